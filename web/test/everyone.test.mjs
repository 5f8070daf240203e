// Keyboard, screen reader, contrast, phone, dark, reduced motion, Italian.

import assert from "node:assert/strict";
import { after, test } from "node:test";
import { choose, drawn, open, quit, setField, until } from "./browser.mjs";

after(quit);

test("every control has a name, and tabs, sliders and menus take keys", async () => {
    const { page, close } = await open();
    await drawn(page);
    const nameless = await page.evaluate(() => {
        const controls = [...document.querySelectorAll("button, input, select, textarea, [tabindex]")].filter((control) => control.checkVisibility());
        const name = (control) => control.getAttribute("aria-label") || control.getAttribute("aria-labelledby") || control.textContent.trim() || control.closest("label")?.textContent.trim();
        return controls.filter((control) => !name(control)).map((control) => control.outerHTML.slice(0, 90));
    });
    assert.deepEqual(nameless.filter((html) => !html.startsWith("<main")), []);
    await page.focus("#tab-picture");
    await page.keyboard.press("ArrowRight");
    assert.equal(await page.evaluate(() => document.activeElement.id), "tab-sheet");
    assert.equal(await page.$eval("#panel-sheet", (panel) => panel.hidden), false);
    await page.keyboard.press("ArrowLeft");
    await page.focus('.side .slider input[type="range"]');
    const before = await page.$eval(".side .slider .number", (field) => field.value);
    await page.keyboard.press("ArrowRight");
    await until(page, (old) => document.querySelector(".side .slider .number").value !== old, before);
    assert.match(await page.$eval('.side .slider input[type="range"]', (range) => range.getAttribute("aria-valuetext")), /°/u);
    await page.focus(".menu.wide > button");
    await page.keyboard.press("ArrowDown");
    await page.keyboard.press("ArrowDown");
    await page.keyboard.press("Enter");
    await until(page, () => document.querySelector("select.mechanism").checkVisibility());
    assert.deepEqual(await page.$$eval("select.mechanism option", (options) => options.map((option) => option.textContent)), ["Engine", "Compressor"]);
    // The focus is seen.
    await page.focus("#tab-picture");
    await page.keyboard.press("Tab");
    const outline = await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle);
    assert.notEqual(outline, "none");
    await close();
});

test("texts have contrast, light and dark", async () => {
    for (const theme of ["light", "dark"]) {
        const { page, close } = await open({ theme });
        await drawn(page);
        const ratios = await page.evaluate(() => {
            const probe = document.body.appendChild(document.createElement("i"));
            const canvas = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
            const luminance = (name) => {
                probe.style.color = `var(${name})`;
                canvas.fillStyle = getComputedStyle(probe).color;
                canvas.fillRect(0, 0, 1, 1);
                const [r, g, b] = [...canvas.getImageData(0, 0, 1, 1).data].slice(0, 3).map((part) => (part / 255 <= 0.04045 ? part / 255 / 12.92 : ((part / 255 + 0.055) / 1.055) ** 2.4));
                return 0.2126 * r + 0.7152 * g + 0.0722 * b;
            };
            const pairs = [["--ink", "--paper"], ["--soft", "--paper"], ["--soft", "--card"], ["--accent", "--paper"], ["--accent", "--tint"], ["--on-accent", "--accent"], ["--bad", "--paper"], ["--warn", "--warn-back"], ["--doc", "--paper"], ["--number", "--paper"], ["--function", "--paper"]];
            return pairs.map(([text, back]) => {
                const [a, b] = [luminance(text), luminance(back)].sort((x, y) => y - x);
                return [`${text} on ${back}`, (a + 0.05) / (b + 0.05)];
            });
        });
        for (const [pair, ratio] of ratios) assert.ok(ratio >= 4.5, `${theme}: ${pair} has ${ratio.toFixed(2)}`);
        await close();
    }
});

test("on a phone nothing is wider than the screen, and the text is a tab", async () => {
    const { page, close } = await open({ width: 390, height: 844, isPhone: true });
    await drawn(page);
    for (const tab of ["text", "picture", "sheet", "charts", "circuits", "simulation", "report", "rust"]) {
        await page.tap(`#tab-${tab}`);
        await new Promise((resolve) => setTimeout(resolve, 400));
        const [width, screen] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
        assert.ok(width <= 390 && screen <= 390, `${tab}: ${width} of ${screen}`);
    }
    await page.tap("#tab-picture");
    await page.evaluate(() => scrollTo(0, 700));
    const top = await page.$eval(".stage", (stage) => stage.getBoundingClientRect().top);
    assert.ok(top >= 0 && top < 60, `the picture is ${top} pixels below the top while sliders are seen`);
    await page.tap("#tab-text");
    assert.ok(await page.$eval(".editor", (editor) => editor.checkVisibility()));
    await close();
});

