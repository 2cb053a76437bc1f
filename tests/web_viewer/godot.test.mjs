// The Godot add-on in Godot's web export, in headless Chromium against a running server.
import assert from "node:assert/strict";
import path from "node:path";
import test, { after, before } from "node:test";
import { serveProject } from "./godot_project.mjs";
import { boxInSubtree, numberInSubtree } from "./subtree.mjs";
import { launchBrowser, logEvents, patience, screenshotFolder, serverUrl } from "./support.mjs";

const server = serverUrl({ everySpecies: true });
const found = {};
let browser;
let project;
let log;

before(async () => {
    project = await serveProject(server);
    browser = await launchBrowser();
    const page = await browser.newPage();
    log = logEvents(page);
    const ended = new Promise((resolve, reject) => {
        page.on("console", (message) => {
            const [, json] = /^RESULT (.*)$/.exec(message.text()) ?? [];
            if (json) Object.assign(found, JSON.parse(json));
            if (found.end) resolve();
            if (/SCRIPT ERROR|Parse Error/.test(message.text()))
                reject(new Error(log.console.join("\n")));
        });
        setTimeout(() => reject(new Error(log.console.join("\n"))), patience).unref();
    });
    await page.goto(project.origin);
    await ended;
    await page.screenshot({ path: path.join(await screenshotFolder(), "godot.png") });
});

after(async () => {
    await browser?.close();
    project?.close();
});

async function described(route) {
    return (await fetch(`${server}/v1/${route}`)).json();
}

test("a model has its levels, one for each distance, with collision", async () => {
    const json = await described("mushrooms/amanita_muscaria.json?lod=1&seed=3&lods=nodes");
    const { levels, bodies, solids, statuses } = found.mushroom;
    assert.deepEqual(statuses, [200]);
    assert.equal(bodies, 1);
    assert.ok(solids >= 2);
    assert.ok(levels.length > 3);
    assert.equal(levels.length, json.levels.length);
    for (let axis = 0; axis < 3; ++axis) {
        assert.ok(Math.abs(levels[0].min[axis] - json.bounds_m.min[axis]) < 1e-4);
        assert.ok(Math.abs(levels[0].max[axis] - json.bounds_m.max[axis]) < 1e-4);
    }
    assert.equal(levels[0].begin, 0);
    for (const [i, level] of levels.entries()) {
        assert.match(level.name, new RegExp(`_from1_LOD${i}$`));
        assert.equal(level.side, 128);
        const size = Math.max(...json.bounds_m.max.map((high, k) => high - json.bounds_m.min[k]));
        // The camera of the model has a field of view of 75 degrees.
        const end = size / (2 * json.levels[i].screen_coverage * Math.tan((75 * Math.PI) / 360));
        assert.ok(Math.abs(level.end / end - 1) < 1e-3, `${level.end} ${end}`);
        if (i > 0) {
            assert.equal(level.begin, levels[i - 1].end);
            assert.ok(level.triangles < 0.6 * levels[i - 1].triangles);
        }
    }
});

test("stored files are confirmed, with a version or offline used at once", () => {
    assert.deepEqual(found.again.statuses, [304]);
    assert.equal(found.again.levels.length, found.mushroom.levels.length);
    assert.deepEqual(found.versioned.statuses, [200, 200, 0], "description, file, stored file");
    assert.deepEqual(found.offline.statuses, [0]);
    assert.ok(found.offline.bytes > 10_000);
});

test("some level is visible on both sides of each distance, and none beyond the last", () => {
    const { pixels } = found.seen;
    assert.equal(pixels.length, 2 * found.mushroom.levels.length);
    for (const count of pixels.slice(0, -1)) assert.ok(count > 0, `${pixels}`);
    assert.equal(pixels.at(-1), 0);
});

test("a tree moves in wind", async () => {
    const file = await fetch(`${server}/v1/trees/shrub.glb?lod=1&wind=uv&texture_size=128`);
    const bytes = Buffer.from(await file.arrayBuffer());
    const json = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());
    for (const level of found.tree.levels) {
        assert.equal(level.material, "ShaderMaterial");
        assert.ok(Math.abs(level.sway - json.asset.extras.wind.sway_m) < 1e-6);
    }
    assert.equal(found.tree.levels[0].side, 64);
    assert.equal(found.tree.bodies, 0, "that of the profile is asked for by `collision` alone");
});

