// Controls that all panels are made of. Each says in its tooltip what it does and in which unit.

import { element } from "../../shared/dom";

type Child = Node | string;

export function button(label: Child, title: string, act: () => void, kind = ""): HTMLButtonElement {
  const made = element("button", { type: "button", title, class: kind }, label);
  if (typeof label !== "string" || label.length < 3) made.setAttribute("aria-label", title);
  made.addEventListener("click", act);
  return made;
}

export interface Check {
  label: HTMLLabelElement;
  set(on: boolean): void;
  enable(on: boolean): void;
}
// Shows what was clicked until the server has answered.
export function check(text: string, title: string, act: (on: boolean) => unknown): Check {
  const box = element("input", { type: "checkbox" });
  let waiting = 0;
  box.addEventListener("change", () => {
    ++waiting;
    void Promise.resolve(act(box.checked)).then(() => --waiting);
  });
  return {
    label: element("label", { title, class: "check" }, box, ` ${text}`),
    set(on) {
      if (waiting === 0) box.checked = on;
    },
    enable: (on) => (box.disabled = !on),
  };
}

export interface Select {
  element: HTMLSelectElement;
  set(value: string, options?: [string, string][]): void;
}
export function select(
  title: string,
  options: [string, string][],
  act: (value: string) => void,
): Select {
  const made = element("select", { title, "aria-label": title });
  let known = "";
  const fill = (entries: [string, string][]) => {
    if (JSON.stringify(entries) === known) return;
    known = JSON.stringify(entries);
    made.replaceChildren(...entries.map(([value, text]) => element("option", { value }, text)));
  };
  fill(options);
  made.addEventListener("change", () => act(made.value));
  return {
    element: made,
    set(value, entries) {
      if (entries) fill(entries);
      made.value = value;
    },
  };
}

export interface NumberOptions {
  label: string;
  title: string; // with the unit
  unit?: string;
  step: number;
  digits: number;
  min?: number;
  max?: number;
  commit: (value: number) => void;
  live?: (value: number) => void; // while the label is dragged
  release?: () => void; // after the last `live`
}
export interface NumberField {
  element: HTMLElement;
  set(value: number): void;
  warn(on: boolean): void;
}

// A number to type, to step with the arrow keys, or to drag by its label.
export function number(options: NumberOptions): NumberField {
  const { step, digits, min = -Infinity, max = Infinity, commit, live, release } = options;
  const input = element("input", {
    type: "text",
    inputmode: "decimal",
    title: options.title,
    "aria-label": options.title,
    autocomplete: "off",
    spellcheck: "false",
  });
  const label = element(
    "span",
    { class: "scrub-label", title: `${options.title}. Drag to change.` },
    options.label,
  );
  const unit = element("span", { class: "unit" }, options.unit ?? "");
  const box = element("span", { class: "number-field" }, label, input, unit);
  let shown = 0;
  let scrubbing = false;
  const clamp = (value: number) => Math.min(max, Math.max(min, value));
  const write = (value: number) => {
    shown = value;
    input.value = (Object.is(value, -0) ? 0 : value).toFixed(digits).replace(/^-(0(\.0*)?)$/, "$1");
  };
  const enter = () => {
    const value = Number(input.value.trim().replace(",", "."));
    if (input.value.trim() === "" || !Number.isFinite(value)) return write(shown);
    if (value.toFixed(digits) === shown.toFixed(digits)) return write(shown);
    write(clamp(value));
    commit(shown);
  };
  input.addEventListener("blur", enter);
  input.addEventListener("focus", () => input.select());
  input.addEventListener("keydown", (event) => {
    if (event.key === "Enter") enter();
    if (event.key === "Escape") {
      write(shown);
      input.blur();
    }
    if (event.key !== "ArrowUp" && event.key !== "ArrowDown") return;
    event.preventDefault();
    const sign = event.key === "ArrowUp" ? 1 : -1;
    write(clamp(Number(input.value) + sign * step * (event.shiftKey ? 10 : 1)));
    commit(shown);
  });
  label.addEventListener("pointerdown", (event) => {
    label.setPointerCapture(event.pointerId);
    const [x, start] = [event.clientX, shown];
    scrubbing = true;
    const move = (e: PointerEvent) => {
      write(clamp(start + Math.round((e.clientX - x) / 3) * step));
      live?.(shown);
    };
    const up = () => {
      scrubbing = false;
      label.removeEventListener("pointermove", move);
      if (shown !== start) (release ?? (() => commit(shown)))();
    };
    label.addEventListener("pointermove", move);
    label.addEventListener("pointerup", up, { once: true });
  });
  return {
    element: box,
    set(value) {
      if (!scrubbing && document.activeElement !== input) write(value);
      else if (!scrubbing && input.value === shown.toFixed(digits)) write(value);
    },
    warn: (on) => box.classList.toggle("warn", on),
  };
}

// A slider with its number; `live` while it moves.
export function slider(
  text: string,
  title: string,
  min: number,
  max: number,
  step: number,
  show: (v: number) => string,
  live: (value: number) => void,
  commit: (value: number) => void,
): { element: HTMLElement; set(value: number): void } {
  const input = element("input", {
    type: "range",
    min: String(min),
    max: String(max),
    step: String(step),
    title,
    "aria-label": title,
  });
  const output = element("output", {});
  const tell = () => (output.textContent = show(Number(input.value)));
  let held = false;
  input.addEventListener("input", () => {
    held = true;
    tell();
    live(Number(input.value));
  });
  input.addEventListener("change", () => {
    held = false;
    commit(Number(input.value));
  });
  return {
    element: element("label", { class: "slider", title }, element("span", {}, text), input, output),
    set(value) {
      if (held) return;
      input.value = String(value);
      tell();
    },
  };
}

export function section(title: string, ...children: Child[]): HTMLDetailsElement {
  return element(
    "details",
    { class: "section", open: "" },
    element("summary", {}, title),
    element("div", { class: "content" }, ...children),
  );
}
export const row = (...children: Child[]) => element("div", { class: "row" }, ...children);
export const note = (text: string) => element("p", { class: "note" }, text);

// Replaces what is inside only where it changed, so that focus and hover stay.
export function list<T>(
  holder: HTMLElement,
  items: T[],
  key: (item: T) => unknown,
  make: (item: T, k: number) => HTMLElement,
): void {
  const wanted = JSON.stringify(items.map(key));
  if (holder.dataset.items === wanted) return;
  holder.dataset.items = wanted;
  holder.replaceChildren(...items.map(make));
}
