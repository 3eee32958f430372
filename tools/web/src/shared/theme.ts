// Light or dark, as the reader's system says or as is chosen; paper is always light.

const dark = matchMedia("(prefers-color-scheme: dark)");
const print = matchMedia("print");
let printing = false; // between beforeprint and afterprint
const listeners: (() => void)[] = [];
let chosen: "light" | "dark" | null = null;
const darkRules = new Set<CSSMediaRule>();

export const isPrinting = () => printing || print.matches;
export const isDark = () => (chosen ? chosen === "dark" : dark.matches) && !isPrinting();
export function onThemeChange(listener: () => void): void {
  listeners.push(listener);
}

// Chooses, whatever the system says: the sheet's dark colours stand under one media condition.
export function chooseTheme(theme: "light" | "dark"): void {
  chosen = theme;
  for (const sheet of document.styleSheets) {
    for (const rule of sheet.cssRules) {
      if (!(rule instanceof CSSMediaRule)) continue;
      if (!/prefers-color-scheme/.test(rule.conditionText) && !darkRules.has(rule)) continue;
      darkRules.add(rule);
      rule.media.mediaText = theme === "dark" ? "screen" : "not all";
    }
  }
  document.documentElement.style.colorScheme = theme;
  tell();
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
