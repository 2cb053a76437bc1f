// A flight through a world as the page streams it, and a month day by day, in headless Chromium.
//   node tests/bench/flight.mjs URL [--world beech,seed=7,extent=1024] [--metres 200] [--speed 5] [--step 0.1]
//                               [--low 1.7] [--high 10] [--days 240-270] [--picture FILE.png]
//                               [--part flight|month]
// The flight: the camera stands until the first view is sharp, then flies to the east through the centre of the world,
// from --low up to --high metres above the ground and down again, in steps of --step seconds. The month: in a browser
// without a cache the camera stands, and days follow one another, each when all of the one before has come. Prints
// requests, bytes over the wire and times of requests by layer; "shared" are geometry and images that tiles name by
// addresses of their own. Nothing is drawn (but for --picture), so that the figures are those of the network, the
// server and the reading of files. Exits with 1 if a request failed or the console has an error.
import { writeFile } from "node:fs/promises";
import path from "node:path";
import { parseArgs } from "node:util";
import { bundled, launchBrowser, patience, root } from "../web_viewer/support.mjs";

const { values: options, positionals } = parseArgs({
    allowPositionals: true,
    options: {
        world: { type: "string", default: "beech,seed=7,extent=1024" },
        year: { type: "string", default: "80" },
        metres: { type: "string", default: "200" },
        speed: { type: "string", default: "5" },
        step: { type: "string", default: "0.1" },
        low: { type: "string", default: "1.7" },
        high: { type: "string", default: "10" },
        days: { type: "string", default: "240-270" },
        picture: { type: "string" },
        part: { type: "string", default: "flight+month" },
    },
});
const base = (positionals[0] ?? "http://127.0.0.1:8080").replace(/\/+$/, "");
const [metres, speed, step, low, high, year] = ["metres", "speed", "step", "low", "high", "year"].map((name) => {
    const value = Number(options[name]);
    if (!(value > 0)) throw new Error(`--${name} ${options[name]}: it has to be above 0`);
    return value;
});
const [firstDay, lastDay] = options.days.split("-").map(Number);
if (!(firstDay >= 1 && lastDay > firstDay && lastDay <= 365)) throw new Error(`--days ${options.days}: two days of a year are needed, as in 240-270`);
const start = [-metres / 2, 0];

const kinds = ["ground", "trees", "floor", "fungi", "shared", "tree of tiles", "other"];

/** Returns what a request is for. */
function kindOf(url) {
    const parts = new URL(url).pathname.split("/");
    if (parts[2] !== "worlds") return /\.(bin|jpg|jpeg|webp|png)$/.test(parts.at(-1)) ? "shared" : "other";
    if (/\.subtree$|^tileset\.json$/.test(parts.at(-1))) return "tree of tiles";
    return kinds.includes(parts[6]) ? parts[6] : "other";
}

/** Follows the requests of a page: each has the kind, the bytes over the wire, and its times in milliseconds. */
async function follow(page) {
    const session = await page.context().newCDPSession(page);
    const open = new Map();
    const log = { requests: [], failed: [], console: [], repeated: 0, cached: 0 };
    page.on("console", (message) => {
        const isIcon = message.location().url.endsWith("/favicon.ico");
        if (["error", "warning"].includes(message.type()) && !isIcon) log.console.push(message.text());
    });
    page.on("pageerror", (error) => log.console.push(error.message));
    session.on("Network.requestWillBeSent", ({ requestId, request, timestamp }) => open.set(requestId, { url: request.url, begin: timestamp }));
    session.on("Network.requestServedFromCache", ({ requestId }) => {
        const one = open.get(requestId);
        if (one) one.isCached = true;
    });
    session.on("Network.responseReceived", ({ requestId, response }) => {
        const one = open.get(requestId);
        if (!one) return;
        Object.assign(one, { status: response.status, timing: response.timing });
        one.isCached ||= response.fromDiskCache;
    });
    session.on("Network.loadingFailed", ({ requestId, errorText, canceled }) => {
        const one = open.get(requestId);
        open.delete(requestId);
        // Tiles that are out of the view again before they have come are no failures.
        if (one && !canceled) log.failed.push(`${one.url}: ${errorText}`);
    });
    session.on("Network.loadingFinished", ({ requestId, encodedDataLength, timestamp }) => {
        const one = open.get(requestId);
        open.delete(requestId);
        // Chromium asks for the icon of every page.
        if (!one || !/^https?:/.test(one.url) || one.url.endsWith("/favicon.ico")) return;
        if (one.isCached) return void ++log.cached;
        // A busy server is asked again.
        if (one.status === 429 || one.status === 503) return void ++log.repeated;
        if (one.status >= 400) return void log.failed.push(`${one.url}: ${one.status}`);
        const sent = one.timing ? one.timing.requestTime + one.timing.sendStart / 1000 : one.begin;
        log.requests.push({
            url: one.url,
            kind: kindOf(one.url),
            bytes: encodedDataLength,
            waited: (timestamp - one.begin) * 1000,
            taken: (timestamp - sent) * 1000,
        });
    });
    await session.send("Network.enable");
    return log;
}

