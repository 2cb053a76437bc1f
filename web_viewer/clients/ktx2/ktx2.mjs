#!/usr/bin/env node
// Rewrites the images of GLB files as KTX2 (KHR_texture_basisu): less memory on the graphics card.
import { cp, mkdir, readFile, readdir, stat, writeFile } from "node:fs/promises";
import os from "node:os";
import path from "node:path";
import { parseArgs } from "node:util";
import { Encoder } from "./encode.mjs";
import { imagesOf, readGlb, Unusable, withImages } from "./glb.mjs";

const usage = `node ktx2.mjs IN OUT [options]
IN and OUT are GLB files, or folders: every GLB below IN is rewritten, other files are copied.
  --mode etc1s|uastc    colours and roughness: small files, or nearer to the original (etc1s)
  --normal etc1s|uastc  normal maps (uastc)
  --quality 1..255      of etc1s (128)
  --jobs N              encoders at a time (one for each processor)
Exit codes: 0 all files are written, 1 some are not, 2 wrong arguments.
`;
const modes = ["etc1s", "uastc"];

function fail(message) {
    process.stderr.write(`${message}\n\n${usage}`);
    process.exit(2);
}

function readArguments() {
    const options = {
        mode: { type: "string", default: "etc1s" },
        normal: { type: "string", default: "uastc" },
        quality: { type: "string", default: "128" },
        jobs: { type: "string", default: String(os.cpus().length || 1) },
        help: { type: "boolean", default: false },
    };
    let read;
    try {
        read = parseArgs({ options, allowPositionals: true });
    } catch (error) {
        fail(error.message);
    }
    const { values, positionals } = read;
    if (values.help) {
        process.stdout.write(usage);
        process.exit(0);
    }
    if (positionals.length !== 2) fail("IN and OUT are needed");
    for (const name of ["mode", "normal"])
        if (!modes.includes(values[name]))
            fail(`--${name} is '${values[name]}', not etc1s or uastc`);
    const whole = (name, most) => {
        const number = Number(values[name]);
        if (!Number.isInteger(number) || number < 1 || number > most)
            fail(`--${name} is '${values[name]}', not a whole number from 1 to ${most}`);
        return number;
    };
    const [from, to] = positionals.map((one) => path.resolve(one));
    if (from === to) fail("OUT is IN; give another name");
    return { ...values, from, to, quality: whole("quality", 255), jobs: whole("jobs", 256) };
}

/** Returns a function that runs at most `most` tasks at a time. */
function limited(most) {
    let running = 0;
    const waiting = [];
    return async (task) => {
        while (running >= most) await new Promise((resolve) => waiting.push(resolve));
        running += 1;
        try {
            return await task();
        } finally {
            running -= 1;
            waiting.shift()?.();
        }
    };
}

/** Returns the paths of the files below a folder, relative to it. */
async function filesBelow(folder, below = "") {
    const entries = await readdir(path.join(folder, below), { withFileTypes: true });
    const lists = await Promise.all(
        entries.map((entry) => {
            const name = path.join(below, entry.name);
            return entry.isDirectory() ? filesBelow(folder, name) : [name];
        }),
    );
    return lists.flat().sort();
}

const thousands = (bytes) => `${Math.ceil(bytes / 1000)} kB`;

async function convert(from, to, encoder, inTurn, { mode, normal, quality }) {
    const bytes = await readFile(from);
    const glb = readGlb(bytes);
    const images = imagesOf(glb);
    const encoded = await Promise.all(
        images.map((image) =>
            inTurn(() => encoder.encode(image, image.role === "normal" ? normal : mode, quality)),
        ),
    );
    const out = withImages(
        glb,
        images.map((image, index) => ({ ...image, ktx2: encoded[index].ktx2 })),
    );
    await mkdir(path.dirname(to), { recursive: true });
    await writeFile(to, out);
    const sum = (name) => encoded.reduce((total, one) => total + one[name], 0);
    process.stdout.write(
        `${path.basename(from)}: ${images.length} images, file ${thousands(bytes.length)} -> ` +
            `${thousands(out.length)}, graphics card ${thousands(sum("before"))} -> ` +
            `at most ${thousands(sum("after"))}\n`,
    );
}

async function main() {
    const options = readArguments();
    const { from, to, jobs } = options;
    const found = await stat(from).catch(() => fail(`${from} does not exist`));
    const names = found.isDirectory() ? await filesBelow(from) : [""];
    const isGlb = (name) => !found.isDirectory() || name.toLowerCase().endsWith(".glb");
    if (!names.some(isGlb)) fail(`${from} has no GLB files`);
    const encoder = await Encoder.create();
    const [oneEncoder, oneFile] = [limited(jobs), limited(2 * jobs)];
    let failed = 0;
    try {
        await Promise.all(
            names.map((name) =>
                oneFile(async () => {
                    const [source, target] = [path.join(from, name), path.join(to, name)];
                    try {
                        if (isGlb(name))
                            await convert(source, target, encoder, oneEncoder, options);
                        else await cp(source, target);
                    } catch (error) {
                        failed += 1;
                        const what = error instanceof Unusable ? "" : "not written: ";
                        process.stderr.write(`${source} ${what}${error.message}\n`);
                    }
                }),
            ),
        );
    } finally {
        await encoder.close();
    }
    process.exitCode = failed > 0 ? 1 : 0;
}

main().catch((error) => {
    process.stderr.write(`${error.message}\n`);
    process.exitCode = 1;
});
