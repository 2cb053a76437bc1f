// Tests of the page that breeds in headless Chromium, against a server with --library (SPOREPRINT_ALL_URL or
// SPOREPRINT_URL) and a token of it (SPOREPRINT_TOKEN).
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import test, { after, before } from "node:test";
import { addressOf, PageOfItsOwn, patience } from "./support.mjs";

const token = process.env.SPOREPRINT_TOKEN ?? "";
const json = { "Content-Type": "application/json" };
const founders = "?a=boletus_edulis&b=amanita_muscaria&seed=1&share=0.5&mutation=0.2";

const own = new PageOfItsOwn("breed", founders, { viewport: { width: 640, height: 480 } });
const openAlone = own.openAlone.bind(own);
const open = own.open.bind(own);
const at = own.at.bind(own);
const { base } = own;

before(() => own.launch());

after(() => own.close());

const ready = (page) => at(page, "ready");

const children = (page) => page.evaluate(() => window.breeding.children());
const hashes = async (page) => (await children(page)).map(({ hash }) => hash);
const sentence = (page) => page.locator("#sentence").textContent();

/** Does something, and waits until other nine children are drawn. */
async function after9(page, act) {
    const before = JSON.stringify(await children(page));
    await act();
    await page.waitForFunction(
        (old) => document.documentElement.dataset.breed === "ready" && JSON.stringify(window.breeding.children()) !== old,
        before,
        { timeout: patience },
    );
}

/** Saves what has the focus or is clicked, and returns the text of the file. */
async function savedText(page, act) {
    const [download] = await Promise.all([page.waitForEvent("download"), act()]);
    return readFile(await download.path(), "utf8");
}

function assertQuiet({ console: lines, failed }) {
    assert.deepEqual(failed, []);
    assert.deepEqual(lines.filter((line) => /^(error|warning|uncaught)/.test(line)), []);
}

/** Moves focus with Tab until an element has it. */
async function tabTo(page, selector) {
    for (let presses = 0; presses < 90; ++presses) {
        if (await page.evaluate((wanted) => document.activeElement?.matches(wanted), selector)) return;
        await page.keyboard.press("Tab");
    }
    assert.fail(`Tab never comes to ${selector}`);
}

test("two parents have nine different children, each with its seed in its label", async () => {
    const { page, log } = await open();
    assert.equal(await sentence(page), "Nine children of Cep and Fly agaric");
    const shown = await children(page);
    assert.deepEqual(shown.map(({ genes }) => genes.seed), [1, 2, 3, 4, 5, 6, 7, 8, 9]);
    assert.equal(new Set(shown.map(({ hash }) => hash)).size, 9);
    const labels = await page.locator(".child").evaluateAll((all) => all.map((one) => one.getAttribute("aria-label")));
    labels.forEach((label, index) =>
        assert.match(label, new RegExp(`^F1, seed ${index + 1}, of Cep × Fly agaric, [\\d.]+ cm high, [\\d.]+ cm wide$`)),
    );
    const colours = await page.locator("#grid canvas").evaluate((canvas) => {
        const small = new OffscreenCanvas(120, 120);
        const context = small.getContext("2d");
        context.drawImage(canvas, 0, 0, 120, 120);
        const { data } = context.getImageData(0, 0, 120, 120);
        return new Set(new Uint32Array(data.buffer)).size;
    });
    assert.ok(colours > 500, `${colours} colours are drawn`);
    await after9(page, () => page.locator("#again").click());
    const again = await children(page);
    assert.deepEqual(again.map(({ genes }) => genes.seed), [10, 11, 12, 13, 14, 15, 16, 17, 18]);
    assert.equal(new Set([...shown, ...again].map(({ hash }) => hash)).size, 18);
    assertQuiet(log);
});

test("a chosen child is a parent of the next nine; back and forwards in the tree are the same bytes", async () => {
    const { page, log } = await open();
    const first = await hashes(page);
    await after9(page, () => page.locator('[data-child="4"]').click());
    assert.equal(await sentence(page), "Nine mutations of F1·5");
    const second = await hashes(page);
    assert.notDeepEqual(second, first);
    // A child of the child with the second founder.
    await page.locator("#mate").selectOption("a");
    await after9(page, () => page.locator('[data-child="1"]').click());
    assert.equal(await sentence(page), "Nine children of F2·2 and F1·5");
    const third = await hashes(page);
    const row = (name) => page.locator(".row-of-tree", { has: page.locator("b", { hasText: name }) }).first();
    await after9(page, () => row("F1·5").click());
    assert.deepEqual(await hashes(page), second);
    await after9(page, () => row("F2·2").click());
    assert.deepEqual(await hashes(page), third);
    // The browser's own steps are those of the page.
    await after9(page, () => page.goBack());
    assert.deepEqual(await hashes(page), second);
    await after9(page, () => row("Cep × Fly agaric").click());
    assert.deepEqual(await hashes(page), first);
    await page.locator("#mate").selectOption("self");
    assertQuiet(log);
});

