// Makes one labelled picture of many mushrooms, to compare shapes side by side.
//
//   node tests/web_viewer/contact_sheet.mjs http://127.0.0.1:8080 [options]
//     --out FILE            picture to write (build/screenshots/contact_sheet.png)
//     --species a,b         rows (all species); a mix is written with + for its commas: a:0.5+b:0.5
//     --leaves              leaves instead of mushrooms: rows are presets; --species selects some
//     --trees               trees instead of mushrooms
//     --colonies            colonies instead of mushrooms: rows are those of --species, or one of
//                           each habit
//     --ages 0,0.3,0.6,1    columns, each list is crossed with the others
//     --seeds 1,2
//     --lods 0,2
//     --views three-quarter,front,side,top,below; of colonies also roots
//     --set name=value      any other parameter for every cell; may be repeated
//     --vary name=v1,v2     any other parameter as columns; may be repeated
//     --each a+b:name=v1,v2 instead of rows by species: a row for a parameter, with its values for
//                           each of the species; may be repeated
//     --cell 320            side of a cell in pixels
//     --wireframe           draws edges
//
// or the page's own sheets, as a person downloads them:
//     --mixes a,b,c,d,e     variety sheet of the morphs between two to five control shapes
//     --glb FILE            and the same as one GLB
//     --growth              growth strips of all species, or of those of --species (also mixes)
import { mkdir, readFile, writeFile } from "node:fs/promises";
import path from "node:path";
import { launchBrowser, logEvents, ready, root } from "./support.mjs";

function readArguments(argv) {
    const options = {
        out: path.join(root, "build/screenshots/contact_sheet.png"),
        cell: 320,
        set: [],
        vary: [],
        each: [],
    };
    const list = (text) => text.split(",").filter(Boolean);
    const take = {
        "--out": (text) => (options.out = path.resolve(text)),
        "--species": (text) =>
            (options.species = list(text).map((mix) => mix.replaceAll("+", ","))),
        "--ages": (text) => options.vary.push(["age", list(text)]),
        "--seeds": (text) => options.vary.push(["seed", list(text)]),
        "--lods": (text) => options.vary.push(["lod", list(text)]),
        "--views": (text) => (options.views = list(text)),
        "--set": (text) => options.set.push(text),
        "--vary": (text) =>
            options.vary.push([text.split("=")[0], list(text.slice(text.indexOf("=") + 1))]),
        "--each": (text) => {
            const [, mixes, name, values] = /^(.+):([^:=]+)=(.+)$/.exec(text) ?? [];
            if (!values) throw new Error(`--each '${text}' is not species:name=values`);
            options.each.push({ mixes: mixes.split("+"), name, values: list(values) });
        },
        "--cell": (text) => (options.cell = Number(text)),
        "--mixes": (text) => (options.mixes = list(text)),
        "--glb": (text) => (options.glb = path.resolve(text)),
    };
    for (let i = 0; i < argv.length; ++i) {
        if (argv[i] === "--wireframe") options.wireframe = true;
        else if (argv[i] === "--leaves") options.leaves = true;
        else if (argv[i] === "--trees") options.trees = true;
        else if (argv[i] === "--colonies") options.colonies = true;
        else if (argv[i] === "--growth") options.growth = true;
        else if (take[argv[i]] && argv[i + 1] !== undefined) take[argv[i]](argv[++i]);
        else if (/^https?:/.test(argv[i]) && !options.base)
            options.base = argv[i].replace(/\/+$/, "");
        else throw new Error(`cannot use argument '${argv[i]}'`);
    }
    if (!options.base)
        throw new Error("give the address of a running server, e.g. http://127.0.0.1:8080");
    return options;
}

const options = readArguments(process.argv.slice(2));
const [kind, list] = options.leaves
    ? ["leaf", "leaves"]
    : options.trees
      ? ["tree", "trees"]
      : [options.colonies ? "colony" : "species", "species"];
const species =
    options.species ??
    (await (await fetch(`${options.base}/v1/${list}`)).json())[list].map(({ id }) => id);

