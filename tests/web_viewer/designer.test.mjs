// Tests of the designer's page in headless Chromium against a running server (SPOREPRINT_URL). The
// photograph is a picture of the service itself.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import path from "node:path";
import test, { after, before } from "node:test";
import {
    bundled,
    launchBrowser,
    logEvents,
    patience,
    reload,
    root,
    screenshotFolder,
    serverUrl,
} from "./support.mjs";

// What a photograph looks like is found among all species.
const base = serverUrl({ everySpecies: true });

/** Where the mushroom of the photograph is: its foot, top and both ends of its cap. */
const foot = [447, 705];
const top = [405, 42];
const cap = [
    [95, 165],
    [708, 92],
];

/** On the photograph from below: a line across the cap, where the stem is fixed and where it ends. */
const capBelow = [
    [190, 210],
    [600, 150],
];
const stemBelow = [
    [405, 200],
    [430, 345],
];

let browser;
let shared;
let folder;
let photograph;
let cutOut;
let fromAbove;
let fromBelow;

before(async () => {
    folder = await screenshotFolder();
    browser = await launchBrowser();
    const picture = async (view, background) => {
        const query = `width=800&height=800&view=${view}&background=${background}`;
        const response = await fetch(`${base}/v1/mushrooms/russula_emetica.png?${query}`);
        assert.equal(response.status, 200);
        return {
            name: `russula_${view}.png`,
            mimeType: "image/png",
            buffer: Buffer.from(await response.arrayBuffer()),
        };
    };
    [photograph, cutOut, fromAbove, fromBelow] = await Promise.all([
        picture("front", "grey"),
        picture("front", "transparent"),
        picture("top", "grey"),
        picture("below", "grey"),
    ]);
});

after(() => browser?.close());

/** Opens the page in a context of its own; `log` has its console messages and requests. */
async function openAlone(options) {
    const context = await browser.newContext({ reducedMotion: "reduce", ...options });
    const page = await context.newPage();
    page.setDefaultTimeout(patience);
    const log = logEvents(page);
    await page.goto(`${base}/editor`);
    await at(page, "empty");
    return { page, log };
}

/** Returns the page that most tests share, because software WebGL takes seconds for a new stage;
 *  each of them begins with another file. Its log starts anew. */
async function open(viewport = { width: 800, height: 480 }) {
    shared ??= await openAlone({ viewport });
    const { page, log } = shared;
    await page.setViewportSize(viewport);
    for (const list of Object.values(log)) list.length = 0;
    await page.locator("details.numbers").evaluate((details) => (details.open = false));
    return shared;
}

/** Waits until the page is empty, ready or failed. */
function at(page, state) {
    return page.waitForFunction(
        (wanted) => document.documentElement.dataset.designer === wanted,
        state,
        { timeout: patience },
    );
}

async function give(page, file = photograph) {
    await page.locator("#file").setInputFiles(file);
    await page.locator("#desk").waitFor();
    await at(page, "ready");
}

/** Returns a place of the photograph in pixels of the window. */
function onScreen(page, point, sketch = "#sketch") {
    return page.locator(sketch).evaluate((element, [x, y]) => {
        const place = new DOMPoint(x, y).matrixTransform(element.getScreenCTM());
        return { x: place.x, y: place.y };
    }, point);
}

async function stroke(page, from, to, sketch = "#sketch") {
    await page.locator(sketch).scrollIntoViewIfNeeded();
    const [a, b] = [await onScreen(page, from, sketch), await onScreen(page, to, sketch)];
    await page.mouse.move(a.x, a.y);
    await page.mouse.down();
    await page.mouse.move((a.x + b.x) / 2, (a.y + b.y) / 2);
    await page.mouse.move(b.x, b.y);
    await page.mouse.up();
}

/** Moves the crosshair of the focused photograph by keys. */
async function moveCrosshair(page, [x, y], place = "#place") {
    const [fromX, fromY] = (await page.locator(place).textContent()).split(", ").map(Number);
    for (const [by, keys] of [
        [x - fromX, ["ArrowLeft", "ArrowRight"]],
        [y - fromY, ["ArrowUp", "ArrowDown"]],
    ]) {
        const key = keys[by > 0 ? 1 : 0];
        const far = Math.abs(by);
        for (let n = 0; n < Math.floor(far / 10); ++n) await page.keyboard.press(`Shift+${key}`);
        for (let n = 0; n < far % 10; ++n) await page.keyboard.press(key);
    }
    assert.equal(await page.locator(place).textContent(), `${x}, ${y}`);
}

async function drawLines(page) {
    await stroke(page, foot, top);
    await stroke(page, ...cap);
    await page.locator("#sketch .outline").waitFor({ state: "attached" });
    await at(page, "ready");
}

const sentence = (page) => page.locator("#sentence").textContent();
const strokes = (page, tool) => page.locator(`#sketch .strokes .${tool}`).count();

/** Returns left, top, right and bottom of the outline, pixels of the photograph. */
function outline(page) {
    return page.locator("#sketch .outline").evaluate((path) => {
        const { x, y, width, height } = path.getBBox();
        return [x, y, x + width, y + height];
    });
}

function expectNoProblems(log) {
    assert.deepEqual(log.failed, []);
    assert.deepEqual(log.console, []);
}

function expectNear(values, wanted, tolerance) {
    const off = values.map((value, index) => Math.abs(value - wanted[index]));
    assert.ok(Math.max(...off) <= tolerance, `${values} is not ${wanted}`);
}

async function saved(page, button) {
    const [download] = await Promise.all([
        page.waitForEvent("download"),
        page.locator(button).click(),
    ]);
    return { name: download.suggestedFilename(), bytes: await readFile(await download.path()) };
}

const traces = (log) => log.requests.filter((url) => url.endsWith("/v1/traces")).length;

