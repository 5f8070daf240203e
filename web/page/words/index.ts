// The words of the language that is chosen.

import { en, type Words } from "./en";
import { it } from "./it";

export const languages = { en, it } as const;
export type { Words } from "./en";
export type Language = keyof typeof languages;

let chosen: Language = navigator.language.startsWith("it") ? "it" : "en";
const listeners: ((words: Words) => void)[] = [];

export function word(): Words {
    return languages[chosen];
}

export function languageOf(): Language {
    return chosen;
}

/** Calls a function now, and again when another language is chosen. */
export function onLanguage(apply: (words: Words) => void): void {
    listeners.push(apply);
    apply(word());
}

export function setLanguage(language: Language): void {
    chosen = language;
    document.documentElement.lang = language;
    for (const apply of listeners) apply(word());
}

/** A text that follows the language; for elements that stay as long as the page. */
export function say(pick: (words: Words) => string): Text {
    const text = document.createTextNode("");
    onLanguage((words) => {
        text.data = pick(words);
    });
    return text;
}