/** Colonies shown when no species is named: two of each habit, two mixes, two far ones. */
const habits = {
    rooted: [
        "hypholoma_fasciculare?habit=rooted",
        "mycena_haematopus:0.5,laccaria_amethystina:0.5?habit=rooted",
    ],
    tuft: ["armillaria_mellea", "hypholoma_fasciculare:0.6,amanita_muscaria:0.4"],
    troop: ["cantharellus_cibarius", "lycoperdon_perlatum"],
    ring: ["marasmius_oreades?habit=ring", "infundibulicybe_geotropa?habit=ring"],
    tier: ["trametes_versicolor", "pleurotus_ostreatus"],
    "far off": ["hypholoma_fasciculare?habit=rooted&lod=2", "trametes_versicolor?lod=2"],
};

let columns = [{ query: options.set, label: [] }];
for (const [name, values] of options.vary) {
    columns = columns.flatMap((column) =>
        values.map((value) => ({
            query: [...column.query, `${name}=${value}`],
            label: [...column.label, `${name} ${value}`],
        })),
    );
}
// Software rendering on a busy machine: one strip has taken minutes.
const timeoutMs = 900_000;
/** Rows of cells, each a mix with its parameters. */
const table = options.each.length
    ? options.each.map(({ mixes, name, values }) => ({
          title: name,
          shown: mixes.flatMap((mix) =>
              values.flatMap((value) =>
                  columns.map(({ query, label }) => ({
                      mix,
                      query: [...query, `${name}=${value}`],
                      label: [mix.replaceAll("_", " "), value, ...label],
                  })),
              ),
          ),
      }))
    : options.colonies && !options.species
      ? Object.entries(habits).map(([title, colonies]) => ({
            title,
            shown: colonies.flatMap((colony) =>
                columns.map(({ query, label }) => {
                    const [mix, own] = colony.split("?");
                    return {
                        mix,
                        query: [...query, ...(own?.split("&") ?? [])],
                        label: [mix.replaceAll("_", " "), ...label],
                    };
                }),
            ),
        }))
      : species.map((mix) => ({
            title: mix.replaceAll("_", " "),
            shown: columns.map((column) => ({ mix, ...column })),
        }));
const views = options.views ?? ["three-quarter"];

/** Opens an address; all but the first one without loading the page again. */
async function go(page, address) {
    if (page.url().startsWith(options.base)) {
        await page.evaluate((there) => {
            history.replaceState(null, "", there);
            dispatchEvent(new PopStateEvent("popstate"));
        }, address);
        return ready(page);
    }
    await page.goto(options.base + address);
    await ready(page);
    if (options.wireframe) await page.evaluate(() => document.querySelector("#wireframe").click());
}

const browser = await launchBrowser();
let broken = 0;

/** Opens a sheet of the page by its address and returns what its button saves. */
async function downloaded(page, address, button) {
    if (address) {
        await page.goto(options.base + address);
        await ready(page);
        const state = await page.locator("#sheet-state").textContent();
        if (!/^\d+ mushrooms,/.test(state)) throw new Error(`${address}: ${state}`);
    }
    const [file] = await Promise.all([page.waitForEvent("download"), page.locator(button).click()]);
    return file;
}

async function pageSheets() {
    // A sheet is as large as its cells; the stage behind it may be small.
    const page = await browser.newPage({ viewport: { width: 640, height: 400 } });
    page.setDefaultTimeout(timeoutMs);
    const log = logEvents(page);
    await mkdir(path.dirname(options.out), { recursive: true });
    const rest = options.set.map((one) => `&${one}`).join("");
    if (options.mixes) {
        await (
            await downloaded(
                page,
                `/?morph=${options.mixes.join(",")}${rest}&sheet=variety`,
                "#sheet-png",
            )
        ).saveAs(options.out);
        if (options.glb)
            await (await downloaded(page, undefined, "#sheet-glb")).saveAs(options.glb);
    } else {
        const strips = [];
        for (const mix of species) {
            const file = await downloaded(
                page,
                `/?species=${mix}${rest}&sheet=growth`,
                "#sheet-png",
            );
            strips.push((await readFile(await file.path())).toString("base64"));
        }
        // Width and height are in the first chunk of a PNG.
        const size = (png) => [16, 20].map((at) => Buffer.from(png, "base64").readUInt32BE(at));
        const width = Math.max(...strips.map((png) => size(png)[0]));
        const columns = inColumns(strips, Math.max(...strips.map((png) => size(png)[1])));
        const all = await browser.newPage({
            viewport: { width: width * columns.length, height: 600 },
        });
        await all.setContent(
            `<!doctype html><style>body { display: flex; margin: 0; background: #f5efe2; } img { display: block; }</style>${columns
                .map(
                    (column) =>
                        `<div>${column.map((png) => `<img src="data:image/png;base64,${png}">`).join("")}</div>`,
                )
                .join("")}`,
        );
        await writeFile(options.out, await all.screenshot({ fullPage: true }));
    }
    for (const line of [...new Set([...log.console, ...log.failed])]) console.error(line);
    for (const file of [options.out, options.mixes && options.glb].filter(Boolean))
        console.log(file);
}

