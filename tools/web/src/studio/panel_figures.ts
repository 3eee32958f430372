// Panel "Figures": the selected joint, the figure it belongs to, and the solver's options.

import { element } from "../shared/dom";
import { figureNames, type FigureName } from "../shared/figure_scene";
import type { Actions } from "./actions";
import { newGesture } from "./gizmo";
import { readLimits } from "./limits";
import { optionNames, type Op, type OptionName, type Vec } from "./protocol";
import type { Sender } from "./sender";
import type { Shown, Store } from "./store";
import { button, check, list, note, number, row, section, select, type NumberField } from "./widgets";
import { degrees, nodeOf, words } from "./words";

const kOptions: Record<OptionName, [string, string]> = {
  holds: ["Holds", "held points stay together while you drag"],
  limits: ["Joint limits", "joints stay within their limits"],
  penetration: ["Bodies stay apart", "limbs do not go into one another"],
  floor: ["Floor", "nothing goes below the floor"],
  feet: ["Feet stay", "supports that stand stay where they are"],
  root: ["Roots may move", "off: the trunks stay, only limbs follow"],
  tangles: ["Keep tangles", "tags keep their |GLI| over 0.5 while you drag"],
};
const kAxes = ["X", "Y", "Z"];

export class FiguresPanel {
  readonly element = element("div", { class: "panel" });
  private readonly jointTitle = element("h3", {});
  private readonly joint: ReturnType<typeof select>;
  private readonly place: NumberField[];
  private readonly turn: NumberField[];
  private readonly limits = element("ul", { class: "limits" });
  private readonly pin: HTMLButtonElement;
  private readonly jointPart: HTMLElement;
  private readonly noJoint = note("Click a joint to select it. Drag it and the whole figure follows.");
  private readonly tabs: Record<FigureName, HTMLButtonElement>;
  private readonly stature: NumberField;
  private readonly rootPlace: NumberField[];
  private readonly rootTurn: NumberField[];
  private readonly leader: ReturnType<typeof select>;
  private readonly shown: ReturnType<typeof select>;
  private readonly options = {} as Record<OptionName, ReturnType<typeof check>>;
  private gesture = 0;

  constructor(
    private readonly store: Store, actions: Actions, private readonly sender: Sender,
    startFrom: () => void,
  ) {
    const figure = () => store.ui.figure;
    this.joint = select("the joint that is turned", [], (v) => store.set({ joint: Number(v) }));
    this.place = this.fields("position of the selected joint in the world (m); the solver brings it there", "m", 0.01, 3,
      (axis, value) => this.dragJoint(axis, value));
    this.turn = this.fields("rotation of the joint in its parent, component of the rotation vector (degrees)", "°", 1, 1,
      (axis, value) => this.jointOp(axis, value), true);
    this.pin = button("Pin", "pin the joint where it is, or free it (P)", () => actions.togglePin(store.ui.selected));
    this.jointPart = element("div", { class: "stack" }, row(this.jointTitle, this.joint.element),
      this.triple("Position", "m", this.place), this.triple("Rotation", "°", this.turn), this.limits,
      row(this.pin, button("Reset", "the joint as in the T-pose (Backspace)", () => actions.resetJoint())));

    this.tabs = { a: this.tab("a"), b: this.tab("b") };
    this.stature = number({ label: "Stature", title: "stature of the figure (m)", unit: "m", step: 0.01, digits: 2, min: 0.5, max: 3,
      commit: (v) => void actions.do({ op: "set_stature", figure: figure(), stature: v }) });
    this.rootPlace = this.fields("position of the figure's root in the world (m)", "m", 0.01, 3, (axis, v) => this.rootOp(axis, v, "position"), true);
    this.rootTurn = this.fields("rotation of the figure's root, component of the rotation vector (degrees)", "°", 1, 1,
      (axis, v) => this.rootOp(axis, v, "rotation_vector"), true);
    this.leader = select("whose motion leads the figure in a solve", [["world", "follows its own clip"], ["partner", "is carried by its partner"]],
      (leader) => void actions.do({ op: "set_root_leader", figure: figure(), leader }));
    this.shown = select("how the figure is shown (I isolates, G ghosts the other)", [["shown", "shown"], ["ghost", "ghost"], ["hidden", "hidden"]],
      (v) => store.set({ shown: { ...store.ui.shown, [figure()]: v as Shown } }));
    for (const name of optionNames) {
      this.options[name] = check(kOptions[name][0], kOptions[name][1], (on) => actions.option(name, on));
    }
    this.element.append(
      section("Joint", this.noJoint, this.jointPart),
      section("Figure", element("div", { class: "segmented", role: "group", "aria-label": "figure" }, this.tabs.a, this.tabs.b),
        row(this.stature.element, this.shown.element), this.triple("Root", "m", this.rootPlace), this.triple("Turn", "°", this.rootTurn),
        element("label", { class: "field inline" }, "Motion", this.leader.element),
        row(button("Mirror", "left and right of this figure change places (M)", () => actions.mirror(figure())),
          button("L → R", "copy the left side's joints onto the right", () => actions.copySide(figure(), "left")),
          button("R → L", "copy the right side's joints onto the left", () => actions.copySide(figure(), "right")),
          button("Reset", "the whole figure in its T-pose, upright on the floor", () => actions.resetFigure(figure())))),
      section("Both", row(button("Start from…", "rest, a template, or a frame of the clips (N)", startFrom),
        button("Swap a, b", "a becomes b and b becomes a", () => actions.swap()),
        button("Mirror scene", "the whole scene through x = 0; every GLI changes its sign (Shift+M)", () => actions.mirror("both")))),
      section("Solver", element("div", { class: "options" }, ...optionNames.map((name) => this.options[name].label)),
        row(button("Settle", "close holds, restore limits and distances without a drag (S)", () => actions.settle()))),
    );
    store.onChange(() => this.refresh());
  }