test("one address is the same nine in another browser, and the tree survives a reload", async () => {
    const line = "line=boletus_edulis,amanita_muscaria,5,0.5,0.2;.1,.1,2,0.5,0.4,ring-surface.cap";
    const query = `?a=.2&b=amanita_muscaria&seed=40&share=0.25&mutation=0.3&lock=surface.stem&${line}`;
    const { page, log } = await open(query);
    assert.equal(await sentence(page), "Nine children of F2·2 and Fly agaric");
    const here = await children(page);
    const { page: other, log: otherLog } = await openAlone(query);
    assert.deepEqual(await children(other), here);
    assert.equal((await addressOf(other)).search, query, "the address stays as it was");
    const rows = (of) => of.locator(".row-of-tree").evaluateAll((all) => all.map((one) => one.getAttribute("aria-label")));
    const tree = await rows(other);
    assert.deepEqual(tree, [
        "Cep × Fly agaric, founders",
        "F1·5, seed 5, of Cep × Fly agaric",
        "F2·2, seed 2, mutated from F1·5, with Fly agaric",
    ]);
    await other.goto(`${base}/breed`);
    await ready(other);
    assert.equal(await sentence(other), "Nine children of F2·2 and Fly agaric");
    assert.deepEqual(await children(other), here);
    assert.deepEqual(await rows(other), tree);
    await other.context().close();
    assertQuiet(log);
    assertQuiet(otherLog);
});

test("a locked part stays as in the first parent, and the species says so", async () => {
    const { page, log } = await open("?a=boletus_edulis&b=boletus_edulis&seed=3&mutation=1&lock=size");
    const cep = await (await fetch(`${base}/v1/species/boletus_edulis`)).json();
    const caps = ({ stages }) => stages.map(({ model }) => model.surface.cap);
    const stems = ({ stages }) => stages.map(({ model }) => model.surface.stem);
    const save = async () => {
        await page.locator('[data-child="0"]').press("s");
        await page.locator("#save-dialog").waitFor();
        const text = await savedText(page, () => page.locator("#save-json").click());
        await page.locator("#save-close").click();
        return JSON.parse(text);
    };
    const free = await save();
    assert.notDeepEqual(caps(free), caps(cep));
    await page.locator("#lock-group").evaluate((group) => (group.open = true));
    await after9(page, () => page.locator('[data-lock="surface.cap"]').check());
    assert.match((await addressOf(page)).href, /lock=size,surface\.cap/);
    const locked = await save();
    assert.deepEqual(caps(locked), caps(cep));
    assert.deepEqual(stems(locked), stems(free), "no other part changes with it");
    assert.match(locked.facts.sources[0], /boletus_edulis and boletus_edulis: seed 3, .*mutation 1, lock size, lock surface\.cap/);
    await after9(page, () => page.locator('[data-lock="surface.cap"]').uncheck());
    assertQuiet(log);
});

