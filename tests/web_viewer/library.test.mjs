// Tests of the designer's library in headless Chromium, against a server with --library (SPOREPRINT_URL) and a
// token of it (SPOREPRINT_TOKEN).
import assert from "node:assert/strict";
import test, { after, before } from "node:test";
import { launchBrowser, logEvents, serverUrl } from "./support.mjs";

const base = serverUrl({ everySpecies: true });
const token = process.env.SPOREPRINT_TOKEN ?? "";
const headers = { Authorization: `Bearer ${token}`, "Content-Type": "application/json" };

let browser;
let picture;

before(async () => {
    assert.match(token, /^spk_/, "SPOREPRINT_TOKEN is that of the server's library");
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
    page.setDefaultTimeout(60_000);
    page.on("dialog", (dialog) => void dialog.accept());
    const log = logEvents(page);
    await page.goto(`${base}/editor${fragment}`);
    await page.locator("#file").setInputFiles(picture);
    await page.waitForFunction(() => document.documentElement.dataset.designer === "ready", undefined, { timeout: 120_000 });
    return { page, log };
}

async function save(page, name) {
    await page.locator("#library-name").fill(name);
    await page.locator("#library-save").click();
    await page.locator("#library-state", { hasText: "saved" }).waitFor();
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
    assert.equal(new URL(page.url()).hash, "", "the token does not stay in the address");
    await page.locator("#tab-library").waitFor();
    await tabTo(page, "tab-found");
    await page.keyboard.press("ArrowLeft");
    assert.equal(await page.locator("#panel-library").isVisible(), true, "the last tab");
    await tabTo(page, "library-name");
    await page.keyboard.press("Control+A");
    await page.keyboard.type("cep_by_keys");
    await tabTo(page, "library-publish");
    await page.keyboard.press("Enter");
    const link = page.locator("#library-address");
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
    await page.locator("#library-conflict").waitFor({ timeout: 60_000 });
    assert.equal((await (await fetch(path, { headers })).json()).facts.common_name, "Theirs");
    await page.getByRole("button", { name: "Save mine under another name" }).click();
    await page.locator("#library-state", { hasText: "cep_of_two_2" }).waitFor();
    assert.equal((await (await fetch(path, { headers })).json()).facts.common_name, "Theirs");
    assert.equal((await fetch(`${path}_2`, { headers })).status, 200);
    await page.context().close();
});

test("species of the library are listed and opened again; a wrong token is named", async () => {
    const { page } = await open("");
    await page.locator("#tab-library").click();
    await page.locator("#token").press("Enter");
    await page.locator("#library-error", { hasText: "begins with spk_" }).waitFor();
    await page.locator("#token").fill(`spk_abcdefgh_${"A".repeat(43)}`);
    await page.locator("#token").press("Enter");
    await page.locator("#library-error", { hasText: "no such token" }).waitFor();
    await page.locator("#token").fill(token);
    await page.locator("#token").press("Enter");
    await page.locator("#library-desk").waitFor();
    await save(page, "cep_again");
    await page.locator("#library-publish").click();
    await page.locator("#library-address").waitFor();
    // A reload goes on with the same species of the library.
    await page.reload();
    await page.waitForFunction(() => document.documentElement.dataset.designer === "ready", undefined, { timeout: 120_000 });
    await page.locator("#tab-library").click();
    assert.equal(await page.locator("#library-name").inputValue(), "cep_again");
    assert.match(await page.locator("#library-address").getAttribute("href"), /~me\.cep_again@1\.glb$/);
    await page.locator("[data-library='~me.cep_again']").click();
    await page.locator("#library-state", { hasText: "~me.cep_again · draft" }).waitFor();
    assert.equal(await page.locator("#library-name").inputValue(), "cep_again");
    await page.locator("#library-leave").click();
    assert.equal(await page.evaluate((text) => JSON.stringify({ ...sessionStorage, ...localStorage }).includes(text), token), false);
    await page.context().close();
});
