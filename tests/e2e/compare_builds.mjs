// Compares the responses of two builds to the same random requests over all routes, byte for byte.
//   node tests/e2e/compare_builds.mjs URL_OF_ONE URL_OF_OTHER [--requests 2000] [--seed 1]
// Both servers have just been started (their caches are alike), with the same atlas and the same page. Headers that differ from request to request (Date, Server-Timing) are ignored, and of
// /openapi.json the order of names, and what depends on counters. Exits with 1 when a response differs.
import { parseArgs } from "node:util";
import { Generator, listsOf, random } from "./openapi/generator.mjs";
import { documentOf, operationsOf } from "./openapi/shared.mjs";

const { values: options, positionals } = parseArgs({
    allowPositionals: true,
    options: { requests: { type: "string", default: "2000" }, seed: { type: "string", default: "1" } },
});
const urls = positionals.map((one) => one.replace(/\/+$/, ""));
if (urls.length !== 2) throw new Error("two URLs are expected");
const count = Number(options.requests);
const ignored = new Set(["date", "server-timing", "keep-alive", "connection"]);

/** The same JSON value with the names of all objects sorted. */
const sorted = (value) => Array.isArray(value) ? value.map(sorted)
    : value && typeof value === "object" ? Object.fromEntries(Object.entries(value).sort().map(([key, one]) => [key, sorted(one)])) : value;

async function responseOf(url, { method, target, headers, body }, id) {
    const response = await fetch(url + target, { method, headers: { ...headers, "X-Request-Id": id }, body });
    const bytes = Buffer.from(await response.arrayBuffer());
    const isDocument = target.startsWith("/openapi.json");
    const isMetrics = target.startsWith("/metrics"); // counters differ
    const isTooLong = response.status === 414; // the head is refused before its request id is read
    const shown = [...response.headers].filter(([name]) => !ignored.has(name) && !(isDocument && ["etag", "content-length"].includes(name)) && !(isMetrics && name === "content-length") && !(isTooLong && name === "x-request-id"));
    return {
        status: response.status,
        headers: shown.map(([name, value]) => `${name}: ${value}`).join("\n"),
        body: isMetrics || isTooLong ? "" : isDocument && response.status === 200 && bytes.length ? JSON.stringify(sorted(JSON.parse(bytes))) : bytes.toString("latin1"),
    };
}

const document = await documentOf(urls[0]);
const [lists] = await Promise.all(urls.map((url) => listsOf(url, document))); // of both, so that both have cached the same
const generator = new Generator(document, lists, random(Number(options.seed)));
const operations = operationsOf(document);
const statuses = {};
let different = 0;
for (let i = 0; i < count; ++i) {
    const request = generator.request(operations[i % operations.length]);
    const [one, other] = await Promise.all(urls.map((url) => responseOf(url, request, `compare-${i}`)));
    statuses[one.status] = (statuses[one.status] ?? 0) + 1;
    for (const part of ["status", "headers", "body"]) {
        if (one[part] === other[part]) continue;
        ++different;
        console.log(`${request.method} ${request.target} ${request.body instanceof Uint8Array ? "" : (request.body ?? "")}: the ${part} differs`);
        console.log(`  ${String(one[part]).slice(0, 600)}\n  ${String(other[part]).slice(0, 600)}`);
        break;
    }
}
console.log(`${count} requests, statuses ${JSON.stringify(statuses)}, ${different} different`);
process.exit(different ? 1 : 0);
