// "Start from...": rest, a template of the library, or a frame of the clips.

import { element } from "../../shared/dom";
import { figureNames, type FigureName } from "../../shared/names";
import { cancelButton, openDialog } from "../controls/dialogs";
import { statureRange } from "../state/measures";
import type { TemplateInfo } from "../state/protocol";
import type { Session } from "../editing/session";
import type { Store } from "../state/store";
import { templateTile } from "./template_tile";
import { button, check, note, number, row, section } from "../controls/widgets";

export function openStartDialog(store: Store, session: Session, templates: TemplateInfo[]): void {
  const go = async (what: object) => {
    dialog.close();
    await session.load(what);
  };
  const stature = { a: store.body.a.stature, b: store.body.b.stature };
  let distance = 1;
  const tall = (figure: FigureName) => {
    const field = number({
      label: `Stature of ${figure}`,
      title: `stature of figure ${figure} (m)`,
      ...statureRange,
      commit: (v) => (stature[figure] = v),
    });
    field.set(stature[figure]);
    return field.element;
  };
  const apart = number({
    label: "Distance",
    title: "distance of the two figures (m)",
    unit: "m",
    step: 0.05,
    digits: 2,
    min: 0.2,
    max: 5,
    commit: (v) => (distance = v),
  });
  apart.set(distance);
  const rest = section(
    "Rest",
    note("Two T-poses, face to face."),
    row(tall("a"), tall("b"), apart.element),
    row(
      button(
        "Start from rest",
        "replace both figures by T-poses",
        () => void go({ rest: { stature, distance } }),
        "primary",
      ),
    ),
  );

  const library = section(
    "A template",
    element(
      "ul",
      { class: "templates small" },
      ...templates.map((template) => {
        const { id } = template;
        const act = () => void go({ template: id });
        const tile = { title: `start from ${id}`, about: id, act };
        return element("li", {}, templateTile(template, tile));
      }),
    ),
  );

  const dialog = openDialog(
    "Start from",
    [
      rest,
      library,
      clipPart(store, go),
      element(
        "div",
        { class: "buttons" },
        cancelButton(() => dialog),
      ),
    ],
    true,
  );
  dialog.querySelector<HTMLElement>(".primary")!.focus();
}

function clipPart(store: Store, go: (what: object) => Promise<void>): HTMLElement {
  const { a, b } = store.start.clips ?? {};
  if (!a || !b)
    return section(
      "A frame of the clips",
      note("Start the studio with --clip-a A --clip-b B to take bodies and postures from clips."),
    );
  const clips = { a, b };
  const frame = { a: 0, b: 0 };
  let together = false;
  const bars = figureNames.map((figure) => {
    const { file, frames, fps, stature } = clips[figure];
    const output = element("output", {}, "frame 0");
    const input = element("input", {
      type: "range",
      min: "0",
      max: String(frames - 1),
      value: "0",
      title: `frame of figure ${figure}'s clip (${fps} frames/s)`,
    });
    input.addEventListener("input", () => {
      frame[figure] = Number(input.value);
      output.textContent = `frame ${input.value} · ${(frame[figure] / fps).toFixed(2)} s`;
    });
    return element(
      "label",
      { class: "slider" },
      element(
        "span",
        { class: `figure-${figure}`, title: `${stature.toFixed(2)} m tall` },
        `${figure}: ${file}`,
      ),
      input,
      output,
    );
  });
  const both = check(
    "as captured in one world",
    "off: each upright in front of the other, 1 m apart",
    (on) => (together = on),
  );
  return section(
    "A frame of the clips",
    ...bars,
    row(
      both.label,
      button(
        "Start from these frames",
        "replace both figures by the clips' bodies and postures",
        () => void go({ clips: { frame_a: frame.a, frame_b: frame.b, together } }),
        "primary",
      ),
    ),
  );
}
