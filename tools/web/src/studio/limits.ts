// Joint limits as arcs round the joint that is turned, and in numbers. Angles in degrees, as in
// solver/terms/joint_limit.cc: R = swing * twist about the bone's direction in the rest pose.

import { MathUtils, Quaternion, Vector3 } from "three";
import type { FigureName } from "../shared/names";
import { themeColour } from "../shared/theme";
import type { Limits, Vec } from "./protocol";
import type { Store } from "./store";
import type { View } from "./view";

const kArc = 0.2; // m

export interface LimitReading {
  name: string;
  value: number;
  min: number;
  max: number;
  beyond: boolean;
}

const vector = (v: Vec) => new Vector3(...v);
const clampedAcos = (x: number) => Math.acos(Math.min(1, Math.max(-1, x)));

export function rotationOf(v: Vec): Quaternion {
  const angle = MathUtils.degToRad(Math.hypot(...v));
  if (angle === 0) return new Quaternion();
  return new Quaternion().setFromAxisAngle(vector(v).normalize(), angle);
}

export function rotationVectorOf(q: Quaternion): Vec {
  const sign = q.w < 0 ? -1 : 1;
  const v = new Vector3(q.x, q.y, q.z).multiplyScalar(sign);
  const sine = v.length();
  const angle = MathUtils.radToDeg(2 * Math.atan2(sine, sign * q.w));
  return sine === 0 ? [0, 0, 0] : (v.multiplyScalar(angle / sine).toArray() as Vec);
}

function twistOf(rotation: Quaternion, axis: Vector3): number {
  const sign = rotation.w < 0 ? -1 : 1;
  const along = sign * (rotation.x * axis.x + rotation.y * axis.y + rotation.z * axis.z);
  return MathUtils.radToDeg(2 * Math.atan2(along, sign * rotation.w));
}

// What a joint's limits say of its rotation.
export function readLimits(limits: Limits, rotation_vector: Vec): LimitReading[] {
  const readings: LimitReading[] = [];
  const read = (name: string, value: number, min: number, max: number) =>
    readings.push({ name, value, min, max, beyond: value < min - 0.5 || value > max + 0.5 });
  if (!limits.axis) return readings;
  const rotation = rotationOf(rotation_vector);
  const axis = vector(limits.axis);
  const direction = axis.clone().applyQuaternion(rotation);
  if (limits.hinge_axis && limits.bend && vector(limits.hinge_axis).lengthSq() > 0) {
    const hinge = vector(limits.hinge_axis);
    const ahead = hinge.clone().cross(axis);
    let bend = MathUtils.radToDeg(Math.atan2(direction.dot(ahead), direction.dot(axis)));
    if (bend < -90) bend += 360;
    read("bend", bend, ...limits.bend);
    const side = MathUtils.radToDeg(Math.asin(Math.min(1, Math.max(-1, direction.dot(hinge)))));
    const play = limits.hinge_play ?? 180;
    if (play < 179) read("sideways", side, -play, play);
  } else if (limits.swing_centre && (limits.swing_max ?? 180) < 179) {
    const swing = MathUtils.radToDeg(clampedAcos(direction.dot(vector(limits.swing_centre))));
    read("swing", swing, 0, limits.swing_max!);
  }
  if (limits.twist && limits.twist[1] - limits.twist[0] < 359) {
    read("twist", twistOf(rotation, axis), ...limits.twist);
  }
  return readings;
}

export function jointPlace(store: Store, figure: FigureName, link: number): Vector3 {
  return vector(store.state.figures[figure].centres[link]);
}

// The range of the selected joint: an arc for a hinge, the rim of a cone for a swing; amber where
// the joint is beyond it.
export function drawLimits(context: CanvasRenderingContext2D, view: View, store: Store): void {
  const { figure, joint, selected, tool } = store.ui;
  if (!selected || joint <= 0 || tool !== "rotate") return;
  const { limits, parent } = store.body[figure].links[joint];
  const state = store.state.figures[figure];
  if (!limits.axis || parent < 0) return;
  const beyond = readLimits(limits, state.rotation_vectors[joint]).some((r) => r.beyond);
  const frame = new Quaternion(...state.frames[parent]);
  const centre = jointPlace(store, figure, joint);
  const onPage = (direction: Vector3) =>
    view.project(centre.clone().addScaledVector(direction.applyQuaternion(frame), kArc));
  const directions: Vector3[] = [];
  const axis = vector(limits.axis);
  const hinged = limits.hinge_axis && limits.bend && vector(limits.hinge_axis).lengthSq() > 0;
  if (hinged) {
    const hinge = vector(limits.hinge_axis!);
    const [from, to] = limits.bend!.map(MathUtils.degToRad);
    for (let k = 0; k <= 40; ++k)
      directions.push(axis.clone().applyAxisAngle(hinge, from + ((to - from) * k) / 40));
  } else if (limits.swing_centre && (limits.swing_max ?? 180) < 179) {
    const middle = vector(limits.swing_centre).normalize();
    const side = middle
      .clone()
      .cross(Math.abs(middle.y) < 0.9 ? new Vector3(0, 1, 0) : new Vector3(1, 0, 0))
      .normalize();
    const rim = middle.clone().applyAxisAngle(side, MathUtils.degToRad(limits.swing_max!));
    for (let k = 0; k <= 60; ++k)
      directions.push(rim.clone().applyAxisAngle(middle, (2 * Math.PI * k) / 60));
  } else {
    return;
  }
  const middle = view.project(centre);
  const now = onPage(
    axis.clone().applyQuaternion(new Quaternion().copy(rotationOf(state.rotation_vectors[joint]))),
  );
  const points = directions.map(onPage);
  if (!middle || points.some((p) => !p)) return;
  context.beginPath();
  if (hinged) context.moveTo(middle.x, middle.y);
  points.forEach((p, k) =>
    k === 0 && !hinged ? context.moveTo(p!.x, p!.y) : context.lineTo(p!.x, p!.y),
  );
  if (hinged) context.closePath();
  const colour = beyond ? "#E69F00" : themeColour("--accent");
  context.globalAlpha = 0.16;
  context.fillStyle = colour;
  context.fill();
  context.globalAlpha = 1;
  context.lineWidth = 1.5;
  context.strokeStyle = colour;
  context.stroke();
  if (!now) return;
  context.lineWidth = 3;
  context.beginPath();
  context.moveTo(middle.x, middle.y);
  context.lineTo(now.x, now.y);
  context.stroke();
}
