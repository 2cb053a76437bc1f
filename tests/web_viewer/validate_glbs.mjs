// Runs glTF-Validator over GLBs; lists every error, warning, info and hint.
//
//   node tests/web_viewer/validate_glbs.mjs URL ...     e.g. http://127.0.0.1:8080/v1/trees/birch.glb
//   node tests/web_viewer/validate_glbs.mjs FOLDER|FILE ...
//     -              takes more of them from standard input, one a line
//     --allow CODE   lets an issue pass (opt-in extensions: UNSUPPORTED_EXTENSION, UNUSED_OBJECT)
//     --workers N    threads (1 to 8; as many as processors)
import { readFile, readdir, stat } from "node:fs/promises";
import { availableParallelism } from "node:os";
import path from "node:path";
import { text } from "node:stream/consumers";
import { Worker, isMainThread, parentPort, workerData } from "node:worker_threads";
import { fileURLToPath } from "node:url";
import { packages } from "./support.mjs";

const severities = ["error", "warning", "info", "hint"];

async function bytesOf(source) {
    if (!/^https?:/.test(source)) return new Uint8Array(await readFile(source));
    const response = await fetch(source);
    if (!response.ok)
        throw new Error(
            `responded with ${response.status}: ${(await response.text()).slice(0, 300)}`,
        );
    return new Uint8Array(await response.arrayBuffer());
}

/** Returns the issues of a GLB as lines; none if it is valid. */
async function issuesOf(source, allowed) {
    try {
        const { issues } = await packages("gltf-validator").validateBytes(await bytesOf(source), {
            uri: source,
            maxIssues: 1000,
            writeTimestamp: false,
            externalResourceFunction: (uri) => bytesOf(new URL(uri, source).href),
        });
        const left = issues.messages.filter(({ code }) => !allowed.includes(code));
        if (left.length === 0 && !issues.truncated) return [];
        return [
            `${source}: ${issues.numErrors}/${issues.numWarnings}/${issues.numInfos}/${issues.numHints}`,
            ...left
                .slice(0, 12)
                .map(
                    ({ severity, code, message, pointer }) =>
                        `  ${severities[severity]} ${code} ${pointer ?? ""}: ${message}`,
                ),
            ...(left.length > 12 || issues.truncated ? ["  and more"] : []),
        ];
    } catch (error) {
        return [`${source}: ${error instanceof Error ? error.message : error}`];
    }
}

async function main() {
    const allowed = [];
    const sources = [];
    let workers = Math.min(8, availableParallelism());
    const argv = process.argv.slice(2);
    for (let i = 0; i < argv.length; ++i) {
        if (argv[i] === "--allow" && argv[i + 1]) allowed.push(argv[++i]);
        else if (argv[i] === "--workers" && argv[i + 1])
            workers = Math.max(1, Math.min(8, Number(argv[++i]) || 1));
        else if (argv[i] === "-")
            sources.push(...(await text(process.stdin)).split("\n").filter(Boolean));
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

    // Each thread takes the next file when it is done: some take a hundred times as long as others.
    let next = 0;
    let failed = 0;
    let done = 0;
    await Promise.all(
        Array.from(
            { length: Math.min(workers, sources.length) },
            () =>
                new Promise((resolve, reject) => {
                    const worker = new Worker(fileURLToPath(import.meta.url), {
                        workerData: { allowed },
                    });
                    const give = () =>
                        next < sources.length
                            ? worker.postMessage(sources[next++])
                            : worker.terminate().then(resolve);
                    worker.on("message", (issues) => {
                        if (issues.length > 0) failed += 1;
                        for (const line of issues) console.error(line);
                        done += 1;
                        if (done % 50 === 0) console.error(`[${done}/${sources.length}]`);
                        give();
                    });
                    worker.on("error", reject);
                    give();
                }),
        ),
    );
    console.log(`${sources.length - failed} of ${sources.length} GLBs at 0/0/0/0`);
    process.exitCode = failed ? 1 : 0;
}

if (isMainThread) await main();
else
    parentPort.on("message", async (source) =>
        parentPort.postMessage(await issuesOf(source, workerData.allowed)),
    );
