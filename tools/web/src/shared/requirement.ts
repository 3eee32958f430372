// One requirement and whether it is met, as in report.json and in the studio's replies.

import type { FigureName } from "./names";

export type RequirementKind =
  | "tangle"
  | "pass_throughs"
  | "penetration"
  | "penetration_over_1cm"
  | "foot_drift"
  | "floor"
  | "hold"
  | "segment_length"
  | "write_back";

export interface Requirement {
  name: string;
  kind: RequirementKind;
  item: number | null; // tag or hold, from 0
  figure: FigureName | null;
  frame: number | null; // of the worst
  limbs: { figure: FigureName; node: string }[]; // concerned there
  value: number;
  limit: number;
  unit: string;
  met: boolean;
  where: string;
}
