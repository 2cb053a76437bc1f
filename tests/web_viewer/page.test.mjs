// Tests of the page in headless Chromium against a running server (SPOREPRINT_URL).
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import path from "node:path";
import test, { after, before } from "node:test";
import {
    addressOf,
    galleryComplete,
    launchBrowser,
    logEvents,
    parameters,
    ready,
    reload,
    screenshotFolder,
    serverUrl,
} from "./support.mjs";

const base = serverUrl();
let browser;
let shared;
let folder;
let species;

before(async () => {
    folder = await screenshotFolder();
    browser = await launchBrowser();
    // All tests share one cache, so that the gallery's pictures are drawn once.
    shared = await browser.newContext({
        viewport: { width: 960, height: 560 },
        reducedMotion: "reduce",
    });
    species = (await (await fetch(`${base}/v1/species`)).json()).species;
});

after(() => browser?.close());

/** Opens a page; `log` has its console messages and requests. */
async function open(t, query = "", viewport = undefined, from = base) {
    const page = await shared.newPage();
    t.after(() => page.close());
    if (viewport) await page.setViewportSize(viewport);
    const log = logEvents(page);
    await page.goto(`${from}/${query}`);
    await ready(page);
    return { page, log };
}

const stagePicture = (page) => page.locator("#stage").screenshot();
/** Returns the requested models. */
const models = (log) => log.requests.filter((url) => /\/v1\/mushrooms\/[^/]+\.glb/.test(url));
const slider = (page, name) => page.locator(`input[type=range][name="${name}"]`);

/** Returns the number of different colours in a picture: an empty stage has only those of a
 *  gradient. */
async function colours(t, png) {
    const context = await browser.newContext();
    t.after(() => context.close());
    const page = await context.newPage();
    return page.evaluate(async (data) => {
        const bitmap = await createImageBitmap(
            await (await fetch(`data:image/png;base64,${data}`)).blob(),
        );
        const canvas = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
        canvas.drawImage(bitmap, 0, 0);
        return new Set(
            new Uint32Array(canvas.getImageData(0, 0, bitmap.width, bitmap.height).data.buffer),
        ).size;
    }, png.toString("base64"));
}

function expectNoProblems(log) {
    assert.deepEqual(log.console, []);
    assert.deepEqual(log.failed, []);
}

test("every species is loaded and drawn without console messages", async (t) => {
    const whole = serverUrl({ everySpecies: true });
    const { species } = await (await fetch(`${whole}/v1/species`)).json();
    assert.ok(species.length > 0);
    const { page, log } = await open(t, "", { width: 1280, height: 800 }, whole);
    await galleryComplete(page);
    // What other tests have published is listed too.
    const builtIn = '#gallery button:not([data-species^="~"]) img';
    assert.equal(
        await page.locator(builtIn).count(),
        species.length,
        "a picture for every species",
    );
    await page.screenshot({ path: path.join(folder, "page.png") });
    for (const { id, common_name: name } of species) {
        await page.locator(`#gallery button[data-species="${id}"]`).click();
        await ready(page);
        assert.equal(
            await page.locator('#gallery button[aria-pressed="true"]').getAttribute("data-species"),
            id,
        );
        assert.equal(await page.locator("#common-name").textContent(), name);
        const { counts, size } = await page.evaluate(() => ({
            counts: window.sporeprint.counts,
            size: window.sporeprint.size,
        }));
        assert.ok(
            counts.triangles > 100 && counts.drawCalls >= 1,
            `${id}: ${JSON.stringify(counts)}`,
        );
        assert.ok(size.height > 0.001 && size.height < 2, `${id} is ${size.height} m tall`);
        const png = await page.screenshot({ path: path.join(folder, `species-${id}.png`) });
        assert.ok((await colours(t, png)) > 1500, `${id} is drawn`);
    }
    expectNoProblems(log);
});

