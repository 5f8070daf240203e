// What somebody does with the page: types, reads, moves, makes a mistake, simulates, copies.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { writeFileSync, mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { choose, drawn, example, fieldOf, focusText, FOUR_BAR, hasProgram, joints, number, open, paste, program, quit, readText, setField, until } from "./browser.mjs";

after(quit);

/** A row of the program's table, by the name of the column. */
function table(text, inputs, set = []) {
    const file = join(mkdtempSync(join(tmpdir(), "linkage-")), "typed.linkage");
    writeFileSync(file, text);
    const [name, degrees] = inputs;
    const values = set.length > 0 ? ["--set", set.join(",")] : [];
    const range = ["--from", `${degrees}deg`, "--to", `${degrees + 1}deg`, "--steps", "1", "--rate", "1"];
    const csv = execFileSync(program, ["table", file, "--along", name, ...range, ...values], { encoding: "utf8" });
    const [head, row] = csv.split("\n").map((line) => line.split(","));
    return Object.fromEntries(head.map((column, index) => [column, Number(row[index])]));
}

const numbersOf = (page) =>
    page.$$eval(".numbers tbody tr", (rows) => rows.map((row) => [...row.children].map((cell) => cell.textContent)));

test("a typed four-bar has formulas, numbers and a picture that follow its slider", async () => {
    const { page, errors, close } = await open();
    await drawn(page);
    await paste(page, "");
    await page.keyboard.type(FOUR_BAR);
    await readText(page);
    await until(page, () => document.querySelector(".side .slider .name")?.textContent === "t");
    await drawn(page);

    await choose(page, "sheet");
    const formulas = await until(page, () => {
        const root = document.querySelector("#panel-sheet .island").shadowRoot;
        const found = [...root.querySelectorAll("annotation")].map((formula) => formula.textContent);
        return root.textContent.includes("Typed") && found.some((formula) => formula.includes("Psi_1")) && found;
    });
    assert.ok(formulas.some((formula) => formula === "\\Psi_1 = a \\cos t + b \\cos u - d - c \\cos v"), formulas.slice(0, 8).join("\n"));
    // The rest of the sheet stays where it is while its numbers change.
    await page.evaluate(() => {
        const panel = document.querySelector("#panel-sheet");
        panel.scrollTop = 400;
        globalThis.kept = panel.querySelector(".island").shadowRoot.querySelector("h1");
        globalThis.before = panel.querySelector(".island").shadowRoot.textContent;
    });
    await setField(page, "t", "75");
    await until(page, () => document.querySelector("#panel-sheet .island").shadowRoot.textContent !== globalThis.before);
    const kept = await page.evaluate(() => globalThis.kept.isConnected && document.querySelector("#panel-sheet").scrollTop === 400);
    assert.ok(kept, "the sheet was replaced");
    const text = await page.evaluate(() => document.querySelector("#panel-sheet .island").shadowRoot.textContent);
    assert.match(text, /75/u);

    await choose(page, "picture");
    if (hasProgram) {
        for (const [degrees, parameters] of [[75, []], [200, []], [200, ["b=110"]]]) {
            await setField(page, "t", String(degrees));
            for (const parameter of parameters) await setField(page, ...parameter.split("="));
            const row = table(FOUR_BAR, ["t", degrees], parameters);
            const rows = await until(
                page,
                (wanted) => {
                    const rows = [...document.querySelectorAll(".numbers tbody tr")].map((row) => [...row.children].map((cell) => cell.textContent));
                    const degrees = Number(rows[1]?.[1].replace("−", "-").replace("°", ""));
                    return Math.abs(((degrees - wanted + 540) % 360) - 180) < 1e-2 && rows;
                },
                (row.u * 180) / Math.PI,
            );
            const [, u, v] = rows;
            assert.ok(Math.abs(number(u[2]) - row.u_rate) < 1e-3 * Math.max(1, Math.abs(row.u_rate)), `${u} ${row.u_rate}`);
            assert.ok(Math.abs(number(v[3]) - row.v_acceleration) < 1e-3 * Math.max(1, Math.abs(row.v_acceleration)), `${v} ${row.v_acceleration}`);
            await drawn(page);
            const { found, scale } = await joints(page);
            for (const name of ["P", "Q"]) {
                const [x, y] = found[name];
                const distance = Math.hypot(x - row[`${name}_x`], y - row[`${name}_y`]);
                assert.ok(distance * scale < 0.2, `${name} is ${distance * scale} pixels from its place`);
            }
        }
    } else {
        console.log("the program linkage is not built: its numbers were not compared");
    }
    assert.deepEqual(errors, []);
    await close();
});

