// One figure as capsules between its nodes, and a nose that says where it looks.

import {
  BufferAttribute,
  BufferGeometry,
  Color,
  Group,
  Mesh,
  MeshLambertMaterial,
  Quaternion,
  SRGBColorSpace,
  Vector3,
  type MeshBasicMaterial,
} from "three";
import { findNode } from "../../shared/body";
import type { Rgb } from "../../shared/colours";
import type { FigureBody, FigureState } from "../state/protocol";

const kHead = findNode("head");
const kHeadTop = findNode("head_top");

// A capsule's vertices as directions of the unit sphere, in rings; the first half of the rings
// belongs to its start.
function sphere(around: number, rings: number): Vector3[] {
  const directions: Vector3[] = [];
  for (let ring = 0; ring < rings; ++ring) {
    const half = ring < rings / 2 ? -1 : 1;
    const step = half < 0 ? rings / 2 - 1 - ring : ring - rings / 2;
    const angle = (Math.PI / 2) * (step / (rings / 2 - 1)); // from the seam to the pole
    for (let k = 0; k < around; ++k) {
      const turn = (2 * Math.PI * k) / around;
      directions.push(
        new Vector3(
          Math.cos(angle) * Math.cos(turn),
          half * Math.sin(angle),
          Math.cos(angle) * Math.sin(turn),
        ),
      );
    }
  }
  return directions;
}

function indices(capsules: number, around: number, rings: number): number[] {
  const out: number[] = [];
  for (let c = 0; c < capsules; ++c) {
    for (let ring = 0; ring + 1 < rings; ++ring) {
      for (let k = 0; k < around; ++k) {
        const a = (c * rings + ring) * around + k;
        const b = (c * rings + ring) * around + ((k + 1) % around);
        out.push(a, a + around, b, b, a + around, b + around);
      }
    }
  }
  return out;
}

const kUp = new Vector3(0, 1, 0);

export class FigureMesh {
  readonly group = new Group();
  readonly material = new MeshLambertMaterial({ vertexColors: true });
  private readonly geometry = new BufferGeometry();
  private readonly position: BufferAttribute;
  private readonly normal: BufferAttribute;
  private readonly colour: BufferAttribute;
  private readonly shadow: Mesh;
  private readonly capsules: number;
  private readonly directions: Vector3[];

  // `around`: vertices round a capsule, even.
  constructor(
    private body: FigureBody,
    shadow: MeshBasicMaterial,
    around: number,
  ) {
    const rings = around / 2 + ((around / 2) % 2);
    this.directions = sphere(around, rings);
    this.capsules = body.nodes.length; // a segment per node but the root, and the nose
    const size = 3 * this.directions.length * this.capsules;
    const attribute = () => new BufferAttribute(new Float32Array(size), 3);
    this.position = attribute();
    this.normal = attribute();
    this.colour = attribute();
    this.geometry.setAttribute("position", this.position);
    this.geometry.setAttribute("normal", this.normal);
    this.geometry.setAttribute("color", this.colour);
    this.geometry.setIndex(indices(this.capsules, around, rings));
    const mesh = new Mesh(this.geometry, this.material);
    this.shadow = new Mesh(this.geometry, shadow);
    mesh.frustumCulled = this.shadow.frustumCulled = false;
    this.group.add(mesh, this.shadow);
  }

  resize(body: FigureBody): void {
    this.body = body;
  }

  // A ghost is seen through, and what is behind it too.
  appear(opacity: number, ghost: boolean): void {
    const { material } = this;
    material.opacity = ghost ? 0.22 : opacity;
    material.depthWrite = !ghost;
    if (material.transparent !== material.opacity < 1) {
      material.transparent = material.opacity < 1;
      material.needsUpdate = true;
    }
  }
  castShadow(on: boolean): void {
    this.shadow.visible = on;
  }

  pose(state: FigureState): void {
    const at = (node: number) => new Vector3(...state.nodes[node]);
    this.body.nodes.forEach(({ parent, radius_m }, node) => {
      if (parent >= 0) this.capsule(node - 1, at(parent), at(node), radius_m);
    });
    const link = this.body.links.findIndex(({ name }) => name === "head");
    const turn = new Quaternion(...state.frames[link]);
    const radius = this.body.nodes[kHeadTop].radius_m;
    const axis = at(kHeadTop).sub(at(kHead));
    const ahead = new Vector3(0, 0, 1).applyQuaternion(turn);
    const point = (along: number, out: number) =>
      at(kHead)
        .addScaledVector(axis, along)
        .addScaledVector(ahead, out * radius);
    this.capsule(this.capsules - 1, point(0.68, 0.85), point(0.55, 1.12), 0.26 * radius);
    this.position.needsUpdate = this.normal.needsUpdate = true;
  }

  private capsule(index: number, from: Vector3, to: Vector3, radius: number): void {
    const axis = to.clone().sub(from);
    const turn = new Quaternion();
    if (axis.lengthSq() > 0) turn.setFromUnitVectors(kUp, axis.normalize());
    const out = new Vector3();
    const count = this.directions.length;
    this.directions.forEach((direction, k) => {
      const vertex = 3 * (index * count + k);
      out.copy(direction).applyQuaternion(turn).toArray(this.normal.array, vertex);
      out
        .multiplyScalar(radius)
        .add(k < count / 2 ? from : to)
        .toArray(this.position.array, vertex);
    });
  }

  // One colour per segment; the nose goes with the head. [segments]
  paint(colours: Rgb[]): void {
    const linear = new Color();
    const count = this.directions.length;
    for (let c = 0; c < this.capsules; ++c) {
      linear.setRGB(...colours[c < this.capsules - 1 ? c : kHeadTop - 1], SRGBColorSpace);
      for (let k = 0; k < count; ++k) linear.toArray(this.colour.array, 3 * (c * count + k));
    }
    this.colour.needsUpdate = true;
  }
}