test("two lines on a photograph make a species with a model", async () => {
    const { page, log } = await open({ width: 1400, height: 880 });
    assert.match(await page.locator("footer").textContent(), /never for identifying mushrooms/);
    const text = { name: "notes.txt", mimeType: "text/plain", buffer: Buffer.from("no picture") };
    await page.locator("#file").setInputFiles(text);
    await at(page, "failed");
    assert.match(await page.locator("#welcome-error").textContent(), /This is no photograph: choose a JPEG/);
    await open({ width: 1400, height: 880 });
    await give(page);
    assert.equal(await sentence(page), "Draw from the foot to the top");
    await stroke(page, foot, top);
    assert.equal(await sentence(page), "Now across the cap");
    assert.equal(traces(log), 0, "one line is not enough");
    await stroke(page, ...cap);
    await page.locator("#sketch .outline").waitFor({ state: "attached" });
    await at(page, "ready");
    expectNear(await outline(page), [88, 40, 714, 715], 25);
    assert.equal(await page.locator("#sketch .mark").count(), 4);
    const names = await page.locator("#nearest b").allTextContents();
    assert.equal(names.length, 5);
    for (const name of names) assert.match(name, /^looks like our /);
    const numbers = await page.locator("#found-numbers dt").allTextContents();
    for (const name of ["Height", "Cap", "Error", "Asymmetry", "Bend", "Method", "Proof"])
        assert.ok(numbers.includes(name), `${name} of ${numbers}`);
    const glb = await saved(page, "#download-glb");
    assert.equal(glb.bytes.toString("latin1", 0, 4), "glTF");
    const species = JSON.parse((await saved(page, "#download-json")).bytes.toString());
    assert.equal(glb.name, `${species.id}.glb`);
    for (const { model } of species.stages) {
        const response = await fetch(`${base}/v1/mushrooms.glb`, {
            method: "POST",
            headers: { "Content-Type": "application/json" },
            body: JSON.stringify({ model, lod: 3, textures: "none" }),
        });
        assert.equal(response.status, 200, "each stage of the species grows");
        await response.arrayBuffer();
    }
    await page.locator("#nearest img").last().scrollIntoViewIfNeeded();
    await page.waitForFunction(() =>
        [...document.querySelectorAll("#nearest img")].every((image) => image.complete),
    );
    await page.locator("#panel").evaluate((panel) => panel.scrollTo(0, 0));
    await page.screenshot({ path: path.join(folder, "designer.png") });
    expectNoProblems(log);
});

test("another species lends the rest, its height can be chosen, and both can be undone", async () => {
    const { page, log } = await open();
    await give(page);
    await drawLines(page);
    const second = page.locator("#nearest button").nth(1);
    const id = await second.getAttribute("data-species");
    await second.click();
    await at(page, "ready");
    const chosen = page.locator(`#nearest button[data-species="${id}"]`);
    assert.equal(await chosen.getAttribute("aria-pressed"), "true");
    await page.locator("#height").fill("50");
    await page.locator("#height").press("Enter");
    await at(page, "ready");
    const height = page.locator("#found-numbers dd").first();
    assert.match(await height.textContent(), /^(49|50|51) mm$/);
    const before = traces(log);
    await page.locator("#undo").click();
    await at(page, "ready");
    assert.doesNotMatch(await height.textContent(), /^(49|50|51) mm$/);
    await page.locator("#undo").click();
    await at(page, "ready");
    assert.equal(await page.locator("#template-auto").getAttribute("aria-pressed"), "true");
    await page.locator("#redo").click();
    await at(page, "ready");
    assert.equal(await chosen.getAttribute("aria-pressed"), "true");
    assert.equal(traces(log), before, "what was traced is at hand again");
    expectNoProblems(log);
});

test("strokes correct the outline, and each gesture can be undone and done again", async () => {
    const { page, log } = await open();
    await give(page);
    await drawLines(page);
    const whole = await outline(page);
    await page.locator('#tools [data-tool="keep"]').click();
    await stroke(page, [440, 500], [450, 640]);
    await page.locator('#tools [data-tool="drop"]').click();
    await stroke(page, [700, 700], [600, 730]);
    await page.locator('#tools [data-tool="frame"]').click();
    await stroke(page, [40, 10], [760, 740]);
    await page.locator('#tools [data-tool="axis"]').click();
    await stroke(page, top, [380, 48]);
    const drawn = async () => Promise.all(["keep", "drop", "frame"].map((t) => strokes(page, t)));
    assert.deepEqual(await drawn(), [1, 1, 1]);
    await page.locator("details.numbers summary").click();
    const x = page.locator("#point-0-1-0");
    expectNear([Number(await x.inputValue())], [380], 2);
    await page.locator("#sketch").focus();
    for (let step = 0; step < 4; ++step) await page.keyboard.press("Control+z");
    await at(page, "ready");
    assert.deepEqual(await drawn(), [0, 0, 0]);
    assert.deepEqual(await outline(page), whole);
    for (let step = 0; step < 2; ++step) await page.keyboard.press("Control+z");
    assert.equal(await strokes(page, "axis"), 0);
    assert.equal(await sentence(page), "Draw from the foot to the top");
    for (let step = 0; step < 6; ++step) await page.keyboard.press("Control+y");
    assert.deepEqual(await drawn(), [1, 1, 1]);
    assert.equal(await page.locator("#redo").isDisabled(), true);
    expectNoProblems(log);
});

test("the keyboard alone draws both lines, and the table has the same points", async () => {
    const { page, log } = await open();
    page.once("filechooser", (chooser) => chooser.setFiles(photograph));
    await Promise.all([
        page.waitForResponse((response) => response.url().endsWith(".jpg")),
        page.locator("#choose:visible, #another:visible").press("Enter"),
    ]);
    await page.locator("#sentence", { hasText: "Draw from the foot to the top" }).waitFor();
    await at(page, "ready");
    assert.equal(await page.evaluate(() => document.activeElement.id), "sketch");
    const go = (place) => moveCrosshair(page, place);
    await go(foot);
    await page.keyboard.press("Enter");
    await go([420, 500]);
    await page.keyboard.press("Enter");
    await page.keyboard.press("Escape");
    assert.match(await page.locator("#status").textContent(), /taken back; 1 left/);
    await go(top);
    await page.keyboard.press("Enter");
    await page.keyboard.press("Enter");
    assert.equal(await sentence(page), "Now across the cap");
    for (const end of cap) {
        await go(end);
        await page.keyboard.press("Enter");
    }
    await page.keyboard.press("Enter");
    await at(page, "ready");
    assert.match(await page.locator("#status").textContent(), /^Traced: .* looks like our /);
    await page.locator('#tools [data-tool="axis"]').press("Enter");
    await page.locator("details.numbers summary").press("Enter");
    const values = await page
        .locator("#points input")
        .evaluateAll((all) => all.map((i) => +i.value));
    assert.deepEqual(values, [...foot, ...top]);
    await page.locator("#point-0-0-1").fill("700");
    await page.locator("#point-0-0-1").press("Enter");
    await at(page, "ready");
    const d = await page.locator("#sketch .strokes .axis .line").getAttribute("d");
    assert.match(d, /^M447\.0 700\.0L/);
    expectNoProblems(log);
});

