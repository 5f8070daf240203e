// The sheet: formulas, with numbers at this position. It changes in place while sliders move.

import { Island } from "../island";
import type { Machine } from "../machine";
import type { At } from "../protocol";
import type { Session } from "../session";
import { sheetStyles } from "../styles";
import { languageOf } from "../words";
import { Tab } from "./tab";

export class SheetTab extends Tab {
    protected override readonly isLive = true;
    #island = new Island("sheet", sheetStyles);

    constructor(machine: Machine, session: Session) {
        super(machine, session);
        this.element.append(this.why, this.stale, this.#island.element);
    }

    protected key(): unknown[] | null {
        const { show } = this.machine;
        const at = positionOf(this.machine);
        return at && [at, show.rate, languageOf()];
    }

    protected async compute(): Promise<boolean> {
        const { show } = this.machine;
        const at = positionOf(this.machine);
        if (at === null) return false;
        const language = languageOf();
        const answer = await this.ask<"sheet">(() => ({ do: "sheet", ...at, rate: show.rate, language, form: "html" }));
        if (answer) {
            this.#island.element.lang = language;
            this.#island.html(answer.text);
        } else if (answer === null) {
            this.#island.clear();
        }
        return answer !== undefined;
    }
}

/** The position, or none of a mechanism that has none: its sheet is without numbers then. */
function positionOf({ at, about, index, target }: Machine): At | null {
    return at ?? (about && { mechanism: index, parameters: target.parameters, place: { inputs: [], unknowns: [] } });
}
