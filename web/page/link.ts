// Text, values and view as the fragment of an address: `#1.` and the deflated JSON in base64url.

import { fromBase64, inflate } from "./wasm";

const VERSION = "1";
/** Longer addresses are cut by some programs. */
export const LONGEST = 8000;
/** What a link's text is at most, inflated: a short link may be a long text. */
const LARGEST = 2_000_000;

export type Linked = {
    text: string;
    mechanism?: string | undefined;
    parameters?: Record<string, number> | undefined;
    inputs?: number[] | undefined;
    unknowns?: number[] | undefined;
    tab?: string | undefined;
    along?: number | undefined;
    rate?: number | undefined;
    shown?: string | undefined;
    columns?: string[] | undefined;
    scene?: { scene: number; to: number; tolerance: number; values: number[]; rates: number[] } | undefined;
};

export class NewerLink extends Error {}
export class DamagedLink extends Error {}

export async function write(linked: Linked): Promise<string> {
    const bytes = new TextEncoder().encode(JSON.stringify(linked));
    const stream = new Blob([bytes]).stream().pipeThrough(new CompressionStream("deflate-raw"));
    const deflated = new Uint8Array(await new Response(stream).arrayBuffer());
    let binary = "";
    for (const byte of deflated) binary += String.fromCharCode(byte);
    return `#${VERSION}.${btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/u, "")}`;
}

/** Reads a fragment; null if it is empty. */
export async function readLink(fragment: string): Promise<Linked | null> {
    if (fragment === "" || fragment === "#") return null;
    const match = /^#(\d+)\.([A-Za-z0-9_-]*)$/u.exec(fragment);
    if (match === null) throw new DamagedLink();
    if (match[1] !== VERSION) throw new NewerLink();
    try {
        const bytes = await inflate(fromBase64((match[2] ?? "").replaceAll("-", "+").replaceAll("_", "/")), LARGEST);
        return check(JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(bytes)));
    } catch {
        throw new DamagedLink();
    }
}

/** Takes of a stranger's object what has the right type. */
function check(value: unknown): Linked {
    if (typeof value !== "object" || value === null) throw new DamagedLink();
    const from = value as Record<string, unknown>;
    if (typeof from.text !== "string") throw new DamagedLink();
    const scene = from.scene as Record<string, unknown> | undefined;
    return {
        text: from.text,
        mechanism: word(from.mechanism),
        parameters: byName(from.parameters),
        inputs: numbers(from.inputs),
        unknowns: numbers(from.unknowns),
        tab: word(from.tab),
        along: number(from.along),
        rate: number(from.rate),
        shown: word(from.shown),
        columns: Array.isArray(from.columns) ? from.columns.filter((name) => typeof name === "string").slice(0, 100) : undefined,
        scene:
            typeof scene === "object" && scene !== null
                ? {
                      scene: number(scene.scene) ?? 0,
                      to: number(scene.to) ?? 2,
                      tolerance: number(scene.tolerance) ?? 1e-8,
                      values: numbers(scene.values) ?? [],
                      rates: numbers(scene.rates) ?? [],
                  }
                : undefined,
    };
}

function word(value: unknown): string | undefined {
    return typeof value === "string" ? value : undefined;
}

function number(value: unknown): number | undefined {
    return typeof value === "number" && Number.isFinite(value) ? value : undefined;
}

function numbers(value: unknown): number[] | undefined {
    return Array.isArray(value) && value.every((item) => number(item) !== undefined) ? (value as number[]) : undefined;
}

function byName(value: unknown): Record<string, number> | undefined {
    if (typeof value !== "object" || value === null) return undefined;
    return Object.fromEntries(Object.entries(value).filter(([, item]) => number(item) !== undefined)) as Record<string, number>;
}
