// Tests of the client kit for three.js in headless Chromium against a running server.
import assert from "node:assert/strict";
import { createServer } from "node:http";
import path from "node:path";
import test, { after, before } from "node:test";
import {
    bundled,
    launchBrowser,
    logEvents,
    patience,
    root,
    screenshotFolder,
    serverUrl,
} from "./support.mjs";

const server = serverUrl({ everySpecies: true });
const kit = path.join(root, "web_viewer/clients/three");
let browser;
let pages;
let address;

before(async () => {
    browser = await launchBrowser();
    const scripts = {
        "/forest.js": await bundled(path.join(kit, "examples/forest.ts")),
        "/compare.js": await bundled(path.join(root, "tests/web_viewer/compare_page.mjs")),
        "/specks.js": await bundled(path.join(root, "tests/web_viewer/specks_page.mjs")),
        "/impostor.js": await bundled(path.join(root, "tests/web_viewer/impostor_page.mjs")),
    };
    pages = createServer(({ url }, response) => {
        const script = scripts[url];
        const name = new URL(url, "http://127.0.0.1").pathname.slice(1);
        response.setHeader("Content-Type", script ? "text/javascript" : "text/html");
        response.end(
            script ??
                `<!doctype html><canvas></canvas><script type="module" src="/${name}.js"></script>`,
        );
    });
    await new Promise((resolve) => pages.listen(0, "127.0.0.1", resolve));
    address = `http://127.0.0.1:${pages.address().port}/`;
});

after(async () => {
    await browser?.close();
    pages?.close();
});

const twelve = [
    "amanita_muscaria",
    "boletus_edulis",
    "cantharellus_cibarius",
    "mycena_sanguinolenta",
    "hypholoma_fasciculare",
    "russula_emetica",
    "macrolepiota_procera",
    "coprinus_comatus",
    "lactarius_deliciosus",
    "hydnum_repandum",
    "lepista_nuda",
    "morchella_esculenta",
];

/** Opens the forest; returns its report, and the requests and bytes that it took. */
async function walked(t, species) {
    const page = await browser.newPage({ viewport: { width: 640, height: 360 } });
    t.after(() => page.close());
    const log = logEvents(page);
    const downloads = [];
    page.on("response", (response) => {
        if (response.url().startsWith(server)) downloads.push(response.body().catch(() => ""));
    });
    await page.goto(`${address}forest?${new URLSearchParams({ server, species: species.join() })}`);
    await page.waitForFunction(() => window.forest ?? window.forestError, null, {
        timeout: patience,
    });
    const error = await page.evaluate(() => window.forestError);
    const report = await page.evaluate(() => window.forest);
    const bodies = await Promise.all(downloads);
    const bytes = bodies.reduce((sum, body) => sum + body.length, 0);
    if (report) await page.screenshot({ path: path.join(await screenshotFolder(), "forest.png") });
    return { report, error, requests: downloads.length, bytes, log };
}

test("a forest of 300 individuals fits on a phone", async (t) => {
    const { report, error, requests, bytes, log } = await walked(t, twelve);
    assert.equal(error, undefined);
    t.diagnostic(`${JSON.stringify(report)}, ${requests} requests, ${bytes} bytes`);
    assert.equal(report.individuals, 300);
    assert.equal(report.species, 12);
    assert.ok(report.draws <= 20, `${report.draws} draw calls`);
    assert.ok(report.triangles <= 200_000, `${report.triangles} triangles in view`);
    assert.ok(report.imageBytes <= 72e6, `${report.imageBytes} bytes of images`);
    assert.ok(requests <= 5, `${requests} requests`);
    assert.ok(bytes <= 3.5e6, `${bytes} bytes downloaded`);
    assert.ok(report.levels.length === 3 && report.levels.every((count) => count > 0));
    assert.ok(report.switches > 0, "levels follow the camera");
    assert.ok(report.colliders >= 24, "every prototype has solids");
    assert.ok(report.moved > 0.005, "the wind moves what is seen");
    assert.deepEqual(log.console.filter((line) => /^(error|uncaught)/.test(line)), []);
});

/** Returns how the pictures of two files differ. */
async function differenceOf(t, query) {
    const page = await browser.newPage();
    t.after(() => page.close());
    await page.goto(`${address}compare?${new URLSearchParams({ server, ...query })}`);
    await page.waitForFunction(() => window.difference, null, { timeout: patience });
    const difference = await page.evaluate(() => window.difference);
    if (!difference.error)
        await page.screenshot({ path: path.join(await screenshotFolder(), "compare.png") });
    return difference;
}

