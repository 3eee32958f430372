// The tabs on the right, one panel each.

import { byId, element } from "../../shared/dom";
import { isOpen } from "../state/measures";
import type { PanelName, Store } from "../state/store";

const kTitles: Record<PanelName, string> = {
  figures: "Figures",
  holds: "Holds",
  tangles: "Tangles",
  photo: "Photo",
  library: "Library",
  try: "Try it",
};

export function fillSide(store: Store, panels: Record<PanelName, HTMLElement>): void {
  const names = Object.keys(kTitles) as PanelName[];
  const tabs = names.map((name) => {
    const tab = element(
      "button",
      { type: "button", role: "tab", id: `tab-${name}`, "aria-controls": `panel-${name}` },
      kTitles[name],
    );
    tab.addEventListener("click", () => store.set({ panel: name }));
    tab.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (!by) return;
      event.stopPropagation();
      const next = (names.indexOf(name) + by + names.length) % names.length;
      store.set({ panel: names[next] });
      tabs[next].focus();
    });
    const panel = panels[name];
    panel.id = `panel-${name}`;
    panel.setAttribute("role", "tabpanel");
    panel.setAttribute("aria-labelledby", tab.id);
    return tab;
  });
  byId("side").append(
    element("div", { class: "tabs", role: "tablist" }, ...tabs),
    ...names.map((name) => panels[name]),
  );
  store.onChange(() => {
    const { state } = store;
    const warn = {
      tangles: state.queries.warnings.length > 0,
      holds: state.holds.some(isOpen),
    };
    names.forEach((name, k) => {
      const open = store.ui.panel === name;
      tabs[k].setAttribute("aria-selected", String(open));
      tabs[k].tabIndex = open ? 0 : -1;
      tabs[k].classList.toggle("warn", Boolean(warn[name as keyof typeof warn]));
      panels[name].hidden = !open;
    });
  });
}
