// Tests of the designer's library in headless Chromium, against a server with --library (SPOREPRINT_URL) and a
// token of it (SPOREPRINT_TOKEN).
import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { readFile } from "node:fs/promises";
import test, { after, before } from "node:test";
import {
    addressOf,
    galleryComplete,
    launchBrowser,
    logEvents,
    patience,
    ready,
    serverUrl,
} from "./support.mjs";

const base = serverUrl({ everySpecies: true });
const token = process.env.SPOREPRINT_TOKEN ?? "";
const headers = { Authorization: `Bearer ${token}`, "Content-Type": "application/json" };

let browser;
let hasLibrary;
let picture;

before(async () => {
    const { links } = await (await fetch(`${base}/v1`)).json();
    hasLibrary = "library" in links;
    if (hasLibrary) assert.match(token, /^spk_/, "SPOREPRINT_TOKEN is that of the server's library");
    browser = await launchBrowser();
    const query = "width=500&height=500&view=front&background=transparent";
    const response = await fetch(`${base}/v1/mushrooms/boletus_edulis.png?${query}`);
    picture = { name: "cep.png", mimeType: "image/png", buffer: Buffer.from(await response.arrayBuffer()) };
});

after(() => browser?.close());

/** Opens the designer with a picture that is cut out, so that it is traced at once. */
async function open(fragment = `#token=${token}`) {
    const context = await browser.newContext({ reducedMotion: "reduce", viewport: { width: 1000, height: 700 } });
    const page = await context.newPage();
    page.setDefaultTimeout(patience);
    page.on("dialog", (dialog) => void dialog.accept());
    const log = logEvents(page);
    await page.goto(`${base}/editor${fragment}`);
    await page.locator("#file").setInputFiles(picture);
    await page.waitForFunction(() => document.documentElement.dataset.designer === "ready", undefined, { timeout: patience });
    return { page, log };
}

async function save(page, name) {
    await page.locator("#library-name").fill(name);
    await page.locator("#library-save").click();
    await page.locator("#library-state", { hasText: "saved" }).waitFor();
}

/** Stores a built-in species in the library under another name; publishes it, if that is wanted. */
async function stored(id, name, { published = true } = {}) {
    const species = await (await fetch(`${base}/v1/species/${id}`)).json();
    const facts = { ...species.facts, common_name: `Own ${name}` };
    const body = JSON.stringify({ ...species, id: name, facts });
    const made = await fetch(`${base}/v1/library`, { method: "POST", headers, body });
    assert.equal(made.status, 201, await made.clone().text());
    if (!published) return;
    const { draft } = await made.json();
    const options = { method: "POST", headers: { ...headers, "If-Match": draft }, body: "{}" };
    const { status } = await fetch(`${base}/v1/library/~me.${name}/publish`, options);
    assert.equal(status, 201);
}

/** Moves focus with Tab until an element has it. */
async function tabTo(page, id) {
    for (let presses = 0; presses < 80; ++presses) {
        if (await page.evaluate((wanted) => document.activeElement?.id === wanted, id)) return;
        await page.keyboard.press("Tab");
    }
    assert.fail(`Tab never comes to #${id}`);
}

test("a picture becomes a published species and its address, by keyboard alone", async () => {
    const { page, log } = await open();
    assert.equal((await addressOf(page)).hash, "", "the token does not stay in the address");
    await page.locator("#tab-library").waitFor();
    await tabTo(page, "tab-found");
    await page.keyboard.press("ArrowLeft");
    assert.equal(await page.locator("#panel-library").isVisible(), true, "the last tab");
    await tabTo(page, "library-name");
    await page.keyboard.press("Control+A");
    await page.keyboard.type("cep_by_keys");
    await tabTo(page, "library-publish");
    await page.keyboard.press("Enter");
    const link = page.locator("#library-published .address");
    await link.waitFor();
    const address = await link.evaluate((anchor) => anchor.href);
    assert.equal(address, `${base}/v1/mushrooms/~me.cep_by_keys@1.glb`);
    const model = await fetch(`${address}?lod=3&textures=none`);
    assert.equal(model.status, 200);
    assert.equal(Buffer.from(await model.arrayBuffer()).subarray(0, 4).toString(), "glTF");
    const mix = await fetch(`${base}/v1/mushrooms/~me.cep_by_keys@1:0.5,amanita_muscaria:0.5.json`);
    assert.equal(mix.status, 200);
    assert.deepEqual(log.failed, []);
    assert.deepEqual(log.console.filter((line) => /^(error|uncaught)/.test(line)), []);
    await page.context().close();
});

