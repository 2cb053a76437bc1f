// Tests of leaves on the page, in headless Chromium against a running server (SPOREPRINT_URL).
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

before(async () => {
    folder = await screenshotFolder();
    browser = await launchBrowser();
    shared = await browser.newContext({
        viewport: { width: 960, height: 560 },
        reducedMotion: "reduce",
    });
});

after(() => browser?.close());

async function open(t, query) {
    const page = await shared.newPage();
    t.after(() => page.close());
    const log = logEvents(page);
    await page.goto(`${base}/${query}`);
    await ready(page);
    await page
        .locator("form details:not([open]) summary")
        .evaluateAll((all) => all.forEach((one) => one.click()));
    return { page, log };
}

function expectNoProblems(log) {
    assert.deepEqual(log.console, []);
    assert.deepEqual(log.failed, []);
}

test("the page of leaves offers every preset and every parameter of the schema", async (t) => {
    const { page, log } = await open(t, "?leaf");
    const { leaves } = await (await fetch(`${base}/v1/leaves`)).json();
    assert.deepEqual(
        await page
            .locator("#gallery button")
            .evaluateAll((all) => all.map((one) => one.dataset.species)),
        leaves.map(({ id }) => id),
    );
    const schema = await (await fetch(`${base}/v1/leaves/schema`)).json();
    const names = (object, prefix = "") =>
        Object.entries(object.properties).flatMap(([key, sub]) =>
            sub.properties ? names(sub, `${prefix}${key}.`) : [prefix + key],
        );
    const shown = await page
        .locator("form .control")
        .evaluateAll((all) => all.map((one) => one.dataset.name));
    assert.deepEqual([...shown].sort(), names(schema).sort());
    assert.equal(await page.locator("#mode-leaf").getAttribute("aria-current"), "page");
    assert.equal(await page.locator("#sheets").isVisible(), false);
    assert.match(
        await page.locator("#dimensions").textContent(),
        /^[\d.]+ cm long, [\d.]+ cm wide$/,
    );
    // A control shows the value of the preset.
    assert.equal(await page.locator('input[type=number][name="venation.nodes"]').inputValue(), "5");
    assert.equal(
        await page.locator('input[type=color][name="summer.inner"]').inputValue(),
        "#3e6826",
    );
    await page.screenshot({ path: path.join(folder, "leaf_editor.png") });
    expectNoProblems(log);
});

test("a changed parameter is requested, in the address, and dropped with the preset", async (t) => {
    const { page, log } = await open(t, "?leaf=birch&seed=7");
    const before = await page.evaluate(() => window.sporeprint.counts.triangles);
    const nodes = page.locator('input[type=number][name="venation.nodes"]');
    await nodes.fill("14");
    await nodes.press("Enter");
    await ready(page);
    assert.deepEqual(Object.fromEntries(await parameters(page)), {
        leaf: "birch",
        seed: "7",
        "venation.nodes": "14",
    });
    assert.notEqual(await page.evaluate(() => window.sporeprint.counts.triangles), before);
    const colour = page.locator('input[type=color][name="summer.inner"]');
    await colour.evaluate((entry) => {
        entry.value = "#aa2211";
        entry.dispatchEvent(new Event("input", { bubbles: true }));
        entry.dispatchEvent(new Event("change", { bubbles: true }));
    });
    await ready(page);
    assert.equal((await parameters(page)).get("summer.inner"), "#aa2211");
    assert.ok(
        log.requests.some((url) =>
            /\/v1\/leaves\/birch\.glb\?seed=7&venation\.nodes=14&summer\.inner=%23aa2211$/.test(
                url,
            ),
        ),
        log.requests.join("\n"),
    );
    await page.locator('#gallery button[data-species="ivy"]').click();
    await ready(page);
    assert.deepEqual(Object.fromEntries(await parameters(page)), { leaf: "ivy", seed: "7" });
    await page.goBack();
    await ready(page);
    assert.equal((await parameters(page)).get("leaf"), "birch");
    assert.equal(await nodes.inputValue(), "14");
    expectNoProblems(log);
});

test("a refusal is shown beside its control, and the last leaf stays", async (t) => {
    const { page, log } = await open(t, "?leaf=maple");
    await page.locator('select[name="venation.lobes"]').selectOption("13");
    await page.locator('.control[data-name="venation.vein_deg"] .validation-error').waitFor();
    assert.match(
        await page
            .locator('.control[data-name="venation.vein_deg"] .validation-error')
            .textContent(),
        /petiole/,
    );
    assert.ok(
        log.failed.every((line) => line.endsWith(": 422")),
        log.failed.join(),
    );
    assert.ok((await page.evaluate(() => window.sporeprint.counts.triangles)) > 100);
});

test("the downloaded file equals that of the address and restores its settings", async (t) => {
    const { page, log } = await open(t, "?leaf=oak&autumn=0.5&lod=2");
    const [download] = await Promise.all([
        page.waitForEvent("download"),
        page.locator("#download").click(),
    ]);
    assert.match(download.suggestedFilename(), /^oak_leaf_s1_[0-9a-f]{8}_LOD2\.glb$/);
    const saved = await readFile(await download.path());
    const served = Buffer.from(
        await (await fetch(`${base}/v1/leaves/oak.glb?autumn=0.5&lod=2`)).arrayBuffer(),
    );
    assert.ok(saved.equals(served));
    // Dropped on the mushrooms' page it opens the page of leaves.
    await page.goto(`${base}/?species=boletus_edulis&lod=3`);
    await ready(page);
    await page
        .locator("#file")
        .setInputFiles({ name: "oak.glb", mimeType: "model/gltf-binary", buffer: saved });
    await page.waitForURL(/leaf=oak/);
    await ready(page);
    assert.deepEqual(Object.fromEntries(await parameters(page)), {
        leaf: "oak",
        autumn: "0.5",
        lod: "2",
    });
    // The gallery of the page before was still loading: console messages about that are ignored.
    assert.deepEqual(log.failed, []);
});
