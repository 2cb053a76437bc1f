// Tests of the page of worlds in headless Chromium, against a server with every species (SPOREPRINT_ALL_URL or
// SPOREPRINT_URL).
import assert from "node:assert/strict";
import path from "node:path";
import test, { after, before } from "node:test";
import { addressOf, PageOfItsOwn, patience, screenshotFolder } from "./support.mjs";

const beech = "?world=beech,seed=7&x=24&y=-10&year=80&day=270";

const own = new PageOfItsOwn("world", beech, { viewport: { width: 1180, height: 760 }, permissions: ["clipboard-read", "clipboard-write"] });
const openAlone = own.openAlone.bind(own);
const open = own.open.bind(own);
const at = own.at.bind(own);
const { base } = own;

before(() => own.launch());

after(() => own.close());

/** Does something, and waits until the page shows what follows from it. */
async function settled(page, act) {
    await act();
    await at(page, "ready");
}

const shown = (page) => page.evaluate(() => window.worlds.shown());
const state = (page) => page.evaluate(() => ({ ...window.worlds.state, hidden: [...window.worlds.state.hidden] }));

/** Returns how many colours are drawn on the stage. */
const coloursOf = (page) =>
    page.locator("#canvas").evaluate(
        (canvas) =>
            new Promise((resolve) => {
                // The picture can be read in the frame in which it is drawn.
                const take = () => {
                    const small = new OffscreenCanvas(160, 100);
                    const context = small.getContext("2d");
                    context.drawImage(canvas, 0, 0, 160, 100);
                    const { data } = context.getImageData(0, 0, 160, 100);
                    resolve(new Set(new Uint32Array(data.buffer)).size);
                };
                const { frames } = window.worlds.renderer;
                const wait = () => (window.worlds.renderer.frames > frames ? take() : requestAnimationFrame(wait));
                canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft" }));
                requestAnimationFrame(wait);
            }),
    );

function assertQuiet({ console: lines, failed }) {
    assert.deepEqual(failed, []);
    assert.deepEqual(lines.filter((line) => /^(error|warning|uncaught)/.test(line)), []);
}

test("a world is shown with its plot, its year, a map and the fruit bodies by name", async () => {
    const { page, log } = await open();
    assert.equal(await page.locator("#world-name").textContent(), "Beech wood");
    assert.equal(await page.locator("#world-time").textContent(), "27 Sep, year 80");
    const files = await shown(page);
    for (const layer of ["ground", "trees", "floor", "fungi"])
        assert.match(files[layer], new RegExp(`^v1/worlds/beech,seed=7/y80d270/plot\\.glb\\?x=24&y=-10&size=10&layers=${layer}&`));
    assert.ok((await coloursOf(page)) > 500);
    assert.ok((await page.locator(".curves .area").count()) > 0, "species fruit in that year");
    assert.ok((await page.locator(".curves .rain").getAttribute("d")).length > 500);
    const facts = await (await fetch(`${base}/v1/worlds/beech,seed=7/y80d270/plot.json?x=24&y=-10`)).json();
    assert.ok(facts.fruit_bodies.length > 0);
    const found = facts.fruit_bodies.length;
    assert.equal(await page.locator("#found-count").textContent(), `${found} fruit ${found === 1 ? "body" : "bodies"} on this plot`);
    const { species } = await (await fetch(`${base}/v1/worlds/beech,seed=7/season.json?year=80&bbox=0,-64,64,0`)).json();
    const counts = Object.fromEntries(species.map(({ id, standing }) => [id, standing[269]]));
    for (const row of await page.locator("#season-legend li").all())
        assert.equal(await row.locator("b").textContent(), String(counts[await row.getAttribute("data-species")]));
    assertQuiet(log);
});

test("the slider of the day brings other fungi, at first them alone", async () => {
    const { page, log } = await open();
    const before = await shown(page);
    log.requests.length = 0;
    await page.locator("#day").evaluate((slider) => {
        slider.value = "285";
        slider.dispatchEvent(new Event("input", { bubbles: true }));
    });
    await page.waitForFunction(() => /y80d285/.test(window.worlds.shown().fungi), undefined, { timeout: patience });
    const dragged = await shown(page);
    assert.deepEqual({ ...dragged, fungi: "" }, { ...before, fungi: "" });
    const files = log.requests.filter((url) => url.includes("plot.glb"));
    assert.ok(files.length > 0 && files.every((url) => url.includes("layers=fungi")), files.join("\n"));
    assert.equal(await page.locator("#world-time").textContent(), "12 Oct, year 80");
    await settled(page, () => page.locator("#day").dispatchEvent("change"));
    for (const address of Object.values(await shown(page))) assert.match(address, /y80d285/);
    assert.match((await addressOf(page)).href, /day=285/);
    assertQuiet(log);
});

