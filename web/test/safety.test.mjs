// Texts of strangers, bad links, browsers that lack something.

import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { join } from "node:path";
import { tmpdir } from "node:os";
import { pathToFileURL } from "node:url";
import { after, test } from "node:test";
import { address, choose, dist, drawn, example, examples, FOUR_BAR, linkOf, open, paste, quit, readText, setField, until } from "./browser.mjs";

after(quit);

const HOSTILE = [
    "/// </script><script>globalThis.hacked = 1</script><img src=x onerror=\"globalThis.hacked = 1\">",
    "/// <svg onload=\"globalThis.hacked = 1\"><style>*{display:none}</style> \u202e ]]> --> <!-- `${globalThis.hacked = 1}`",
    FOUR_BAR,
].join("\n");

/** Elements of the whole page, shadow roots included, that no view makes of a text. */
const suspects = (page) =>
    page.evaluate(() => {
        const found = [];
        const look = (root) => {
            for (const element of root.querySelectorAll("*")) {
                const isBad = element.localName === "script" || element.localName === "iframe" || [...element.attributes].some(({ name }) => name.startsWith("on"));
                const isForeign = element.localName === "img" && !element.getAttribute("src").startsWith("data:");
                if ((isBad || isForeign) && element.closest("body > script") === null) found.push(element.outerHTML.slice(0, 80));
                if (element.shadowRoot) look(element.shadowRoot);
            }
        };
        look(document.body);
        return found;
    });

