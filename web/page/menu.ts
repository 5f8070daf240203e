// A button that opens a list of actions: arrows choose, Escape closes.

import { freshId, h, set } from "./dom";
import { onLanguage, say, type Words } from "./words";

export type Item = { label: (words: Words) => string; more?: (words: Words) => string; isChosen?: () => boolean; act: () => void };

export function menu(label: (words: Words) => string, items: Item[], kind = "", name = label): HTMLElement {
    const id = freshId("menu");
    const list = h("div", { class: "items", role: "menu", id, hidden: true });
    const button = h("button", { type: "button", class: "quiet", "aria-haspopup": "menu", "aria-expanded": "false", "aria-controls": id }, say(label));
    const element = h("div", { class: `menu ${kind}` }, button, list);
    const buttons = items.map((item) => {
        const row = h("button", { type: "button", role: item.isChosen ? "menuitemradio" : "menuitem", tabindex: -1 }, h("b", {}, say(item.label)));
        if (item.more) row.append(h("span", {}, say(item.more)));
        row.addEventListener("click", () => {
            close(true);
            item.act();
        });
        return row;
    });
    list.append(...buttons);
    onLanguage((words) => {
        set(list, "aria-label", name(words));
        set(button, "aria-label", name === label ? null : `${name(words)}: ${label(words)}`);
    });

    function outside(event: Event): void {
        if (!element.contains(event.target as Node)) close(false);
    }
    function open(at: number): void {
        list.hidden = false;
        set(button, "aria-expanded", "true");
        items.forEach((item, index) => {
            const row = buttons[index];
            if (row && item.isChosen) set(row, "aria-checked", item.isChosen() ? "true" : "false");
        });
        // A list that would leave the window on the right ends there.
        list.style.translate = "";
        const over = list.getBoundingClientRect().right + 8 - document.documentElement.clientWidth;
        if (over > 0) list.style.translate = `${-over}px 0`;
        buttons.at(at)?.focus();
        addEventListener("pointerdown", outside, true);
    }
    function close(isBack: boolean): void {
        list.hidden = true;
        set(button, "aria-expanded", "false");
        removeEventListener("pointerdown", outside, true);
        if (isBack) button.focus();
    }
    button.addEventListener("click", () => (list.hidden ? open(0) : close(true)));
    button.addEventListener("keydown", (event) => {
        if (event.key === "ArrowDown" || event.key === "ArrowUp") {
            event.preventDefault();
            open(event.key === "ArrowDown" ? 0 : -1);
        }
    });
    list.addEventListener("keydown", (event) => {
        const now = buttons.findIndex((row) => row === document.activeElement);
        const next = { ArrowDown: now + 1, ArrowUp: now - 1, Home: 0, End: buttons.length - 1 }[event.key];
        if (next !== undefined) {
            event.preventDefault();
            buttons.at(next % buttons.length)?.focus();
        } else if (event.key === "Escape" || event.key === "Tab") {
            close(event.key === "Escape");
        }
    });
    return element;
}
