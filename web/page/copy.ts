// Copies: Rust, LaTeX, SVG, CSV.

import { isRefusal, type Kind, type QuestionOf } from "./answers";
import type { Editor } from "./editor";
import { dialog, download, toClipboard, type Notice } from "./files";
import type { Machine } from "./machine";
import type { Item } from "./menu";
import type { PictureView } from "./picture";
import type { Session } from "./session";
import type { SimulationTab } from "./tabs/simulation";
import type { Tabs } from "./tabs/tabs";
import { languageOf, word, type Words } from "./words";

const STEPS = 360;

export function copyItems(
    machine: Machine,
    session: Session,
    editor: Editor,
    picture: PictureView,
    simulation: SimulationTab,
    tabs: Tabs,
    notice: Notice,
): Item[] {
    async function copy(label: (w: Words) => string, ending: string, text: string | null): Promise<void> {
        if (text === null) return;
        if (await toClipboard(text)) {
            notice.say(word().copied(label(word())));
            return;
        }
        const name = `${machine.about?.name ?? "mechanism"}.${ending}`;
        dialog(word().notCopied, text, [{ label: (w) => w.save, act: () => download(name, text) }], true);
    }
    async function ask<K extends Kind>(make: () => QuestionOf<K>): Promise<string | null> {
        const answer = await session.ask<K>("copy", machine.text ?? "", make);
        if (answer === null) return null;
        if (isRefusal(answer)) {
            notice.say(answer.why, true);
            return null;
        }
        return "text" in answer ? answer.text : null;
    }
    async function motion(): Promise<string | null> {
        if (tabs.current === "simulation" && simulation.csv !== null) return simulation.csv;
        const { at, show } = machine;
        if (at === null) return null;
        const { along, rate } = show;
        const found = await session.ask("copy", machine.text ?? "", () => ({ do: "motion", ...at, along, rate, steps: STEPS }));
        if (found === null) return null;
        if (isRefusal(found)) {
            notice.say(found.why, true);
            return null;
        }
        return ask<"csv">(() => ({ do: "csv" }));
    }
    const item = (label: (w: Words) => string, ending: string, text: () => Promise<string | null> | string | null): Item => ({
        label,
        act: () => void Promise.resolve(text()).then((found) => copy(label, ending, found)),
    });
    return [
        item((w) => w.copyMacro, "rs", () => `use linkage::linkage;\n\nlinkage! {\n${indent(editor.text)}}\n`),
        item((w) => w.copyRust, "rs", () => ask<"rust">(() => ({ do: "rust", mechanism: machine.index }))),
        item(
            (w) => w.copyLatex,
            "tex",
            () => {
                const { at, show } = machine;
                if (at === null) return null;
                return ask<"sheet">(() => ({ do: "sheet", ...at, rate: show.rate, language: languageOf(), form: "latex" }));
            },
        ),
        item((w) => w.copySvg, "svg", () => picture.svg),
        item((w) => w.copyCsv, "csv", motion),
    ];
}

function indent(text: string): string {
    return `${text.trimEnd().replace(/^(?=.)/gmu, "    ")}\n`;
}
