// Positions of a scene's nodes at its keys, from the bytes of the file alone: no library, and
// nothing of the pages' code.
import { readFileSync } from "node:fs";

const kComponents = { SCALAR: 1, VEC3: 3, VEC4: 4, MAT4: 16 };

// p of q p q^-1, q = [x, y, z, w].
function turned([x, y, z, w], p) {
  const t = [2 * (y * p[2] - z * p[1]), 2 * (z * p[0] - x * p[2]), 2 * (x * p[1] - y * p[0])];
  return [
    p[0] + w * t[0] + y * t[2] - z * t[1],
    p[1] + w * t[1] + z * t[0] - x * t[2],
    p[2] + w * t[2] + x * t[1] - y * t[0],
  ];
}

export class Glb {
  constructor(path) {
    const bytes = readFileSync(path);
    const length = bytes.readUInt32LE(12);
    this.json = JSON.parse(bytes.subarray(20, 20 + length).toString("utf8"));
    this.bin = bytes.subarray(20 + length + 8);
    this.parent = new Map();
    this.json.nodes.forEach((node, k) =>
      (node.children ?? []).forEach((c) => this.parent.set(c, k)),
    );
    this.tracks = new Map(); // "node path" -> rows
    const { channels, samplers } = this.json.animations[0];
    for (const { target, sampler } of channels) {
      this.tracks.set(`${target.node} ${target.path}`, this.rows(samplers[sampler].output));
    }
    this.frames = this.rows(samplers[0].input).length;
  }

  rows(index) {
    const { bufferView, byteOffset = 0, count, type } = this.json.accessors[index];
    const start = (this.json.bufferViews[bufferView].byteOffset ?? 0) + byteOffset;
    const width = kComponents[type];
    return Array.from({ length: count }, (_, k) =>
      Array.from({ length: width }, (_, c) => this.bin.readFloatLE(start + 4 * (k * width + c))),
    );
  }

  names() {
    return this.json.nodes
      .filter((n) => /^[ab]\/(?!joint\/)/.test(n.name ?? ""))
      .map((n) => n.name);
  }

  position(name, frame) {
    let p = [0, 0, 0];
    for (
      let n = this.json.nodes.findIndex((x) => x.name === name);
      n !== undefined;
      n = this.parent.get(n)
    ) {
      const node = this.json.nodes[n];
      const q = this.tracks.get(`${n} rotation`)?.[frame] ?? node.rotation ?? [0, 0, 0, 1];
      const t = this.tracks.get(`${n} translation`)?.[frame] ?? node.translation ?? [0, 0, 0];
      p = turned(q, p).map((x, k) => x + t[k]);
    }
    return p;
  }
}
