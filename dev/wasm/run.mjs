// Computes the lines of `vectors.tsv` in WebAssembly and compares them: node run.mjs MODULE VECTORS

import { readFileSync } from "node:fs";

const [module, vectors] = process.argv.slice(2);
const { instance } = await WebAssembly.instantiate(readFileSync(module), {});
const { begin, compute, text, bytes, memory } = instance.exports;
const read = () => new TextDecoder().decode(new Uint8Array(memory.buffer, text(), bytes()));

const expected = readFileSync(vectors, "utf8").trimEnd().split("\n");
const count = begin();
let differences = count === expected.length ? 0 : 1;
for (let place = 0; place < count; place += 1) {
    try {
        compute(place);
    } catch (error) {
        console.log(`${expected[place]}\n    ${error}: ${read()}`);
        process.exit(1);
    }
    if (read() !== expected[place]) {
        console.log(`${expected[place]} expected\n${read()} found`);
        differences += 1;
    }
}
console.log(`${count} lines of ${expected.length}, ${differences} differences`);
process.exit(differences === 0 ? 0 : 1);