test("fingers alone draw, on targets that they can hit", async () => {
    const { page, log } = await openAlone({
        viewport: { width: 800, height: 1000 },
        hasTouch: true,
        isMobile: true,
    });
    await give(page);
    const tap = async (point) => {
        const { x, y } = await onScreen(page, point);
        await page.touchscreen.tap(x, y);
    };
    await tap(foot);
    await tap(top);
    await tap(top);
    assert.equal(await sentence(page), "Now across the cap");
    await tap(cap[0]);
    await page.locator("#take-back").tap();
    for (const end of cap) await tap(end);
    await page.locator("#finish").tap();
    await at(page, "ready");
    await page.locator("#template-auto").scrollIntoViewIfNeeded();
    const small = await page
        .locator("button:visible")
        .evaluateAll((buttons) =>
            buttons
                .filter((button) => button.getBoundingClientRect().height < 44)
                .map((button) => button.textContent),
        );
    assert.deepEqual(small, []);
    await page.locator("#cap-file-above").setInputFiles(fromAbove);
    await page.locator("#cap-dialog").waitFor();
    const smallInDialog = await page
        .locator("#cap-dialog button:visible")
        .evaluateAll((buttons) => buttons.map((button) => button.getBoundingClientRect().height));
    assert.ok(Math.min(...smallInDialog) >= 44, `${smallInDialog}`);
    await page.locator("#cap-cancel").tap();
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.equal(wide, 0, "nothing is wider than the window");
    await page.screenshot({ path: path.join(folder, "designer_800.png"), fullPage: true });
    expectNoProblems(log);
});

test("points of the outline are moved on the photograph, and a reload keeps the draft", async () => {
    const { page, log } = await open();
    await give(page);
    await drawLines(page);
    const found = async (name) =>
        page.locator(`#found-numbers dt:text-is("${name}") + dd`).textContent();
    const traced = await found("Cap");
    await page.locator('#tools [data-tool="outline"]').click();
    await page.locator("#sketch").scrollIntoViewIfNeeded();
    const focused = () =>
        page.evaluate(() => document.activeElement.getAttribute("aria-label") ?? "");
    assert.match(
        await focused(),
        /^stem, point 2 of \d+, [\d.]+ mm from the axis, [\d.]+ mm high$/,
    );
    const points = await page.locator(".handle[role=button]").count();
    const margin = page.locator('.handle[role=button][aria-label^="cap, point 2 "]');
    const index = Number(await margin.getAttribute("data-index"));
    // The left side is dragged, and the right one follows.
    const [from, right] = await Promise.all(
        [page.locator(`.handle[data-index="${index}"][data-side="-1"]`), margin].map((handle) =>
            handle.locator(".knob").boundingBox(),
        ),
    );
    const middle = ({ x, y, width, height }) => ({ x: x + width / 2, y: y + height / 2 });
    const { x, y } = middle(from);
    await page.mouse.move(x, y);
    await page.mouse.down();
    // With Ctrl it does not snap to what was measured.
    await page.keyboard.down("Control");
    await page.mouse.move(x - 10, y);
    await page.mouse.up();
    await page.keyboard.up("Control");
    await at(page, "ready");
    assert.ok(middle(await margin.locator(".knob").boundingBox()).x > middle(right).x + 5);
    assert.equal(await found("Method"), "traced, then edited");
    const dragged = await found("Cap");
    assert.ok(parseFloat(dragged) > parseFloat(traced), `${dragged} after ${traced}`);
    assert.match(await focused(), /^cap, point 2 /);
    // A held key is one step of undo.
    await page.evaluate(() => {
        window.said = [];
        const status = document.getElementById("status");
        const read = () => window.said.push(status.textContent);
        new MutationObserver(read).observe(status, { childList: true, characterData: true, subtree: true });
    });
    await page.keyboard.down("Shift");
    for (let step = 0; step < 14; ++step) await page.keyboard.down("ArrowDown");
    await page.keyboard.up("ArrowDown");
    await page.keyboard.up("Shift");
    assert.match((await page.evaluate(() => window.said)).join("; "), /would cross .* further on/);
    await page.keyboard.press("Control+z");
    assert.equal(await found("Cap"), dragged);
    await at(page, "ready");
    // Meanwhile the service may have been given the sharp margin, which it refuses at coarse levels of detail.
    for (const list of Object.values(log)) list.length = 0;
    await page.keyboard.press("Insert");
    await page.waitForFunction(
        (most) => document.querySelectorAll(".handle[role=button]").length === most,
        points + 1,
    );
    await page.keyboard.press("PageUp");
    await page.keyboard.press("Delete");
    await at(page, "ready");
    assert.equal(await page.locator(".handle[role=button]").count(), points);
    await page.waitForTimeout(600);
    const edited = await found("Cap");
    await reload(page, log);
    await page.locator("#sketch .outline").waitFor({ state: "attached" });
    await at(page, "ready");
    assert.equal(await found("Cap"), edited);
    assert.equal(await found("Method"), "traced, then edited");
    assert.match(await found("Proof"), /never crosses itself/);
    await page.locator("#forget").click();
    await at(page, "empty");
    // Undo brings back the shape, and the same file the photograph.
    await page.locator("#bring-back").click();
    await at(page, "ready");
    assert.equal(await found("Cap"), edited);
    assert.equal(await page.locator("#forgotten").isVisible(), true);
    assert.equal(await page.locator('#tools [data-tool="axis"]').isVisible(), false);
    await page.locator("#file").setInputFiles(photograph);
    await page.locator('#tools [data-tool="axis"]').waitFor();
    await at(page, "ready");
    assert.equal(await found("Cap"), edited);
    assert.equal(await page.locator("#forgotten").isVisible(), false);
    await page.locator("#forget").click();
    await at(page, "empty");
    await reload(page, log);
    await at(page, "empty");
    assert.equal(await page.locator("#bring-back").isVisible(), false, "nothing is left of it");
    expectNoProblems(log);
});

test("the JSON of a species is opened, edited and saved again", async () => {
    const { page, log } = await open();
    const text = await (await fetch(`${base}/v1/species/boletus_edulis`)).text();
    const file = { mimeType: "application/json", buffer: Buffer.from(text) };
    await page.locator("#file").setInputFiles({ ...file, name: "cep.json" });
    await page.locator("#sketch .edited").waitFor();
    await at(page, "ready");
    assert.equal(await page.locator("#tools button:visible").count(), 2, "outline and axis");
    const save = async () => JSON.parse((await saved(page, "#download-json")).bytes.toString());
    const species = JSON.parse(text);
    assert.deepEqual(await save(), species);
    await page.locator("#found-numbers", { hasText: "never crosses itself" }).waitFor();
    await page.locator('.handle[aria-label^="cap, point 2 "]').focus();
    await page.keyboard.press("Alt+ArrowRight");
    await at(page, "ready");
    const edited = await save();
    const stage = edited.stages.findIndex(({ age }) => age === 0.6);
    const [, { r }] = edited.stages[stage].model.silhouette.cap;
    const [, old] = species.stages[stage].model.silhouette.cap;
    const { y: height } = species.stages[stage].model.silhouette.cap.at(-1);
    expectNear([r - old.r], [0.001 * height], 1e-9);
    old.r = r;
    assert.deepEqual(edited, species, "nothing else has changed");
    await page.screenshot({ path: path.join(folder, "designer_species.png") });
    await page.locator("#file").setInputFiles({
        name: "none.json",
        mimeType: "application/json",
        buffer: Buffer.from("{}"),
    });
    await page.locator("#gesture-errors li", { hasText: "/stages" }).waitFor();
    expectNoProblems(log);
});

