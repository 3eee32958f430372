// Panel "Holds": what stays together, what is pinned, where feet may stand.

import { element } from "../../shared/dom";
import { figureNames, words, type FigureName } from "../../shared/names";
import type { Actions } from "../editing/actions";
import { isOpen } from "../state/measures";
import type { Hold, Pin } from "../state/protocol";
import type { Store } from "../state/store";
import { button, check, list, note, row, section } from "../controls/widgets";
import { cm, endOf, nodeOf } from "../state/words";

const kFeet = ["left_ankle", "left_toe", "right_ankle", "right_toe"];

export class HoldsPanel {
  readonly element = element("div", { class: "panel" });
  private readonly holds = element("ul", { class: "items" });
  private readonly noHolds = note(
    "No holds yet. Connect a hand to the other's wrist, or a foot to the floor: " +
      "a click on each end.",
  );
  private readonly pins = element("ul", { class: "items" });
  private readonly noPins = note(
    "No pins. Select a joint and press P: drags leave it where it is.",
  );
  private readonly feet: { figure: FigureName; node: string; check: ReturnType<typeof check> }[] =
    [];

  constructor(
    private readonly store: Store,
    private readonly actions: Actions,
  ) {
    const supports = figureNames.map((figure) =>
      element(
        "div",
        { class: "feet" },
        element("span", { class: `figure-${figure}` }, `Figure\u00a0${figure}`),
        ...kFeet.map((node) => {
          const made = check(
            words(node),
            `${nodeOf(figure, node)} may be planted in a solve`,
            (on) => this.support(figure, node, on),
          );
          this.feet.push({ figure, node, check: made });
          return made.label;
        }),
      ),
    );
    this.element.append(
      section(
        "Holds",
        row(
          button(
            "Connect…",
            "click a joint, then the joint that it holds, or the floor (C)",
            () => actions.tool("hold"),
            "primary",
          ),
          button("Settle", "close open holds (S)", () => actions.settle()),
        ),
        this.noHolds,
        this.holds,
      ),
      section(
        "Pins",
        this.noPins,
        this.pins,
        row(button("Free all", "remove every pin", () => actions.clearPins())),
      ),
      section("Feet that may be planted", ...supports),
    );
    store.onChange(() => this.refresh());
  }

  private support(figure: FigureName, node: string, on: boolean): Promise<boolean> {
    const others = this.store.state.supports[figure].filter((name) => name !== node);
    return this.actions.do({ op: "set_supports", figure, nodes: on ? [...others, node] : others });
  }

  private refresh(): void {
    const { state } = this.store;
    this.noHolds.hidden = state.holds.length > 0;
    list(
      this.holds,
      state.holds,
      (h) => [h.from, h.to, h.rotation, cm(h.error_m)],
      (hold, k) => this.hold(hold, k),
    );
    this.noPins.hidden = state.pins.length > 0;
    this.pins.parentElement!.querySelector<HTMLElement>(".row")!.hidden = state.pins.length === 0;
    list(
      this.pins,
      state.pins,
      (p) => [p.figure, p.node, Boolean(p.ray)],
      (pin) => this.pin(pin),
    );
    for (const { figure, node, check: made } of this.feet)
      made.set(state.supports[figure].includes(node));
  }

  private hold(hold: Hold, index: number): HTMLElement {
    const open = isOpen(hold);
    const turn = check(
      "keeps its angle",
      "also keep the relative orientation of the two ends",
      (rotation) => {
        const { from, to } = hold;
        return this.actions.do({ op: "edit_hold", index, from, to, rotation });
      },
    );
    turn.set(hold.rotation);
    const edit = button("Edit", "pick both ends anew", () => {
      this.actions.tool("hold");
      this.store.set({ holdEdited: index });
    });
    const remove = button(
      "✕",
      "remove this hold (Delete)",
      () => void this.actions.do({ op: "remove_hold", index }),
    );
    const item = element(
      "li",
      { tabindex: "0", "data-hold": String(index), title: "distance of the two held points (cm)" },
      element(
        "div",
        { class: "ends" },
        this.end(hold.from),
        element("span", { class: "chain" }, "holds"),
        this.end(hold.to),
        element(
          "b",
          { class: open ? "bad" : "good" },
          open ? `${cm(hold.error_m)} open` : cm(hold.error_m),
        ),
      ),
      row(turn.label, edit, remove),
    );
    this.light(item, index);
    item.addEventListener("keydown", (event) => {
      if (event.key === "Delete" && event.target === item) remove.click();
    });
    return item;
  }
  private end(end: Hold["from"]): HTMLElement {
    return element(
      "span",
      { class: end.figure === "world" ? "" : `figure-${end.figure}` },
      endOf(end),
    );
  }
  private light(item: HTMLElement, index: number): void {
    for (const event of ["mouseenter", "focus"])
      item.addEventListener(event, () => this.store.set({ litHold: index }));
    for (const event of ["mouseleave", "blur"])
      item.addEventListener(event, () => this.store.set({ litHold: null }));
  }

  private pin(pin: Pin): HTMLElement {
    const { figure, node } = pin;
    return element(
      "li",
      { class: "line" },
      element("span", { class: `figure-${figure}` }, nodeOf(figure, node)),
      element("small", {}, pin.ray ? "on a line of the photo" : "in place"),
      button(
        "✕",
        `free ${nodeOf(figure, node)}`,
        () => void this.actions.do({ op: "unpin", figure, node }),
      ),
    );
  }
}
