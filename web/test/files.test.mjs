// Texts as files: saved, opened again, and files that are no text.

import assert from "node:assert/strict";
import { existsSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { setTimeout as wait } from "node:timers/promises";
import { after, test } from "node:test";
import { drawn, FOUR_BAR, open, paste, PATIENCE, quit, readText, until } from "./browser.mjs";

after(quit);

/** Clicks an item of the menu of files by its words. */
const item = (page, words) =>
    page.evaluate((wanted) => {
        const items = [...document.querySelectorAll("header .menu .items button")];
        items.find((button) => button.textContent.trim() === wanted).click();
    }, words);

const hasSlider = (page, name) =>
    until(page, (wanted) => [...document.querySelectorAll(".side .slider .name")].some(({ textContent }) => textContent === wanted), name);

async function choose(page, file) {
    const [chooser] = await Promise.all([page.waitForFileChooser(), item(page, "Open a file…")]);
    await chooser.accept([file]);
}

test("a text is saved as a file and opened again", async () => {
    const folder = mkdtempSync(join(tmpdir(), "linkage-"));
    const { page, close } = await open();
    await drawn(page);
    await paste(page, FOUR_BAR);
    await readText(page);
    await hasSlider(page, "t");
    const client = await page.createCDPSession();
    await client.send("Page.setDownloadBehavior", { behavior: "allow", downloadPath: folder });
    await item(page, "Save as a file");
    const saved = join(folder, "Typed.linkage");
    for (let waited = 0; !existsSync(saved) && waited < PATIENCE; waited += 50) await wait(50);
    assert.equal(readFileSync(saved, "utf8"), FOUR_BAR);

    writeFileSync(saved, FOUR_BAR.replaceAll(/\bt\b/gu, "crank"));
    await choose(page, saved);
    await hasSlider(page, "crank");

    // A file that is no text leaves the page as it is, with a sentence.
    const bytes = join(folder, "picture.linkage");
    writeFileSync(bytes, Buffer.from([0xff, 0xfe, 0x80, 0x00]));
    await choose(page, bytes);
    await until(page, () => [...document.querySelectorAll('[role="status"], [role="alert"]')].some(({ textContent }) => /text/u.test(textContent)));
    await hasSlider(page, "crank");
    await close();
});
