// Writes the values of sliders into the text.

import type { Parameter } from "./protocol";

/** Gives parameters other values in the text; a value that is a formula with commas stays as it is. */
export function rewrite(text: string, parameters: Parameter[], values: number[]): string {
    let result = text;
    parameters.forEach(({ name, value, is_angle }, index) => {
        const next = values[index];
        if (next === undefined || next === value) return;
        const written = is_angle ? `${digits((next * 180) / Math.PI)}deg` : digits(next);
        const quoted = name.replace(/[^\p{L}\p{N}_]/gu, "\\$&");
        const statement = /\bparam\b[^;]*;/gu;
        const place = new RegExp(`(?<![\\p{L}\\p{N}_])(${quoted}\\s*=\\s*)[^,;()]+`, "u");
        result = result.replace(statement, (list) => list.replace(place, (_, head: string) => head + written));
    });
    return result;
}

function digits(value: number): string {
    return String(Number(value.toPrecision(9)));
}
