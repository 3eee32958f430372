// One view of the scene: the main one in perspective, or a side view to judge depth by.

import {
  MOUSE,
  OrthographicCamera,
  PerspectiveCamera,
  Raycaster,
  Vector2,
  Vector3,
  type Camera,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { element } from "../../shared/dom";
import type { Vec } from "../state/protocol";

export type ViewName = "main" | "front" | "side" | "top";
export const directions = {
  "three-quarter": [0.72, 0.3, 1],
  front: [0, 0, 1],
  back: [0, 0, -1],
  side: [1, 0, 0],
  "other side": [-1, 0, 0],
  top: [0, 1, 0],
} as const;
export type Direction = keyof typeof directions;
const kDistance = 4.75; // m
const kSideHeight = 2.3; // m that a side view shows

export class View {
  readonly element: HTMLElement;
  readonly camera: PerspectiveCamera | OrthographicCamera;
  readonly controls: OrbitControls;

  constructor(
    readonly name: ViewName,
    parent: HTMLElement,
    changed: () => void,
  ) {
    const label = name === "main" ? [] : [element("span", { class: "view-name" }, name)];
    this.element = element("div", { class: `view ${name}`, "data-view": name }, ...label);
    parent.append(this.element);
    this.camera =
      name === "main"
        ? new PerspectiveCamera(30, 1, 0.05, 60)
        : new OrthographicCamera(-1, 1, 1, -1, 0.05, 60);
    this.controls = new OrbitControls(this.camera, this.element);
    this.controls.mouseButtons = { LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.ROTATE, RIGHT: MOUSE.PAN };
    if (name !== "main") {
      this.controls.enableRotate = false;
      this.controls.mouseButtons = { LEFT: MOUSE.PAN, MIDDLE: MOUSE.PAN, RIGHT: MOUSE.PAN };
    }
    this.controls.minDistance = 0.3;
    this.controls.maxDistance = 20;
    this.look(name === "main" ? "three-quarter" : name, new Vector3(0, 0.88, 0));
    this.controls.addEventListener("change", changed);
  }

  look(direction: Direction, target = this.controls.target.clone(), distance = kDistance): void {
    const away = new Vector3(...directions[direction]).normalize();
    if (direction === "top") away.z = 1e-4; // up of the picture is away from the front
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(away, distance);
    this.controls.update();
  }

  // So that everything within `radius` of `centre` is seen.
  frame(centre: Vector3, radius: number): void {
    const away = this.camera.position.clone().sub(this.controls.target).normalize();
    if (this.camera instanceof PerspectiveCamera) {
      const half = (this.camera.fov * Math.PI) / 360;
      const narrow = Math.min(half, Math.atan(Math.tan(half) * this.camera.aspect));
      this.camera.position.copy(centre).addScaledVector(away, radius / Math.sin(narrow));
    } else {
      this.camera.position.copy(centre).addScaledVector(away, kDistance);
      const { width, height } = this.element.getBoundingClientRect();
      this.camera.zoom = (kSideHeight / (2 * radius)) * Math.min(1, width / Math.max(1, height));
    }
    this.controls.target.copy(centre);
    this.controls.update();
  }

  fit(width: number, height: number): void {
    const { camera } = this;
    if (camera instanceof PerspectiveCamera) {
      camera.aspect = width / height;
    } else {
      camera.top = kSideHeight / 2;
      camera.bottom = -camera.top;
      camera.right = (camera.top * width) / height;
      camera.left = -camera.right;
    }
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
  }

  // Where a point of the world is on the page (CSS px); null behind the camera.
  project(point: Vector3 | Vec): { x: number; y: number } | null {
    const p = (Array.isArray(point) ? new Vector3(...point) : point.clone()).project(
      this.camera as Camera,
    );
    if (p.z > 1 || p.z < -1) return null;
    const box = this.element.getBoundingClientRect();
    return { x: box.left + ((p.x + 1) / 2) * box.width, y: box.top + ((1 - p.y) / 2) * box.height };
  }

  // The line of sight through a point of the page.
  ray(x: number, y: number): Raycaster["ray"] {
    const box = this.element.getBoundingClientRect();
    const caster = new Raycaster();
    caster.setFromCamera(
      new Vector2((2 * (x - box.left)) / box.width - 1, 1 - (2 * (y - box.top)) / box.height),
      this.camera,
    );
    return caster.ray;
  }

  // From which side the camera looks, towards the viewer.
  towardsViewer(): Vector3 {
    return this.camera.getWorldDirection(new Vector3()).negate();
  }

  // Metres that a CSS pixel covers at `point`.
  metresPerPixel(point: Vector3): number {
    const height = this.element.clientHeight;
    if (this.camera instanceof OrthographicCamera) return kSideHeight / this.camera.zoom / height;
    const depth = -point.clone().applyMatrix4(this.camera.matrixWorldInverse).z;
    return (2 * depth * Math.tan((this.camera.fov * Math.PI) / 360)) / height;
  }
}
