// All positions at these inputs, drawn small: a choice of one.

import type { Position } from "./answers";
import { isRefusal } from "./answers";
import { h, set } from "./dom";
import { Island } from "./island";
import type { Machine } from "./machine";
import type { Session } from "./session";
import { settled } from "./signal";
import { smallStyles } from "./styles";
import { onLanguage, say, word } from "./words";

/** Two positions nearer than this are one, where others are left out: relative, summed over the unknowns. */
const SAME = 1e-6;

export class PositionsView {
    readonly element: HTMLElement;
    #machine: Machine;
    #session: Session;
    #list = h("div", { class: "positions", role: "radiogroup" });
    #left = h("p", { class: "why" }, say((w) => w.morePositions));
    #islands: Island[] = [];
    #positions: Position[] = [];
    #more = false;
    #key = "";
    #ask = settled(200, () => void this.#find());

    constructor(machine: Machine, session: Session) {
        this.#machine = machine;
        this.#session = session;
        this.element = h("section", { class: "choices" }, h("h2", {}, say((w) => w.positions)), this.#list, this.#left);
        this.#list.addEventListener("keydown", (event) => this.#key_(event));
        machine.moved.on(() => {
            this.#mark();
            this.#ask.soon();
        });
        onLanguage((words) => {
            set(this.#list, "aria-label", words.positionsHint);
            this.#render();
        });
    }

    async #find(): Promise<void> {
        const { text, at, isOld } = this.#machine;
        if (text === null || at === null || isOld) {
            if (at === null) {
                this.#positions = [];
                this.#key = "";
                this.#render();
            }
            return;
        }
        const { mechanism, parameters, place } = at;
        const key = JSON.stringify([text, mechanism, parameters, place.inputs]);
        if (key === this.#key) return;
        const question = { do: "positions", mechanism, parameters, inputs: place.inputs } as const;
        const answer = await this.#session.ask("positions", text, () => question);
        if (answer === null) return;
        this.#key = key;
        [this.#positions, this.#more] = isRefusal(answer) ? [[], false] : [answer.positions, answer.more];
        this.#render();
    }

    #render(): void {
        const positions = this.#positions;
        this.element.hidden = positions.length === 0;
        this.#left.hidden = !this.#more;
        while (this.#islands.length < positions.length) this.#islands.push(new Island("small", smallStyles));
        // Buttons stay, so that the focus does.
        while (this.#list.children.length > positions.length) this.#list.lastElementChild?.remove();
        positions.forEach((position, index) => {
            const island = this.#islands[index] as Island;
            island.svg(position.svg);
            let button = this.#list.children[index];
            if (button === undefined) {
                button = h("button", { type: "button", role: "radio", onclick: () => this.#take(index) }, island.element, h("span"));
                this.#list.append(button);
            }
            const name = position.branch === "" ? word().onlyPosition : position.branch;
            (button.lastElementChild as HTMLElement).textContent = name;
            set(button, "aria-label", word().position(name));
            set(button, "title", name);
        });
        this.#mark();
    }

    #take(index: number): void {
        const position = this.#positions[index];
        const at = this.#machine.at;
        if (position && at) void this.#machine.take({ inputs: at.place.inputs, unknowns: position.unknowns });
    }

    /** Marks the position that the picture shows, if it is not left out; angles count turns, here they do not. */
    #mark(): void {
        const { at, about } = this.#machine;
        let chosen = -1;
        let least = Infinity;
        if (at !== null && about !== null) {
            this.#positions.forEach((position, index) => {
                const distance = position.unknowns.reduce((sum, value, which) => {
                    const difference = value - (at.place.unknowns[which] ?? 0);
                    const size = about.unknowns[which]?.is_angle ? Math.abs(Math.sin(difference / 2)) : Math.abs(difference);
                    return sum + size / (1 + Math.abs(value));
                }, 0);
                if (distance < (this.#more ? Math.min(least, SAME) : least)) [least, chosen] = [distance, index];
            });
        }
        [...this.#list.children].forEach((button, index) => {
            set(button, "aria-checked", index === chosen ? "true" : "false");
            set(button, "tabindex", index === Math.max(chosen, 0) ? 0 : -1);
        });
    }

    #key_(event: KeyboardEvent): void {
        const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
        if (step === undefined) return;
        const buttons = [...this.#list.children] as HTMLElement[];
        const now = buttons.findIndex((button) => button.matches(":focus"));
        const next = (now + step + buttons.length) % buttons.length;
        event.preventDefault();
        buttons[next]?.focus();
        this.#take(next);
    }
}