/** Opens a page at the address of the server, with a cache of its own that is empty. */
async function opened(browser, script) {
    // The page of the tool stands in the place of one of the server's, whose policy would refuse it.
    const context = await browser.newContext({ bypassCSP: true });
    const page = await context.newPage();
    page.setDefaultTimeout(patience);
    const log = await follow(page);
    // 3d-tiles-renderer takes what has come in frames, and Chromium has none while nothing is drawn on a busy machine.
    await page.addInitScript(() => (window.requestAnimationFrame = (act) => setTimeout(() => act(performance.now()), 1000 / 60)));
    await page.goto(`${base}/livez`);
    await page.addScriptTag({ content: script, type: "module" });
    await page.waitForFunction(() => window.flight);
    await page.evaluate(
        ([world, from, above, of]) => window.flight.begin(world, Number(/extent=(\d+)/.exec(world)?.[1] ?? 1024), from, above, of, 1),
        [options.world, start, low, year],
    );
    log.requests.length = 0;
    return { page, log, close: () => context.close() };
}

const megabytes = (bytes) => `${(bytes / 1e6).toFixed(2)} MB`;

function quantile(values, share) {
    const sorted = [...values].sort((x, y) => x - y);
    return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] ?? NaN;
}

const sum = (requests) => requests.reduce((all, { bytes }) => all + bytes, 0);

function printTable(requests) {
    const row = (name, some) =>
        console.log(
            [
                name.padEnd(14),
                String(some.length).padStart(8),
                megabytes(sum(some)).padStart(11),
                (some.length ? `${(sum(some) / some.length / 1000).toFixed(1)} kB` : "-").padStart(10),
                ...["taken", "waited"].flatMap((what) =>
                    [0.5, 0.99].map((share) => (some.length ? quantile(some.map((one) => one[what]), share).toFixed(0) : "-").padStart(7)),
                ),
            ].join(""),
        );
    console.log("              requests      bytes      each     p50    p99    p50    p99  ms: on the wire; with waiting in the browser");
    for (const kind of kinds) {
        const some = requests.filter((one) => one.kind === kind);
        if (some.length > 0) row(kind, some);
    }
    row("all", requests);
}

/** Prints what is expected to be empty; returns whether it is. */
function printFailures(log, { failures }) {
    console.log(`${log.failed.length} failed requests, ${log.console.length} lines on the console, ${failures.length} failures of tiles, ${log.repeated} repeated by a busy server, ${log.cached} from the browser's cache`);
    for (const line of [...log.failed, ...log.console, ...failures].slice(0, 10)) console.log(`    ${line}`);
    return log.failed.length + log.console.length + failures.length === 0;
}

