// Hours of a server's life in minutes: arrivals at random, nine of ten for what is kept (by Zipf's law), one for a morph never asked for.
//   node tests/bench/mixed_load.mjs URL [--minutes 30] [--rate 150] [--pid PID]
// Arrivals do not wait for answers, so a server that falls behind is seen to. With --pid the server's resident memory is followed.
// Ends with what README.md tells; exits 1 if anything but 200 and 503 with Retry-After came.
import http from "node:http";
import { readFileSync } from "node:fs";
import { performance } from "node:perf_hooks";
import { parseArgs } from "node:util";

const { values: options, positionals } = parseArgs({
    allowPositionals: true,
    options: { minutes: { type: "string", default: "30" }, rate: { type: "string", default: "150" }, pid: { type: "string" } },
});
const base = new URL(positionals[0] ?? "http://127.0.0.1:8080");
const minutes = Number(options.minutes), rate = Number(options.rate);
if (!(minutes > 0) || !(rate > 0)) throw new Error(`--minutes ${options.minutes} --rate ${options.rate}: both have to be above 0`);

const agent = new http.Agent({ keepAlive: true, maxSockets: 256 });

/** Status, milliseconds and whether a refusal says when to come again. */
function ask(path) {
    return new Promise((resolve) => {
        const begin = performance.now();
        const request = http.get(new URL(path, base), { agent }, (response) => {
            response.on("data", () => {});
            response.on("end", () => resolve({
                status: response.statusCode, ms: performance.now() - begin, retry: "retry-after" in response.headers }));
            response.on("error", () => resolve({ status: 0, ms: performance.now() - begin, retry: false }));
        });
        request.on("error", () => resolve({ status: 0, ms: performance.now() - begin, retry: false }));
    });
}

async function species() {
    const response = await fetch(new URL("/v1/species?family=swept", base));
    return (await response.json()).species.map((one) => one.id);
}

const ids = await species();
const kept = ids.flatMap((id) => Array.from({ length: 16 }, (_, seed) => `/v1/mushrooms/${id}.glb?lod=1&texture_size=256&seed=${seed}`));
for (let i = kept.length - 1; i > 0; --i) {
    const j = Math.floor(Math.random() * (i + 1));
    [kept[i], kept[j]] = [kept[j], kept[i]];
}
// Zipf's law with exponent 1: the k-th is asked for 1/k as often as the first.
const zipf = [];
kept.reduce((sum, _, k) => (zipf[k] = sum + 1 / (k + 1)), 0);
function anyKept() {
    const at = Math.random() * zipf[zipf.length - 1];
    let low = 0, high = zipf.length - 1;
    while (low < high) {
        const middle = (low + high) >> 1;
        if (zipf[middle] < at) low = middle + 1;
        else high = middle;
    }
    return kept[low];
}
let asked = 0;
function newMorph() {
    const a = Math.floor(Math.random() * ids.length), b = (a + 1 + Math.floor(Math.random() * (ids.length - 1))) % ids.length;
    const weight = 1 + Math.floor(Math.random() * 999);
    return `/v1/mushrooms/${ids[a]}:${weight},${ids[b]}:${1000 - weight}.glb?lod=1&texture_size=256&seed=${1000 + asked++}`;
}

const resident = () => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${options.pid}/status`, "utf8"))[1]) / 1024;

const warm = performance.now();
for (const path of kept) await ask(path);
console.log(`${kept.length} files asked for once in ${((performance.now() - warm) / 1000).toFixed(0)} s`);

const taken = { hit: [], morph: [] }, statuses = new Map(), memory = [];
let wrong = 0, open = 0, mostOpen = 0;
function count(kind, answer) {
    --open;
    statuses.set(answer.status, (statuses.get(answer.status) ?? 0) + 1);
    if (answer.status === 200) taken[kind].push(answer.ms);
    else if (answer.status !== 503 || !answer.retry) ++wrong;
}
const begin = performance.now(), end = begin + minutes * 60_000;
const follower = options.pid ? setInterval(() => memory.push([performance.now() - begin, resident()]), 2000) : undefined;
let next = begin;
while (performance.now() < end) {
    // Arrivals that are due by now; the time to the next is exponential.
    while (next <= performance.now()) {
        const kind = Math.random() < 0.9 ? "hit" : "morph";
        mostOpen = Math.max(mostOpen, ++open);
        ask(kind === "hit" ? anyKept() : newMorph()).then((answer) => count(kind, answer));
        next += (-Math.log(1 - Math.random()) / rate) * 1000;
    }
    await new Promise((resolve) => setTimeout(resolve, Math.max(0, Math.min(next, end) - performance.now())));
}
clearInterval(follower);
while (open > 0) await new Promise((resolve) => setTimeout(resolve, 20));

const quantile = (sorted, share) => sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))]?.toFixed(1) ?? "-";
console.log(`${minutes} min at ${rate}/s, at most ${mostOpen} at once; answers: ${[...statuses].map(([s, n]) => `${n} × ${s}`).join(", ")}`);
for (const [kind, all] of Object.entries(taken)) {
    all.sort((x, y) => x - y);
    console.log(`${kind.padEnd(6)} ${all.length}: median ${quantile(all, 0.5)} ms, p99 ${quantile(all, 0.99)}, worst ${quantile(all, 1)}`);
}
if (memory.length > 0) {
    const later = memory.filter(([at]) => at > minutes * 60_000 * 0.2).map(([, mb]) => mb);
    console.log(`resident after a fifth of the time: ${Math.min(...later).toFixed(0)} to ${Math.max(...later).toFixed(0)} MB, at the end ${later.at(-1).toFixed(0)}`);
}
console.log(wrong === 0 ? "no error" : `${wrong} answers that should not be`);
agent.destroy();
process.exit(wrong === 0 ? 0 : 1);