test("by keyboard alone from the first nine to a saved species, which the service takes", async () => {
    const { page, log } = await open();
    await page.locator("body").evaluate(() => document.activeElement?.blur());
    await tabTo(page, ".child");
    for (const key of ["ArrowDown", "ArrowRight", "ArrowRight", "ArrowRight"]) await page.keyboard.press(key);
    const focused = () => page.evaluate(() => document.activeElement.dataset.child);
    assert.equal(await focused(), "5");
    await after9(page, () => page.keyboard.press("Enter"));
    assert.equal(await focused(), "5", "the focus stays where it is");
    await page.keyboard.press("Home");
    await page.keyboard.press("s");
    await page.locator("#save-dialog").waitFor();
    const text = await savedText(page, () => page.keyboard.press("Enter"));
    await page.keyboard.press("Escape");
    const species = JSON.parse(text);
    assert.match(species.facts.sources.join("\n"), /seed 1, .*\nBred of boletus_edulis and amanita_muscaria: seed 6/);
    const { model } = species.stages.at(-1);
    for (const [address, body] of [
        ["v1/mushrooms.glb", { model, lod: 3 }],
        ["v1/offspring.json", { a: species, b: "amanita_muscaria", seed: 2 }],
    ]) {
        const response = await fetch(`${base}/${address}`, { method: "POST", headers: json, body: JSON.stringify(body) });
        assert.equal(response.status, 200, address);
    }
    // The tree by its own keys: up to the founders.
    await tabTo(page, ".row-of-tree");
    await page.keyboard.press("Home");
    await after9(page, () => page.keyboard.press("Enter"));
    assert.equal(await sentence(page), "Nine children of Cep and Fly agaric");
    // Of the children's couple nothing is left once its branch is taken off.
    const rows = await page.locator(".row-of-tree").count();
    await page.keyboard.press("ArrowDown");
    page.once("dialog", (dialog) => dialog.accept());
    await page.keyboard.press("Delete");
    await page.waitForFunction((before) => document.querySelectorAll(".row-of-tree").length < before, rows);
    assert.equal(await sentence(page), "Nine children of Cep and Fly agaric");
    assertQuiet(log);
});

test("the second parent can be what can be crossed with the first, also of the library", async () => {
    const { page, log } = await open();
    const name = `kid_${Date.now() % 1_000_000}`;
    await page.locator('[data-child="2"]').press("s");
    await page.locator("#save-name").fill(name);
    await page.locator("#save-token").fill(token);
    await page.locator("#save-library button").click();
    await page.locator("#save-stored", { hasText: `~me.${name}@1 is published` }).waitFor();
    const address = await page.locator("#save-stored .address").getAttribute("href");
    assert.equal((await fetch(new URL(address, `${base}/`))).status, 200, address);
    await page.locator("#save-dialog").screenshot({ path: "build/screenshots/breed_saved.png" });
    await page.locator("#save-close").click();
    const { species } = await (await fetch(`${base}/v1/library?q=${name}`)).json();
    assert.deepEqual([species[0].parent, species[0].parent2], ["boletus_edulis", "amanita_muscaria"]);
    await page.locator("#change-b").click();
    await page.locator("#parent-note", { hasText: "branched species cannot be crossed with Cep, which is swept" }).waitFor();
    assert.equal(await page.locator('[data-species="ramaria_formosa"]').count(), 0);
    await page.locator("#parent-search").fill(name);
    await after9(page, () => page.locator(`[data-species="~me.${name}@1"]`).click());
    assert.match((await addressOf(page)).href, new RegExp(`b=~me\\.${name}@1`));
    assert.equal(new Set(await hashes(page)).size, 9);
    // A first parent of another family is bred alone.
    await page.locator("#change-a").click();
    await after9(page, () => page.locator('[data-species="ramaria_formosa"]').click());
    assert.match((await addressOf(page)).href, /a=ramaria_formosa&b=ramaria_formosa/);
    assertQuiet(log);
});

test("what an address gets wrong is said in a sentence, and other children can be bred", async () => {
    const { page } = await open("?a=boletus_edulis&b=ramaria_formosa", "failed");
    const problem = page.locator("#problem");
    assert.match(await problem.textContent(), /only species of one family can be crossed/);
    await after9(page, () => page.locator("#alone").click());
    assert.equal(await problem.isVisible(), false);
    await open("?a=boletus_edulis&mutation=7");
    assert.match(await problem.textContent(), /mutation '7' is no number from 0 to 1/);
    await open("?a=own-0123456789a", "failed");
    assert.match(await problem.textContent(), /only the browser where it was made has it/);
});

test("a child goes to the designer as its draft, and comes back from there as a parent", async () => {
    const { page, log } = await open();
    page.once("dialog", (dialog) => void dialog.accept());
    await page.locator('[data-child="0"]').press("s");
    await page.locator("#save-designer").click();
    await page.waitForFunction(() => document.documentElement.dataset.designer === "ready", undefined, { timeout: patience });
    assertQuiet(log);
    await page.goto(`${base}/breed`);
    await ready(page);
    // Leaving may cut off the images of a model that was still being drawn, which the loader reports.
    log.console.length = 0;
    await page.locator("#change-b").click();
    await after9(page, () => page.locator("#parent-draft").click());
    assert.match(await sentence(page), /^Nine children of .* and Cep × Fly agaric$/);
    assert.equal(new Set(await hashes(page)).size, 9);
    assertQuiet(log);
});