test("a click on the graph of the year sets the day, and the number of the day can be typed", async () => {
    const { page, log } = await open();
    const { width } = await page.locator("#season").boundingBox();
    await settled(page, () => page.locator("#season").click({ position: { x: 30 + ((200 - 0.5) / 365) * (width - 60), y: 60 } }));
    assert.equal((await state(page)).day, 200);
    assert.equal(await page.locator("#day").inputValue(), "200");
    assert.match(await page.locator("#season-text").textContent(), /^19 Jul · -?[\d.]+ °C · rain [\d.]+ mm · \d+ fruit bod/);
    await settled(page, async () => {
        await page.locator("#day-number").fill("300");
        await page.locator("#day-number").press("Enter");
    });
    assert.equal((await state(page)).day, 300);
    await settled(page, async () => {
        await page.locator("#year").focus();
        await page.keyboard.press("ArrowRight");
    });
    assert.equal((await state(page)).year, 81);
    await settled(page, () => page.goBack());
    assert.deepEqual([(await state(page)).year, (await state(page)).day], [80, 300]);
    assertQuiet(log);
});

test("a click on the map moves the view there, arrows move it on, and other maps are shown", async () => {
    const { page, log } = await open();
    const frame = page.locator("#map-frame");
    await frame.scrollIntoViewIfNeeded();
    const { width, height } = await frame.boundingBox();
    await settled(page, () => frame.click({ position: { x: width * 0.75, y: height * 0.25 } }));
    const moved = await state(page);
    assert.ok(Math.abs(moved.x - 256) < 6 && Math.abs(moved.y - 256) < 6, `${moved.x}, ${moved.y}`);
    assert.ok((await shown(page)).ground.includes(`x=${moved.x}&y=${moved.y}`));
    await settled(page, () => frame.press("ArrowLeft"));
    assert.ok(Math.abs((await state(page)).x - (moved.x - 10.24)) < 0.02);
    const { maps } = await (await fetch(`${base}/v1/worlds/beech,seed=7.json`)).json();
    assert.deepEqual(await page.locator("#map-choice option").evaluateAll((all) => all.map(({ value }) => value)), Object.keys(maps));
    for (const map of ["wetness", "spores", "terrarium"]) {
        await page.locator("#map-choice").selectOption(map);
        await page.waitForFunction((name) => document.getElementById("map-frame").dataset.map?.includes(`/maps/${name}`), map, { timeout: patience });
        await at(page, "ready");
    }
    assert.match((await addressOf(page)).href, /map=terrarium/);
    await page.locator("#map-choice").selectOption("spores");
    await page.locator("#map-species").selectOption("boletus_edulis");
    await page.waitForFunction(() => document.getElementById("map-frame").dataset.map?.includes("species=boletus_edulis"), undefined, { timeout: patience });
    // The place under the pointer in the view is on the map.
    const middle = await page.evaluate(() => window.worlds.pixelOf(window.worlds.state.x, window.worlds.state.y));
    await page.mouse.move(middle.x, middle.y);
    await page.waitForFunction(() => document.querySelector("#map-overlay .cursor").style.display === "", undefined, { timeout: patience });
    await page.locator("#map-choice").selectOption("height");
    assertQuiet(log);
});

test("a click on the ground says what keeps each species from fruiting there, in the service's words", async () => {
    const { page, log } = await open();
    const at = await page.evaluate(() => window.worlds.pixelOf(21, -7));
    await settled(page, () => page.mouse.click(at.x, at.y));
    const { why } = await state(page);
    assert.ok(why && Math.hypot(why[0] - 21, why[1] + 7) < 1.5, String(why));
    const limits = await (await fetch(`${base}/v1/worlds/beech,seed=7/y80d270/limits.json?x=${why[0]}&y=${why[1]}`)).json();
    const rows = page.locator("#why-list li");
    assert.equal(await rows.count(), limits.species.length);
    for (const { id, why: words } of limits.species)
        assert.equal(await page.locator(`#why-list li[data-species="${id}"] p`).textContent(), words);
    // On another day the reasons are others.
    await settled(page, async () => {
        await page.locator("#day-number").fill("20");
        await page.locator("#day-number").press("Enter");
    });
    assert.equal(await page.locator('#why-list li[data-species="boletus_edulis"]').getAttribute("data-verdict"), "no");
    assertQuiet(log);
});

