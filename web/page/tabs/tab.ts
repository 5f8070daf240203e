// What every tab has in common: it computes while it is seen, and says so if what it shows is of an earlier choice.

import type { Answers, Kind, QuestionOf } from "../answers";
import { isRefusal } from "../answers";
import { h, set } from "../dom";
import type { Machine } from "../machine";
import type { Lane, Session } from "../session";
import { onLanguage, say, word } from "../words";

/** How long a computation about an earlier text goes on, in milliseconds: to start anew costs a compilation. */
const PATIENCE = 1000;

/** A result that took the module longer, in milliseconds, is not computed anew by itself at each move, unless it is live. */
const SLOW = 1500;

export abstract class Tab {
    readonly element = h("div", { class: "tab" });
    protected readonly machine: Machine;
    protected readonly session: Session;
    protected readonly why = h("p", { class: "why", role: "status", hidden: true });
    protected readonly stale = h("p", { class: "stale", hidden: true });
    protected readonly isLive: boolean = false;
    #isSeen = false;
    #key = "";
    #wanted = "";
    #isRunning = false;
    /** The text that is computed. */
    #text: string | null = null;
    #took = 0;

    constructor(machine: Machine, session: Session) {
        this.machine = machine;
        this.session = session;
        const again = h("button", { type: "button", onclick: () => void this.#compute() }, say((w) => w.again));
        this.stale.append(say((w) => w.old), " ", again);
        const refresh = (): void => this.refresh();
        machine.compiled.on(refresh);
        machine.moved.on(refresh);
        machine.motionFound.on(refresh);
        onLanguage(refresh);
    }

    /** What the result depends on; null if there is nothing to compute. */
    protected abstract key(): unknown[] | null;
    protected abstract compute(): Promise<boolean>;

    set seen(isSeen: boolean) {
        this.#isSeen = isSeen;
        if (isSeen) this.refresh();
    }

    refresh(): void {
        const { text, isOld } = this.machine;
        const key = this.key();
        if (key === null || text === null) return;
        this.#wanted = JSON.stringify([text, key]);
        const isStale = this.#wanted !== this.#key;
        const isLeft = isStale && this.#key !== "" && this.#took > SLOW && !this.isLive;
        set(this.element, "data-old", isLeft || isOld);
        this.stale.hidden = !isLeft;
        if (this.#isRunning && this.#text !== text) this.#hurry();
        if (this.#isSeen && isStale && !isLeft && !this.#isRunning) void this.#compute();
    }

    #hurry(): void {
        setTimeout(() => {
            const since = this.session.running?.since ?? Infinity;
            if (!this.#isRunning || this.#text === this.machine.text) return;
            if (performance.now() - since >= PATIENCE) this.session.stop(word().replaced);
            else this.#hurry();
        }, PATIENCE);
    }

    async #compute(): Promise<void> {
        if (this.#isRunning) return;
        this.#isRunning = true;
        this.#text = this.machine.text;
        const key = this.#wanted;
        const isDone = await this.compute();
        this.#isRunning = false;
        if (!isDone) return;
        this.#took = this.session.milliseconds;
        this.#key = key;
        this.refresh();
    }

    /** Asks; a refusal is shown in place of the answer. */
    protected async ask<K extends Kind>(make: () => QuestionOf<K>, lane: Lane = "tab"): Promise<Answers[K] | null | undefined> {
        const answer = await this.session.ask(lane, this.machine.text ?? "", make);
        if (answer === null) return undefined;
        this.why.hidden = !isRefusal(answer);
        if (isRefusal(answer)) {
            this.why.textContent = answer.why;
            return null;
        }
        return answer;
    }
}
