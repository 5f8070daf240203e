// The circuits: which positions are connected by motion.

import { h } from "../dom";
import { show as shown } from "../format";
import { Island } from "../island";
import type { Machine } from "../machine";
import type { Circuits, Quantity } from "../protocol";
import type { Session } from "../session";
import { chartStyles } from "../styles";
import { languageOf, word } from "../words";
import { Tab } from "./tab";

export class CircuitsTab extends Tab {
    #text = h("pre", { class: "lines" });
    #charts = h("div", { class: "charts" });

    constructor(machine: Machine, session: Session) {
        super(machine, session);
        this.element.append(this.why, this.stale, h("div", { class: "page wide" }, this.#text, this.#charts));
    }

    protected key(): unknown[] | null {
        const { at, show } = this.machine;
        // The circuits do not depend on the input that moves.
        return at && [at.mechanism, at.parameters, at.place.inputs.with(show.along, 0), show.along, languageOf()];
    }

    protected async compute(): Promise<boolean> {
        const { at, show, about } = this.machine;
        if (at === null || about === null) return false;
        const { mechanism, parameters, place } = at;
        const question = { do: "circuits", mechanism, parameters, inputs: place.inputs, along: show.along } as const;
        const answer = await this.ask<"circuits">(() => question);
        if (answer === undefined) return false;
        this.#text.textContent = answer === null ? "" : inWords(answer, about.inputs[show.along]);
        this.#charts.replaceChildren(
            ...(answer?.charts ?? []).map(({ svg }) => {
                const island = new Island("chart", chartStyles);
                island.svg(svg);
                return h("figure", {}, island.element);
            }),
        );
        return true;
    }
}

function inWords({ positions, more, circuits, motions }: Circuits, input: Quantity | undefined): string {
    const each = motions.map((motion, index) => {
        const [least, largest] = [motion.least, motion.largest].map((end) => shown(end ?? NaN, input?.is_angle));
        return `${word().motionOfCircuit(index + 1, motion.circuit)}: ${word().way(motion, input?.name ?? "", least ?? "", largest ?? "")}`;
    });
    const head = [word().circuitsHead(positions, motions.length, circuits), ...(more ? [word().morePositions] : [])];
    return [...head, ...each].join("\n");
}
