// Three numbers in a row that ask for an operation; dragged by a label they are one gesture.

import { element } from "../../shared/dom";
import { newGesture } from "../stage/gizmo";
import type { GestureOp, Vec } from "../state/protocol";
import type { Sender } from "../state/sender";
import { number, type NumberField } from "../controls/widgets";

export interface VectorOptions {
  label: string;
  title: string; // with the unit
  unit: string;
  step: number;
  digits: number;
  scrub: boolean; // whether labels can be dragged: the operation takes a gesture
  op: (axis: number, value: number) => GestureOp | null;
}

export class VectorFields {
  readonly element: HTMLElement;
  private readonly fields: NumberField[];
  private gesture = 0;

  constructor(
    private readonly sender: Sender,
    private readonly options: VectorOptions,
  ) {
    const { label, unit } = options;
    this.fields = ["X", "Y", "Z"].map((name, axis) => this.field(name, axis));
    this.element = element(
      "div",
      { class: "triple" },
      element("span", {}, `${label} `, element("small", {}, unit)),
      ...this.fields.map((field) => field.element),
    );
  }

  set(values: Vec): void {
    this.fields.forEach((field, axis) => field.set(values[axis]));
  }
  warn(on: boolean): void {
    for (const field of this.fields) field.warn(on);
  }

  private field(name: string, axis: number): NumberField {
    const { title, unit, step, digits, scrub, op } = this.options;
    let last = 0;
    const send = (made: GestureOp | null) => {
      if (made) void this.sender.do(made);
    };
    const live = (value: number) => {
      last = value;
      this.gesture ||= newGesture();
      const made = op(axis, value);
      if (made) this.sender.drag({ ...made, gesture: this.gesture });
    };
    const release = () => {
      const made = op(axis, last);
      send(made && { ...made, gesture: this.gesture });
      this.gesture = 0;
    };
    return number({
      label: name,
      title: `${name}: ${title}`,
      unit,
      step,
      digits,
      commit: (value) => send(op(axis, value)),
      ...(scrub ? { live, release } : {}),
    });
  }
}