  private tab(figure: FigureName): HTMLButtonElement {
    return button(`Figure ${figure}`, `figure ${figure}`, () => {
      const { selected } = this.store.ui;
      if (selected && selected.figure !== figure) this.store.select({ ...selected, figure });
      else this.store.set({ figure });
    }, `figure-${figure}`);
  }

  private fields(
    title: string, unit: string, step: number, digits: number,
    commit: (axis: number, value: number) => Op | null, scrub = false,
  ): NumberField[] {
    return kAxes.map((label, axis) => {
      const live = (value: number) => {
        this.gesture ||= newGesture();
        const op = commit(axis, value);
        if (op) this.sender.drag({ ...op, gesture: this.gesture });
      };
      let last = 0;
      return number({
        label, title: `${label}: ${title}`, unit, step, digits,
        commit: (value) => void this.finish(commit(axis, value)),
        ...(scrub ? {
          live: (value: number) => live((last = value)),
          release: () => {
            const op = commit(axis, last);
            void this.finish(op && { ...op, gesture: this.gesture });
            this.gesture = 0;
          },
        } : {}),
      });
    });
  }
  private async finish(op: Op | null): Promise<void> {
    if (op) await this.sender.do(op);
  }
  private triple(name: string, unit: string, fields: NumberField[]): HTMLElement {
    return element("div", { class: "triple" }, element("span", {}, `${name} `, element("small", {}, unit)), ...fields.map((f) => f.element));
  }

  private dragJoint(axis: number, value: number): Op | null {
    const { selected } = this.store.ui;
    if (!selected) return null;
    const target = [...this.store.place(selected)] as Vec;
    target[axis] = value;
    return { op: "drag", figure: selected.figure, node: this.store.nodeName(selected), target };
  }
  private jointOp(axis: number, value: number): Op | null {
    const { figure, joint } = this.store.ui;
    const vector = [...this.store.state.figures[figure].rotation_vectors[joint]] as Vec;
    vector[axis] = value;
    if (joint === 0) return this.rootOp(axis, value, "rotation_vector");
    return { op: "set_joint", figure, joint: this.store.body[figure].links[joint].name, rotation_vector: vector };
  }
  private rootOp(axis: number, value: number, which: "position" | "rotation_vector"): Op {
    const { figure } = this.store.ui;
    const { position, rotation_vector } = this.store.state.figures[figure].root;
    const root = { position: [...position], rotation_vector: [...rotation_vector] };
    root[which][axis] = value;
    return { op: "set_root", figure, ...root };
  }

  private refresh(): void {
    const { ui, state, body } = this.store;
    this.jointPart.hidden = !ui.selected;
    this.noJoint.hidden = ui.selected !== null;
    if (ui.selected) this.refreshJoint();
    const { figure } = ui;
    for (const f of figureNames) this.tabs[f].setAttribute("aria-pressed", String(f === figure));
    this.stature.set(body[figure].stature);
    const { root } = state.figures[figure];
    this.rootPlace.forEach((field, k) => field.set(root.position[k]));
    this.rootTurn.forEach((field, k) => field.set(root.rotation_vector[k]));
    this.leader.set(state.root[figure]);
    this.shown.set(ui.shown[figure]);
    for (const name of optionNames) this.options[name].set(state.options[name]);
  }

  private refreshJoint(): void {
    const { ui, state, body } = this.store;
    const selected = ui.selected!;
    const { figure } = selected;
    this.jointTitle.textContent = nodeOf(figure, this.store.nodeName(selected));
    this.jointTitle.className = `figure-${figure}`;
    const links = body[figure].links;
    this.joint.set(String(ui.joint), links.map(({ name }, k) => [String(k), `turns: ${words(name)}`]));
    this.place.forEach((field, k) => field.set(this.store.place(selected)[k]));
    const vector = state.figures[figure].rotation_vectors[ui.joint] ?? [0, 0, 0];
    const readings = ui.joint > 0 ? readLimits(links[ui.joint].limits, vector) : [];
    this.turn.forEach((field, k) => {
      field.set(ui.joint === 0 ? state.figures[figure].root.rotation_vector[k] : vector[k]);
      field.warn(readings.some((r) => r.beyond));
    });
    list(this.limits, readings, (r) => [r.name, Math.round(r.value), r.beyond], (r) => element("li", { class: r.beyond ? "beyond" : "" },
      element("span", {}, r.name), element("b", {}, degrees(r.value)),
      element("small", {}, `limit ${r.min === 0 ? "" : `${degrees(r.min)} to `}${degrees(r.max)}`)));
    this.pin.textContent = this.store.pinOf(selected) >= 0 ? "Unpin" : "Pin";
  }
}
