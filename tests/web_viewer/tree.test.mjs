// Tests of trees on the page, in headless Chromium against a running server (SPOREPRINT_URL).
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import path from "node:path";
import test, { after, before } from "node:test";
import {
    launchBrowser,
    logEvents,
    parameters,
    ready,
    reload,
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

const counts = (page) => page.evaluate(() => window.sporeprint.counts);

function expectNoProblems(log) {
    assert.deepEqual(log.console, []);
    assert.deepEqual(log.failed, []);
}

test("the page of trees offers every preset and parameter and shows the matrix", async (t) => {
    const { page, log } = await open(t, "?tree&lod=2");
    const { trees } = await (await fetch(`${base}/v1/trees`)).json();
    assert.deepEqual(
        await page
            .locator("#gallery button")
            .evaluateAll((all) => all.map((one) => one.dataset.species)),
        trees.map(({ id }) => id),
    );
    const schema = await (await fetch(`${base}/v1/trees/schema`)).json();
    const names = (object, prefix = "") =>
        Object.entries(object.properties).flatMap(([key, sub]) =>
            sub.properties
                ? names(sub, `${prefix}${key}.`)
                : sub.type === "array"
                  ? []
                  : [prefix + key],
        );
    const shown = await page
        .locator("form .control")
        .evaluateAll((all) => all.map((one) => one.dataset.name));
    assert.deepEqual([...shown].sort(), names(schema).sort());
    assert.equal(await page.locator("#mode-tree").getAttribute("aria-current"), "page");
    assert.match(
        await page.locator("#dimensions").textContent(),
        /^[\d.]+ m tall, [\d.]+ m across$/,
    );
    assert.equal((await counts(page)).drawCalls, 2, "bark and leaves");
    assert.equal((await counts(page)).textures, 6);
    const { matrix } = await (await fetch(`${base}/v1/trees/broadleaf.json?lod=2`)).json();
    const cells = await page
        .locator("#matrix td input")
        .evaluateAll((all) => all.map((one) => Number(one.value)));
    assert.deepEqual(
        cells,
        matrix.flat().map((share) => Number(share.toFixed(4))),
    );
    await page.screenshot({ path: path.join(folder, "tree_editor.png") });
    expectNoProblems(log);
});

test("a change of the table posts a custom matrix, which is written to the address", async (t) => {
    const { page, log } = await open(t, "?tree=birch&lod=2");
    const before = (await counts(page)).triangles;
    const entry = page.locator('#matrix input[data-cell="0-1"]');
    await entry.fill("0.6");
    await entry.press("Enter");
    await ready(page);
    assert.equal(
        await page.locator('#matrix input[data-cell="0-0"]').inputValue(),
        "0.4",
        "the row sums to one",
    );
    assert.match((await parameters(page)).get("rows"), /^0\.4,0\.6;/);
    assert.notEqual((await counts(page)).triangles, before);
    assert.ok(log.requests.some((url) => url.endsWith("/v1/trees.glb")));
    assert.equal(await page.locator("#copy-url").isDisabled(), true, "no URL contains it");
    await reload(page, log);
    await ready(page);
    assert.equal(await page.locator('#matrix input[data-cell="0-1"]').inputValue(), "0.6");
    await page.getByRole("button", { name: "Back to the preset" }).click();
    await ready(page);
    assert.equal((await counts(page)).triangles, before);
    assert.equal((await parameters(page)).get("rows"), null);
    expectNoProblems(log);
});

test("a refused row has its message under the table, and the last tree stays", async (t) => {
    const { page, log } = await open(t, "?tree=herb&lod=3");
    const entry = page.locator('#matrix input[data-cell="1-2"]');
    await entry.fill("0");
    await entry.press("Enter");
    await page.locator("#matrix .validation-error:not([hidden])").waitFor();
    assert.match(
        await page.locator("#matrix .validation-error").textContent(),
        /Order 3: .*hardly ever end/,
    );
    assert.ok(
        log.failed.every((line) => line.endsWith(": 422")),
        log.failed.join(),
    );
    assert.ok((await counts(page)).triangles > 100);
});

test("the downloaded file equals that of the address and restores its settings", async (t) => {
    const { page, log } = await open(t, "?tree=poplar&autumn=0.5&lod=3");
    const [download] = await Promise.all([
        page.waitForEvent("download"),
        page.locator("#download").click(),
    ]);
    assert.match(download.suggestedFilename(), /^poplar_tree_s1_[0-9a-f]{8}_LOD3\.glb$/);
    const saved = await readFile(await download.path());
    const served = Buffer.from(
        await (await fetch(`${base}/v1/trees/poplar.glb?autumn=0.5&lod=3`)).arrayBuffer(),
    );
    assert.ok(saved.equals(served));
    await page.goto(`${base}/?leaf=oak&lod=3`);
    await ready(page);
    await page
        .locator("#file")
        .setInputFiles({ name: "poplar.glb", mimeType: "model/gltf-binary", buffer: saved });
    await page.waitForURL(/tree=poplar/);
    await ready(page);
    assert.deepEqual(Object.fromEntries(await parameters(page)), {
        tree: "poplar",
        autumn: "0.5",
        lod: "3",
    });
    assert.deepEqual(log.failed, []);
});
