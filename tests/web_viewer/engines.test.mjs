// Every profile in Babylon.js and glTF-Transform, in headless Chromium against a running server.
// The page and the client kit try three.js.
import assert from "node:assert/strict";
import path from "node:path";
import test, { after, before } from "node:test";
import { bundled, launchBrowser, patience, root, serverUrl } from "./support.mjs";

const server = serverUrl({ everySpecies: true });
let browser;
let page;

before(async () => {
    browser = await launchBrowser();
    page = await browser.newPage();
    page.setDefaultTimeout(patience);
    const script = await bundled(path.join(root, "tests/web_viewer/engines_page.mjs"));
    const address = `${server}/engines/`;
    const html = '<!doctype html><canvas></canvas><script type="module" src="page.js"></script>';
    await page.route(`${address}*`, (route) =>
        route.fulfill(
            route.request().url().endsWith(".js")
                ? { contentType: "text/javascript", body: script }
                : { contentType: "text/html", body: html },
        ),
    );
    await page.goto(address);
    await page.waitForFunction(() => window.engines);
});

after(() => browser?.close());

const opened = (engine, url) =>
    page.evaluate(([name, file]) => window.engines[name](file), [engine, url]);

async function described(route, query) {
    const response = await fetch(`${server}/v1/${route}.json?${query}`);
    assert.equal(response.status, 200, await response.clone().text());
    return response.json();
}

function assertBox(found, { min, max }, tolerance, what) {
    for (let axis = 0; axis < 3; ++axis) {
        assert.ok(
            Math.abs(found.min[axis] - min[axis]) < tolerance,
            `${what}: ${found.min} ${min}`,
        );
        assert.ok(
            Math.abs(found.max[axis] - max[axis]) < tolerance,
            `${what}: ${found.max} ${max}`,
        );
    }
}

const profiles = ["core", "web", "mobile", "godot", "unity", "unreal", "blender", "cesium"];
const webp = ["web", "mobile", "godot", "cesium"];
const products = [
    {
        route: "mushrooms/amanita_muscaria",
        query: "age=0.7",
        materials: 1,
        name: "amanita_muscaria",
    },
    { route: "trees/shrub", query: "seed=2", materials: 2, name: "shrub" },
    { route: "colonies/mycena_sanguinolenta", query: "count=5&distinct=2", materials: 1 },
    { route: "leaves/maple", query: "autumn=0.3", materials: 1, name: "maple" },
];

for (const profile of profiles)
    test(`${profile} opens with size, orientation, material and level`, async () => {
        for (const { route, query, materials, name } of products) {
            const what = `${route} ${profile}`;
            const options = `${query}&profile=${profile}&lod=1&texture_size=256`;
            const json = await described(route, options);
            const url = `${server}${json.canonical}`;
            const size = Math.max(
                ...json.bounds_m.max.map((high, i) => high - json.bounds_m.min[i]),
            );
            const inBabylon = await opened("babylon", url);
            // Boxes of nodes are made of the boxes of their meshes, and therefore larger.
            if (name) assertBox(inBabylon, json.bounds_m, size / 8000, what);
            else assertBox(inBabylon, json.bounds_m, size / 8, what);
            assert.equal(inBabylon.materials, materials, what);
            assert.ok(inBabylon.maps, `${what}: all images are decoded`);
            assert.equal(inBabylon.side, 128, what);
            const read = await opened("transform", url);
            assertBox(read, json.bounds_m, name ? size / 8000 : size / 8, what);
            assert.equal(read.materials, materials, what);
            const type = webp.includes(profile) ? "image/webp" : "image/jpeg";
            for (const image of read.images) assert.deepEqual(image, [type, 128, 128], what);
            if (name) assert.equal(read.triangles[0], read.stated, what);
            const chain = profile === "unreal";
            if (name) assert.equal(read.nodes.length, chain ? json.levels.length : 1, what);
            const first = chain && route.startsWith("mushrooms") ? "_from1_LOD0" : "_LOD1";
            if (name)
                assert.ok(read.nodes[0].startsWith(name) && read.nodes[0].endsWith(first), what);
        }
    });

for (const profile of ["core", "web", "unity", "cesium"])
    test(`growth moves in ${profile}`, async () => {
        const options = `profile=${profile}&lod=2&animation=growth&frames=5&texture_size=128`;
        const url = `${server}/v1/mushrooms/amanita_muscaria.glb?${options}`;
        const found = await opened("babylon", url);
        assert.equal(found.clips.length, 1);
        assert.deepEqual(found.weights, [
            [1, 0, 0, 0, 0],
            [0, 0, 0, 0, 1],
        ]);
        assert.deepEqual((await opened("transform", url)).clips.length, 1);
    });

test("instances are drawn at their places", async () => {
    for (const [route, compress] of [
        ["trees/shrub", "none"],
        ["trees/shrub", "quantize"],
        ["trees/shrub", "meshopt"],
        ["colonies/mycena_sanguinolenta", "meshopt"],
    ]) {
        const options = `instancing=gpu&lod=2&texture_size=128&compress=${compress}`;
        const json = await described(route, options);
        const found = await opened("babylon", `${server}${json.canonical}`);
        const size = Math.max(...json.bounds_m.max.map((high, i) => high - json.bounds_m.min[i]));
        assertBox(found, json.bounds_m, size / 12, `${route} ${compress}`);
        const { stated } = await opened("transform", `${server}${json.canonical}`);
        assert.equal(found.triangles, stated, `${route} ${compress}`);
    }
});
