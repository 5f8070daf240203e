// The page: its parts, and what passes between them.

import licences from "linkage:licences";
import worker from "linkage:worker";
import { isRefusal } from "./answers";
import { copyItems } from "./copy";
import { h, set } from "./dom";
import { Editor } from "./editor";
import { exampleItems, examples } from "./examples";
import { dialog, download, LARGEST_TEXT, Notice, openFile, readFile, toClipboard } from "./files";
import { kilobytes } from "./format";
import { learn } from "./language";
import { DamagedLink, LONGEST, NewerLink, readLink, write, type Linked } from "./link";
import { Machine } from "./machine";
import { menu } from "./menu";
import { MistakesView } from "./mistakes";
import { NumbersView } from "./numbers";
import { PictureView } from "./picture";
import { PositionsView } from "./positions";
import { recall, remember } from "./preferences";
import { rewrite } from "./rewrite";
import { followFile, servedFile } from "./served";
import { Session } from "./session";
import { settled } from "./signal";
import { SlidersView } from "./sliders";
import { ChartsTab } from "./tabs/charts";
import { CircuitsTab } from "./tabs/circuits";
import { ReportTab } from "./tabs/report";
import { RustTab } from "./tabs/rust";
import { SheetTab } from "./tabs/sheet";
import { SimulationTab } from "./tabs/simulation";
import { Tabs, type TabName } from "./tabs/tabs";
import { setTheme, theme, type Theme } from "./theme";
import { Toolbar } from "./toolbar";
import { loadModule, NoWebAssembly } from "./wasm";
import { languageOf, languages, onLanguage, say, setLanguage, word, type Language } from "./words";
import { WorkView } from "./work";

const stored = recall();
setLanguage(stored.language ?? languageOf());
setTheme(stored.theme ?? "auto");

async function begin(): Promise<void> {
    const root = document.getElementById("page") as HTMLElement;
    try {
        const module = await loadModule();
        const address = URL.createObjectURL(new Blob([worker], { type: "text/javascript" }));
        page(root, () => new Worker(address), module);
    } catch (error) {
        const why = h("p", { class: "failure", role: "alert" });
        onLanguage((words) => {
            why.textContent = error instanceof NoWebAssembly ? words.noWebAssembly : words.moduleFailed;
        });
        console.error(error);
        root.replaceChildren(why);
    }
}

