// What the picture shows: traces, velocities and accelerations, the input that moves and its rate.

import { h, set } from "./dom";
import { read, show } from "./format";
import type { Machine } from "./machine";
import { onLanguage, say, word, type Words } from "./words";

type Flag = "traces" | "velocities" | "accelerations";

export class Toolbar {
    readonly element: HTMLElement;
    #machine: Machine;
    #flags = new Map<Flag, HTMLButtonElement>();
    #along = h("select");
    #rate = h("input", { type: "text", class: "number", autocomplete: "off" });
    #unit = h("span", { class: "unit" });

    constructor(machine: Machine) {
        this.#machine = machine;
        const flag = (name: Flag, label: (w: Words) => string): HTMLElement => {
            const toggle = (): void => {
                void machine.draw({ [name]: !machine.show[name] });
                this.update();
            };
            const button = h("button", { type: "button", class: `chip ${name}`, onclick: toggle }, say(label));
            this.#flags.set(name, button);
            return button;
        };
        const along = h("label", {}, h("span", {}, say((w) => w.along)), this.#along);
        this.element = h(
            "div",
            { class: "toolbar", role: "group" },
            flag("traces", (w) => w.traces),
            flag("velocities", (w) => w.velocities),
            flag("accelerations", (w) => w.accelerations),
            h("span", { class: "gap" }),
            along,
            h("label", {}, h("span", {}, say((w) => w.rate)), this.#rate, this.#unit),
        );
        this.#along.addEventListener("change", () => {
            void machine.draw({ along: this.#along.selectedIndex });
            this.update();
        });
        this.#rate.addEventListener("change", () => {
            const rate = read(this.#rate.value);
            set(this.#rate, "aria-invalid", rate === null ? "true" : null);
            if (rate !== null) void machine.draw({ rate });
            this.update();
        });
        machine.compiled.on(() => this.update());
        onLanguage((words) => {
            set(this.element, "aria-label", words.show);
            set(this.#rate, "aria-label", words.rateHead);
        });
        this.update();
    }

    update(): void {
        const { about, show: shown } = this.#machine;
        for (const [name, button] of this.#flags) set(button, "aria-pressed", shown[name] ? "true" : "false");
        const inputs = about?.inputs ?? [];
        this.#along.replaceChildren(...inputs.map(({ name }, index) => h("option", { selected: index === shown.along }, name)));
        (this.#along.parentElement as HTMLElement).hidden = inputs.length < 2;
        if (!this.#rate.matches("[aria-invalid]")) this.#rate.value = show(shown.rate);
        this.#unit.textContent = inputs[shown.along]?.is_angle === false ? word().perSecond : "rad/s";
    }
}
