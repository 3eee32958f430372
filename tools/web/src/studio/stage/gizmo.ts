// The gizmo of the main view: turns one joint, or moves and turns a whole figure. What it asks for
// is absolute, so that the newest request of a gesture stands for all before it.

import { Object3D, Quaternion, Vector3 } from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";
import { rotationVectorOf } from "../state/limits";
import type { Op } from "../state/protocol";
import type { Sender } from "../state/sender";
import type { Store } from "../state/store";
import type { Viewport } from "./viewport";

// Not those of the page before a reload.
let lastGesture = Math.floor(Date.now() / 100) % 1_000_000_000;
export const newGesture = () => ++lastGesture;

export class Gizmo {
  private readonly controls: TransformControls;
  private readonly handle = new Object3D();
  private gesture = 0; // of the drag that is under way; 0: none
  private op: Op | null = null;

  constructor(
    private readonly viewport: Viewport,
    private readonly store: Store,
    private readonly sender: Sender,
  ) {
    const { main, scene } = viewport;
    this.controls = new TransformControls(main.camera, main.element);
    this.controls.setSize(0.8);
    scene.add(this.handle, this.controls.getHelper());
    viewport.showOnlyInMain(this.controls.getHelper());
    this.controls.addEventListener("change", () => viewport.invalidate());
    this.controls.addEventListener("dragging-changed", ({ value }) => this.grab(Boolean(value)));
    this.controls.addEventListener("objectChange", () => this.follow());
    store.onChange(() => this.refresh());
  }

  // Whether the pointer is over one of its rings or arrows.
  get hovered(): boolean {
    return this.controls.object !== undefined && this.controls.axis !== null;
  }
  get dragging(): boolean {
    return this.gesture !== 0;
  }

  refresh(): void {
    const { ui, state } = this.store;
    if (!state || this.gesture) return;
    const turns = ui.tool === "rotate" && ui.selected !== null;
    const moves = ui.tool === "move";
    const seen = ui.shown[ui.figure] === "shown";
    if (!(turns || moves) || !seen) {
      this.controls.detach();
      return;
    }
    const link = turns ? ui.joint : 0;
    this.handle.position.set(...this.store.jointCentre(ui.figure, link));
    this.handle.quaternion.fromArray(state.figures[ui.figure].frames[link]);
    this.handle.updateMatrixWorld();
    this.controls.setMode(turns || ui.turning ? "rotate" : "translate");
    this.controls.setSpace(ui.worldAxes || (moves && !ui.turning) ? "world" : "local");
    if (this.controls.object !== this.handle) this.controls.attach(this.handle);
  }

  private grab(on: boolean): void {
    this.viewport.main.controls.enabled = !on && !this.store.ui.locked;
    this.store.set({ dragging: on });
    if (on) {
      this.gesture = newGesture();
      this.op = null;
      return;
    }
    const op = this.op;
    this.gesture = 0;
    if (op) void this.sender.do(op).then(() => this.refresh());
  }

  private follow(): void {
    if (!this.gesture) return;
    const { ui, body, state } = this.store;
    const rotates = ui.tool === "rotate";
    const link = rotates ? ui.joint : 0;
    const { name, parent } = body[ui.figure].links[link];
    const world = this.handle.quaternion.clone();
    if (parent >= 0) {
      const local = new Quaternion(...state.figures[ui.figure].frames[parent])
        .invert()
        .multiply(world);
      this.op = {
        op: "set_joint",
        figure: ui.figure,
        joint: name,
        rotation_vector: rotationVectorOf(local),
      };
    } else {
      const position = rotates
        ? new Vector3(...state.figures[ui.figure].root.position)
        : this.handle.position;
      this.op = {
        op: "set_root",
        figure: ui.figure,
        position: position.toArray(),
        rotation_vector: rotationVectorOf(world),
      };
    }
    this.op.gesture = this.gesture;
    this.sender.drag(this.op);
  }
}
