// The mechanism that the page shows: the last text without mistakes, the values chosen, and the position that was reached.

import type { Motion } from "./answers";
import { isRefusal } from "./answers";
import { show as shown } from "./format";
import type { About, At, Mistake, Moved, Place, Refusal, Show } from "./protocol";
import type { Session } from "./session";
import { Signal, settled } from "./signal";
import { languageOf, onLanguage, word } from "./words";

/** Values by name, as a link has them. */
export type Wanted = {
    mechanism?: string | undefined;
    parameters?: Record<string, number> | undefined;
    inputs?: number[] | undefined;
    unknowns?: number[] | undefined;
};

/** What is asked for: the sliders show it, also where no position has it. */
export type Target = { parameters: number[]; inputs: number[] };

const STEPS = 180;

export class Machine {
    /** Other mistakes, or other mechanisms. */
    readonly compiled = new Signal();
    /** Another position, another word, or none. */
    readonly moved = new Signal();
    readonly motionFound = new Signal();

    mistakes: Mistake[] = [];
    /** Why the text cannot be read at all. */
    unreadable: string | null = null;
    text: string | null = null;
    mechanisms: About[] = [];
    index = 0;
    target: Target = { parameters: [], inputs: [] };
    at: At | null = null;
    last: Moved | null = null;
    /** Why there is no picture of the target. */
    why: string | null = null;
    /** Where the motion stopped, or a word about the link. */
    note: (() => string) | null = null;
    motion: Motion | null = null;
    show: Show = { traces: true, velocities: false, accelerations: false, along: 0, rate: 1, language: languageOf() };
    /** True while the text has mistakes. */
    isOld = false;

    #session: Session;
    #asked = 0;
    #follow = settled(250, () => void this.#findMotion());

    constructor(session: Session) {
        this.#session = session;
        onLanguage(({ code }) => {
            if (code !== this.show.language) void this.draw({ language: code });
        });
    }

    get about(): About | null {
        return this.mechanisms[this.index] ?? null;
    }

    /** Reads a text; `wanted` is what a link asks for. */
    async compile(text: string, wanted: Wanted = {}): Promise<void> {
        const answer = await this.#session.compile(text);
        if (answer === null) return;
        this.unreadable = null;
        this.mistakes = [];
        if (isRefusal(answer)) {
            this.unreadable = answer.why;
            this.isOld = true;
        } else if ("mistakes" in answer) {
            this.mistakes = answer.mistakes;
            this.isOld = true;
        } else {
            this.#take(text, answer.mechanisms, wanted);
            return;
        }
        this.compiled.emit();
        this.moved.emit();
    }

    choose(index: number): void {
        this.#begin(index, null, {});
    }

