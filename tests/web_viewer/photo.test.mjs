// Tests of what makes a photograph of the model: lights, close-ups, depth of field, saved pictures.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import test, { after, before } from "node:test";
import { launchBrowser, logEvents, parameters, ready, reload, serverUrl } from "./support.mjs";

const base = serverUrl();
const plain = "lod=2&texture_size=128";
const agaric = `species=amanita_muscaria&${plain}`;
/** What close-ups show. */
const metresOf = { margin: 0.05, underside: 0.06, base: 0.08 };
/** Depth of field is many pictures: they are small here. */
const small = { width: 380, height: 300 };
const noPicture = '<svg xmlns="http://www.w3.org/2000/svg"/>';
let browser;
let shared;

before(async () => {
    browser = await launchBrowser();
    shared = await browser.newContext({
        viewport: { width: 760, height: 500 },
        reducedMotion: "reduce",
    });
});

after(() => browser?.close());

/** Opens the page without pictures in its gallery, which take longer than all else here. */
async function open(t, query, viewport = undefined) {
    const page = await shared.newPage();
    t.after(() => page.close());
    if (viewport) await page.setViewportSize(viewport);
    await page.route(/\/v1\/mushrooms\/\w+\.png/, (route) =>
        route.fulfill({ contentType: "image/svg+xml", body: noPicture }),
    );
    const log = logEvents(page);
    await page.goto(`${base}/?${query}`);
    await ready(page);
    return { page, log };
}

const view = (page, name) => page.locator(`[data-view="${name}"]`);
const frame = (page) => page.evaluate(() => window.sporeprint.frame);
const shorter = ({ width, height }) => Math.min(width, height);

function expectNoProblems(log) {
    assert.deepEqual(log.console, []);
    assert.deepEqual(log.failed, []);
}

/** Returns the mean red, green and blue of the stage, 0 to 255, and the mean difference between
 *  neighbours, which is the less the more is blurred; read in the task that has drawn it. */
function measured(page) {
    return page.evaluate(async () => {
        await window.sporeprint.ready();
        const drawn = document.querySelector("#canvas");
        const { width, height } = drawn;
        const canvas = new OffscreenCanvas(width, height).getContext("2d");
        canvas.drawImage(drawn, 0, 0);
        const { data } = canvas.getImageData(0, 0, width, height);
        const sums = [0, 0, 0, 0];
        let detail = 0;
        for (let at = 0; at < data.length; at += 4) {
            for (let channel = 0; channel < 4; ++channel) sums[channel] += data[at + channel];
            if ((at / 4) % width) detail += Math.abs(data[at + 1] - data[at - 3]);
        }
        const pixels = width * height;
        const [red, green, blue, alpha] = sums.map((sum) => sum / pixels);
        return { red, green, blue, alpha, detail: detail / pixels };
    });
}

const brightness = ({ red, green, blue }) => 0.2126 * red + 0.7152 * green + 0.0722 * blue;
const warmth = ({ red, blue }) => red / blue;

test("light passes through the thin flesh of a rich file alone", async (t) => {
    const seen = async (species, materials) => {
        const query = `species=${species}&${plain}&light=backlight&materials=${materials}`;
        const { page, log } = await open(t, query);
        const found = brightness(await measured(page));
        expectNoProblems(log);
        await page.close();
        return found;
    };
    const [full, rich] = [
        await seen("mycena_sanguinolenta", "full"),
        await seen("mycena_sanguinolenta", "rich"),
    ];
    // The means are of the whole stage, of which the slender bonnet is little.
    assert.ok(rich > full + 0.04, `${rich} ${full}`);
    const [opaque, stillOpaque] = [
        await seen("trametes_versicolor", "full"),
        await seen("trametes_versicolor", "rich"),
    ];
    assert.ok(Math.abs(stillOpaque - opaque) < 0.01, `${stillOpaque} ${opaque}`);
});