test("a set of twelve species in one atlas is one draw call and looks the same", async (t) => {
    const order = {
        species: twelve,
        levels: [1, 2, 3],
        share: "species",
        lods: "msft",
        profile: "web",
        texture_size: 1024,
    };
    for (const [atlas, draws] of [
        ["species", 12],
        ["set", 1],
    ])
        // From near, and from where an individual has 40 pixels and is drawn with mipmaps.
        for (const distance of [4, 10]) {
            const difference = await differenceOf(t, {
                first: JSON.stringify(order),
                second: JSON.stringify({ ...order, atlas }),
                distance,
            });
            assert.equal(difference.error, undefined);
            t.diagnostic(`${atlas} at ${distance}: ${JSON.stringify(difference)}`);
            assert.deepEqual(difference.draws, [12, draws]);
            assert.ok(difference.covered > 0.01, `${difference.covered} is covered`);
            assert.ok(difference.mean < 1, `mean ΔE ${difference.mean}`);
            // From afar few pixels are covered, so that each counts more.
            const most = distance > 4 ? 0.015 : 0.01;
            assert.ok(difference.visible < most, `${difference.visible} differs visibly`);
        }
});

test("compressed files look like the uncompressed ones", async (t) => {
    const small = "lod=1&texture_size=512";
    for (const product of [
        `mushrooms/amanita_muscaria.glb?${small}`,
        `mushrooms/morchella_esculenta.glb?${small}`,
        `colonies/hypholoma_fasciculare.glb?${small}`,
        `leaves/maple.glb?${small}`,
        `trees/spruce.glb?lod=2&texture_size=512`,
    ])
        for (const options of ["compress=quantize", "compress=meshopt"]) {
            const { mean, covered, error } = await differenceOf(t, {
                first: product,
                second: `${product}&${options}`,
            });
            assert.equal(error, undefined);
            t.diagnostic(`${product} ${options}: mean ΔE ${mean.toFixed(3)}`);
            assert.ok(covered > 0.02, `${product} covers ${covered} of the picture`);
            assert.ok(mean < 1, `${product} ${options}: mean ΔE ${mean}`);
        }
});

test("an impostor looks like the mesh at a distance", async (t) => {
    // The largest share of the outline, and of 255 of a colour. A cap that leans is thin from some
    // sides, so that its outline has more pixels for its area; the gaps of a crown are smaller than
    // a texel, those between slim needles most; branches of a coral hide the light from each other,
    // seen from above most.
    for (const [product, lod, outline, colour] of [
        ["mushrooms/amanita_muscaria", 2, 0.15, 20],
        ["mushrooms/boletus_edulis", 2, 0.1, 6],
        ["mushrooms/cantharellus_cibarius", 2, 0.12, 8],
        ["mushrooms/ramaria_formosa", 1, 0.2, 26],
        ["trees/spruce", 1, 0.56, 22],
    ]) {
        const page = await browser.newPage();
        t.after(() => page.close());
        const log = logEvents(page);
        const query = new URLSearchParams({ server, product, lod, side: 40 });
        await page.goto(`${address}impostor?${query}`);
        await page.waitForFunction(() => window.impostor, null, { timeout: patience });
        const { error, views } = await page.evaluate(() => window.impostor);
        assert.equal(error, undefined);
        for (const { view, shader } of views) {
            const seen = `${product} from ${view}: ${JSON.stringify(shader)}`;
            assert.ok(shader.covered > 0.04, seen);
            assert.ok(shader.outline <= outline, seen);
            for (const one of shader.bias) assert.ok(Math.abs(one) <= colour, seen);
        }
        const worst = Math.max(...views.map(({ shader }) => shader.outline));
        t.diagnostic(`${product}: outlines differ by ${(100 * worst).toFixed(1)} % at most`);
        assert.deepEqual(log.console.filter((line) => /^(error|uncaught)/.test(line)), []);
    }
});

test("no species shows a speck from any side", async (t) => {
    const answer = await fetch(`${server}/v1/species`);
    const ids = (await answer.json()).species.map(({ id }) => id);
    const draws = Number(process.env.SPOREPRINT_SPECKS ?? 12);
    const page = await browser.newPage();
    t.after(() => page.close());
    const log = logEvents(page);
    for (let i = 0; i < draws; ++i) {
        const id = ids[(11 * i + Math.floor(i / ids.length)) % ids.length];
        const age = (0.1 + (0.9 * ((37 * i) % 100)) / 100).toFixed(3);
        const product = `mushrooms/${id}.glb?lod=0&texture_size=512&seed=${i}&age=${age}`;
        const view = { azimuth: (73 * i) % 360, elevation: [25, 5, 85, -40][i % 4] };
        await page.goto(`${address}specks?${new URLSearchParams({ server, product, ...view })}`);
        await page.waitForFunction(() => window.specks, null, { timeout: patience });
        const { error, found, covered } = await page.evaluate(() => window.specks);
        assert.equal(error, undefined, product);
        assert.ok(covered > 0.02, `${product} covers ${covered} of the picture`);
        assert.deepEqual(found, [], `${product} ${JSON.stringify(view)}`);
    }
    assert.deepEqual(log.console.filter((line) => /^(error|uncaught)/.test(line)), []);
});

test("a refusal names the parameter", async (t) => {
    const { error } = await walked(t, ["amanita_muscara"]);
    assert.match(error, /404.*amanita_muscara/);
});
