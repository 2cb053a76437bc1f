// Pictures of mushrooms that nobody here has made, from the picture to the grown mushroom and back: how far the
// contour of what grows is from that of the picture. The stage real_inputs of tests/run installs them.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { access, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";
import test from "node:test";
import { packages, root, serverUrl } from "./support.mjs";

const installed = path.join(root, "tests/web_viewer/real_inputs/node_modules");
const binary = path.join(root, "build/release/server/sporeprint");
/** Files, and the mean distance of the contours in % of the height: the goal, and what is allowed. */
const inputs = {
    fluent_3d: { file: "@lobehub/fluent-emoji-3d/assets/1f344.webp", goal: 0.8, most: 0.8 },
    twemoji: { file: "@twemoji/svg/1f344.svg", goal: 1.2, most: 0.65 },
    openmoji_red: { file: "openmoji/color/svg/1F344.svg", goal: 2, most: 0.7 },
    openmoji_brown: { file: "openmoji/color/svg/1F344-200D-1F7EB.svg", goal: 2, most: 0.45 },
};
const side = 512;

async function isInstalled() {
    return access(installed).then(
        () => true,
        () => false,
    );
}

/** Returns whether a pixel is no more than the shadow on the ground, which is translucent black. */
const isShadow = (red, green, blue, alpha) => red + green + blue === 0 && alpha < 255;

/** Returns the middles of the opaque pixels of a picture that have a transparent neighbour. */
async function contourOf(picture) {
    const { data, info } = await packages("sharp")(picture)
        .resize(side, side, { fit: "contain", background: { r: 0, g: 0, b: 0, alpha: 0 } })
        .ensureAlpha()
        .raw()
        .toBuffer({ resolveWithObject: true });
    const inside = (x, y) => {
        if (x < 0 || y < 0 || x >= info.width || y >= info.height) return false;
        const pixel = data.subarray(4 * (y * info.width + x), 4 * (y * info.width + x) + 4);
        return pixel[3] >= 128 && !isShadow(...pixel);
    };
    const outside = outsideOf(inside, info.width, info.height);
    const points = [];
    for (let y = 0; y < info.height; ++y)
        for (let x = 0; x < info.width; ++x)
            if (inside(x, y) && [[1, 0], [-1, 0], [0, 1], [0, -1]].some(([u, v]) => outside(x + u, y + v)))
                points.push([x, y]);
    return points;
}

/** Returns whether a pixel hangs together with the border of a picture: a hole is no outside. */
function outsideOf(inside, width, height) {
    const reached = new Set();
    const open = [[-1, -1]];
    const key = (x, y) => (y + 1) * (width + 2) + x + 1;
    reached.add(key(-1, -1));
    while (open.length) {
        const [x, y] = open.pop();
        for (const [u, v] of [[x + 1, y], [x - 1, y], [x, y + 1], [x, y - 1]]) {
            if (u < -1 || v < -1 || u > width || v > height || inside(u, v) || reached.has(key(u, v))) continue;
            reached.add(key(u, v));
            open.push([u, v]);
        }
    }
    return (x, y) => reached.has(key(x, y));
}

function nearest([x, y], points) {
    let best = points[0], least = Infinity;
    for (const point of points) {
        const square = (point[0] - x) ** 2 + (point[1] - y) ** 2;
        if (square < least) [best, least] = [point, square];
    }
    return best;
}

const meanDistance = (from, to) =>
    from.reduce((sum, a) => sum + Math.hypot(...nearest(a, to).map((value, i) => value - a[i])), 0) / from.length;

const heightOf = (points) => Math.max(...points.map(([, y]) => y)) - Math.min(...points.map(([, y]) => y));

const middleOf = (points) => [0, 1].map((i) => points.reduce((sum, point) => sum + point[i], 0) / points.length);

/**
 * Returns the mean distance of two contours in % of the height, when one is scaled and moved to where it fits the
 * other best: the camera of our pictures is near and a little above, so that the near edge of a foot is lower.
 */
function apart(truth, grown) {
    const height = heightOf(truth);
    let moved = grown.map((point) => point.map((value) => (value * height) / heightOf(grown)));
    for (let round = 0; round < 20; ++round) {
        const aims = moved.map((point) => nearest(point, truth));
        const [from, to] = [middleOf(moved), middleOf(aims)];
        let along = 0, square = 0;
        moved.forEach((point, k) => {
            for (const i of [0, 1]) {
                along += (point[i] - from[i]) * (aims[k][i] - to[i]);
                square += (point[i] - from[i]) ** 2;
            }
        });
        moved = moved.map((point) => point.map((value, i) => to[i] + (along / square) * (value - from[i])));
    }
    return (50 * (meanDistance(moved, truth) + meanDistance(truth, moved))) / height;
}

async function post(address, body, type) {
    const response = await fetch(`${serverUrl()}${address}`, { method: "POST", headers: { "Content-Type": type }, body });
    const found = await response.json();
    assert.ok(response.ok, `${address}: ${JSON.stringify(found)}`);
    return found;
}

/** Starts a server with species of a folder; returns its address and how to end it. */
async function serverOf(folder) {
    const port = 20000 + Math.floor(12000 * Math.random());
    const server = spawn(binary, ["--host", "127.0.0.1", "--port", String(port), "--atlas", folder], { stdio: "ignore" });
    const url = `http://127.0.0.1:${port}`;
    for (let i = 0; i < 300; ++i) {
        const isLive = await fetch(`${url}/livez`).then((response) => response.ok, () => false);
        if (isLive) break;
        await new Promise((resolve) => setTimeout(resolve, 100));
    }
    return { url, end: () => server.kill() };
}

test("pictures that nobody here has made grow into what they show", async (t) => {
    if (!(await isInstalled())) return t.skip("the stage real_inputs of tests/run installs them");
    const folder = await mkdtemp(path.join(tmpdir(), "real_inputs_"));
    t.after(() => rm(folder, { recursive: true }));
    const traces = {};
    for (const [id, { file }] of Object.entries(inputs)) {
        const drawing = await readFile(path.join(installed, file));
        const picture = await packages("sharp")(drawing, { density: file.endsWith(".svg") ? 1200 : 72 })
            .resize(1024, 1024, { fit: "inside" })
            .png()
            .toBuffer();
        const { photo, alpha } = await post("/v1/photos", picture, "image/png");
        assert.equal(alpha, true, id);
        const order = { views: { side: { photo } }, height_m: 0.1, id };
        const trace = await post("/v1/traces", JSON.stringify(order), "application/json");
        traces[id] = { picture, trace };
        await writeFile(path.join(folder, `${id}.json`), JSON.stringify(trace.species));
    }
    const server = await serverOf(folder);
    t.after(() => server.end());
    const found = {};
    for (const [id, { picture, trace }] of Object.entries(traces)) {
        const { age } = trace.species.stages[trace.stage];
        const query = `width=${side}&height=${side}&view=front&background=transparent&base=clean&variation=0&seed=1&age=${age}`;
        const response = await fetch(`${server.url}/v1/mushrooms/${id}.png?${query}`);
        assert.equal(response.status, 200, id);
        const grown = Buffer.from(await response.arrayBuffer());
        found[id] = apart(await contourOf(picture), await contourOf(grown));
        t.diagnostic(`${id}: ${found[id].toFixed(2)} %, goal ${inputs[id].goal} %, ${trace.form}, ${trace.method}, like ${trace.template}`);
    }
    for (const [id, { most }] of Object.entries(inputs)) assert.ok(found[id] <= most, `${id}: ${found[id]} % of ${most}`);
});