test("a dragged slider requests drafts and the final model and writes the address", async (t) => {
    const { page, log } = await open(t, `?species=${species[0].id}`);
    await galleryComplete(page);
    const before_ = await stagePicture(page);
    const requestCount = models(log).length;
    const box = await slider(page, "age").boundingBox();
    const y = box.y + box.height / 2;
    await page.mouse.move(box.x + box.width * 0.6, y);
    await page.mouse.down();
    for (let step = 0; step < 12; ++step) {
        await page.mouse.move(box.x + box.width * (0.6 - step * 0.035), y);
        await page.waitForTimeout(60);
    }
    await page.waitForTimeout(400);
    const drafts = models(log)
        .slice(requestCount)
        .map((url) => new URL(url).searchParams);
    assert.ok(drafts.length >= 1 && drafts.length <= 12, `${drafts.length} drafts for one drag`);
    assert.ok(
        drafts.every((query) => query.get("lod") === "1" && query.get("textures") === "linked"),
    );
    await page.mouse.up();
    await ready(page);
    const age = Number((await parameters(page)).get("age"));
    assert.ok(age > 0.05 && age < 0.45, `age is ${age}`);
    assert.equal(await page.locator('input[type=number][name="age"]').inputValue(), String(age));
    const last = new URL(models(log).at(-1)).searchParams;
    assert.deepEqual([...last], [["age", String(age)]]);
    assert.notDeepEqual(await stagePicture(page), before_, "the picture changed");
    await page.screenshot({ path: path.join(folder, "after-drag.png") });

    await page.goBack();
    await ready(page);
    assert.equal((await parameters(page)).get("age"), null, "one step back undoes the drag");
    assert.equal(await slider(page, "age").inputValue(), "0.6");
    await page.goForward();
    await ready(page);
    assert.equal(Number((await parameters(page)).get("age")), age);
    expectNoProblems(log);
});

test("an address opens as it was shared", async (t) => {
    const id = species.at(-1).id;
    const { page, log } = await open(t, `?species=${id}&seed=42&age=0.35&lod=1`);
    assert.equal(await page.locator('input[type=number][name="seed"]').inputValue(), "42");
    assert.equal(await page.locator('input[type=number][name="age"]').inputValue(), "0.35");
    assert.equal(await page.locator('#lods button[aria-pressed="true"]').textContent(), "L1");
    assert.equal(
        await page.locator('#gallery button[aria-pressed="true"]').getAttribute("data-species"),
        id,
    );
    expectNoProblems(log);
});

test("quantised and compressed geometry shows the same model", async (t) => {
    const shown = [];
    for (const compress of ["none", "quantize", "meshopt"]) {
        const { page, log } = await open(
            t,
            `?species=${species[0].id}&lod=1&compress=${compress}&animation=growth&frames=3`,
        );
        shown.push(
            await page.evaluate(() => ({
                counts: window.sporeprint.counts,
                size: window.sporeprint.size,
            })),
        );
        expectNoProblems(log);
    }
    const [plain, ...others] = shown;
    assert.ok(plain.counts.triangles > 500);
    for (const { counts, size } of others) {
        assert.deepEqual(counts, plain.counts);
        for (const [axis, metres] of Object.entries(plain.size))
            assert.ok(Math.abs(size[axis] - metres) < 0.0001, `${axis}: ${size[axis]}`);
    }
});

test("what an address gets wrong is said in words beside the control", async (t) => {
    const { page } = await open(t, `?species=${species[0].id}&age=1.7&sed=4`);
    assert.match(
        await page.locator('.control[data-name="age"] .validation-error').textContent(),
        /'1.7' is above 1/,
    );
    assert.match(await page.locator("#problem").textContent(), /sed/);
    assert.equal(await slider(page, "age").getAttribute("aria-invalid"), "true");
});

test("an unknown species is reported and the first one is shown", async (t) => {
    const { page, log } = await open(t, "?species=amanita_unicornis");
    assert.match(
        await page.locator("#problem").textContent(),
        /'amanita_unicornis' is no species here/,
    );
    assert.equal(
        await page.locator('#gallery button[aria-pressed="true"]').getAttribute("data-species"),
        species[0].id,
    );
    expectNoProblems(log);
});

