// What can be done from a key, a button or a click alike.

import { Quaternion, Vector3 } from "three";
import { figureNames, type FigureName } from "../../shared/names";
import { stands } from "../state/measures";
import type { HoldEnd, Op, OptionName, Photo, Tangle, Vec } from "../state/protocol";
import type { Sender } from "../state/sender";
import type { Pick, Store, Tool } from "../state/store";
import type { Direction } from "../stage/view";
import type { Viewport } from "../stage/viewport";
import { endOf, nodeOf } from "../state/words";

const kTouching = 0.02; // m between skins; nodes further apart are drawn together by a hold

export class Actions {
  private photoPreview: Photo | null = null; // while a slider or the mouse moves it

  constructor(
    private readonly store: Store,
    private readonly sender: Sender,
    readonly viewport: Viewport,
  ) {}

  do(...ops: Op[]): Promise<boolean> {
    return this.sender.do(...ops);
  }
  undo(): void {
    if (this.store.state.can_undo) this.inHistory("undo");
  }
  redo(): void {
    if (this.store.state.can_redo) this.inHistory("redo");
  }
  private inHistory(op: "undo" | "redo"): void {
    ++this.store.photoVersion; // another picture may come back
    void this.do({ op });
  }
  settle(): void {
    void this.do({ op: "settle" });
  }

  tool(tool: Tool): void {
    const { ui } = this.store;
    if (tool === "move" && ui.tool === "move") return this.store.set({ turning: !ui.turning });
    this.store.set({ tool, holdFrom: null, holdEdited: null, turning: false });
    const said: Partial<Record<Tool, string>> = {
      hold: "Connect: click a joint, then the joint that it holds, or the floor.",
      pin: "Pin: click joints to pin them where they are, or to free them. Dragging still poses.",
      "photo-pin":
        "Pin to the photo: drag a joint to its point in it. The depth is left to the solver.",
      "photo-move": "Move the photo: drag in the main view.",
      rotate: ui.selected ? "" : "Rotate: click a joint.",
    };
    this.store.say(said[tool] ?? "");
  }

  // -- Pins and holds ----------------------------------------------------------------------------

  togglePin(pick: Pick | null): void {
    if (!pick) return this.store.say("Select a joint to pin it.");
    const node = this.store.nodeName(pick);
    const pinned = this.store.pinOf(pick) >= 0;
    void this.do({ op: pinned ? "unpin" : "pin", figure: pick.figure, node });
  }
  clearPins(): void {
    const ops = this.store.state.pins.map(({ figure, node }): Op => ({
      op: "unpin",
      figure,
      node,
    }));
    if (ops.length > 0) void this.do(...ops);
  }

  pickForHold(pick: Pick): void {
    const { ui } = this.store;
    const from = ui.holdFrom;
    if (!from) {
      this.store.set({ holdFrom: pick });
      this.store.say(
        `${nodeOf(pick.figure, this.store.nodeName(pick))}: now click what it holds, or the floor.`,
      );
      return;
    }
    if (from.figure === pick.figure && from.node === pick.node) {
      this.store.set({ holdFrom: null });
      return;
    }
    this.connect(from, {
      figure: pick.figure,
      node: this.store.nodeName(pick),
      ...this.offsetOf(from, pick),
    });
  }

  holdToWorld(place: Vec | null): void {
    const from = this.store.ui.holdFrom;
    if (!from || !place) return;
    const { radius_m } = this.store.body[from.figure].nodes[from.node];
    const stays = stands(this.store.place(from)); // held to the floor where it is
    const offset: Vec = [place[0], radius_m, place[2]];
    this.connect(from, stays ? { figure: "world" } : { figure: "world", offset });
  }

  // The point of `to` where the skins touch, on the side of `from`, in the frame of its link; none
  // where they touch already.
  private offsetOf(from: Pick, to: Pick): { offset?: Vec } {
    const { store } = this;
    const [a, b] = [from, to].map((pick) => new Vector3(...store.place(pick)));
    const node = store.body[to.figure].nodes[to.node];
    const apart = store.body[from.figure].nodes[from.node].radius_m + node.radius_m;
    const way = a.sub(b);
    if (way.length() < apart + kTouching) return {};
    const frame = new Quaternion(...store.state.figures[to.figure].frames[node.link]);
    return { offset: way.setLength(apart).applyQuaternion(frame.invert()).toArray() as Vec };
  }

