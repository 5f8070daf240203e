// What is being computed, how far it is, and a button that stops it.

import { h, set } from "./dom";
import type { Session } from "./session";
import { say, word } from "./words";

/** Shorter work is not worth a word. */
const PATIENCE = 400;

export class WorkView {
    readonly element: HTMLElement;
    #sessions: Session[];
    #label = h("span");
    #bar = h("progress", { max: 1 });
    #timer: ReturnType<typeof setTimeout> | undefined;

    constructor(sessions: Session[]) {
        this.#sessions = sessions;
        const stop = h("button", { type: "button", onclick: () => this.#stop() }, say((w) => w.stop));
        this.element = h("div", { class: "work", role: "status", hidden: true }, this.#label, this.#bar, stop);
        for (const session of sessions) session.changed.on(() => this.#show());
    }

    #show(): void {
        clearTimeout(this.#timer);
        const now = performance.now();
        const busy = this.#sessions.filter((session) => session.running !== null);
        const first = busy.map((session) => session.running?.since ?? now).sort((a, b) => a - b)[0];
        const slow = busy.find((session) => (session.running?.since ?? now) <= now - PATIENCE);
        this.element.hidden = slow === undefined;
        if (slow?.running) {
            const label = word().working[slow.running.lane];
            if (this.#label.textContent !== label) this.#label.textContent = label;
            set(this.#bar, "value", slow.progress);
            set(this.#bar, "aria-label", label);
        }
        if (first !== undefined) this.#timer = setTimeout(() => this.#show(), Math.max(first + PATIENCE - now, 100));
    }

    #stop(): void {
        for (const session of this.#sessions) {
            if (session.running !== null) session.stop();
        }
    }
}
