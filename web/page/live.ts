// A live sheet: the numbers of a sheet and its picture follow sliders, by a module without the compiler.

import worker from "linkage:worker";
import css from "./page.css";
import liveCss from "./live.css";
import { isRefusal } from "./answers";
import { cleanHtml } from "./clean";
import { h, set } from "./dom";
import { Machine } from "./machine";
import { NumbersView } from "./numbers";
import { patch } from "./patch";
import { PictureView } from "./picture";
import { Session } from "./session";
import { SlidersView } from "./sliders";
import { sheetOf } from "./theme";
import { fromBase64, inflate, loadModule, NoWebAssembly } from "./wasm";
import { onLanguage, say, setLanguage, word, type Language } from "./words";

/** What the program writes into a live sheet. */
type Data = {
    written: string;
    name: string;
    parameters: Record<string, number>;
    place: { inputs: number[]; unknowns: number[] };
    rate: number | null;
};

const language: Language = document.documentElement.lang === "it" ? "it" : "en";

async function begin(): Promise<void> {
    setLanguage(language);
    const text = document.getElementById("linkage-data")?.textContent ?? "";
    const dock = h("aside", { class: "side live" });
    const host = h("div", { id: "linkage-live" });
    const root = host.attachShadow({ mode: "open" });
    root.adoptedStyleSheets = [sheetOf(css.replaceAll(":root", ":host")), sheetOf(liveCss)];
    root.append(dock);
    document.body.append(host);
    try {
        const bytes = await inflate(fromBase64(text), 2 ** 28);
        const data = JSON.parse(new TextDecoder().decode(bytes)) as Data;
        const module = await loadModule();
        const address = URL.createObjectURL(new Blob([worker], { type: "text/javascript" }));
        live(dock, data, new Session(() => new Worker(address), module, (written) => ({ do: "load", written })));
    } catch (error) {
        console.error(error);
        dock.append(h("p", { class: "failure", role: "alert" }, error instanceof NoWebAssembly ? word().noWebAssembly : word().liveFailed));
    }
}

function live(dock: HTMLElement, data: Data, session: Session): void {
    const machine = new Machine(session);
    const picture = new PictureView(machine);
    const sliders = new SlidersView(machine);
    const numbers = new NumbersView(machine);
    if (data.rate !== null) machine.show = { ...machine.show, rate: data.rate, velocities: true };
    const fold = h("button", { type: "button", class: "fold", "aria-expanded": "true", onclick: () => folded(dock, fold) }, say((w) => w.liveFold));
    dock.append(fold, picture.element, sliders.element, numbers.element);
    onLanguage((words) => set(dock, "aria-label", words.sliders));
    document.body.classList.add("has-live");

    const main = document.querySelector("main") as HTMLElement;
    let isAsked = false;
    /** Writes the numbers of the newest position; one question at a time, so that a slider never waits. */
    async function write(): Promise<void> {
        if (machine.at === null || isAsked) return;
        isAsked = true;
        const { at } = machine;
        const answer = await session.ask("tab", data.written, () => ({ do: "sheet", ...at, rate: data.rate, language, form: "html" }));
        isAsked = false;
        if (answer !== null && !isRefusal(answer)) {
            const { content } = cleanHtml(answer.text);
            patch(main, content);
        }
        if (machine.at !== at) void write();
    }
    machine.moved.on(() => void write());
    void machine.compile(data.written, { mechanism: data.name, parameters: data.parameters, ...data.place });
}

function folded(dock: HTMLElement, button: HTMLElement): void {
    const isFolded = dock.toggleAttribute("data-folded");
    set(button, "aria-expanded", String(!isFolded));
}

void begin();
