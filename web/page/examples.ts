// The examples: files of the repository, embedded at the build.

import files from "linkage:examples";
import type { Item } from "./menu";
import type { Words } from "./words";

export type Example = { name: string; text: string };
export const examples: Example[] = files;

export function exampleItems(take: (example: Example) => void): Item[] {
    const words = (w: Words, name: string): readonly [string, string] => w.exampleWords[name as keyof Words["exampleWords"]] ?? [name, ""];
    return examples.map((example) => ({
        label: (w) => words(w, example.name)[0],
        more: (w) => words(w, example.name)[1],
        act: () => take(example),
    }));
}