test("the names and the gallery show all members of a mix", async (t) => {
    const [first, last] = [species[0], species.at(-1)];
    const page = await shared.newPage();
    t.after(() => page.close());
    // This test is about the page's handling of a mix, not about which species can be mixed.
    await page.route(/\/v1\/mushrooms\/[^/]+,/, (route) => {
        const url = route.request().url();
        return route.continue({ url: url.replace(/mushrooms\/[^/]+\./, `mushrooms/${first.id}.`) });
    });
    const log = logEvents(page);
    await page.goto(`${base}/?species=${first.id}:0.5,${last.id}:0.5`);
    await ready(page);
    assert.equal(await page.locator('#gallery button[aria-pressed="true"]').count(), 2);
    assert.equal(
        await page.locator("#common-name").textContent(),
        `${first.common_name} × ${last.common_name}`,
    );
    expectNoProblems(log);
});

test("every control is a native input with query name, description and valid value", async (t) => {
    const { page } = await open(t);
    const schema = await (await fetch(`${base}/v1/mushrooms/schema`)).json();
    const names = Object.keys(schema.properties).filter(
        (name) =>
            name !== "v" && !schema.properties[name].properties && !schema.properties[name].oneOf,
    );
    for (const name of names)
        assert.ok((await page.locator(`[name="${name}"]`).count()) >= 1, `${name} has a control`);
    const errors = await page.evaluate(() =>
        [...document.querySelectorAll("form [name]")].flatMap((entry) => {
            const wrong = [];
            const about = entry.getAttribute("aria-describedby")?.split(" ")[0];
            if (!document.getElementById(about)?.textContent) wrong.push("no description");
            if (
                entry.type === "range" &&
                !document.querySelector(`input[type=number][name="${entry.name}"]`)
            )
                wrong.push("no number");
            if (
                entry.type === "number" &&
                entry.value !== "" &&
                (Number(entry.value) < Number(entry.min) || Number(entry.value) > Number(entry.max))
            )
                wrong.push("outside its range");
            if (!entry.labels?.length && !entry.getAttribute("aria-label")) wrong.push("no label");
            return wrong.map((what) => `${entry.name}: ${what}`);
        }),
    );
    assert.deepEqual(errors, []);
});

test("a value of the species' own is sent only while it is changed", async (t) => {
    const { page, log } = await open(t, `?species=${species[0].id}`);
    await page.evaluate(() =>
        document.querySelectorAll("details").forEach((details) => (details.open = true)),
    );
    const row = page.locator(".control.inherited.number:visible").first();
    assert.equal(await row.count(), 1);
    const name = await row.getAttribute("data-name");
    assert.ok(!models(log).some((url) => new URL(url).searchParams.has(name)));
    const own = await slider(page, name).inputValue();
    await slider(page, name).focus();
    await page.keyboard.press(
        Number(own) > Number(await slider(page, name).getAttribute("min"))
            ? "ArrowLeft"
            : "ArrowRight",
    );
    await ready(page);
    assert.ok((await parameters(page)).has(name));
    assert.ok(new URL(models(log).at(-1)).searchParams.has(name));
    await page.locator(`.control[data-name="${name}"] .reset`).click();
    await ready(page);
    assert.ok(!(await parameters(page)).has(name));
    assert.equal(await slider(page, name).inputValue(), own);
    expectNoProblems(log);
});

/** Drops bytes onto the page as a file. */
async function drop(page, bytes, name) {
    const transfer = await page.evaluateHandle(
        ([data, file]) => {
            const transfer_ = new DataTransfer();
            transfer_.items.add(
                new File([Uint8Array.from(atob(data), (sign) => sign.charCodeAt(0))], file),
            );
            return transfer_;
        },
        [Buffer.from(bytes).toString("base64"), name],
    );
    await page.dispatchEvent("body", "dragover", { dataTransfer: transfer });
    await page.dispatchEvent("body", "drop", { dataTransfer: transfer });
}

