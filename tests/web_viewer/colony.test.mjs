// Tests of colonies on the page, in headless Chromium against a running server (SPOREPRINT_URL).
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import path from "node:path";
import test, { after, before } from "node:test";
import {
    launchBrowser,
    logEvents,
    parameters,
    ready,
    screenshotFolder,
    serverUrl,
} from "./support.mjs";

const base = serverUrl();
let browser;
let shared; // the gallery's pictures are drawn once
let folder;
let ids;

before(async () => {
    folder = await screenshotFolder();
    browser = await launchBrowser();
    shared = await browser.newContext({
        viewport: { width: 960, height: 560 },
        reducedMotion: "reduce",
    });
    ids = (await (await fetch(`${base}/v1/species`)).json()).species.map(({ id }) => id);
});

after(() => browser?.close());

async function open(t, query, viewport = undefined) {
    const page = await shared.newPage();
    t.after(() => page.close());
    if (viewport) await page.setViewportSize(viewport);
    const log = logEvents(page);
    await page.goto(`${base}/${query}`);
    await ready(page);
    await page
        .locator("form details:not([open]) summary")
        .evaluateAll((all) => all.forEach((one) => one.click()));
    return { page, log };
}

const small = "lod=2&texture_size=128";
const counts = (page) => page.evaluate(() => window.sporeprint.counts);
const row = (page, name) => page.locator(`form .control[data-name="${name}"]`);
const number = (page, name) => page.locator(`input[type=number][name="${name}"]`);

function expectNoProblems(log) {
    assert.deepEqual(log.console, []);
    assert.deepEqual(log.failed, []);
}

test("the page of colonies offers all species and parameters and counts individuals", async (t) => {
    const { page, log } = await open(t, `?colony=hypholoma_fasciculare&habit=rooted&${small}`);
    assert.deepEqual(
        await page
            .locator("#gallery button")
            .evaluateAll((all) => all.map((one) => one.dataset.species)),
        ids,
    );
    const schema = await (await fetch(`${base}/v1/colonies/schema`)).json();
    const shown = await page
        .locator("form .control")
        .evaluateAll((all) => all.map((one) => one.dataset.name));
    assert.deepEqual(
        [...shown].sort(),
        Object.keys(schema.properties)
            .filter((name) => name !== "v")
            .sort(),
    );
    assert.equal(await page.locator("#mode-colony").getAttribute("aria-current"), "page");
    assert.equal(await page.locator("#sheets").isVisible(), false);
    assert.equal(
        await page.locator('#gallery button[aria-pressed="true"]').getAttribute("data-species"),
        "hypholoma_fasciculare",
    );
    const { made, effective } = await (
        await fetch(`${base}/v1/colonies/hypholoma_fasciculare.json?habit=rooted&${small}`)
    ).json();
    assert.match(
        await page.locator("#dimensions").textContent(),
        new RegExp(`^[\\d.]+ cm tall, [\\d.]+ cm across · ${made} of 24 made$`),
    );
    assert.equal(
        (await counts(page)).drawCalls,
        made + 1,
        "roots with their stems, and one node each",
    );
    // A control shows the value of the species.
    assert.equal(
        Number(await number(page, "field_scale").inputValue()),
        Number(effective.field_scale.toPrecision(3)),
    );
    await page.screenshot({ path: path.join(folder, "colony_editor.png") });
    expectNoProblems(log);
});