const speciesOf = async (page) => JSON.parse((await saved(page, "#download-json")).bytes.toString());

/** Grows every stage of a species as the service would. */
async function expectGrown({ stages }) {
    for (const { model, name } of stages) {
        const response = await fetch(`${base}/v1/mushrooms.glb`, {
            method: "POST",
            headers: { "Content-Type": "application/json" },
            body: JSON.stringify({ model, lod: 3, textures: "none" }),
        });
        assert.equal(response.status, 200, `${name}: ${response.status < 400 || (await response.text())}`);
        await response.arrayBuffer();
    }
}

async function start(page, id) {
    await page.locator("#start-species:visible, #another-species:visible").press("Enter");
    await page.locator("#species-search").fill(id.replaceAll("_", " "));
    const button = page.locator(`#species-list button[data-species="${id}"]`);
    await button.press("Enter");
    await page.locator("#species-dialog").waitFor({ state: "hidden" });
    await page.locator("#panel-found dd", { hasText: "from the file of a species" }).waitFor();
    await at(page, "ready");
}

const countsOf = ({ stages }) =>
    stages.map(({ model: { silhouette } }) =>
        ["stem", "hymenium", "cap"].map((curve) => silhouette[curve].length).join(),
    );

test("all stages stand side by side, each has its own outline, and all have the same points", async () => {
    const { page, log } = await open({ width: 1400, height: 860 });
    await start(page, "amanita_muscaria");
    const before = await speciesOf(page);
    const stages = page.locator("#stage-list button");
    assert.equal(await stages.count(), before.stages.length);
    await page.locator('#stages[data-pictures="complete"]').waitFor({ timeout: patience });
    assert.equal(await page.locator("#stage-list .refused").count(), 0);
    const drawn = await page.locator("#stage-list canvas").evaluateAll((all) =>
        all.map((canvas) => {
            const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
            return data.filter((value, index) => index % 4 === 3 && value > 128).length;
        }),
    );
    for (const pixels of drawn) assert.ok(pixels > 1000, `${pixels} pixels of a small picture`);
    await stages.nth(1).click();
    assert.equal(await stages.nth(1).getAttribute("aria-pressed"), "true");
    assert.equal(await page.locator("#sketch .neighbour").count(), 2, "younger and older");
    const point = page.locator('.handle[role=button][aria-label^="cap, point 2 "]');
    await point.focus();
    await page.keyboard.press("Alt+ArrowRight");
    await at(page, "ready");
    const moved = await speciesOf(page);
    const cap = ({ stages }, stage) => stages[stage].model.silhouette.cap;
    assert.ok(cap(moved, 1)[1].r > cap(before, 1)[1].r);
    cap(moved, 1)[1] = cap(before, 1)[1];
    assert.deepEqual(moved, before, "nothing else has changed");
    await point.focus();
    await page.keyboard.press("Insert");
    await at(page, "ready");
    const more = await speciesOf(page);
    assert.equal(new Set(countsOf(more)).size, 1, "as many points in all stages");
    assert.notDeepEqual(countsOf(more), countsOf(before));
    await expectGrown(more);
    await point.focus();
    const label = () => page.evaluate(() => document.activeElement.getAttribute("aria-label"));
    await page.keyboard.press("[");
    assert.match(await label(), /^lower face, point 2 /);
    await page.keyboard.press("[");
    assert.match(await label(), /^stem, point 1 /);
    await page.keyboard.press("]");
    await page.keyboard.press("]");
    assert.match(await label(), /^cap, point 2 /);
    // Space lets arrows move the whole curve.
    await page.keyboard.press(" ");
    assert.equal(await page.locator("#whole-curve").getAttribute("aria-pressed"), "true");
    await page.keyboard.press("Alt+ArrowUp");
    await page.keyboard.press(" ");
    await at(page, "ready");
    const raised = await speciesOf(page);
    const rise = cap(raised, 1).map(({ y }, index) => y - cap(more, 1)[index].y);
    expectNear(rise, rise.map(() => rise[0]), 1e-9);
    assert.ok(rise[0] > 0);
    await page.waitForTimeout(600);
    await reload(page, log);
    await page.locator("#sketch .edited").waitFor();
    await at(page, "ready");
    assert.deepEqual(await speciesOf(page), raised, "a reload has the draft again");
    await page.locator(".handle[tabindex='0']").focus();
    for (let step = 0; step < 3; ++step) await page.keyboard.press("Control+z");
    await at(page, "ready");
    assert.deepEqual(await speciesOf(page), before, "undo survives a reload");
    await page.screenshot({ path: path.join(folder, "designer_stages.png") });
    expectNoProblems(log);
});

test("starting from a species is one step, and the model of what was open before is dimmed", async () => {
    const { page, log } = await open({ width: 1000, height: 700 });
    await give(page);
    await drawLines(page);
    const before = await outline(page);
    const dimmed = page.locator("#former-note");
    assert.equal(await dimmed.isVisible(), false);
    await start(page, "boletus_edulis");
    await page.locator("#tools [data-tool=outline]").focus();
    await page.keyboard.press("Control+z");
    await page.locator('#tools [data-tool="axis"]').waitFor();
    await at(page, "ready");
    assert.deepEqual(await outline(page), before);
    await page.keyboard.press("Control+y");
    await page.locator("#found-numbers", { hasText: "from the file of a species" }).waitFor();
    await at(page, "ready");
    await page.waitForTimeout(600);
    await reload(page, log);
    await at(page, "ready");
    await page.locator("#undo").click();
    await page.locator('#tools [data-tool="axis"]').waitFor();
    await at(page, "ready");
    assert.deepEqual(await outline(page), before, "the draft has both");
    await page.locator("#file").setInputFiles({ ...photograph, name: "another.png" });
    await dimmed.getByText("what was open before").waitFor();
    assert.equal(await page.locator("#stage.former").count(), 1);
    await drawLines(page);
    assert.equal(await dimmed.isVisible(), false);
    expectNoProblems(log);
});