test("a dropped GLB restores its settings", async (t) => {
    const id = species.at(-1).id;
    const bytes = await (
        await fetch(
            `${base}/v1/mushrooms/${id}.glb?age=0.35&seed=42&variation=0.8&texture_size=256`,
        )
    ).arrayBuffer();
    const { page, log } = await open(t, `?species=${species[0].id}&size=2`);
    await drop(page, bytes, "found.glb");
    await page.waitForFunction((wanted) => location.search.includes(wanted), id);
    await ready(page);
    assert.deepEqual([...(await parameters(page))].sort(), [
        ["age", "0.35"],
        ["seed", "42"],
        ["species", id],
        ["texture_size", "256"],
        ["variation", "0.8"],
    ]);
    assert.equal(await page.locator('input[type=number][name="seed"]').inputValue(), "42");
    assert.equal(await page.locator('select[name="texture_size"]').inputValue(), "256");
    assert.match(await page.locator("#status").textContent(), /./);
    await page.screenshot({ path: path.join(folder, "after-drop.png") });
    expectNoProblems(log);
});

test("a file of another origin is refused with a message, and the mushroom stays", async (t) => {
    const { page } = await open(t);
    const before_ = (await addressOf(page)).href;
    await drop(page, Buffer.from("not a model"), "poem.glb");
    await page.locator("#problem:not([hidden])").waitFor();
    assert.match(await page.locator("#problem").textContent(), /\w+ \w+/);
    assert.equal((await addressOf(page)).href, before_);
    await ready(page);
});

test("an idle page sends no request and draws no frame", async (t) => {
    const { page, log } = await open(t);
    await galleryComplete(page);
    await page.waitForTimeout(500);
    const requestCount = log.requests.length;
    const { frames } = await page.evaluate(() => window.sporeprint.renderer);
    await page.waitForTimeout(3000);
    assert.deepEqual(log.requests.slice(requestCount), []);
    assert.equal((await page.evaluate(() => window.sporeprint.renderer)).frames, frames);
    expectNoProblems(log);
});

test("a second visit takes the gallery's pictures from the cache of the browser", async (t) => {
    const { page, log } = await open(t);
    await galleryComplete(page);
    await reload(page, log);
    await ready(page);
    await galleryComplete(page);
    assert.equal(await page.locator("#gallery img").count(), species.length);
    const sizes = await page.evaluate(() =>
        performance
            .getEntriesByType("resource")
            .filter(({ name }) => /\.png\?/.test(name))
            .map(({ transferSize }) => transferSize),
    );
    assert.deepEqual(sizes, Array(species.length).fill(0));
    expectNoProblems(log);
});

test("the whole page can be used by keyboard and the focus is always visible", async (t) => {
    const { page, log } = await open(t);
    await galleryComplete(page);
    const seen = new Set();
    let unseen = 0;
    for (let step = 0; step < 120; ++step) {
        await page.keyboard.press("Tab");
        const focus = await page.evaluate(() => {
            const element = document.activeElement;
            if (!element || element === document.body) return null;
            const box = element.getBoundingClientRect();
            const ring = getComputedStyle(element);
            return {
                key:
                    element.id ||
                    element.dataset.species ||
                    element.name ||
                    element.textContent.trim().slice(0, 30) ||
                    element.tagName,
                visible:
                    box.width > 0 &&
                    box.height > 0 &&
                    box.right > 0 &&
                    box.bottom > 0 &&
                    box.left < innerWidth &&
                    box.top < innerHeight,
                ring: ring.outlineStyle !== "none" && parseFloat(ring.outlineWidth) > 0,
            };
        });
        if (!focus) break;
        if (!focus.visible || !focus.ring) unseen += 1;
        seen.add(focus.key);
    }
    assert.equal(unseen, 0, "every stop is visible and has a focus ring");
    for (const key of [
        "canvas",
        "wireframe",
        "download",
        "copy-url",
        "tab-shape",
        "open",
        species[0].id,
        species.at(-1).id,
    ]) {
        assert.ok(seen.has(key), `${key} can be reached; seen: ${[...seen].join(", ")}`);
    }

    await page.locator(`#gallery button[data-species="${species[0].id}"]`).focus();
    await page.keyboard.press("ArrowDown");
    await page.keyboard.press("Enter");
    await ready(page);
    assert.equal((await parameters(page)).get("species"), (species[1] ?? species[0]).id);

    await slider(page, "age").focus();
    await page.keyboard.press("ArrowRight");
    await ready(page);
    assert.ok(Number((await parameters(page)).get("age")) > 0.6);

    const before_ = await stagePicture(page);
    await page.locator("#canvas").focus();
    for (let turn = 0; turn < 4; ++turn) await page.keyboard.press("ArrowRight");
    await page.evaluate(() => window.sporeprint.ready());
    assert.notDeepEqual(await stagePicture(page), before_, "arrow keys turn the mushroom");
    expectNoProblems(log);
});