test("a click on a mushroom shows its species and the address of its model", async () => {
    const place = "x=114&y=27";
    const [facts, centre] = await Promise.all(
        ["plot", "limits"].map(async (file) => (await fetch(`${base}/v1/worlds/beech/y80d285/${file}.json?${place}`)).json()),
    );
    const cep = facts.fruit_bodies.find(({ species }) => species === "boletus_edulis");
    const [x, y, height] = cep.place_m;
    // The camera is a metre south of it, and looks at it.
    const local = [x - 114, height - centre.place_m[2] + cep.above_ground_m, 27 - y];
    const look = [local[0], local[1] + 0.7, local[2] + 1, local[0], local[1] + 0.04, local[2]];
    const { page, log } = await open(`?world=beech&${place}&year=80&day=285&hide=trees,floor&look=${look.map((one) => one.toFixed(2))}`);
    const above = await page.evaluate((at) => window.worlds.pixelOf(...at), [x, y, cep.above_ground_m + 0.03]);
    await settled(page, () => page.mouse.click(above.x, above.y));
    await page.locator("#body-card").waitFor();
    assert.match(await page.locator("#body-card b").textContent(), /^Cep$/);
    const model = await page.locator("#body-card code").textContent();
    assert.match(model, /^\/v1\/mushrooms\/[a-z_]+\.glb\?seed=\d+&age=[\d.]+&substrate=none$/);
    assert.equal((await fetch(base + model, { method: "HEAD" })).status, 200);
    assert.equal(await page.locator("#body-link").getAttribute("href"), model.replace("/v1/mushrooms/", "./?species=").replace(".glb?", "&"));
    assertQuiet(log);
});

test("an address restores the world, the place, the time, the layers, the map and the camera", async () => {
    const world = "world=spruce,seed=3,climate.rain=1200,fungi.species=boletus_edulis%2Bcantharellus_cibarius";
    const query = `?${world}&x=-40&y=60&year=120&day=250&size=12&hide=trees&map=wetness&why=-40,60&look=3,2,5,0,0.3,0`;
    const { page, log } = await openAlone(query);
    assert.equal((await addressOf(page)).search, query, "the address stays as it was");
    assert.equal(await page.locator("#preset").inputValue(), "spruce");
    assert.equal(await page.locator("#control-climate\\.rain-number").inputValue(), "1200");
    assert.deepEqual(await page.locator(".chips li").allTextContents(), ["Cep×", "Chanterelle×"]);
    assert.equal(await page.locator("#why-list li").count(), 2);
    assert.equal(await page.locator('[data-layer="trees"]').isChecked(), false);
    assert.equal(await page.locator("#map-choice").inputValue(), "wetness");
    assert.deepEqual((await state(page)).look, [3, 2, 5, 0, 0.3, 0]);
    await page.locator("#copy-page").click();
    const copied = await page.evaluate(() => navigator.clipboard.readText());
    assert.equal(copied, (await addressOf(page)).href);
    await page.locator("#copy-resource").click();
    await page.locator("#notice", { hasText: "URL copied" }).waitFor();
    const resource = await page.evaluate(() => navigator.clipboard.readText());
    assert.match(resource, /\/v1\/worlds\/spruce,seed=3,.*,v=[^/]+\/y120d250\/plot\.glb\?.*layers=ground\+floor\+fungi|layers=ground%2Bfloor%2Bfungi/);
    assert.equal((await fetch(resource, { method: "HEAD" })).status, 200);
    await page.context().close();
    assertQuiet(log);
});

