// `linkage serve` gives the page the name of a file: then, and only then, it asks that server for the file's text.

const PERIOD = 1000;

function name(): string | null {
    return document.querySelector<HTMLMetaElement>('meta[name="linkage-file"]')?.content ?? null;
}

export function isServed(): boolean {
    return name() !== null;
}

/** Loads the text of the file now, and after each change. */
export function followFile(load: (text: string) => void): void {
    if (!isServed()) return;
    let tag: string | null = null;
    const ask = async (): Promise<void> => {
        try {
            const response = await fetch("/text", { cache: "no-store", headers: tag === null ? {} : { "If-None-Match": tag } });
            if (response.status === 200) {
                tag = response.headers.get("ETag");
                load(await response.text());
            }
        } catch {
            // The program was ended: the text stays as it is, and the next answer counts.
        }
        setTimeout(() => void ask(), PERIOD);
    };
    void ask();
}
