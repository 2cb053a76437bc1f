// The picture of README's chapter on photographs: a picture, the outline traced on it, the species that grows from
// it, and its mix with a built-in one.
//   node tests/web_viewer/photo_sheet.mjs URL TOKEN FILE
// URL is that of a server with --library, TOKEN one of its tokens. The species is called traced.
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";

const root = path.join(path.dirname(fileURLToPath(import.meta.url)), "../..");
const sharp = createRequire(path.join(root, "web_viewer/"))("sharp");

const [url, token, file] = process.argv.slice(2);
if (!file) throw new Error("usage: photo_sheet.mjs URL TOKEN FILE");
const width = 360, height = 420, scale = 2, margin = 12, caption = 34;
const original = `lepista_nuda.png?seed=5&age=0.7&view=front&background=grey&base=clean&width=${width * scale}&height=${height * scale}`;
const partner = "amanita_muscaria";

async function ask(method, target, body, type = "application/json") {
    const headers = { Authorization: `Bearer ${token}`, "If-Match": "*", ...(body ? { "Content-Type": type } : {}) };
    const response = await fetch(url + target, { method, headers, body: typeof body === "object" && type === "application/json" ? JSON.stringify(body) : body });
    if (!response.ok) throw new Error(`${method} ${target}: ${response.status} ${await response.text()}`);
    return response;
}

const picture = async (target) => Buffer.from(await (await ask("GET", target)).arrayBuffer());

/** Returns a picture with the measured outline drawn on it. */
function withOutline(photo, { left, right }) {
    const points = (side) => side.map(([x, y]) => `${x},${y}`).join(" ");
    const line = (side, colour, thick) => `<polyline points="${points(side)}" fill="none" stroke="${colour}" stroke-width="${thick}" stroke-linejoin="round"/>`;
    const drawn = [left, right].map((side) => line(side, "#2b211b", 9) + line(side, "#fffaf0", 5)).join("");
    const svg = `<svg xmlns="http://www.w3.org/2000/svg" width="${width * scale}" height="${height * scale}">${drawn}</svg>`;
    return sharp(photo).composite([{ input: Buffer.from(svg) }]).png().toBuffer();
}

function titled(text) {
    return Buffer.from(
        `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${caption}"><text x="${width / 2}" y="22" text-anchor="middle" font-family="serif" font-style="italic" font-size="19" fill="#4a3a2e">${text}</text></svg>`,
    );
}

const photo = await picture(`/v1/mushrooms/${original}`);
const { photo: name } = await (await ask("POST", "/v1/photos", photo, "image/png")).json();
// As a person draws it: from a little below the foot to a little above the top, and across the cap.
const gesture = { axis: [[420, 750], [360, 120]], cap: [[180, 210], [540, 210]] };
const trace = await (await ask("POST", "/v1/traces", { views: { side: { photo: name, gesture } }, images: true })).json();
await ask("POST", "/v1/library", { ...trace.species, id: "traced" });
const { newest } = await (await ask("POST", "/v1/library/~me.traced/publish", {})).json();
const shown = `.png?age=${trace.species.stages[trace.stage].age}&background=grey&variation=0&base=clean&width=${width * scale}&height=${height * scale}`;
const own = `~me.traced@${newest}`;
const panels = [
    ["a picture", photo],
    ["its outline, traced", await withOutline(photo, trace.outline)],
    ["the species that grows from it", await picture(`/v1/mushrooms/${own}${shown}`)],
    ["and its mix with the fly agaric", await picture(`/v1/mushrooms/${own}:0.5,${partner}:0.5${shown}`)],
];
const layers = [];
for (const [i, [text, input]] of panels.entries()) {
    const left = margin + i * (width + margin);
    layers.push({ input: await sharp(input).resize(width, height).png().toBuffer(), left, top: margin });
    layers.push({ input: titled(text), left, top: margin + height });
}
const sheet = sharp({ create: { width: margin + panels.length * (width + margin), height: margin + height + caption, channels: 3, background: "#f5eee0" } });
await sheet.composite(layers).png({ palette: true, quality: 90 }).toFile(file);
