// Walks tilesets of a running server as Cesium's own tools do (3d-tiles-tools, whose traversal 3d-tiles-validator uses
// too), and checks what the validator checks: versions, geometric errors, the layout and availability of subtrees, and
// that every vertex of a content lies in the box of its tile and in those of the tiles above.
//
//   npm install --prefix tests/web_viewer/tiles
//   node tests/web_viewer/check_tiles.mjs URL ...    e.g. http://127.0.0.1:8080/v1/worlds/beech,extent=256/web/y80d270/tileset.json
//     --every N    reads only each Nth content of a layer
//     --list FILE  writes the URLs of the contents that were read, for validate_glbs.mjs
//
// The box of the tile that a tileset names for a layer is not asked to contain crowns and trunks beyond the edge of the
// world: readers that do not know the boxes of subtrees divide it. How many contents reach out of it is printed.
import { writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import path from "node:path";
import { parseArgs } from "node:util";
import { packages, root } from "./support.mjs";

const { TilesetTraverser } = createRequire(path.join(root, "tests/web_viewer/tiles/package.json"))("3d-tiles-tools");
const { NodeIO } = packages("@gltf-transform/core");
const { ALL_EXTENSIONS } = packages("@gltf-transform/extensions");

const { values: options, positionals: tilesets } = parseArgs({
    allowPositionals: true,
    options: { every: { type: "string", default: "1" }, list: { type: "string" } },
});
const every = Number(options.every);
if (tilesets.length === 0 || !Number.isInteger(every) || every < 1) {
    console.error("usage: check_tiles.mjs URL ... [--every N] [--list FILE]");
    process.exit(2);
}

/** Share of half the side of a box by which a vertex may be outside: that of the validator. */
const tolerance = 1e-5;

const problems = [];
const problem = (where, what) => problems.push(`${where}: ${what}`);

async function bytesOf(url) {
    const response = await fetch(url);
    if (!response.ok) throw new Error(`${url} responded with ${response.status}`);
    return Buffer.from(await response.arrayBuffer());
}

/** Checks the head of a subtree and the layout of its buffers. */
function checkSubtree(url, bytes) {
    const [json, binary] = [8, 16].map((at) => Number(bytes.readBigUint64LE(at)));
    if (bytes.toString("latin1", 0, 4) !== "subt" || bytes.readUInt32LE(4) !== 1) problem(url, "it is no subtree of version 1");
    if (json % 8 !== 0 || binary % 8 !== 0) problem(url, `its parts of ${json} and ${binary} bytes are not multiples of 8`);
    if (24 + json + binary !== bytes.length) problem(url, `it has ${bytes.length} bytes and names ${24 + json + binary}`);
    const { buffers = [], bufferViews = [] } = JSON.parse(bytes.toString("utf8", 24, 24 + json));
    for (const { buffer, byteOffset, byteLength } of bufferViews)
        if (!(byteLength >= 1 && byteOffset >= 0 && byteOffset + byteLength <= buffers[buffer]?.byteLength)) problem(url, "a view lies outside of its buffer");
}

/** Reads what a tileset names, relative to it. */
class Resources {
    constructor(base) {
        this.base = base;
    }
    resolveUri(uri) {
        return new URL(uri, this.base).href;
    }
    async resolveData(uri) {
        const bytes = await bytesOf(this.resolveUri(uri));
        if (uri.endsWith(".subtree")) checkSubtree(this.resolveUri(uri), bytes);
        return bytes;
    }
    resolveDataPartial(uri) {
        return this.resolveData(uri);
    }
    derive(uri) {
        return new Resources(new URL(`${uri}/`, this.base).href);
    }
}

// Geometry that tiles share is requested once; of images nothing is needed here.
const shared = new Map();
async function fetchForReader(url) {
    const { pathname } = new URL(url);
    if (/\.(jpg|webp|png)$/.test(pathname)) return new Response(new Uint8Array(0));
    if (!pathname.endsWith(".bin")) return fetch(url);
    if (!shared.has(url)) shared.set(url, bytesOf(url));
    return new Response(await shared.get(url));
}
const io = new NodeIO(fetchForReader).setAllowNetwork(true).registerExtensions(ALL_EXTENSIONS);

/** Returns the product of two matrices of 16 numbers, column by column. */
const product = (a, b) => a.map((_, i) => [0, 1, 2, 3].reduce((sum, k) => sum + a[4 * k + (i % 4)] * b[4 * (i - (i % 4)) / 4 + k], 0));

/** Returns the matrix of a place, a quaternion and a scale. */
function matrixOf([tx, ty, tz], [x, y, z, w], [sx, sy, sz]) {
    return [
        (1 - 2 * (y * y + z * z)) * sx, 2 * (x * y + z * w) * sx, 2 * (x * z - y * w) * sx, 0,
        2 * (x * y - z * w) * sy, (1 - 2 * (x * x + z * z)) * sy, 2 * (y * z + x * w) * sy, 0,
        2 * (x * z + y * w) * sz, 2 * (y * z - x * w) * sz, (1 - 2 * (x * x + y * y)) * sz, 0,
        tx, ty, tz, 1,
    ];
}

/** Returns the matrices of the instances of a node. */
function instancesOf(node) {
    const own = node.getWorldMatrix();
    const instances = node.getExtension("EXT_mesh_gpu_instancing");
    if (!instances) return [own];
    const [places, turns, scales] = ["TRANSLATION", "ROTATION", "SCALE"].map((name) => instances.getAttribute(name));
    const count = (places ?? turns ?? scales).getCount();
    return Array.from({ length: count }, (_, i) =>
        product(own, matrixOf(places?.getElement(i, []) ?? [0, 0, 0], turns?.getElement(i, []) ?? [0, 0, 0, 1], scales?.getElement(i, []) ?? [1, 1, 1])),
    );
}

/** Returns the box of all vertices of a file: east, north and up. */
async function boxOfContent(url) {
    const document = await io.read(url);
    const box = { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] };
    const point = [0, 0, 0];
    for (const scene of document.getRoot().listScenes())
        scene.traverse((node) => {
            const matrices = node.getMesh() ? instancesOf(node) : [];
            for (const primitive of node.getMesh()?.listPrimitives() ?? []) {
                const positions = primitive.getAttribute("POSITION");
                for (let i = 0; i < positions.getCount(); ++i) {
                    const [x, y, z] = positions.getElement(i, point);
                    for (const m of matrices) {
                        const place = [
                            m[0] * x + m[4] * y + m[8] * z + m[12],
                            -(m[2] * x + m[6] * y + m[10] * z + m[14]),
                            m[1] * x + m[5] * y + m[9] * z + m[13],
                        ];
                        for (let axis = 0; axis < 3; ++axis) {
                            box.min[axis] = Math.min(box.min[axis], place[axis]);
                            box.max[axis] = Math.max(box.max[axis], place[axis]);
                        }
                    }
                }
            }
        });
    return box;
}