async function flight(browser, script) {
    const { page, log, close } = await opened(browser, script);
    const sharp = await page.evaluate((day) => window.flight.show(day), lastDay);
    console.log(`\nfirst view of ${options.world} on day ${lastDay} of year ${year}: sharp after ${sharp.toFixed(1)} s, ${megabytes(sum(log.requests))} in ${log.requests.length} requests`);
    printTable(log.requests);
    const before = log.requests.length;
    const found = await page.evaluate((args) => window.flight.fly(...args), [start, metres, speed, low, high, step]);
    const later = log.requests.slice(before);
    console.log(`\nflight of ${metres} m at ${speed} m/s in ${found.steps} steps of ${step} s: ${found.seconds.toFixed(1)} s, steps at most ${(found.late / 1000).toFixed(1)} s late`);
    console.log(`sharp in ${((100 * found.sharp) / found.steps).toFixed(0)} % of the steps, longest without ${found.longest.toFixed(1)} s, sharp ${found.settled.toFixed(1)} s after the last`);
    printTable(later);
    const shared = log.requests.filter(({ kind }) => kind === "shared");
    console.log(`\nshared geometry and images from the first view to the end: ${megabytes(sum(shared))} (goal: at most 30 MB)`);
    for (const [what, pattern] of [["geometry of trees", /\/trees\/.*\.bin/], ["geometry of mushrooms", /\/mushrooms\/.*\.bin/], ["images", /\.(jpg|jpeg|webp|png)/]]) {
        const some = shared.filter(({ url }) => pattern.test(url));
        const largest = some.reduce((most, one) => (one.bytes > most.bytes ? one : most), { bytes: 0, url: "" });
        console.log(`    ${what}: ${some.length}, ${megabytes(sum(some))}, largest ${(largest.bytes / 1000).toFixed(0)} kB ${largest.url.replace(base, "")}`);
    }
    const report = await page.evaluate(() => window.flight.report());
    console.log(`tiles in view at the end: ${JSON.stringify(report.visible)}; memory of tiles at most ${megabytes(found.memory)}${report.memory.isFull ? ", and there is no more" : ""}`);
    const isGood = printFailures(log, report);
    if (options.picture) {
        const { url, calls, triangles } = await page.evaluate(() => window.flight.picture());
        await writeFile(options.picture, Buffer.from(url.split(",")[1], "base64"));
        console.log(`last view drawn to ${options.picture}: ${calls} draw calls, ${triangles} triangles`);
    }
    await close();
    return isGood;
}

async function month(browser, script) {
    const { page, log, close } = await opened(browser, script);
    const days = [];
    for (let day = firstDay; day <= lastDay; ++day) {
        const before = log.requests.length;
        const seconds = await page.evaluate((of) => window.flight.show(of), day);
        const some = log.requests.slice(before);
        days.push({ day, seconds, bytes: sum(some), some });
    }
    const [first, ...later] = days;
    const share = (bytes) => `${((100 * bytes) / first.bytes).toFixed(1)} %`;
    console.log(`\nday ${firstDay}: ${megabytes(first.bytes)} in ${first.some.length} requests, sharp after ${first.seconds.toFixed(1)} s`);
    printTable(first.some);
    for (const { day, seconds, bytes, some } of later) {
        const parts = kinds.map((kind) => [kind, sum(some.filter((one) => one.kind === kind))]).filter(([, size]) => size > 0);
        console.log(`day ${day}: ${megabytes(bytes)} (${share(bytes)}) in ${some.length} requests, ${seconds.toFixed(1)} s: ${parts.map(([kind, size]) => `${kind} ${(size / 1000).toFixed(0)} kB`).join(", ")}`);
    }
    const bytes = later.map((one) => one.bytes);
    const mean = bytes.reduce((all, one) => all + one, 0) / bytes.length;
    console.log(`later days: mean ${megabytes(mean)} (${share(mean)}; goal: at most 15 %), median ${megabytes(quantile(bytes, 0.5))} (${share(quantile(bytes, 0.5))}), most ${megabytes(Math.max(...bytes))} (${share(Math.max(...bytes))}); all of them together ${megabytes(mean * bytes.length)}`);
    printTable(later.flatMap(({ some }) => some));
    const isGood = printFailures(log, await page.evaluate(() => window.flight.report()));
    await close();
    return isGood;
}

const script = await bundled(path.join(root, "tests/bench/flight_page.mjs"));
const browser = await launchBrowser();
try {
    for (const [name, part] of [["flight", flight], ["month", month]])
        if (options.part.includes(name) && !(await part(browser, script))) process.exitCode = 1;
} finally {
    await browser.close();
}
