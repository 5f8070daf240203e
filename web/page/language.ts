// Colours and completion of the language. Its words come from the module; these few serve until it is there.

import { type CompletionContext, type CompletionResult, completeFromList, type Completion } from "@codemirror/autocomplete";
import { HighlightStyle, StreamLanguage, type StringStream, syntaxHighlighting } from "@codemirror/language";
import { tags } from "@lezer/highlight";

const keywords = new Set(
    ("mechanism param input unknown coordinate drive loop equation implied let point output extern derive body scene " +
        "mass inertia center angle gravity spring damper torque force potential friction stop energy power reaction " +
        "reactions equilibrium on at between and in by of restitution").split(" "),
);
const functions = new Set("sin cos tan sqrt exp ln abs atan2 hypot norm x y pi".split(" "));

/** Takes the words of the language from the module. */
export function learn(words: { keywords: string[]; functions: string[] }): void {
    for (const word of words.keywords) keywords.add(word);
    for (const word of words.functions) functions.add(word);
}

const NAME = /^[\p{L}_][\p{L}\p{N}_]*/u;
const NUMBER = /^(\d[\d_]*)(\.\d[\d_]*)?([eE][+-]?\d+)?/;
const UNIT = /^(deg|rad|rpm)\b/;

type State = { comment: number };

function token(stream: StringStream, state: State): string | null {
    if (state.comment > 0 || stream.match("/*")) {
        if (state.comment === 0) state.comment = 1;
        while (!stream.eol()) {
            if (stream.match("*/")) {
                state.comment = 0;
                break;
            }
            stream.next();
        }
        return "comment";
    }
    if (stream.eatSpace()) return null;
    if (stream.match("///") || stream.match("//!")) {
        stream.skipToEnd();
        return "docComment";
    }
    if (stream.match("//")) {
        stream.skipToEnd();
        return "comment";
    }
    if (stream.match(NUMBER)) {
        stream.match(UNIT);
        return "number";
    }
    const name = stream.match(NAME) as RegExpMatchArray | null;
    if (name) {
        if (keywords.has(name[0])) return "keyword";
        if (functions.has(name[0]) && (name[0] === "pi" || stream.match(/^\s*\(/u, false))) return "function";
        return "name";
    }
    return stream.next() === "@" ? "at" : null;
}

export const language = StreamLanguage.define<State>({
    name: "linkage",
    startState: () => ({ comment: 0 }),
    token,
    languageData: { commentTokens: { line: "//" }, closeBrackets: { brackets: ["(", "[", "{"] } },
    tokenTable: {
        docComment: tags.docComment,
        function: tags.standard(tags.variableName),
        name: tags.variableName,
        at: tags.operatorKeyword,
    },
});

export const colours = syntaxHighlighting(
    HighlightStyle.define([
        { tag: tags.keyword, color: "var(--accent)", fontWeight: "600" },
        { tag: tags.comment, color: "var(--soft)" },
        { tag: tags.docComment, color: "var(--doc)" },
        { tag: tags.number, color: "var(--number)" },
        { tag: tags.standard(tags.variableName), color: "var(--function)" },
        { tag: tags.operatorKeyword, color: "var(--accent)", fontWeight: "600" },
    ]),
);

const DECLARATION = /\b(param|input|unknown|coordinate|let|point|output|body|scene|drive|mechanism)\s+([^;{]*)/gu;

/** Names that the text declares, with the keyword of each. */
function declared(text: string): Completion[] {
    const found = new Map<string, Completion>();
    for (const [, kind = "", rest = ""] of text.replace(/\/\/.*$/gmu, "").matchAll(DECLARATION)) {
        const isList = ["param", "input", "unknown", "coordinate"].includes(kind);
        const names = isList ? rest.split(",").map((part) => part.split("=")[0] ?? "") : [rest];
        for (const part of names) {
            const name = /[\p{L}_][\p{L}\p{N}_]*/u.exec(part)?.[0];
            if (name) found.set(name, { label: name, detail: kind, type: "variable" });
        }
    }
    return [...found.values()];
}

/** Completes names of the text, keywords and functions. */
export function complete(context: CompletionContext): CompletionResult | null {
    const line = context.state.doc.lineAt(context.pos);
    if (/\/\//u.test(line.text.slice(0, context.pos - line.from))) return null;
    const before = context.matchBefore(/[\p{L}_][\p{L}\p{N}_]*/u);
    if (!before && !context.explicit) return null;
    // Of a long text the first part.
    const names = declared(context.state.sliceDoc(0, 100_000));
    const taken = new Set(names.map((name) => name.label));
    const others: Completion[] = [
        ...[...keywords].map((label) => ({ label, type: "keyword", boost: -1 })),
        ...[...functions].map((label) => ({ label, type: "function", boost: -2 })),
    ];
    const result = completeFromList([...names, ...others.filter(({ label }) => !taken.has(label))])(context);
    return result as CompletionResult | null;
}
