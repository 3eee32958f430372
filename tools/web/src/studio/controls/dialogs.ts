// Questions that must be answered before one goes on.

import { element } from "../../shared/dom";
import { button } from "./widgets";

// Over the page until it is closed.
export function show(dialog: HTMLDialogElement): HTMLDialogElement {
  document.body.append(dialog);
  dialog.addEventListener("close", () => dialog.remove());
  dialog.showModal();
  return dialog;
}

export function openDialog(title: string, content: (Node | string)[], wide = false) {
  const dialog = element(
    "dialog",
    { class: wide ? "wide" : "", "aria-label": title },
    element("h2", {}, title),
    ...content,
  );
  return show(dialog);
}

export const cancelButton = (dialog: () => HTMLDialogElement) =>
  button("Cancel", "leave all as it is (Escape)", () => dialog().close());

// Buttons of a dialog; the last is what Enter does.
function buttons(
  dialog: () => HTMLDialogElement,
  ok: string,
  kind: string,
  act: () => void,
): HTMLElement {
  const yes = element("button", { type: "submit", class: `primary ${kind}` }, ok);
  yes.addEventListener("click", (event) => {
    event.preventDefault();
    act();
  });
  return element("div", { class: "buttons" }, cancelButton(dialog), yes);
}

export function confirmed(title: string, text: string, ok: string, kind = ""): Promise<boolean> {
  return new Promise((done) => {
    let answer = false;
    const dialog: HTMLDialogElement = openDialog(title, [
      element(
        "form",
        {},
        element("p", {}, text),
        buttons(
          () => dialog,
          ok,
          kind,
          () => {
            answer = true;
            dialog.close();
          },
        ),
      ),
    ]);
    dialog.querySelector<HTMLElement>(".primary")!.focus();
    dialog.addEventListener("close", () => done(answer));
  });
}

export function asked(
  title: string,
  label: string,
  value: string,
  ok: string,
): Promise<string | null> {
  return new Promise((done) => {
    let answer: string | null = null;
    const input = element("input", { type: "text", value, "aria-label": label, maxlength: "120" });
    const form = element(
      "form",
      {},
      element("label", { class: "field" }, label, input),
      buttons(
        () => dialog,
        ok,
        "",
        () => {
          answer = input.value.trim();
          if (answer) dialog.close();
          else input.focus();
        },
      ),
    );
    const dialog: HTMLDialogElement = openDialog(title, [form]);
    input.focus();
    input.select();
    dialog.addEventListener("close", () => done(answer || null));
  });
}