test("a mistake is underlined on its token, with its help, and the last picture stays, marked as old", async () => {
    const { page, close } = await open();
    await drawn(page);
    await paste(page, FOUR_BAR.replace("b@u = c", "b@w = c"));
    await readText(page);
    const marks = await until(page, () => {
        const found = document.querySelector(".editor").shadowRoot.querySelectorAll(".cm-lintRange-error");
        return found.length > 0 && [...found].map((mark) => mark.textContent);
    });
    assert.ok(marks.includes("w"), marks.join());
    const listed = await page.$eval(".mistakes li", (item) => item.textContent);
    assert.match(listed, /`w`/u);
    assert.equal(await page.$eval(".stage", (stage) => stage.hasAttribute("data-old")), true);
    assert.ok(await page.evaluate(() => document.querySelector(".stage .island").shadowRoot.querySelector("svg") !== null));
    assert.match(await page.$eval(".banner", (banner) => banner.textContent), /mistakes/u);
    // Sliders still move the last good text.
    await setField(page, "theta2", "90");
    await until(page, () => document.querySelector(".numbers tbody td")?.textContent === "90°");
    await paste(page, FOUR_BAR);
    await drawn(page);
    assert.equal(await page.$eval(".status", (status) => status.textContent), "No mistakes");
    await close();
});

test("names are completed", async () => {
    const { page, close } = await open();
    await drawn(page);
    await paste(page, FOUR_BAR.replace(/\}$/u, ""));
    await page.keyboard.type("output double = m");
    await until(page, () => [...document.querySelector(".editor").shadowRoot.querySelectorAll(".cm-tooltip-autocomplete li")].some((item) => item.textContent.startsWith("mu")));
    await close();
});

test("a joint is dragged: the input follows and counts turns; at a limit it stops with a word", async () => {
    const { page, close } = await open();
    await drawn(page);
    const screen = (name) =>
        page.evaluate((wanted) => {
            const svg = document.querySelector(".stage .island").shadowRoot.querySelector("svg");
            const group = [...svg.querySelectorAll("g[transform]")].find((group) => group.querySelector("text")?.textContent.trim() === wanted);
            const box = group.querySelector("path,circle").getBoundingClientRect();
            return [box.x + box.width / 2, box.y + box.height / 2];
        }, name);
    // Traces make the frame of the picture wider.
    await until(page, () => document.querySelector(".stage .island").shadowRoot.querySelector(".curve"));
    const [ox, oy] = await screen("O");
    const [bx, by] = await screen("B");
    const radius = Math.hypot(bx - ox, by - oy);
    await page.mouse.move(bx, by);
    await page.mouse.down();
    // One turn and a half from 60 degrees.
    for (let angle = 60; angle <= 600; angle += 15) {
        const at = (angle * Math.PI) / 180;
        await page.mouse.move(ox + radius * Math.cos(at), oy - radius * Math.sin(at));
        await until(
            page,
            (wanted) => {
                const text = document.querySelector('.side .slider input.number[aria-label^="theta2,"]').value;
                return Math.abs(Number(text.replace("−", "-").replace("°", "")) - wanted) < 40;
            },
            angle,
        );
    }
    await page.mouse.up();
    await until(page, () => document.querySelector(".badge").textContent === "turn 2");
    assert.ok(Math.abs(number(await fieldOf(page, "theta2")) - 600) < 20);

    await paste(page, example("linkages/watt_line"));
    await until(page, () => document.querySelector(".side .slider .name")?.textContent === "theta");
    await drawn(page);
    await setField(page, "theta", "150");
    await until(page, () => /dead point|locks/u.test(document.querySelector(".banner").textContent));
    const stopped = number(await fieldOf(page, "theta"));
    assert.ok(Math.abs(stopped - 150) > 1, String(stopped));
    await close();
});

