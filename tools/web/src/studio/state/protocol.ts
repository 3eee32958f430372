// What the page and the server say to each other. Lengths in m, angles in degrees, quaternions
// [x, y, z, w]; figures, nodes and joints by name.

import type { FigureName, PerFigure } from "../../shared/names";
import type { Requirement } from "../../shared/requirement";
import type { OptionName } from "./operations";

export { optionNames, type GestureOp, type Op, type OptionName } from "./operations";

export type Vec = [number, number, number];
export type Quat = [number, number, number, number];
export type Path = [string, string];

export interface Limits {
  kind: string; // "fixed", "hinge", "swing_twist", "free"
  axis?: Vec;
  twist?: [number, number];
  middle?: Quat; // rotation in the middle of the range
  swing_axis?: Vec; // perpendicular to where the bone points there
  swing?: [number, number]; // about that axis, half axes of an ellipse
  side?: [number, number]; // and about the direction times that axis
  twist_with_parent?: [number, number]; // of both; then the swing is told in the link's own frame
  hinge_axis?: Vec;
  bend?: [number, number];
  hinge_play?: number; // out of the plane of bending
}

export interface FigureBody {
  stature: number;
  nodes: { name: string; parent: number; radius_m: number; link: number }[]; // link: carries it
  links: { name: string; parent: number; node: string | null; limits: Limits }[];
}
export type Body = PerFigure<FigureBody>;

export interface FigureState {
  stature: number;
  root: { position: Vec; rotation_vector: Vec };
  nodes: Vec[];
  frames: Quat[]; // of the links, in the world
  rotation_vectors: Vec[]; // of the links, in their parents
  centres: Vec[]; // of the joints, in the world
}

export interface Ray {
  origin: Vec;
  direction: Vec;
}
export interface Pin {
  figure: FigureName;
  node: string;
  position: Vec;
  ray?: Ray | null;
}
export interface HoldEnd {
  figure: FigureName | "world";
  node?: string;
  offset?: Vec;
}
export interface Hold {
  from: HoldEnd;
  to: HoldEnd;
  rotation: boolean;
  error_m: number;
  from_place: Vec;
  to_place: Vec;
}
export interface Tangle {
  a: Path;
  b: Path;
  from?: number; // s
  to?: number;
}
export interface Tag extends Tangle {
  gli: number;
  to_half: number;
  rho: number;
  group_size: number;
  requested: boolean;
  weak: boolean;
  can_slip: boolean;
}
export interface Overlap {
  limbs: [string, string];
  depth_m: number;
  place: Vec;
}
export interface Queries {
  tags: Tag[];
  literal_tangles: number;
  overlaps: Overlap[];
  requirements: Requirement[];
  requirements_met: boolean;
  beyond_limits_deg: Record<string, number>;
  warnings: string[];
}
export interface Photo {
  file: string;
  opacity: number;
  scale: number; // 1: as high as the view
  offset: [number, number]; // heights of the view, right and up
}
export interface Camera {
  eye: Vec;
  target: Vec;
  fov_deg: number;
}

export interface State {
  revision: number;
  dirty: boolean;
  saved_as: string | null;
  can_undo: boolean;
  can_redo: boolean;
  undo_text?: string;
  name: string;
  description: string;
  tags_words: string[];
  figures: PerFigure<FigureState>;
  pins: Pin[];
  options: Record<OptionName, boolean>;
  holds: Hold[];
  supports: PerFigure<string[]>;
  root: PerFigure<"world" | "partner">;
  tangles: Tangle[];
  photo: Photo | null;
  camera: Camera | null;
  queries: Queries;
}

// What the solver found, where it was asked.
export interface Result {
  drag_error_m: number;
  pin_error_m: number;
  blocked?: [string, string] | null;
  stalled: boolean;
  converged: boolean;
  iterations: number;
  ms: number;
}
export interface ClipInfo {
  file: string;
  frames: number;
  fps: number;
  stature: number;
}
export interface Start {
  template?: string;
  photo?: boolean;
  clips?: Partial<PerFigure<ClipInfo>>;
  library?: string;
}
export interface Reply {
  session?: string;
  start?: Start;
  body?: Body;
  state: State;
  result?: Result | null;
  warning?: string;
}
export interface TemplateInfo {
  id: string;
  name: string;
  description: string;
  tags: string[];
  read_only: boolean;
  modified?: string;
  has_thumbnail: boolean;
  error?: string; // why it cannot be read
}