test("of two writers of a draft the later one chooses, and nothing is lost", async () => {
    const { page } = await open();
    await page.locator("#tab-library").click();
    await save(page, "cep_of_two");
    const path = `${base}/v1/library/~me.cep_of_two`;
    const theirs = await (await fetch(path, { headers })).json();
    theirs.facts.common_name = "Theirs";
    const put = await fetch(path, { method: "PUT", headers: { ...headers, "If-Match": "*" }, body: JSON.stringify(theirs) });
    assert.equal(put.status, 200);
    // The height of the mushroom changes all of its outlines.
    await page.locator("#tab-found").click();
    await page.locator("#height").fill("77");
    await page.locator("#height").press("Enter");
    await page.locator("#tab-library").click();
    await page.locator("#library-conflict").waitFor({ timeout: patience });
    assert.equal((await (await fetch(path, { headers })).json()).facts.common_name, "Theirs");
    await page.getByRole("button", { name: "Save this one as cep_of_two_2" }).click();
    await page.locator("#library-state", { hasText: "cep_of_two_2" }).waitFor();
    assert.equal((await (await fetch(path, { headers })).json()).facts.common_name, "Theirs");
    assert.equal((await fetch(`${path}_2`, { headers })).status, 200);
    // A name that is taken: what was wanted is done after the choice, and the choice is gone.
    await page.locator("#library-name").fill("cep_of_two");
    await page.locator("#library-publish").click();
    await page.locator("#library-conflict", { hasText: "You have a species ~me.cep_of_two already." }).waitFor();
    await page.getByRole("button", { name: "Make this its next version" }).click();
    await page.locator("#library-published", { hasText: "~me.cep_of_two@1" }).waitFor();
    assert.ok(await page.locator("#library-conflict").isHidden());
    assert.notEqual((await (await fetch(path, { headers })).json()).facts.common_name, "Theirs");
    await page.context().close();
});

test("species of the library are listed and opened again; a wrong token is named", async () => {
    // Of a link whose end was lost nothing stays in the address.
    const { page } = await open("#token=spk_abcdefgh_AAA");
    assert.equal((await addressOf(page)).href, `${base}/editor`);
    await page.locator("#tab-library").click();
    await page.locator("#library-error", { hasText: "a token is spk_" }).waitFor();
    await page.locator("#token").fill("spk_");
    await page.locator("#token").press("Enter");
    await page.locator("#library-error", { hasText: "a token is spk_" }).waitFor();
    await page.locator("#token").fill(`spk_abcdefgh_${"A".repeat(43)}`);
    await page.locator("#token").press("Enter");
    await page.locator("#library-error", { hasText: "no such token" }).waitFor();
    await page.locator("#token").fill(token);
    await page.locator("#token").press("Enter");
    await page.locator("#library-desk").waitFor();
    await save(page, "cep_again");
    await page.locator("#library-publish").click();
    await page.locator("#library-published .address").waitFor();
    // A reload goes on with the same species of the library.
    await page.reload();
    await page.waitForFunction(() => document.documentElement.dataset.designer === "ready", undefined, { timeout: patience });
    await page.locator("#tab-library").click();
    assert.equal(await page.locator("#library-name").inputValue(), "cep_again");
    assert.match(await page.locator("#library-published .address").getAttribute("href"), /~me\.cep_again@1\.glb$/);
    await page.locator("[data-library='~me.cep_again']").click();
    await page.locator("#library-state", { hasText: "~me.cep_again · draft" }).waitFor();
    assert.equal(await page.locator("#library-name").inputValue(), "cep_again");
    await page.locator("#library-leave").click();
    assert.equal(await page.evaluate((text) => JSON.stringify({ ...sessionStorage, ...localStorage }).includes(text), token), false);
    await page.context().close();
});