/** Returns by how many metres a box stands out of that of a tile, which has the axes of the world. */
function outside({ min, max }, tile) {
    let most = 0;
    for (let axis = 0; axis < 3; ++axis) {
        const [middle, half] = [tile.boundingVolume.box[axis], tile.boundingVolume.box[3 + 4 * axis]];
        const allowed = half * (1 + tolerance);
        most = Math.max(most, middle - allowed - min[axis], max[axis] - middle - allowed);
    }
    return most;
}

const listed = [];

async function check(address) {
    const tileset = JSON.parse(await bytesOf(address));
    if (tileset.asset.version !== "1.1") problem(address, `its version is ${tileset.asset.version}`);
    const layers = new Map();
    const traverser = new TilesetTraverser(address, new Resources(address), { depthFirst: true });
    await traverser.traverse(tileset, async (traversed) => {
        const tile = traversed.asFinalTile();
        const parent = traversed.getParent();
        if (parent && parent.asFinalTile().geometricError < tile.geometricError) problem(traversed.path, `its geometric error ${tile.geometricError} is larger than that of its parent`);
        // The root of a layer names no file but the pattern of them.
        if (traversed.isImplicitTilesetRoot()) return true;
        const uri = tile.content?.uri;
        if (!uri) return true;
        const name = uri.split("/").at(-4);
        const layer = layers.get(name) ?? { contents: 0, read: 0, empty: 0, beyond: 0, farthest: 0 };
        layers.set(name, layer);
        if (layer.contents++ % every !== 0) return true;
        const url = new URL(uri, address).href;
        const box = await boxOfContent(url);
        listed.push(url);
        ++layer.read;
        if (box.min[0] > box.max[0]) {
            ++layer.empty;
            return true;
        }
        for (let above = traversed; above; above = above.getParent()) {
            const out = outside(box, above.asFinalTile());
            if (out <= 0) continue;
            if (above.isImplicitTilesetRoot()) {
                ++layer.beyond;
                layer.farthest = Math.max(layer.farthest, out);
            } else problem(url, `it stands ${out.toFixed(3)} m out of the box of ${above.path}`);
        }
        return true;
    });
    console.log(address);
    for (const [name, { contents, read, empty, beyond, farthest }] of layers)
        console.log(`    ${name}: ${contents} contents, ${read} read, ${empty} of them empty; ${beyond} beyond the square of the world, at most ${farthest.toFixed(2)} m`);
    return [...layers.values()].reduce((sum, { read }) => sum + read, 0);
}

let read = 0;
for (const tileset of tilesets) read += await check(tileset);
if (options.list) await writeFile(options.list, listed.map((url) => `${url}\n`).join(""));
for (const line of problems.slice(0, 40)) console.error(line);
if (problems.length > 40) console.error(`and ${problems.length - 40} more`);
console.log(`${read} contents read, ${problems.length} problems`);
process.exitCode = problems.length > 0 ? 1 : 0;
