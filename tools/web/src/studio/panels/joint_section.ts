// The selected joint: where it is, how it is turned, its limits.

import { element } from "../../shared/dom";
import { words } from "../../shared/names";
import type { Actions } from "../editing/actions";
import { readLimits } from "../state/limits";
import type { GestureOp, Vec } from "../state/protocol";
import type { Sender } from "../state/sender";
import type { Store } from "../state/store";
import { VectorFields } from "./vector_fields";
import { button, list, note, row, section, select } from "../controls/widgets";
import { degrees, nodeOf } from "../state/words";

export class JointSection {
  readonly element: HTMLElement;
  private readonly title = element("h3", {});
  private readonly joint: ReturnType<typeof select>;
  private readonly place: VectorFields;
  private readonly turn: VectorFields;
  private readonly limits = element("ul", { class: "limits" });
  private readonly pin: HTMLButtonElement;
  private readonly content: HTMLElement;
  private readonly none = note("Click a joint to select it. Drag it and the whole figure follows.");

  constructor(
    private readonly store: Store,
    actions: Actions,
    sender: Sender,
  ) {
    this.joint = select("the joint that is turned", [], (v) => store.set({ joint: Number(v) }));
    this.place = new VectorFields(sender, {
      label: "Position",
      unit: "m",
      step: 0.01,
      digits: 3,
      scrub: false,
      title: "position of the joint in the world (m); the solver brings it there",
      op: (axis, value) => this.dragOp(axis, value),
    });
    this.turn = new VectorFields(sender, {
      label: "Rotation",
      unit: "°",
      step: 1,
      digits: 1,
      scrub: true,
      title: "rotation of the joint in its parent, component of the rotation vector (degrees)",
      op: (axis, value) => this.turnOp(axis, value),
    });
    this.pin = button("Pin", "pin the joint where it is, or free it (P)", () =>
      actions.togglePin(store.ui.selected),
    );
    const reset = button("Reset", "the joint as in the T-pose (Backspace)", () =>
      actions.resetJoint(),
    );
    this.content = element(
      "div",
      { class: "stack" },
      row(this.title, this.joint.element),
      this.place.element,
      this.turn.element,
      this.limits,
      row(this.pin, reset),
    );
    this.element = section("Joint", this.none, this.content);
  }

  private dragOp(axis: number, value: number): GestureOp | null {
    const { selected } = this.store.ui;
    if (!selected) return null;
    const target = [...this.store.place(selected)] as Vec;
    target[axis] = value;
    return { op: "drag", figure: selected.figure, node: this.store.nodeName(selected), target };
  }

  private turnOp(axis: number, value: number): GestureOp {
    const { figure, joint } = this.store.ui;
    const { root, rotation_vectors } = this.store.state.figures[figure];
    const now = joint === 0 ? root.rotation_vector : rotation_vectors[joint];
    const rotation_vector: Vec = [...now];
    rotation_vector[axis] = value;
    if (joint === 0) return { op: "set_root", figure, position: root.position, rotation_vector };
    const { name } = this.store.body[figure].links[joint];
    return { op: "set_joint", figure, joint: name, rotation_vector };
  }

  refresh(): void {
    const { ui, state, body } = this.store;
    const { selected } = ui;
    this.content.hidden = !selected;
    this.none.hidden = selected !== null;
    if (!selected) return;
    const { figure } = selected;
    this.title.textContent = nodeOf(figure, this.store.nodeName(selected));
    this.title.className = `figure-${figure}`;
    const { links } = body[figure];
    this.joint.set(
      String(ui.joint),
      links.map(({ name }, k) => [String(k), `turns: ${words(name)}`]),
    );
    this.place.set(this.store.place(selected));
    const { root, rotation_vectors } = state.figures[figure];
    const vector = ui.joint === 0 ? root.rotation_vector : rotation_vectors[ui.joint];
    const { parent, limits } = links[ui.joint];
    const axis = parent > 0 ? links[parent].limits.axis : undefined;
    const before = axis && { axis, rotation_vector: rotation_vectors[parent] };
    const readings = ui.joint === 0 ? [] : readLimits(limits, vector, before);
    this.turn.set(vector);
    this.turn.warn(readings.some((r) => r.beyond));
    list(
      this.limits,
      readings,
      (r) => [r.name, Math.round(r.value), r.beyond],
      (r) => {
        const range = `limit ${r.min === 0 ? "" : `${degrees(r.min)} to `}${degrees(r.max)}`;
        return element(
          "li",
          { class: r.beyond ? "beyond" : "" },
          element("span", {}, r.name),
          element("b", {}, degrees(r.value)),
          element("small", {}, range),
        );
      },
    );
    this.pin.textContent = this.store.pinOf(selected) >= 0 ? "Unpin" : "Pin";
  }
}
