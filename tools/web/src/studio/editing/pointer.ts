// What the mouse, a pen or a finger does on the views: hover, select, drag by the solver, connect.

import { Plane, Vector3 } from "three";
import { newGesture, type Gizmo } from "../stage/gizmo";
import { pickNode } from "../stage/picking";
import type { Actions } from "./actions";
import type { Op, Vec } from "../state/protocol";
import type { Sender } from "../state/sender";
import type { Pick, Store } from "../state/store";
import type { View } from "../stage/view";
import type { Viewport } from "../stage/viewport";

const kClick = 3; // px; less than this is a click, not a drag

interface Press {
  view: View;
  pick: Pick | null;
  pointer: number;
  x: number;
  y: number;
  moved: boolean;
  gesture: number;
  offset: Vector3; // of the node from the point of its plane that was grabbed
  start: Vector3; // of the node
  op: Op | null;
}

export class Pointer {
  private press: Press | null = null;

  constructor(
    viewport: Viewport,
    private readonly store: Store,
    private readonly sender: Sender,
    private readonly gizmo: Gizmo,
    private readonly actions: Actions,
  ) {
    for (const view of viewport.views) {
      const { element } = view;
      element.addEventListener("pointerdown", (event) => this.down(event, view), { capture: true });
      element.addEventListener("pointermove", (event) => this.move(event), { capture: true });
      // After the gizmo, which knows by then whether it is meant.
      element.addEventListener("pointermove", (event) => this.hover(event, view));
      element.addEventListener("pointerup", (event) => this.up(event));
      element.addEventListener("pointercancel", () => this.cancel());
      element.addEventListener("pointerleave", () => {
        if (!this.press && this.store.ui.hovered) this.store.set({ hovered: null });
      });
      element.addEventListener("contextmenu", (event) => event.preventDefault());
    }
  }

  private down(event: PointerEvent, view: View): void {
    (document.activeElement as HTMLElement | null)?.blur?.();
    if (event.button !== 0 || this.gizmo.dragging) return;
    if (view.name === "main" && this.gizmo.hovered) return;
    const pick = pickNode(this.store, view, event.clientX, event.clientY);
    this.press = {
      view,
      pick,
      pointer: event.pointerId,
      x: event.clientX,
      y: event.clientY,
      moved: false,
      gesture: 0,
      offset: new Vector3(),
      start: new Vector3(),
      op: null,
    };
    const { tool } = this.store.ui;
    if (tool === "photo-move" && view.name === "main") {
      this.hold(event, view);
      return;
    }
    if (!pick) return;
    this.hold(event, view);
    if (tool !== "hold") this.store.select(pick);
    this.press.start.set(...this.store.place(pick));
    const at = this.onPlane(view, this.press.start, event);
    if (at) this.press.offset.copy(this.press.start).sub(at);
  }

  // Neither the camera nor the gizmo sees this press.
  private hold(event: PointerEvent, view: View): void {
    event.stopImmediatePropagation();
    event.preventDefault();
    view.element.setPointerCapture(event.pointerId);
  }

  // Where the line of sight meets the plane through `point` that faces the camera.
  private onPlane(view: View, point: Vector3, event: PointerEvent): Vector3 | null {
    const plane = new Plane().setFromNormalAndCoplanarPoint(view.towardsViewer(), point);
    return view.ray(event.clientX, event.clientY).intersectPlane(plane, new Vector3());
  }

  private hover(event: PointerEvent, view: View): void {
    if (this.press || event.buttons !== 0 || this.gizmo.dragging) return;
    const { store } = this;
    const over = view.name === "main" && this.gizmo.hovered;
    const hovered = over ? null : pickNode(store, view, event.clientX, event.clientY);
    const old = store.ui.hovered;
    if (hovered?.figure !== old?.figure || hovered?.node !== old?.node) store.set({ hovered });
    view.element.classList.toggle("grab", hovered !== null);
  }

  private move(event: PointerEvent): void {
    const { press, store } = this;
    if (!press || event.pointerId !== press.pointer) return;
    if (Math.hypot(event.clientX - press.x, event.clientY - press.y) > kClick) press.moved = true;
    if (!press.moved) return;
    if (store.ui.tool === "photo-move" && !press.pick) {
      this.actions.shiftPhoto(event.movementX, event.movementY, false);
      return;
    }
    if (press.pick) this.drag(press, event);
  }

  private drag(press: Press, event: PointerEvent): void {
    const { store } = this;
    const { tool } = store.ui;
    if (tool !== "pose" && tool !== "photo-pin" && tool !== "pin") return;
    event.stopImmediatePropagation();
    press.gesture ||= newGesture();
    const { figure } = press.pick!;
    const node = store.nodeName(press.pick!);
    if ((tool === "photo-pin" || event.altKey) && press.view.name === "main") {
      const ray = press.view.ray(event.clientX, event.clientY);
      const [origin, direction] = [ray.origin.toArray(), ray.direction.toArray()];
      press.op = { op: "drag_ray", figure, node, origin, direction, gesture: press.gesture };
      store.set({
        dragging: true,
        dragTarget: this.onPlane(press.view, press.start, event)?.toArray() as Vec,
      });
    } else {
      const target = this.targetOf(press, event);
      if (!target) return;
      press.op = { op: "drag", figure, node, target: target.toArray(), gesture: press.gesture };
      store.set({ dragging: true, dragTarget: target.toArray() as Vec });
    }
    this.sender.drag(press.op);
  }

  // In the plane of the picture; with Shift towards the viewer and away, by the way down and up.
  private targetOf(press: Press, event: PointerEvent): Vector3 | null {
    if (event.shiftKey) {
      const step = press.view.metresPerPixel(press.start) * (event.clientY - press.y);
      return press.start.clone().addScaledVector(press.view.towardsViewer(), step);
    }
    return this.onPlane(press.view, press.start, event)?.add(press.offset) ?? null;
  }

  private up(event: PointerEvent): void {
    const { press, store } = this;
    if (!press || event.pointerId !== press.pointer) return;
    this.press = null;
    store.set({ dragging: false, dragTarget: null });
    if (press.op) {
      const ops = [press.op];
      if (press.op.op === "drag_ray" && store.ui.tool === "photo-pin") {
        const { figure, node, origin, direction } = press.op;
        ops.push({ op: "pin", figure, node, ray: { origin, direction } });
      }
      void this.sender.do(...ops);
    } else if (press.moved) {
      if (store.ui.tool === "photo-move") this.actions.shiftPhoto(0, 0, true);
    } else {
      this.click(press, event);
    }
  }

  private click(press: Press, event: PointerEvent): void {
    const { tool } = this.store.ui;
    if (tool === "hold") {
      if (press.pick) this.actions.pickForHold(press.pick);
      else this.actions.holdToWorld(this.floorPoint(press.view, event));
    } else if (tool === "pin" && press.pick) {
      this.actions.togglePin(press.pick);
    } else if (!press.pick) {
      this.store.select(null);
    }
  }

  private floorPoint(view: View, event: PointerEvent): Vec | null {
    const floor = new Plane(new Vector3(0, 1, 0), 0);
    const at = view.ray(event.clientX, event.clientY).intersectPlane(floor, new Vector3());
    return at ? (at.toArray() as Vec) : null;
  }

  // Escape: the drag is taken back. True where there was one.
  cancel(): boolean {
    const { press } = this;
    this.press = null;
    this.store.set({ dragging: false, dragTarget: null });
    if (!press?.op) return false;
    void this.sender.do(press.op).then(() => this.actions.undo());
    return true;
  }
}
