// A slider and a field of text for every input and every parameter.

import { h, set } from "./dom";
import { read, show, stepOf } from "./format";
import type { Machine } from "./machine";
import type { Parameter, Quantity } from "./protocol";
import { onLanguage, say, word } from "./words";

const TURN = 2 * Math.PI;

type Range = { least: number; largest: number };

export class Slider {
    readonly element: HTMLElement;
    readonly range = h("input", { type: "range" });
    readonly field: HTMLInputElement;
    readonly badge = h("span", { class: "badge" });
    #isAngle: boolean;
    #bounds: Range = { least: 0, largest: 1 };
    #value = 0;
    /** Somebody writes in the field. */
    #isEdited = false;

    constructor(quantity: Quantity & Partial<Pick<Parameter, "unit">>, set_: (value: number) => void) {
        this.#isAngle = quantity.is_angle;
        this.field = h("input", { type: "text", inputmode: "text", autocomplete: "off", class: "number" });
        const label = quantity.unit ? `${quantity.name} [${quantity.unit}]` : quantity.name;
        const name = h("span", { class: "name" }, label);
        this.element = h("div", { class: "slider" }, name, this.badge, this.field, this.range);
        set(this.range, "aria-label", quantity.name);
        set(this.field, "aria-label", word().value(quantity.name));
        this.range.addEventListener("input", () => set_(this.#clamp(Number(this.range.value))));
        this.range.addEventListener("change", () => this.show(this.#value));
        const take = (): void => {
            this.#isEdited = false;
            const value = read(this.field.value, this.#isAngle);
            set(this.field, "aria-invalid", value === null ? "true" : null);
            this.field.title = value === null ? word().notNumber : "";
            if (value !== null && show(value, this.#isAngle) !== show(this.#value, this.#isAngle)) set_(value);
        };
        this.field.addEventListener("input", () => (this.#isEdited = true));
        this.field.addEventListener("change", take);
        this.field.addEventListener("focus", () => this.field.select());
        this.field.addEventListener("keydown", (event) => {
            if (event.key === "Enter") take();
            if (event.key === "Escape") {
                this.#isEdited = false;
                this.show(this.#value);
            }
        });
    }

    /** The value is within the range, or somebody holds the thumb. */
    holds(value: number): boolean {
        const { min, max } = this.range;
        return max !== "" && ((Number(min) < value && value < Number(max)) || this.range.matches(":active"));
    }

    bound(bounds: Range): void {
        const { least, largest } = bounds;
        if (!(largest > least)) return;
        this.#bounds = bounds;
        const step = this.#isAngle ? Math.min(0.5 * (Math.PI / 180), (largest - least) / 100) : stepOf(largest - least);
        this.range.min = String(least);
        this.range.max = String(largest);
        this.range.step = String(step);
        this.show(this.#value);
    }

    show(value: number): void {
        this.#value = value;
        // A thumb that somebody holds stays where it is.
        if (!this.range.matches(":active")) this.range.value = String(value);
        const text = show(value, this.#isAngle);
        if (!this.#isEdited) {
            this.field.value = text;
            set(this.field, "aria-invalid", null);
        }
        set(this.range, "aria-valuetext", text);
        const { least, largest } = this.#bounds;
        const part = (Math.min(Math.max(value, least), largest) - least) / (largest - least);
        this.range.style.setProperty("--part", String(Number.isFinite(part) ? part : 0));
    }

    /** The range's last step may lie inside its end. */
    #clamp(value: number): number {
        const { least, largest } = this.#bounds;
        const step = Number(this.range.step);
        if (value > largest - step) return largest;
        return Math.max(value, least);
    }
}

export class SlidersView {
    readonly element = h("div", { class: "sliders" });
    #machine: Machine;
    #inputs: Slider[] = [];
    #parameters: Slider[] = [];
    #ends = h("p", { class: "ends" });
    #shape = "";
    /** Writes the values into the text. */
    onText: (() => void) | null = null;
    #actions: HTMLElement;

    constructor(machine: Machine) {
        this.#machine = machine;
        const reset = (): void => {
            const about = machine.about;
            if (about) void machine.move({ parameters: about.parameters.map(({ value }) => value) });
        };
        this.#actions = h(
            "div",
            { class: "actions" },
            h("button", { type: "button", class: "quiet", onclick: reset }, say((w) => w.reset)),
            h("button", { type: "button", class: "quiet", onclick: () => this.onText?.() }, say((w) => w.intoText)),
        );
        machine.compiled.on(() => this.#build());
        machine.moved.on(() => this.#update());
        machine.motionFound.on(() => this.#update());
        onLanguage(() => {
            this.#shape = "";
            this.#build();
        });
    }

    #build(): void {
        const machine = this.#machine;
        const about = machine.about;
        const shape = JSON.stringify([about?.name, about?.inputs, about?.parameters]);
        if (shape === this.#shape) return;
        this.#shape = shape;
        this.#inputs = (about?.inputs ?? []).map(
            (input, index) =>
                new Slider(input, (value) => {
                    void machine.move({ inputs: machine.target.inputs.with(index, value) });
                }),
        );
        this.#parameters = (about?.parameters ?? []).map((parameter, index) => {
            const slider = new Slider(parameter, (value) => {
                void machine.move({ parameters: machine.target.parameters.with(index, value) });
            });
            slider.bound(around(parameter, about?.parameters ?? []));
            return slider;
        });
        const sections = [
            this.#section(word().inputs, this.#inputs, this.#ends),
            this.#section(word().parameters, this.#parameters, this.#actions),
        ];
        this.element.replaceChildren(...sections.filter((section) => section !== null));
        this.#update();
    }

    #section(title: string, sliders: Slider[], last: HTMLElement): HTMLElement | null {
        if (sliders.length === 0) return null;
        return h("section", {}, h("h2", {}, title), ...sliders.map((slider) => slider.element), last);
    }

    #update(): void {
        const { about, target, motion, at } = this.#machine;
        if (about === null) return;
        about.inputs.forEach((input, index) => {
            const slider = this.#inputs[index];
            const value = target.inputs[index] ?? 0;
            if (!slider) return;
            const turns = Math.floor(value / TURN + 1e-9);
            const isLimited = motion !== null && !motion.turns && index === this.#machine.show.along;
            if (isLimited) {
                slider.bound({ least: motion.least, largest: motion.largest });
            } else if (input.is_angle) {
                // The end of a turn belongs to it while the thumb is there.
                const isEnd = Math.abs(value - TURN * turns) < 1e-9 && Number(slider.range.max) > value - 1e-9 && turns > 0 && Number(slider.range.min) < value - 1;
                const base = TURN * (isEnd ? turns - 1 : turns);
                slider.bound({ least: base, largest: base + TURN });
            } else if (at !== null && !slider.holds(value)) {
                const size = Math.max(Math.abs(value), scale(about.parameters));
                slider.bound({ least: value - size, largest: value + size });
            }
            slider.badge.textContent = input.is_angle && !isLimited && turns !== 0 ? word().turn(turns > 0 ? turns + 1 : turns) : "";
            slider.show(value);
        });
        about.parameters.forEach((parameter, index) => {
            const slider = this.#parameters[index];
            const value = target.parameters[index] ?? parameter.value;
            slider?.show(value);
            set(slider?.element as Element, "data-moved", value !== parameter.value);
        });
        const isMoved = about.parameters.some(({ value }, index) => value !== target.parameters[index]);
        this.#actions.hidden = !isMoved;
        const limits = motion !== null && at !== null && !motion.turns ? [motion.least, motion.largest] : [];
        const ends = limits.flatMap((limit, index) => {
            const why = motion?.ends[index];
            return why ? [`${show(limit, motion?.is_angle)}: ${word().limit(why)}`] : [];
        });
        this.#ends.replaceChildren(...ends.map((end) => h("span", {}, end)));
        this.#ends.hidden = ends.length === 0;
        this.#inputs[this.#machine.show.along]?.element.after(this.#ends);
    }
}

function scale(parameters: Parameter[]): number {
    return Math.max(...parameters.filter((parameter) => !parameter.is_angle).map(({ value }) => Math.abs(value)), 0) || 1;
}

/** From zero to twice the value, or about zero. */
export function around(parameter: Parameter, all: Parameter[]): Range {
    const { value, is_angle } = parameter;
    if (is_angle) return { least: value - Math.PI / 2, largest: value + Math.PI / 2 };
    if (value === 0) return { least: -scale(all), largest: scale(all) };
    return value > 0 ? { least: 0, largest: 2 * value } : { least: 2 * value, largest: 0 };
}
