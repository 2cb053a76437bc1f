// Tests of the morph editor in headless Chromium against a running server (SPOREPRINT_URL).
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import path from "node:path";
import test, { after, before } from "node:test";
import {
    galleryComplete,
    launchBrowser,
    logEvents,
    packages,
    parameters,
    ready,
    screenshotFolder,
    serverUrl,
} from "./support.mjs";

const base = serverUrl();
const [a, b, c, d, e] = [
    "amanita_muscaria",
    "boletus_edulis",
    "coprinus_comatus",
    "russula_vinosa",
    "cantharellus_cibarius",
];
let browser;
let shared;
let folder;
let species;

before(async () => {
    folder = await screenshotFolder();
    browser = await launchBrowser();
    shared = await browser.newContext({
        viewport: { width: 1000, height: 700 },
        reducedMotion: "reduce",
    });
    species = (await (await fetch(`${base}/v1/species`)).json()).species;
});

after(() => browser?.close());

/** Opens a page; `log` has its console messages and requests. */
async function open(t, query, viewport = undefined) {
    const page = await shared.newPage();
    t.after(() => page.close());
    if (viewport) await page.setViewportSize(viewport);
    const log = logEvents(page);
    await page.goto(`${base}/${query}`);
    await ready(page);
    return { page, log };
}

function expectNoProblems(log) {
    assert.deepEqual(log.console, []);
    assert.deepEqual(log.failed, []);
}

const shares = async (page) =>
    Object.fromEntries(
        (await parameters(page))
            .get("morph")
            .split(",")
            .map((part) => {
                const [id, weight] = part.split(":");
                return [id, Number(weight)];
            }),
    );
const models = (log) =>
    log.requests
        .filter((url) => /\/v1\/(mushrooms|morphs)\/[^?]+\.glb/.test(url))
        .map((url) => decodeURIComponent(url));
const arcs = (page) =>
    page
        .locator(".drawing .own > g")
        .evaluateAll((groups) => groups.map((group) => group.getAttribute("class").split(" ")[1]));

