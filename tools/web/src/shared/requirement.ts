// A requirement as report.json has it (docs/report.md); the studio's runs say the same.
import type { FigureName } from "./names";

export type RequirementKind =
  | "tangle"
  | "pass_throughs"
  | "penetration"
  | "penetration_over_1cm"
  | "foot_drift"
  | "foot_travel"
  | "foot_acceleration"
  | "floor"
  | "hold"
  | "segment_length"
  | "write_back"
  | "plausible.pose_error"
  | "plausible.trunk_tilt"
  | "plausible.floating"
  | "plausible.joint_limit"
  | "plausible.jerk";

export interface Requirement {
  name: string;
  kind: RequirementKind;
  item: number | null; // tag or hold, from 0
  figure: FigureName | null;
  frame: number | null; // of the worst
  limbs: { figure: FigureName; node: string }[];
  value: number | null; // null: there was nothing to judge
  limit: number;
  unit: string;
  met: boolean;
  where: string;
}