test("the page asks the network for nothing, in any view", async () => {
    const types = { html: "text/html", js: "text/javascript", css: "text/css" };
    const server = createServer((request, response) => {
        const name = request.url.slice(1);
        const isThere = /^[a-z]+\.(html|js|css)$/u.test(name);
        response.writeHead(isThere ? 200 : 404, { "Content-Type": types[name.split(".")[1]] ?? "text/plain" });
        response.end(isThere ? readFileSync(join(dist, name)) : "");
    });
    await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
    const served = `http://127.0.0.1:${server.address().port}/`;
    const folder = pathToFileURL(`${dist}/`).href;
    for (const [base, name] of [[folder, "linkage.html"], [folder, "index.html"], [served, "index.html"]]) {
        const { page, asked, errors, close } = await open({ url: `${base}${name}` });
        await drawn(page);
        for (const tab of ["sheet", "charts", "circuits", "report", "rust", "simulation", "picture"]) {
            await choose(page, tab);
            await new Promise((resolve) => setTimeout(resolve, 700));
        }
        const own = ["linkage.html", "index.html", "page.js", "module.js", "style.css"].map((file) => `${base}${file}`);
        assert.deepEqual(asked.filter((url) => !own.includes(url.split("#")[0]) && !/^(blob|data):/u.test(url)), []);
        assert.deepEqual(errors, []);
        const policy = await page.$eval("meta[http-equiv]", (meta) => meta.content);
        assert.match(policy, /default-src 'none'/u);
        assert.match(policy, /connect-src 'none'/u);
        assert.doesNotMatch(policy, /unsafe-inline|unsafe-eval'? |https?:/u);
        const isBlocked = await page.evaluate(() => fetch("https://example.org/").then(() => false, () => true));
        assert.ok(isBlocked);
        await close();
    }
    server.close();
});

test("hostile comments and links are text", async () => {
    const link = await linkOf({ text: HOSTILE, tab: "<img src=x onerror=alert(1)>", mechanism: "</script>", columns: ["<b>"], parameters: { __proto__: 1, a: 1e400 } });
    const { page, asked, errors, close } = await open({ url: link });
    await drawn(page);
    for (const tab of ["sheet", "charts", "circuits", "report", "rust", "picture"]) {
        await choose(page, tab);
        await new Promise((resolve) => setTimeout(resolve, 900));
        assert.deepEqual(await suspects(page), [], tab);
    }
    await choose(page, "sheet");
    await until(page, () => document.querySelector("#panel-sheet .island").shadowRoot.textContent.includes("<img src=x onerror="));
    assert.equal(await page.evaluate(() => globalThis.hacked), undefined);
    assert.deepEqual(asked.filter((url) => !url.startsWith(address) && !/^(blob|data):/u.test(url)), []);
    assert.deepEqual(errors, []);
    // Names cannot be markup: the compiler says so, and its words are text too.
    await paste(page, "mechanism <img src=x onerror=alert(1)> { }");
    await readText(page);
    await page.waitForSelector(".mistakes li");
    assert.deepEqual(await suspects(page), []);
    await close();
});

test("damaged, newer and swollen links are one sentence each", async () => {
    const good = await linkOf({ text: FOUR_BAR });
    const bomb = await linkOf({ text: "x".repeat(50_000_000) });
    const newer = await linkOf({ text: FOUR_BAR }, "2");
    for (const [url, said] of [
        [good.slice(0, -9), /damaged/u],
        [`${address}#1.%%%`, /damaged/u],
        [`${address}#nonsense`, /damaged/u],
        [await linkOf({ text: 5 }), /damaged/u],
        [bomb, /damaged/u],
        [newer, /newer/u],
    ]) {
        const { page, close } = await open({ url });
        await until(page, () => document.querySelector(".notice.seen"));
        assert.match(await page.$eval(".notice", (notice) => notice.textContent), said);
        // The page is of use all the same.
        await drawn(page);
        await close();
    }
});

test("a module that cannot be loaded, and a browser without WebAssembly, are one sentence each", async () => {
    const html = readFileSync(join(dist, "linkage.html"), "utf8");
    const file = join(mkdtempSync(join(tmpdir(), "linkage-")), "incomplete.html");
    writeFileSync(file, html.replace(/linkageModule="[^"]*"/u, (module) => `${module.slice(0, module.length / 2)}"`));
    for (const [options, said] of [
        [{ url: pathToFileURL(file).href }, /cannot be loaded/u],
        [{ before: () => (WebAssembly.compile = () => Promise.reject(new Error("damaged"))) }, /cannot be loaded/u],
        [{ before: () => delete globalThis.WebAssembly }, /no WebAssembly/u],
        [{ before: () => delete globalThis.WebAssembly, language: "it" }, /non ha WebAssembly/u],
    ]) {
        const { page, close } = await open(options);
        await page.waitForSelector(".failure");
        assert.match(await page.$eval(".failure", (failure) => failure.textContent), said);
        await close();
    }
});

test("a worker that cannot start is one sentence", async () => {
    const { page, close } = await open({
        before: () => {
            const instantiate = Worker.prototype.postMessage;
            Worker.prototype.postMessage = function (message) {
                instantiate.call(this, "module" in message ? { module: new Uint8Array(3).buffer } : message);
            };
        },
    });
    await until(page, () => /cannot be loaded/u.test(document.body.textContent));
    await close();
});

/** Prefixes of an example: all of the smallest; of the others, whose keys would take an hour, a dozen unless LINKAGE_EVERY_PREFIX=1. */
function prefixes(name, text) {
    const step = name.endsWith("scotch_yoke") || process.env.LINKAGE_EVERY_PREFIX === "1" ? 1 : Math.ceil(text.length / 12);
    const ends = [];
    for (let end = 0; end < text.length; end += step) ends.push(end);
    return [...ends, text.length];
}

test("the prefixes of every example are read, and the last good picture stays", async () => {
    const { page, errors, close } = await open();
    for (const name of examples) {
        await drawn(page);
        const text = example(name);
        for (const end of prefixes(name, text)) {
            await paste(page, text.slice(0, end));
            await readText(page);
            const state = await page.evaluate(() => ({
                isDrawn: document.querySelector(".stage .island").shadowRoot.querySelector("svg") !== null,
                words: `${document.querySelector(".status").textContent} ${document.querySelector(".banner").textContent}`,
            }));
            assert.ok(state.isDrawn, `${name}: prefix of ${end}`);
            assert.doesNotMatch(state.words, /failed|cannot be loaded/u, `${name}: prefix of ${end}`);
        }
        const [, input] = /^\s*(?:input|drive \w+ by) (\w+)/mu.exec(text);
        await until(page, (wanted) => document.querySelector(".side .slider .name")?.textContent === wanted, input);
    }
    await drawn(page);
    assert.deepEqual(errors, []);
    await close();
});

/** A row of four-bars, each driven by the rocker of the one before. */
function row(count) {
    const names = Array.from({ length: count }, (_, k) => k);
    const unknowns = names.map((k) => `p${k}, q${k}`).join(", ");
    const loops = names.map((k) => `loop a@${k === 0 ? "t" : `q${k - 1}`} + b@p${k} = c@q${k} + d@0;`).join("\n");
    return `mechanism Row { param a = 40, b = 120, c = 80, d = 100; input t; unknown ${unknowns};\n${loops} }`;
}

test("a megabyte of text and two hundred loops leave the keys free", async () => {
    const { page, close } = await open();
    await drawn(page);
    for (const text of [`// ${"long ".repeat(190_000)}\n${FOUR_BAR}`, `mechanism ${"{ (".repeat(100_000)}`, row(200)]) {
        await paste(page, text);
        // While it is read, a key is seen at once.
        const waited = await page.evaluate(async () => {
            let longest = 0;
            for (let at = performance.now(), end = at + 3000; at < end; ) {
                await new Promise((resolve) => setTimeout(resolve, 10));
                longest = Math.max(longest, performance.now() - at);
                at = performance.now();
            }
            return longest;
        });
        assert.ok(waited < 1500, `the page did not answer for ${waited} ms`);
        await readText(page);
    }
    await paste(page, `${FOUR_BAR}\n// ${"x".repeat(1_000_000)}`);
    await until(page, () => /1000 kB/u.test(document.querySelector(".notice").textContent));
    await paste(page, FOUR_BAR);
    await until(page, () => document.querySelector(".side .slider .name")?.textContent === "t");
    await drawn(page);
    await close();
});

test("a text too long for a link is offered as a file", async () => {
    const { page, close } = await open();
    await drawn(page);
    let noise = "";
    for (let k = 0, x = 1; k < 12_000; k += 1) {
        x = (x * 48271) % 2147483647;
        noise += (x % 36).toString(36);
    }
    await paste(page, `// ${noise}\n${FOUR_BAR}`);
    await until(page, () => document.querySelector(".side .slider .name")?.textContent === "t");
    await page.click("header .menu:nth-of-type(2) > button");
    await (await page.$$("header .menu:nth-of-type(2) .items button"))[2].click();
    const said = await page.waitForSelector("dialog[open] p");
    assert.match(await said.evaluate((element) => element.textContent), /more than the 8 kB/u);
    assert.match(await page.$eval("dialog .primary", (button) => button.textContent), /Save/u);
    await setField(page, "a", "41").catch(() => {});
    await close();
});
