// What a joint's limits say of its rotation, as solver/problem/terms/joint_limit.cc has it:
// R = swing * twist about the bone's direction in the rest pose. Angles and rotation vectors in
// degrees.

import { MathUtils, Quaternion, Vector3 } from "three";
import type { Limits, Vec } from "./protocol";

const kShown = 0.5; // degrees beyond a limit that count

export interface LimitReading {
  name: string;
  value: number;
  min: number;
  max: number;
  beyond: boolean;
}

export interface Hinge {
  axis: Vector3; // of the bone in the rest pose
  hinge: Vector3;
  bend: [number, number];
  play: number; // out of the plane of bending
}
export interface Cone {
  axis: Vector3; // as above
  centre: Vector3;
  swing: number;
}

const vector = (v: Vec) => new Vector3(...v);
const clampedToOne = (x: number) => Math.min(1, Math.max(-1, x));

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

// The limits of a joint that bends one way; null for others.
export function hingeOf({ axis, hinge_axis, bend, hinge_play }: Limits): Hinge | null {
  if (!axis || !hinge_axis || !bend) return null;
  const hinge = vector(hinge_axis);
  if (hinge.lengthSq() === 0) return null;
  return { axis: vector(axis), hinge, bend, play: hinge_play ?? 180 };
}

// The cone that the bone's direction stays in; null where it may go anywhere.
export function coneOf({ axis, swing_centre, swing_max }: Limits): Cone | null {
  if (!axis || !swing_centre || (swing_max ?? 180) >= 179) return null;
  return { axis: vector(axis), centre: vector(swing_centre), swing: swing_max! };
}

function twistOf(rotation: Quaternion, axis: Vector3): number {
  const sign = rotation.w < 0 ? -1 : 1;
  const along = sign * (rotation.x * axis.x + rotation.y * axis.y + rotation.z * axis.z);
  return MathUtils.radToDeg(2 * Math.atan2(along, sign * rotation.w));
}

// Past half a turn the angle wraps: more bent, not bent backwards. [-90, 270) degrees
function bendOf(direction: Vector3, { axis, hinge }: Hinge): number {
  const ahead = hinge.clone().cross(axis);
  const bend = MathUtils.radToDeg(Math.atan2(direction.dot(ahead), direction.dot(axis)));
  return bend < -90 ? bend + 360 : bend;
}

export function readLimits(limits: Limits, rotation_vector: Vec): LimitReading[] {
  if (!limits.axis) return [];
  const readings: LimitReading[] = [];
  const read = (name: string, value: number, min: number, max: number) =>
    readings.push({ name, value, min, max, beyond: value < min - kShown || value > max + kShown });
  const rotation = rotationOf(rotation_vector);
  const axis = vector(limits.axis);
  const direction = axis.clone().applyQuaternion(rotation);
  const [hinge, cone] = [hingeOf(limits), coneOf(limits)];
  if (hinge) {
    read("bend", bendOf(direction, hinge), ...hinge.bend);
    const side = MathUtils.radToDeg(Math.asin(clampedToOne(direction.dot(hinge.hinge))));
    if (hinge.play < 179) read("sideways", side, -hinge.play, hinge.play);
  } else if (cone) {
    const swing = MathUtils.radToDeg(Math.acos(clampedToOne(direction.dot(cone.centre))));
    read("swing", swing, 0, cone.swing);
  }
  if (limits.twist && limits.twist[1] - limits.twist[0] < 359) {
    read("twist", twistOf(rotation, axis), ...limits.twist);
  }
  return readings;
}
