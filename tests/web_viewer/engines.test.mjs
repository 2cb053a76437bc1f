// Every profile in Babylon.js and glTF-Transform, in headless Chromium against a running server; plots and tiles of
// worlds in three.js too. The page and the client kit try three.js with all else.
import assert from "node:assert/strict";
import path from "node:path";
import test, { after, before } from "node:test";
import { boxInSubtree, numberInSubtree } from "./subtree.mjs";
import { bundled, launchBrowser, logEvents, patience, root, serverUrl } from "./support.mjs";

const server = serverUrl({ everySpecies: true });
let browser;
let page;
let log;

before(async () => {
    browser = await launchBrowser();
    page = await browser.newPage();
    page.setDefaultTimeout(patience);
    log = logEvents(page);
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
            // The base colour of leaves on trees has alpha, which JPEG has not.
            const types = read.images.map(([found]) => found).sort();
            const expected = read.images.map(() => type);
            if (route.startsWith("trees") && type === "image/jpeg")
                expected[expected.length - 1] = "image/png";
            assert.deepEqual(types, expected, what);
            for (const [, ...sides] of read.images) assert.deepEqual(sides, [128, 128], what);
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

/** Opens a file, expects that nothing failed or was complained of on the way, and returns what each engine has of it. */
async function openedInAll(url, what) {
    for (const list of Object.values(log)) list.length = 0;
    const found = {};
    const isLinked = url.includes("/web/");
    found.babylon = await opened(isLinked ? "babylonLinked" : "babylon", url);
    for (const engine of ["three", "transform"]) found[engine] = await opened(engine, url);
    assert.deepEqual(log.failed, [], what);
    assert.deepEqual(log.console.filter((line) => /^(error|warning|uncaught)/.test(line)), [], what);
    return found;
}

const plots = [
    ["beech,seed=7,extent=256", "y80d270", "x=20&y=-5"],
    ["meadow,extent=256", "y80d250", "x=10&y=30"],
];
const ofPlot = "size=4&lod=2&texture_size=256&litter=5";

for (const instancing of ["none", "gpu"])
    test(`plots of worlds with instancing=${instancing} open with their size, their images and all that is on them`, async () => {
        for (const [world, time, place] of plots) {
            const what = `${world} ${instancing}`;
            const folder = `worlds/${world}/${time}`;
            const json = await described(`${folder}/plot`, `${place}&${ofPlot}&instancing=${instancing}`);
            const url = `${server}/v1/${folder}/plot.glb?${place}&${ofPlot}&instancing=${instancing}`;
            const { babylon, three, transform } = await openedInAll(url, what);
            // The origin is on the ground in the middle of the plot; leaves and crowns reach beyond its edges.
            const [west, south, east, north] = json.bbox;
            for (const found of [babylon, three]) {
                assert.ok(found.min[0] <= (west - east) / 2 + 1e-3 && found.max[0] >= (east - west) / 2 - 1e-3, `${what}: ${found.min} ${found.max}`);
                assert.ok(found.min[2] <= (south - north) / 2 + 1e-3 && found.max[2] >= (north - south) / 2 - 1e-3, `${what}: ${found.min} ${found.max}`);
                assert.ok(found.min[1] < 0 && found.max[1] > 0, `${what}: ${found.min} ${found.max}`);
                assertBox(found, three, 0.02, what);
                assert.ok(found.pictured > 0 && found.pictured === transform.pictured, `${what}: ${found.pictured} of ${transform.pictured} images are decoded`);
                assert.equal(found.triangles, transform.stated, what);
                assert.equal(found.drawn, transform.drawn, what);
            }
        }
    });

const ofTiles = "beech,seed=7,extent=256";
const leafTile = [5, 14, 21];

for (const [profile, layer, time] of [
    ["core", "ground", "y80m10"],
    ["core", "trees", "y80m10"],
    ["core", "fungi", "y80d270"],
    ["web", "trees", "y80m10"],
])
    test(`a tile of ${layer} of the profile ${profile} opens inside its box, with all that stands there`, async () => {
        const what = `${profile} ${layer}`;
        const folder = `${server}/v1/worlds/${ofTiles}/${profile}/${time}/${layer}`;
        const [level, x, y] = leafTile;
        const { babylon, three, transform } = await openedInAll(`${folder}/${level}/${x}/${y}.glb`, what);
        // A subtree has three of the six levels of this world.
        const subtree = new Uint8Array(await (await fetch(`${folder}/3/${x >> 2}/${y >> 2}.subtree`)).arrayBuffer());
        const box = boxInSubtree(subtree, numberInSubtree(2, x & 3, y & 3));
        for (const found of [babylon, three]) {
            assert.ok(found.pictured > 0 && found.pictured === transform.pictured, `${what}: ${found.pictured} of ${transform.pictured} images are decoded`);
            assert.equal(found.triangles, transform.stated, what);
            assert.equal(found.drawn, transform.drawn, what);
            // East, up and south in the file are east, north and up in the box.
            const [low, high] = [found.min, found.max];
            const inside = [[low[0], high[0]], [-high[2], -low[2]], [low[1], high[1]]];
            for (let axis = 0; axis < 3; ++axis)
                assert.ok(inside[axis][0] >= box.min[axis] - 1e-3 && inside[axis][1] <= box.max[axis] + 1e-3, `${what}: ${low} ${high} in ${box.min} ${box.max}`);
        }
        if (layer === "ground") return;
        const kinds = layer === "trees" ? "tree" : "fungus";
        // What a month shows is that of the middle of it: October begins on day 274.
        const day = layer === "trees" ? 274 + 15 : 270;
        const [west, south] = [8 * x - 128, 8 * y - 128];
        const query = `bbox=${west},${south},${west + 8},${south + 8}&kinds=${kinds}`;
        const { placements } = await described(`worlds/${ofTiles}/y80d${day}/placements`, query);
        assert.ok(placements.length > 0, what);
        assert.deepEqual(transform.ids.sort(), placements.map(({ id }) => id).sort(), what);
    });

for (const [engine, profile] of [
    ["Three", "web"],
    ["Babylon", "core"],
])
    test(`a world of the profile ${profile} streams with 3d-tiles-renderer in ${engine}`, async () => {
        for (const list of Object.values(log)) list.length = 0;
        const [level, x, y] = leafTile;
        const ground = new Uint8Array(await (await fetch(`${server}/v1/worlds/${ofTiles}/${profile}/y80m9/ground/3/${x >> 2}/${y >> 2}.subtree`)).arrayBuffer());
        const { min, max } = boxInSubtree(ground, numberInSubtree(level - 3, x & 3, y & 3));
        const place = [(min[0] + max[0]) / 2, max[2] + 2, -(min[1] + max[1]) / 2];
        const found = await opened(`streamedIn${engine}`, [`${server}/v1/worlds/${ofTiles}/${profile}/y80d270/tileset.json`, place]);
        assert.deepEqual(found.failed, []);
        assert.deepEqual(log.failed, []);
        for (const layer of ["ground", "trees", "floor", "fungi"]) assert.ok(found.loaded[layer] > 0, `${layer}: ${JSON.stringify(found)}`);
        assert.ok(found.visible >= 4);
        // The renderer warns of every tileset of version 1.1.
        assert.deepEqual(log.console.filter((line) => /^(error|warning|uncaught)/.test(line) && !/version/i.test(line)), []);
    });

test("a map opens as an image, north up", async () => {
    const address = `${server}/v1/worlds/${ofTiles}/y0/maps/height`;
    const side = 16;
    const found = await page.evaluate(([url, count]) => window.engines.map(url, count), [`${address}.png?size=128`, side]);
    assert.deepEqual([found.width, found.height], [128, 128]);
    const numbers = new DataView(await (await fetch(`${address}.r16?size=128`)).arrayBuffer());
    const at = (i) => Math.floor(((i + 0.5) * 128) / side);
    for (const [i, shown] of found.pixels.entries()) {
        const number = numbers.getUint16(2 * (at(Math.floor(i / side)) * 128 + at(i % side)), true);
        assert.ok(Math.abs(shown - number / 257) <= 1, `${i}: ${shown} ${number}`);
    }
    assert.ok(new Set(found.pixels).size > 40, "there are hills");
});