test("a parameter that is changed makes another world, and a refused one is named beside its control", async () => {
    const { page, log } = await open();
    await page.locator("#parameters details").evaluateAll((all) => all.forEach((one) => (one.open = true)));
    await settled(page, async () => {
        await page.locator("#control-climate\\.rain-number").fill("300");
        await page.locator("#control-climate\\.rain-number").press("Enter");
    });
    assert.match((await shown(page)).ground, /^v1\/worlds\/beech,seed=7,climate\.rain=300\//);
    assert.match((await addressOf(page)).href, /world=beech,seed=7,climate\.rain=300/);
    await settled(page, () => page.locator(".chips button").first().click());
    assert.equal(await page.locator(".chips li").count(), 11);
    assertQuiet(log);
    await page.locator("#control-stand\\.kinds").fill("palm");
    await page.locator("#control-stand\\.kinds").press("Enter");
    await at(page, "failed");
    assert.match(await page.locator('[data-name="stand.kinds"] .validation-error').textContent(), /unknown tree 'palm'/);
    assert.equal(await page.locator("#problem").isVisible(), true);
    await settled(page, () => page.locator("#preset").selectOption("meadow"));
    assert.equal(await page.locator("#problem").isVisible(), false);
    assert.equal(await page.locator("#world-name").textContent(), "Meadow");
});

test("a world stands on a terrain that is sent, and on grown hills again", async () => {
    const { page, log } = await open("?world=meadow,seed=7,extent=256,terrain.relief=20&x=20&y=-5&year=80&day=270");
    // Heights of another world are a file like any other.
    const heights = await (await fetch(`${base}/v1/worlds/spruce,seed=3,extent=256/y80/maps/height.png?size=129`)).arrayBuffer();
    await page.locator("#own-terrain summary").click();
    await page.setInputFiles("#terrain-file", { name: "hills.png", mimeType: "image/png", buffer: Buffer.from(heights) });
    await page.fill("#terrain-metres", "256");
    await page.fill("#terrain-max", "35");
    await settled(page, () =>
        Promise.all([page.waitForResponse((response) => response.url().includes("terrain.id=t-") && response.url().includes("plot.glb")), page.click("#terrain-use")]),
    );
    await page.waitForFunction(() => document.querySelector("#terrain-about").textContent.startsWith("129 × 129 heights over 256 m"));
    const address = (await addressOf(page)).searchParams.get("world");
    assert.match(address, /^meadow,seed=7,extent=256,terrain\.id=t-[0-9a-f]{32}$/, "what has no meaning beside it is gone");
    assert.deepEqual(log.failed, []);
    await settled(page, () => page.click("#terrain-none"));
    assert.equal((await addressOf(page)).searchParams.get("world"), "meadow,seed=7,extent=256");

    await page.fill("#terrain-max", "9000");
    await page.fill("#terrain-metres", "16");
    await page.click("#terrain-use");
    await page.waitForFunction(() => document.querySelector("#problem").textContent.includes("steeper than 80 degrees"));
    await page.locator("#own-terrain summary").click();
});

test("layers go and come without a request, and the saved plot has those that are on", async () => {
    const { page, log } = await open();
    const drawn = await page.evaluate(() => window.worlds.renderer.frames);
    await page.locator("#canvas").press("ArrowLeft");
    await page.waitForFunction((old) => window.worlds.renderer.frames > old, drawn, { timeout: patience });
    const before = await page.evaluate(() => window.worlds.renderer.triangles);
    log.requests.length = 0;
    await page.locator('[data-layer="trees"]').uncheck();
    await page.locator('[data-layer="floor"]').uncheck();
    await page.waitForFunction((old) => window.worlds.renderer.triangles < old, before, { timeout: patience });
    assert.deepEqual(log.requests.filter((url) => url.includes("/v1/")), []);
    assert.match((await addressOf(page)).href, /hide=trees,floor/);
    const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#download").click()]);
    assert.match(download.suggestedFilename(), /\.glb$/);
    assert.ok(log.requests.at(-1).includes("layers=ground+fungi"));
    assertQuiet(log);
});

test("one walks and flies through tiles, and a new day replaces the tiles of the fungi alone", async () => {
    const query = "?world=beech,seed=7,extent=256&x=20&y=-5&year=80&day=270&view=walk";
    const { page, log } = await openAlone(query, { width: 700, height: 520 });
    const before = await shown(page);
    for (const layer of ["ground", "trees", "floor"])
        assert.equal(before[layer], `v1/worlds/beech,seed=7,extent=256/web/y80m9/${layer}/tileset.json`);
    assert.equal(before.fungi, "v1/worlds/beech,seed=7,extent=256/web/y80d270/fungi/tileset.json");
    assert.ok((await page.evaluate(() => window.worlds.renderer.triangles)) > 10_000);
    log.requests.length = 0;
    await settled(page, () => page.locator("#day").evaluate((slider) => {
        slider.value = "273";
        slider.dispatchEvent(new Event("input", { bubbles: true }));
    }));
    await page.waitForFunction(() => /y80d273/.test(window.worlds.shown().fungi), undefined, { timeout: patience });
    assert.deepEqual({ ...(await shown(page)), fungi: "" }, { ...before, fungi: "" });
    const tiles = log.requests.filter((url) => /\.(glb|subtree)$|tileset\.json$/.test(url));
    assert.ok(tiles.length > 0 && tiles.every((url) => url.includes("/y80d273/fungi/")), tiles.join("\n"));
    await settled(page, () => page.locator("#day").dispatchEvent("change"));
    // W walks to the north, and the address follows.
    await page.locator("#canvas").focus();
    await page.keyboard.down("w");
    await page.waitForTimeout(1200);
    await page.keyboard.up("w");
    await page.waitForFunction(() => window.worlds.state.y > -4.9, undefined, { timeout: patience });
    await at(page, "ready");
    const walked = await state(page);
    assert.equal(walked.look[2], 1.6, "at the height of eyes");
    assert.match((await addressOf(page)).href, /view=walk/);
    await settled(page, () => page.locator('[data-view="fly"]').click());
    await page.locator("#canvas").focus();
    await page.keyboard.down("e");
    await page.waitForTimeout(1200);
    await page.keyboard.up("e");
    await page.waitForFunction(() => window.worlds.state.look?.[2] > 4.2, undefined, { timeout: patience });
    await settled(page, () => page.locator("#why-here").click());
    assert.ok((await page.locator("#why-list li").count()) > 0);
    await settled(page, () => page.locator("#map-frame").press("ArrowRight"));
    assert.ok(Math.abs((await state(page)).x - walked.x - 2.56) < 0.1);
    await settled(page, () => page.locator('[data-view="plot"]').click());
    assert.match((await shown(page)).ground, /plot\.glb/);
    await page.context().close();
    assertQuiet(log);
});

test("a narrow window has everything in one column, and nothing is wider than it", async () => {
    const { page, log } = await openAlone(beech, { width: 360, height: 740 });
    const wide = await page.evaluate(() =>
        [...document.querySelectorAll("body *")]
            .filter((one) => one.getBoundingClientRect().right > innerWidth + 1 && !one.closest("svg, .status, .skip, [hidden]"))
            .map((one) => one.id || one.className || one.tagName),
    );
    assert.deepEqual(wide, []);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    const top = async (selector) => (await page.locator(selector).boundingBox()).y;
    assert.ok((await top("#stage")) < (await top("#season")) && (await top("#season")) < (await top("#map-frame")));
    assert.ok((await top("#why")) < (await top("#preset")));
    await page.screenshot({ path: path.join(await screenshotFolder(), "world_narrow.png"), fullPage: true });
    await page.context().close();
    assertQuiet(log);
});

test("by keyboard alone: another day, another map, and why", async () => {
    const { page, log } = await open();
    await page.locator("body").evaluate(() => document.activeElement?.blur());
    const tabTo = async (selector) => {
        for (let presses = 0; presses < 120; ++presses) {
            if (await page.evaluate((wanted) => document.activeElement?.matches(wanted), selector)) return;
            await page.keyboard.press("Tab");
        }
        assert.fail(`Tab never comes to ${selector}`);
    };
    await tabTo("#canvas");
    const frames = await page.evaluate(() => window.worlds.renderer.frames);
    await page.keyboard.press("ArrowRight");
    await page.waitForFunction((old) => window.worlds.renderer.frames > old, frames, { timeout: patience });
    await tabTo("#why-here");
    await settled(page, () => page.keyboard.press("Enter"));
    assert.ok((await page.locator("#why-list li").count()) > 0);
    await tabTo("#day");
    await settled(page, () => page.keyboard.press("ArrowRight"));
    assert.equal((await state(page)).day, 271);
    await tabTo("#map-choice");
    await settled(page, () => page.keyboard.press("ArrowDown"));
    assert.notEqual((await state(page)).map, "height");
    assertQuiet(log);
});

test("the navigation leads to worlds and back, and the page says what it is not for", async () => {
    const { page } = await open();
    assert.match(await page.locator("footer").textContent(), /never for identifying mushrooms to eat/);
    assert.deepEqual(
        await page.locator("header nav a").evaluateAll((all) => all.map((one) => one.getAttribute("href"))),
        ["./", "editor", "breed", "docs"],
    );
    for (const other of ["breed", "editor"])
        assert.match(await (await fetch(`${base}/${other}`)).text(), /<a href="world">Worlds<\/a>/);
});
