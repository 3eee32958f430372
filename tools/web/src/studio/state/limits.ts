// What a joint's limits say of its rotation, as model/body/joint_limit.cc has it: turned back from
// the middle of the range, R = swing * twist about where the bone points there. Angles and rotation
// vectors in degrees.

import { MathUtils, Quaternion, Vector3 } from "three";
import type { Limits, Quat, Vec } from "./protocol";

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
// Swings about an elliptic cone, about `axis` and about `across`, least and most of each.
export interface Cone {
  axis: Vector3; // of the bone in the rest pose
  centre: Vector3; // where it points in the middle of the range
  about: Vector3;
  across: Vector3;
  swing: [number, number];
  side: [number, number];
}
// The joint before a wrist: its bone, and how it is turned.
export interface ParentJoint {
  axis: Vec;
  rotation_vector: Vec;
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

const middleOf = ({ middle }: Limits) => new Quaternion(...(middle ?? ([0, 0, 0, 1] as Quat)));

// The cone that the bone's direction stays in; null where it may go anywhere.
export function coneOf(limits: Limits): Cone | null {
  const { axis, swing_axis, swing, side } = limits;
  if (!axis || !swing_axis || !swing || !side) return null;
  const centre = vector(axis).applyQuaternion(middleOf(limits));
  const about = vector(swing_axis);
  const across = centre.clone().cross(about);
  return { axis: vector(axis), centre, about, across, swing, side };
}

// How far the bone may swing in the direction of a rotation vector (u about the one axis, v about
// the other).
export function reachOf({ swing, side }: Cone, u: number, v: number): number {
  const most = [u < 0 ? -swing[0] : swing[1], v < 0 ? -side[0] : side[1]];
  const length = Math.hypot(u, v);
  return length === 0 ? Math.min(...most) : length / Math.hypot(u / most[0], v / most[1]);
}

// The swing from the centre to a direction, and the furthest that it may go that way.
function swingOf(cone: Cone, direction: Vector3): { value: number; most: number } {
  const across = cone.centre.clone().cross(direction);
  const value = MathUtils.radToDeg(Math.atan2(across.length(), cone.centre.dot(direction)));
  return { value, most: reachOf(cone, across.dot(cone.about), across.dot(cone.across)) };
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

export function readLimits(
  limits: Limits,
  rotation_vector: Vec,
  parent?: ParentJoint,
): LimitReading[] {
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
    // A wrist's: the forearm as the hand sees it, mirrored about the bone.
    const seen = axis.clone().applyQuaternion(rotation.clone().conjugate());
    const own = axis
      .clone()
      .multiplyScalar(2 * seen.dot(axis))
      .sub(seen);
    const { value, most } = swingOf(cone, limits.twist_with_parent ? own : direction);
    read("swing", value, 0, most);
  }
  const back = middleOf(limits);
  const twist = twistOf(
    rotation.clone().multiply(back.clone().conjugate()),
    axis.clone().applyQuaternion(back),
  );
  if (limits.twist && limits.twist[1] - limits.twist[0] < 359)
    read("twist", twist, ...limits.twist);
  if (limits.twist_with_parent && parent) {
    const before = twistOf(rotationOf(parent.rotation_vector), vector(parent.axis));
    read("twist with forearm", twist + before, ...limits.twist_with_parent);
  }
  return readings;
}
