// Tests of growth on the page, in headless Chromium against a running server (SPOREPRINT_URL).
import assert from "node:assert/strict";
import path from "node:path";
import test, { after, before } from "node:test";
import {
    galleryComplete,
    launchBrowser,
    logEvents,
    parameters,
    ready,
    screenshotFolder,
    serverUrl,
} from "./support.mjs";

const base = serverUrl();
const species = "boletus_edulis";
let browser;
let shared; // the gallery's pictures are drawn once
let folder;

before(async () => {
    folder = await screenshotFolder();
    browser = await launchBrowser();
    shared = await browser.newContext({ viewport: { width: 960, height: 560 } });
});

after(() => browser?.close());

async function open(t, query = "", reducedMotion = "no-preference") {
    const page = await shared.newPage();
    t.after(() => page.close());
    await page.emulateMedia({ reducedMotion });
    const log = logEvents(page);
    await page.goto(`${base}/?species=${species}${query}`);
    await ready(page);
    return { page, log };
}

const growth = (page) => page.evaluate(() => window.sporeprint.growth);
const clips = (log) =>
    log.requests
        .filter((url) => /\.glb\?.*animation=growth/.test(url))
        .map((url) => new URL(url).searchParams);
/** Returns the query of the last requested model. */
const lastModel = (log) => new URL(log.requests.findLast((url) => /\.glb/.test(url))).searchParams;
const picture = (page) => page.locator("#stage").screenshot();

function expectNoProblems(log) {
    assert.deepEqual(log.console, []);
    assert.deepEqual(log.failed, []);
}

test("play requests a clip at LOD 1, and stopping requests the model of the age", async (t) => {
    const { page, log } = await open(t, "&seed=7");
    assert.deepEqual(clips(log), []);
    await page.locator("#play").focus();
    await page.keyboard.press("Enter");
    await page.waitForFunction(() => window.sporeprint.growth.playing);
    assert.deepEqual(
        clips(log).map((query) => [...query]),
        [
            [
                ["seed", "7"],
                ["lod", "1"],
                ["animation", "growth"],
            ],
        ],
    );
    assert.equal(await page.locator("#play").getAttribute("aria-label"), "Stay at this age");
    // In one task of the page, because the clip continues while a test reads.
    const seen = await page.evaluate(
        () =>
            new Promise((resolve) => {
                const ages = [];
                const look = () => {
                    const { age, playing } = window.sporeprint.growth;
                    ages.push(age);
                    if (playing && ages.length < 5) return requestAnimationFrame(look);
                    const sliderAge = Number(
                        document.querySelector('input[type=range][name="age"]').value,
                    );
                    const { search } = location;
                    document.querySelector("#play").click();
                    resolve({ ages, sliderAge, search, after: window.sporeprint.growth });
                };
                look();
            }),
    );
    assert.ok(
        seen.ages.every((age, i) => i === 0 || age >= seen.ages[i - 1]) &&
            seen.ages.at(-1) > seen.ages[0],
        `${seen.ages}`,
    );
    assert.ok(Math.abs(seen.sliderAge - seen.ages.at(-1)) < 0.01, "the slider follows");
    assert.ok(!seen.search.includes("age="), "playing changes no setting");
    assert.equal(seen.after.playing, false);
    await ready(page);
    const age = Number((await parameters(page)).get("age"));
    assert.ok(Math.abs(age - seen.ages.at(-1)) < 0.01, `stayed at ${age}`);
    assert.equal((await growth(page)).age, undefined, "the still mushroom stands there again");
    assert.deepEqual(
        [...lastModel(log)],
        [
            ["seed", "7"],
            ["age", String(age)],
        ],
    );
    expectNoProblems(log);
});

