// Light or dark: as the system says, or as chosen. Style sheets that ask the system are rewritten to the choice.

import { Signal } from "./signal";

export type Theme = "auto" | "light" | "dark";
export const themeChanged = new Signal();

const system = matchMedia("(prefers-color-scheme: dark)");
let chosen: Theme = "auto";

export function theme(): Theme {
    return chosen;
}

export function isDark(): boolean {
    return chosen === "dark" || (chosen === "auto" && system.matches);
}

export function setTheme(next: Theme): void {
    chosen = next;
    document.documentElement.dataset.theme = isDark() ? "dark" : "light";
    for (const [text, sheet] of sheets) sheet.replaceSync(themed(text));
    themeChanged.emit();
}

system.addEventListener("change", () => setTheme(chosen));

const sheets = new Map<string, CSSStyleSheet>();

function themed(text: string): string {
    return text.replace(/\(prefers-color-scheme:\s*dark\)/gu, isDark() ? "all" : "not all");
}

/** A style sheet to adopt, which follows the theme; one for each text. */
export function sheetOf(text: string): CSSStyleSheet {
    let sheet = sheets.get(text);
    if (sheet === undefined) {
        sheet = new CSSStyleSheet();
        sheet.replaceSync(themed(text));
        sheets.set(text, sheet);
    }
    return sheet;
}