test("an impostor ends the levels, and its shader shows what the mesh shows", () => {
    const { levels, pictures } = found.impostor;
    assert.equal(levels.length, 3);
    assert.match(levels[2].name, /_from2_LOD2$/);
    assert.equal(levels[2].triangles, 12);
    const [mesh, quad] = pictures;
    assert.ok(mesh.covered > 500, `${mesh.covered} pixels`);
    assert.ok(Math.abs(quad.covered / mesh.covered - 1) < 0.1, `${quad.covered} ${mesh.covered}`);
    for (let k = 0; k < 3; ++k)
        assert.ok(Math.abs(quad.mean[k] - mesh.mean[k]) < 0.08, `${quad.mean} ${mesh.mean}`);
});

test("a colony is one draw call for each mesh", async () => {
    const json = await described(
        "colonies/hypholoma_fasciculare.json?lod=1&count=12&distinct=3&seed=2",
    );
    const { parts } = found.colony;
    const counts = parts.map(({ count }) => count).sort((a, b) => a - b);
    assert.ok(parts.length <= 4);
    assert.equal(
        counts.reduce((sum, count) => sum + count),
        json.made + 1,
        "and the stems",
    );
});

/** Returns the JSON of a GLB of the server. */
async function jsonOfFile(route) {
    const bytes = Buffer.from(await (await fetch(`${server}/v1/${route}`)).arrayBuffer());
    return JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());
}

const world = "worlds/beech,seed=7,extent=256";

test("a plot of a world opens with all its meshes and images", async () => {
    const json = await jsonOfFile(`${world}/y80d270/plot.glb?x=20&y=-5&size=4&lod=2&texture_size=256&layers=ground+trees+fungi`);
    const { plot } = found;
    assert.deepEqual(plot.statuses, [200]);
    assert.equal(plot.meshes, json.nodes.filter(({ mesh }) => mesh !== undefined).length);
    assert.equal(plot.triangles, json.asset.extras.triangles);
    assert.ok(plot.pictures);
    for (const axis of [0, 2]) assert.ok(plot.min[axis] < -1.999 && plot.max[axis] > 1.999, `${plot.min} ${plot.max}`);
});

test("tiles of worlds open inside their boxes", async () => {
    for (const layer of ["ground", "trees", "fungi"]) {
        const folder = `${world}/core/${layer === "fungi" ? "y80d270" : "y80m10"}/${layer}`;
        const json = await jsonOfFile(`${folder}/5/14/21.glb`);
        const tile = found[layer];
        assert.deepEqual(tile.statuses, [200], layer);
        assert.equal(tile.meshes, json.nodes.filter(({ mesh }) => mesh !== undefined).length, layer);
        assert.ok(tile.meshes > 0, layer);
        assert.equal(tile.triangles, json.asset.extras.triangles, layer);
        assert.ok(tile.pictures, layer);
        const subtree = new Uint8Array(await (await fetch(`${server}/v1/${folder}/3/3/5.subtree`)).arrayBuffer());
        const box = boxInSubtree(subtree, numberInSubtree(2, 14 & 3, 21 & 3));
        // East, up and south in the file are east, north and up in the box.
        const inside = [[tile.min[0], tile.max[0]], [-tile.max[2], -tile.min[2]], [tile.min[1], tile.max[1]]];
        for (let axis = 0; axis < 3; ++axis)
            assert.ok(inside[axis][0] >= box.min[axis] - 1e-3 && inside[axis][1] <= box.max[axis] + 1e-3, `${layer}: ${tile.min} ${tile.max} in ${box.min} ${box.max}`);
    }
});

test("a refusal is reported in the words of the server", () => {
    assert.equal(found.refused.bytes, 0);
    const reported = log.console.filter(
        (line) => /ERROR: /.test(line) && !/script cache/.test(line),
    );
    assert.equal(reported.filter((line) => /did you mean 'amanita_muscaria'/.test(line)).length, 1);
    assert.equal(reported.length, 1, reported.join("\n"));
});
