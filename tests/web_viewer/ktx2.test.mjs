// The tool that rewrites images as KTX2, on files of a running server; three.js opens the results.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { createServer } from "node:http";
import { mkdir, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";
import test, { after, before } from "node:test";
import { readGlb } from "../../web_viewer/clients/ktx2/glb.mjs";
import { bundled, launchBrowser, packages, root, serverUrl } from "./support.mjs";

const server = serverUrl({ everySpecies: true });
const program = path.join(root, "web_viewer/clients/ktx2/ktx2.mjs");
const small = "lod=2&texture_size=512";
const instanced = "instancing=gpu&compress=meshopt";
const files = {
    "levels_and_solids.glb": `mushrooms/amanita_muscaria.glb?${small}&lods=msft&collision=omi`,
    "variants.glb": `mushrooms/boletus_edulis.glb?lod=3&texture_size=512&variants=weather`,
    "trees/instances.glb": `trees/shrub.glb?${small}&${instanced}&image_format=webp_jpg`,
    "colony.glb":
        `colonies/mycena_sanguinolenta.glb?${small}&count=5&instancing=gpu&profile=web` +
        "&materials=rich",
};
let folder;
let browser;
let pages;
let page;

const convert = (...args) =>
    spawnSync(process.execPath, [program, ...args], { encoding: "utf8", timeout: 120_000 });
const fetched = async (route) => {
    const response = await fetch(`${server}/v1/${route}`);
    assert.equal(response.status, 200, await response.clone().text());
    return Buffer.from(await response.arrayBuffer());
};

before(async () => {
    folder = await mkdtemp(path.join(tmpdir(), "sporeprint-ktx2-test-"));
    await mkdir(path.join(folder, "in/trees"), { recursive: true });
    for (const [name, route] of Object.entries(files))
        await writeFile(path.join(folder, "in", name), await fetched(route));
    await writeFile(path.join(folder, "in/set.json"), "{}");
    const script = await bundled(path.join(root, "tests/web_viewer/ktx2_page.mjs"));
    const basis = path.join(root, "web_viewer/node_modules/three/examples/jsm/libs/basis");
    pages = createServer(async ({ url }, response) => {
        if (url === "/page.js") {
            response.setHeader("Content-Type", "text/javascript");
            return response.end(script);
        }
        const from = url.startsWith("/basis/") ? basis : folder;
        if (url !== "/") {
            const file = path.join(from, url.replace(/^\/basis/, ""));
            const body = await readFile(file).catch(() => undefined);
            response.statusCode = body ? 200 : 404;
            return response.end(body);
        }
        response.setHeader("Content-Type", "text/html");
        return response.end('<canvas></canvas><script type="module" src="/page.js"></script>');
    });
    await new Promise((resolve) => pages.listen(0, "127.0.0.1", resolve));
    browser = await launchBrowser();
    page = await browser.newPage();
    await page.goto(`http://127.0.0.1:${pages.address().port}/`);
    await page.waitForFunction(() => window.compare);
});

after(async () => {
    await browser?.close();
    pages?.close();
    if (folder) await rm(folder, { recursive: true });
});

/** Returns what must stay as it is: the JSON without images, and the bytes that are no images. */
function keptOf({ json, binary }) {
    const { images, textures, bufferViews, buffers, accessors, ...rest } = json;
    const ofImages = new Set(images.map(({ bufferView }) => bufferView));
    const bytes = bufferViews.flatMap((view, index) => {
        if (ofImages.has(index)) return [];
        const place = view.extensions?.EXT_meshopt_compression ?? view;
        const start = place.byteOffset ?? 0;
        const { byteOffset: _, extensions: __, ...how } = view;
        return [[how.byteStride, how.byteLength, binary.subarray(start, start + place.byteLength)]];
    });
    for (const list of ["extensionsUsed", "extensionsRequired"])
        rest[list] = (rest[list] ?? []).filter((name) => !/_texture_/.test(name));
    return { rest, accessors: accessors.map(({ bufferView: _, ...one }) => one), bytes };
}

/** glTF-Validator knows neither the extension nor its media type and format. */
const unknown = {
    UNSUPPORTED_EXTENSION: /^\/extensionsUsed/,
    VALUE_NOT_IN_LIST: /^\/images\/\d+\/mimeType$/,
    IMAGE_UNRECOGNIZED_FORMAT: /^\/images\/\d+$/,
};

/** Expects that a file differs from its original in the format of its images alone, and looks like
 *  it by a mean colour difference below `most`. */
async function expectSameButImages(t, [before_, after_], most) {
    const read = (name) => readFile(path.join(folder, name));
    const [old, now] = await Promise.all([before_, after_].map(read));
    assert.deepEqual(keptOf(readGlb(now)), keptOf(readGlb(old)), after_);
    const { json } = readGlb(now);
    assert.ok(json.images.every(({ mimeType }) => mimeType === "image/ktx2"));
    assert.ok(json.extensionsRequired.includes("KHR_texture_basisu"));
    const { issues } = await packages("gltf-validator").validateBytes(new Uint8Array(now));
    const others = issues.messages.filter(
        ({ code, pointer }) => code !== "UNUSED_OBJECT" && !unknown[code]?.test(pointer),
    );
    assert.deepEqual(others, [], after_);
    const shown = await page.evaluate(
        ([first, second]) => window.compare(first, second),
        [`/${before_}`, `/${after_}`],
    );
    t.diagnostic(`${after_}: ${JSON.stringify(shown)}`);
    assert.ok(shown.covered > 0.02 && shown.mean < most, `${after_}: ${shown.mean}`);
    assert.ok(shown.after.count >= 3);
    // Blocks are 4 texels wide, so the last two mipmaps of each image are as large as the third.
    assert.ok(shown.after.bytes <= shown.before / 4 + 64 * shown.after.count, after_);
}

test("a folder looks the same in a quarter of the memory, and keeps everything else", async (t) => {
    const [from, to] = ["in", "out"].map((name) => path.join(folder, name));
    const { status, stderr, stdout } = convert(from, to);
    assert.equal(status, 0, stderr);
    t.diagnostic(stdout.trim());
    assert.equal(await readFile(path.join(to, "set.json"), "utf8"), "{}");
    for (const name of Object.keys(files))
        await expectSameButImages(t, [`in/${name}`, `out/${name}`], 3.5);
});

test("a file in uastc is nearer to the original", async (t) => {
    const name = "levels_and_solids.glb";
    const { status, stderr } = convert(
        path.join(folder, "in", name),
        path.join(folder, name),
        "--mode",
        "uastc",
    );
    assert.equal(status, 0, stderr);
    await expectSameButImages(t, [`in/${name}`, name], 1.5);
});

test("what cannot be converted is named, and the exit code says so", async () => {
    const out = path.join(folder, "refused.glb");
    const refused = async (bytes, words) => {
        const file = path.join(folder, "refused_in.glb");
        await writeFile(file, bytes);
        const { status, stderr } = convert(file, out);
        assert.equal(status, 1, stderr);
        assert.match(stderr, words);
    };
    await refused(Buffer.from("no model"), /is no GLB/);
    await refused(await fetched("leaves/maple.glb?lod=3&textures=none"), /has no images/);
    await refused(await fetched("leaves/maple.glb?lod=3&textures=linked"), /textures=embedded/);
    const whole = await fetched("leaves/maple.glb?lod=3&texture_size=128");
    await refused(whole.subarray(0, whole.length - 100), /cut off/);
    const source = path.join(folder, "leaf.glb");
    const converted = path.join(folder, "leaf_ktx2.glb");
    await writeFile(source, whole);
    assert.equal(convert(source, converted).status, 0);
    await refused(await readFile(converted), /KTX2 images already/);
    for (const [args, words] of [
        [[], /IN and OUT are needed/],
        [[folder, folder], /OUT is IN/],
        [["none.glb", out], /does not exist/],
        [[folder, out, "--mode", "bc7"], /--mode is 'bc7'/],
        [[folder, out, "--quality", "0"], /--quality is '0'/],
        [[folder, out, "--fast"], /--fast/],
    ]) {
        const { status, stderr } = convert(...args);
        assert.equal(status, 2, stderr);
        assert.match(stderr, words);
    }
});
