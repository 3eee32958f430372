// The operations of tools/posing/operation_table.h. Made from them by
// `cmake --build build/release --target operations_ts`: not to be edited.

import type { FigureName } from "../../shared/names";
import type { Camera, HoldEnd, Photo, Quat, Ray, Tangle, Vec } from "./protocol";

export const optionNames = [
  "holds",
  "limits",
  "penetration",
  "floor",
  "tangles",
  "feet",
  "root",
] as const;
export type OptionName = (typeof optionNames)[number];

export interface DragOp {
  op: "drag";
  figure: FigureName;
  node: string;
  target: Vec;
  gesture?: number;
}
export interface DragRayOp {
  op: "drag_ray";
  figure: FigureName;
  node: string;
  origin: Vec;
  direction: Vec;
  gesture?: number;
}
export interface SettleOp {
  op: "settle";
}
export interface PinOp {
  op: "pin";
  figure: FigureName;
  node: string;
  ray?: Ray;
}
export interface UnpinOp {
  op: "unpin";
  figure: FigureName;
  node: string;
}
export interface SetOptionOp {
  op: "set_option";
  option: OptionName;
  on: boolean;
}
export interface MoveFigureOp {
  op: "move_figure";
  figure: FigureName;
  shift: Vec;
  gesture?: number;
}
export interface TurnFigureOp {
  op: "turn_figure";
  figure: FigureName;
  rotation: Quat;
  gesture?: number;
}
export interface RotateJointOp {
  op: "rotate_joint";
  figure: FigureName;
  joint: string;
  rotation: Quat;
  world?: boolean;
  gesture?: number;
}
export interface SetJointOp {
  op: "set_joint";
  figure: FigureName;
  joint: string;
  rotation_vector: Vec;
  gesture?: number;
}
export interface SetRootOp {
  op: "set_root";
  figure: FigureName;
  position: Vec;
  rotation_vector?: Vec;
  gesture?: number;
}
export interface SetStatureOp {
  op: "set_stature";
  figure: FigureName;
  stature: number;
}
export interface MirrorOp {
  op: "mirror";
  figure: FigureName | "both";
}
export interface SwapFiguresOp {
  op: "swap_figures";
}
export interface CopySideOp {
  op: "copy_side";
  figure: FigureName;
  from: "left" | "right";
}
export interface ResetJointOp {
  op: "reset_joint";
  figure: FigureName;
  joint: string;
}
export interface ResetFigureOp {
  op: "reset_figure";
  figure: FigureName;
}
export interface AddHoldOp {
  op: "add_hold";
  from: HoldEnd;
  to: HoldEnd;
  rotation?: boolean;
}
export interface EditHoldOp {
  op: "edit_hold";
  index: number;
  from: HoldEnd;
  to: HoldEnd;
  rotation?: boolean;
}
export interface RemoveHoldOp {
  op: "remove_hold";
  index: number;
}
export interface SetSupportsOp {
  op: "set_supports";
  figure: FigureName;
  nodes: string[];
}
export interface SetRootLeaderOp {
  op: "set_root_leader";
  figure: FigureName;
  leader: "world" | "partner";
}
export interface SetTanglesOp {
  op: "set_tangles";
  tangles: Tangle[];
}
export interface SetNameOp {
  op: "set_name";
  name: string;
}
export interface SetDescriptionOp {
  op: "set_description";
  description: string;
}
export interface SetTagsOp {
  op: "set_tags";
  tags: string[];
}
export interface SetPhotoOp {
  op: "set_photo";
  photo: Photo | null;
}
export interface SetCameraOp {
  op: "set_camera";
  camera: Camera | null;
}
export interface UndoOp {
  op: "undo";
}
export interface RedoOp {
  op: "redo";
}

export type Op =
  | DragOp
  | DragRayOp
  | SettleOp
  | PinOp
  | UnpinOp
  | SetOptionOp
  | MoveFigureOp
  | TurnFigureOp
  | RotateJointOp
  | SetJointOp
  | SetRootOp
  | SetStatureOp
  | MirrorOp
  | SwapFiguresOp
  | CopySideOp
  | ResetJointOp
  | ResetFigureOp
  | AddHoldOp
  | EditHoldOp
  | RemoveHoldOp
  | SetSupportsOp
  | SetRootLeaderOp
  | SetTanglesOp
  | SetNameOp
  | SetDescriptionOp
  | SetTagsOp
  | SetPhotoOp
  | SetCameraOp
  | UndoOp
  | RedoOp;

// Steps of one gesture are one step of the history.
export type GestureOp =
  DragOp | DragRayOp | MoveFigureOp | TurnFigureOp | RotateJointOp | SetJointOp | SetRootOp;