test("a clip lasts eight seconds, and then the mushroom of the settings is shown", async (t) => {
    const { page, log } = await open(t, "&lod=3");
    const before_ = await page.evaluate(() => window.sporeprint.counts.vertices);
    await page.locator("#play").click();
    await page.waitForFunction(() => window.sporeprint.growth.playing);
    assert.equal(clips(log)[0].get("lod"), "3", "no finer than what was chosen");
    // Measured on the page's own clock, because there may be few frames.
    const pace = await page.evaluate(
        () =>
            new Promise((resolve) => {
                let first;
                const look = (now) => {
                    const { age } = window.sporeprint.growth;
                    first ??= { now, age };
                    if (now - first.now < 2000) return requestAnimationFrame(look);
                    resolve((age - first.age) / ((now - first.now) / 1000));
                };
                requestAnimationFrame(look);
            }),
    );
    assert.ok(Math.abs(pace - 1 / 8) < 0.03, `${pace} lives a second`);
    await page.waitForFunction(() => window.sporeprint.growth.age === 1, undefined, {
        timeout: 30_000,
    });
    await ready(page);
    assert.equal((await growth(page)).age, undefined);
    assert.equal(await page.evaluate(() => window.sporeprint.counts.vertices), before_);
    assert.equal(await page.locator('input[type=number][name="age"]').inputValue(), "0.6");
    assert.equal((await parameters(page)).get("age"), null);
    expectNoProblems(log);
});

test("the age poses a loaded clip without a request until it stays the same", async (t) => {
    const { page, log } = await open(t, "&animation=growth&frames=5&lod=2");
    assert.deepEqual(
        clips(log).map((query) => [...query]),
        [
            [
                ["lod", "2"],
                ["animation", "growth"],
                ["frames", "5"],
            ],
        ],
    );
    assert.equal((await growth(page)).playing, false, "play was not pressed");
    assert.notEqual(await page.locator('.control[data-name="frames"]').getAttribute("hidden"), "");
    await galleryComplete(page);
    const still = await picture(page);
    const requestCount = () => log.requests.filter((url) => url.includes("/v1/")).length;
    const before_ = requestCount();
    const slider = page.locator('input[type=range][name="age"]');
    await slider.focus();
    for (let press = 0; press < 8; ++press) await page.keyboard.press("ArrowLeft");
    const { age } = await growth(page);
    assert.ok(Math.abs(age - Number(await slider.inputValue())) < 1e-9);
    assert.equal(requestCount(), before_);
    assert.notDeepEqual(await picture(page), still, "it has another shape");
    await ready(page);
    assert.equal(lastModel(log).get("age"), String(age));
    expectNoProblems(log);
});

test("the number of frames is neither shown nor sent without a clip", async (t) => {
    const { page, log } = await open(t, "&animation=growth&frames=5&lod=3&panel=export");
    await page.evaluate(() =>
        document.querySelectorAll("details").forEach((details) => (details.open = true)),
    );
    await page.locator('select[name="animation"]').selectOption("none");
    await ready(page);
    assert.equal(await page.locator('.control[data-name="frames"]').isVisible(), false);
    assert.equal((await parameters(page)).get("frames"), null);
    assert.equal(lastModel(log).get("frames"), null);
    expectNoProblems(log);
});

test("with reduced motion the clip is moved by the slider only", async (t) => {
    const { page, log } = await open(t, "&lod=2", "reduce");
    await page.locator("#play").click();
    await page.waitForFunction(() => document.activeElement?.name === "age");
    assert.match(await page.locator("#status").textContent(), /move the age/);
    await page.waitForTimeout(300);
    const { age, playing } = await growth(page);
    assert.deepEqual([age, playing], [undefined, false], "nothing moves by itself");
    await page.keyboard.press("Home");
    assert.equal((await growth(page)).age, 0);
    await page.screenshot({ path: path.join(folder, "growth-by-hand.png") });
    await ready(page);
    assert.equal((await parameters(page)).get("age"), "0");
    expectNoProblems(log);
});

test("playing repeatedly frees all memory of the graphics card", async (t) => {
    const { page } = await open(t, "&lod=3");
    const round = async () => {
        await page.locator("#play").click();
        await page.waitForFunction(() => window.sporeprint.growth.age > 0.02);
        await page.locator("#play").click();
        await ready(page);
        return page.evaluate(() => window.sporeprint.renderer);
    };
    const first = await round();
    await round();
    const last = await round();
    assert.equal(last.geometries, first.geometries);
    assert.equal(last.textures, first.textures);
});
