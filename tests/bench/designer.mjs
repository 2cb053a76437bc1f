// What a person at the designer waits for: a point of the outline is dragged step by step in headless Chromium, and
// drafts are saved in the browser and, with a token, in the library.
//   node tests/bench/designer.mjs URL [--steps 60] [--token spk_...] [--size 1400x860]
// WebGL is drawn by the processor, as in all tests. Prints medians and 95th percentiles beside their budgets; they are
// for reading, and nothing fails.
import { performance } from "node:perf_hooks";
import { parseArgs } from "node:util";
import { launchBrowser } from "../web_viewer/support.mjs";

const { values: options, positionals } = parseArgs({
    allowPositionals: true,
    options: {
        steps: { type: "string", default: "60" },
        token: { type: "string" },
        size: { type: "string", default: "1400x860" },
    },
});
const base = (positionals[0] ?? "http://127.0.0.1:8080").replace(/\/+$/, "");
const steps = Number(options.steps);
if (!Number.isInteger(steps) || steps < 1) throw new Error(`--steps ${options.steps}: allowed are whole numbers from 1`);
const [width, height] = options.size.split("x").map(Number);
if (!(width > 0) || !(height > 0)) throw new Error(`--size ${options.size}: allowed is WIDTHxHEIGHT`);

/** Returns the value below which this share of a list is. */
function quantile(values, share) {
    const sorted = [...values].sort((a, b) => a - b);
    return sorted[Math.min(Math.floor(share * sorted.length), sorted.length - 1)] ?? NaN;
}

function print(name, values, budget) {
    const [middle, high] = [0.5, 0.95].map((share) => quantile(values, share).toFixed(1));
    console.log(`${name.padEnd(48)} ${middle.padStart(7)} / ${high.padStart(6)} ms   budget ${budget}   n ${values.length}`);
}

/** Runs in the page before its scripts: notes when the pointer moves, when a model has arrived, and when the stage was
 *  drawn after it. */
function watch() {
    const seen = { moved: 0, laidOut: [], arrived: [], submitted: [], drawn: [], saved: [] };
    window.designerBench = seen;
    const now = () => performance.now();
    let waiting = false;
    const after = new MessageChannel();
    addEventListener(
        "pointermove",
        () => {
            seen.moved = now();
            seen.done = false;
            after.port2.postMessage("");
        },
        true,
    );
    // The next task: the page has moved its point. The layout of the outline is what the next frame waits for.
    after.port1.onmessage = () => {
        document.querySelector("#sketch .edited")?.getBoundingClientRect();
        seen.laidOut.push(now() - seen.moved);
    };
    const { fetch: plain } = window;
    window.fetch = async (address, init) => {
        const response = await plain(address, init);
        if (!String(address).includes("mushrooms.glb")) return response;
        const bytes = await response.arrayBuffer();
        seen.arrived.push(now() - seen.moved);
        waiting = true;
        const copy = new Response(bytes, response);
        Object.defineProperty(copy, "url", { value: response.url });
        return copy;
    };
    const { drawElements } = WebGL2RenderingContext.prototype;
    WebGL2RenderingContext.prototype.drawElements = function (...values) {
        drawElements.apply(this, values);
        if (!waiting || this.canvas.id !== "canvas") return;
        waiting = false;
        seen.submitted.push(now() - seen.moved);
        setTimeout(() => {
            // Reading a pixel waits for the frame.
            this.readPixels(0, 0, 1, 1, this.RGBA, this.UNSIGNED_BYTE, new Uint8Array(4));
            seen.drawn.push(now() - seen.moved);
            seen.done = true;
        });
    };
    const { put } = IDBObjectStore.prototype;
    IDBObjectStore.prototype.put = function (...values) {
        const begin = now();
        this.transaction.addEventListener("complete", () => seen.saved.push(now() - begin));
        return put.apply(this, values);
    };
}

async function drags(browser) {
    const page = await browser.newPage({ viewport: { width, height }, reducedMotion: "reduce" });
    page.setDefaultTimeout(60_000);
    await page.addInitScript(watch);
    await page.goto(`${base}/editor`);
    await page.locator("#start-species").click();
    await page.locator('#species-list button[data-species="boletus_edulis"]').click();
    await page.locator('#stages[data-pictures="complete"]').waitFor();
    const knob = page.locator('.handle[role=button][aria-label^="cap, point 3 "] .knob');
    const box = await knob.boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 2, y);
    await page.waitForTimeout(2000);
    await page.evaluate(() => {
        for (const list of ["laidOut", "arrived", "submitted", "drawn", "saved"]) window.designerBench[list] = [];
    });
    for (let step = 0; step < steps; ++step) {
        await page.mouse.move(x + 3 + (step % 12), y - (step % 5));
        await page.waitForFunction(() => window.designerBench.done, undefined, { timeout: 5000 }).catch(() => undefined);
        await page.waitForTimeout(30);
    }
    await page.mouse.up();
    for (let step = 0; step < 20; ++step) {
        await page.keyboard.press("ArrowRight");
        await page.waitForTimeout(450);
    }
    const seen = await page.evaluate(() => window.designerBench);
    print("pointer moved: outline drawn and laid out", seen.laidOut, "8 / 16");
    print("pointer moved: model has arrived", seen.arrived.slice(0, steps), "");
    print("pointer moved: model given to WebGL", seen.submitted.slice(0, steps), "");
    print("pointer moved: model drawn", seen.drawn.slice(0, steps), "25 / 50");
    print("draft saved in the browser", seen.saved, "4 / 15");
    await page.close();
}

async function writes(token) {
    const headers = { Authorization: `Bearer ${token}`, "Content-Type": "application/json" };
    const species = await (await fetch(`${base}/v1/species/boletus_edulis`)).json();
    species.id = `bench_${Date.now().toString(36)}`;
    const sent = async (path, method, more = {}) => {
        const begin = performance.now();
        const body = method === "DELETE" ? undefined : JSON.stringify(species);
        const response = await fetch(`${base}${path}`, { method, headers: { ...headers, ...more }, body });
        const text = await response.text();
        if (!response.ok) throw new Error(`${method} ${path}: ${response.status} ${text}`);
        return { ms: performance.now() - begin, etag: response.headers.get("etag"), text };
    };
    let { etag, text } = await sent("/v1/library", "POST");
    const { id } = JSON.parse(text);
    const times = [];
    for (let step = 0; step < steps; ++step) {
        species.stages[0].model.silhouette.cap[1].r += 1e-6;
        const stored = await sent(`/v1/library/${id}`, "PUT", { "If-Match": etag });
        ({ etag } = stored);
        times.push(stored.ms);
    }
    await sent(`/v1/library/${id}?purge=true`, "DELETE", { "If-Match": "*" });
    print("draft saved in the library", times, "4 / 15");
}

const browser = await launchBrowser();
try {
    await drags(browser);
} finally {
    await browser.close();
}
if (options.token) await writes(options.token);
