// The keyboard map, and the page that shows it.

import { element } from "../../shared/dom";
import type { Actions } from "./actions";
import { openDialog } from "../controls/dialogs";
import type { Session } from "./session";
import type { Store } from "../state/store";
import type { Direction } from "../stage/view";
import { button } from "../controls/widgets";

interface Binding {
  keys: string; // as shown
  text: string;
  match?: (event: KeyboardEvent) => boolean;
  act?: (event: KeyboardEvent) => void;
}
type Group = [title: string, bindings: Binding[]];

const kNudge = 0.01; // m

export class Keys {
  private readonly groups: Group[];

  constructor(
    store: Store,
    private readonly actions: Actions,
    session: Session,
    private readonly escape: () => void,
    lock: () => void,
    startFrom: () => void,
  ) {
    const key = (
      keys: string,
      text: string,
      act: (event: KeyboardEvent) => void,
      match?: Binding["match"],
    ): Binding => ({
      keys,
      text,
      act,
      match:
        match ??
        ((e) =>
          !e.ctrlKey &&
          !e.metaKey &&
          !e.altKey &&
          !e.shiftKey &&
          e.key.toLowerCase() === keys.toLowerCase()),
    });
    const shift = (letter: string, text: string, act: () => void) =>
      key(
        `Shift+${letter}`,
        text,
        act,
        (e) =>
          e.shiftKey && !e.ctrlKey && !e.metaKey && e.key.toLowerCase() === letter.toLowerCase(),
      );
    const ctrl = (letter: string, text: string, act: () => void, shifted = false) =>
      key(
        `Ctrl+${shifted ? "Shift+" : ""}${letter}`,
        text,
        act,
        (e) =>
          (e.ctrlKey || e.metaKey) &&
          e.shiftKey === shifted &&
          e.key.toLowerCase() === letter.toLowerCase(),
      );
    const mouse = (keys: string, text: string): Binding => ({ keys, text });
    const look = (digit: string, direction: Direction) =>
      key(digit, `look from: ${direction}`, () => actions.look(direction));
    const plain = (e: KeyboardEvent) => !e.ctrlKey && !e.metaKey && !e.altKey;
    this.groups = [
      [
        "Mouse",
        [
          mouse("drag a joint", "pose: the whole figure follows"),
          mouse("Shift + drag", "towards you and away"),
          mouse("Alt + drag", "along the line of sight: the solver chooses the depth"),
          mouse("click", "select"),
          mouse("drag beside", "orbit"),
          mouse("right + drag", "pan"),
          mouse("wheel", "zoom"),
        ],
      ],
      [
        "Tools",
        [
          key("Q", "pose", () => actions.tool("pose")),
          key("R", "rotate a joint", () => actions.tool("rotate")),
          key("T", "move a figure; again: turn it", () => actions.tool("move")),
          key("C", "connect two ends (hold)", () => actions.tool("hold")),
          key("O", "pin a joint to the photo", () => actions.tool("photo-pin")),
          key("X", "gizmo in own or world axes", () =>
            store.set({ worldAxes: !store.ui.worldAxes }),
          ),
          key("Escape", "leave: drag, tool, selection", () => this.escape()),
        ],
      ],
      [
        "Posture",
        [
          key("P", "pin or free the joint", () => actions.togglePin(store.ui.selected)),
          shift("P", "free all pins", () => actions.clearPins()),
          key("S", "settle", () => actions.settle()),
          key("M", "mirror the figure", () => actions.mirror(store.ui.figure)),
          shift("M", "mirror the scene", () => actions.mirror("both")),
          key("Backspace", "reset the joint", () => actions.resetJoint()),
          key(
            "Arrows",
            "move the joint by 1 cm (Shift: 5 cm)",
            (e) => this.nudge(e),
            (e) => plain(e) && e.key.startsWith("Arrow"),
          ),
          key(
            "[ ]",
            "joint before, after",
            (e) => actions.step(e.key === "]" ? 1 : -1),
            (e) => plain(e) && (e.key === "[" || e.key === "]"),
          ),
          key("\\", "the same joint of the other figure", () => actions.otherFigure()),
          key("N", "start from…", startFrom),
        ],
      ],
      [
        "View",
        [
          look("1", "front"),
          look("3", "side"),
          look("7", "top"),
          look("0", "three-quarter"),
          key("F", "frame the joint", () => actions.frame(true)),
          key("Home", "frame both figures", () => actions.frame(false)),
          key("V", "side views", () => store.set({ sideViews: !store.ui.sideViews })),
          key("H", "heat map", () => store.set({ heat: !store.ui.heat })),
          key("G", "other figure as a ghost", () => actions.isolate("ghost")),
          key("I", "isolate the figure", () => actions.isolate("hidden")),
          key("L", "lock photo and camera", lock),
        ],
      ],
      [
        "Template",
        [
          ctrl("Z", "undo", () => actions.undo()),
          ctrl("Z", "redo", () => actions.redo(), true),
          ctrl("Y", "redo", () => actions.redo()),
          ctrl("S", "save", () => void session.save()),
          ctrl("S", "save as", () => void session.saveAs(), true),
          key(
            "?",
            "this map",
            () => this.help(),
            (e) => e.key === "?",
          ),
        ],
      ],
    ];
    addEventListener("keydown", (event) => this.press(event));
  }

  private press(event: KeyboardEvent): void {
    if (document.querySelector("dialog[open]")) return;
    const target = event.target as HTMLElement;
    const control = event.ctrlKey || event.metaKey;
    const typing = target.matches("input:not([type=checkbox], [type=range]), textarea, select");
    if (typing && !(control && event.key.toLowerCase() === "s")) return;
    if (target.matches("input[type=range], li, pre") && /^(Arrow|Delete|Backspace)/.test(event.key))
      return;
    for (const [, bindings] of this.groups) {
      for (const { match, act } of bindings) {
        if (!match?.(event)) continue;
        event.preventDefault();
        act!(event);
        return;
      }
    }
  }

  private nudge(event: KeyboardEvent): void {
    const step = event.shiftKey ? 5 * kNudge : kNudge;
    const [x, y] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[
      event.key
    ] ?? [0, 0];
    this.actions.nudge(x * step, y * step);
  }

  help(): void {
    const groups = this.groups.map(([title, bindings]) =>
      element(
        "section",
        {},
        element("h3", {}, title),
        element(
          "dl",
          {},
          ...bindings.flatMap(({ keys, text }) => [
            element("dt", {}, element("kbd", {}, keys)),
            element("dd", {}, text),
          ]),
        ),
      ),
    );
    const close = button("Close", "close (Escape)", () => dialog.close());
    const dialog: HTMLDialogElement = openDialog(
      "Keyboard and mouse",
      [element("div", { class: "map" }, ...groups), element("div", { class: "buttons" }, close)],
      true,
    );
    close.focus({ preventScroll: true });
  }
}