  private connect(from: Pick, to: HoldEnd): void {
    const { holdEdited } = this.store.ui;
    const hold = {
      from: { figure: from.figure, node: this.store.nodeName(from) },
      to,
      rotation: false,
    };
    const op: Op =
      holdEdited === null
        ? { op: "add_hold", ...hold }
        : { op: "edit_hold", index: holdEdited, ...hold };
    this.store.set({ tool: "pose", holdFrom: null, holdEdited: null, panel: "holds" });
    const ops: Op[] = to.offset ? [op, { op: "settle" }] : [op];
    void this.do(...ops).then((done) => {
      if (done) this.store.say(`${endOf(hold.from)} holds ${endOf(to)}.`, "good");
    });
  }

  // -- Figures -----------------------------------------------------------------------------------

  mirror(figure: FigureName | "both"): void {
    void this.do({ op: "mirror", figure });
  }
  swap(): void {
    void this.do({ op: "swap_figures" });
  }
  copySide(figure: FigureName, from: "left" | "right"): void {
    void this.do({ op: "copy_side", figure, from });
  }
  resetFigure(figure: FigureName): void {
    void this.do({ op: "reset_figure", figure });
  }
  resetJoint(): void {
    const { figure, joint, selected } = this.store.ui;
    if (!selected) return this.store.say("Select a joint to reset it.");
    if (joint === 0) return this.store.say("The root has no rest: it is where the figure stands.");
    void this.do({ op: "reset_joint", figure, joint: this.store.body[figure].links[joint].name });
  }
  option(option: OptionName, on: boolean): Promise<boolean> {
    return this.do({ op: "set_option", option, on });
  }
  tangles(tangles: Tangle[]): Promise<boolean> {
    return this.do({ op: "set_tangles", tangles });
  }

  // Moves the selected joint in the picture's plane by metres; the solver follows.
  nudge(right: number, up: number): void {
    const { selected } = this.store.ui;
    if (!selected) return;
    const { camera } = this.viewport.main;
    const [x, y] = [0, 1].map((k) => new Vector3().setFromMatrixColumn(camera.matrixWorld, k));
    const target = new Vector3(...this.store.place(selected))
      .addScaledVector(x, right)
      .addScaledVector(y, up);
    this.dragTo(selected, target.toArray() as Vec);
  }
  dragTo(pick: Pick, target: Vec): void {
    void this.do({ op: "drag", figure: pick.figure, node: this.store.nodeName(pick), target });
  }

  // Steps through the joints of a figure.
  step(by: number): void {
    const { selected, figure } = this.store.ui;
    const count = this.store.body[figure].nodes.length;
    const node = selected ? (selected.node + by + count) % count : 0;
    this.store.select({ figure, node });
  }
  otherFigure(): void {
    const { selected, figure } = this.store.ui;
    const other = figure === "a" ? "b" : "a";
    if (selected) this.store.select({ ...selected, figure: other });
    else this.store.set({ figure: other, joint: 0 });
  }

  // The other figure goes, or comes back.
  isolate(as: "ghost" | "hidden"): void {
    const { shown, figure } = this.store.ui;
    const other = figure === "a" ? "b" : "a";
    this.store.set({
      shown: { ...shown, [figure]: "shown", [other]: shown[other] === as ? "shown" : as },
    });
  }

  // -- View --------------------------------------------------------------------------------------

  look(direction: Direction): void {
    if (this.store.ui.locked) return this.store.say("Photo and camera are locked (L).");
    const { main } = this.viewport;
    main.look(direction, undefined, main.camera.position.distanceTo(main.controls.target));
  }
  frame(selectionOnly: boolean): void {
    const { state, ui } = this.store;
    const points =
      selectionOnly && ui.selected
        ? [new Vector3(...this.store.place(ui.selected))]
        : figureNames
            .filter((f) => ui.shown[f] !== "hidden")
            .flatMap((f) => state.figures[f].nodes.map((p) => new Vector3(...p)));
    this.viewport.frameAll(points);
  }

  // As it is shown now.
  get photo(): Photo | null {
    return this.photoPreview ?? this.store.state.photo;
  }
  // `dx`, `dy` in CSS pixels of the main view; kept when `done`.
  shiftPhoto(dx: number, dy: number, done: boolean): void {
    const { ui } = this.store;
    const { photo } = this;
    if (!photo || ui.locked) return;
    const height = this.viewport.main.element.clientHeight;
    const offset: [number, number] = [photo.offset[0] + dx / height, photo.offset[1] - dy / height];
    this.setPhoto({ ...photo, offset }, done);
  }
  setPhoto(photo: Photo | null, done: boolean): void {
    this.photoPreview = done ? null : photo;
    if (done) void this.do({ op: "set_photo", photo });
    this.store.changed();
  }
}
