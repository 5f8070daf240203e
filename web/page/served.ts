// A page that `linkage serve` gives follows a file: its text is asked for again and again, and taken when it changed.

const INTERVAL = 700;

/** The name of the file, as the server wrote it into the page; null for a page that is no server's. */
export function servedFile(): string | null {
    const meta = document.querySelector('meta[name="linkage-file"]');
    return meta?.getAttribute("content") ?? null;
}

/** Takes the text of the file now and after each change; says once why it cannot be read, or null if the server is gone. */
export function followFile(take: (text: string) => void, say: (why: string | null) => void): void {
    let tag = "";
    let said: string | null = "";
    async function look(): Promise<void> {
        try {
            const headers: Record<string, string> = tag === "" ? {} : { "If-None-Match": tag };
            const answer = await fetch("/text", { headers, cache: "no-store" });
            if (answer.status === 200) {
                tag = answer.headers.get("ETag") ?? "";
                said = "";
                take(await answer.text());
            } else if (answer.status !== 304) {
                tell(await answer.text());
            }
        } catch {
            tell(null);
        }
        setTimeout(() => void look(), INTERVAL);
    }
    function tell(why: string | null): void {
        if (said !== why) say(why);
        said = why;
    }
    void look();
}