test("a position is chosen among all of them", async () => {
    const { page, close } = await open();
    await drawn(page);
    await until(page, () => document.querySelectorAll(".positions button svg, .positions button").length === 2);
    const before = await numbersOf(page);
    await page.click('.positions button[aria-checked="false"]');
    await until(page, (old) => document.querySelector(".numbers tbody tr:nth-child(2) td").textContent !== old, before[1][1]);
    assert.equal(await page.$$eval('.positions [aria-checked="true"]', (chosen) => chosen.length), 1);
    // The sliders follow this motion, not its branch.
    await setField(page, "theta2", "100");
    await until(page, () => document.querySelector(".numbers tbody td").textContent === "100°");
    assert.ok(number((await numbersOf(page))[1][1]) < 0);
    await close();
});

test("parameters without a position: the picture says which group cannot close", async () => {
    const { page, close } = await open();
    await drawn(page);
    await setField(page, "l1", "300");
    const said = await until(page, () => /theta3/u.test(document.querySelector(".banner").textContent) && document.querySelector(".banner").textContent);
    assert.match(said, /does not close|cannot be assembled/u);
    await close();
});

test("a scene is simulated, played and stopped", async () => {
    const { page, errors, close } = await open();
    await drawn(page);
    await paste(page, example("machines/door_closer"));
    await until(page, () => document.querySelector(".side .slider .name")?.textContent === "door");
    await drawn(page);
    await choose(page, "simulation");
    await page.click(".settings button.primary");
    await until(page, () => document.querySelectorAll(".results figure").length > 3);
    assert.match(await page.$eval(".events", (list) => list.textContent), /From 0 s to 2 s/u);
    const frame = () => page.evaluate(() => document.querySelector(".film .island").shadowRoot.querySelector("svg")?.innerHTML ?? "");
    await until(page, () => document.querySelector(".film .island").shadowRoot.querySelector("svg"));
    const first = await frame();
    await page.click(".play");
    await until(page, () => Number.parseFloat(document.querySelector(".clock").value) > 0.4);
    await page.click(".play");
    assert.notEqual(await frame(), first);
    const time = await page.$eval(".clock", (clock) => clock.value);
    await new Promise((resolve) => setTimeout(resolve, 300));
    assert.equal(await page.$eval(".clock", (clock) => clock.value), time, "it is paused");

    // A long one is stopped, and the page goes on.
    await paste(page, example("machines/engine"));
    await until(page, () => document.querySelector(".side .slider .name")?.textContent === "phi");
    await until(page, () => document.querySelector(".stage .island").shadowRoot.querySelector(".curve"));
    const field = (await page.$$(".settings .number"))[0];
    await field.click({ count: 3 });
    await field.type("100000");
    await page.click(".settings button.primary");
    await until(page, () => {
        const work = document.querySelector(".work");
        const isSeen = !work.hidden && work.querySelector("span").textContent === "Computing";
        if (isSeen) work.querySelector("button").click();
        return isSeen;
    });
    await until(page, () => document.querySelector("#panel-simulation .why").textContent === "Stopped.");
    await choose(page, "sheet");
    await until(page, () => document.querySelector("#panel-sheet .island").shadowRoot.textContent.includes("Engine"));
    assert.deepEqual(errors, []);
    await close();
});