async function centre(locator) {
    const box = await locator.boundingBox();
    return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

/** Drags in steps; `during` is called before the button is released. */
async function drag(page, from, to, during = async () => undefined) {
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    for (let step = 1; step <= 10; ++step) {
        await page.mouse.move(
            from.x + ((to.x - from.x) * step) / 10,
            from.y + ((to.y - from.y) * step) / 10,
        );
        await page.waitForTimeout(60);
    }
    await during();
    await page.mouse.up();
}

test("the morph editor opens with two species, accepts up to five, and can be left", async (t) => {
    const { page, log } = await open(t, `?species=${a}&seed=3`, { width: 1280, height: 800 });
    await galleryComplete(page);
    await page.locator("#mode-morph").click();
    await ready(page);
    assert.equal(await page.locator("#mode-morph").getAttribute("aria-current"), "page");
    assert.equal(Object.keys(await shares(page)).length, 2);
    assert.ok(await page.locator("#morph-t").isVisible());
    const [joined] = Object.keys(await shares(page)).filter((id) => id !== a);
    const chosen = [b, c, d, e].find((id) => id !== joined);
    // What has joined by itself is said where everybody sees it, and gives way to what is chosen.
    const notice = page.locator("#notice");
    assert.match(await notice.textContent(), /is the other half for now/);
    assert.ok(await notice.isVisible());
    await page.screenshot({ path: path.join(folder, "notice.png") });
    await page.locator(`#gallery button[data-species="${chosen}"]`).click();
    assert.deepEqual(await shares(page), { [a]: 0.5, [chosen]: 0.5 });
    for (const id of [b, c, d, e]) {
        const button = page.locator(`#gallery button[data-species="${id}"]`);
        if ((await button.getAttribute("aria-pressed")) === "false") await button.click();
    }
    await ready(page);
    assert.deepEqual(
        await shares(page),
        Object.fromEntries([a, b, c, d, e].map((id) => [id, 0.2])),
    );
    assert.equal(await page.locator(".pad .corner").count(), 5);
    assert.equal(await page.locator('#gallery button[aria-pressed="true"]').count(), 5);
    const sixth = species.find(({ id }) => ![a, b, c, d, e].includes(id));
    await page.locator(`#gallery button[data-species="${sixth.id}"]`).click();
    assert.match(await page.locator("#status").textContent(), /at most 5/);
    assert.equal(Object.keys(await shares(page)).length, 5);
    await page.screenshot({ path: path.join(folder, "editor.png") });
    assert.equal((await parameters(page)).get("seed"), "3", "the other settings stay");
    await page.goBack();
    await ready(page);
    assert.equal(Object.keys(await shares(page)).length, 4);
    await page.locator("#mode-species").click();
    await ready(page);
    assert.ok(
        (await parameters(page)).has("species") && (await page.locator("#editor").isHidden()),
    );
    // Of two, taking one off leaves the other one alone.
    await page.goBack();
    await ready(page);
    for (const id of Object.keys(await shares(page)).filter((id) => id !== c))
        await page
            .locator("#members li", { has: page.locator(`[data-share="${id}"]`) })
            .locator(".off")
            .click();
    await ready(page);
    assert.equal((await parameters(page)).get("species"), c);
    assert.ok(await page.locator("#editor").isHidden());
    expectNoProblems(log);
});

test("dragging the weight point requests drafts, and the final model when released", async (t) => {
    const { page, log } = await open(t, `?morph=${a},${b},${c},${d},${e}`);
    await galleryComplete(page);
    const before_ = await page.locator("#stage").screenshot();
    const requestCount = models(log).length;
    const from = await centre(page.locator("#weight-point"));
    const corner = await centre(page.locator('.pad .corner[data-corner="1"] circle'));
    const half = { x: (from.x + corner.x) / 2, y: (from.y + corner.y) / 2 };
    await drag(page, from, half, () => page.waitForTimeout(500));
    const drafts = models(log)
        .slice(requestCount)
        .map((url) => new URL(url).searchParams);
    assert.ok(drafts.length >= 1 && drafts.length <= 11, `${drafts.length} drafts for one drag`);
    assert.ok(
        drafts.every((query) => query.get("lod") === "1" && query.get("textures") === "linked"),
    );
    await ready(page);
    const weights = await shares(page);
    assert.ok(weights[b] > 0.35 && weights[b] < 0.95, JSON.stringify(weights));
    assert.ok(Math.abs(Object.values(weights).reduce((sum, weight) => sum + weight, 0) - 1) < 1e-9);
    assert.equal(new URL(models(log).at(-1)).search, "", "the whole model as it is by default");
    assert.notDeepEqual(await page.locator("#stage").screenshot(), before_);
    assert.match(await page.locator("#weight-point").getAttribute("aria-valuetext"), /Cep \d+ %/);

    await drag(page, half, { x: corner.x + 3, y: corner.y - 2 });
    await ready(page);
    assert.equal((await shares(page))[b], 1);
    assert.equal(new URL(models(log).at(-1)).pathname, `/v1/mushrooms/${b}.glb`);
    await page.goBack();
    await ready(page);
    assert.deepEqual(await shares(page), weights, "one step back per drag");
    expectNoProblems(log);
});

test("a dragged shape does not wait for its textures", async (t) => {
    const { page } = await open(t, `?morph=${a}:0.5,${b}:0.3,${c}:0.2`);
    await galleryComplete(page);
    let textureRequests = 0;
    let release = () => undefined;
    const released = new Promise((resolve) => {
        release = resolve;
    });
    await page.route(/\/v1\/mushrooms\/[^/]+\/\w+\.jpg/, async (route) => {
        textureRequests += 1;
        await released;
        await route.continue().catch(() => undefined);
    });
    const triangles = await page.evaluate(() => window.sporeprint.counts.triangles);
    const from = await centre(page.locator("#weight-point"));
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(from.x + 30, from.y + 10);
    await page.waitForFunction(
        (before_) => window.sporeprint.counts.triangles < before_,
        triangles,
    );
    assert.equal(
        await page.evaluate(() => window.sporeprint.counts.textures),
        3,
        "it uses the textures of the model before",
    );
    assert.ok(textureRequests <= 3, "one set of textures is requested");
    release();
    await page.unroute(/\/v1\/mushrooms\/[^/]+\/\w+\.jpg/, { behavior: "ignoreErrors" });
    await page.mouse.up();
    await ready(page);
});

test("the copied URL has the canonical mix, and the download has the same bytes", async (t) => {
    const { page, log } = await open(t, `?morph=${c}:0.25,${a}:0.5,${b}:0.25`);
    await shared.grantPermissions(["clipboard-read", "clipboard-write"], {
        origin: new URL(base).origin,
    });
    await page.locator("#copy-url").click();
    await page.waitForFunction(
        () => document.querySelector("#status").textContent === "URL copied",
    );
    const address = await page.evaluate(() => navigator.clipboard.readText());
    assert.equal(
        decodeURIComponent(new URL(address).pathname),
        `/v1/mushrooms/${a}:0.5,${b}:0.25,${c}:0.25.glb`,
    );
    const [download] = await Promise.all([
        page.waitForEvent("download"),
        page.locator("#download").click(),
    ]);
    assert.deepEqual(
        Buffer.from(await (await fetch(address)).arrayBuffer()),
        await readFile(await download.path()),
    );
    expectNoProblems(log);
});

test("an error in the address of a morph is explained", async (t) => {
    const { page, log } = await open(t, `?morph=${a}:0.5,amanita_unicornis:0.5`);
    assert.match(
        await page.locator("#problem").textContent(),
        /'amanita_unicornis' is no species here/,
    );
    assert.ok(await page.locator("#editor").isHidden());
    expectNoProblems(log);
});

test("own arcs between two outlines can be added, dragged, undone and reset", async (t) => {
    const { page, log } = await open(t, `?morph=${a}:0.6,${b}:0.4`, { width: 1280, height: 800 });
    await galleryComplete(page);
    const { arcs: given } = await (await fetch(`${base}/v1/morphs/${a}/${b}`)).json();
    assert.equal(await page.locator(".drawing .given .arc").count(), given.length);
    assert.equal(await page.locator(".drawing .body").count(), 2);
    assert.match(await page.locator("#graph-state").textContent(), /proven not to fold/);
    await page.screenshot({ path: path.join(folder, "editor-graph.png") });

    await page.locator("#graph-tools button", { hasText: "Add arc" }).click();
    await ready(page);
    assert.deepEqual(await arcs(page), ["accepted"]);
    const first = (await parameters(page)).get("arcs");
    assert.match(first, /^cap:0\.\d+:0\.\d+$/);
    assert.match(models(log).at(-1), new RegExp(`/v1/morphs/${a}/${b}.glb$`));

    const end = await centre(page.locator('.drawing [data-index="0"] [data-side="b"] .knob'));
    await drag(page, end, { x: end.x - 30, y: end.y + 8 });
    await ready(page);
    const dragged = (await parameters(page)).get("arcs");
    assert.notEqual(dragged, first);
    assert.equal(dragged.split(":")[1], first.split(":")[1], "the other end stays");
    assert.deepEqual(await arcs(page), ["accepted"]);

    const undo = page.getByRole("button", { name: "Undo" });
    await undo.click();
    await ready(page);
    assert.equal((await parameters(page)).get("arcs"), first);
    await undo.click();
    await ready(page);
    assert.equal((await parameters(page)).get("arcs"), null);
    assert.ok(await undo.isDisabled());
    for (let step = 0; step < 2; ++step) await page.getByRole("button", { name: "Redo" }).click();
    await ready(page);
    assert.equal((await parameters(page)).get("arcs"), dragged);

    // A double click on an outline adds an arc there.
    const place = await page
        .locator(".drawing .curve.stem")
        .first()
        .evaluate((path_) => {
            const { x, y } = path_.getPointAtLength(path_.getTotalLength() * 0.6);
            const box = path_.ownerSVGElement.getBoundingClientRect();
            return { x: box.x + x, y: box.y + y };
        });
    await page.mouse.dblclick(place.x, place.y);
    await ready(page);
    assert.equal((await arcs(page)).length, 2);
    await page.locator("#graph-tools button", { hasText: "Reset" }).click();
    await ready(page);
    assert.deepEqual(await arcs(page), []);
    assert.equal((await parameters(page)).get("arcs"), null);
    expectNoProblems(log);
});

test("a crossing arc is refused with the service's message, and the mushroom stays", async (t) => {
    const { page, log } = await open(t, `?morph=${a}:0.6,${b}:0.4&arcs=cap:0.3:0.3,cap:0.6:0.6`);
    await galleryComplete(page);
    assert.deepEqual(await arcs(page), ["accepted", "accepted"]);
    const handle = page.locator('.drawing [data-index="1"] [data-side="b"]');
    const other = await centre(page.locator('.drawing [data-index="0"] [data-side="b"] .knob'));
    const end = await centre(handle.locator(".knob"));
    const beyond = { x: other.x + (other.x - end.x) * 0.5, y: other.y + (other.y - end.y) * 0.5 };
    await drag(page, end, beyond, async () =>
        assert.ok((await arcs(page)).includes("refused"), "red while it is dragged"),
    );
    await page.locator("#graph-problem:not([hidden])").waitFor();
    await assert.rejects(page.evaluate(() => window.sporeprint.ready()));
    const message = await page.locator("#graph-problem").textContent();
    assert.match(message, /^Arc [12] is refused: ./);
    const response = await fetch(`${base}/v1/morphs/${a}/${b}.glb`, {
        method: "POST",
        headers: { "Content-Type": "application/json" },
        body: JSON.stringify({
            t: 0.4,
            arcs: (await parameters(page))
                .get("arcs")
                .split(",")
                .map((arc) => {
                    const [curve, from, to] = arc.split(":");
                    return { curve, a: Number(from), b: Number(to) };
                }),
        }),
    });
    assert.equal(response.status, 422);
    const { errors } = await response.json();
    const sentences = errors.map(({ detail }) =>
        detail.replace(/\/arcs\/(\d+)/g, (_, index) => `arc ${Number(index) + 1}`),
    );
    assert.ok(
        sentences.some((sentence) => message.endsWith(sentence)),
        `${message} is one of ${sentences.join("; ")}`,
    );
    const named = errors.map(({ parameter }) => Number(parameter.split("/")[2]));
    assert.deepEqual(
        await arcs(page),
        [0, 1].map((index) => (named.includes(index) ? "refused" : "accepted")),
    );
    assert.equal(
        await page.locator(".drawing .refused .mark").first().isVisible(),
        true,
        "not by colour alone",
    );
    assert.ok(await page.locator("#problem").isHidden(), "it is said once, beside the arcs");
    assert.ok((await page.evaluate(() => window.sporeprint.counts)).triangles > 100);
    await page.screenshot({ path: path.join(folder, "editor-refused.png") });
    await page.getByRole("button", { name: "Undo" }).click();
    await ready(page);
    assert.deepEqual(await arcs(page), ["accepted", "accepted"]);
    assert.ok(await page.locator("#graph-problem").isHidden());
    assert.deepEqual(
        log.console.filter((line) => !/status of 422/.test(line)),
        [],
    );
});

test("the morph editor can be used by keyboard alone", async (t) => {
    const { page, log } = await open(t, `?species=${a}`);
    await galleryComplete(page);
    const press = async (key, times = 1) => {
        for (let time = 0; time < times; ++time) await page.keyboard.press(key);
    };
    await page.locator("#mode-morph").focus();
    await press("Enter");
    await ready(page);
    await page.locator("#morph-t").focus();
    await press("ArrowRight", 5);
    await ready(page);
    assert.equal(Object.values(await shares(page))[1], 0.55);

    // To the graph, an arc, its end; every stop has a focus ring or a thick knob.
    const reach = async (matches) => {
        for (let step = 0; step < 90; ++step) {
            const found = await page.evaluate(() => {
                const element = document.activeElement;
                return {
                    text: element.textContent?.trim(),
                    label: element.getAttribute("aria-label") ?? "",
                    id: element.id,
                };
            });
            if (matches(found)) return found;
            await press("Tab");
        }
        throw new Error("no such stop");
    };
    await page.locator(".skip").focus();
    await reach(({ text }) => text === "Add arc");
    await press("Enter");
    await ready(page);
    const { label } = await page.evaluate(() => ({
        label: document.activeElement.getAttribute("aria-label"),
    }));
    assert.match(label, /^Arc 1, cap, end on Fly agaric$/);
    const start = (await parameters(page)).get("arcs");
    await press("ArrowUp", 3);
    await ready(page);
    assert.notEqual((await parameters(page)).get("arcs"), start);
    await press("Control+z");
    await ready(page);
    await press("Delete");
    await ready(page);
    assert.equal((await parameters(page)).get("arcs"), null);

    // A third species by keyboard: the polygon, its point, corners by digits.
    await page.locator(`#gallery button[data-species="${c}"]`).focus();
    await press("Enter");
    await ready(page);
    await page.locator("#weight-point").focus();
    const middle = await shares(page);
    await press("ArrowUp", 4);
    await ready(page);
    assert.ok(Object.values(await shares(page))[0] > Object.values(middle)[0]);
    await press("3");
    await ready(page);
    assert.equal(Object.values(await shares(page))[2], 1);
    await press("ArrowUp");
    await ready(page);
    assert.ok(Object.values(await shares(page))[2] < 1, "a key leaves a corner again");
    await press("Home");
    await ready(page);
    for (const weight of Object.values(await shares(page)))
        assert.ok(Math.abs(weight - 1 / 3) < 0.002);
    expectNoProblems(log);
});

test("the clip of a mix is requested once, and the age poses it", async (t) => {
    const { page, log } = await open(t, `?morph=${a}:0.5,${c}:0.5&texture_size=128`);
    await galleryComplete(page);
    const schema = await (await fetch(`${base}/v1/mushrooms/schema`)).json();
    if (!schema.properties.animation?.enum?.includes("growth"))
        return t.skip("this server makes no clips");
    await page.locator("#play").click();
    await page.locator("#status", { hasText: /Growth is loaded/ }).waitFor({ timeout: 60_000 });
    const clip = new URL(models(log).at(-1));
    assert.equal(clip.pathname, `/v1/mushrooms/${a}:0.5,${c}:0.5.glb`);
    assert.deepEqual(
        [clip.searchParams.get("animation"), clip.searchParams.get("lod")],
        ["growth", "1"],
    );
    const requestCount = models(log).length;
    await page.locator('input[type=range][name="age"]').focus();
    await page.keyboard.press("ArrowLeft");
    await page.waitForFunction(() => window.sporeprint.growth.age < 0.6);
    assert.deepEqual(
        models(log)
            .slice(requestCount)
            .filter((url) => /lod=1/.test(url)),
        [],
        "no model is requested",
    );
    await ready(page);
    expectNoProblems(log);
});

test("a share can be typed, and one click makes it the only one", async (t) => {
    const { page, log } = await open(t, `?morph=${a}:0.5,${b}:0.3,${c}:0.2`);
    await galleryComplete(page);
    await page.locator(`[data-share="${a}"]`).fill("75");
    await page.locator(`[data-share="${a}"]`).press("Enter");
    await ready(page);
    assert.equal((await shares(page))[a], 0.75);
    assert.ok(Math.abs((await shares(page))[b] / (await shares(page))[c] - 1.5) < 0.02);
    await page.locator('#members [data-member="2"] .letter').click();
    await ready(page);
    assert.equal((await shares(page))[c], 1);
    expectNoProblems(log);
});

test(
    "a variety sheet of five shapes has 25 morphs, as a picture and as one valid GLB",
    { timeout: 600_000 },
    async (t) => {
        const { page, log } = await open(t, `?morph=${a},${b},${c},${d},${e}&texture_size=256`, {
            width: 1280,
            height: 800,
        });
        await galleryComplete(page);
        await page.locator("#variety").click();
        await page.evaluate(() => window.sporeprint.ready());
        assert.equal((await parameters(page)).get("sheet"), "variety");
        assert.match(await page.locator("#sheet-state").textContent(), /^25 mushrooms/);
        await page.screenshot({ path: path.join(folder, "editor-sheet.png") });
        const [picture] = await Promise.all([
            page.waitForEvent("download"),
            page.locator("#sheet-png").click(),
        ]);
        assert.match(picture.suggestedFilename(), /^variety-.*\.png$/);
        const png = await readFile(await picture.path());
        assert.equal(png.readUInt32BE(16), 1360, "five cells wide");
        await picture.saveAs(path.join(folder, "variety.png"));

        const [model] = await Promise.all([
            page.waitForEvent("download", { timeout: 300_000 }),
            page.locator("#sheet-glb").click(),
        ]);
        assert.match(model.suggestedFilename(), /^variety-.*\.glb$/);
        const glb = new Uint8Array(await readFile(await model.path()));
        const { issues, info } = await packages("gltf-validator").validateBytes(glb, {
            maxIssues: 20,
        });
        assert.deepEqual(issues.messages, []);
        assert.equal(info.drawCallCount, 25);
        const json = JSON.parse(
            new TextDecoder().decode(
                glb.subarray(20, 20 + new DataView(glb.buffer, glb.byteOffset).getUint32(12, true)),
            ),
        );
        assert.equal(json.scenes.length, 1);
        const names = json.scenes[0].nodes.map((node) => json.nodes[node].name);
        assert.equal(new Set(names).size, 25);
        for (const name of [a, b, c, d, e, `${a}:0.5,${b}:0.5`])
            assert.ok(names.includes(name), `${name} is one of ${names}`);
        const places = json.scenes[0].nodes.map(
            (node) => json.nodes[node].translation ?? [0, 0, 0],
        );
        assert.equal(
            new Set(places.map(([x, , z]) => `${x.toFixed(4)} ${z.toFixed(4)}`)).size,
            25,
            "each stands on its own place",
        );
        await page.locator("#sheet-close").click();
        await page.waitForFunction(() => !new URLSearchParams(location.search).has("sheet"));
        expectNoProblems(log);
    },
);

test("a sheet can be cancelled, and the address of a sheet opens it", async (t) => {
    const { page, log } = await open(t, `?morph=${a},${b},${c},${d}&texture_size=128`);
    await galleryComplete(page);
    await page.route(/lod=1/, async (route) => {
        await new Promise((resolve) => setTimeout(resolve, 300));
        await route.continue().catch(() => undefined);
    });
    await page.locator("#variety").click();
    await page.locator("#sheet-cancel").click();
    assert.match(await page.locator("#sheet-state").textContent(), /^Stopped after \d+ of 25/);
    const requestCount = models(log).length;
    await page.waitForTimeout(900);
    assert.equal(models(log).length, requestCount, "nothing more is asked for");
    assert.ok(await page.locator("#sheet-png").isDisabled());
    await page.keyboard.press("Escape");
    assert.ok(await page.locator("#sheet").isHidden());

    await page.unroute(/lod=1/);
    await page.goto(`${base}/?species=${c}&texture_size=128&sheet=growth`);
    await ready(page);
    assert.match(await page.locator("#sheet-state").textContent(), /^9 mushrooms/);
    const [picture] = await Promise.all([
        page.waitForEvent("download"),
        page.locator("#sheet-png").click(),
    ]);
    assert.match(picture.suggestedFilename(), /^growth-coprinus_comatus.png$/);
    await picture.saveAs(path.join(folder, "growth.png"));
    expectNoProblems(log);
});

test("the morph editor fits into 390 pixels without horizontal scrolling", async (t) => {
    for (const [name, query] of [
        ["two", `${a},${c}&arcs=cap:0.4:0.5`],
        ["five", `${a},${b},${c},${d},${e}`],
    ]) {
        const { page, log } = await open(t, `?morph=${query}`, { width: 390, height: 844 });
        await galleryComplete(page);
        const { wide, over } = await page.evaluate(() => ({
            wide: document.documentElement.scrollWidth,
            over: [...document.querySelectorAll("main *, aside *, header *, footer")]
                .filter(
                    (element) =>
                        !element.closest("svg") &&
                        element.getBoundingClientRect().right > innerWidth + 0.5 &&
                        element.getClientRects().length,
                )
                .map((element) => element.id || element.className || element.tagName),
        }));
        assert.ok(wide <= 390, `the page is ${wide} pixels wide`);
        assert.deepEqual(over, []);
        await page.screenshot({ path: path.join(folder, `editor-phone-${name}.png`) });
        await page.screenshot({
            path: path.join(folder, `editor-phone-${name}-whole.png`),
            fullPage: true,
        });
        expectNoProblems(log);
    }
});
