// The module: it is in the page as base64 of deflated bytes, so that the page asks the network for nothing.

declare global {
    // Set by module.js.
    var linkageModule: string | undefined;
}

export class NoWebAssembly extends Error {}
export class NoModule extends Error {}

/** Inflates deflated bytes, of at most `limit` bytes. */
export async function inflate(bytes: Uint8Array<ArrayBuffer>, limit: number): Promise<Uint8Array<ArrayBuffer>> {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
    const reader = stream.getReader();
    const parts: Uint8Array<ArrayBuffer>[] = [];
    let length = 0;
    for (;;) {
        const { done, value } = await reader.read();
        if (done) break;
        length += value.length;
        if (length > limit) {
            await reader.cancel();
            throw new RangeError("too long");
        }
        parts.push(value as Uint8Array<ArrayBuffer>);
    }
    return new Uint8Array(await new Blob(parts).arrayBuffer());
}

export function fromBase64(text: string): Uint8Array<ArrayBuffer> {
    const binary = atob(text);
    const bytes = new Uint8Array(binary.length);
    for (let at = 0; at < binary.length; at += 1) bytes[at] = binary.charCodeAt(at);
    return bytes;
}

export async function loadModule(): Promise<WebAssembly.Module> {
    if (typeof WebAssembly !== "object" || typeof DecompressionStream !== "function") throw new NoWebAssembly();
    try {
        if (globalThis.linkageModule === undefined) throw new NoModule();
        const bytes = await inflate(fromBase64(globalThis.linkageModule), 2 ** 28);
        return await WebAssembly.compile(bytes);
    } catch (error) {
        throw new NoModule(String(error));
    }
}
