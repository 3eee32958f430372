// The slim bar on top, the tools on the left and the status line below.

import { byId, element } from "../../shared/dom";
import { chooseTheme, isDark } from "../../shared/theme";
import type { Actions } from "../editing/actions";
import { icon, type IconName } from "../controls/icons";
import { isOpen } from "../state/measures";
import type { Session } from "../editing/session";
import type { Store, Tool } from "../state/store";
import { button } from "../controls/widgets";
import { cm, limb } from "../state/words";

const kTheme = "retarget-studio-theme";

function iconButton(name: IconName, title: string, act: () => void): HTMLButtonElement {
  const made = element("button", { type: "button", title, "aria-label": title }, icon(name));
  made.addEventListener("click", act);
  return made;
}

// -- Top -----------------------------------------------------------------------------------------

export function fillTopBar(
  store: Store,
  actions: Actions,
  session: Session,
  help: () => void,
): void {
  const bar = byId("topbar");
  const name = element("input", {
    type: "text",
    class: "name",
    title: "name of the template",
    maxlength: "120",
  });
  name.addEventListener("change", () => {
    const text = name.value.trim();
    if (text && text !== store.state.name) void actions.do({ op: "set_name", name: text });
    else name.value = store.state.name;
  });
  const dirty = element("span", { class: "dirty", role: "status" });
  const undo = iconButton("undo", "undo (Ctrl+Z)", () => actions.undo());
  const redo = iconButton("redo", "redo (Ctrl+Shift+Z)", () => actions.redo());
  const save = button("Save", "save the template (Ctrl+S)", () => void session.save(), "primary");
  const theme = iconButton(isDark() ? "sun" : "moon", "light or dark", () => setTheme(!isDark()));
  const setTheme = (dark: boolean) => {
    localStorage.setItem(kTheme, dark ? "dark" : "light");
    chooseTheme(dark ? "dark" : "light");
    theme.replaceChildren(icon(dark ? "sun" : "moon"));
  };
  const chosen = localStorage.getItem(kTheme);
  if (chosen) setTheme(chosen === "dark");
  bar.append(
    element("b", { class: "brand" }, "retarget", element("span", {}, " studio")),
    name,
    dirty,
    element("span", { class: "space" }),
    undo,
    redo,
    save,
    theme,
    button("?", "keyboard map (?)", help),
  );
  store.onChange(() => {
    const { state } = store;
    if (document.activeElement !== name) name.value = state.name;
    dirty.textContent = state.dirty ? "unsaved" : state.saved_as ? "saved" : "";
    dirty.classList.toggle("on", state.dirty);
    undo.disabled = !state.can_undo;
    undo.title = state.undo_text ? `undo: ${state.undo_text} (Ctrl+Z)` : "undo (Ctrl+Z)";
    redo.disabled = !state.can_redo;
    document.title = `${state.dirty ? "• " : ""}${state.name} · retarget studio`;
  });
}

// -- Left ----------------------------------------------------------------------------------------

const kTools: [Tool, IconName, string][] = [
  ["pose", "pose", "Pose: drag joints, the whole figure follows (Q)"],
  ["rotate", "rotate", "Rotate the selected joint (R)"],
  ["move", "move", "Move or turn a whole figure; again: turn (T)"],
  ["pin", "pin", "Pin and free joints by clicks"],
  ["hold", "hold", "Connect two joints, or a joint and the floor (C)"],
  ["photo-pin", "photo-pin", "Pin a joint to a point of the photo (O)"],
];