test("on narrow pages the model stays in view while the panel is used", async () => {
    const { page } = await open({ width: 1400, height: 860 });
    await start(page, "boletus_edulis");
    await page.locator("#tab-paint").click();
    for (const [width, height] of [
        [390, 844],
        [700, 900],
        [1000, 700],
    ]) {
        await page.setViewportSize({ width, height });
        await page.locator("#paint-surface-stem-base").scrollIntoViewIfNeeded();
        await page.locator("#paint-surface-stem-base").evaluate((one) => one.scrollIntoView({ block: "center" }));
        const [stage, row] = await Promise.all(
            ["#stage", "#paint-surface-stem-base"].map((each) => page.locator(each).boundingBox()),
        );
        const seen = Math.min(stage.y + stage.height, height) - Math.max(stage.y, 0);
        assert.ok(seen > 0.35 * height, `${seen} pixels of the model at ${width}`);
        const below = row.y > stage.y + stage.height - 1;
        const beside = row.x + row.width <= stage.x || row.x >= stage.x + stage.width;
        assert.ok(below || beside, `the model covers the panel at ${width}`);
        assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth), 0);
    }
    await page.locator("#tab-found").click();
});

test("the curve itself is dragged, and a double click adds a point to it", async () => {
    const { page, log } = await open({ width: 1400, height: 860 });
    await start(page, "boletus_edulis");
    const before = await speciesOf(page);
    const stage = before.stages.findIndex(({ age }) => age === 0.6);
    /** Returns a place of the right half of the curve between two points of the cap. */
    const between = async () => {
        const [a, b] = await Promise.all(
            [2, 3].map(async (index) => {
                const handle = page.locator(`.handle[role=button][aria-label^="cap, point ${index} "] .knob`);
                const { x, y, width, height } = await handle.boundingBox();
                return { x: x + width / 2, y: y + height / 2 };
            }),
        );
        const middle = { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
        return page.evaluate(({ x, y }) => {
            for (let out = 0; out < 40; ++out)
                for (const by of [out, -out])
                    if (document.elementFromPoint(x + by, y)?.classList.contains("grab"))
                        return { x: x + by, y };
        }, middle);
    };
    const place = await between();
    await page.mouse.dblclick(place.x, place.y);
    await at(page, "ready");
    const more = await speciesOf(page);
    assert.equal(more.stages[stage].model.silhouette.cap.length, before.stages[stage].model.silhouette.cap.length + 1);
    assert.equal(new Set(countsOf(more)).size, 1);
    await page.keyboard.press("Control+z");
    await at(page, "ready");
    const again = await between();
    await page.mouse.move(again.x, again.y);
    await page.mouse.down();
    await page.mouse.move(again.x + 6, again.y);
    await page.mouse.move(again.x + 14, again.y);
    await page.mouse.up();
    await at(page, "ready");
    const dragged = await speciesOf(page);
    const cap = ({ stages }) => stages[stage].model.silhouette.cap;
    const outwards = cap(dragged).map(({ r }, index) => r - cap(before)[index].r);
    assert.ok(outwards[1] > 1e-4 && outwards[2] > 1e-4, `both points follow: ${outwards}`);
    assert.deepEqual(outwards.filter((_, index) => index !== 1 && index !== 2).filter(Boolean), []);
    // Near to the ground a point snaps to it.
    const foot = page.locator('.handle[role=button][aria-label^="stem, point 2 "]');
    await foot.scrollIntoViewIfNeeded();
    const { x, y, width, height } = await foot.locator(".knob").boundingBox();
    const ground = await page.evaluate(() => {
        const axis = document.querySelector("#sketch .middle").getAttribute("d").match(/[\d.]+/g);
        const matrix = document.getElementById("sketch").getScreenCTM();
        return new DOMPoint(Number(axis[0]), Number(axis[1])).matrixTransform(matrix).y;
    });
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + width / 2 + 4, ground + 5);
    await page.mouse.up();
    await at(page, "ready");
    const { y: low } = (await speciesOf(page)).stages[stage].model.silhouette.stem[1];
    assert.equal(low, 0);
    expectNoProblems(log);
});

test("every species is a start, and the axis of its stem is bent and straightened", async () => {
    const { page, log } = await open({ width: 1400, height: 860 });
    await start(page, "ramaria_formosa");
    const coral = JSON.parse(await (await fetch(`${base}/v1/species/ramaria_formosa`)).text());
    assert.deepEqual(await speciesOf(page), coral);
    assert.equal(await page.locator('#tools [data-tool="outline"]').isDisabled(), true);
    await page.locator("#tab-more").click();
    await page.locator("#more summary", { hasText: "Limbs" }).click();
    await page.locator("#control-limbs\\.flatness-number").fill("0.5");
    await page.locator("#control-limbs\\.flatness-number").press("Enter");
    await at(page, "ready");
    const flat = await speciesOf(page);
    const shown = flat.stages.findIndex(({ model }) => model.limbs.flatness === 0.5);
    assert.ok(shown >= 0);
    await expectGrown({ stages: [flat.stages[shown]] });
    await page.locator("#tab-found").click();
    await start(page, "boletus_edulis");
    await page.locator('#tools [data-tool="bend"]').press("Enter");
    await page.locator("#bend-axis").press("Enter");
    await page.locator('.handle[aria-label^="axis, point 4 of 4"]').focus();
    for (let press = 0; press < 6; ++press) await page.keyboard.press("ArrowRight");
    await at(page, "ready");
    const bent = await speciesOf(page);
    const axes = bent.stages.map(({ model }) => model.axis.length);
    assert.deepEqual([...new Set(axes)], [4], "an axis in all stages");
    const moved = bent.stages.filter(({ model }) => model.axis[3].x > 0.02);
    assert.equal(moved.length, 1, "it is bent in one");
    await expectGrown(bent);
    await page.locator('.handle[aria-label^="axis, point 4 of 4"]').focus();
    for (let press = 0; press < 20; ++press) await page.keyboard.press("Shift+ArrowRight");
    assert.match(await page.locator("#status").textContent(), /would fold further on/);
    await at(page, "ready");
    await expectGrown(await speciesOf(page));
    await page.locator("#straighten").press("Enter");
    await at(page, "ready");
    const straight = await speciesOf(page);
    const bend = straight.stages.map(({ model }) => model.deformation.bend_deg);
    assert.ok(straight.stages.every(({ model }) => model.axis.length === 0));
    assert.ok(Math.max(...bend) > 5 && Math.max(...bend) <= 90, `${bend}`);
    expectNoProblems(log);
});

