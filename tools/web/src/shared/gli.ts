// Gauss Linking Integral of straight segments (Ho and Komura 2007, Eq. 1), in turns. The closed
// form is the signed solid angle of a parallelogram (van Oosterom and Strackee 1983); the same as
// model/geometry/gli.cc.

import { numSegments, parentOf } from "./body";

// Turns from which two paths are tangled (ibid., section 4.2).
export const kTangled = 0.5;

// Node positions of one body: x, y, z of each node in order. [3 x nodes] (m)
export type NodePositions = ArrayLike<number>;

const p = new Float64Array(12); // the parallelogram's corners, p1..p4
const n = new Float64Array(4); // and their lengths

function dot(i: number, j: number): number {
  return p[3 * i] * p[3 * j] + p[3 * i + 1] * p[3 * j + 1] + p[3 * i + 2] * p[3 * j + 2];
}

function cross(i: number, j: number): [number, number, number] {
  const [a, b] = [3 * i, 3 * j];
  return [
    p[a + 1] * p[b + 2] - p[a + 2] * p[b + 1],
    p[a + 2] * p[b] - p[a] * p[b + 2],
    p[a] * p[b + 1] - p[a + 1] * p[b],
  ];
}

// A crossing at a gap that is tiny beside the segments: by the cone's four dihedral angles.
function dihedral(volume: number): number {
  const m = [0, 1, 2, 3].map((i) => cross(i, (i + 1) % 4));
  let angle = 2 * Math.PI;
  for (let i = 0; i < 4; ++i) {
    const q = m[(i + 1) % 4];
    const along = m[i][0] * q[0] + m[i][1] * q[1] + m[i][2] * q[2];
    angle -= Math.atan2(n[(i + 1) % 4] * Math.abs(volume), along);
  }
  return (Math.sign(volume) * angle) / (4 * Math.PI);
}

// GLI of the segment from node `a` to node `b` of `first` with that from `c` to `d` of `second`.
export function segmentGli(
  first: NodePositions,
  a: number,
  b: number,
  second: NodePositions,
  c: number,
  d: number,
): number {
  for (let k = 0; k < 3; ++k) {
    const [ak, bk] = [first[3 * a + k], first[3 * b + k]];
    const [ck, dk] = [second[3 * c + k], second[3 * d + k]];
    p[k] = ak - ck;
    p[3 + k] = bk - ck;
    p[6 + k] = bk - dk;
    p[9 + k] = ak - dk;
  }
  for (let i = 0; i < 4; ++i) n[i] = Math.sqrt(dot(i, i));
  // u = b - a, v = d - c; the volume is the same from every corner, and the shortest one loses the
  // fewest digits.
  const [ux, uy, uz] = [0, 1, 2].map((k) => first[3 * b + k] - first[3 * a + k]);
  const [vx, vy, vz] = [0, 1, 2].map((k) => second[3 * d + k] - second[3 * c + k]);
  let s = 0;
  for (let i = 1; i < 4; ++i) if (n[i] < n[s]) s = i;
  const volume =
    (uy * vz - uz * vy) * p[3 * s] +
    (uz * vx - ux * vz) * p[3 * s + 1] +
    (ux * vy - uy * vx) * p[3 * s + 2];
  if (volume === 0) return 0;
  const p13 = dot(0, 2);
  const n13 = n[0] * n[2];
  const k = n13 + p13;
  if (k < 0.01 * n13) return dihedral(volume);
  const d1 = k * n[1] + dot(0, 1) * n[2] + dot(1, 2) * n[0];
  const d2 = k * n[3] + dot(0, 3) * n[2] + dot(2, 3) * n[0];
  const angle = Math.atan2(Math.abs(volume) * Math.max(0, d1 + d2), d1 * d2 - volume * volume);
  return (Math.sign(volume) * angle) / (2 * Math.PI);
}

// All segments of one body against all of the other, by rows. [segments x segments]
export function gliTable(first: NodePositions, second: NodePositions): Float64Array {
  const table = new Float64Array(numSegments * numSegments);
  for (let i = 0; i < numSegments; ++i) {
    for (let j = 0; j < numSegments; ++j) {
      table[i * numSegments + j] = segmentGli(
        first,
        parentOf[i + 1],
        i + 1,
        second,
        parentOf[j + 1],
        j + 1,
      );
    }
  }
  return table;
}

// GLI of two paths (Eq. 3), each given by its signs.
export function pathGli(table: Float64Array, first: Int8Array, second: Int8Array): number {
  let sum = 0;
  for (let i = 0; i < numSegments; ++i) {
    if (first[i] === 0) continue;
    for (let j = 0; j < numSegments; ++j) {
      sum += first[i] * second[j] * table[i * numSegments + j];
    }
  }
  return sum;
}

// How much each segment is wound up with the other body as a whole (the paper's Fig. 7): the sum of
// |GLI| over the other body's segments. One row per body. [2][segments]
export function heat(table: Float64Array): [Float64Array, Float64Array] {
  const rows = new Float64Array(numSegments);
  const columns = new Float64Array(numSegments);
  for (let i = 0; i < numSegments; ++i) {
    for (let j = 0; j < numSegments; ++j) {
      const value = Math.abs(table[i * numSegments + j]);
      rows[i] += value;
      columns[j] += value;
    }
  }
  return [rows, columns];
}
