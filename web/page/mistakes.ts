// Mistakes of the text: underlined there, and listed below it with their help.

import { h, set } from "./dom";
import type { Editor } from "./editor";
import type { Machine } from "./machine";
import { onLanguage, word } from "./words";

export class MistakesView {
    readonly element = h("div", { class: "mistakes" });
    #status = h("p", { class: "status", role: "status" });
    #list = h("ol", { lang: "en" });
    #machine: Machine;
    #editor: Editor;

    constructor(machine: Machine, editor: Editor) {
        this.#machine = machine;
        this.#editor = editor;
        this.element.append(this.#status, this.#list);
        machine.compiled.on(() => this.#show());
        onLanguage(() => this.#show());
    }

    /** The text has changed and is not read yet. */
    wait(): void {
        set(this.element, "data-waiting", true);
    }

    #show(): void {
        const { mistakes, unreadable, text } = this.#machine;
        set(this.element, "data-waiting", false);
        this.#editor.mark(mistakes);
        const isEmpty = this.#editor.text.trim() === "";
        const count = mistakes.length;
        set(this.element, "data-bad", count > 0 || unreadable !== null);
        if (isEmpty) this.#status.textContent = word().empty;
        else if (unreadable !== null) this.#status.textContent = unreadable;
        else if (count > 0) this.#status.textContent = word().mistakes(count);
        else this.#status.textContent = text === null ? word().compiling : word().noMistakes;
        this.#list.replaceChildren(
            ...(isEmpty ? [] : mistakes).slice(0, 50).map(({ from, line, column, text, help }) =>
                h(
                    "li",
                    {},
                    h(
                        "button",
                        { type: "button", onclick: () => this.#editor.go(from) },
                        h("span", { class: "place" }, word().place(line, column)),
                        h("span", {}, text),
                        help === null ? null : h("span", { class: "help" }, help),
                    ),
                ),
            ),
        );
    }
}
