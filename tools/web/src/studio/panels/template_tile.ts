// A template of the library as a button: its picture, its name and a line about it.

import { element } from "../../shared/dom";
import { address, type Query } from "../state/api";
import type { TemplateInfo } from "../state/protocol";

export interface Tile {
  title: string;
  about: string;
  version?: string; // another one asks for the picture anew
  act: () => void;
}

function picture({ id, name, has_thumbnail }: TemplateInfo, version?: string): HTMLElement {
  if (!has_thumbnail) {
    const initial = name.slice(0, 1).toUpperCase();
    return element("span", { class: "no-picture", "aria-hidden": "true" }, initial);
  }
  const query: Query = version === undefined ? { id } : { id, v: version };
  const src = address("/api/library/thumbnail", query);
  return element("img", { alt: "", src, loading: "lazy" });
}

export function templateTile(template: TemplateInfo, tile: Tile): HTMLButtonElement {
  const { title, about, version, act } = tile;
  const made = element(
    "button",
    { type: "button", class: "open", title },
    picture(template, version),
    element(
      "span",
      { class: "about" },
      element("b", {}, template.name),
      element("small", {}, about),
    ),
  );
  made.addEventListener("click", act);
  return made;
}
