// Language and colours of the last visit. Some browsers keep nothing for files from disk: then they are as at first.

import type { Theme } from "./theme";
import { languages, type Language } from "./words";

type Preferences = { language?: Language | undefined; theme?: Theme | undefined };
const KEY = "linkage";

export function recall(): Preferences {
    try {
        const { language, theme } = JSON.parse(localStorage.getItem(KEY) ?? "{}") as Record<string, unknown>;
        return {
            language: typeof language === "string" && language in languages ? (language as Language) : undefined,
            theme: theme === "light" || theme === "dark" || theme === "auto" ? theme : undefined,
        };
    } catch {
        return {};
    }
}

export function remember(some: Preferences): void {
    try {
        localStorage.setItem(KEY, JSON.stringify({ ...recall(), ...some }));
    } catch {
        // Nothing depends on it.
    }
}