test("the page fits into 360 pixels without horizontal scrolling", async (t) => {
    const { page, log } = await open(t, "", { width: 360, height: 740 });
    await galleryComplete(page);
    await page.evaluate(() =>
        document.querySelectorAll("details").forEach((details) => (details.open = true)),
    );
    const { wide, over } = await page.evaluate(() => ({
        wide: document.documentElement.scrollWidth,
        over: [...document.querySelectorAll("main *, aside *, header *, footer")]
            .filter(
                (element) =>
                    element.getBoundingClientRect().right > innerWidth + 0.5 &&
                    element.getClientRects().length,
            )
            .map((element) => element.id || element.className || element.tagName),
    }));
    assert.ok(wide <= 360, `the page is ${wide} pixels wide`);
    assert.deepEqual(over, []);
    await page.screenshot({ path: path.join(folder, "phone.png") });
    await page.screenshot({ path: path.join(folder, "phone-whole.png"), fullPage: true });
    expectNoProblems(log);
});

test("the downloaded file and the copied address are the same bytes", async (t) => {
    const { page } = await open(t, `?species=${species[0].id}&seed=7`);
    await shared.grantPermissions(["clipboard-read", "clipboard-write"], {
        origin: new URL(base).origin,
    });
    const [download] = await Promise.all([
        page.waitForEvent("download"),
        page.locator("#download").click(),
    ]);
    assert.match(download.suggestedFilename(), /\.glb$/);
    const saved = await readFile(await download.path());
    await page.locator("#copy-url").click();
    await page.waitForFunction(
        () => document.querySelector("#status").textContent === "URL copied",
    );
    const address = await page.evaluate(() => navigator.clipboard.readText());
    assert.match(address, /^http.*\/v1\/mushrooms\/.*seed=7/);
    assert.deepEqual(Buffer.from(await (await fetch(address)).arrayBuffer()), saved);
    await page.locator("#tab-export").click();
    await page.locator("#copy-curl").click();
    await page.waitForFunction(
        () => document.querySelector("#status").textContent === "curl command copied",
    );
    assert.equal(
        await page.evaluate(() => navigator.clipboard.readText()),
        `curl -o '${download.suggestedFilename()}' '${address}'`,
    );
});

test("repeated changes free all memory of the graphics card", async (t) => {
    const { page } = await open(t);
    await galleryComplete(page);
    const roll = async () => {
        await page.locator(".dice").click();
        await ready(page);
        return page.evaluate(() => window.sporeprint.renderer);
    };
    const first = await roll();
    let last = first;
    for (let i = 0; i < 5; ++i) last = await roll();
    assert.equal(last.geometries, first.geometries);
    assert.equal(last.textures, first.textures);
    assert.ok((await parameters(page)).has("seed"));
});

test("wireframe and named views change the picture, and the address has the view", async (t) => {
    const { page, log } = await open(t, `?species=${species[0].id}`);
    const plain = await stagePicture(page);
    await page.locator("#wireframe").click();
    await page.evaluate(() => window.sporeprint.ready());
    const wire = await stagePicture(page);
    assert.notDeepEqual(wire, plain);
    await page.evaluate(() => window.sporeprint.view("below"));
    await page.evaluate(() => window.sporeprint.ready());
    assert.notDeepEqual(await stagePicture(page), wire);
    assert.deepEqual(
        [...(await parameters(page))],
        [
            ["species", species[0].id],
            ["view", "below"],
        ],
    );
    expectNoProblems(log);
});

