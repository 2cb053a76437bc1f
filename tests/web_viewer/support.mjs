// Shared by the page's tests and tools: npm packages, a browser, a log of a page's events.
import { createRequire } from "node:module";
import { mkdir } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
export const root = path.resolve(here, "../..");

/** Resolves packages of web_viewer; tests have none of their own. */
export const packages = createRequire(path.join(root, "web_viewer/package.json"));

/**
 * Returns the URL of the running server without a slash at its end. With `everySpecies` it is that of
 * a server with the whole atlas (SPOREPRINT_ALL_URL), if there are two servers.
 */
export function serverUrl({ everySpecies = false } = {}) {
    const url = (everySpecies && process.env.SPOREPRINT_ALL_URL) || process.env.SPOREPRINT_URL;
    if (!url)
        throw new Error(
            "SPOREPRINT_URL is not set: start a server and name it, e.g. http://127.0.0.1:8080",
        );
    return url.replace(/\/+$/, "");
}

/**
 * Milliseconds after which a page that is waited for counts as hung. Beside a build or tests with
 * sanitizers, a page that is ready in seconds has taken two minutes.
 */
export const patience = 300_000;

export async function screenshotFolder() {
    const folder = path.resolve(root, process.env.SCREENSHOT_DIR ?? "build/screenshots");
    await mkdir(folder, { recursive: true });
    return folder;
}

/** Returns a script and what it imports as one text. */
export async function bundled(file) {
    const { outputFiles } = await packages("esbuild").build({
        entryPoints: [file],
        bundle: true,
        write: false,
        format: "esm",
        target: ["es2022"],
        nodePaths: [path.join(root, "web_viewer/node_modules")],
        external: ["node:*"],
    });
    return outputFiles[0].text;
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

/** Logs console messages, failures and requests of a page; the returned lists grow with them. */
export function logEvents(page) {
    const log = { console: [], failed: [], requests: [] };
    page.on("console", (message) => log.console.push(`${message.type()}: ${message.text()}`));
    page.on("pageerror", (error) => log.console.push(`uncaught: ${error.message}`));
    page.on("request", (request) => log.requests.push(request.url()));
    page.on("requestfailed", (request) => {
        // The page cancels requests that are out of date: these are no failures.
        if (request.failure()?.errorText !== "net::ERR_ABORTED") {
            log.failed.push(`${request.url()}: ${request.failure()?.errorText}`);
        }
    });
    page.on("response", (response) => {
        if (response.status() >= 400) log.failed.push(`${response.url()}: ${response.status()}`);
    });
    return log;
}

/**
 * Loads the page again. The browser ends what the document that is left was still loading, and that
 * document logs this: its messages from then on are dropped.
 */
export async function reload(page, log) {
    const logged = log.console.length;
    page.once("framenavigated", () => log.console.splice(logged));
    await page.reload();
}

/**
 * Returns the page's address. The page is asked: `page.url()` hears of an address that a script has
 * set only after a while.
 */
export async function addressOf(page) {
    return new URL(await page.evaluate(() => location.href));
}

/** Returns the parameters of the page's address. */
export async function parameters(page) {
    return (await addressOf(page)).searchParams;
}

/** Waits until the shown model equals the controls and a frame was drawn. */
export async function ready(page) {
    await page.waitForFunction(() => window.sporeprint, undefined, { timeout: patience });
    await page.evaluate(() => window.sporeprint.ready());
}

/** Waits until the gallery has all its pictures. */
export async function galleryComplete(page) {
    await page.waitForFunction(
        () => document.documentElement.dataset.gallery === "complete",
        undefined,
        {
            timeout: patience,
        },
    );
}

/** A page with an address of its own, in a browser of its own. It says in data-NAME of its root how far it is. */
export class PageOfItsOwn {
    /**
     * @param {string} name of the page, also its address
     * @param {string} first query of the window that tests share
     * @param {object} context options of its windows
     */
    constructor(name, first, context) {
        Object.assign(this, { name, first, context, base: serverUrl({ everySpecies: true }) });
    }

    async launch() {
        this.browser = await launchBrowser();
    }

    close() {
        return this.browser?.close();
    }

    /** Opens the page in a window of its own, which has no storage yet. */
    async openAlone(query, viewport = this.context.viewport) {
        const context = await this.browser.newContext({ reducedMotion: "reduce", ...this.context, viewport });
        const page = await context.newPage();
        page.setDefaultTimeout(patience);
        const log = logEvents(page);
        // Software WebGL keeps a loaded machine busy for long.
        await page.goto(`${this.base}/${this.name}${query}`, { waitUntil: "commit" });
        await this.at(page, "ready");
        return { page, log };
    }

    /** Returns the window that most tests share, since software WebGL takes seconds to begin, at an address. */
    async open(query = this.first, state = "ready") {
        this.shared ??= await this.openAlone(this.first);
        const { page, log } = this.shared;
        for (const list of Object.values(log)) list.length = 0;
        await page.evaluate((address) => {
            history.pushState(null, "", address);
            dispatchEvent(new PopStateEvent("popstate"));
        }, query);
        await this.at(page, state);
        return this.shared;
    }

    /** Waits until the page is ready or failed. */
    at(page, state) {
        return page.waitForFunction(([name, wanted]) => document.documentElement.dataset[name] === wanted, [this.name, state], { timeout: patience });
    }
}
