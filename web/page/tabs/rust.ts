// The code that the macro writes.

import { h } from "../dom";
import type { Machine } from "../machine";
import type { Session } from "../session";
import { onLanguage } from "../words";
import { Tab } from "./tab";

export class RustTab extends Tab {
    #code = h("code");
    #frame = h("pre", { class: "code", tabindex: 0, role: "region" }, this.#code);

    constructor(machine: Machine, session: Session) {
        super(machine, session);
        this.element.append(this.why, this.stale, this.#frame);
        onLanguage((words) => this.#frame.setAttribute("aria-label", words.rust));
    }

    protected key(): unknown[] | null {
        return this.machine.about && [this.machine.index];
    }

    protected async compute(): Promise<boolean> {
        const mechanism = this.machine.index;
        const answer = await this.ask<"rust">(() => ({ do: "rust", mechanism }));
        if (answer !== undefined) this.#code.textContent = answer?.text ?? "";
        this.#frame.hidden = !answer;
        return answer !== undefined;
    }
}