test("parts are painted, from the photograph too, and the form has all else of the schema", async () => {
    const { page, log } = await open({ width: 1400, height: 860 });
    await give(page);
    await drawLines(page);
    const before = await speciesOf(page);
    const stage = before.stages.findIndex(({ model }) => model.surface.cap.image);
    await page.locator("#tab-paint").click();
    const fromPhoto = page.locator("#paint section", { hasText: "Cap" }).first().locator(".segments button");
    assert.deepEqual(
        await fromPhoto.evaluateAll((all) => all.map((one) => one.getAttribute("aria-pressed"))),
        ["true", "false"],
    );
    // The eyedropper reads the grey behind the mushroom, by the keyboard alone.
    await page.locator("#paint-surface-cap-ramp-0 ~ .pipette").press("Enter");
    assert.match(await page.locator("#sentence").textContent(), /^Choose a place for Cap, apex/);
    await page.keyboard.press("Shift+ArrowRight");
    await page.keyboard.press("Enter");
    await page.waitForFunction(() =>
        document.querySelector("#paint-surface-cap-ramp-0-text").value !== "#820C17",
    );
    await at(page, "ready");
    const picked = await page.locator("#paint-surface-cap-ramp-0-text").inputValue();
    const painted = await speciesOf(page);
    const apexes = painted.stages.map(({ model }) => model.surface.cap.ramp[0]);
    assert.deepEqual([...new Set(apexes)], [picked], "a colour is that of every age");
    assert.equal(painted.stages[stage].model.surface.cap.image, undefined, "paint covers no image");
    await page.locator("#paint section .segments button").first().click();
    await at(page, "ready");
    assert.ok((await speciesOf(page)).stages[stage].model.surface.cap.image, "the image is back");
    await page.locator("#add-stop").click();
    await at(page, "ready");
    assert.equal(await page.locator("#every-age").isChecked(), true);
    await page.locator("#paint-surface-stem-top-text").fill("#2040c0");
    await page.locator("#paint-surface-stem-top-text").press("Enter");
    await at(page, "ready");
    await page.locator("#tab-ornaments").press("ArrowLeft");
    await page.locator("#tab-ornaments").click();
    await page.locator("#ornaments summary", { hasText: "Warts" }).click();
    assert.equal(await page.locator("#every-age").isChecked(), false, "ornaments are of one age");
    const count = page.locator("#control-warts\\.count-number");
    await count.scrollIntoViewIfNeeded();
    await count.fill("5000");
    await count.press("Enter");
    assert.match(await page.locator("#control-warts\\.count-error").textContent(), /above 1600/);
    await count.fill("60");
    await count.press("Enter");
    await at(page, "ready");
    const amount = page.locator("#control-ornaments\\.warts-number");
    await amount.fill("0.9");
    await amount.press("Enter");
    await at(page, "ready");
    await page.locator("#tab-more").click();
    const season = page.locator("#control-facts\\.season");
    await season.evaluate((input) => (input.closest("details").open = true));
    await season.fill("8, 13");
    await season.press("Enter");
    assert.match(await page.locator("#control-facts\\.season-error").textContent(), /13 is above 12/);
    await season.fill("8, 9");
    await season.press("Enter");
    await at(page, "ready");
    const after = await speciesOf(page);
    const surfaces = after.stages.map(({ model }) => model.surface);
    assert.deepEqual([...new Set(surfaces.map(({ stem }) => stem.top))], ["#2040C0"]);
    assert.equal(new Set(surfaces.map(({ cap }) => cap.ramp.length)).size, 1);
    assert.equal(surfaces[0].cap.ramp.length, before.stages[0].model.surface.cap.ramp.length + 1);
    assert.deepEqual([...new Set(after.stages.map(({ model }) => model.warts.count))], [60]);
    const amounts = after.stages.map(({ model }) => model.ornaments.warts);
    assert.deepEqual(amounts.filter((value) => value === 0.9).length, 1, "one stage alone");
    assert.deepEqual(after.facts.season, [8, 9]);
    await expectGrown(after);
    await page.screenshot({ path: path.join(folder, "designer_paint.png") });
    await page.locator("#tab-found").click();
    expectNoProblems(log);
});

test("the model lies over the photograph where the photographed one is", async () => {
    const { page, log } = await open({ width: 1400, height: 860 });
    await give(page);
    await drawLines(page);
    await page.locator("#over-photo").check();
    const box = await page.waitForFunction(() => {
        const canvas = document.querySelector(".over-photo canvas");
        const { width, height } = canvas;
        const copy = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
        copy.drawImage(canvas, 0, 0);
        const { data } = copy.getImageData(0, 0, width, height);
        const [xs, ys] = [[], []];
        for (let i = 0; i < width * height; ++i) {
            if (data[4 * i + 3] < 128) continue;
            xs.push(i % width);
            ys.push(Math.floor(i / width));
        }
        const least = (values) => values.reduce((a, b) => Math.min(a, b), Infinity);
        const most = (values) => values.reduce((a, b) => Math.max(a, b), 0);
        return xs.length > 1000 && [least(xs), least(ys), most(xs), most(ys)].map((v) => (v * 800) / width);
    });
    expectNear(await box.jsonValue(), [88, 40, 714, 715], 45);
    await page.locator("#over-photo").uncheck();
    expectNoProblems(log);
});

