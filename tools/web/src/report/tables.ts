// The tables are in the page; here they come alive: frames are jumped to, tags shown.

import { element } from "../shared/dom";
import type { Clock } from "./clock";
import type { Transport } from "./transport";

export function enliven(clock: Clock, transport: Transport): void {
  for (const span of document.querySelectorAll<HTMLElement>("span[data-frame]")) {
    const jump = element(
      "button",
      { type: "button", class: "jump", title: "show this frame" },
      ...span.childNodes,
    );
    jump.addEventListener("click", () => clock.seek(Number(span.dataset.frame)));
    span.replaceChildren(jump);
  }
  for (const row of document.querySelectorAll<HTMLElement>("tr[data-tag]")) {
    const tag = Number(row.dataset.tag);
    row.tabIndex = 0;
    for (const event of ["mouseenter", "focusin"])
      row.addEventListener(event, () => transport.showTag(tag));
    for (const event of ["mouseleave", "focusout"])
      row.addEventListener(event, () => transport.showTag(null));
  }
}

// Paper shows everything, closed or not.
export function openForPrint(): void {
  const closed: HTMLDetailsElement[] = [];
  const open = () => {
    for (const details of document.querySelectorAll("details")) {
      if (details.open) continue;
      details.open = true;
      closed.push(details);
    }
  };
  const close = () => {
    for (const details of closed.splice(0)) details.open = false;
  };
  addEventListener("beforeprint", open);
  addEventListener("afterprint", close);
  const print = matchMedia("print");
  print.addEventListener("change", () => (print.matches ? open() : close()));
}
