// The simulation of a scene: its motion in time, played, and its charts.

import type { Answers } from "../answers";
import { isRefusal } from "../answers";
import { fill, h, set } from "../dom";
import { read, show } from "../format";
import { Island } from "../island";
import type { Machine } from "../machine";
import type { Simulated } from "../protocol";
import type { Session } from "../session";
import { around, Slider } from "../sliders";
import { chartStyles, pictureStyles } from "../styles";
import { onLanguage, say, word } from "../words";
import { Tab } from "./tab";

const STEPS = 400;
const SPEEDS = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2];

type Settings = { scene: number; to: number; tolerance: number; values: number[]; rates: number[] };

export class SimulationTab extends Tab {
    #pictures: Session;
    #settings: Settings = { scene: 0, to: 2, tolerance: 1e-8, values: [], rates: [] };
    #form = h("form", { class: "settings" });
    #none = h("p", { class: "empty" });
    #results = h("div", { class: "results" });
    #island = new Island("picture", pictureStyles);
    #button = h("button", { type: "button", class: "primary play", onclick: () => this.#toggle() });
    #scrub = h("input", { type: "range", min: 0, step: "any" });
    #clock = h("output", { class: "clock" });
    #speed = h("select");
    #player: HTMLElement;
    #lines = h("ul", { class: "events", lang: "en" });
    #charts = h("div");
    #simulated: Simulated | null = null;
    /** The position that the simulation began at. */
    #base: { mechanism: number; parameters: number[] } | null = null;
    #text: string | null = null;
    #earlier = h("p", { class: "stale", hidden: true }, say((w) => w.old));
    #time = 0;
    #isPlaying = false;
    #frame = -1;
    #shape = "";

