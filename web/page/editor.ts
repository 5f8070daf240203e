// The text: CodeMirror in a shadow root, whose styles are then adopted sheets, which a strict policy of styles lets pass.

import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap } from "@codemirror/commands";
import { bracketMatching, indentOnInput, indentUnit } from "@codemirror/language";
import { type Diagnostic, lintGutter, lintKeymap, setDiagnostics } from "@codemirror/lint";
import { Compartment, EditorState } from "@codemirror/state";
import {
    drawSelection,
    EditorView,
    highlightActiveLine,
    keymap,
    lineNumbers,
    type ViewUpdate,
} from "@codemirror/view";
import { h } from "./dom";
import { colours, complete, language } from "./language";
import type { Mistake } from "./protocol";
import { Signal } from "./signal";
import { onLanguage, word } from "./words";

const look = EditorView.theme({
    "&": { height: "100%", fontSize: "var(--code-size)", backgroundColor: "transparent", color: "var(--ink)" },
    "&.cm-focused": { outline: "none" },
    ".cm-scroller": { fontFamily: "var(--code)", lineHeight: "1.6", overflow: "auto" },
    ".cm-content": { padding: ".75rem 0 3rem", caretColor: "var(--accent)" },
    // The rest of a long line stands in.
    ".cm-line": { padding: "0 .75rem 0 calc(.25rem + 6ch)", textIndent: "-6ch" },
    ".cm-cursor": { borderLeftColor: "var(--accent)", borderLeftWidth: "2px" },
    ".cm-gutters": { backgroundColor: "transparent", border: "none", color: "var(--faint)" },
    ".cm-lineNumbers .cm-gutterElement": { padding: "0 .4rem 0 .75rem" },
    ".cm-gutter-lint": { width: ".9rem" },
    ".cm-gutter-lint .cm-gutterElement": { padding: "0" },
    ".cm-lint-marker": { width: ".6rem", height: ".6rem", content: "none", borderRadius: "50%", margin: ".5em auto 0" },
    ".cm-lint-marker-error": { content: "none", background: "var(--bad)" },
    ".cm-activeLine": { backgroundColor: "var(--line-shade)" },
    "&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground": {
        backgroundColor: "var(--selection)",
    },
    ".cm-matchingBracket, &.cm-focused .cm-matchingBracket": { backgroundColor: "var(--selection)", color: "inherit" },
    ".cm-lintRange-error": {
        backgroundImage: "none",
        textDecoration: "underline wavy var(--bad) 1.5px",
        textUnderlineOffset: "3px",
        textDecorationSkipInk: "none",
    },
    ".cm-tooltip": {
        backgroundColor: "var(--card)",
        color: "var(--ink)",
        border: "1px solid var(--line)",
        borderRadius: ".5rem",
        boxShadow: "var(--lift)",
        overflow: "hidden",
    },
    ".cm-diagnostic": { padding: ".5rem .75rem", borderLeft: "3px solid var(--bad)", fontFamily: "var(--text)", maxWidth: "34rem" },
    ".cm-diagnostic .help": { display: "block", marginTop: ".25rem", color: "var(--soft)" },
    ".cm-tooltip-autocomplete > ul": { fontFamily: "var(--code)", maxHeight: "16em" },
    ".cm-tooltip-autocomplete > ul > li": { padding: ".2rem .6rem" },
    ".cm-tooltip-autocomplete > ul > li[aria-selected]": { backgroundColor: "var(--accent)", color: "var(--paper)" },
    ".cm-completionDetail": { opacity: ".7", fontStyle: "normal", marginLeft: "1.5em" },
});

export class Editor {
    readonly element = h("div", { class: "editor" });
    /** The text after each change by typing. */
    readonly changed = new Signal<string>();
    #view: EditorView;
    #labels = new Compartment();
    #isQuiet = false;

    constructor() {
        const root = this.element.attachShadow({ mode: "open" });
        const frame = h("div");
        root.append(frame);
        const sheet = new CSSStyleSheet();
        sheet.replaceSync(":host{display:block}:host>div{height:100%}");
        root.adoptedStyleSheets = [sheet];
        this.#view = new EditorView({
            root,
            parent: frame,
            state: EditorState.create({
                extensions: [
                    lineNumbers(),
                    lintGutter(),
                    history(),
                    drawSelection(),
                    EditorState.allowMultipleSelections.of(true),
                    indentOnInput(),
                    indentUnit.of("    "),
                    bracketMatching(),
                    closeBrackets(),
                    autocompletion({ override: [complete], icons: false }),
                    highlightActiveLine(),
                    EditorView.lineWrapping,
                    language,
                    colours,
                    look,
                    this.#labels.of([]),
                    // Tab leaves the text.
                    keymap.of([...closeBracketsKeymap, ...completionKeymap, ...historyKeymap, ...lintKeymap, ...defaultKeymap]),
                    EditorView.updateListener.of((update: ViewUpdate) => {
                        if (update.docChanged && !this.#isQuiet) this.changed.emit(this.text);
                    }),
                ],
            }),
        });
        const frameOf = frame.firstElementChild as HTMLElement | null;
        frameOf?.style.setProperty("height", "100%");
        onLanguage(() => this.#label());
    }

    get text(): string {
        return this.#view.state.doc.toString();
    }

    /** Replaces the text, as one step that can be undone. */
    replace(text: string): void {
        this.#isQuiet = true;
        this.#view.dispatch({ changes: { from: 0, to: this.#view.state.doc.length, insert: text }, selection: { anchor: 0 } });
        this.#isQuiet = false;
        this.#view.scrollDOM.scrollTop = 0;
    }

    /** Underlines mistakes. */
    mark(mistakes: Mistake[]): void {
        const length = this.#view.state.doc.length;
        const clamp = (place: number): number => Math.min(Math.max(place, 0), length);
        const diagnostics = mistakes.map(({ from, to, text, help }): Diagnostic => {
            // A mistake at the end of the text has no character: the last one is underlined.
            const start = Math.min(clamp(from), Math.max(length - 1, 0));
            return {
                from: start,
                to: Math.max(clamp(to), Math.min(start + 1, length)),
                severity: "error",
                message: help === null ? text : `${text}\n${help}`,
                renderMessage: () => h("span", {}, text, help === null ? null : h("span", { class: "help" }, help)),
            };
        });
        this.#view.dispatch(setDiagnostics(this.#view.state, diagnostics));
    }

    /** Moves the cursor to a place and shows it. */
    go(place: number): void {
        const anchor = Math.min(place, this.#view.state.doc.length);
        this.#view.dispatch({ selection: { anchor }, effects: EditorView.scrollIntoView(anchor, { y: "center" }) });
        this.#view.focus();
    }

    #label(): void {
        const attributes = EditorView.contentAttributes.of({
            "aria-label": word().textLabel,
            spellcheck: "false",
            autocorrect: "off",
            autocapitalize: "off",
        });
        this.#view.dispatch({ effects: this.#labels.reconfigure(attributes) });
    }
}
