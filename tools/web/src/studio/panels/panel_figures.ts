// Panel "Figures": the selected joint, the figure it belongs to, and the solver's options.

import { element } from "../../shared/dom";
import { figureNames, type FigureName, type PerFigure } from "../../shared/names";
import type { Actions } from "../editing/actions";
import { JointSection } from "./joint_section";
import { statureRange } from "../state/measures";
import { optionNames, type GestureOp, type OptionName, type Vec } from "../state/protocol";
import type { Sender } from "../state/sender";
import type { Shown, Store } from "../state/store";
import { VectorFields } from "./vector_fields";
import { button, check, number, row, section, select, type NumberField } from "../controls/widgets";

const kOptions: Record<OptionName, [string, string]> = {
  holds: ["Holds", "held points stay together while you drag"],
  limits: ["Joint limits", "joints stay within their limits"],
  penetration: ["Bodies stay apart", "limbs do not go into one another"],
  floor: ["Floor", "nothing goes below the floor"],
  feet: ["Feet stay", "supports that stand stay where they are"],
  root: ["Roots may move", "off: the trunks stay, only limbs follow"],
  tangles: ["Keep tangles", "tags keep their |GLI| over 0.5 while you drag"],
};

export class FiguresPanel {
  readonly element = element("div", { class: "panel" });
  private readonly joint: JointSection;
  private readonly tabs: PerFigure<HTMLButtonElement>;
  private readonly stature: NumberField;
  private readonly rootPlace: VectorFields;
  private readonly rootTurn: VectorFields;
  private readonly leader: ReturnType<typeof select>;
  private readonly shown: ReturnType<typeof select>;
  private readonly options = {} as Record<OptionName, ReturnType<typeof check>>;

  constructor(
    private readonly store: Store,
    private readonly actions: Actions,
    sender: Sender,
    startFrom: () => void,
  ) {
    const figure = () => store.ui.figure;
    this.joint = new JointSection(store, actions, sender);
    this.tabs = { a: this.tab("a"), b: this.tab("b") };
    this.stature = number({
      label: "Stature",
      title: "stature of the figure (m)",
      ...statureRange,
      commit: (v) => void actions.do({ op: "set_stature", figure: figure(), stature: v }),
    });
    this.rootPlace = new VectorFields(sender, {
      label: "Root",
      unit: "m",
      step: 0.01,
      digits: 3,
      scrub: true,
      title: "position of the figure's root in the world (m)",
      op: (axis, v) => this.rootOp(axis, v, "position"),
    });
    this.rootTurn = new VectorFields(sender, {
      label: "Turn",
      unit: "°",
      step: 1,
      digits: 1,
      scrub: true,
      title: "rotation of the figure's root, component of the rotation vector (degrees)",
      op: (axis, v) => this.rootOp(axis, v, "rotation_vector"),
    });
    const leaders: [string, string][] = [
      ["world", "follows its own clip"],
      ["partner", "is carried by its partner"],
    ];
    this.leader = select(
      "whose motion leads the figure in a solve",
      leaders,
      (leader) =>
        void actions.do({
          op: "set_root_leader",
          figure: figure(),
          leader: leader === "partner" ? "partner" : "world",
        }),
    );
    const ways: [string, string][] = [
      ["shown", "shown"],
      ["ghost", "ghost"],
      ["hidden", "hidden"],
    ];
    this.shown = select("how the figure is shown (I isolates, G ghosts the other)", ways, (v) =>
      store.set({ shown: { ...store.ui.shown, [figure()]: v as Shown } }),
    );
    for (const name of optionNames) {
      this.options[name] = check(...kOptions[name], (on) => actions.option(name, on));
    }
    this.element.append(
      this.joint.element,
      this.figureSection(),
      this.bothSection(startFrom),
      this.solverSection(),
    );
    store.onChange(() => this.refresh());
  }

  private tab(figure: FigureName): HTMLButtonElement {
    return button(
      `Figure ${figure}`,
      `figure ${figure}`,
      () => {
        const { selected } = this.store.ui;
        if (selected && selected.figure !== figure) this.store.select({ ...selected, figure });
        else this.store.set({ figure });
      },
      `figure-${figure}`,
    );
  }

  private figureSection(): HTMLElement {
    const { actions } = this;
    const figure = () => this.store.ui.figure;
    return section(
      "Figure",
      element(
        "div",
        { class: "segmented", role: "group", "aria-label": "figure" },
        this.tabs.a,
        this.tabs.b,
      ),
      row(this.stature.element, this.shown.element),
      this.rootPlace.element,
      this.rootTurn.element,
      element("label", { class: "field inline" }, "Motion", this.leader.element),
      row(
        button("Mirror", "left and right of this figure change places (M)", () =>
          actions.mirror(figure()),
        ),
        button("L → R", "copy the left side's joints onto the right", () =>
          actions.copySide(figure(), "left"),
        ),
        button("R → L", "copy the right side's joints onto the left", () =>
          actions.copySide(figure(), "right"),
        ),
        button("Reset", "the whole figure in its T-pose, upright on the floor", () =>
          actions.resetFigure(figure()),
        ),
      ),
    );
  }

  private bothSection(startFrom: () => void): HTMLElement {
    return section(
      "Both",
      row(
        button("Start from…", "rest, a template, or a frame of the clips (N)", startFrom),
        button("Swap a, b", "a becomes b and b becomes a", () => this.actions.swap()),
        button(
          "Mirror scene",
          "the whole scene through x = 0; every GLI changes its sign (Shift+M)",
          () => this.actions.mirror("both"),
        ),
      ),
    );
  }

  private solverSection(): HTMLElement {
    const labels = optionNames.map((name) => this.options[name].label);
    return section(
      "Solver",
      element("div", { class: "options" }, ...labels),
      row(
        button("Settle", "close holds, restore limits and distances without a drag (S)", () =>
          this.actions.settle(),
        ),
      ),
    );
  }

  private rootOp(axis: number, value: number, which: "position" | "rotation_vector"): GestureOp {
    const { figure } = this.store.ui;
    const { position, rotation_vector } = this.store.state.figures[figure].root;
    const root: { position: Vec; rotation_vector: Vec } = {
      position: [...position],
      rotation_vector: [...rotation_vector],
    };
    root[which][axis] = value;
    return { op: "set_root", figure, ...root };
  }

  private refresh(): void {
    const { ui, state, body } = this.store;
    const { figure } = ui;
    this.joint.refresh();
    for (const f of figureNames) this.tabs[f].setAttribute("aria-pressed", String(f === figure));
    this.stature.set(body[figure].stature);
    const { root } = state.figures[figure];
    this.rootPlace.set(root.position);
    this.rootTurn.set(root.rotation_vector);
    this.leader.set(state.root[figure]);
    this.shown.set(ui.shown[figure]);
    for (const name of optionNames) this.options[name].set(state.options[name]);
  }
}
