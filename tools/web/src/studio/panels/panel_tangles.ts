// Panel "Tangles": what is wound round what, live; which of it is to stay; what is wrong.

import { numSegments, nodeNames, parentOf } from "../../shared/body";
import { cssOf, ramp, rgbOf, sequential } from "../../shared/colours";
import { element, fitCanvas } from "../../shared/dom";
import { gliTable, kTangled } from "../../shared/gli";
import { heatScale } from "../../shared/legend";
import { words } from "../../shared/names";
import { isDark, onThemeChange } from "../../shared/theme";
import type { Actions } from "../editing/actions";
import type { Tag, Tangle } from "../state/protocol";
import type { Store } from "../state/store";
import { check, list, note, section } from "../controls/widgets";
import { cm, limb, limbs, pathOf, signed } from "../state/words";

const kBarFull = 1.2; // turns at the end of a bar
const kPairFull = 0.35;

const same = (x: Tangle, y: Tangle) => `${x.a} ${x.b}` === `${y.a} ${y.b}`;
const plain = ({ a, b }: Tangle): Tangle => ({ a, b });

export class TanglesPanel {
  readonly element = element("div", { class: "panel" });
  private readonly found = check(
    "Leave it to the reduction",
    "the tags are those that Algorithm 1 and its reduction find when the template is used",
    (on) => this.actions.tangles(on ? [] : this.store.state.queries.tags.map(plain)),
  );
  private readonly tags = element("ul", { class: "items tags" });
  private readonly none = note(
    "Nothing is tangled yet: no two paths wind round each other by more than half a turn.",
  );
  private readonly literal = note("");
  private readonly warnings = element("ul", { class: "warnings" });
  private readonly noWarnings = note("Nothing to warn of.");
  private readonly matrix = element("canvas", {
    class: "matrix",
    role: "img",
    "aria-label": "GLI of every segment of a against every segment of b",
  });
  private readonly pair = element("p", { class: "note pair" });
  private readonly heat: ReturnType<typeof check>;
  private table: ArrayLike<number> = new Float64Array(numSegments * numSegments);

  constructor(
    private readonly store: Store,
    private readonly actions: Actions,
  ) {
    this.heat = check(
      "Heat on the bodies (H)",
      "colour each limb by the sum of |GLI| over the other body's segments (turns)",
      (heat) => store.set({ heat }),
    );
    const legend = element("div", { class: "legend" }, ...heatScale());
    this.element.append(
      section("Tangles to keep", this.found.label, this.none, this.tags, this.literal),
      section("Warnings", this.noWarnings, this.warnings),
      section(
        "Heat map",
        element("div", { class: "row" }, this.heat.label, legend),
        this.pair,
        this.matrix,
      ),
    );
    this.matrix.addEventListener("mousemove", (event) => this.pointAt(event));
    this.matrix.addEventListener("mouseleave", () => this.store.set({ litPair: null }));
    onThemeChange(() => this.draw());
    new ResizeObserver(() => this.refresh()).observe(this.matrix);
    store.onChange(() => this.refresh());
  }

  private refresh(): void {
    const { state, ui } = this.store;
    if (!state) return;
    const { tags, literal_tangles, warnings, overlaps } = state.queries;
    this.found.set(state.tangles.length === 0);
    this.none.hidden = tags.length > 0;
    if (
      tags.length !== this.tags.children.length ||
      tags.some((t, k) => this.tags.children[k].getAttribute("data-tag") !== keyOf(t))
    ) {
      this.tags.replaceChildren(...tags.map((tag) => this.tag(tag)));
    }
    tags.forEach((tag, k) => this.write(this.tags.children[k] as HTMLElement, tag));
    this.literal.textContent =
      literal_tangles === undefined
        ? ""
        : `${literal_tangles} pairs of paths in Algorithm 1's full list.`;
    this.noWarnings.hidden = warnings.length > 0;
    list(
      this.warnings,
      warnings,
      (w) => w,
      (text) => element("li", {}, limbs(text)),
    );
    this.heat.set(ui.heat);
    this.element.dataset.overlaps = overlaps
      .map((o) => `${limb(o.limbs[0])} and ${limb(o.limbs[1])}: ${cm(o.depth_m)}`)
      .join("; ");
    if (this.element.offsetParent === null || ui.panel !== "tangles") return;
    this.table = gliTable(state.figures.a.nodes.flat(), state.figures.b.nodes.flat());
    this.draw();
    this.tellPair();
  }