function page(root: HTMLElement, spawn: () => Worker, module: WebAssembly.Module): void {
    // One worker moves the picture, the other computes what takes longer.
    const quick = new Session(spawn, module);
    const slow = new Session(spawn, module);
    const machine = new Machine(quick);
    const editor = new Editor();
    const notice = new Notice();
    const picture = new PictureView(machine);
    const positions = new PositionsView(machine, quick);
    const sliders = new SlidersView(machine);
    const numbers = new NumbersView(machine);
    const toolbar = new Toolbar(machine);
    const charts = new ChartsTab(machine, slow);
    const simulation = new SimulationTab(machine, slow, quick);
    const pictureTab = h("div", { class: "tab picture-tab" }, toolbar.element, picture.element, positions.element);
    const tabs = new Tabs([
        { name: "picture", element: pictureTab, seen: () => {} },
        ...(
            [
                ["sheet", new SheetTab(machine, slow)],
                ["charts", charts],
                ["circuits", new CircuitsTab(machine, slow)],
                ["simulation", simulation],
                ["report", new ReportTab(machine, slow)],
                ["rust", new RustTab(machine, slow)],
            ] as const
        ).map(([name, tab]) => ({ name, element: tab.element, seen: (isSeen: boolean) => (tab.seen = isSeen) })),
    ]);
    const mistakes = new MistakesView(machine, editor);

    function load(text: string, linked: Partial<Linked> = {}): void {
        if (text.length > LARGEST_TEXT) {
            notice.say(word().tooLong(Math.round(text.length / 1000)), true);
            return;
        }
        editor.replace(text);
        if (linked.along !== undefined || linked.rate !== undefined || linked.shown !== undefined) {
            machine.show = {
                ...machine.show,
                traces: linked.shown?.includes("t") ?? machine.show.traces,
                velocities: linked.shown?.includes("v") ?? false,
                accelerations: linked.shown?.includes("a") ?? false,
                along: Math.max(0, Math.trunc(linked.along ?? 0)),
                rate: linked.rate ?? 1,
            };
            toolbar.update();
        }
        charts.chosen = linked.columns ?? null;
        if (linked.scene) simulation.settings = linked.scene;
        if (linked.tab) tabs.show(linked.tab as TabName);
        void machine.compile(text, linked);
    }

    // Typing: the text is read once the keys rest a moment.
    const reading = settled(150, () => {
        const text = editor.text;
        if (text.length > LARGEST_TEXT) notice.say(word().tooLong(Math.round(text.length / 1000)), true);
        else void machine.compile(text);
    });
    editor.changed.on(() => {
        mistakes.wait();
        reading.soon();
    });
    sliders.onText = () => {
        const about = machine.about;
        if (about === null) return;
        const text = rewrite(editor.text, about.parameters, machine.target.parameters);
        editor.replace(text);
        void machine.compile(text);
    };

    // The address.
    function linked(): Linked {
        const { about, at, show } = machine;
        const moved = about?.parameters.filter(({ value }, index) => machine.target.parameters[index] !== value) ?? [];
        const value = (name: string): number => machine.target.parameters[about?.parameters.findIndex((p) => p.name === name) ?? -1] ?? 0;
        const isSimulated = tabs.current === "simulation";
        return {
            text: editor.text,
            mechanism: machine.mechanisms.length > 1 ? about?.name : undefined,
            parameters: moved.length > 0 ? Object.fromEntries(moved.map(({ name }) => [name, value(name)])) : undefined,
            inputs: at?.place.inputs,
            unknowns: at?.place.unknowns,
            tab: tabs.current === "picture" ? undefined : tabs.current,
            along: show.along || undefined,
            rate: show.rate === 1 ? undefined : show.rate,
            shown: `${show.traces ? "t" : ""}${show.velocities ? "v" : ""}${show.accelerations ? "a" : ""}`,
            columns: tabs.current === "charts" ? (charts.chosen ?? undefined) : undefined,
            scene: isSimulated ? simulation.settings : undefined,
        };
    }
    let fragment = "";
    async function writeAddress(): Promise<string> {
        const next = editor.text.length > LARGEST_TEXT ? "" : await write(linked());
        fragment = next.length > LONGEST ? "" : next;
        history.replaceState(null, "", fragment === "" ? location.href.split("#")[0] : fragment);
        return next;
    }
    const addressing = settled(700, () => void writeAddress());
    machine.moved.on(() => addressing.soon());
    tabs.changed.on(() => {
        addressing.soon();
        if (tabs.current !== "simulation") simulation.rest();
    });
    const save = (): void => download(`${machine.about?.name ?? "mechanism"}.linkage`, editor.text);
    async function share(): Promise<void> {
        const next = await writeAddress();
        if (next.length > LONGEST || next === "") {
            dialog(word().longLink(kilobytes(next.length || editor.text.length)), null, [{ label: (w) => w.save, act: save }]);
            return;
        }
        const address = `${location.href.split("#")[0]}${next}`;
        if (await toClipboard(address)) notice.say(word().copied(word().linkItem));
        else dialog(word().notCopied, address, [], true);
    }
    async function follow(): Promise<void> {
        if (location.hash === fragment && fragment !== "") return;
        try {
            const from = await readLink(location.hash);
            if (from !== null) {
                load(from.text, from);
                return;
            }
        } catch (error) {
            if (error instanceof NewerLink) notice.say(word().newerLink, true);
            else if (error instanceof DamagedLink) notice.say(word().damagedLink, true);
            else throw error;
        }
        if (editor.text === "") load(examples[0]?.text ?? "");
    }
    addEventListener("hashchange", () => void follow());

    // The frame.
    const open = (): void => openFile(".linkage,text/plain", (text) => load(text), (why) => notice.say(why, true));
    const legal = (): void => dialog(word().licences, licences);
    const mechanism = h("select", { class: "mechanism", onchange: () => machine.choose(mechanism.selectedIndex) });
    machine.compiled.on(() => {
        mechanism.replaceChildren(...machine.mechanisms.map(({ name }, index) => h("option", { selected: index === machine.index }, name)));
        mechanism.hidden = machine.mechanisms.length < 2;
        document.title = machine.about ? `${machine.about.name} · linkage` : word().title;
    });
    const head = h(
        "header",
        {},
        h("a", { class: "skip", href: "#views", onclick: (event: Event) => (event.preventDefault(), main.focus()) }, say((w) => w.skip)),
        h("h1", {}, "linkage", h("span", { class: "slogan" }, say((w) => w.slogan))),
        menu((w) => w.examples, exampleItems(({ text }) => load(text)), "wide"),
        menu((w) => w.file, [
            { label: (w) => w.open, act: open },
            { label: (w) => w.save, act: save },
            { label: (w) => w.share, act: () => void share() },
            { label: (w) => w.licences, act: legal },
        ]),
        menu((w) => w.copy, copyItems(machine, slow, editor, picture, simulation, tabs, notice)),
        h("span", { class: "gap" }),
        menu(
            (w) => w.theme,
            (["auto", "light", "dark"] as const).map((name: Theme) => ({
                label: (w) => w.themes[name],
                isChosen: () => theme() === name,
                act: () => {
                    setTheme(name);
                    remember({ theme: name });
                },
            })),
        ),
        menu(
            () => languages[languageOf()].code.toUpperCase(),
            (Object.keys(languages) as Language[]).map((code) => ({
                label: () => languages[code].ownName,
                isChosen: () => languageOf() === code,
                act: () => {
                    setLanguage(code);
                    remember({ language: code });
                },
            })),
            "language",
        (w) => w.language,
        ),
    );
    const left = h("section", { class: "left" }, editor.element, mistakes.element);
    const right = h("aside", { class: "side" }, sliders.element, numbers.element);
    const work = new WorkView([quick, slow]);
    const main = h("main", { id: "views", tabindex: -1 }, h("div", { class: "tabs-row" }, tabs.list, mechanism), work.element, tabs.panels);
    root.replaceChildren(head, left, main, right, notice.element);
    onLanguage((words) => {
        set(mechanism, "aria-label", words.mechanism);
        set(left, "aria-label", words.text);
        set(main, "aria-label", words.views);
        set(right, "aria-label", words.sliders);
    });
    addEventListener("dragover", (event) => event.preventDefault());
    addEventListener("drop", (event) => {
        event.preventDefault();
        const file = event.dataTransfer?.files[0];
        if (file) void readFile(file, (text) => load(text), (why) => notice.say(why, true));
    });
    void quick.ask("copy", null, () => ({ do: "words" })).then((words) => {
        if (words !== null && !isRefusal(words)) learn(words);
    });
    const file = servedFile();
    if (file === null) {
        void follow();
    } else {
        set(head, "data-file", file);
        followFile(
            (text) => {
                if (text !== editor.text) load(text);
                notice.say(word().followed(file));
            },
            (why) => notice.say(why ?? word().serverGone, true),
        );
    }
}

void begin();
