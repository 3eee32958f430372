// Light or dark, as the reader's system says; paper is always light.

const dark = matchMedia("(prefers-color-scheme: dark)");
const print = matchMedia("print");
let printing = false; // between beforeprint and afterprint
const listeners: (() => void)[] = [];

export const isPrinting = () => printing || print.matches;
export const isDark = () => dark.matches && !isPrinting();
export function onThemeChange(listener: () => void): void {
  listeners.push(listener);
}

// A custom property of the style sheet, such as "--ink".
export function themeColour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

function tell(): void {
  document.documentElement.classList.toggle("printing", isPrinting());
  for (const listener of listeners) listener();
}
dark.addEventListener("change", tell);
print.addEventListener("change", tell);
addEventListener("beforeprint", () => {
  printing = true;
  tell();
});
addEventListener("afterprint", () => {
  printing = false;
  tell();
});