test("the viewer shows what is published: by address, in the gallery and in mixes", async () => {
    await stored("boletus_edulis", "cep_in_lists");
    const context = await browser.newContext({ reducedMotion: "reduce", viewport: { width: 1100, height: 700 } });
    const page = await context.newPage();
    page.setDefaultTimeout(patience);
    const log = logEvents(page);
    await page.goto(`${base}/?species=~me.cep_in_lists&lod=3&textures=none`);
    await ready(page);
    assert.equal((await addressOf(page)).searchParams.get("species"), "~me.cep_in_lists@1");
    assert.equal(await page.locator("#common-name").textContent(), "Own cep_in_lists");
    await galleryComplete(page);
    const own = page.locator("#gallery [data-species='~me.cep_in_lists@1']");
    assert.equal(await own.getAttribute("aria-pressed"), "true");
    assert.equal(await own.locator("img").count(), 1);
    await page.locator("#find").fill("cep_in_lists");
    assert.equal(await page.locator("#gallery button[data-species]:visible").count(), 1);
    await page.locator("#find").fill("");
    await page.locator("#mode-morph").click();
    await page.locator("#gallery [data-species='russula_vinosa']").click();
    await ready(page);
    const morph = (await addressOf(page)).searchParams.get("morph");
    assert.match(morph, /^~me\.cep_in_lists@1:0\.5,russula_vinosa:0\.5$/);
    await page.goto(`${base}/?species=russula_vinosa:0.5,~me.cep_in_lists@1:0.5&lod=3&textures=none`);
    await ready(page);
    assert.equal(await page.locator("#common-name").textContent(), "Darkening brittlegill × Own cep_in_lists");
    assert.deepEqual(log.failed, []);
    await page.goto(`${base}/?species=~me.none_of_these&lod=3&textures=none`);
    await page.locator("#problem", { hasText: "~me.none_of_these" }).waitFor();
    await context.close();
});

test("the designer starts from species of the library, page by page, and from own drafts", async () => {
    await stored("amanita_muscaria", "agaric_draft", { published: false });
    for (const name of ["paged_a", "paged_b"]) await stored("boletus_edulis", name);
    const context = await browser.newContext({ reducedMotion: "reduce", viewport: { width: 1100, height: 700 } });
    const page = await context.newPage();
    page.setDefaultTimeout(patience);
    // Pages are made of one species, so that there are some.
    await page.route(/\/v1\/library\?/, (route) =>
        route.continue({ url: route.request().url().replace(/limit=\d+/, "limit=1") }),
    );
    await page.goto(`${base}/editor#token=${token}`);
    await page.locator("#tab-library:not([hidden])").waitFor({ state: "attached" });
    await page.locator("#start-species").click();
    const items = page.locator("#published-list button");
    await items.first().waitFor();
    assert.equal(await items.count(), 1);
    await page.locator("#published-more").click();
    await items.nth(1).waitFor();
    await page.locator("#species-search").fill("paged_b");
    await page.waitForFunction(() => document.querySelectorAll("#published-list button").length === 1);
    await page.locator("#published-list [data-species='~me.paged_b@1']").click();
    await page.locator("#found-numbers", { hasText: "from the file of a species" }).waitFor();
    await page.locator("#another-species").click();
    await page.locator("#species-search").fill("agaric_draft");
    await page.locator("#published-none", { hasText: "none with this name" }).waitFor();
    await page.locator("#published-mine").check();
    const draft = page.locator("#published-list [data-species='~me.agaric_draft']");
    await draft.locator("canvas[data-drawn]").waitFor();
    await draft.click();
    await page.locator("#library-state", { hasText: "~me.agaric_draft · draft" }).waitFor({ state: "attached" });
    await context.close();
});

