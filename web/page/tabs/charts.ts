// Charts over the motion: coordinates, outputs and points with their velocities and accelerations.

import { h, set } from "../dom";
import { isRefusal } from "../answers";
import { Island } from "../island";
import type { Machine } from "../machine";
import type { Quantity } from "../protocol";
import type { Session } from "../session";
import { chartStyles } from "../styles";
import { onLanguage, say, word } from "../words";
import { Tab } from "./tab";

/** Curves that one chart has at most. */
const CURVES = 5;
const STEPS = 180;

/** A column by the quantity that it is of, and what of it. */
type Column = Quantity & { of: string; part: string };

export class ChartsTab extends Tab {
    /** The columns that the user has chosen, if any. */
    #chosen: string[] | null = null;
    /** The columns that are shown: those of the choice that there are, or the first ones. */
    #shown: string[] = [];
    #columns: Column[] = [];
    #shape = "";
    #picker = h("div", { class: "picker" });
    #charts = h("div", { class: "charts" });
    #islands = new Map<string, Island>();
    #title = h("h2");

    constructor(machine: Machine, session: Session) {
        super(machine, session);
        const columns = h(
            "details",
            { class: "columns", open: true },
            h("summary", {}, say((w) => w.choose)),
            h("p", { class: "soft" }, say((w) => w.chooseHint)),
            this.#picker,
        );
        this.element.append(this.why, this.stale, h("div", { class: "page wide" }, this.#title, this.#charts, columns));
        onLanguage(() => {
            this.#shape = "";
        });
    }

    /** The columns that a link has. */
    get chosen(): string[] | null {
        return this.#chosen;
    }
    set chosen(names: string[] | null) {
        this.#chosen = names;
    }

    protected key(): unknown[] | null {
        const { at, show, motion } = this.machine;
        // A motion does not depend on where on it the mechanism is.
        if (at === null || motion === null) return null;
        const { least, largest } = motion;
        return [at.mechanism, at.parameters, at.place.inputs.with(show.along, 0), show.along, show.rate, least, largest, this.#chosen];
    }

    protected async compute(): Promise<boolean> {
        const { at, show, text, about } = this.machine;
        if (at === null || text === null || about === null) return false;
        const { along, rate } = show;
        const motion = await this.ask<"motion">(() => ({ do: "motion", ...at, along, rate, steps: STEPS }));
        if (!motion) return motion === null;
        this.#title.textContent = word().overMotion(about.inputs[along]?.name ?? "");
        this.#columns = motion.columns.map((column) => this.#column(column));
        const known = new Set(this.#columns.map(({ name }) => name));
        const chosen = this.#chosen?.filter((name) => known.has(name)) ?? [];
        this.#shown = chosen.length > 0 || this.#chosen?.length === 0 ? chosen : this.#first();
        this.#pick();
        const groups = this.#groups();
        const figures: HTMLElement[] = [];
        for (const columns of groups) {
            const key = columns.join(" ");
            const island = this.#islands.get(key) ?? new Island("chart", chartStyles);
            this.#islands.set(key, island);
            const answer = await this.session.ask("chart", text, () => ({ do: "chart", columns }));
            if (answer === null) return false;
            if (!isRefusal(answer)) {
                island.svg(answer.svg);
                figures.push(h("figure", {}, island.element));
            } else {
                this.why.hidden = false;
                this.why.textContent = answer.why;
            }
        }
        for (const key of this.#islands.keys()) {
            if (!groups.some((columns) => columns.join(" ") === key)) this.#islands.delete(key);
        }
        this.#charts.replaceChildren(...figures);
        return true;
    }

    /** `C_velocity_x` is `velocity_x` of `C`. */
    #column({ name, is_angle }: Quantity): Column {
        const { about } = this.machine;
        const quantities = about ? [...about.inputs, ...about.unknowns, ...about.outputs].map((quantity) => quantity.name) : [];
        const owners = [...quantities, ...(about?.points ?? [])].filter((of) => name === of || name.startsWith(`${of}_`));
        const of = owners.sort((a, b) => b.length - a.length)[0];
        return of === undefined ? { name, is_angle, of: name, part: "" } : { name, is_angle, of, part: name.slice(of.length + 1) };
    }

    /** The outputs and the unknowns, if there is nothing chosen. */
    #first(): string[] {
        const { about } = this.machine;
        const names = [...(about?.unknowns ?? []), ...(about?.outputs ?? [])].map(({ name }) => name);
        return names.filter((name) => this.#columns.some((column) => column.name === name)).slice(0, 3 * CURVES);
    }

    /** Columns of one kind share a chart: they have one scale. */
    #groups(): string[][] {
        const groups = new Map<string, string[][]>();
        const points = new Set(this.machine.about?.points);
        // Outputs may be of any unit: each has its own charts.
        const outputs = new Set(this.machine.about?.outputs.map((output) => output.name));
        for (const name of this.#shown) {
            const column = this.#columns.find((candidate) => candidate.name === name);
            if (column === undefined) continue;
            const isPoint = points.has(column.of);
            const kind = isPoint ? column.part.replace(/^speed$/u, "velocity").replace(/_?[xy]$/u, "") : column.part;
            const key = JSON.stringify([isPoint, kind, column.is_angle, outputs.has(column.of) ? column.of : ""]);
            const charts = groups.get(key) ?? [[]];
            if (charts.at(-1)?.length === CURVES) charts.push([]);
            charts.at(-1)?.push(name);
            groups.set(key, charts);
        }
        return [...groups.values()].flat();
    }

    #pick(): void {
        const shape = JSON.stringify(this.#columns);
        if (shape !== this.#shape) {
            this.#shape = shape;
            const rows = new Map<string, Column[]>();
            for (const column of this.#columns) rows.set(column.of, [...(rows.get(column.of) ?? []), column]);
            this.#picker.replaceChildren(
                ...[...rows].map(([of, columns]) =>
                    h(
                        "div",
                        { class: "row", role: "group", "aria-label": of },
                        h("span", { class: "name" }, of),
                        ...columns.map((column) => this.#chip(column)),
                    ),
                ),
            );
        }
        for (const button of this.#picker.querySelectorAll("button")) {
            set(button, "aria-pressed", this.#shown.includes(button.dataset.column ?? "") ? "true" : "false");
        }
    }

    #chip(column: Column): HTMLElement {
        const label = column.part === "" ? column.of : column.part.replaceAll("_", " ");
        const toggle = (): void => {
            const shown = this.#shown;
            this.#shown = shown.includes(column.name) ? shown.filter((name) => name !== column.name) : [...shown, column.name];
            this.#chosen = this.#shown;
            this.#pick();
            this.refresh();
        };
        return h(
            "button",
            { type: "button", class: "chip", "data-column": column.name, "aria-label": column.name, onclick: toggle },
            label,
        );
    }
}
