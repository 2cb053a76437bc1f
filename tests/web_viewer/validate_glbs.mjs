// Runs glTF-Validator over GLBs; zero errors, warnings, infos and hints, or the list of what is wrong.
//
//   node tests/web_viewer/validate_glbs.mjs http://127.0.0.1:8080/v1/mushrooms/boletus_edulis.glb?lod=1 ...
//   node tests/web_viewer/validate_glbs.mjs FOLDER|FILE ...
//     --allow CODE   lets an issue pass (opt-in extensions: UNSUPPORTED_EXTENSION, UNUSED_OBJECT)
import { readFile, readdir, stat } from "node:fs/promises";
import path from "node:path";
import { packages } from "./support.mjs";

const { validateBytes } = packages("gltf-validator");
const severities = ["error", "warning", "info", "hint"];

const allowed = new Set();
const sources = [];
const argv = process.argv.slice(2);
for (let i = 0; i < argv.length; ++i) {
    if (argv[i] === "--allow" && argv[i + 1]) allowed.add(argv[++i]);
    else if (/^https?:/.test(argv[i])) sources.push(argv[i]);
    else if ((await stat(argv[i])).isDirectory()) {
        const names = (await readdir(argv[i])).filter((name) => name.endsWith(".glb")).sort();
        sources.push(...names.map((name) => path.join(argv[i], name)));
    } else sources.push(argv[i]);
}
if (sources.length === 0) {
    console.error("nothing to validate: give URLs, .glb files or a folder of them");
    process.exit(2);
}

async function bytesOf(source) {
    if (!/^https?:/.test(source)) return new Uint8Array(await readFile(source));
    const response = await fetch(source);
    if (!response.ok) throw new Error(`answered ${response.status}: ${(await response.text()).slice(0, 300)}`);
    return new Uint8Array(await response.arrayBuffer());
}

let failed = 0;
for (const source of sources) {
    try {
        const bytes = await bytesOf(source);
        const { issues } = await validateBytes(bytes, {
            uri: source,
            maxIssues: 50,
            writeTimestamp: false,
            externalResourceFunction: (uri) => bytesOf(new URL(uri, source).href),
        });
        const left = issues.messages.filter(({ code }) => !allowed.has(code));
        if (left.length === 0 && !issues.truncated) continue;
        failed += 1;
        console.error(`${source}: ${issues.numErrors}/${issues.numWarnings}/${issues.numInfos}/${issues.numHints}`);
        for (const { severity, code, message, pointer } of left.slice(0, 12)) {
            console.error(`  ${severities[severity]} ${code} ${pointer ?? ""}: ${message}`);
        }
        if (left.length > 12 || issues.truncated) console.error("  and more");
    } catch (error) {
        failed += 1;
        console.error(`${source}: ${error instanceof Error ? error.message : error}`);
    }
}
console.log(`${sources.length - failed} of ${sources.length} GLBs at 0/0/0/0`);
process.exitCode = failed ? 1 : 0;