test("charts, circuits, report and code are there", async () => {
    const { page, errors, close } = await open();
    await drawn(page);
    await choose(page, "charts");
    await until(page, () => document.querySelectorAll("#panel-charts figure").length > 0);
    const figures = await page.$$eval("#panel-charts figure", (all) => all.length);
    await page.click('.chip[data-column="C_speed"]');
    await until(page, (old) => document.querySelectorAll("#panel-charts figure").length === old + 1, figures);
    const title = await page.evaluate(() => [...document.querySelectorAll("#panel-charts figure .island")].at(-1).shadowRoot.textContent);
    assert.match(title, /C_speed/u);
    await choose(page, "circuits");
    await until(page, () => /circuit/u.test(document.querySelector("#panel-circuits .lines").textContent));
    await choose(page, "report");
    await until(page, () => /Grübler/u.test(document.querySelector("#panel-report .island").shadowRoot.textContent));
    await choose(page, "rust");
    await until(page, () => /pub (const )?fn/u.test(document.querySelector("#panel-rust code").textContent));
    assert.deepEqual(errors, []);
    await close();
});

test("what is copied is Rust, LaTeX, SVG, CSV and a link that brings everything back", async () => {
    const { page, close } = await open();
    await drawn(page);
    await setField(page, "theta2", "123");
    await setField(page, "l2", "25");
    await until(page, () => document.querySelector(".numbers tbody td").textContent === "123°");
    const copy = async (menu, index) => {
        const count = await page.evaluate(() => globalThis.copied.length);
        await page.click(`header .menu:nth-of-type(${menu}) > button`);
        const items = await page.$$(`header .menu:nth-of-type(${menu}) .items button`);
        await items[index].click();
        await until(page, (before) => globalThis.copied.length > before, count);
        return page.evaluate(() => globalThis.copied.at(-1));
    };
    assert.match(await copy(3, 0), /^use linkage::linkage;\n\nlinkage! \{\n {4}\/\/\/[\s\S]*mechanism FourBar[\s\S]*\}\n$/u);
    assert.match(await copy(3, 1), /impl/u);
    assert.match(await copy(3, 2), /\\Psi/u);
    assert.match(await copy(3, 3), /^<svg/u);
    assert.match(await copy(3, 4), /^theta2,/u);
    const link = await copy(2, 2);
    assert.ok(link.length < 8000);
    const other = await open({ url: link });
    await drawn(other.page);
    await until(other.page, () => document.querySelector(".numbers tbody td")?.textContent === "123°");
    assert.equal(await fieldOf(other.page, "l2"), "25");
    await other.close();
    await close();
});

test("values of sliders are written into the text", async () => {
    const { page, close } = await open();
    await drawn(page);
    await setField(page, "l3", "55");
    await page.waitForSelector(".side .actions:not([hidden]) button:nth-child(2)");
    await page.click(".side .actions button:nth-child(2)");
    await until(page, () => document.querySelector(".editor").shadowRoot.textContent.includes("l3 = 55"));
    await focusText(page);
    await close();
});

test("every example has a sentence in each language, and is drawn", async () => {
    const { page, errors, close } = await open();
    await drawn(page);
    const sentences = () => page.$$eval(".menu.wide .items button", (items) => items.map((item) => item.querySelector("span").textContent));
    const english = await sentences();
    assert.ok(english.length >= 12 && english.every((sentence) => sentence.endsWith(".")), english.join("\n"));
    for (let index = 0; index < english.length; index += 1) {
        await page.evaluate(() => (globalThis.before = document.title));
        await page.evaluate((at) => document.querySelectorAll(".menu.wide .items button")[at].click(), index);
        if (index > 0) await until(page, () => document.title !== globalThis.before);
        await drawn(page);
        await until(page, () => document.querySelectorAll(".positions button").length > 0);
        assert.equal(await page.$eval(".status", (status) => status.textContent), "No mistakes");
        assert.equal(await page.$eval(".banner", (banner) => banner.textContent), "", await page.title());
    }
    await page.click(".menu.language > button");
    await (await page.$$(".menu.language .items button"))[1].click();
    const italian = await sentences();
    assert.ok(italian.every((sentence, index) => sentence.endsWith(".") && sentence !== english[index]));
    assert.deepEqual(errors, []);
    await close();
});
