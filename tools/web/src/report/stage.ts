// The players stay in view, smaller, while one reads the plots and tables.

import { byId } from "../shared/dom";

// `changed` is told when they become small or large.
export function keepInView(changed: () => void): void {
  const space = byId("stage-space"); // keeps its height, so that nothing jumps
  const stage = byId("stage");
  let small = false;
  const update = () => {
    const past = space.getBoundingClientRect().bottom < 150;
    if (past === small) return;
    small = past;
    if (small) space.style.height = `${space.offsetHeight}px`;
    stage.classList.toggle("small", small);
    if (!small) space.style.height = "";
    changed();
  };
  addEventListener("scroll", update, { passive: true });
  addEventListener("resize", update);
}
