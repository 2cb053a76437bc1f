// What the page's tests and tools share: packages of the page's room, a browser, a listening ear.
import { createRequire } from "node:module";
import { mkdir } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
export const root = path.resolve(here, "../..");

/** The page's room holds the packages; tests have none of their own. */
export const packages = createRequire(path.join(root, "web_viewer/package.json"));

/**
 * Address of the running server, without a slash at its end. For `everySpecies` that of a server with the whole atlas
 * (SPOREPRINT_ALL_URL), where there are two.
 */
export function serverUrl({ everySpecies = false } = {}) {
    const url = (everySpecies && process.env.SPOREPRINT_ALL_URL) || process.env.SPOREPRINT_URL;
    if (!url)
        throw new Error(
            "SPOREPRINT_URL is not set: start a server and name it, e.g. http://127.0.0.1:8080",
        );
    return url.replace(/\/+$/, "");
}

export async function screenshotFolder() {
    const folder = path.resolve(root, process.env.SCREENSHOT_DIR ?? "build/screenshots");
    await mkdir(folder, { recursive: true });
    return folder;
}

/** Debian's Chromium with software WebGL, the same on every machine. */
export async function launchBrowser() {
    const { chromium } = packages("playwright-core");
    return chromium.launch({
        executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
        headless: true,
        args: [
            "--no-sandbox",
            "--use-angle=swiftshader",
            "--enable-unsafe-swiftshader",
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
            "--disable-quic",
            "--disable-default-apps",
        ],
    });
}

/** Notes everything a page says or fails at; `requests` grows with each request it makes. */
export function listen(page) {
    const heard = { console: [], failed: [], requests: [] };
    page.on("console", (message) => heard.console.push(`${message.type()}: ${message.text()}`));
    page.on("pageerror", (error) => heard.console.push(`uncaught: ${error.message}`));
    page.on("request", (request) => heard.requests.push(request.url()));
    page.on("requestfailed", (request) => {
        // A request that the page itself gave up, for a newer one, did not fail.
        if (request.failure()?.errorText !== "net::ERR_ABORTED") {
            heard.failed.push(`${request.url()}: ${request.failure()?.errorText}`);
        }
    });
    page.on("response", (response) => {
        if (response.status() >= 400) heard.failed.push(`${response.url()}: ${response.status()}`);
    });
    return heard;
}

/** Waits until the shown model equals the controls and a frame was drawn. */
export async function ready(page) {
    await page.waitForFunction(() => window.sporeprint, undefined, { timeout: 120_000 });
    await page.evaluate(() => window.sporeprint.ready());
}

/** Waits until the gallery has all its pictures. */
export async function galleryComplete(page) {
    await page.waitForFunction(
        () => document.documentElement.dataset.gallery === "complete",
        undefined,
        {
            timeout: 180_000,
        },
    );
}