test("solids for collision are drawn as edges and are no draw calls", async (t) => {
    const query = `?species=${species[0].id}&lod=1`;
    const { page } = await open(t, query);
    const plain = await page.evaluate(() => window.sporeprint.counts);
    const picture = await stagePicture(page);
    const { page: solid, log } = await open(t, `${query}&collision=nodes`);
    assert.deepEqual(await solid.evaluate(() => window.sporeprint.counts), plain);
    assert.notDeepEqual(await stagePicture(solid), picture);
    const { page: body, log: ofBody } = await open(t, `${query}&collision=omi`);
    const withSolids = await stagePicture(body);
    assert.notDeepEqual(withSolids, picture);
    await body.evaluate(() => document.querySelector("#solids").click());
    await body.evaluate(() => window.sporeprint.ready());
    assert.notDeepEqual(await stagePicture(body), withSolids, "they can be hidden");
    assert.equal((await parameters(body)).get("solids"), "hidden");
    expectNoProblems(ofBody);
    expectNoProblems(log);
});

test("weights of wind move the model in a breeze and are shown as colours", async (t) => {
    const still = `?species=mycena_sanguinolenta&lod=2&texture_size=128`;
    const { page: without } = await open(t, still);
    assert.ok(await without.locator("#breeze").isHidden());
    for (const format of ["uv", "attribute", "color"]) {
        const { page, log } = await open(t, `${still}&wind=${format}`);
        const press = (button) => page.evaluate((id) => document.querySelector(id).click(), button);
        // The pixels of the canvas alone are read in the task that has drawn them.
        const drawn = () =>
            page.evaluate(async () => {
                await window.sporeprint.ready();
                return document.querySelector("#canvas").toDataURL();
            });
        const rest = await drawn();
        const views = new Set([rest]);
        for (const channel of ["all", "bend", "phase"]) {
            await press(`[data-channel="${channel}"]`);
            views.add(await drawn());
            assert.equal((await parameters(page)).get("weights"), channel);
        }
        assert.equal(views.size, 4, `${format}: each weight is shown`);
        await press('[data-channel="phase"]');
        assert.equal(await drawn(), rest);
        const before = await page.evaluate(() => window.sporeprint.renderer.frames);
        await press("#breeze");
        await page.waitForFunction((n) => window.sporeprint.renderer.frames > n + 3, before);
        assert.notEqual(await drawn(), rest, `${format}: it moves`);
        await press("#breeze");
        assert.equal(await drawn(), rest, `${format}: it stands still again`);
        expectNoProblems(log);
    }
});

/** Returns what a button copies, as the page shows it where it may not use the clipboard. */
async function copied(page, button) {
    await page.evaluate(() => {
        navigator.clipboard.writeText = () => Promise.reject(new Error("not allowed"));
    });
    const shown = page.waitForEvent("dialog").then(async (dialog) => {
        const text = dialog.defaultValue();
        await dialog.accept();
        return text;
    });
    await page.locator(button).click();
    return shown;
}

const posted = (path_, body) =>
    fetch(`${base}${path_}`, {
        method: "POST",
        headers: { "Content-Type": "application/json" },
        body,
    });