test("a finger drags a joint", async () => {
    const { page, close } = await open({ width: 390, height: 844, isPhone: true });
    await drawn(page);
    await until(page, () => document.querySelector(".stage .island").shadowRoot.querySelector(".curve"));
    const places = await page.evaluate(() => {
        const svg = document.querySelector(".stage .island").shadowRoot.querySelector("svg");
        return ["O", "B"].map((name) => {
            const group = [...svg.querySelectorAll("g[transform]")].find((one) => one.querySelector("text")?.textContent.trim() === name);
            const box = group.querySelector("path,circle").getBoundingClientRect();
            return [box.x + box.width / 2, box.y + box.height / 2];
        });
    });
    const [[ox, oy], [bx, by]] = places;
    const radius = Math.hypot(bx - ox, by - oy);
    await page.touchscreen.touchStart(bx, by);
    for (const angle of [80, 100, 120]) {
        const at = (angle * Math.PI) / 180;
        await page.touchscreen.touchMove(ox + radius * Math.cos(at), oy - radius * Math.sin(at));
        await until(page, (wanted) => Math.abs(Number.parseFloat(document.querySelector(".side .slider .number").value) - wanted) < 12, angle);
    }
    await page.touchscreen.touchEnd();
    assert.equal(await page.evaluate(() => scrollY), 0);
    await close();
});

test("Italian: interface, limits, legend, circuits and sheet", async () => {
    const { page, close } = await open({ language: "it" });
    await drawn(page);
    assert.equal(await page.$eval("#tab-sheet", (tab) => tab.textContent), "Foglio");
    assert.equal(await page.evaluate(() => document.documentElement.lang), "it");
    // With this crank the coupler and the rocker come into line, and the motion ends.
    await setField(page, "l2", "50");
    await setField(page, "theta2", "170");
    await page.click(".chip.velocities");
    const said = (selector, pattern) => until(page, (at, wanted) => new RegExp(wanted, "u").test(document.querySelector(at).textContent), selector, pattern);
    const legend = (name) => until(page, (word) => document.querySelector(".stage .island").shadowRoot.textContent.includes(`${word} × `), name);
    await said(".banner", "^theta2 si ferma a .*°: punto morto di theta3, theta4\\.$");
    await said(".side .ends", "°: punto morto di theta3, theta4");
    await legend("velocità");
    await choose(page, "circuits");
    await said("#panel-circuits .lines", "^2 posizioni, 1 moto, 1 circuito\nmoto 1, circuito 1: theta2 va e viene tra");
    await choose(page, "sheet");
    await until(page, () => /^Equazioni/u.test(document.querySelector("#panel-sheet .island").shadowRoot.querySelector("h2")?.textContent ?? ""));
    await page.click(".menu.language > button");
    await (await page.$$(".menu.language .items button"))[0].click();
    assert.equal(await page.$eval("#tab-sheet", (tab) => tab.textContent), "Sheet");
    await said(".banner", "^theta2 stops at .*°: dead point of theta3, theta4\\.$");
    await legend("velocity");
    await until(page, () => /Constraint/u.test(document.querySelector("#panel-sheet .island").shadowRoot.textContent));
    await close();
});

test("colours are the system's, or chosen; motion is reduced where it is asked for", async () => {
    const { page, close } = await open({ theme: "dark" });
    await drawn(page);
    const back = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    assert.equal(await back(), "rgb(21, 23, 27)");
    await page.click("header .menu:nth-of-type(4) > button");
    await (await page.$$("header .menu:nth-of-type(4) .items button"))[1].click();
    assert.equal(await back(), "rgb(253, 252, 248)");
    await page.emulateMediaFeatures([{ name: "prefers-reduced-motion", value: "reduce" }]);
    assert.match(await page.$eval(".stage .island", (island) => getComputedStyle(island).transitionDuration), /^0s/u);
    await close();
});