/** Returns things of a height in as many columns as a picture needs: Chromium repeats the content
 *  of pictures taller than 8192 pixels. */
function inColumns(things, height) {
    const columns = Math.ceil((things.length * height) / 8000),
        each = Math.ceil(things.length / columns);
    return Array.from({ length: columns }, (_, column) =>
        things.slice(column * each, (column + 1) * each),
    );
}

async function ownSheet() {
    const page = await browser.newPage({ viewport: { width: options.cell, height: options.cell } });
    const log = logEvents(page);
    const rows = [];
    for (const { title, shown } of table) {
        const cells = [];
        for (const { mix, query, label } of shown) {
            const address = `/?${[`${kind}=${mix}`, ...query, "shot=1"].join("&")}`;
            let facts = "";
            try {
                await go(page, address);
                facts = await page.evaluate(() => {
                    const { size, counts, made } = window.sporeprint;
                    const cm = (metres) => (metres * 100).toFixed(1);
                    return `${cm(size.height)} x ${cm(Math.max(size.width, size.depth))} cm, ${counts.triangles} tri${made ? `, ${made.made} of ${made.requested}` : ""}`;
                });
            } catch (error) {
                broken += 1;
                facts = error.message.split("\n")[0].replace(/^page\.\w+: /, "");
                console.error(`${mix} ${label.join(" ")}: ${facts}`);
            }
            for (const view of views) {
                await page
                    .evaluate((name) => window.sporeprint?.view(name), view)
                    .catch(() => undefined);
                await page.evaluate(
                    () =>
                        new Promise((done) =>
                            requestAnimationFrame(() => requestAnimationFrame(done)),
                        ),
                );
                const png = await page.screenshot();
                cells.push({
                    png: png.toString("base64"),
                    label: [...label, view, facts].join(" · "),
                });
            }
        }
        rows.push({ title, cells });
    }
    for (const line of [...new Set([...log.console, ...log.failed])]) console.error(line);

    const escaped = (text) => text.replace(/[&<>"]/g, (sign) => `&#${sign.charCodeAt(0)};`);
    const columns = inColumns(rows, options.cell + 40);
    const html = `<!doctype html><meta charset="utf-8"><style>
body { display: flex; align-items: flex-start; margin: 0; background: #f5efe2; color: #2b211a; font: 12px/1.3 sans-serif; }
table { border-collapse: collapse; } th { font: italic 600 15px serif; min-width: 130px; padding: 4px; }
td { border: 1px solid #d8ccb6; padding: 0; width: ${options.cell}px; } img { display: block; width: ${options.cell}px; }
p { margin: 2px 5px; min-height: 2.6em; }</style>
${columns
    .map(
        (column) =>
            `<table>${column
                .map(
                    ({ title, cells }) =>
                        `<tr><th>${escaped(title).replaceAll(".", ".<wbr>")}</th>${cells
                            .map(
                                ({ png, label }) =>
                                    `<td><img src="data:image/png;base64,${png}"><p>${escaped(label)}</p></td>`,
                            )
                            .join("")}</tr>`,
                )
                .join("")}</table>`,
    )
    .join("")}`;
    const width = 140 + Math.max(...rows.map(({ cells }) => cells.length)) * (options.cell + 1);
    const sheet = await browser.newPage({
        viewport: { width: width * columns.length, height: 600 },
    });
    await sheet.setContent(html);
    await mkdir(path.dirname(options.out), { recursive: true });
    await writeFile(options.out, await sheet.screenshot({ fullPage: true }));
    console.log(options.out);
}

try {
    await (options.mixes || options.growth ? pageSheets() : ownSheet());
} finally {
    await browser.close();
}
process.exitCode = broken ? 1 : 0;