    constructor(machine: Machine, session: Session, pictures: Session) {
        super(machine, session);
        this.#pictures = pictures;
        for (const speed of SPEEDS) this.#speed.append(h("option", { value: speed, selected: speed === 1 }, `× ${speed}`));
        const speed = h("label", {}, h("span", {}, say((w) => w.speed)), this.#speed);
        this.#player = h("div", { class: "player" }, this.#button, this.#scrub, this.#clock, speed);
        this.#results.append(this.#earlier, h("div", { class: "film" }, this.#island.element), this.#player, this.#lines, this.#charts);
        this.#results.hidden = true;
        this.element.append(h("div", { class: "page wide" }, this.#none, this.#form, this.why, this.#results));
        this.#scrub.addEventListener("input", () => {
            this.#isPlaying = false;
            this.#go(Number(this.#scrub.value));
        });
        this.#form.addEventListener("submit", (event) => {
            event.preventDefault();
            void this.#run();
        });
        machine.compiled.on(() => this.#build());
        machine.moved.on(() => this.#age());
        onLanguage((words) => {
            this.#shape = "";
            set(this.#scrub, "aria-label", words.time);
            set(this.#island.element, "aria-label", words.picture);
            this.#build();
            this.#label();
        });
    }

    get settings(): Settings {
        return this.#settings;
    }
    set settings(settings: Partial<Settings>) {
        this.#settings = { ...this.#settings, ...settings };
        this.#shape = "";
        this.#build();
    }

    /** It runs when it is asked to. */
    protected key(): null {
        return null;
    }
    protected compute(): Promise<boolean> {
        return Promise.resolve(true);
    }

    /** Stops playing while another tab is seen. */
    rest(): void {
        this.#isPlaying = false;
        this.#label();
    }

    #build(): void {
        const { about } = this.machine;
        const shape = JSON.stringify([this.machine.index, about?.name, about?.scenes, about?.inputs]);
        if (shape === this.#shape) return;
        this.#shape = shape;
        const scenes = about?.scenes ?? [];
        this.#none.hidden = scenes.length > 0;
        this.#none.textContent = word().noScenes;
        this.#form.hidden = scenes.length === 0;
        this.rest();
        const settings = this.#settings;
        if (settings.scene >= scenes.length) settings.scene = 0;
        const scene = scenes[settings.scene];
        if (about === null || scene === undefined) return;
        if (settings.values.length !== scene.parameters.length) settings.values = scene.parameters.map(({ value }) => value);
        if (settings.rates.length !== about.inputs.length) settings.rates = about.inputs.map(() => 0);
        const select = h("select", {
            onchange: () => {
                settings.scene = select.selectedIndex;
                settings.values = [];
                this.#shape = "";
                this.#build();
            },
        });
        scenes.forEach(({ name }, index) => select.append(h("option", { selected: index === settings.scene }, name)));
        const field = (label: string, value: string, unit: string, take: (value: number) => void, isAngle = false): HTMLElement => {
            const input = h("input", { type: "text", class: "number", value, autocomplete: "off" });
            input.addEventListener("change", () => {
                const number = read(input.value, isAngle);
                set(input, "aria-invalid", number === null ? "true" : null);
                if (number !== null) take(number);
            });
            return h("label", {}, h("span", {}, label), input, unit === "" ? null : h("span", { class: "unit" }, unit));
        };
        const sliders = scene.parameters.map((parameter, index) => {
            const slider = new Slider(parameter, (value) => {
                settings.values[index] = value;
                slider.show(value);
            });
            slider.bound(around(parameter, scene.parameters));
            slider.show(settings.values[index] ?? parameter.value);
            return slider.element;
        });
        fill(
            this.#form,
            h("label", {}, h("span", {}, word().scene), select),
            field(word().until, show(settings.to), word().seconds, (value) => (settings.to = value)),
            field(word().tolerance, show(settings.tolerance), "", (value) => (settings.tolerance = value)),
            ...about.inputs.map((input, index) =>
                field(`${input.name}′`, show(settings.rates[index] ?? 0), input.is_angle ? "rad/s" : "/s", (value) => (settings.rates[index] = value)),
            ),
            h("button", { type: "submit", class: "primary", disabled: !scene.simulates }, word().run),
            h("p", { class: "soft" }, scene.simulates ? word().fromHere : word().notSimulated),
            scene.parameters.length === 0
                ? null
                : h("details", {}, h("summary", {}, word().sceneParameters), h("div", { class: "values" }, ...sliders)),
        );
    }

    async #run(): Promise<void> {
        const { at, about } = this.machine;
        if (at === null || about === null) return;
        const { scene, values, rates, to, tolerance } = this.#settings;
        this.rest();
        const answer = await this.ask<"simulate">(() => ({ do: "simulate", ...at, scene, values, rates, to, tolerance, steps: STEPS }));
        if (!answer) {
            if (answer === null) this.#results.hidden = true;
            return;
        }
        this.#base = { mechanism: at.mechanism, parameters: at.parameters };
        this.#text = this.machine.text;
        this.#take(answer);
    }

    /** The results may be of an earlier text, or of other parameters. */
    #age(): void {
        const { at, text, isOld } = this.machine;
        const isOther = JSON.stringify([at?.mechanism, at?.parameters]) !== JSON.stringify([this.#base?.mechanism, this.#base?.parameters]);
        const isEarlier = isOld || text !== this.#text || isOther;
        this.#earlier.hidden = !isEarlier;
        set(this.#results, "data-old", isEarlier);
    }

    #take(simulated: Simulated): void {
        this.#simulated = simulated;
        this.#results.hidden = false;
        this.#age();
        this.#lines.replaceChildren(...simulated.lines.map((line) => h("li", {}, line)));
        this.#charts.replaceChildren(
            ...simulated.sections.map(({ heading, charts }) =>
                h(
                    "section",
                    {},
                    h("h2", {}, heading),
                    h(
                        "div",
                        { class: "charts" },
                        ...charts.map((svg) => {
                            const island = new Island("chart", chartStyles);
                            island.svg(svg);
                            return h("figure", {}, island.element);
                        }),
                    ),
                ),
            ),
        );
        set(this.#scrub, "max", simulated.times.at(-1) ?? 0);
        set(this.#scrub, "min", simulated.times[0] ?? 0);
        this.#frame = -1;
        this.#go(simulated.times[0] ?? 0);
        this.#label();
    }

    /** The table of the last simulation. */
    get csv(): string | null {
        return this.#simulated?.csv ?? null;
    }

    #label(): void {
        this.#button.textContent = this.#isPlaying ? word().pause : word().play;
    }

    #toggle(): void {
        const times = this.#simulated?.times;
        if (!times?.length) return;
        this.#isPlaying = !this.#isPlaying;
        this.#label();
        if (!this.#isPlaying) return;
        const [first, last] = [times[0] ?? 0, times.at(-1) ?? 0];
        if (this.#time >= last) this.#time = first;
        let before = performance.now();
        const step = (now: number): void => {
            if (!this.#isPlaying) return;
            const elapsed = ((now - before) / 1000) * Number(this.#speed.value);
            before = now;
            this.#go(Math.min(this.#time + elapsed, last));
            if (this.#time >= last) this.rest();
            else requestAnimationFrame(step);
        };
        requestAnimationFrame(step);
    }

    /** Shows the last frame at or before a time. */
    #go(time: number): void {
        const simulated = this.#simulated;
        if (simulated === null) return;
        this.#time = time;
        this.#scrub.value = String(time);
        this.#clock.value = `${show(Number(time.toFixed(3)))} s`;
        set(this.#scrub, "aria-valuetext", this.#clock.value);
        let frame = 0;
        let end = simulated.times.length;
        while (end - frame > 1) {
            const middle = (frame + end) >> 1;
            if ((simulated.times[middle] ?? Infinity) <= time) frame = middle;
            else end = middle;
        }
        if (frame !== this.#frame) {
            this.#frame = frame;
            void this.#draw(simulated, frame);
        }
    }

    async #draw(simulated: Simulated, frame: number): Promise<void> {
        const place = simulated.places[frame];
        const base = this.#base;
        if (place === undefined || base === null) return;
        const text = this.#text ?? "";
        const question = { do: "picture", ...base, place, show: this.machine.show } as const;
        const answer: Answers["picture"] | { why: string } | null = await this.#pictures.ask("move", text, () => question);
        if (answer !== null && !isRefusal(answer) && simulated === this.#simulated) this.#island.svg(answer.picture.svg);
    }
}