test("a service without a library shows nothing of it", async (t) => {
    const other = serverUrl();
    if (other === base) return t.skip("there is one server alone, which has a library");
    const page = await browser.newPage();
    await page.goto(`${other}/editor`);
    await page.locator("#start-species").click();
    await page.locator("#species-list button").first().waitFor();
    for (const id of ["tab-library", "published-part"]) assert.equal(await page.locator(`#${id}`).isVisible(), false);
    await page.goto(`${other}/?lod=3&textures=none`);
    await galleryComplete(page);
    assert.equal(await page.locator("#gallery :is(.heading, .more)").count(), 0);
    await page.close();
});

test("own species are renamed, taken out of lists, shared, saved as files and deleted", async () => {
    await stored("boletus_edulis", "cep_to_share");
    const { page } = await open();
    await page.locator("#tab-library").click();
    const item = page.locator("#library-list li", { has: page.locator("[data-library='~me.cep_to_share']") });
    await item.locator("[data-library]").click();
    await page.locator("#library-state", { hasText: "~me.cep_to_share · draft" }).waitFor();
    await page.locator("#library-title").fill("A shared cep");
    await page.locator("#library-title").press("Enter");
    await page.locator("#library-save").click();
    await page.locator("#library-state", { hasText: "saved" }).waitFor();
    const path = `${base}/v1/library/~me.cep_to_share`;
    assert.equal((await (await fetch(path, { headers })).json()).facts.common_name, "A shared cep");
    await item.locator("summary").click();
    await item.locator("[data-action=share]").click();
    await item.locator("[data-action=make-link]").click();
    const link = await item.locator(".share-link").inputValue();
    const reader = await (await browser.newContext({ viewport: { width: 800, height: 500 } })).newPage();
    reader.setDefaultTimeout(patience);
    await reader.goto(link);
    await reader.locator("#found-numbers", { hasText: "from the file of a species" }).waitFor({ timeout: patience });
    assert.equal((await addressOf(reader)).hash, "", "the key does not stay in the address");
    await item.locator("[data-action=revoke]").click();
    await item.locator(".links li").waitFor({ state: "detached" });
    await reader.goto("about:blank");
    await reader.goto(link);
    await reader.locator(":is(#gesture-errors, #welcome-error)", { hasText: "only what is published" }).waitFor();
    await reader.context().close();
    await item.locator("[data-action=unlist]").click();
    await item.locator("i", { hasText: "@1, unlisted" }).waitFor();
    const listed = await (await fetch(`${base}/v1/library?q=cep_to_share`)).json();
    assert.deepEqual(listed.species, []);
    await item.locator("summary").click();
    const [download] = await Promise.all([
        page.waitForEvent("download"),
        item.locator("[data-action=export]").click(),
    ]);
    const file = JSON.parse(await readFile(await download.path(), "utf8"));
    assert.deepEqual(file.versions.map(({ number }) => number), [0, 1]);
    const questions = [];
    page.on("dialog", (dialog) => questions.push(dialog.message()));
    await item.locator("[data-action=purge]").click();
    await item.waitFor({ state: "detached" });
    assert.match(questions[0], /Delete ~me\.cep_to_share for ever\?.*its published version are deleted/);
    assert.equal((await fetch(`${path}@1`)).status, 410);
    // Under another name, since those of deleted species are never given again.
    file.name = "cep_imported";
    const wrong = { name: "cep.library.json", mimeType: "application/json", buffer: Buffer.from(JSON.stringify(file)) };
    await page.locator("#library-file").setInputFiles(wrong);
    await page.locator("#library-error", { hasText: "its id is 'cep_to_share'" }).waitFor();
    for (const version of file.versions) {
        version.text = version.text.replace('"id":"cep_to_share"', '"id":"cep_imported"');
        version.sha256 = createHash("sha256").update(version.text).digest("hex");
    }
    await page.locator("#library-file").setInputFiles({ ...wrong, buffer: Buffer.from(JSON.stringify(file)) });
    await page.locator("[data-library='~me.cep_imported']", { hasText: "@1" }).waitFor();
    await page.context().close();
});