export function fillToolbar(store: Store, actions: Actions): void {
  const bar = byId("toolbar");
  const tools = kTools.map(([tool, picture, title]) => {
    const made = iconButton(picture, title, () => actions.tool(tool));
    made.dataset.tool = tool;
    return made;
  });
  const line = () => element("hr", {});
  const axes = iconButton("world", "gizmo axes: the joint's own or the world's (X)", () =>
    store.set({ worldAxes: !store.ui.worldAxes }),
  );
  const heat = iconButton("heat", "heat map of |GLI| on the bodies (H)", () =>
    store.set({ heat: !store.ui.heat }),
  );
  const ghost = iconButton("ghost", "the other figure as a ghost (G); isolate: I", () =>
    actions.isolate("ghost"),
  );
  const views = iconButton("views", "side views (V)", () =>
    store.set({ sideViews: !store.ui.sideViews }),
  );
  bar.append(
    ...tools,
    line(),
    axes,
    iconButton("settle", "Settle: close holds, restore limits and distances (S)", () =>
      actions.settle(),
    ),
    iconButton("mirror", "Mirror this figure (M)", () => actions.mirror(store.ui.figure)),
    line(),
    heat,
    ghost,
    views,
    iconButton("frame", "Frame both figures (Home); the selected joint: F", () =>
      actions.frame(false),
    ),
  );
  store.onChange(() => {
    const { ui, state } = store;
    tools.forEach((made) =>
      made.setAttribute("aria-pressed", String(made.dataset.tool === ui.tool)),
    );
    tools[5].hidden = !state.photo;
    const press = (made: HTMLElement, on: boolean) => made.setAttribute("aria-pressed", String(on));
    press(axes, ui.worldAxes);
    press(heat, ui.heat);
    press(ghost, Object.values(ui.shown).includes("ghost"));
    press(views, ui.sideViews);
  });
}

// -- Below ---------------------------------------------------------------------------------------

// What the solver did, in words.
function solved(store: Store): { text: string; bad: boolean } {
  const { result } = store;
  if (!result) return { text: "", bad: false };
  const said: string[] = [];
  let bad = false;
  if (result.blocked) {
    said.push(`${limb(result.blocked[0])} and ${limb(result.blocked[1])} block each other`);
    bad = true;
  } else if (result.stalled) {
    said.push("a limb is in the way");
    bad = true;
  }
  if (result.drag_error_m > 0.01) said.push(`${cm(result.drag_error_m)} short of the target`);
  if (result.pin_error_m > 0.005)
    said.push(`a pin or a standing foot gives way by ${cm(result.pin_error_m)}`);
  if (said.length === 0) said.push("reached");
  said.push(
    `${result.iterations} steps`,
    `${result.ms < 10 ? result.ms.toFixed(1) : Math.round(result.ms)} ms`,
  );
  return { text: said.join(" · "), bad };
}

const kHints: Record<Tool, string> = {
  pose:
    "drag a joint: pose · Shift: depth · Alt: along the line of sight · " +
    "drag beside: orbit · right: pan · wheel: zoom",
  rotate: "drag a ring: turn the joint · X: own or world axes",
  move: "drag an arrow: move the figure · T again: turn it",
  pin: "click a joint: pin or free it",
  hold: "click one end, then the other · Escape: leave it",
  "photo-pin": "drag a joint to its point in the photo",
  "photo-move": "drag: move the photo · Escape: done",
};

export function fillStatus(store: Store): void {
  const bar = byId("status");
  const message = element("span", { class: "message", role: "status", "aria-live": "polite" });
  const solver = element("span", {
    class: "solver",
    title: "what the solver did with the last drag",
  });
  const hint = element("span", { class: "hint" });
  const counts = element("span", { class: "counts" });
  bar.append(message, solver, element("span", { class: "space" }), hint, counts);
  store.onChange(() => {
    const { state, ui } = store;
    const { text, kind } = store.connected
      ? store.message
      : { text: "The studio's server does not answer. Trying again…", kind: "bad" };
    message.textContent = text;
    message.className = `message ${kind}`;
    const { text: said, bad } = solved(store);
    solver.textContent = said;
    solver.classList.toggle("bad", bad);
    hint.textContent = kHints[ui.tool];
    const open = state.holds.filter(isOpen).length;
    const { warnings } = state.queries;
    counts.textContent = [
      open > 0 ? `${open} open hold${open > 1 ? "s" : ""} (S settles)` : "",
      warnings.length > 0 ? `${warnings.length} warning${warnings.length > 1 ? "s" : ""}` : "",
    ]
      .filter(Boolean)
      .join(" · ");
  });
}
