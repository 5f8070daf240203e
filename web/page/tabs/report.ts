// The report: mobility, modes and circuits, the motion with its extremes. It is in English.

import { Island } from "../island";
import type { Machine } from "../machine";
import type { Session } from "../session";
import { sheetStyles } from "../styles";
import { Tab } from "./tab";

export class ReportTab extends Tab {
    #island = new Island("sheet", sheetStyles);

    constructor(machine: Machine, session: Session) {
        super(machine, session);
        this.#island.element.lang = "en";
        this.element.append(this.why, this.stale, this.#island.element);
    }

    protected key(): unknown[] | null {
        return this.machine.at && [this.machine.at];
    }

    protected async compute(): Promise<boolean> {
        const { at } = this.machine;
        if (at === null) return false;
        const answer = await this.ask<"report">(() => ({ do: "report", ...at }));
        if (answer) this.#island.html(answer.html);
        else if (answer === null) this.#island.clear();
        return answer !== undefined;
    }
}