test("the export panel has every switch of the file, its costs, and what can be copied", async (t) => {
    const { page, log } = await open(
        t,
        "?species=boletus_edulis&lod=1&texture_size=512&profile=godot&panel=export",
        { width: 360, height: 740 },
    );
    const { properties } = await (await fetch(`${base}/v1/mushrooms/schema`)).json();
    const ofFile = Object.keys(properties).filter((name) => properties[name]["x-group"] === "file");
    assert.ok(ofFile.length >= 7);
    for (const name of ofFile)
        assert.ok(await page.locator(`#export-form [name="${name}"]`).first().isVisible(), name);
    assert.equal(await page.locator("#form").isVisible(), false);
    const costs = await page.locator("#costs").innerText();
    const { triangles } = await page.evaluate(() => window.sporeprint.counts);
    assert.equal(/Triangles\s+([\d\u202f]+)/.exec(costs)[1].replace("\u202f", ""), `${triangles}`);
    // Three images of 256 x 256 with mipmaps.
    assert.match(costs, /Texture memory\s+1\.0 MB/);
    assert.match(costs, /Draw calls\s+1/);
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 360);

    const code = await copied(page, "#copy-code");
    assert.match(code, /GLTFDocument/);
    assert.match(code, /\/v1\/mushrooms\/boletus_edulis\.glb\?.*profile=godot/);
    const manifest = JSON.parse(await copied(page, "#copy-manifest"));
    assert.match(manifest.canonical, /boletus_edulis\.glb/);
    assert.equal(manifest.effective.profile, "godot");
    const set = await posted("/v1/sets.json", await copied(page, "#copy-set"));
    assert.equal(set.status, 200, await set.clone().text());
    const { files } = await set.json();
    assert.deepEqual(new Set(files.map(({ lod }) => lod)), new Set([1, 2, 3]));
    assert.ok(files.every(({ url }) => /boletus_edulis.*profile=godot/.test(url)));
    expectNoProblems(log);

    await page.locator("#tab-export").focus();
    await page.keyboard.press("ArrowLeft");
    assert.ok(await page.locator("#form").isVisible());
    assert.equal((await parameters(page)).get("panel"), null);
    await page.keyboard.press("ArrowRight");
    assert.equal((await parameters(page)).get("panel"), "export");
    await page.goto(`${(await addressOf(page)).href}&lods=half`);
    await ready(page);
    assert.match(
        await page.locator('.control[data-name="lods"] .validation-error').textContent(),
        /'half' cannot be read/,
    );
});

test("levels of detail are shown as large as they are drawn last", async (t) => {
    const small = "?species=boletus_edulis&lod=1&texture_size=128&panel=export";
    const shown = (page) =>
        page.evaluate(async () => {
            await window.sporeprint.ready();
            return window.sporeprint.shown;
        });
    for (const lods of ["msft", "nodes"]) {
        const { page, log } = await open(t, `${small}&lods=${lods}&collision=omi`);
        const { levels } = await (
            await fetch(
                `${base}/v1/mushrooms/boletus_edulis.json?lod=1&texture_size=128&lods=${lods}`,
            )
        ).json();
        // A chain has levels between the whole ones.
        const level = (number) => levels.find(({ lod }) => lod === number);
        await page.locator('[data-level="2"]').click();
        let { triangles, pixels } = await shown(page);
        assert.ok(Math.abs(pixels / (level(2).screen_coverage * 1080) - 1) < 0.02, `${pixels}`);
        assert.ok(triangles < 0.5 * level(1).triangles && triangles > level(3).triangles);
        assert.equal((await parameters(page)).get("level"), "2");
        assert.equal((await parameters(page)).get("lod"), "1", "the file is the same");
        await page.locator("#level-screen").selectOption("2160");
        assert.ok(Math.abs((await shown(page)).pixels / (2 * pixels) - 1) < 0.02);
        await reload(page, log);
        await ready(page);
        assert.equal((await shown(page)).triangles, triangles, "the address has the level");
        await page.locator('[data-level="2"]').click();
        assert.ok((await shown(page)).triangles > triangles);
        assert.equal((await parameters(page)).get("level"), null);
        expectNoProblems(log);
    }
    const { page, log } = await open(t, small);
    await page.locator('[data-level="0"]').waitFor();
    await page.locator('[data-level="3"]').click();
    await ready(page);
    assert.equal((await parameters(page)).get("lod"), "3", "a level of its own is another file");
    assert.equal(await page.locator('[data-level="3"]').getAttribute("aria-pressed"), "true");
    await page.locator('[data-level="0"]').waitFor();
    expectNoProblems(log);
});

test("variants of the material are offered, shown and taken back", async (t) => {
    const query = "?species=amanita_muscaria&lod=2&texture_size=256";
    const { page: without } = await open(t, query);
    assert.ok(await without.locator("#variant").isHidden());
    const { page, log } = await open(t, `${query}&variants=weather`);
    const drawn = async (variant) => {
        await page.locator("#variant").selectOption(variant);
        await page.waitForTimeout(500);
        return page.evaluate(async () => {
            await window.sporeprint.ready();
            return document.querySelector("#canvas").toDataURL();
        });
    };
    const names = await page.locator("#variant option").allTextContents();
    assert.deepEqual(names, ["As requested", "dry", "wet", "aged", "frosted"]);
    const plain = await drawn("");
    const pictures = new Set([plain]);
    for (const name of names.slice(1)) pictures.add(await drawn(name));
    assert.equal(pictures.size, 5);
    assert.equal(await drawn(""), plain);
    expectNoProblems(log);
});

