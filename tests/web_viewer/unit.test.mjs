// The parts of the page that need no browser: schema to fields, settings to addresses, words.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import path from "node:path";
import test from "node:test";
import { packages, root } from "./support.mjs";

const { outputFiles } = packages("esbuild").buildSync({
    stdin: {
        contents: ["schema", "settings", "http", "camera", "gallery", "dom"].map((name) => `export * from "./${name}";`).join("\n"),
        resolveDir: path.join(root, "web_viewer/src"),
    },
    bundle: true,
    write: false,
    format: "esm",
    target: "es2022",
});
const page = await import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`);

const schema = {
    type: "object",
    properties: {
        seed: { type: "integer", minimum: 0, maximum: 4294967295, default: 1, description: "The individual." },
        age: { type: "number", minimum: 0, maximum: 1, default: 0.6 },
        lod: { type: "integer", minimum: 0, maximum: 3, default: 0 },
        texture_size: { type: "integer", enum: [128, 256, 512], default: 256 },
        textures: { enum: ["embedded", "linked", "none"], default: "embedded" },
        glow: { type: "boolean", default: false },
        deformation: {
            type: "object",
            properties: { bend_deg: { type: "number", minimum: 0, maximum: 90, "x-unit": "deg", "x-default-from": "species" } },
        },
        hymenium: { $ref: "#/$defs/hymenium", "x-default-from": "species" },
        v: { type: "string" },
    },
    $defs: {
        hymenium: {
            oneOf: [
                { properties: { form: { const: "gills" }, count: { type: "integer", minimum: 3, maximum: 300, default: 80 } } },
                { properties: { form: { const: "pores" }, per_mm: { type: "number", minimum: 0.5, maximum: 8, default: 2 } } },
            ],
        },
    },
};
const fields = page.groupsOf(schema).flatMap((group) => group.fields);
const named = (name) => fields.find((field) => field.name === name);

test("every parameter of the schema becomes a field under its query name, except v", () => {
    assert.deepEqual(fields.map((field) => field.name).sort(), [
        "age", "deformation.bend_deg", "glow", "hymenium.count", "hymenium.form", "hymenium.per_mm", "lod", "seed", "texture_size", "textures",
    ]);
    assert.equal(named("age").kind, "number");
    assert.equal(named("texture_size").kind, "select");
    assert.equal(named("glow").kind, "checkbox");
    assert.equal(named("deformation.bend_deg").unit, "°");
    assert.equal(named("deformation.bend_deg").group, "deformation");
});

test("alternatives of a variant are one list of names and the fields of all of them", () => {
    assert.deepEqual(named("hymenium.form").options, ["gills", "pores"]);
    assert.ok(named("hymenium.count").fromSpecies);
    assert.equal(named("hymenium.count").fallback, undefined);
});

test("a slider's step is 1, 2 or 5 times a power of ten and leaves at least 180 positions", () => {
    for (const field of fields.filter(({ kind, integer }) => kind === "number" && !integer)) {
        assert.ok((field.max - field.min) / field.step >= 179.9, field.name);
        assert.match(field.step.toExponential(), /^[125]e/, field.name);
    }
});

test("an address carries only what differs, in the schema's order", () => {
    const settings = new page.Settings(fields, "boletus_edulis");
    assert.equal(settings.address(".glb"), "/v1/mushrooms/boletus_edulis.glb");
    settings.set("deformation.bend_deg", 20);
    settings.set("age", 0.25);
    settings.set("seed", 1);
    assert.equal(settings.address(".json"), "/v1/mushrooms/boletus_edulis.json?age=0.25&deformation.bend_deg=20");
    assert.equal(settings.pageQuery(new URLSearchParams("shot=1")), "?species=boletus_edulis&age=0.25&deformation.bend_deg=20&shot=1");
    settings.set("age", 0.6);
    assert.equal(settings.address(".glb"), "/v1/mushrooms/boletus_edulis.glb?deformation.bend_deg=20");
});

test("another species drops what was set on the last one's own shape and keeps the rest", () => {
    const settings = new page.Settings(fields, "boletus_edulis");
    settings.set("deformation.bend_deg", 20);
    settings.set("seed", 7);
    settings.choose("russula_vinosa");
    assert.equal(settings.address(".glb"), "/v1/mushrooms/russula_vinosa.glb?seed=7");
});

test("what a page address says is read back, and what it cannot use is named", () => {
    const settings = new page.Settings(fields, "a");
    const faults = settings.read(new URLSearchParams("species=a&age=3.7e-1&lod=9&sed=4&textures=none&seed=0x10&glow=true"));
    assert.deepEqual(faults.map(({ parameter }) => parameter), ["lod", "sed", "seed"]);
    assert.deepEqual([...settings.values], [["age", 0.37], ["textures", "none"], ["glow", true]]);
});

test("a drag asks for linked textures and a lower level of detail, never a higher one", () => {
    const settings = new page.Settings(fields, "a");
    assert.deepEqual([...settings.draftValues(true)], [["lod", 1], ["textures", "linked"]]);
    assert.deepEqual([...settings.draftValues(false)], [["lod", 1]]);
    settings.set("lod", 3);
    settings.set("textures", "none");
    assert.deepEqual([...settings.draftValues(true)], [["lod", 3]]);
});

test("values outside the schema have their fault in words", () => {
    assert.equal(page.fault(named("age"), 1.7), "is above 1");
    assert.equal(page.fault(named("seed"), 1.5), "needs a whole number");
    assert.equal(page.fault(named("age"), Number.NaN), "needs a number");
    assert.equal(page.fault(named("age"), 0), undefined);
});

test("Retry-After is read as seconds and as a date, within bounds", () => {
    assert.equal(page.retryAfter("3", 0), 3);
    assert.equal(page.retryAfter(null, 0), 1);
    assert.equal(page.retryAfter("Thu, 01 Jan 1970 00:00:10 GMT", 4000), 6);
    assert.equal(page.retryAfter("86400", 0), 20);
    assert.equal(page.retryAfter("0", 0), 0.25);
});

test("the scale bar has a round length and is as long on the screen as it says", () => {
    for (const perMetre of [90, 1234, 5000, 33333, 1e6]) {
        const bar = page.scaleBar(perMetre, 64);
        assert.ok(Math.abs(bar.pixels - bar.metres * perMetre) < 1e-9);
        assert.ok(bar.pixels >= 63.9 && bar.pixels <= 161, `${perMetre}: ${bar.pixels}`);
        assert.match(bar.metres.toExponential(), /^[125]e/);
    }
    assert.equal(page.centimetres(0.05), "5 cm");
    assert.equal(page.centimetres(0.0005), "0.05 cm");
});

test("seasons and numbers are said as a person says them", () => {
    assert.equal(page.seasonText([7, 8, 9, 10]), "Jul–Oct");
    assert.equal(page.seasonText([11, 12, 1, 2]), "Nov–Feb");
    assert.equal(page.seasonText([9]), "Sep");
    assert.equal(page.seasonText([4, 5, 6, 8, 9, 10, 11]), "Apr–Jun, Aug–Nov");
    assert.equal(page.kilobytes(340_200), "340 kB");
    assert.equal(page.kilobytes(1_240_000), "1.24 MB");
});

test("the page's TypeScript has no type errors", () => {
    const { status, stdout } = spawnSync(process.execPath, [packages.resolve("typescript/bin/tsc"), "--noEmit"], {
        cwd: path.join(root, "web_viewer"),
        encoding: "utf8",
    });
    assert.equal(status, 0, stdout);
});
