// Tabs: arrows move among them, and one panel is seen. On a phone the text is one of them.

import { h, set } from "../dom";
import { Signal } from "../signal";
import { onLanguage, say, word } from "../words";

const NAMES = ["text", "picture", "sheet", "charts", "circuits", "simulation", "report", "rust"] as const;
export type TabName = (typeof NAMES)[number];
type Panel = { name: TabName; element: HTMLElement; seen: (isSeen: boolean) => void };

export class Tabs {
    readonly list = h("div", { class: "tabs", role: "tablist" });
    readonly panels = h("div", { class: "panels" });
    readonly changed = new Signal();
    current: TabName = "picture";
    #panels: Panel[];
    #narrow = matchMedia("(max-width: 60rem)");

    constructor(panels: Panel[]) {
        this.#panels = panels;
        for (const name of NAMES) {
            const tab = h("button", { type: "button", role: "tab", id: `tab-${name}`, "data-tab": name, onclick: () => this.show(name) }, say((w) => w[name]));
            if (name !== "text") set(tab, "aria-controls", `panel-${name}`);
            this.list.append(tab);
        }
        for (const { name, element } of panels) {
            set(element, "role", "tabpanel");
            set(element, "id", `panel-${name}`);
            set(element, "aria-labelledby", `tab-${name}`);
            this.panels.append(element);
        }
        this.list.addEventListener("keydown", (event) => this.#key(event));
        this.#narrow.addEventListener("change", () => this.show(this.current));
        onLanguage(() => set(this.list, "aria-label", word().views));
        this.show("picture");
    }

    show(name: TabName): void {
        const isKnown = NAMES.includes(name) && (name !== "text" || this.#narrow.matches);
        this.current = isKnown ? name : "picture";
        document.body.dataset.tab = this.current;
        for (const tab of this.list.querySelectorAll<HTMLElement>("[role=tab]")) {
            const isChosen = tab.dataset.tab === this.current;
            set(tab, "aria-selected", isChosen ? "true" : "false");
            set(tab, "tabindex", isChosen ? 0 : -1);
            if (isChosen) tab.scrollIntoView({ block: "nearest", inline: "nearest" });
        }
        for (const panel of this.#panels) {
            panel.element.hidden = panel.name !== this.current;
            panel.seen(panel.name === this.current);
        }
        this.changed.emit();
    }

    #key(event: KeyboardEvent): void {
        const tabs = [...this.list.querySelectorAll<HTMLElement>("[role=tab]")].filter((tab) => tab.offsetParent !== null);
        const now = tabs.findIndex((tab) => tab.matches(":focus"));
        const next = { ArrowRight: now + 1, ArrowLeft: now - 1, Home: 0, End: tabs.length - 1 }[event.key];
        if (next === undefined) return;
        event.preventDefault();
        const tab = tabs.at(next % tabs.length);
        tab?.focus();
        this.show(tab?.dataset.tab as TabName);
    }
}
