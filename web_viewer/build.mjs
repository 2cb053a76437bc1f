// Bundles the pages into dist/: index.html, docs.html, editor.html, breed.html, world.html, hashed scripts and styles, favicon.svg.
// The server serves index.html at / and every other file at /assets/<name>. All links are relative,
// so that the page can be served below a path prefix.
import { readFile, rm, mkdir, writeFile, copyFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import path from "node:path";
import { build } from "esbuild";

const here = path.dirname(fileURLToPath(import.meta.url));
const source = path.join(here, "src");
const dist = path.join(here, "dist");

await rm(dist, { recursive: true, force: true });
await mkdir(dist, { recursive: true });

const result = await build({
    absWorkingDir: here,
    entryPoints: { app: "src/main.ts", docs: "src/docs.ts", editor: "src/designer/main.ts", breed: "src/breed/main.ts", world: "src/world/main.ts" },
    outdir: "dist",
    entryNames: "[name]-[hash]",
    assetNames: "[name]-[hash]",
    bundle: true,
    minify: true,
    format: "esm",
    target: ["es2022"],
    legalComments: "eof",
    metafile: true,
    logLevel: "warning",
});

const names = {};
for (const output of Object.keys(result.metafile.outputs)) {
    const file = path.basename(output);
    names[file.replace(/-[A-Z0-9]{8}(?=\.)/, "")] = file;
}

for (const page of ["index.html", "docs.html", "editor.html", "breed.html", "world.html"]) {
    const text = await readFile(path.join(source, page), "utf8");
    const linked = text.replace(/\{\{([a-z.]+)\}\}/g, (_, name) => {
        if (!names[name])
            throw new Error(`${page} asks for ${name}, which the bundle does not have`);
        return `assets/${names[name]}`;
    });
    await writeFile(path.join(dist, page), linked);
}
await copyFile(path.join(source, "favicon.svg"), path.join(dist, "favicon.svg"));

for (const [output, { bytes }] of Object.entries(result.metafile.outputs)) {
    console.log(`${output}  ${(bytes / 1000).toFixed(1)} kB`);
}