test("touch alone goes from a photograph to a published species", async (t) => {
    if (!hasLibrary) return t.skip("the server has no library");
    const context = await browser.newContext({
        reducedMotion: "reduce",
        viewport: { width: 390, height: 844 },
        hasTouch: true,
        isMobile: true,
    });
    const page = await context.newPage();
    page.setDefaultTimeout(patience);
    const ready = () =>
        page.waitForFunction(() => document.documentElement.dataset.designer === "ready", undefined, { timeout: patience });
    const session = await context.newCDPSession(page);
    const touch = (type, ...points) =>
        session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    /** A finger goes from one place of the window to another. */
    const slide = async (from, to) => {
        await touch("touchStart", from);
        for (let step = 1; step <= 5; ++step)
            await touch("touchMove", from.map((start, axis) => start + ((to[axis] - start) * step) / 5));
        await touch("touchEnd");
    };
    const seen = () => page.locator("#sketch").scrollIntoViewIfNeeded();
    const onScreen = (place) =>
        page.evaluate(([x, y]) => {
            const matrix = document.getElementById("sketch").getScreenCTM();
            const { x: left, y: top } = new DOMPoint(x, y).matrixTransform(matrix);
            return [left, top];
        }, place);
    await page.goto(`${base}/editor#token=${token}`);
    const query = "width=800&height=800&view=front&background=grey";
    const response = await fetch(`${base}/v1/mushrooms/russula_emetica.png?${query}`);
    const photograph = { name: "russula.png", mimeType: "image/png", buffer: Buffer.from(await response.arrayBuffer()) };
    page.once("filechooser", (chooser) => chooser.setFiles(photograph));
    await page.locator("#choose").tap();
    await page.locator("#sentence", { hasText: "Draw from the foot to the top" }).waitFor();
    await ready();
    for (const line of [[[447, 705], [405, 42]], [[95, 165], [708, 92]]]) {
        await seen();
        await slide(await onScreen(line[0]), await onScreen(line[1]));
    }
    await page.locator("#sketch .outline").waitFor({ state: "attached" });
    await ready();
    const cap = page.locator('#found-numbers dt:text-is("Cap") + dd');
    const traced = await cap.textContent();
    await page.locator('#tools [data-tool="outline"]').tap();
    await seen();
    const { x, y, width, height } = await page
        .locator('.handle[role=button][aria-label^="cap, point 2 "] .knob')
        .boundingBox();
    // A point is held above the finger.
    await slide([x + width / 2, y + height / 2], [x + width / 2 + 14, y + height / 2 + 40]);
    await page.locator("#found-numbers", { hasText: "traced, then edited" }).waitFor({ state: "attached" });
    await ready();
    assert.notEqual(await cap.textContent(), traced);
    await page.locator("#tab-library").tap();
    const name = page.locator("#library-name");
    await name.tap();
    await name.fill("russula_by_touch");
    await page.locator("#library-publish").tap();
    await page.locator("#library-published .address").waitFor();
    const model = await fetch(`${base}/v1/mushrooms/~me.russula_by_touch@1.glb?lod=3&textures=none`);
    assert.equal(model.status, 200);
    await model.arrayBuffer();
    const small = await page
        .locator("#panel :is(button, select, input[type=text]):visible, #panel summary:visible")
        .evaluateAll((all) =>
            all.filter((one) => one.getBoundingClientRect().height < 44).map((one) => one.id || one.textContent),
        );
    assert.deepEqual(small, []);
    await context.close();
});