    /** Asks for other values; the motion is followed there. */
    async move(to: Partial<Target>): Promise<void> {
        this.target = { ...this.target, ...to };
        const { text } = this;
        if (text === null) return;
        if (this.at === null) {
            await this.#beginAt(this.target.parameters);
            return;
        }
        const isDesign = to.parameters !== undefined;
        const target = this.target;
        this.#asked += 1;
        const asked = this.#asked;
        const answer = await this.#session.ask("move", text, () => ({
            do: "follow",
            ...(this.at as At),
            to: target,
            show: this.show,
        }));
        this.#accept(answer, isDesign, asked === this.#asked);
        if (isDesign && answer !== null && !isRefusal(answer) && answer.stopped !== null && asked === this.#asked) {
            await this.#explain(text, target.parameters);
        }
    }

    /** Parameters were followed up to where no position has them: the reason is that of their own position. */
    async #explain(text: string, parameters: number[]): Promise<void> {
        const { index, show } = this;
        const asked = this.#asked;
        const answer = await this.#session.ask("draw", text, () => ({ do: "begin", mechanism: index, parameters, show }));
        if (answer === null || !isRefusal(answer) || asked !== this.#asked) return;
        this.note = () => answer.why;
        this.moved.emit();
    }

    /** Moves the input that leads a joint nearest to a place of the plane. */
    async drag(joint: string, to: [number, number]): Promise<void> {
        const { text } = this;
        this.#asked += 1;
        const asked = this.#asked;
        if (text === null || this.at === null) return;
        const answer = await this.#session.ask("move", text, () => ({
            do: "drag",
            ...(this.at as At),
            joint,
            to,
            show: this.show,
        }));
        this.#accept(answer, false, asked === this.#asked);
    }

    /** Takes another position at the same inputs. */
    async take(place: Place): Promise<void> {
        const { text, at } = this;
        if (text === null) return;
        const base = at ?? { mechanism: this.index, parameters: this.target.parameters, place };
        const answer = await this.#session.ask("move", text, () => ({ do: "picture", ...base, place, show: this.show }));
        this.#accept(answer, true);
    }

    /** Draws the same position in another way. */
    async draw(show: Partial<Show>): Promise<void> {
        const isOther = show.along !== undefined && show.along !== this.show.along;
        this.show = { ...this.show, ...show };
        if (isOther) this.#forget();
        await this.#redraw();
    }

    async #redraw(): Promise<void> {
        const { text } = this;
        if (text === null || this.at === null) return;
        const asked = this.#asked;
        const answer = await this.#session.ask("draw", text, () => ({ do: "picture", ...(this.at as At), show: this.show }));
        if (answer === null || isRefusal(answer)) return;
        // The word about the last motion holds for its other drawings too.
        const isSame = asked === this.#asked;
        this.#accept(answer, false, isSame, isSame ? this.note : null);
    }

    #take(text: string, mechanisms: About[], wanted: Wanted): void {
        const before = this.about;
        const previous = { at: this.at, about: before, target: this.target };
        this.text = text;
        this.mechanisms = mechanisms;
        this.isOld = false;
        const name = wanted.mechanism ?? before?.name;
        const index = Math.max(0, mechanisms.findIndex((about) => about.name === name));
        this.#begin(index, previous, wanted);
    }

    #begin(index: number, previous: { at: At | null; about: About | null; target: Target } | null, wanted: Wanted): void {
        this.index = index;
        const about = this.about;
        this.note = null;
        this.why = null;
        this.at = null;
        this.last = null;
        this.#forget();
        if (about === null) {
            this.compiled.emit();
            this.moved.emit();
            return;
        }
        const isSame = previous?.about != null && shape(previous.about) === shape(about);
        // A value that was moved stays, unless the text gives this parameter another one.
        const parameters = about.parameters.map((parameter, at) => {
            const asked = wanted.parameters?.[parameter.name];
            if (asked !== undefined) return asked;
            const old = isSame ? previous.about?.parameters[at] : undefined;
            return old?.value === parameter.value ? (previous?.target.parameters[at] ?? parameter.value) : parameter.value;
        });
        if (this.show.along >= about.inputs.length) this.show = { ...this.show, along: 0 };
        this.target = { parameters, inputs: about.inputs.map(() => 0) };
        this.compiled.emit();
        if (about.refusal !== null) {
            this.why = about.refusal;
            this.moved.emit();
        } else if (wanted.inputs?.length === about.inputs.length && wanted.unknowns?.length === about.unknowns.length) {
            void this.#beginAtLink(parameters, { inputs: wanted.inputs, unknowns: wanted.unknowns });
        } else if (isSame && previous?.at) {
            void this.#goOn({ ...previous.at, mechanism: index }, { parameters, inputs: previous.target.inputs });
        } else {
            void this.#beginAt(parameters);
        }
    }

    async #beginAt(parameters: number[], near?: Place): Promise<void> {
        const { text, index, show } = this;
        if (text === null) return;
        const answer = await this.#session.ask("move", text, () => ({ do: "begin", mechanism: index, parameters, ...(near && { near }), show }));
        this.#accept(answer, true);
    }

    async #beginAtLink(parameters: number[], place: Place): Promise<void> {
        const { text, index, show } = this;
        if (text === null) return;
        const question = { do: "picture", mechanism: index, parameters, place, show } as const;
        const answer = await this.#session.ask("move", text, () => question);
        if (answer !== null && isRefusal(answer)) {
            await this.#beginAt(parameters);
            this.note = () => word().linkPlace;
            this.moved.emit();
        } else {
            this.#accept(answer, true);
        }
    }

    /**
     * The text changed, but not its coordinates: the position goes along. Where it does not reach the values of the text, another
     * one is taken that has them, and a word says so: the page shows the mechanism of the text, or none.
     */
    async #goOn(from: At, to: Target): Promise<void> {
        const { text, show } = this;
        if (text === null) return;
        this.target = to;
        const answer = await this.#session.ask("move", text, () => ({ do: "follow", ...from, to, show }));
        if (answer === null) return;
        const isThere = !isRefusal(answer) && answer.parameters.every((value, at) => value === to.parameters[at]);
        if (isThere) {
            this.#accept(answer, true);
            return;
        }
        this.target = to;
        await this.#beginAt(to.parameters, from.place);
        if (this.why !== null || this.text !== text) return;
        this.note = () => word().jumped;
        this.moved.emit();
    }

    /** `isNew` if another motion goes through the position; `isNewest` if nothing else is asked for meanwhile. */
    #accept(answer: Moved | Refusal | null, isNew: boolean, isNewest = true, note: Machine["note"] = null): void {
        if (answer === null) return;
        if (isRefusal(answer)) {
            this.why = answer.why;
            this.note = null;
        } else {
            this.why = null;
            this.note = this.#words(answer) ?? note;
            this.last = answer;
            this.at = { mechanism: answer.mechanism, parameters: answer.parameters, place: answer.place };
            if (isNewest) this.target = { parameters: answer.parameters, inputs: answer.place.inputs };
            if (isNew || this.motion === null) this.#follow.soon();
        }
        this.moved.emit();
    }

    /** Where and why a motion stopped, in words; null if it did not. */
    #words({ stopped, place }: Moved): (() => string) | null {
        if (stopped === null) return null;
        const input = stopped.input === null ? undefined : this.about?.inputs[stopped.input];
        if (input === undefined) return () => word().parametersStop(word().limit(stopped));
        const value = shown(place.inputs[stopped.input ?? 0] ?? NaN, input.is_angle);
        return () => word().inputStops(input.name, value, word().limit(stopped));
    }

    #forget(): void {
        this.motion = null;
        this.#follow.never();
    }

    async #findMotion(): Promise<void> {
        const { text } = this;
        if (text === null || this.at === null) return;
        const { along, rate } = this.show;
        const answer = await this.#session.ask("motion", text, () => ({
            do: "motion",
            ...(this.at as At),
            along,
            rate,
            steps: STEPS,
        }));
        if (answer === null || isRefusal(answer)) return;
        this.motion = answer;
        this.motionFound.emit();
        if (this.show.traces) await this.#redraw();
    }
}

/** Two texts of the same shape have the same coordinates and parameters. */
function shape(about: About): string {
    const names = (list: { name: string }[]): string[] => list.map(({ name }) => name);
    return JSON.stringify([about.name, names(about.parameters), names(about.inputs), names(about.unknowns)]);
}