test("two fingers zoom, a loupe shows what a finger covers, and a long touch adds a point", async () => {
    const { page, log } = await openAlone({
        viewport: { width: 390, height: 844 },
        hasTouch: true,
        isMobile: true,
    });
    await page.locator("#start-species").tap();
    await page.locator('#species-list button[data-species="boletus_edulis"]').tap();
    await page.locator("#sketch .edited").waitFor();
    await at(page, "ready");
    await page.locator("#sketch").scrollIntoViewIfNeeded();
    const session = await page.context().newCDPSession(page);
    const touch = (type, ...points) =>
        session.send("Input.dispatchTouchEvent", {
            type,
            touchPoints: points.map(([x, y], id) => ({ x, y, id })),
        });
    const middleOf = async (locator) => {
        const { x, y, width, height } = await locator.boundingBox();
        return [x + width / 2, y + height / 2];
    };
    const cap = page.locator(`#sketch .handle[role=button][aria-label^="cap, point 3 "]`);
    const [x, y] = await middleOf(cap.locator(".knob"));
    await touch("touchStart", [x, y]);
    await touch("touchMove", [x + 10, y + 45]);
    await page.locator("#loupe").waitFor();
    await page.screenshot({ path: path.join(folder, "designer_loupe.png") });
    const [, raised] = await middleOf(cap.locator(".knob"));
    assert.ok(raised < y + 20, "the point is above the finger");
    await touch("touchEnd");
    await page.locator("#loupe").waitFor({ state: "hidden" });
    await at(page, "ready");
    const species = await speciesOf(page);
    // A finger that rests on the curve adds a point there.
    await page.locator("#sketch").scrollIntoViewIfNeeded();
    const handles = await page.locator(".handle[role=button]").count();
    const place = await page.evaluate(() => {
        const path = document.querySelector("#sketch .grab");
        const matrix = path.getScreenCTM();
        const total = path.getTotalLength();
        const knobs = [...document.querySelectorAll("#sketch .controls .knob")].map((knob) => {
            const { x, y, width, height } = knob.getBoundingClientRect();
            return [x + width / 2, y + height / 2];
        });
        const away = ({ x, y }) => Math.min(...knobs.map(([a, b]) => Math.hypot(a - x, b - y)));
        const places = Array.from({ length: 180 }, (_, k) =>
            path.getPointAtLength((0.52 + k / 400) * total).matrixTransform(matrix),
        );
        const { x, y } = places.reduce((best, place) => (away(place) > away(best) ? place : best));
        return [x, y];
    });
    await touch("touchStart", place);
    await page.waitForTimeout(700);
    await touch("touchEnd");
    await at(page, "ready");
    assert.equal(await page.locator(".handle[role=button]").count(), handles + 1);
    await page.locator("#remove-point").scrollIntoViewIfNeeded();
    await page.locator("#undo").tap();
    await at(page, "ready");
    assert.deepEqual(await speciesOf(page), species);
    const widthOf = () =>
        page.locator("#sketch").evaluate((svg) => svg.viewBox.baseVal.width);
    const whole = await widthOf();
    await page.locator("#sketch").scrollIntoViewIfNeeded();
    const [mx, my] = await middleOf(page.locator("#sketch"));
    await touch("touchStart", [mx - 30, my]);
    await touch("touchStart", [mx - 30, my], [mx + 30, my]);
    await touch("touchMove", [mx - 60, my], [mx + 60, my]);
    await touch("touchMove", [mx - 90, my], [mx + 90, my]);
    await touch("touchEnd");
    expectNear([(await widthOf()) / whole], [1 / 3], 0.05);
    assert.deepEqual(await speciesOf(page), species, "zooming moves nothing");
    await page.locator("#zoom-whole").tap();
    assert.equal(await widthOf(), whole);
    for (const tab of ["paint", "ornaments", "more", "found"]) {
        await page.locator(`#tab-${tab}`).tap();
        if (tab !== "found") await page.locator(`#panel-${tab} :is(.control, .paint-row)`).first().waitFor();
        const small = await page
            .locator("button:visible, #panel input:visible, #panel summary:visible")
            .evaluateAll((all) =>
                all
                    .filter((one) => one.closest("label, .entry") === null || one.type === "number")
                    .filter((one) => one.getBoundingClientRect().height < 44)
                    .map((one) => one.id || one.textContent),
            );
        assert.deepEqual(small, [], tab);
        const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        assert.equal(wide, 0, "nothing is wider than the window");
    }
    // Whole pages are the last pictures, because they change what the pointer is.
    for (const tab of ["paint", "ornaments", "more", "found"]) {
        await page.locator(`#tab-${tab}`).click();
        await page.screenshot({ path: path.join(folder, `designer_390_${tab}.png`), fullPage: true });
    }
    expectNoProblems(log);
});

test("the page lets no point go where the service refuses the outline", async () => {
    const text = await bundled(path.join(root, "web_viewer/src/designer/outline.ts"));
    const { controlsOf, moved } = await import(
        `data:text/javascript;base64,${Buffer.from(text).toString("base64")}`
    );
    let random = 7;
    const draw = () => (random = (random * 16807) % 2147483647) / 2147483647;
    let stops = 0;
    // With an effort of 50 these are more than 10,000 drags.
    const drags = Math.ceil(20 * Number(process.env.SPOREPRINT_EFFORT ?? 1));
    for (const id of ["boletus_edulis", "amanita_muscaria", "cantharellus_cibarius"]) {
        const { stages } = await (await fetch(`${base}/v1/species/${id}`)).json();
        for (let { silhouette } of stages.map(({ model }) => model)) {
            for (let drag = 0; drag < drags; ++drag) {
                const controls = controlsOf(silhouette);
                const at = Math.floor(draw() * controls.length);
                const far = draw() < 0.5 ? 0.1 : 0.01;
                const { r, y } = controls[at];
                const to = { r: r + far * (draw() - 0.5), y: y + far * (draw() - 0.5) };
                const move = moved(silhouette, at, to);
                if (move.stopped) ++stops;
                ({ silhouette } = move);
                const response = await fetch(`${base}/v1/outlines/check`, {
                    method: "POST",
                    headers: { "Content-Type": "application/json" },
                    body: JSON.stringify({ silhouette, axis: [] }),
                });
                assert.deepEqual((await response.json()).problem, null, `${id}, drag ${drag}`);
            }
        }
    }
    assert.ok(stops > drags, `only ${stops} drags were stopped`);
});

test("what the service refuses stands beside what it is about, in its words", async () => {
    const { page } = await open();
    await give(page);
    await stroke(page, [30, 700], [40, 720]);
    await stroke(page, [20, 705], [50, 705]);
    await at(page, "failed");
    const errors = page.locator("#gesture-errors li");
    const [first] = await errors.allTextContents();
    assert.match(first, /^(Foot to top|Across the cap|Photograph) \S/);
    await page.locator("#sketch").focus();
    await page.keyboard.press("Control+z");
    await page.keyboard.press("Control+z");
    await at(page, "ready");
    assert.equal(await errors.count(), 0);
    await drawLines(page);
    await page.locator("#height").fill("-3");
    await page.locator("#height").press("Enter");
    await at(page, "failed");
    assert.match(await page.locator("#height-error").textContent(), /-0\.003/);
    assert.equal(await page.locator("#height").getAttribute("aria-invalid"), "true");
    await page.locator("#height").fill("");
    await page.locator("#height").press("Enter");
    await at(page, "ready");
    assert.equal(await page.locator("#height-error").isVisible(), false);
});

test("a forgotten photograph is sent again, and one that is cut out needs no line", async () => {
    const { page, log } = await open();
    const [stored] = await Promise.all([
        page.waitForResponse((response) => response.url().endsWith("/v1/photos")),
        give(page),
    ]);
    const { photo } = await stored.json();
    const gone = await fetch(`${base}/v1/photos/${photo}.jpg`, { method: "DELETE" });
    assert.equal(gone.status, 204);
    await drawLines(page);
    assert.equal(await page.locator("#sketch .outline").count(), 1);
    assert.equal(log.requests.filter((url) => url.endsWith("/v1/photos")).length, 2);
    const before = traces(log);
    await page.locator("#file").setInputFiles(cutOut);
    await page.waitForResponse((response) => response.url().endsWith("/v1/traces"));
    await at(page, "ready");
    assert.equal(traces(log), before + 1);
    assert.equal(await strokes(page, "axis"), 0);
    assert.equal(await page.locator("#sketch .outline").count(), 1);
});