test("a request to a busy server is repeated after Retry-After, which is shown", async (t) => {
    const { page } = await open(t, `?species=${species[0].id}`);
    await galleryComplete(page);
    let refused = 0;
    await page.route(/\/v1\/mushrooms\/[^/]+\.glb/, async (route) => {
        if (refused++ < 2)
            await route.fulfill({ status: 503, headers: { "Retry-After": "1" }, body: "" });
        else await route.continue();
    });
    const start = Date.now();
    await page.locator(".dice").click();
    await page.locator("#progress-text", { hasText: /busy; again in 1 s/ }).waitFor();
    await ready(page);
    assert.ok(Date.now() - start >= 1900);
    assert.equal(refused, 3);
    assert.ok(await page.locator("#problem").isHidden());
});

test("a refusal stands in words beside its control, and the old mushroom stays", async (t) => {
    const { page } = await open(t, `?species=${species[0].id}`);
    await galleryComplete(page);
    const shown = await page.evaluate(() => window.sporeprint.counts);
    await page.route(/\/v1\/mushrooms\/[^/]+\.glb/, (route) =>
        route.fulfill({
            status: 422,
            contentType: "application/problem+json",
            body: JSON.stringify({
                title: "Impossible",
                status: 422,
                detail: "1 parameter does not fit",
                errors: [{ parameter: "size", detail: "this species cannot be so large" }],
            }),
        }),
    );
    await slider(page, "size").focus();
    await page.keyboard.press("End");
    await page
        .locator('.control[data-name="size"] .validation-error', { hasText: "cannot be so large" })
        .waitFor();
    assert.match(
        await page.locator("#problem").textContent(),
        /Impossible.*1 parameter does not fit/,
    );
    await assert.rejects(
        page.evaluate(() => window.sporeprint.ready()),
        /Impossible/,
    );
    assert.deepEqual(await page.evaluate(() => window.sporeprint.counts), shown);
    await page.unroute(/\/v1\/mushrooms\/[^/]+\.glb/);
    await page.keyboard.press("Home");
    await ready(page);
    assert.ok(await page.locator("#problem").isHidden());
});

test("the API page shows every route of the description", async (t) => {
    const context = await browser.newContext({ viewport: { width: 1100, height: 800 } });
    t.after(() => context.close());
    const page = await context.newPage();
    const log = logEvents(page);
    await page.goto(`${base}/docs`);
    await page.waitForFunction(() => document.documentElement.dataset.docs === "complete");
    const { paths } = await (await fetch(`${base}/openapi.json`)).json();
    const text = await page.locator("main").textContent();
    for (const route of Object.keys(paths)) assert.ok(text.includes(route), `${route} is shown`);
    assert.match(text, /0 to 1/);
    await page.screenshot({ path: path.join(folder, "docs.png") });
    await page.setViewportSize({ width: 360, height: 740 });
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 360);
    expectNoProblems(log);
});

test("the search narrows the gallery, and Escape shows all of it again", async (t) => {
    const { page, log } = await open(t);
    const shown = () =>
        page
            .locator("#gallery li:not([hidden]) button")
            .evaluateAll((all) => all.map((one) => one.dataset.species));
    const [first] = species;
    await page.locator("#find").fill(first.scientific_name.toUpperCase());
    assert.deepEqual(await shown(), [first.id]);
    assert.equal(await page.locator("#found").textContent(), `1 of ${species.length}`);
    await page.locator("#find").fill("no such fungus");
    assert.deepEqual(await shown(), []);
    await page.locator("#find").press("Escape");
    assert.equal((await shown()).length, species.length);
    assert.equal(await page.locator("#found").textContent(), "");
    expectNoProblems(log);
});