  private tag(tag: Tag): HTMLElement {
    const box = check("", "keep this tangle in a solve", (on) => {
      item.dataset.waiting = "true";
      return this.tick(tag, on).then(() => (item.dataset.waiting = "false"));
    });
    const bar = element(
      "div",
      { class: "bar", title: `|GLI| (turns); the line stands at ${kTangled}` },
      element("i", {}),
      element("b", {}),
    );
    const item = element(
      "li",
      { tabindex: "0", "data-tag": keyOf(tag) },
      element(
        "div",
        { class: "tag" },
        box.label,
        element(
          "div",
          { class: "paths" },
          element("span", { class: "figure-a" }, `a ${pathOf(tag.a)}`),
          element("span", { class: "figure-b" }, `b ${pathOf(tag.b)}`),
        ),
        element("output", { title: "GLI with its sign (turns)" }),
      ),
      bar,
      element("small", {}),
    );
    for (const event of ["mouseenter", "focus"])
      item.addEventListener(event, () => this.store.set({ lit: plain(tag) }));
    for (const event of ["mouseleave", "blur"])
      item.addEventListener(event, () => this.store.set({ lit: null }));
    return item;
  }

  private write(item: HTMLElement, tag: Tag): void {
    const size = Math.abs(tag.gli);
    const whole = this.store.state.tangles.length === 0;
    const box = item.querySelector("input")!;
    if (item.dataset.waiting !== "true") box.checked = whole || tag.requested;
    item.classList.toggle("off", !whole && !tag.requested);
    item.querySelector("output")!.textContent = signed(tag.gli, 3);
    const fill = item.querySelector<HTMLElement>("i")!;
    fill.style.width = `${Math.min(100, (100 * size) / kBarFull)}%`;
    const state = size <= kTangled ? "lost" : tag.weak ? "weak" : "kept";
    item.dataset.state = state;
    const said = [`${signed(size - kTangled, 3)} to the ${kTangled} line`];
    if (size <= kTangled) said.push("not tangled");
    else if (tag.weak) said.push(size < 0.6 ? "weak: under 0.6" : "weak");
    if (tag.can_slip) said.push("ends inside a loop that can slip");
    item.querySelector("small")!.textContent = said.join(" · ");
  }

  // One tick changes "found" into a list of one's own.
  private tick(tag: Tag, on: boolean): Promise<boolean> {
    const { tangles, queries } = this.store.state;
    const now = tangles.length === 0 ? queries.tags.map(plain) : tangles;
    const rest = now.filter((t) => !same(t, tag));
    if (!on && rest.length === 0) this.store.say("The last tick leaves it to the reduction.");
    return this.actions.tangles(on ? [...rest, plain(tag)] : rest);
  }

  // -- Every segment of a (rows) against every segment of b (columns) -----------------------------

  private draw(): void {
    if (this.element.offsetParent === null) return;
    const context = fitCanvas(this.matrix);
    const cell = this.matrix.clientWidth / numSegments;
    const stops = isDark() ? sequential.dark : sequential.light;
    for (let i = 0; i < numSegments; ++i) {
      for (let j = 0; j < numSegments; ++j) {
        const value = Math.abs(this.table[i * numSegments + j]) / kPairFull;
        context.fillStyle = cssOf(ramp(stops, value));
        context.fillRect(j * cell, i * cell, cell - 0.5, cell - 0.5);
      }
    }
    const { litPair } = this.store.ui;
    if (!litPair) return;
    context.strokeStyle = cssOf(rgbOf("#D55E00"));
    context.lineWidth = 2;
    context.strokeRect(litPair[1] * cell, litPair[0] * cell, cell, cell);
  }
  private pointAt(event: MouseEvent): void {
    const cell = this.matrix.clientWidth / numSegments;
    const at = (x: number) => Math.min(numSegments - 1, Math.max(0, Math.floor(x / cell)));
    this.store.set({ litPair: [at(event.offsetY), at(event.offsetX)] });
  }
  private tellPair(): void {
    const pair = this.store.ui.litPair;
    this.pair.textContent =
      pair === null
        ? "|GLI| of each segment pair; rows: a, columns: b. Point at a cell."
        : `a ${segment(pair[0])} × b ${segment(pair[1])}: ${signed(this.table[pair[0] * numSegments + pair[1]], 3)}`;
  }
}

const keyOf = (tag: Tangle) => `${tag.a.join(" ")} x ${tag.b.join(" ")}`;
const segment = (s: number) => `${words(nodeNames[parentOf[s + 1]])}–${words(nodeNames[s + 1])}`;
