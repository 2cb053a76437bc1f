// The naming trial: can people who know neither code nor data name each species from its picture?
//
//   node tests/web_viewer/naming_trial.mjs sheet URL --out FOLDER [--shuffle 1] [--cell 264]
//       writes FOLDER/sheet_1.png, … (numbered pictures in shuffled order, each from the side and
//       from below, with a scale bar), FOLDER/names.txt (the alphabetical list of names for the
//       judges) and FOLDER/key.json (the right names); URL is that of a running server
//   node tests/web_viewer/naming_trial.mjs score FOLDER
//       reads FOLDER/key.json and every FOLDER/answers_*.json ({"1":"scientific name", …}), prints
//       and writes FOLDER/confusion.md
import { mkdir, readdir, readFile, writeFile } from "node:fs/promises";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { launchBrowser, ready } from "./support.mjs";

/** Mean score that passes a trial. */
export const pass = 0.8;

/** Returns 1 for the species, 0.5 for its genus, 0 otherwise. */
export function points(said, is) {
    const words = (name) => name.trim().toLowerCase().split(/\s+/);
    const [genus, species] = words(said ?? "");
    const [ofGenus, ofSpecies] = words(is);
    if (genus !== ofGenus) return 0;
    return species === ofSpecies ? 1 : 0.5;
}

/** Returns the scores of each judge, their mean, and the pictures that were not named by all:
 *  [{number, is, said: [..]}]. */
export function scored(key, judges) {
    const numbers = Object.keys(key);
    const shares = judges.map(
        (answers) =>
            numbers.reduce((sum, n) => sum + points(answers[n], key[n]), 0) / numbers.length,
    );
    const mean = shares.reduce((sum, share) => sum + share, 0) / shares.length;
    const missed = numbers
        .filter((n) => judges.some((answers) => points(answers[n], key[n]) < 1))
        .map((n) => ({
            number: Number(n),
            is: key[n],
            said: judges.map((answers) => answers[n] ?? "(nothing)"),
        }));
    return { shares, mean, missed };
}

/** Reads the key and the judges' answers from a folder, in the order of file names. */
export async function readTrial(folder) {
    const json = async (name) => JSON.parse(await readFile(path.join(folder, name), "utf8"));
    const files = (await readdir(folder)).filter((name) => /^answers_.*\.json$/.test(name)).sort();
    return { key: await json("key.json"), files, judges: await Promise.all(files.map(json)) };
}

/** Returns the confusion table as Markdown. */
export function confusionTable({ key, files }, { shares, mean, missed }) {
    const percent = (share) => `${(100 * share).toFixed(1)} %`;
    const judge = (file) => file.replace(/^answers_|\.json$/g, "");
    return [
        "# Naming trial",
        "",
        `${Object.keys(key).length} species at maturity; the same genus counts half. Mean ${percent(mean)}; ${files
            .map((file, i) => `${judge(file)} ${percent(shares[i])}`)
            .join(", ")}.`,
        "",
        `| picture | is | ${files.map(judge).join(" | ")} |`,
        `|---|---|${files.map(() => "---|").join("")}`,
        ...missed.map(
            ({ number, is, said }) =>
                `| ${number} | *${is}* | ${said.map((name) => (name === is ? "right" : name)).join(" | ")} |`,
        ),
        "",
    ].join("\n");
}

/** Shuffles a list; the same number gives the same order. */
function shuffled(list, number) {
    let state = number >>> 0;
    const next = () => {
        state = (state + 0x9e3779b9) >>> 0;
        let z = Math.imul(state ^ (state >>> 16), 0x21f0aaad);
        z = Math.imul(z ^ (z >>> 15), 0x735a2d97);
        return (z ^ (z >>> 15)) >>> 0;
    };
    const all = [...list];
    for (let i = all.length - 1; i > 0; --i) {
        const j = next() % (i + 1);
        [all[i], all[j]] = [all[j], all[i]];
    }
    return all;
}

async function makeSheet(base, { out, shuffle = 1, cell = 264, across = 3, rows = 3 }) {
    const list = (await (await fetch(`${base}/v1/species`)).json()).species;
    const order = shuffled(
        list.sort((a, b) => (a.id < b.id ? -1 : 1)),
        shuffle,
    );
    await mkdir(out, { recursive: true });
    const browser = await launchBrowser();
    try {
        const page = await browser.newPage({ viewport: { width: cell, height: cell } });
        const cells = [];
        for (const [i, { id }] of order.entries()) {
            // The scale bar is the page's own; names and numbers are not shown.
            await page.goto(`${base}/?species=${id}&shot=1`);
            await ready(page);
            await page.evaluate(() => document.querySelector(".scale").classList.remove("chrome"));
            const pictures = [];
            for (const view of ["three-quarter", "below"]) {
                await page.evaluate((name) => window.sporeprint.view(name), view);
                await page.evaluate(
                    () =>
                        new Promise((done) =>
                            requestAnimationFrame(() => requestAnimationFrame(done)),
                        ),
                );
                pictures.push((await page.screenshot()).toString("base64"));
            }
            cells.push(
                `<figure><figcaption>${i + 1}</figcaption>${pictures.map((png) => `<img src="data:image/png;base64,${png}">`).join("")}</figure>`,
            );
        }
        const per = across * rows;
        for (let first = 0; first < cells.length; first += per) {
            const sheet = await browser.newPage({
                viewport: { width: across * (2 * cell + 12) + 16, height: 400 },
            });
            await sheet.setContent(`<!doctype html><style>body { margin: 8px; background: #f5efe2; display: grid; gap: 8px; grid-template-columns: repeat(${across}, auto); font: 600 20px serif; }
figure { margin: 0; border: 1px solid #d8ccb6; position: relative; display: flex; } figcaption { position: absolute; left: 6px; top: 4px; }</style>${cells.slice(first, first + per).join("")}`);
            await writeFile(
                path.join(out, `sheet_${first / per + 1}.png`),
                await sheet.screenshot({ fullPage: true }),
            );
        }
    } finally {
        await browser.close();
    }
    await writeFile(
        path.join(out, "key.json"),
        `${JSON.stringify(Object.fromEntries(order.map(({ scientific_name }, i) => [i + 1, scientific_name])), null, 1)}\n`,
    );
    await writeFile(
        path.join(out, "names.txt"),
        `${list
            .map(({ scientific_name, common_name }) => `${scientific_name} (${common_name})`)
            .sort()
            .join("\n")}\n`,
    );
    console.log(out);
}

async function main([what, where, ...rest]) {
    const options = Object.fromEntries(
        rest.flatMap((word, i) => (word.startsWith("--") ? [[word.slice(2), rest[i + 1]]] : [])),
    );
    if (what === "sheet" && /^https?:/.test(where ?? "") && options.out) {
        const number = (name) =>
            options[name] === undefined ? {} : { [name]: Number(options[name]) };
        return makeSheet(where.replace(/\/+$/, ""), {
            out: path.resolve(options.out),
            ...number("shuffle"),
            ...number("cell"),
        });
    }
    if (what === "score" && where) {
        const trial = await readTrial(where);
        const table = confusionTable(trial, scored(trial.key, trial.judges));
        await writeFile(path.join(where, "confusion.md"), table);
        return console.log(table);
    }
    throw new Error("say 'sheet ADDRESS --out FOLDER' or 'score FOLDER'");
}

if (import.meta.url === pathToFileURL(process.argv[1] ?? "").href)
    await main(process.argv.slice(2));
