// The numbers of this position: values, rates and accelerations.

import { h } from "./dom";
import { show } from "./format";
import type { Machine } from "./machine";
import { patch } from "./patch";
import { onLanguage, word } from "./words";

export class NumbersView {
    readonly element = h("section", { class: "numbers" });
    #machine: Machine;

    constructor(machine: Machine) {
        this.#machine = machine;
        machine.moved.on(() => this.#show());
        onLanguage(() => this.#show());
    }

    #show(): void {
        const numbers = this.#machine.last?.numbers ?? [];
        this.element.hidden = numbers.length === 0;
        const words = word();
        const head = [words.name, words.valueHead, words.rateHead, words.accelerationHead].map((text) => h("th", { scope: "col" }, text));
        const rows = numbers.map(({ name, is_angle, value, rate, acceleration }) =>
            h(
                "tr",
                {},
                h("th", { scope: "row" }, name),
                h("td", {}, show(value, is_angle, 5)),
                h("td", {}, show(rate, false, 4)),
                h("td", {}, show(acceleration, false, 4)),
            ),
        );
        const table = h("table", {}, h("thead", {}, h("tr", {}, ...head)), h("tbody", {}, ...rows));
        const fresh = h("section", {}, h("h2", {}, words.numbers), h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": words.numbers }, table));
        patch(this.element, fresh);
    }
}
