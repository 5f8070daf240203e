// A place for drawings and sheets of the module, in a shadow root: their styles and those of the page do not meet.

import { cleanHtml, cleanSvg, type Cleaned } from "./clean";
import { h } from "./dom";
import { patch } from "./patch";
import { sheetOf } from "./theme";

export class Island {
    readonly element: HTMLElement;
    readonly body = h("div", { class: "body" });
    #root: ShadowRoot;
    #own: CSSStyleSheet[];

    constructor(kind: string, styles: string[]) {
        this.element = h("div", { class: `island ${kind}` });
        this.#root = this.element.attachShadow({ mode: "open" });
        this.#own = [":host{display:block}", ...styles].map(sheetOf);
        this.#root.adoptedStyleSheets = this.#own;
        this.#root.append(this.body);
        this.#root.addEventListener("click", (event) => this.#follow(event));
    }

    /** Shows the content of an HTML page, changing what is there in place. */
    html(text: string): void {
        this.#take(cleanHtml(text));
    }

    /** Shows one drawing; false if the text is none. */
    svg(text: string): boolean {
        const cleaned = cleanSvg(text);
        if (cleaned !== null) this.#take(cleaned);
        return cleaned !== null;
    }

    clear(): void {
        this.body.replaceChildren();
    }

    #take({ content, styles }: Cleaned): void {
        const wanted = [...this.#own, ...styles.map(sheetOf)];
        const there = this.#root.adoptedStyleSheets;
        if (wanted.length !== there.length || wanted.some((sheet, index) => sheet !== there[index])) {
            this.#root.adoptedStyleSheets = wanted;
        }
        patch(this.body, content);
    }

    /** A link to a place of the same sheet: a fragment of the page's address does not reach into a shadow root. */
    #follow(event: Event): void {
        const link = (event.target as Element).closest("a");
        const href = link?.getAttribute("href");
        if (!href?.startsWith("#")) return;
        event.preventDefault();
        const target = this.#root.getElementById(href.slice(1));
        for (const marked of this.#root.querySelectorAll(".target")) marked.classList.remove("target");
        target?.classList.add("target");
        target?.scrollIntoView({ block: "center" });
    }
}
