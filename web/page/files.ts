// Files that leave and enter the page, the clipboard, and words that need an answer.

import { h } from "./dom";
import { word, type Words } from "./words";

export function download(name: string, text: string, type = "text/plain"): void {
    const address = URL.createObjectURL(new Blob([text], { type }));
    const link = h("a", { href: address, download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** Asks for a file and reads it; null if it is none or no text. */
export function openFile(accept: string, take: (text: string) => void, refuse: (why: string) => void): void {
    const input = h("input", { type: "file", accept });
    input.addEventListener("change", () => {
        const file = input.files?.[0];
        if (file) void readFile(file, take, refuse);
    });
    input.click();
}

/** The largest text that the page takes. */
export const LARGEST_TEXT = 1_000_000;

export async function readFile(file: File, take: (text: string) => void, refuse: (why: string) => void): Promise<void> {
    if (file.size > 2 * LARGEST_TEXT) {
        refuse(word().tooLong(Math.round(file.size / 1000)));
        return;
    }
    try {
        take(new TextDecoder("utf-8", { fatal: true }).decode(await file.arrayBuffer()));
    } catch {
        refuse(word().notText);
    }
}

/** Copies a text; false if the browser does not let the page. */
export async function toClipboard(text: string): Promise<boolean> {
    try {
        await navigator.clipboard.writeText(text);
        return true;
    } catch {
        return false;
    }
}

type Action = { label: (words: Words) => string; act: () => void };

/** A dialog with a sentence, perhaps a text, to read or to copy by hand, and actions. */
export function dialog(sentence: string, text: string | null, actions: Action[] = [], isToCopy = false): void {
    const box = h("dialog", { "aria-label": sentence });
    box.append(h("p", {}, sentence));
    if (text !== null) {
        const area = h("textarea", { readonly: true, rows: 12, "aria-label": sentence });
        area.value = text;
        box.append(area);
        if (isToCopy) area.addEventListener("focus", () => area.select());
    }
    const close = (): void => box.close();
    const row = h("div", { class: "actions" });
    for (const { label, act } of actions) {
        row.append(
            h(
                "button",
                {
                    type: "button",
                    class: "primary",
                    onclick: () => {
                        close();
                        act();
                    },
                },
                label(word()),
            ),
        );
    }
    row.append(h("button", { type: "button", onclick: close }, word().close));
    box.append(row);
    box.addEventListener("close", () => box.remove());
    document.body.append(box);
    box.showModal();
}

/** A word at the foot of the window, for a while. */
export class Notice {
    readonly element = h("p", { class: "notice", role: "status" });
    #timer: ReturnType<typeof setTimeout> | undefined;

    say(text: string, isLong = false): void {
        this.element.textContent = text;
        this.element.classList.add("seen");
        clearTimeout(this.#timer);
        this.#timer = setTimeout(() => this.element.classList.remove("seen"), isLong ? 12_000 : 3500);
    }
}

