// The body as a tree: names of the nodes in their order, and who is whose parent. A segment ends at
// each node but the root and is known by it; segment k ends at node k + 1.

const kTree: [name: string, parent: string | null][] = [
  ["root", null],
  ["chest", "root"],
  ["neck", "chest"],
  ["head", "neck"],
  ["head_top", "head"],
  ["left_shoulder", "neck"],
  ["left_elbow", "left_shoulder"],
  ["left_wrist", "left_elbow"],
  ["left_hand", "left_wrist"],
  ["right_shoulder", "neck"],
  ["right_elbow", "right_shoulder"],
  ["right_wrist", "right_elbow"],
  ["right_hand", "right_wrist"],
  ["left_hip", "root"],
  ["left_knee", "left_hip"],
  ["left_ankle", "left_knee"],
  ["left_toe", "left_ankle"],
  ["right_hip", "root"],
  ["right_knee", "right_hip"],
  ["right_ankle", "right_knee"],
  ["right_toe", "right_ankle"],
];

export const nodeNames = kTree.map(([name]) => name);
export const numNodes = nodeNames.length;
export const numSegments = numNodes - 1;
const nodeIndex = new Map(nodeNames.map((name, index) => [name, index]));
// Index of each node's parent; -1 for the root.
export const parentOf = kTree.map(([, parent]) => (parent === null ? -1 : nodeIndex.get(parent)!));

export function findNode(name: string): number {
  const index = nodeIndex.get(name);
  if (index === undefined) throw new Error(`no node "${name}"`);
  return index;
}

// The signs with which the path `from`..`to` walks the segments: +1 outward, -1 inward, 0 not at
// all. [segments]
export function pathSigns(from: number, to: number): Int8Array {
  const signs = new Int8Array(numSegments);
  for (let n = to; n > 0; n = parentOf[n]) signs[n - 1] += 1;
  for (let n = from; n > 0; n = parentOf[n]) signs[n - 1] -= 1;
  return signs;
}