test("parameters of other habits are hidden, and a refusal is beside its control", async (t) => {
    const { page, log } = await open(t, `?colony=hypholoma_fasciculare&${small}`);
    assert.equal(
        await page.locator('select[name="habit"]').inputValue(),
        "tuft",
        "the species' own",
    );
    assert.equal(await row(page, "depth").isVisible(), false);
    assert.equal(await row(page, "trunk_radius").isVisible(), false);
    await page.locator('select[name="habit"]').selectOption("rooted");
    await ready(page);
    assert.equal(await row(page, "depth").isVisible(), true);
    assert.equal((await parameters(page)).get("habit"), "rooted");
    expectNoProblems(log);
    await number(page, "depth").fill("9");
    await number(page, "depth").press("Enter");
    await ready(page);
    await page.locator('select[name="habit"]').selectOption("ring");
    await page.locator("#control-depth-error:not([hidden])").waitFor();
    assert.match(
        await page.locator("#control-depth-error").textContent(),
        /only habit=rooted has it/,
    );
    assert.ok(
        log.failed.every((line) => line.endsWith(": 422")),
        log.failed.join(),
    );
    // Another species has a habit of its own; what was set for the last one is dropped.
    await page.locator('#gallery button[data-species="trametes_versicolor"]').click();
    await ready(page);
    assert.equal(await page.locator('select[name="habit"]').inputValue(), "tier");
    assert.equal(await row(page, "trunk_radius").isVisible(), true);
    assert.deepEqual(Object.fromEntries(await parameters(page)), {
        colony: "trametes_versicolor",
        lod: "2",
        texture_size: "128",
    });
});

test("the view of the roots hides the caps until another view is chosen", async (t) => {
    const { page, log } = await open(t, `?colony=hypholoma_fasciculare&habit=rooted&${small}`);
    const triangles = async () => {
        await ready(page);
        return page.evaluate(() => window.sporeprint.renderer.triangles);
    };
    const size = () => page.evaluate(() => window.sporeprint.size);
    await page.locator('#views [data-view="top"]').click();
    const [whole, before] = [await triangles(), await size()];
    await page.locator('#views [data-view="roots"]').click();
    const bare = await triangles();
    assert.ok(bare < whole, `${bare} of ${whole} triangles`);
    assert.equal(
        await page.locator('#views [data-view="roots"]').getAttribute("aria-pressed"),
        "true",
    );
    assert.deepEqual(await size(), before, "the colony is as large as it was");
    await page.locator("#stage").screenshot({ path: path.join(folder, "colony_roots.png") });
    await number(page, "seed").fill("5");
    await number(page, "seed").press("Enter");
    const other = await triangles();
    await page.locator('#views [data-view="top"]').click();
    assert.ok(other < (await triangles()), "another colony showed its roots, too");
    assert.equal(
        await page.locator('#views [data-view="roots"]').getAttribute("aria-pressed"),
        "false",
    );
    expectNoProblems(log);
});

test("the links carry a mix from the morph editor to its colony and back", async (t) => {
    const { page, log } = await open(
        t,
        "?morph=mycena_sanguinolenta:0.5,amanita_muscaria:0.5&lod=3&texture_size=128",
    );
    await page.locator("#mode-colony").click();
    await page.waitForURL(/colony=/);
    await ready(page);
    const mix = "amanita_muscaria:0.5,mycena_sanguinolenta:0.5";
    assert.equal((await parameters(page)).get("colony"), mix);
    assert.equal(await page.locator('#gallery button[aria-pressed="true"]').count(), 2);
    assert.match(await page.locator("#common-name").textContent(), / × /);
    assert.equal(await page.locator("#mode-morph").getAttribute("href"), `?morph=${mix}`);
    assert.ok((await page.evaluate(() => window.sporeprint.made)).made > 1);
    expectNoProblems(log);
    await page.locator("#gallery button").first().click();
    assert.equal(
        await page.locator("#mode-morph").isVisible(),
        false,
        "a lone species is no morph",
    );
    assert.equal(await page.locator("#mode-species").getAttribute("href"), `?species=${ids[0]}`);
});