test("each light changes brightness and colour as named, and survives a reload", async (t) => {
    const { page, log } = await open(t, agaric);
    assert.equal(await page.locator("#light").inputValue(), "daylight");
    const seen = { daylight: await measured(page) };
    for (const light of ["overcast", "studio", "backlight", "dusk"]) {
        await page.locator("#light").selectOption(light);
        seen[light] = await measured(page);
        assert.equal((await parameters(page)).get("light"), light);
        assert.equal(seen[light].alpha, 255, "the background is a part of the picture");
    }
    const bright = Object.fromEntries(
        Object.entries(seen).map(([light, colour]) => [light, brightness(colour)]),
    );
    const numbers = JSON.stringify(seen);
    assert.ok(bright.daylight > bright.overcast + 40, numbers);
    assert.ok(bright.studio > bright.overcast + 40, numbers);
    assert.ok(bright.overcast > bright.dusk + 10, numbers);
    assert.ok(bright.backlight > bright.dusk + 10, numbers);
    assert.ok(warmth(seen.backlight) > warmth(seen.overcast) + 0.05, numbers);
    assert.ok(warmth(seen.overcast) > warmth(seen.dusk) + 0.1, numbers);
    assert.ok(warmth(seen.dusk) < 1, numbers);
    assert.ok(Math.abs(warmth(seen.studio) - 1) < 0.06, numbers);

    await reload(page, log);
    await ready(page);
    assert.equal(await page.locator("#light").inputValue(), "dusk");
    const again = await measured(page);
    assert.ok(Math.abs(brightness(again) - bright.dusk) < 1, `${brightness(again)} ${bright.dusk}`);
    await page.locator("#light").selectOption("daylight");
    assert.equal(
        (await parameters(page)).get("light"),
        null,
        "the usual light is not in the address",
    );
    assert.ok(Math.abs(brightness(await measured(page)) - bright.daylight) < 1);
    expectNoProblems(log);
});

test("close-ups show margin, underside and base in their sizes, by button and key", async (t) => {
    const { page, log } = await open(t, agaric);
    const size = await page.evaluate(() => window.sporeprint.size);
    const whole = await frame(page);
    assert.ok(shorter(whole) > size.above, "the whole mushroom is shown first");
    const seen = {};
    for (const [name, metres] of Object.entries(metresOf)) {
        await view(page, name).click();
        await page.evaluate(() => window.sporeprint.ready());
        seen[name] = await frame(page);
        const shown = shorter(seen[name]);
        assert.ok(Math.abs(shown / metres - 1) < 0.1, `${name}: ${shown} m`);
        assert.equal((await parameters(page)).get("view"), name);
        assert.equal(await view(page, name).getAttribute("aria-pressed"), "true");
    }
    const [margin, underside, foot] = Object.keys(metresOf).map((name) => seen[name].target);
    const radius = Math.hypot(margin[0], margin[2]);
    assert.ok(Math.abs(radius / (size.width / 2) - 1) < 0.3, `${margin}`);
    assert.ok(margin[1] > size.above * 0.5 && margin[1] < size.above, `${margin}`);
    assert.ok(Math.hypot(underside[0], underside[2]) < radius);
    assert.ok(underside[1] > size.above * 0.5 && underside[1] < size.above, `${underside}`);
    assert.ok(Math.hypot(foot[0], foot[2]) < 0.02 && foot[1] < 0.04, `${foot}`);

    await page.locator("#canvas").focus();
    const key = await view(page, "margin").getAttribute("aria-keyshortcuts");
    await page.keyboard.press(key);
    assert.equal((await parameters(page)).get("view"), "margin");
    await reload(page, log);
    await ready(page);
    assert.deepEqual((await frame(page)).target, margin, "an address opens with its close-up");
    assert.ok(Math.abs(shorter(await frame(page)) / 0.05 - 1) < 0.1);

    await page.locator("#canvas").focus();
    await page.keyboard.press("ArrowLeft");
    assert.equal(
        (await parameters(page)).get("view"),
        null,
        "a camera that was turned has no name",
    );
    assert.equal(await view(page, "margin").getAttribute("aria-pressed"), "false");
    await page.keyboard.press("Home");
    assert.ok(Math.abs(shorter(await frame(page)) / shorter(whole) - 1) < 0.01);
    expectNoProblems(log);
});

