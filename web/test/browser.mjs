// A browser with the page, for tests: LINKAGE_DIST is the folder of the build, CHROMIUM the browser.

import { existsSync, readdirSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import puppeteer from "puppeteer-core";

const here = dirname(fileURLToPath(import.meta.url));
export const root = dirname(dirname(here));
export const dist = process.env.LINKAGE_DIST ?? join(dirname(here), "dist");
export const program = process.env.LINKAGE_PROGRAM ?? join(root, "target", "debug", "linkage");
export const hasProgram = existsSync(program);
export const address = pathToFileURL(join(dist, "linkage.html")).href;

/** How long a test waits for what the page computes. */
export const PATIENCE = 60_000;

export const examples = ["linkages", "machines"].flatMap((folder) =>
    readdirSync(join(root, "examples", folder)).filter((file) => file.endsWith(".linkage")).map((file) => `${folder}/${file.slice(0, -".linkage".length)}`),
);
export const example = (name) => readFileSync(join(root, "examples", `${name}.linkage`), "utf8");

let browser;

/**
 * Opens the page. Whatever it asks for beyond its own file, and each error on its console, is kept in `asked` and `errors`.
 * `before` runs in the page before its scripts.
 */
export async function open({ url = address, before, width = 1440, height = 900, isPhone = false, theme = "light", language = "en" } = {}) {
    browser ??= await puppeteer.launch({
        executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
        args: ["--no-sandbox", "--disable-dev-shm-usage"],
    });
    const context = await browser.createBrowserContext();
    const page = await context.newPage();
    page.setDefaultTimeout(PATIENCE);
    const asked = [];
    const errors = [];
    page.on("request", (request) => asked.push(request.url()));
    page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
    page.on("pageerror", (error) => errors.push(error.message));
    await page.setViewport({ width, height, isMobile: isPhone, hasTouch: isPhone, deviceScaleFactor: isPhone ? 2 : 1 });
    await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: theme }]);
    await page.evaluateOnNewDocument((chosen) => {
        Object.defineProperty(navigator, "language", { value: chosen });
        globalThis.copied = [];
        Object.defineProperty(navigator, "clipboard", { value: { writeText: async (text) => void globalThis.copied.push(text) } });
    }, language);
    if (before) await page.evaluateOnNewDocument(before);
    await page.goto(url);
    return { page, asked, errors, close: () => context.close() };
}

export async function quit() {
    await browser?.close();
    browser = undefined;
}

/** Waits until a function in the page gives something true, and returns it. */
export async function until(page, check, ...values) {
    const handle = await page.waitForFunction(check, { timeout: PATIENCE, polling: 50 }, ...values);
    return handle.jsonValue();
}

/** The picture is there and belongs to the text. */
export const drawn = (page) =>
    until(page, () => {
        const stage = document.querySelector(".stage");
        return stage?.querySelector(".island").shadowRoot.querySelector("svg") && !stage.hasAttribute("data-old");
    });

/** Replaces the text as a paste does. */
export async function paste(page, text) {
    await focusText(page);
    await page.keyboard.down("Control");
    await page.keyboard.press("a");
    await page.keyboard.up("Control");
    await page.keyboard.press("Delete");
    await page.evaluate((pasted) => {
        const data = new DataTransfer();
        data.setData("text/plain", pasted);
        const content = document.querySelector(".editor").shadowRoot.querySelector(".cm-content");
        content.dispatchEvent(new ClipboardEvent("paste", { clipboardData: data, bubbles: true, cancelable: true }));
    }, text);
}

export const focusText = (page) => page.evaluate(() => document.querySelector(".editor").shadowRoot.querySelector(".cm-content").focus());

/** Waits until the text was read: mistakes are those of this text. */
export const readText = (page) => until(page, () => document.querySelector(".mistakes") && !document.querySelector(".mistakes").hasAttribute("data-waiting"));

/** What a view of the module's drawings and sheets says. */
export const shadowText = (page, selector) => page.evaluate((at) => document.querySelector(at).shadowRoot.textContent, selector);

export async function choose(page, name) {
    await page.click(`#tab-${name}`);
}

/** Writes into the field of a slider. */
export async function setField(page, name, text) {
    const field = await page.waitForSelector(`.side .slider input.number[aria-label^="${name},"]`);
    await field.click({ count: 3 });
    await field.type(text);
    await page.keyboard.press("Enter");
}

export const fieldOf = (page, name) => page.$eval(`.side .slider input.number[aria-label^="${name},"]`, (field) => field.value);

/** The number of a text with a true minus sign, perhaps in degrees. */
export const number = (text) => Number(text.replace("−", "-").replace("°", ""));

/** Places of joints in the plane, read from the drawing: its grid has the scale. */
export const joints = (page) =>
    page.evaluate(() => {
        const svg = document.querySelector(".stage .island").shadowRoot.querySelector("svg");
        const numbers = [...svg.querySelectorAll("text.tick")].map((tick) => ({
            value: Number(tick.textContent.trim().replace("−", "-")),
            x: Number(tick.getAttribute("x")),
            y: Number(tick.getAttribute("y")),
            isX: tick.getAttribute("text-anchor") === "middle",
        }));
        const lines = [...svg.querySelectorAll("line.grid")].map((line) => ["x1", "x2", "y1", "y2"].map((name) => Number(line.getAttribute(name))));
        const xs = numbers.filter((tick) => tick.isX).sort((a, b) => a.value - b.value);
        const ys = lines.filter(([, , y1, y2]) => y1 === y2).map(([, , y]) => y).sort((a, b) => b - a);
        const values = numbers.filter((tick) => !tick.isX).map((tick) => tick.value).sort((a, b) => a - b);
        const scale = (xs.at(-1).x - xs[0].x) / (xs.at(-1).value - xs[0].value);
        const x0 = xs[0].x - scale * xs[0].value;
        const y0 = ys[0] + scale * values[0];
        const found = {};
        for (const group of svg.querySelectorAll("g[transform]")) {
            const name = group.querySelector("text")?.textContent.trim();
            const match = /translate\(([-\d.]+)[ ,]([-\d.]+)\)/.exec(group.getAttribute("transform"));
            if (name && match) found[name] = [(Number(match[1]) - x0) / scale, (y0 - Number(match[2])) / scale];
        }
        return { found, scale };
    });

/** A link to a text, made as the page makes it. */
export async function linkOf(object, version = "1") {
    const { deflateRawSync } = await import("node:zlib");
    return `${address}#${version}.${deflateRawSync(Buffer.from(JSON.stringify(object))).toString("base64url")}`;
}

export const FOUR_BAR =
    "mechanism Typed { param a = 40, b = 120, c = 80, d = 100; input t; unknown u, v; " +
    "loop a@t + b@u = c@v + d@0; point P = a@t; point Q = P + b@u; output mu = v - u; }";
