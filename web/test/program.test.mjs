// The page with the program: live sheets, and a page that follows a file.

import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { pathToFileURL } from "node:url";
import { dist, drawn, FOUR_BAR, hasProgram, open, program, quit, until } from "./browser.mjs";

after(quit);

const options = { skip: hasProgram ? false : "the program is not built" };

function fileOf(text) {
    const file = join(mkdtempSync(join(tmpdir(), "linkage-")), "typed.linkage");
    writeFileSync(file, text);
    return file;
}

test("the numbers of a live sheet follow its sliders, without network", options, async () => {
    const file = fileOf(`/// </script><script>globalThis.hacked = 1</script>\n${FOUR_BAR}`);
    const sheet = file.replace(".linkage", ".html");
    execFileSync(program, ["sheet", file, "--live", "--rate", "1", "--at", "t=60deg", "--page", dist, "-o", sheet]);
    console.log(`live sheet: ${statSync(sheet).size} bytes`);
    const { page, asked, errors, close } = await open({ url: pathToFileURL(sheet).href });
    await until(page, () => document.querySelector("#linkage-live")?.shadowRoot.querySelector(".stage .island")?.shadowRoot.querySelector("svg"));
    // u = 60 degrees at the start, then 100: the angle of the coupler by the program.
    const csv = execFileSync(program, ["table", file, "--from", "100deg", "--to", "101deg", "--steps", "1", "--rate", "1"], { encoding: "utf8" });
    const [head, row] = csv.split("\n").map((line) => line.split(","));
    const rate = Number(row[head.indexOf("u_rate")]);
    await page.evaluate(() => {
        globalThis.heading = document.querySelector("main h1");
        const range = document.querySelector("#linkage-live").shadowRoot.querySelector('.slider input[type="range"]');
        range.value = String((100 * Math.PI) / 180);
        range.dispatchEvent(new Event("input"));
    });
    const shown = await until(page, (wanted) => {
        const rows = [...document.querySelectorAll("main table tr")].map((row) => [...row.children].map((cell) => cell.textContent.trim()));
        const numbers = rows.flat().map((text) => Number(text.replace("−", "-"))).filter(Number.isFinite);
        return numbers.find((number) => Math.abs(number - wanted) < 2e-3 * Math.abs(wanted));
    }, rate);
    assert.ok(Math.abs(shown - rate) < 2e-3 * Math.abs(rate));
    assert.ok(await page.evaluate(() => globalThis.heading.isConnected && globalThis.hacked === undefined));
    assert.deepEqual(asked.filter((url) => !/^(file|data|blob):/u.test(url)), []);
    assert.deepEqual(errors, []);
    await close();
});

test("a served page follows its file, and asks this server only", options, async () => {
    const file = fileOf(FOUR_BAR);
    const server = spawn(program, ["serve", file, "--page", dist], { stdio: ["ignore", "pipe", "ignore"] });
    try {
        const url = await new Promise((resolve) => server.stdout.once("data", (data) => resolve(String(data).trim())));
        const { page, asked, close } = await open({ url });
        await drawn(page);
        const names = () => [...document.querySelectorAll(".side .slider .name")].map((name) => name.textContent);
        assert.ok((await page.evaluate(names)).includes("t"));
        writeFileSync(file, FOUR_BAR.replaceAll(/\bt\b/gu, "crank"));
        await until(page, () => [...document.querySelectorAll(".side .slider .name")].some((name) => name.textContent === "crank"));
        assert.deepEqual(asked.filter((asked) => !asked.startsWith(url) && !/^(data|blob):/u.test(asked)), []);
        await close();
    } finally {
        server.kill();
    }
});