/** Does what makes a trace; returns the views that were requested and the traced model. */
async function traced(page, act) {
    const [response] = await Promise.all([
        page.waitForResponse((each) => each.url().endsWith("/v1/traces") && each.status() === 200),
        act(),
    ]);
    const { species, stage } = await response.json();
    await at(page, "ready");
    return { views: response.request().postDataJSON().views, model: species.stages[stage].model };
}

test("a photograph from above gives the skin of the cap, and a reload keeps it", async () => {
    const { page, log } = await open({ width: 800, height: 800 });
    const alone = await traced(page, () => give(page, cutOut));
    assert.deepEqual(Object.keys(alone.views), ["side"]);
    await page.locator("#cap-file-above").setInputFiles(fromAbove);
    await page.locator("#cap-dialog").waitFor();
    const use = page.locator("#cap-use");
    assert.equal(await use.isDisabled(), true, "a line is missing");
    await stroke(page, [50, 400], [750, 400], "#cap-sketch");
    assert.equal(await use.isDisabled(), false);
    await page.locator('#cap-tools [data-tool="centre"]').click();
    const middle = await onScreen(page, [390, 380], "#cap-sketch");
    await page.mouse.click(middle.x, middle.y);
    await page.mouse.move(middle.x, middle.y);
    await stroke(page, [390, 380], [410, 400], "#cap-sketch");
    await page.screenshot({ path: path.join(folder, "designer_cap_above.png") });
    const { views, model } = await traced(page, () => use.click());
    expectNear(views.above.centre, [410, 400], 2);
    expectNear(views.above.gesture.axis.flat(), [50, 400, 750, 400], 2);
    assert.ok(model.surface.cap.image);
    assert.notDeepEqual(model.surface.cap.image, alone.model.surface.cap.image);
    const before = traces(log);
    const picture = page.locator('#cap-rows [data-view="above"] image');
    await page.locator("#undo").click();
    await at(page, "ready");
    assert.equal(await picture.count(), 0);
    await page.locator("#redo").click();
    await picture.waitFor({ state: "attached" });
    await at(page, "ready");
    assert.equal(traces(log), before, "what was traced is at hand again");
    expectNoProblems(log);
    // The service forgets it: it is sent again.
    const gone = await fetch(`${base}/v1/photos/${views.above.photo}.jpg`, { method: "DELETE" });
    assert.equal(gone.status, 204);
    const again = await traced(page, async () => {
        await page.locator("#height").fill("70");
        await page.locator("#height").press("Enter");
    });
    assert.notEqual(again.views.above.photo, views.above.photo);
    await page.waitForTimeout(600);
    const reloaded = await traced(page, () => reload(page, log));
    assert.deepEqual(reloaded.views.above.gesture, views.above.gesture);
    assert.deepEqual(reloaded.views.above.centre, views.above.centre);
    await picture.waitFor({ state: "attached" });
});

test("the keyboard alone draws on a photograph from below, and its errors stand at its row", async () => {
    const { page } = await open();
    await give(page, cutOut);
    const row = page.locator('#cap-rows [data-view="below"]');
    page.once("filechooser", (chooser) => chooser.setFiles(fromBelow));
    await row.locator("button", { hasText: "Choose" }).press("Enter");
    await page.locator("#cap-dialog").waitFor();
    const focused = () => page.evaluate(() => document.activeElement.getAttribute("aria-label"));
    assert.equal(await focused(), "Photograph of the cap to draw on");
    const press = (key) => page.keyboard.press(key);
    const set = async (place) => {
        await moveCrosshair(page, place, "#cap-place");
        await press("Enter");
    };
    // In a corner is no cap.
    await set([20, 760]);
    await set([60, 780]);
    await press("Escape");
    await press("Escape");
    await press("Escape");
    assert.equal(await page.locator("#cap-dialog").isVisible(), true, "Escape discards nothing");
    await set([20, 760]);
    await set([60, 780]);
    await press("Enter");
    await page.locator("#cap-use").press("Enter");
    await at(page, "failed");
    assert.match(await row.locator(".validation-error").textContent(), /\S+ \S+/);
    assert.equal(await page.locator("#problem").isVisible(), false);
    assert.equal(await focused(), "Change from below");
    await press("Enter");
    await page.locator("#cap-dialog").waitFor();
    await press("Control+z");
    await page.locator('#cap-tools [data-tool="axis"]').press("Enter");
    await page.locator("#cap-clear").press("Enter");
    await page.locator("#cap-sketch").focus();
    for (const place of capBelow) await set(place);
    await press("Enter");
    await page.locator('#cap-tools [data-tool="frame"]').press("Enter");
    await page.locator("#cap-sketch").focus();
    for (const corner of [
        [150, 20],
        [640, 345],
    ])
        await set(corner);
    for (const [tool, place] of [
        ["centre", stemBelow[0]],
        ["stemEnd", stemBelow[1]],
    ]) {
        await page.locator(`#cap-tools [data-tool="${tool}"]`).press("Enter");
        await set(place);
    }
    assert.match(await focused(), /^End of the stem, at /);
    await press("ArrowLeft");
    const [x, y] = stemBelow[1];
    await page.screenshot({ path: path.join(folder, "designer_cap_below.png") });
    const { views, model } = await traced(page, () => page.locator("#cap-use").press("Enter"));
    assert.deepEqual(views.below.gesture, { axis: capBelow, frame: [150, 20, 490, 325] });
    assert.deepEqual(views.below.centre, stemBelow[0]);
    assert.deepEqual(views.below.stem_end, [x - 1, y]);
    assert.ok(model.surface.hymenium.image);
    assert.equal(await row.locator(".validation-error").isVisible(), false);
    await row.locator("button", { hasText: "Remove" }).press("Enter");
    await at(page, "ready");
    assert.equal(await focused(), "Choose… from below");
});

test("the viewer leads to the designer and back", async () => {
    const { page } = await open();
    assert.equal(await page.locator("header nav a").first().getAttribute("href"), "./");
    await page.goto(`${serverUrl()}/`, { waitUntil: "commit" });
    await page.locator("#mode-designer").click();
    await page.waitForURL(/\/editor$/, { waitUntil: "commit" });
    await page.locator("#choose").waitFor({ state: "attached" });
});
