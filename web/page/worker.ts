// The worker: it instantiates the module and passes questions on. It becomes one classic script, started from a blob.

import type { Question } from "./protocol";

type Exports = { memory: WebAssembly.Memory; room(length: number): number; ask(length: number): number; answer(): number };
export type ToWorker = { module: WebAssembly.Module | BufferSource } | { id: number; question: Question };
export type FromWorker =
    | { ready: true }
    | { failed: string }
    | { id: number; progress: number }
    | { id: number; answer: object; milliseconds: number }
    | { id: number; trap: string };

let exports: Exports | null = null;
let current = 0;

function post(message: FromWorker): void {
    self.postMessage(message);
}

async function start(module: WebAssembly.Module | BufferSource): Promise<void> {
    const progress = (part: number): void => post({ id: current, progress: part });
    try {
        const compiled = module instanceof WebAssembly.Module ? module : await WebAssembly.compile(module);
        const instance = await WebAssembly.instantiate(compiled, { page: { progress } });
        exports = instance.exports as unknown as Exports;
        post({ ready: true });
    } catch (error) {
        post({ failed: String(error) });
    }
}

function answer(module: Exports, question: Question): object {
    const bytes = new TextEncoder().encode(JSON.stringify(question));
    // The memory may have grown: its buffer is asked for after each call.
    const to = module.room(bytes.length);
    new Uint8Array(module.memory.buffer, to, bytes.length).set(bytes);
    const length = module.ask(bytes.length);
    const from = module.answer();
    return JSON.parse(new TextDecoder().decode(new Uint8Array(module.memory.buffer, from, length))) as object;
}

self.onmessage = (event: MessageEvent<ToWorker>): void => {
    const message = event.data;
    if ("module" in message) {
        void start(message.module);
        return;
    }
    current = message.id;
    const since = performance.now();
    try {
        if (exports === null) throw new Error("no module");
        post({ id: message.id, answer: answer(exports, message.question), milliseconds: performance.now() - since });
    } catch (error) {
        post({ id: message.id, trap: String(error) });
    }
};