test("a close-up that a form does not have is disabled and says why", async (t) => {
    const { page, log } = await open(t, `species=clavariadelphus_pistillaris&view=margin&${plain}`);
    assert.ok(await view(page, "margin").isDisabled());
    assert.match(await view(page, "margin").getAttribute("title"), /A club has no margin/);
    assert.ok(await view(page, "underside").isDisabled());
    assert.ok(await view(page, "base").isEnabled());
    assert.equal((await parameters(page)).get("view"), null);
    const size = await page.evaluate(() => window.sporeprint.size);
    assert.ok(shorter(await frame(page)) > size.above, "the whole is shown instead");
    expectNoProblems(log);

    const { page: tree, log: ofTree } = await open(t, "tree=birch&lod=3&texture_size=128");
    assert.match(await view(tree, "margin").getAttribute("title"), /A tree has no margin/);
    await view(tree, "base").click();
    assert.ok(Math.abs(shorter(await frame(tree)) / 0.8 - 1) < 0.1, "the foot of its trunk");
    expectNoProblems(ofTree);
});

test("a small bracket, a leaf and a colony have close-ups of their own sizes", async (t) => {
    const { page, log } = await open(t, `species=trametes_versicolor&view=margin&${plain}`);
    const size = await page.evaluate(() => window.sporeprint.size);
    const most = 0.7 * Math.max(size.width, size.height, size.depth);
    const shown = await frame(page);
    assert.ok(Math.abs(shorter(shown) / Math.min(0.05, most) - 1) < 0.1, `${shorter(shown)} m`);
    assert.ok(shown.target[2] > 0, "the margin is away from the wood");
    expectNoProblems(log);

    const { page: leaf, log: ofLeaf } = await open(t, `leaf=maple&view=margin&${plain}`);
    const blade = await leaf.evaluate(() => window.sporeprint.size);
    const { target } = await frame(leaf);
    assert.ok(target[0] > blade.width * 0.2, `${target} of ${blade.width}`);
    assert.ok(Math.abs(shorter(await frame(leaf)) / 0.05 - 1) < 0.1);
    expectNoProblems(ofLeaf);

    const colony = `colony=amanita_muscaria&count=4&distinct=2&lod=3&texture_size=128`;
    const { page: many, log: ofMany } = await open(t, colony);
    for (const [name, metres] of Object.entries(metresOf)) {
        await view(many, name).click();
        assert.ok(Math.abs(shorter(await frame(many)) / metres - 1) < 0.1, name);
        const [x, y, z] = (await frame(many)).target;
        assert.ok(Math.hypot(x, z) > 0.02, `${name} is that of one individual: ${[x, y, z]}`);
    }
    expectNoProblems(ofMany);
});

