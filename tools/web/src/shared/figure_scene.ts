// A written scene (scene.glb and the like) on a stage: both figures, posed at any time, painted
// segment by segment. Node names are those of the file: "a/left_wrist".

import {
  type AnimationClip,
  AnimationMixer,
  BufferAttribute,
  Color,
  type Mesh,
  type MeshBasicMaterial,
  MeshLambertMaterial,
  type Object3D,
  Scene,
  SkinnedMesh,
  SRGBColorSpace,
  Vector3,
} from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { nodeNames, numNodes, numSegments } from "./body";
import type { Rgb } from "./colours";
import { figureNames, type FigureName, type PerFigure } from "./names";
import { shadowMaterial } from "./surroundings";

// The file's mesh is one capsule per segment in node order, then the nose, each of as many
// vertices.
const kCapsules = numSegments + 1;
const kHeadSegment = nodeNames.indexOf("head_top") - 1;

function shadowOf(mesh: SkinnedMesh, material: MeshBasicMaterial): SkinnedMesh {
  const shadow = new SkinnedMesh(mesh.geometry, material);
  shadow.bind(mesh.skeleton, mesh.bindMatrix);
  shadow.frustumCulled = false;
  return shadow;
}

interface Figure {
  nodes: Object3D[]; // in node order
  colour: BufferAttribute;
  perCapsule: number; // vertices
  positions: Float64Array; // [3 x nodes], world
}

export class FigureScene {
  readonly scene = new Scene();
  readonly duration: number; // s
  private readonly nodes = new Map<string, Object3D>();
  private readonly figures: PerFigure<Figure>;
  private readonly mixer: AnimationMixer;
  private readonly shadow = shadowMaterial();

  static async load(bytes: ArrayBuffer): Promise<FigureScene> {
    const gltf = await new GLTFLoader().parseAsync(bytes, "");
    return new FigureScene(gltf.scene, gltf.animations[0]);
  }

  private constructor(
    root: Object3D,
    private readonly clip: AnimationClip,
  ) {
    this.scene.add(root);
    // The loader changes names with a slash in them and keeps the file's own in userData.
    const meshes: SkinnedMesh[] = [];
    root.traverse((node) => {
      this.nodes.set((node.userData.name as string) ?? node.name, node);
      if (node instanceof SkinnedMesh) meshes.push(node);
    });
    const shadows = meshes.map((mesh) => shadowOf(mesh, this.shadow));
    this.scene.add(...shadows);
    this.figures = { a: this.figureOf("a", meshes[0]), b: this.figureOf("b", meshes[1]) };
    this.mixer = new AnimationMixer(root);
    const action = this.mixer.clipAction(clip);
    action.play();
    action.paused = true; // the clock is ours
    this.duration = clip.duration;
    this.pose(0);
  }

  private figureOf(name: FigureName, mesh: SkinnedMesh): Figure {
    const count = mesh.geometry.getAttribute("position").count;
    const colour = new BufferAttribute(new Float32Array(3 * count), 3);
    mesh.geometry.setAttribute("color", colour);
    mesh.frustumCulled = false;
    (mesh as Mesh).material = new MeshLambertMaterial({ vertexColors: true });
    const nodes = nodeNames.map((node) => this.node(`${name}/${node}`));
    const positions = new Float64Array(3 * numNodes);
    return { nodes, colour, perCapsule: Math.ceil(count / kCapsules), positions };
  }

  private node(name: string): Object3D {
    const node = this.nodes.get(name);
    if (!node) throw new Error(`the scene has no node "${name}"`);
    return node;
  }

  // Poses both figures at `time` (s), clamped to the clip.
  pose(time: number): void {
    const action = this.mixer.existingAction(this.clip)!;
    action.time = Math.min(Math.max(time, 0), this.duration);
    this.mixer.update(0);
    this.scene.updateMatrixWorld();
    const at = new Vector3();
    for (const name of figureNames) {
      const { nodes, positions } = this.figures[name];
      nodes.forEach((node, k) =>
        at.setFromMatrixPosition(node.matrixWorld).toArray(positions, 3 * k),
      );
    }
  }

  // World positions of a figure's nodes as posed last. [3 x nodes] (m)
  positions(figure: FigureName): Float64Array {
    return this.figures[figure].positions;
  }

  nodePosition(name: string): [number, number, number] {
    return new Vector3().setFromMatrixPosition(this.node(name).matrixWorld).toArray();
  }

  point(figure: FigureName, node: number): Vector3 {
    return new Vector3().fromArray(this.figures[figure].positions, 3 * node);
  }

  // One colour per segment; the nose goes with the head. [segments]
  paint(figure: FigureName, colours: Rgb[]): void {
    const { colour, perCapsule } = this.figures[figure];
    const data = colour.array as Float32Array;
    const linear = new Color();
    for (let s = 0; s < kCapsules; ++s) {
      linear.setRGB(...colours[s < numSegments ? s : kHeadSegment], SRGBColorSpace);
      const end = Math.min(data.length, 3 * perCapsule * (s + 1));
      for (let k = 3 * perCapsule * s; k < end; k += 3) linear.toArray(data, k);
    }
    colour.needsUpdate = true;
  }

  shadowColour(css: string): void {
    this.shadow.color.set(css);
  }

  // Where the pair is on the floor at each key, the mean of both roots over about a second, for a
  // camera that follows without bobbing. [keys] of [x, z]
  path(): [number, number][] {
    const tracks = this.clip.tracks.filter((track) => track.name.endsWith(".position"));
    const keys = tracks[0].times.length;
    const mean = (k: number, axis: number) =>
      tracks.reduce((sum, track) => sum + track.values[3 * k + axis], 0) / tracks.length;
    const half = Math.min(15, keys >> 1);
    return Array.from({ length: keys }, (_, k) => {
      const [from, to] = [Math.max(0, k - half), Math.min(keys - 1, k + half)];
      let [x, z] = [0, 0];
      for (let j = from; j <= to; ++j) {
        x += mean(j, 0) / (to - from + 1);
        z += mean(j, 2) / (to - from + 1);
      }
      return [x, z];
    });
  }
}
