// Makes a picture of worlds for web_viewer/pictures: pictures of plots, or of the page /world, side by side.
//   node tests/web_viewer/world_sheet.mjs URL NAME FILE
// NAME is one of the sheets below.
import { launchBrowser, logEvents, packages, patience } from "./support.mjs";

const sharp = packages("sharp");

/** Returns the address of a picture of a plot. */
const plot = (world, time, query) => `/v1/worlds/${world}/${time}/plot.png?${query}`;
/** Returns the address of the page as it flies over a world. `look` is heading, pitch and height above the ground. */
const flight = (world, x, y, time, look) => `/world?world=${world}&x=${x}&y=${y}&${time}&view=fly&look=${look}`;

/** Fairy rings of parasols alone, six times as many as the meadow has of all, so that one is seen from far above. */
const parasols = "meadow,seed=7,extent=256,fungi.abundance=6,fungi.species=macrolepiota_procera";

/**
 * What each picture shows: `cells`, addresses with the text below each, if any; `cell`, their size, also that of the
 * window of the page; `columns`; `part` of the pictures, as left, top, width and height, if not all of them; `whole` to
 * show the page itself, not its stage alone.
 */
const sheets = {
    worlds: {
        columns: 3,
        cell: [480, 320],
        cells: [
            plot("beech,seed=3", "y80d285", ""),
            plot("spruce,seed=2", "y90d190", "x=30"),
            plot("birch,seed=2", "y128d118", "x=95&y=-54"),
            plot("beech,seed=7", "y81d285", "x=51.5&y=33.5&size=4&view=kneeling"),
            plot("spruce,seed=7", "y90d262", "x=-214.8&y=-136&size=4&view=kneeling"),
            plot("mixed,seed=7", "y88d276", "x=196.1&y=-35.6&size=4&view=kneeling"),
            plot("meadow,seed=7", "y88d280", "x=29.9&y=8.2&size=4&view=kneeling"),
            plot("clearing,seed=7", "y88d285", "x=3.3&y=63.9&size=4&view=kneeling"),
            plot("mixed,seed=7", "y80d28", "x=-2.8&y=45.3"),
        ].map((address) => [address]),
    },
    seasons: {
        columns: 2,
        cell: [546, 364],
        cells: [20, 125, 200, 285].map((day) => [plot("birch,seed=2", `y128d${day}`, "x=95&y=-54")]),
    },
    ring: {
        columns: 3,
        cell: [480, 303],
        part: [0, 122, 1024, 646],
        // The days of summer and autumn on which most of them are open.
        cells: [[61, 277], [66, 192], [71, 207], [76, 264], [81, 266], [86, 303]].map(([year, day]) => [
            plot(parasols, `y${year}d${day}`, "x=-11&y=-11.5&size=20&view=aslant&width=1024&height=768"),
            `year ${year}`,
        ]),
    },
    flight: {
        columns: 2,
        cell: [640, 400],
        cells: [
            [flight("beech,seed=7,extent=256", 20, -5, "year=80&day=285", "20,-8,3")],
            [flight("birch,seed=2,extent=256", 60, -54, "year=128&day=200", "40,-14,14")],
        ],
    },
    world_page: {
        columns: 1,
        cell: [1280, 800],
        whole: true,
        cells: [["/world?world=beech,seed=7&x=17&y=17&year=80&day=270"]],
    },
};

const gap = 3, caption = 30, paper = "#f5eee0";

/** Returns a line of text that stands below a cell. */
function titled(text, width) {
    const style = `text-anchor="middle" font-family="serif" font-style="italic" font-size="18" fill="#4a3a2e"`;
    return Buffer.from(`<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${caption}"><text x="${width / 2}" y="21" ${style}>${text}</text></svg>`);
}

async function fetched(address) {
    const response = await fetch(address);
    if (!response.ok) throw new Error(`${address}: ${response.status} ${await response.text()}`);
    return Buffer.from(await response.arrayBuffer());
}

/** The page in one window: all of it, or its stage without what lies on that. */
class Window {
    constructor([width, height], whole) {
        Object.assign(this, { viewport: { width, height }, whole });
    }

    async open(address) {
        this.browser = await launchBrowser();
        // The page allows no styles but its own.
        this.page = await this.browser.newPage({ viewport: this.viewport, reducedMotion: "reduce", bypassCSP: true });
        this.page.setDefaultTimeout(patience);
        this.log = logEvents(this.page);
        await this.page.goto(address, { waitUntil: "commit" });
        await this.ready();
        const style = "#stage { position: fixed !important; inset: 0; z-index: 9; } #stage > :not(canvas) { display: none !important; }";
        if (!this.whole) await this.page.addStyleTag({ content: style });
    }

    ready() {
        return this.page.waitForFunction(() => document.documentElement.dataset.world === "ready", undefined, { timeout: patience });
    }

    /** Returns a picture of an address; all but the first are shown without loading the page again. */
    async picture(address) {
        if (!this.page) await this.open(address);
        await this.page.evaluate(async (there) => {
            history.pushState(null, "", there);
            dispatchEvent(new PopStateEvent("popstate"));
            // From these frames on the page knows which tiles it needs for this view.
            for (let frames = 0; frames < 3; ++frames) await new Promise(requestAnimationFrame);
        }, address);
        await this.ready();
        if (this.log.failed.length) throw new Error(this.log.failed.join("\n"));
        return this.page.screenshot();
    }

    close() {
        return this.browser?.close();
    }
}

const [url, name, file] = process.argv.slice(2);
const wanted = sheets[name];
if (!file || !wanted) throw new Error(`usage: world_sheet.mjs URL NAME FILE, with one NAME of ${Object.keys(sheets).join(", ")}`);
const { cells, cell: [width, height], columns, part, whole = false } = wanted;
const window = new Window([width, height], whole);
const below = cells.some(([, text]) => text) ? caption : 0;
const layers = [];
try {
    for (const [i, [address, text]] of cells.entries()) {
        const own = address.startsWith("/world?")
            ? await window.picture(url + address)
            : await fetched(url + address);
        const left = (i % columns) * (width + gap), top = Math.floor(i / columns) * (height + below + gap);
        const shown = part ? sharp(own).extract({ left: part[0], top: part[1], width: part[2], height: part[3] }) : sharp(own);
        layers.push({ input: await shown.resize(width, height).png().toBuffer(), left, top });
        if (text) layers.push({ input: titled(text, width), left, top: top + height });
    }
} finally {
    await window.close();
}
const across = (count, side) => count * (side + gap) - gap;
const sheet = sharp({
    create: { width: across(columns, width), height: across(Math.ceil(cells.length / columns), height + below), channels: 3, background: paper },
});
await sheet.composite(layers).png({ palette: true, quality: 92, effort: 10 }).toFile(file);