test("depth of field is off at first, blurs what is not in focus, and comes to rest", async (t) => {
    const { page, log } = await open(t, `${agaric}&view=margin`, small);
    assert.equal(await page.locator("#depth").getAttribute("aria-pressed"), "false");
    assert.ok(await page.locator("#aperture").isHidden());
    const calls = () => page.evaluate(() => window.sporeprint.renderer.frames);
    const before_ = await calls();
    const sharp = await measured(page);
    assert.ok((await calls()) - before_ <= 2, "without it a frame is one picture");

    await page.locator("#depth").click();
    const blurred = await measured(page);
    assert.equal((await parameters(page)).get("aperture"), "4");
    assert.ok(blurred.detail < sharp.detail * 0.9, `${blurred.detail} of ${sharp.detail}`);
    assert.ok(Math.abs(brightness(blurred) - brightness(sharp)) < 4, "it is as bright");

    await page.locator("#aperture").focus();
    await page.keyboard.press("Home");
    const open_ = await measured(page);
    assert.equal((await parameters(page)).get("aperture"), "1.4");
    assert.equal(await page.locator("#aperture").getAttribute("aria-valuetext"), "f/1.4");
    assert.ok(open_.detail < blurred.detail, "a wider aperture blurs more");
    const rest = await calls();
    await page.waitForTimeout(700);
    assert.equal(await calls(), rest, "the final picture is not drawn again");

    await page.locator("#depth").click();
    assert.equal((await parameters(page)).get("aperture"), null);
    const off = await measured(page);
    assert.ok(Math.abs(off.detail - sharp.detail) < 0.01, "off is the picture of before");
    expectNoProblems(log);
});

/** Returns the differences between a PNG, made smaller, and the stage: mean of all channels. */
function difference(page, png) {
    return page.evaluate(async (data) => {
        await window.sporeprint.ready();
        const drawn = document.querySelector("#canvas");
        const { width, height } = drawn;
        const pixels = (image) => {
            const canvas = new OffscreenCanvas(width, height).getContext("2d");
            canvas.imageSmoothingQuality = "high";
            canvas.drawImage(image, 0, 0, width, height);
            return canvas.getImageData(0, 0, width, height).data;
        };
        const stage = pixels(drawn);
        const bytes = Uint8Array.from(atob(data), (sign) => sign.charCodeAt(0));
        const saved = pixels(await createImageBitmap(new Blob([bytes], { type: "image/png" })));
        const sum = stage.reduce((far, value, at) => far + Math.abs(value - saved[at]), 0);
        return sum / stage.length;
    }, png.toString("base64"));
}

test("a saved picture has twice the size of the stage and the same content", async (t) => {
    const { page, log } = await open(t, `${agaric}&seed=7&light=studio&view=underside`, small);
    for (const [depth, most] of [
        [false, 2],
        [true, 3],
    ]) {
        if (depth) await page.locator("#depth").click();
        await page.evaluate(() => window.sporeprint.ready());
        const [download] = await Promise.all([
            page.waitForEvent("download", { timeout: 120_000 }),
            page.locator("#picture").click(),
        ]);
        const name = download.suggestedFilename();
        assert.match(name, /^amanita_muscaria_s7_\w*underside_studio\.png$/);
        const png = await readFile(await download.path());
        assert.equal(png.toString("latin1", 1, 4), "PNG");
        const canvas = await page.evaluate(() => {
            const { width, height } = document.querySelector("#canvas");
            return [width, height];
        });
        assert.deepEqual(
            [png.readUInt32BE(16), png.readUInt32BE(20)],
            canvas.map((n) => 2 * n),
        );
        const far = await difference(page, png);
        assert.ok(far < most, `they differ by ${far} of 255`);
    }
    expectNoProblems(log);
});

test("a picture that is too large is refused in words, and the stage stays", async (t) => {
    const { page, log } = await open(t, agaric);
    const before_ = await measured(page);
    await page.evaluate(() => {
        HTMLCanvasElement.prototype.toBlob = (done) => done(null);
    });
    await page.locator("#picture").click();
    await page.locator("#problem").waitFor();
    const text = await page.locator("#problem").textContent();
    assert.match(text, /The picture could not be saved/);
    const [width, height] = await page.evaluate(() => {
        const canvas = document.querySelector("#canvas");
        return [canvas.width, canvas.height];
    });
    assert.ok(text.includes(`${2 * width} × ${2 * height} pixels`), text);
    assert.deepEqual(await measured(page), before_);
    assert.ok(await page.locator("#picture").isEnabled(), "it can be tried again");
    expectNoProblems(log);
});
