// Joint limits drawn round the joint that is turned: an arc for a hinge, the rim of a cone for a
// swing; amber where the joint is beyond it.

import { MathUtils, Quaternion, Vector3 } from "three";
import { okabeIto } from "../../shared/colours";
import { themeColour } from "../../shared/theme";
import {
  coneOf,
  hingeOf,
  reachOf,
  readLimits,
  rotationOf,
  type Cone,
  type Hinge,
} from "../state/limits";
import type { Store } from "../state/store";
import type { View } from "./view";

const kArc = 0.2; // m
const kSteps = { arc: 40, rim: 60 };

type Context = CanvasRenderingContext2D;
type Point = { x: number; y: number };

// Directions in which a hinge may point the bone, in the joint's parent.
function arc({ axis, hinge, bend }: Hinge): Vector3[] {
  const [from, to] = bend.map(MathUtils.degToRad);
  return Array.from({ length: kSteps.arc + 1 }, (_, k) =>
    axis.clone().applyAxisAngle(hinge, from + ((to - from) * k) / kSteps.arc),
  );
}

// The furthest directions of a swing, in the joint's parent.
function rim(cone: Cone): Vector3[] {
  return Array.from({ length: kSteps.rim + 1 }, (_, k) => {
    const [u, v] = [Math.cos, Math.sin].map((f) => f((2 * Math.PI * k) / kSteps.rim));
    const about = cone.about.clone().multiplyScalar(u).addScaledVector(cone.across, v);
    return cone.centre.clone().applyAxisAngle(about, MathUtils.degToRad(reachOf(cone, u, v)));
  });
}

function fill(context: Context, outline: Point[], colour: string): void {
  context.beginPath();
  context.moveTo(outline[0].x, outline[0].y);
  for (const { x, y } of outline.slice(1)) context.lineTo(x, y);
  context.closePath();
  context.globalAlpha = 0.16;
  context.fillStyle = colour;
  context.fill();
  context.globalAlpha = 1;
  context.lineWidth = 1.5;
  context.strokeStyle = colour;
  context.stroke();
}

function drawBone(context: Context, from: Point, to: Point): void {
  context.lineWidth = 3;
  context.beginPath();
  context.moveTo(from.x, from.y);
  context.lineTo(to.x, to.y);
  context.stroke();
}

export function drawLimits(context: Context, view: View, store: Store): void {
  const { figure, joint, selected, tool } = store.ui;
  if (!selected || joint <= 0 || tool !== "rotate") return;
  const { limits, parent } = store.body[figure].links[joint];
  const [hinge, cone] = [hingeOf(limits), coneOf(limits)];
  if (parent < 0 || (!hinge && !cone)) return;
  const state = store.state.figures[figure];
  const frame = new Quaternion(...state.frames[parent]);
  const centre = store.jointCentre(figure, joint);
  const onPage = (direction: Vector3) =>
    view.project(
      new Vector3(...centre).addScaledVector(direction.clone().applyQuaternion(frame), kArc),
    );
  const middle = view.project(centre);
  const points = (hinge ? arc(hinge) : rim(cone!)).map(onPage);
  if (!middle || points.some((p) => !p)) return;
  const outline = points as Point[];
  const turn = state.rotation_vectors[joint];
  const before = store.body[figure].links[parent].limits.axis;
  const parentJoint = before && { axis: before, rotation_vector: state.rotation_vectors[parent] };
  const beyond = readLimits(limits, turn, parentJoint).some((r) => r.beyond);
  const colour = beyond ? okabeIto.orange : themeColour("--accent");
  fill(context, hinge ? [middle, ...outline] : outline, colour);
  const now = onPage((hinge ?? cone!).axis.applyQuaternion(rotationOf(turn)));
  if (now) drawBone(context, middle, now);
}