test("a colony of GPU instances is counted and framed like one of nodes", async (t) => {
    const query = `?colony=coprinus_comatus&count=8&distinct=2&panel=export&${small}`;
    const { page, log } = await open(t, query);
    const nodes = await page.evaluate(() => ({
        ...window.sporeprint.counts,
        ...window.sporeprint.size,
    }));
    await page.locator('select[name="instancing"]').selectOption("gpu");
    await ready(page);
    const gpu = await page.evaluate(() => ({
        ...window.sporeprint.counts,
        ...window.sporeprint.size,
    }));
    assert.equal(gpu.triangles, nodes.triangles);
    assert.equal(gpu.drawCalls, 3, "stems and two individuals");
    // Boxes of instances are made of the boxes of their meshes, and therefore slightly larger.
    assert.ok(
        gpu.width >= nodes.width * 0.999 && gpu.width < nodes.width * 1.3,
        `${gpu.width} of ${nodes.width} m`,
    );
    expectNoProblems(log);
});

test("the downloaded file equals that of the copied URL and restores its settings", async (t) => {
    const { page, log } = await open(
        t,
        `?colony=russula_vinosa&seed=3&habit=ring&lod=2&texture_size=128`,
    );
    await page
        .context()
        .grantPermissions(["clipboard-read", "clipboard-write"], { origin: new URL(base).origin });
    const [download] = await Promise.all([
        page.waitForEvent("download"),
        page.locator("#download").click(),
    ]);
    assert.match(download.suggestedFilename(), /^russula_vinosa.*\.glb$/);
    const saved = await readFile(await download.path());
    await page.locator("#copy-url").click();
    await page.waitForFunction(
        () => document.querySelector("#status").textContent === "URL copied",
    );
    const address = await page.evaluate(() => navigator.clipboard.readText());
    assert.match(
        address,
        /\/v1\/colonies\/russula_vinosa\.glb\?seed=3&habit=ring&lod=2&texture_size=128&v=/,
    );
    assert.ok(saved.equals(Buffer.from(await (await fetch(address)).arrayBuffer())));
    await page.goto(`${base}/?leaf=oak&lod=3`);
    await ready(page);
    await page
        .locator("#file")
        .setInputFiles({ name: "ring.glb", mimeType: "model/gltf-binary", buffer: saved });
    await page.waitForURL(/colony=russula/);
    await ready(page);
    assert.deepEqual(Object.fromEntries(await parameters(page)), {
        colony: "russula_vinosa",
        seed: "3",
        habit: "ring",
        lod: "2",
        texture_size: "128",
    });
    assert.deepEqual(log.failed, []);
});

test("the number of individuals is shown after the count was changed by keys", async (t) => {
    const { page, log } = await open(t, `?colony=hypholoma_fasciculare&${small}`);
    log.requests.length = 0;
    const slider = page.locator('input[type=range][name="count"]');
    await slider.focus();
    for (let i = 0; i < 3; ++i) await slider.press("ArrowLeft");
    await ready(page);
    assert.equal((await parameters(page)).get("count"), "21");
    assert.equal((await page.evaluate(() => window.sporeprint.made)).requested, 21);
    expectNoProblems(log);
});

test("the navigation and a colony fit into every width from 320 pixels", async (t) => {
    const { page, log } = await open(
        t,
        `?colony=hypholoma_fasciculare:0.5,coprinus_comatus:0.5&lod=3&texture_size=128`,
        { width: 360, height: 740 },
    );
    for (const width of [320, 360, 420, 421, 540, 541, 760, 761, 900, 901, 1100, 1280]) {
        await page.setViewportSize({ width, height: 740 });
        const over = await page.evaluate(() =>
            [...document.querySelectorAll("main *, aside *, header *, footer")]
                .filter(
                    (element) =>
                        element.getClientRects().length &&
                        element.getBoundingClientRect().right > innerWidth + 0.5,
                )
                .map((element) => element.id || element.className || element.tagName),
        );
        assert.deepEqual(over, [], `${width} pixels wide`);
        assert.ok(
            (await page.evaluate(() => document.documentElement.scrollWidth)) <= width,
            `${width} pixels wide`,
        );
    }
    expectNoProblems(log);
});
