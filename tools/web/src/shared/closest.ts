// Closest points of two segments, for the mark where bodies touch (Ericson, Real-Time Collision
// Detection, 2005, section 5.1.9).

import { type Vector3 } from "three";

const clamp01 = (x: number) => Math.min(1, Math.max(0, x));

// The middle between the closest points of a..b and c..d.
export function middleOfClosest(a: Vector3, b: Vector3, c: Vector3, d: Vector3): Vector3 {
  const u = b.clone().sub(a);
  const v = d.clone().sub(c);
  const w = a.clone().sub(c);
  const [uu, vv, uv] = [u.dot(u), v.dot(v), u.dot(v)];
  const [uw, vw] = [u.dot(w), v.dot(w)];
  const denominator = uu * vv - uv * uv;
  let s = denominator > 1e-12 ? clamp01((uv * vw - uw * vv) / denominator) : 0;
  let t = vv > 0 ? (uv * s + vw) / vv : 0;
  if (t < 0 || t > 1) {
    t = clamp01(t);
    s = uu > 0 ? clamp01((uv * t - uw) / uu) : 0;
  }
  return a.clone().addScaledVector(u, s).add(c.clone().addScaledVector(v, t)).multiplyScalar(0.5);
}
