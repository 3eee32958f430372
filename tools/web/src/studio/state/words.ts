// Names and numbers in words.

import { words, type FigureName } from "../../shared/names";
import type { HoldEnd, Path } from "./protocol";

// "a/left_elbow" -> "a's left elbow"
export function limb(name: string): string {
  const [figure, node] = name.split("/");
  return node ? `${figure}'s ${words(node)}` : words(name);
}
// The same wherever it stands in a sentence.
export const limbs = (text: string) => text.replace(/\b[ab]\/[a-z_]+/g, limb);
export const nodeOf = (figure: FigureName, node: string) => `${figure}'s ${words(node)}`;
export const endOf = (end: HoldEnd) =>
  end.figure === "world" ? "the world" : nodeOf(end.figure, end.node ?? "");
// Short, for lists: "l. hand–r. wrist".
export const pathOf = ([from, to]: Path) => `${words(from)} to ${words(to)}`;

export function cm(metres: number): string {
  const value = 100 * metres;
  return `${value.toFixed(Math.abs(value) < 10 ? 1 : 0)} cm`;
}
// With a real minus sign, and no "-0.00".
export function signed(value: number, digits: number): string {
  const text = Math.abs(value).toFixed(digits);
  return (value < 0 && Number(text) !== 0 ? "−" : "+") + text;
}
export const degrees = (value: number) => `${value.toFixed(0).replace("-", "−")}°`;
