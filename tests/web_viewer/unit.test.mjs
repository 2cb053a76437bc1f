// Tests of the modules that need no browser: schema to fields, settings to addresses, texts.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import path from "node:path";
import test from "node:test";
import { coveringArray, product } from "./glb_urls.mjs";
import { confusionTable, pass, points, readTrial, scored } from "./naming_trial.mjs";
import { packages, root } from "./support.mjs";

const { outputFiles } = packages("esbuild").buildSync({
    stdin: {
        contents: [
            "arcs",
            "breed/locks",
            "breed/offspring",
            "breed/parents",
            "breed/pedigree",
            "breed/pedigree_address",
            "breed/tree_rows",
            "camera",
            "close_ups",
            "depth_of_field",
            "designer/axis_line",
            "designer/details",
            "designer/file_title",
            "designer/findings",
            "designer/gesture",
            "designer/library",
            "designer/outline",
            "designer/paint",
            "designer/service",
            "designer/sketch",
            "designer/species_chooser",
            "designer/species_file",
            "designer/species_form",
            "designer/stage_strip",
            "dom",
            "gallery",
            "history",
            "http",
            "level_ranges",
            "library_list",
            "manifest",
            "mix",
            "model",
            "products",
            "rows",
            "schema",
            "settings",
            "view_state",
            "weights",
        ]
            .map((name) => `export * from "./${name}";`)
            .concat(
                ["fly_motion", "height_field", "map_colours", "plot_view", "richest_place", "season_curves", "shared_meshes", "view_address", "why_panel", "world_settings"]
                    .map((name) => `export * as ${name} from "./world/${name}";`),
            )
            .concat('export { Box3, BoxGeometry, DataTexture, Group, InstancedMesh, Mesh, MeshStandardMaterial, PerspectiveCamera, Vector3 } from "three";')
            .join("\n"),
        resolveDir: path.join(root, "web_viewer/src"),
    },
    bundle: true,
    write: false,
    format: "esm",
    target: "es2022",
});
const page = await import(
    `data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`
);

const schema = {
    type: "object",
    properties: {
        seed: {
            type: "integer",
            minimum: 0,
            maximum: 4294967295,
            default: 1,
            description: "The individual.",
        },
        age: { type: "number", minimum: 0, maximum: 1, default: 0.6 },
        lod: { type: "integer", minimum: 0, maximum: 3, default: 0 },
        texture_size: { type: "integer", enum: [128, 256, 512], default: 256 },
        textures: { enum: ["embedded", "linked", "none"], default: "embedded" },
        glow: { type: "boolean", default: false },
        deformation: {
            type: "object",
            properties: {
                bend_deg: {
                    type: "number",
                    minimum: 0,
                    maximum: 90,
                    "x-unit": "deg",
                    "x-default-from": "species",
                },
            },
        },
        hymenium: { $ref: "#/$defs/hymenium", "x-default-from": "species" },
        v: { type: "string" },
    },
    $defs: {
        hymenium: {
            oneOf: [
                {
                    properties: {
                        form: { const: "gills" },
                        count: { type: "integer", minimum: 3, maximum: 300, default: 80 },
                    },
                },
                {
                    properties: {
                        form: { const: "pores" },
                        per_mm: { type: "number", minimum: 0.5, maximum: 8, default: 2 },
                    },
                },
            ],
        },
    },
};
const fields = page.groupsOf(schema).flatMap((group) => group.fields);
const named = (name) => fields.find((field) => field.name === name);

test("the group of top-level parameters is named after the product", () => {
    assert.equal(page.groupsOf(schema)[0].label, "Individual");
    assert.equal(page.groupsOf(schema, page.colonies.groupName)[0].label, "Colony");
});

test("every parameter of the schema becomes a field under its query name, except v", () => {
    assert.deepEqual(fields.map((field) => field.name).sort(), [
        "age",
        "deformation.bend_deg",
        "glow",
        "hymenium.count",
        "hymenium.form",
        "hymenium.per_mm",
        "lod",
        "seed",
        "texture_size",
        "textures",
    ]);
    assert.equal(named("age").kind, "number");
    assert.equal(named("texture_size").kind, "select");
    assert.equal(named("glow").kind, "checkbox");
    assert.equal(named("deformation.bend_deg").unit, "°");
    assert.equal(named("deformation.bend_deg").group, "deformation");
});

test("alternatives of a variant become one list of names and the fields of all", () => {
    assert.deepEqual(named("hymenium.form").options, ["gills", "pores"]);
    assert.equal(named("hymenium.count").owner, "species");
    assert.equal(named("hymenium.count").fallback, undefined);
});

test("a slider's step is 1, 2 or 5 times a power of ten and leaves at least 180 positions", () => {
    for (const field of fields.filter(({ kind, integer }) => kind === "number" && !integer)) {
        assert.ok((field.max - field.min) / field.step >= 179.9, field.name);
        assert.match(field.step.toExponential(), /^[125]e/, field.name);
    }
});

test("an address contains only values that are not defaults, in the schema's order", () => {
    const settings = new page.Settings(fields, "boletus_edulis");
    assert.equal(settings.address(".glb"), "v1/mushrooms/boletus_edulis.glb");
    settings.set("deformation.bend_deg", 20);
    settings.set("age", 0.25);
    settings.set("seed", 1);
    assert.equal(
        settings.address(".json"),
        "v1/mushrooms/boletus_edulis.json?age=0.25&deformation.bend_deg=20",
    );
    assert.equal(
        settings.pageQuery(new URLSearchParams("shot=1")),
        "?species=boletus_edulis&age=0.25&deformation.bend_deg=20&shot=1",
    );
    settings.set("age", 0.6);
    assert.equal(
        settings.address(".glb"),
        "v1/mushrooms/boletus_edulis.glb?deformation.bend_deg=20",
    );
});

test("a leaf has routes of its own, and its colours have colour inputs", () => {
    const tint = { type: "string", format: "color", "x-default-from": "preset" };
    const parts = page
        .groupsOf({
            type: "object",
            properties: {
                seed: schema.properties.seed,
                summer: { type: "object", properties: { vein: tint } },
            },
        })
        .flatMap((group) => group.fields);
    assert.deepEqual(
        parts.map(({ name, kind, owner }) => [name, kind, owner]),
        [
            ["seed", "number", ""],
            ["summer.vein", "color", "preset"],
        ],
    );
    const settings = new page.Settings(parts, "maple", page.leaves);
    settings.set("summer.vein", "#aabbcc");
    assert.equal(settings.address(".glb"), "v1/leaves/maple.glb?summer.vein=%23aabbcc");
    assert.equal(settings.pageQuery(new URLSearchParams()), "?leaf=maple&summer.vein=%23aabbcc");
    settings.choose("oak");
    assert.equal(settings.address(".json"), "v1/leaves/oak.json");
    assert.deepEqual(
        settings.read(new URLSearchParams("leaf=oak&age=1")).map(({ detail }) => detail),
        ["'age' is no parameter of a leaf"],
    );
});

test("a page's query and a canonical path determine the product", () => {
    assert.equal(page.productOf(new URLSearchParams("leaf")), page.leaves);
    assert.equal(page.productOf(new URLSearchParams("seed=7")), page.mushrooms);
    assert.deepEqual(page.modelAt("/v1/leaves/oak.glb"), { product: page.leaves, id: "oak" });
    assert.equal(page.modelAt("/v1/mushrooms/a:0.5,b:0.5.json").id, "a:0.5,b:0.5");
    assert.equal(page.productOf(new URLSearchParams("colony=a:0.5,b:0.5")), page.colonies);
    assert.deepEqual(page.modelAt("/v1/colonies/a:0.5,b:0.5.glb"), {
        product: page.colonies,
        id: "a:0.5,b:0.5",
    });
    assert.equal(page.modelAt("/v1/morphs/a/b.glb"), undefined);
});

test("all links and requests of the page are relative to its path prefix", () => {
    for (const product of page.products) assert.match(product.path, /^v1\/\w+$/);
    for (const file of ["index.html", "docs.html", "editor.html"]) {
        const text = readFileSync(path.join(root, "web_viewer/src", file), "utf8");
        const links = [...text.matchAll(/(?:href|src)="([^"]*)"/g)].map(([, link]) => link);
        assert.ok(links.length > 3);
        for (const link of links) {
            assert.ok(
                new URL(link.replace(/[{}]/g, ""), "http://host/a/b/docs").pathname.startsWith(
                    "/a/b/",
                ) && !link.startsWith("/"),
                `${file}: ${link}`,
            );
        }
    }
});

test("choosing another species drops values of the last one's shape and keeps the rest", () => {
    const settings = new page.Settings(fields, "boletus_edulis");
    settings.set("deformation.bend_deg", 20);
    settings.set("seed", 7);
    settings.choose("russula_vinosa");
    assert.equal(settings.address(".glb"), "v1/mushrooms/russula_vinosa.glb?seed=7");
});

test("a page address is read back, and parameters that cannot be used are reported", () => {
    const settings = new page.Settings(fields, "a");
    const rejected = settings.read(
        new URLSearchParams("species=a&age=3.7e-1&lod=9&sed=4&textures=none&seed=0x10&glow=true"),
    );
    assert.deepEqual(
        rejected.map(({ parameter }) => parameter),
        ["lod", "sed", "seed"],
    );
    assert.deepEqual(
        [...settings.values],
        [
            ["age", 0.37],
            ["textures", "none"],
            ["glow", true],
        ],
    );
});

test("a draft has linked textures and never a finer level of detail", () => {
    const settings = new page.Settings(fields, "a");
    assert.deepEqual(
        [...settings.draftValues(true)],
        [
            ["lod", 1],
            ["textures", "linked"],
        ],
    );
    assert.deepEqual([...settings.draftValues(false)], [["lod", 1]]);
    settings.set("lod", 3);
    settings.set("textures", "none");
    assert.deepEqual([...settings.draftValues(true)], [["lod", 3]]);
});

test("a clip is requested at LOD 1 or coarser, and frames are sent only with a clip", () => {
    const properties = {
        ...schema.properties,
        animation: { enum: ["none", "growth"], default: "none" },
        frames: { type: "integer", minimum: 2, maximum: 16, default: 9 },
    };
    const settings = new page.Settings(
        page.groupsOf({ ...schema, properties }).flatMap((group) => group.fields),
        "a",
    );
    assert.ok(settings.hasGrowthClips);
    assert.ok(!new page.Settings(fields, "a").hasGrowthClips);
    settings.set("frames", 5);
    assert.equal(settings.address(".glb"), "v1/mushrooms/a.glb");
    assert.equal(settings.applies(settings.field("frames")), false);
    assert.equal(
        settings.address(".glb", settings.clipValues()),
        "v1/mushrooms/a.glb?lod=1&animation=growth&frames=5",
    );
    settings.set("lod", 3);
    settings.set("animation", "growth");
    assert.equal(settings.address(".glb"), "v1/mushrooms/a.glb?lod=3&animation=growth&frames=5");
    assert.equal(settings.address(".glb", settings.clipValues()), settings.address(".glb"));
    assert.equal(
        settings.address(".glb", settings.draftValues(false)),
        "v1/mushrooms/a.glb?lod=3",
        "drafts do not move",
    );
});

test("values outside the schema have a validation error", () => {
    assert.equal(page.validationError(named("age"), 1.7), "is above 1");
    assert.equal(page.validationError(named("seed"), 1.5), "needs a whole number");
    assert.equal(page.validationError(named("age"), Number.NaN), "needs a number");
    assert.equal(page.validationError(named("age"), 0), undefined);
});

test("Retry-After is read as seconds and as a date, within bounds", () => {
    assert.equal(page.retryAfter("3", 0), 3);
    assert.equal(page.retryAfter(null, 0), 1);
    assert.equal(page.retryAfter("Thu, 01 Jan 1970 00:00:10 GMT", 4000), 6);
    assert.equal(page.retryAfter("86400", 0), 20);
    assert.equal(page.retryAfter("0", 0), 0.25);
});

test("the scale bar has a round length and the right number of pixels", () => {
    for (const perMetre of [90, 1234, 5000, 33333, 1e6]) {
        const bar = page.scaleBar(perMetre, 64);
        assert.ok(Math.abs(bar.pixels - bar.metres * perMetre) < 1e-9);
        assert.ok(bar.pixels >= 63.9 && bar.pixels <= 161, `${perMetre}: ${bar.pixels}`);
        assert.match(bar.metres.toExponential(), /^[125]e/);
    }
    assert.equal(page.centimetres(0.05), "5 cm");
    assert.equal(page.centimetres(0.0005), "0.05 cm");
});

test("seasons and numbers are formatted for people", () => {
    assert.equal(page.seasonText([7, 8, 9, 10]), "Jul–Oct");
    assert.equal(page.seasonText([11, 12, 1, 2]), "Nov–Feb");
    assert.equal(page.seasonText([9]), "Sep");
    assert.equal(page.seasonText([4, 5, 6, 8, 9, 10, 11]), "Apr–Jun, Aug–Nov");
    assert.equal(page.kilobytes(340_200), "340 kB");
    assert.equal(page.kilobytes(1_240_000), "1.24 MB");
});

// The morph editor

const close = (one, other, most = 1e-12) =>
    assert.ok(Math.abs(one - other) <= most, `${one} is not ${other}`);

/** Returns points of a polygon: corners, edges, inside. */
function pointsIn(corners) {
    const points = [];
    for (let a = 0; a < corners.length; ++a) {
        for (let b = 0; b < corners.length; ++b) {
            for (const [s, t] of [
                [0, 0],
                [0.5, 0],
                [1, 0],
                [0.2, 0.3],
                [0.35, 0.6],
                [0.05, 0.9],
                [0.001, 0.001],
            ]) {
                points.push({
                    x: (1 - t) * ((1 - s) * corners[a].x + s * corners[b].x),
                    y: (1 - t) * ((1 - s) * corners[a].y + s * corners[b].y),
                });
            }
        }
    }
    return points;
}

for (const n of [3, 4, 5]) {
    const corners = page.polygon(n);
    test(`weights in a polygon of ${n} corners sum to one and determine the point`, () => {
        for (const point of pointsIn(corners)) {
            const weights = page.weightsAt(point, corners);
            close(
                weights.reduce((sum, weight) => sum + weight, 0),
                1,
            );
            assert.ok(
                weights.every((weight) => weight >= 0),
                JSON.stringify(weights),
            );
            const back = page.pointOf(weights, corners);
            close(back.x, point.x, 1e-9);
            close(back.y, point.y, 1e-9);
        }
    });

    test(`a corner of ${n} is exactly its species, and an edge mixes only its two ends`, () => {
        corners.forEach((corner, index) => {
            assert.deepEqual(
                page.weightsAt(corner, corners),
                corners.map((_, at) => (at === index ? 1 : 0)),
            );
            const next = corners[(index + 1) % n];
            const weights = page.weightsAt(
                { x: 0.25 * corner.x + 0.75 * next.x, y: 0.25 * corner.y + 0.75 * next.y },
                corners,
            );
            close(weights[index], 0.25, 1e-9);
            close(weights[(index + 1) % n], 0.75, 1e-9);
        });
        for (const weight of page.weightsAt({ x: 0, y: 0 }, corners)) close(weight, 1 / n);
    });

    test(`weights in a polygon of ${n} corners are continuous, also at its border`, () => {
        for (const point of pointsIn(corners)) {
            const before = page.weightsAt(point, corners);
            for (const [dx, dy] of [
                [1, 0],
                [0, 1],
                [-0.6, -0.8],
            ]) {
                const moved = page.insidePolygon(
                    { x: point.x + 1e-5 * dx, y: point.y + 1e-5 * dy },
                    corners,
                );
                page.weightsAt(moved, corners).forEach((weight, index) =>
                    close(weight, before[index], 5e-5),
                );
            }
        }
    });

    test(`a point outside ${n} corners is moved to the nearest point of the border`, () => {
        for (const point of pointsIn(corners)) {
            const far = { x: point.x * 3 + 0.1, y: point.y * 3 - 0.2 };
            const kept = page.insidePolygon(far, corners);
            const again = page.insidePolygon(kept, corners);
            close(Math.hypot(kept.x - again.x, kept.y - again.y), 0, 1e-12);
            const distance = Math.hypot(kept.x - far.x, kept.y - far.y);
            for (const other of pointsIn(corners)) {
                assert.ok(distance <= Math.hypot(other.x - far.x, other.y - far.y) + 1e-9);
            }
        }
        const near = { x: corners[1].x * 0.98, y: corners[1].y * 0.98 };
        assert.equal(
            page.insidePolygon(near, corners, 0.05),
            corners[1],
            "a corner close by is taken exactly",
        );
        assert.notEqual(page.insidePolygon(near, corners), corners[1]);
    });
}

test("mixes have the service's canonical form", () => {
    const mix = (text) => page.canonicalMix(page.readShares(text));
    assert.equal(mix("a"), "a");
    assert.equal(mix("a:5"), "a");
    assert.equal(mix("a:9999,b:1"), "a");
    assert.equal(mix("b:1,a:1"), "a:0.5,b:0.5");
    assert.equal(mix("c:1,b:1,a:1"), "a:0.334,b:0.333,c:0.333");
    assert.equal(mix("a:7e-1,b:0.3,c:0"), "a:0.7,b:0.3");
    for (const text of ["a:0.334,b:0.333,c:0.333", "a:0.7,b:0.3", "a"])
        assert.equal(mix(text), text);
    for (const text of ["", "a,a", "a:-1", "a:0", "a:0,b:0", "A", "a:x", "a:1,"])
        assert.equal(page.readShares(text), undefined, text);
});

test("rows of a matrix are read as they were written, and always sum to one", () => {
    const rows = [
        [0.5, 0.5],
        [0.25, 0.5, 0.25],
    ];
    assert.equal(page.rowsText(rows), "0.5,0.5;0.25,0.5,0.25");
    assert.deepEqual(page.readRows("0.5,0.5;0.25,0.5,0.25"), rows);
    assert.deepEqual(page.readRows(".5,5e-1"), [[0.5, 0.5]]);
    for (const wrong of [
        "",
        "1",
        "0.5,0.5;0.5,0.5",
        "0.5,x",
        "0.5,0.5;",
        "NaN,1",
        Array(12).fill("0.5,0.5").join(";"),
    ]) {
        assert.equal(page.readRows(wrong), undefined, wrong);
    }
    assert.deepEqual(page.withShare([0.2, 0.6, 0.2], 2, 0.6), [0.1, 0.3, 0.6]);
    assert.deepEqual(
        page.withShare([1, 0, 0], 0, 0.4),
        [0.4, 0.3, 0.3],
        "zeros have no proportion",
    );
    assert.deepEqual(page.withShare([0.5, 0.5], 0, 7), [1, 0]);
    for (let i = 0; i < 300; ++i) {
        const row = Array.from({ length: 2 + (i % 8) }, () => Math.random());
        const made = page.withShare(row, i % row.length, Math.random());
        assert.ok(
            Math.abs(made.reduce((sum, share) => sum + share, 0) - 1) < 1e-9 &&
                made.every((share) => share >= -1e-12),
            made.join(),
        );
    }
    assert.deepEqual(page.grownBy(rows), [...rows, [0, 0.25, 0.5, 0.25]]);
});

test("custom rows are posted with all settings, and dropped with the preset", () => {
    const parts = page
        .groupsOf({
            type: "object",
            properties: {
                lod: { type: "integer", minimum: 0, maximum: 3, default: 0 },
                matrix: { type: "string", enum: ["own", "perfect"], "x-default-from": "preset" },
            },
        })
        .flatMap(({ fields }) => fields);
    const settings = new page.Settings(parts, "birch", page.trees);
    settings.set("lod", 2);
    assert.deepEqual(settings.readMatrix(new URLSearchParams("rows=0.5,0.5")), []);
    const { address, body } = settings.request();
    assert.equal(address, "v1/trees.glb");
    assert.deepEqual(JSON.parse(body), { preset: "birch", lod: 2, order: 2, rows: [[0.5, 0.5]] });
    assert.equal(settings.pageQuery(new URLSearchParams()), "?tree=birch&rows=0.5,0.5&lod=2");
    assert.equal(settings.readMatrix(new URLSearchParams("rows=1")).length, 1);
    settings.rows = [[0.5, 0.5]];
    settings.choose("herb");
    assert.equal(settings.request().address, "v1/trees/herb.glb?lod=2");
});

test("changing one share keeps the proportions of the others", () => {
    const shares = page.readShares("a:0.5,b:0.3,c:0.2");
    const weights = (index, weight) =>
        page.reweighted(shares, index, weight).map((share) => Number(share.weight.toFixed(9)));
    assert.deepEqual(weights(0, 0), [0, 0.6, 0.4]);
    assert.deepEqual(weights(2, 0.6), [0.25, 0.15, 0.6]);
    assert.deepEqual(weights(1, 1), [0, 1, 0]);
    assert.deepEqual(
        page.reweighted(page.readShares("a:1,b:0,c:0"), 0, 0.5).map(({ weight }) => weight),
        [0.5, 0.25, 0.25],
    );
});

test("the address of a morph contains all shares and arcs in order, and is read back", () => {
    const settings = new page.Settings(fields, "a");
    const known = (id) => ["a", "b", "c"].includes(id);
    const read = (query) => settings.readMorph(new URLSearchParams(query), known);
    assert.deepEqual(read("morph=b:0.6,a:0.4&arcs=cap:0.25:0.4"), []);
    assert.equal(settings.mix, "a:0.4,b:0.6");
    assert.equal(settings.pageQuery(new URLSearchParams()), "?morph=b:0.6,a:0.4&arcs=cap:0.25:0.4");
    assert.deepEqual(read("morph=c,a,b:0"), []);
    assert.equal(settings.pageQuery(new URLSearchParams()), "?morph=c:0.5,a:0.5,b:0");
    assert.equal(settings.address(".glb"), "v1/mushrooms/a:0.5,c:0.5.glb");
    for (const wrong of [
        "morph=a",
        "morph=a,z",
        "morph=a,a",
        "morph=",
        "morph=a,b&arcs=cap:2:1",
        "morph=a,b&arcs=brim:0:1",
    ]) {
        assert.equal(read(wrong).length, 1, wrong);
    }
    assert.deepEqual(read("species=a"), []);
    assert.equal(settings.morph, undefined);
});

test("own arcs are posted with the settings; a mix without arcs has a plain URL", () => {
    const settings = new page.Settings(fields, "a");
    settings.readMorph(new URLSearchParams("morph=b:0.6,a:0.4&arcs=cap:0.25:0.4"), () => true);
    settings.set("age", 0.3);
    settings.set("deformation.bend_deg", 20);
    const { address, body } = settings.request(settings.draftValues(true));
    assert.equal(address, "v1/morphs/b/a.glb");
    assert.deepEqual(JSON.parse(body), {
        t: 0.4,
        arcs: [{ curve: "cap", a: 0.25, b: 0.4 }],
        age: 0.3,
        lod: 1,
        textures: "linked",
        deformation: { bend_deg: 20 },
    });
    settings.readMorph(new URLSearchParams("morph=b:1,a:0&arcs=cap:0.25:0.4"), () => true);
    assert.equal(settings.request().address, "v1/mushrooms/b.glb?age=0.3&deformation.bend_deg=20");
    assert.equal(settings.request().body, undefined);
});

test("arcs of one sub-curve cross if their ends are in reverse order or meet", () => {
    const arc = (curve, a, b) => ({ curve, a, b });
    assert.ok(page.crosses(arc("cap", 0.2, 0.6), arc("cap", 0.4, 0.5)));
    assert.ok(page.crosses(arc("cap", 0.2, 0.6), arc("cap", 0.2, 0.7)));
    assert.ok(!page.crosses(arc("cap", 0.2, 0.5), arc("cap", 0.4, 0.6)));
    assert.ok(!page.crosses(arc("cap", 0.2, 0.6), arc("stem", 0.4, 0.5)));
    assert.deepEqual(
        page.crossing([arc("cap", 0.1, 0.1), arc("cap", 0.2, 0.6), arc("cap", 0.4, 0.5)]),
        [false, true, true],
    );
});

test("a new arc is in the widest gap and crosses no other arc", () => {
    const arcs = [];
    for (let step = 0; step < 12; ++step) arcs.push(page.widestGap(arcs, "cap"));
    assert.ok(!page.crossing(arcs).includes(true));
    assert.deepEqual(arcs[0], { curve: "cap", a: 0.5, b: 0.5 });
    assert.equal(page.matched([{ curve: "cap", a: 0.5, b: 0.8 }], "cap", 0.25, "a"), 0.4);
    assert.equal(page.matched([{ curve: "cap", a: 0.5, b: 0.8 }], "cap", 0.9, "b"), 0.75);
    assert.equal(page.matched([], "stem", 1, "a"), 1);
    assert.equal(page.matched([], "stem", 0, "a"), 0);
});

test("undo and redo are inverse, and a new step discards the undone ones", () => {
    const history = new page.History("");
    for (const value of ["a", "ab", "abc"]) history.push(value);
    assert.deepEqual([history.undo(), history.undo()], ["ab", "a"]);
    assert.equal(history.redo(), "ab");
    history.push("abx");
    assert.ok(!history.redoable);
    assert.equal(history.redo(), "abx");
    assert.deepEqual(
        [history.undo(), history.undo(), history.undo(), history.undo()],
        ["ab", "a", "", ""],
    );
    assert.ok(!history.undoable && history.redoable);
    history.begin("z");
    assert.ok(!history.undoable && !history.redoable);
});

for (const n of [2, 3, 4, 5]) {
    test(`a variety sheet of ${n} has every control shape and no duplicates`, () => {
        const { cells, columns, rows } = page.varietyLayout(n);
        assert.equal(cells.length, n === 3 ? 21 : 25);
        const seen = new Set(
            cells.map(({ weights, age }) => JSON.stringify([page.thousandths(weights), age])),
        );
        assert.equal(seen.size, cells.length);
        for (const { weights, column, row } of cells) {
            assert.equal(weights.length, n);
            assert.ok(weights.every((weight) => weight >= 0));
            close(
                weights.reduce((sum, weight) => sum + weight, 0),
                1,
            );
            assert.ok(column >= 0 && column < columns && row >= 0 && row < rows);
        }
        for (let index = 0; index < n; ++index) {
            assert.ok(
                cells.some(({ weights }) => page.controlShape(weights) === index),
                `control shape ${index}`,
            );
        }
    });
}

test("the page's TypeScript has no type errors", () => {
    const { status, stdout } = spawnSync(
        process.execPath,
        [packages.resolve("typescript/bin/tsc"), "--noEmit"],
        {
            cwd: path.join(root, "web_viewer"),
            encoding: "utf8",
        },
    );
    assert.equal(status, 0, stdout);
});

test("the search matches all words with names, form, substrate and months", () => {
    const hoof = {
        id: "fomes",
        scientific_name: "Fomes fomentarius",
        common_name: "hoof fungus",
        form: "bracket",
        substrate: "birch and beech",
        season: [9, 10],
    };
    for (const words of [
        "",
        "  ",
        "HOOF",
        "fomes birch",
        "bracket oct",
        "beech september",
        "hoof fung",
    ]) {
        assert.ok(page.matchesSearch(hoof, words), words);
    }
    for (const words of ["fly", "hoof may", "birch oak", "august"])
        assert.ok(!page.matchesSearch(hoof, words), words);
    assert.ok(
        page.matchesSearch({ id: "x", scientific_name: "X y", common_name: "z" }, "x"),
        "facts may be missing",
    );
});

test("a naming trial scores the genus 0.5, ignores case and lists what was missed", () => {
    assert.equal(points("Boletus edulis", "Boletus edulis"), 1);
    assert.equal(points(" mycena  GALERICULATA ", "Mycena haematopus"), 0.5);
    assert.equal(points("Mycenastrum corium", "Mycena haematopus"), 0);
    assert.equal(points(undefined, "Boletus edulis"), 0);
    const key = { 1: "Boletus edulis", 2: "Mycena haematopus" };
    const result = scored(key, [
        { 1: "Boletus edulis", 2: "Mycena galericulata" },
        { 1: "Boletus edulis" },
    ]);
    assert.deepEqual(result.shares, [0.75, 0.5]);
    assert.equal(result.mean, 0.625);
    assert.deepEqual(result.missed, [
        { number: 2, is: "Mycena haematopus", said: ["Mycena galericulata", "(nothing)"] },
    ]);
    const table = confusionTable(
        { key, files: ["answers_first.json", "answers_second.json"] },
        result,
    );
    assert.match(table, /Mean 62\.5 %; first 75\.0 %, second 50\.0 %/);
    assert.match(table, /\| 2 \| \*Mycena haematopus\* \| Mycena galericulata \| \(nothing\) \|/);
});

test("the last naming trial was passed, and its table matches its answers", async () => {
    const folder = path.join(
        import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname),
        "naming_trial",
    );
    const trial = await readTrial(folder);
    assert.ok(trial.judges.length >= 2);
    const result = scored(trial.key, trial.judges);
    assert.ok(result.mean >= pass, `${result.mean}`);
    assert.equal(
        readFileSync(path.join(folder, "confusion.md"), "utf8").trim(),
        confusionTable(trial, result).trim(),
    );
});

test("a covering array contains every pair or triple in fewer rows than the product", () => {
    const sizes = [7, 4, 3, 3, 2];
    for (const strength of [2, 3]) {
        const rows = coveringArray(sizes, strength);
        assert.ok(rows.length < product(sizes).length / 2, `${rows.length} rows`);
        assert.ok(
            rows.every(
                (row) =>
                    row.length === sizes.length &&
                    row.every((value, i) => value >= 0 && value < sizes[i]),
            ),
        );
        const groups = product(sizes.map(() => 2))
            .filter((taken) => taken.filter(Boolean).length === strength)
            .map((taken) => [...taken.keys()].filter((i) => taken[i]));
        for (const group of groups) {
            const seen = new Set(rows.map((row) => group.map((i) => row[i]).join()));
            assert.equal(
                seen.size,
                group.reduce((n, i) => n * sizes[i], 1),
                `factors ${group}`,
            );
        }
    }
});

test("each level is drawn from where the one before ends, at the size that it states", () => {
    const levels = [
        { lod: 0, triangles: 900, screen_coverage: 0.5 },
        { lod: 1, triangles: 90, screen_coverage: 0.1 },
    ];
    const [first, last] = page.rangesOf(levels, 2, 90, 1080);
    // At 90 degrees the screen is twice as high as it is away.
    assert.deepEqual([first.near, first.far.toFixed(9)], [0, "2.000000000"]);
    assert.deepEqual([last.near, last.far.toFixed(9)], [first.far, "10.000000000"]);
    assert.deepEqual([first.pixels, last.pixels], [540, 108]);
    const narrow = page.rangesOf(levels, 2, 45, 2160);
    assert.ok(narrow[0].far > first.far && narrow[0].pixels === 1080);
    for (const [length, text] of [
        [0.0423, "4.2 cm"],
        [0.18, "18 cm"],
        [0.9999, "1 m"],
        [4.16, "4.2 m"],
        [99.4, "99 m"],
        [1300, "1.3 km"],
    ])
        assert.equal(page.metres(length), text);
});

test("the views are part of the page's address, and no request has them", () => {
    const query =
        "panel=export&solids=hidden&weights=phase&level=2&fov=75&screen=2160" +
        "&light=dusk&view=underside&aperture=2.8";
    const view = page.readView(new URLSearchParams(query));
    assert.equal(page.viewQuery(view), `&${query}`);
    assert.deepEqual(page.readView(new URLSearchParams()), page.initialView);
    assert.equal(page.viewQuery(page.initialView), "");
    for (const wrong of [
        "panel=x",
        "weights=sway",
        "level=-1",
        "fov=9",
        "fov=x",
        "screen=1",
        "light=neon",
        "view=behind",
        "aperture=3",
    ])
        assert.deepEqual(page.readView(new URLSearchParams(wrong)), page.initialView, wrong);
    const settings = new page.Settings(
        page.groupsOf(schema).flatMap(({ fields }) => fields),
        "a",
    );
    assert.deepEqual(settings.read(new URLSearchParams(`species=a&lod=1&${query}`)), []);
    assert.equal(settings.pageQuery(new URLSearchParams(query)), `?species=a&lod=1&${query}`);
    assert.equal(settings.request().address, "v1/mushrooms/a.glb?lod=1");
});

test("the request of a set has the options of the file and chooses seeds, ages and levels", () => {
    const settings = new page.Settings(
        page.groupsOf(schema).flatMap(({ fields }) => fields),
        "a:0.7,b:0.3",
    );
    settings.set("seed", 5);
    settings.set("age", 0.25);
    settings.set("lod", 1);
    settings.set("texture_size", 128);
    settings.set("deformation.bend_deg", 20);
    const { seeds, individuals, ...rest } = JSON.parse(page.setRequestOf(settings, [1, 2, 3]));
    assert.ok(seeds >= 1 && individuals >= 1);
    assert.deepEqual(rest, {
        species: ["a:0.7,b:0.3"],
        ages: [0.25],
        first_seed: 5,
        levels: [1, 2, 3],
        texture_size: 128,
        deformation: { bend_deg: 20 },
    });
    const tree = new page.Settings([], "birch", page.trees);
    assert.equal(page.setRequestOf(tree, [0]), undefined, "a set consists of mushrooms");
});

test("points of an aperture are spread evenly over the unit disc", () => {
    const points_ = Array.from({ length: 96 }, (_, index) => page.discPoint(index, 96));
    for (const axis of [0, 1]) {
        const mean = points_.reduce((sum, point) => sum + point[axis], 0) / 96;
        assert.ok(Math.abs(mean) < 0.02, `${mean}`);
        // The mean square of a coordinate over the disc is a quarter.
        const square = points_.reduce((sum, point) => sum + point[axis] ** 2, 0) / 96;
        assert.ok(Math.abs(square - 0.25) < 0.01, `${square}`);
    }
    assert.ok(points_.every(([x, y]) => Math.hypot(x, y) < 1));
    // A lens of 52 mm before a sensor of 24 mm has an angle of 26 degrees.
    assert.ok(Math.abs(page.apertureDiameter(4, 26) - 0.052 / 4) < 0.0001);
});

test("a shifted lens leaves what is in focus where it is, and moves what is farther away", () => {
    const camera = new page.PerspectiveCamera(26, 1.5, 0.01, 100);
    camera.position.set(0.3, 0.4, 1.2);
    camera.lookAt(0, 0.1, 0);
    camera.updateMatrixWorld();
    const focus = camera.position.distanceTo(new page.Vector3(0, 0.1, 0));
    const inFocus = camera.localToWorld(new page.Vector3(0.1, -0.05, -focus));
    const behind = camera.localToWorld(new page.Vector3(0.1, -0.05, -2 * focus));
    const before = [inFocus, behind].map((point) => point.clone().project(camera));
    page.shiftLens(camera, 0.01, -0.02, focus);
    camera.updateMatrixWorld();
    const after = [inFocus, behind].map((point) => point.clone().project(camera));
    assert.ok(Math.hypot(after[0].x - before[0].x, after[0].y - before[0].y) < 1e-9);
    assert.ok(
        after[1].x > before[1].x && after[1].y < before[1].y,
        "what is behind follows the lens",
    );
});

test("a form without a cap has no margin and no underside, a mix has those of its members", () => {
    assert.equal(page.missingOfForms("margin", ["agaric"]), undefined);
    assert.equal(page.missingOfForms("margin", ["puffball"]), "A puffball has no margin");
    assert.equal(
        page.missingOfForms("underside", ["earthstar"]),
        "An earthstar has no underside to look at",
    );
    assert.equal(page.missingOfForms("margin", ["cup"]), undefined);
    assert.ok(page.missingOfForms("underside", ["cup"]));
    assert.equal(page.missingOfForms("underside", ["club", "bolete"]), undefined);
    assert.equal(page.missingOfForms("underside", [undefined]), undefined, "a form not known here");
    assert.equal(page.missingOfForms("base", ["club"]), undefined);
});

test("a close-up shows its size, of a small model a part", () => {
    const of = (x, y, z) => page.frameOf(0.05, new page.Vector3(x, y, z));
    assert.equal(of(0.1, 0.14, 0.1), 0.05);
    assert.ok(Math.abs(of(0.01, 0.02, 0.01) - 0.014) < 1e-12);
});

test("what grows on wood or hangs far below its origin is told from what stands on the ground", () => {
    const { Box3, Group, Vector3, hangsOnWall, woodOf } = page;
    const between = (low, high) => new Box3(new Vector3(-1, low, -1), new Vector3(1, high, 1));
    const model = new Group();
    assert.equal(hangsOnWall(model, between(-0.1, 1)), false, "a foot in the soil");
    assert.equal(hangsOnWall(model, between(-0.35, 0.65)), false, "an egg of a stinkhorn");
    assert.equal(hangsOnWall(model, between(-0.6, 0.6)), true, "an impostor of a bracket");
    const level = new Group();
    level.name = "fomes_fomentarius_s1_LOD0";
    const wood = new Group();
    wood.name = "fomes_fomentarius_s1_LOD0_wood";
    level.add(wood);
    model.add(level);
    assert.equal(woodOf(model), wood);
    assert.equal(hangsOnWall(model, between(-0.1, 1)), true, "a tier high up its trunk");
});

test("a drawn line keeps its shape with few points, and never has more than the service reads", () => {
    const wave = Array.from({ length: 400 }, (_, i) => [i, 50 * Math.sin(i / 4)]);
    const many = page.simplified(wave, 0.5);
    assert.ok(many.length <= page.mostPoints, `${many.length} points`);
    assert.deepEqual([many[0], many.at(-1)], [wave[0], wave.at(-1)], "its ends stay");
    const straight = Array.from({ length: 90 }, (_, i) => [i, 2 * i + (i % 2)]);
    assert.equal(page.simplified(straight, 2).length, 2);
    const bent = [...straight, ...straight.map(([x, y]) => [x + 90, 180 - y])];
    assert.equal(page.simplified(bent, 2).length, 3);
    assert.deepEqual(page.simplified([], 2), []);
});

test("a gesture is sent without what was not drawn, its frame as a rectangle", () => {
    const axis = [
        [4, 9],
        [4, 1],
    ];
    const drawing = {
        gesture: page.withStroke(page.nothingDrawn, "axis", axis),
        template: "auto",
        form: "auto",
        images: false,
        heightMm: undefined,
    };
    const side = { side: "p1" };
    assert.deepEqual(page.orderOf(drawing, side), {
        views: { side: { photo: "p1", gesture: { axis } } },
        template: "auto",
        form: "auto",
        images: false,
    });
    const framed = page.withStroke(drawing.gesture, "frame", [
        [9, 2],
        [1, 12],
    ]);
    const order = page.orderOf({ gesture: framed, template: "x", form: "cup", images: true, heightMm: 80 }, side);
    assert.deepEqual(order, {
        views: { side: { photo: "p1", gesture: { axis, frame: [1, 2, 8, 10] } } },
        template: "x",
        form: "cup",
        images: true,
        height_m: 0.08,
    });
    assert.deepEqual(page.orderOf(page.startOfDrawing, side), {
        views: { side: { photo: "p1" } },
        template: "auto",
        form: "auto",
        images: true,
    });
});

test("photographs of the cap are sent with what was drawn on them", () => {
    const across = [
        [2, 5],
        [8, 5],
    ];
    const drawn = page.withStroke(page.nothingDrawn, "axis", across);
    const drawing = {
        ...page.startOfDrawing,
        source: 1,
        views: {
            above: { source: 4, gesture: drawn, centre: [5, 4], stemEnd: undefined },
            below: { source: 2, gesture: page.nothingDrawn, centre: undefined, stemEnd: [5, 9] },
        },
    };
    const { views } = page.orderOf(drawing, { side: "p1", above: "p4", below: "p2" });
    assert.deepEqual(views, {
        side: { photo: "p1" },
        above: { photo: "p4", gesture: { axis: across }, centre: [5, 4] },
        below: { photo: "p2", stem_end: [5, 9] },
    });
    const named = page.orderOf(drawing, { side: "p1", below: "p2" });
    assert.deepEqual(Object.keys(named.views), ["side", "below"], "one without a name is left out");
    assert.deepEqual(page.sourcesOf(drawing), [1, 4, 2]);
    assert.deepEqual(page.sourcesOf(page.startOfDrawing), []);
    const isComplete = (gesture, cutOut) => page.isComplete({ gesture }, cutOut);
    assert.equal(isComplete(page.nothingDrawn, false), false);
    assert.equal(isComplete(page.nothingDrawn, true), true, "a picture that is cut out needs no line");
    assert.equal(isComplete(page.withStroke(page.nothingDrawn, "cap", across), true), false);
    assert.equal(isComplete(drawn, false), true);
});

test("strokes that correct add up, the two lines are drawn anew", () => {
    const line = (x) => [
        [x, 0],
        [x, 9],
    ];
    let gesture = page.nothingDrawn;
    for (const tool of ["axis", "cap", "keep", "drop"])
        for (const x of [1, 2]) gesture = page.withStroke(gesture, tool, line(x));
    assert.deepEqual(gesture.axis, line(2));
    assert.deepEqual(gesture.keep, [line(1), line(2)]);
    assert.equal(page.strokeCount(gesture), 6);
    const moved = page.withPoint(gesture, "drop", [1, 0], [7, 7]);
    assert.deepEqual(moved.drop, [
        line(1),
        [
            [7, 7],
            [2, 9],
        ],
    ]);
    assert.deepEqual(gesture.drop, [line(1), line(2)], "the old gesture is as it was");
    assert.deepEqual(page.withStrokes(gesture, "axis", []).axis, []);
});

test("the page says which line is missing; what is cut out needs none", () => {
    const line = [
        [0, 0],
        [0, 9],
    ];
    const axis = page.withStroke(page.nothingDrawn, "axis", line);
    assert.equal(page.missingLine(page.nothingDrawn, false), "axis");
    assert.equal(page.missingLine(axis, false), "cap");
    assert.equal(page.missingLine(page.withStroke(axis, "cap", line), false), undefined);
    assert.equal(page.missingLine(page.nothingDrawn, true), undefined);
    assert.equal(page.missingLine(axis, true), undefined);
});

test("a pointer of the service finds its place on the designer's page", () => {
    for (const tool of page.tools)
        assert.equal(page.placeOf(`/views/side/gesture/${tool}/0/1`), tool);
    assert.equal(page.placeOf("/views/side"), "photo");
    assert.equal(page.placeOf("/views/side/photo"), "photo");
    for (const pointer of ["", "/photo", "/gesture", "/gesture/axis/0", "/centre"])
        for (const side of page.capSides) assert.equal(page.placeOf(`/views/${side}${pointer}`), side);
    assert.equal(page.placeOf("/height_m"), "height");
    assert.equal(page.placeOf("/template"), "template");
    assert.equal(page.placeOf("/elsewhere"), undefined);
});

test("a name of the library resembles a title, and the library allows it", () => {
    const named = new RegExp(`^${page.namePattern}$`);
    const names = {
        "Red bolete": "red_bolete",
        "King Alfred's cakes": "king_alfred_s_cakes",
        "Champiñón  de París": "champinon_de_paris",
        "3rd _ attempt": "rd_attempt",
        "": "my_mushroom",
        ポルチーニ: "my_mushroom",
        [`${"x".repeat(23)} y`]: "x".repeat(23),
    };
    for (const [title, name] of Object.entries(names)) {
        assert.equal(page.nameLike(title), name);
        assert.match(name, named);
    }
});

test("a photograph gives its species a title, unless its name is a camera's", () => {
    const titles = {
        "red_bolete.jpg": "Red bolete",
        "champiñón-de-París (2).webp": "Champiñón de París 2",
        "under the birch.png": "Under the birch",
        "IMG_20261128_1203.jpg": undefined,
        "DSCF0042.JPG": undefined,
        "photo1.jpg": undefined,
        "Screenshot 3.png": undefined,
        "image.png": undefined,
        "": undefined,
    };
    for (const [file, title] of Object.entries(titles)) assert.equal(page.titleOfFile(file), title, file);
    assert.equal(page.titleOfFile(`${"mushroom ".repeat(20)}.jpg`).length <= 64, true);
});

test("a token is taken from the fragment of an address, and from nothing else", () => {
    const token = `spk_abcdefgh_${"A".repeat(43)}`;
    for (const text of [`#token=${token}`, token, ` ${token} `, `http://127.0.0.1:8080/editor#token=${token}`])
        assert.equal(page.tokenIn(text), token);
    for (const other of ["", "#", "#token=", `?token=${token}`, `#token=${token}x`, "#token=<b>"])
        assert.equal(page.tokenIn(other), undefined, other);
});

test("points outside of a picture come to its border, as whole pixels", () => {
    assert.deepEqual(page.inside([-3, 7.6], { width: 10, height: 20 }), [0, 8]);
    assert.deepEqual(page.inside([10, 20], { width: 10, height: 20 }), [9, 19]);
});

test("height and cap are read from the outline, and numbers are told with their units", () => {
    const silhouette = {
        stem: [
            { r: 0, y: -0.01 },
            { r: 0.02, y: 0.08 },
        ],
        hymenium: [
            { r: 0.02, y: 0.08 },
            { r: 0.05, y: 0.085 },
        ],
        cap: [
            { r: 0.05, y: 0.085 },
            { r: 0, y: 0.12 },
        ],
    };
    assert.deepEqual(page.sizeOf({ silhouette }), { height: 0.12, cap: 0.1 });
    assert.equal(page.sizeOf({}), undefined);
    assert.equal(page.millimetres(0.0123), "12.3 mm");
    assert.equal(page.millimetres(0.1234), "123 mm");
    const rows = page.rowsOf({
        angles: { lean_deg: -2.1, bend_deg: 8 },
        asymmetry_pct: 1.24,
        error_pct: 0.4,
        ring: { height_m: 0.05, width_m: 0.006 },
        method: "straightened",
        certificate: { simple: true, method: "monotone" },
        stage: 0,
        species: { stages: [{ model: { silhouette } }] },
    });
    const values = Object.fromEntries(rows.map(([name, value]) => [name, value]));
    assert.equal(values.Height, "120 mm");
    assert.equal(values.Cap, "100 mm across");
    assert.equal(values.Ring, "50 mm high");
    assert.equal(values.Asymmetry, "1.2 %");
    assert.equal(values.Lean, "2° to the left");
    assert.match(values.Method, /bends less/);
    assert.match(values.Proof, /never crosses/);
});

const bolete = {
    stem: [
        { r: 0, y: -0.0198 },
        { r: 0.02475, y: -0.01155 },
        { r: 0.0275, y: 0.018 },
        { r: 0.0212, y: 0.07 },
        { r: 0.0205, y: 0.084 },
    ],
    hymenium: [
        { r: 0.0205, y: 0.084 },
        { r: 0.0335, y: 0.0848 },
        { r: 0.0532, y: 0.0838 },
    ],
    cap: [
        { r: 0.0532, y: 0.0838 },
        { r: 0.0566, y: 0.0892 },
        { r: 0.0358, y: 0.1168 },
        { r: 0, y: 0.1237 },
    ],
    junction: "corner",
    margin: "smooth",
};

test("the outline goes through its points, and shared points are moved in both curves", () => {
    const controls = page.controlsOf(bolete);
    assert.equal(controls.length, 5 + 2 + 3);
    const line = page.polylineOf(bolete, 6);
    assert.equal(line.length, 9 * 6 + 1);
    controls.forEach(({ r, y }, index) => {
        const sample = line[index * 6];
        assert.ok(Math.hypot(sample.r - r, sample.y - y) < 1e-12, `point ${index}`);
    });
    assert.equal(page.crossingOf(bolete), undefined);
    const junction = page.withControl(bolete, 4, { r: 0.022, y: 0.083 });
    assert.deepEqual(junction.stem.at(-1), { r: 0.022, y: 0.083 });
    assert.deepEqual(junction.hymenium[0], { r: 0.022, y: 0.083 });
    assert.equal(page.withControl(bolete, 9, { r: 0.01, y: 0.13 }).cap.at(-1).r, 0);
    assert.deepEqual(page.withControl(bolete, 2, bolete.stem[2]), bolete);
});

test("no drag lets the outline cross itself, and one that would stops before it", () => {
    const far = page.moved(bolete, 5, { r: 0.0335, y: 0.2 });
    assert.deepEqual(far.stopped, ["hymenium", "cap"]);
    assert.equal(page.crossingOf(far.silhouette), undefined);
    const { y } = far.silhouette.hymenium[1];
    assert.ok(y > 0.1 && y < 0.12, `it went up to ${y}, below the cap`);
    assert.deepEqual(page.moved(bolete, 2, { r: -0.1, y: 0.018 }).stopped, ["stem", "axis"]);
    let random = 7;
    const draw = () => (random = (random * 16807) % 2147483647) / 2147483647;
    let silhouette = bolete;
    for (let n = 0; n < 200; ++n) {
        const at = Math.floor(draw() * 10);
        const to = { r: 0.08 * draw(), y: 0.16 * draw() - 0.02 };
        ({ silhouette } = page.moved(silhouette, at, to));
        assert.equal(page.crossingOf(silhouette), undefined, `drag ${n}`);
    }
});

test("a point is inserted on the curve, and removing it gives the outline back", () => {
    for (let at = 0; at < 9; ++at) {
        const more = page.withInserted(bolete, at);
        assert.equal(page.controlsOf(more).length, 11);
        const middle = page.polylineOf(bolete, 2)[2 * at + 1];
        const { r, y } = page.controlsOf(more)[at + 1];
        assert.ok(Math.hypot(middle.r - r, middle.y - y) < 1e-12);
        assert.ok(page.isRemovable(more, at + 1));
        assert.deepEqual(page.withRemoved(more, at + 1), bolete);
    }
    for (const shared of [0, 4, 6, 9]) {
        assert.equal(page.isRemovable(bolete, shared), false);
        assert.deepEqual(page.withRemoved(bolete, shared), bolete);
    }
});

test("a place of the outline is found again on the photograph, on both sides of a bent axis", () => {
    const axis = [
        [400, 700],
        [410, 500],
        [450, 300],
        [470, 200],
    ];
    const frame = new page.AxisFrame(axis, 0.12);
    for (const side of [-1, 1])
        for (const place of [
            { r: 0, y: 0 },
            { r: 0.02, y: 0.01 },
            { r: 0.05, y: 0.1 },
            { r: 0.01, y: -0.02 },
            { r: 0.03, y: 0.14 },
        ]) {
            const found = frame.fromPhoto(frame.toPhoto(place, side));
            assert.ok(Math.hypot(found.r - place.r, found.y - place.y) < 2e-3 * (1 + place.r / 0.01));
        }
    const [left, right] = [-1, 1].map((side) => frame.toPhoto({ r: 0.02, y: 0.05 }, side));
    assert.ok(left[0] < right[0], "the left side is on the left");
    const top = frame.toPhoto({ r: 0, y: 0.12 }, 1);
    assert.ok(Math.hypot(top[0] - 470, top[1] - 200) < 1e-9);
});

test("a dragged curve takes both points of its piece along, and a whole curve all of its own", () => {
    const by = { r: 0, y: 0.001 };
    const { silhouette: piece, stopped } = page.dragged(bolete, page.weightsOfPiece(7, 0.25), by);
    assert.equal(stopped, undefined);
    page.controlsOf(piece).forEach(({ r, y }, at) => {
        const old = page.controlsOf(bolete)[at];
        const share = { 7: 0.75, 8: 0.25 }[at] ?? 0;
        assert.ok(Math.hypot(r - old.r, y - old.y - share * by.y) < 1e-12, `point ${at}`);
    });
    const weights = page.weightsOfCurve(bolete, "cap");
    const { silhouette: whole } = page.dragged(bolete, weights, by);
    for (const [at, { curve, y }] of page.controlsOf(whole).entries()) {
        const { y: old } = page.controlsOf(bolete)[at];
        // The margin belongs to the lower face and to the cap.
        const moves = curve === "cap" || at === 6;
        assert.ok(Math.abs(y - old - (moves ? by.y : 0)) < 1e-12, `point ${at} of the ${curve}`);
    }
    const far = page.dragged(bolete, page.weightsOfCurve(bolete, "cap"), { r: 0, y: -0.2 });
    assert.ok(far.stopped, "a cap is not dragged through the stem");
    assert.equal(page.crossingOf(far.silhouette), undefined);
});

test("the nearest place of the curve is found, and a point is inserted there", () => {
    for (const span of [1, 5, 8])
        for (const share of [0.25, 0.5, 0.75]) {
            const place = page.polylineOf(bolete, 4)[4 * span + 4 * share];
            const found = page.nearestOn(bolete, place);
            assert.equal(found.span, span);
            assert.ok(Math.abs(found.share - share) < 0.03 && found.away < 1e-12);
            const more = page.withInserted(bolete, span, found.share);
            const control = page.controlsOf(more)[span + 1];
            assert.ok(Math.hypot(control.r - place.r, control.y - place.y) < 1e-12);
        }
});

test("brackets walk from curve to curve and stay at the ends", () => {
    const curveAt = (at) => page.controlsOf(bolete)[at].curve;
    let at = 2;
    const names = ["stem", "hymenium", "cap", "cap"];
    for (const name of names.slice(1)) {
        at = page.startOfCurve(bolete, at, 1);
        assert.equal(curveAt(at), name);
    }
    at = page.startOfCurve(bolete, at, -1);
    assert.equal(curveAt(at), "hymenium");
    at = page.startOfCurve(bolete, page.startOfCurve(bolete, at, -1), -1);
    assert.equal(curveAt(at), "stem");
});

test("a dragged point snaps to the nearest measured line and to the ground", () => {
    const line = [
        { r: 0.02, y: 0 },
        { r: 0.02, y: 0.1 },
    ];
    assert.deepEqual(page.snapped({ r: 0.0205, y: 0.05 }, [line], 0.001), { r: 0.02, y: 0.05 });
    assert.equal(page.snapped({ r: 0.022, y: 0.05 }, [line], 0.001), undefined);
    assert.deepEqual(page.snapped({ r: 0.03, y: -0.0005 }, [line], 0.001), { r: 0.03, y: 0 });
});

test("values of a document are changed by pointer, and nothing else is", () => {
    const species = { id: "own", stages: [{ age: 0, model: { surface: { cap: { image: "x" } } } }] };
    const before = structuredClone(species);
    const ramp = ["#000000", "#FFFFFF"];
    const changed = page.withDetails(species, {
        "/stages/0/model/surface/cap/ramp": ramp,
        "/stages/0/model/surface/cap/image": undefined,
        "/stages/7/model/form": "swept",
        "/spread/size": 0.3,
        "/facts/sources": undefined,
    });
    assert.deepEqual(species, before, "documents are immutable");
    assert.deepEqual(changed, {
        id: "own",
        stages: [{ age: 0, model: { surface: { cap: { ramp } } } }],
        spread: { size: 0.3 },
    });
    assert.equal(page.atPointer(changed, "/stages/0/model/surface/cap/ramp/1"), "#FFFFFF");
    assert.equal(page.atPointer(changed, "/stages/3/model"), undefined);
    const details = {
        "/stages/1/model/axis": [],
        "/stages/1/model/deformation/bend_deg": 3,
        "/stages/1/model/warts/count": 4,
        "/spread/size": 0.2,
    };
    assert.deepEqual(Object.keys(page.withoutGeometry(details)), [
        "/stages/1/model/warts/count",
        "/spread/size",
    ]);
    assert.deepEqual(page.withoutStages(details), { "/spread/size": 0.2 });
    assert.equal(page.withoutStages({ "/stages/1/age": 0.1 }), undefined);
});

const colour = (fallback) => ({ type: "string", format: "color", "x-default": fallback });
const amount = { type: "number", minimum: 0, maximum: 1, "x-default": 0.2 };
/** A species' schema in small: what the page knows of the document is from it. */
const modelSchema = {
    type: "object",
    properties: {
        warts: {
            type: "object",
            title: "warts",
            properties: {
                count: { type: "integer", minimum: 0, maximum: 1600, "x-default": 0 },
                size: { ...amount, description: "Radius of a piece." },
            },
        },
        surface: {
            type: "object",
            properties: {
                cap: {
                    type: "object",
                    properties: {
                        ramp: {
                            type: "array",
                            maxItems: 6,
                            items: colour("#000000"),
                            "x-default": ["#C8A078", "#B48C64"],
                        },
                        roughness: amount,
                        image: { type: "string" },
                    },
                },
                stem: { type: "object", properties: { top: colour("#F0E6D2") } },
            },
        },
    },
    oneOf: [
        {
            properties: {
                form: { const: "swept" },
                silhouette: { type: "object", properties: { cap: { type: "array" } } },
                azimuth: { type: "object", properties: { lobes: amount } },
            },
        },
        {
            properties: {
                form: { const: "branched" },
                limbs: { type: "object", properties: { web: amount } },
            },
        },
    ],
};

test("every colour of the schema can be painted, and a painted part loses its image", () => {
    const parts = page.paintedParts(modelSchema);
    assert.deepEqual(
        parts.map(({ member }) => member),
        ["surface/cap", "surface/stem"],
    );
    const [cap, stem] = parts;
    assert.equal(cap.ramp.most, 6);
    assert.equal(cap.hasImage, true);
    assert.equal(page.paintOf({}, stem.colours[0]), "#F0E6D2");
    assert.deepEqual(page.rampOf({}, cap), ["#C8A078", "#B48C64"]);
    const models = [
        { surface: { cap: { ramp: ["#000000", "#FFFFFF"], image: "…" } } },
        { surface: { cap: { ramp: ["#111111", "#222222"] } } },
    ];
    const more = page.painted(models, cap, cap.ramp.member, (model) =>
        page.withStop(page.rampOf(model, cap), 0),
    );
    assert.deepEqual(more, {
        "/stages/0/model/surface/cap/ramp": ["#000000", "#808080", "#FFFFFF"],
        "/stages/0/model/surface/cap/image": undefined,
        "/stages/1/model/surface/cap/ramp": ["#111111", "#1A1A1A", "#222222"],
    });
    const own = page.painted(models, stem, "surface/stem/top", (_, stage) =>
        stage === 1 ? "#ABCDEF" : undefined,
    );
    assert.deepEqual(own, { "/stages/1/model/surface/stem/top": "#ABCDEF" });
    assert.deepEqual(page.withoutStop(["#000000", "#FFFFFF"], 0), ["#000000", "#FFFFFF"]);
    assert.deepEqual(page.withoutStop(["#000000", "#111111", "#FFFFFF"], 1), ["#000000", "#FFFFFF"]);
});

test("an eyedropper takes the mean of what is not transparent, and texts become colours", () => {
    const pixels = [200, 10, 0, 255, 100, 20, 0, 255, 0, 0, 255, 0];
    assert.equal(page.meanColour(pixels), "#960F00");
    assert.equal(page.meanColour([1, 2, 3, 0]), undefined);
    assert.equal(page.readColour(" c8a078 "), "#C8A078");
    for (const none of ["", "#12345", "red", "#1234567"]) assert.equal(page.readColour(none), undefined);
});

test("the form of a model has what no other panel has, with the values of its document", () => {
    const form = page.formOf(modelSchema, "model", false);
    assert.deepEqual(form.fields.map(({ name }) => name).sort(), [
        "azimuth.lobes",
        "limbs.web",
        "surface.cap.roughness",
        "warts.count",
        "warts.size",
    ]);
    assert.ok(form.groups.some(({ label }) => label === "Surface · Cap"));
    const values = new page.DocumentValues(form);
    const own = { stages: [{ model: { form: "swept", warts: { count: 40 } } }] };
    values.read(own, { "/stages/0/model/warts/size": 0.5, "/spread/size": 1 }, "/stages/0/model");
    const { effective } = values;
    assert.equal(page.valueAt(effective, "warts.count"), 40, "its own");
    assert.equal(page.valueAt(effective, "warts.size"), 0.2, "the default");
    assert.equal(page.valueAt(effective, "azimuth.lobes"), 0.2);
    assert.equal(page.valueAt(effective, "limbs.web"), undefined, "a cap has no limbs");
    assert.deepEqual([...values.values], [["warts.size", 0.5]]);
    values.set("warts.count", 12);
    assert.deepEqual(values.change("warts.count"), {
        pointer: "/stages/0/model/warts/count",
        value: 12,
    });
    values.set("warts.size", undefined);
    assert.equal(values.change("warts.size").value, undefined, "again as it was");
    const facts = { properties: { id: { type: "string", maxLength: 6 } } };
    const named = new page.DocumentValues(page.formOf(facts, "species", true));
    named.read({ id: "cep" }, undefined, "");
    named.set("id", "my_cep");
    assert.deepEqual(named.change("id"), { pointer: "/id", value: "my_cep" });
    for (const [text, reason] of [
        ["My Cep", /letters a to z/],
        ["", /letters a to z/],
        ["too_long", /8 letters; at most 6/],
    ]) {
        named.set("id", text);
        assert.throws(() => named.change("id"), reason);
    }
    for (const name of ["warts.count", "spines.to", "surface.hymenium.pattern", "limbs.trunks"])
        assert.ok(page.isEqualInAllStages(name), name);
    for (const name of ["warts.size", "hymenium.blades", "surface.cap.roughness"])
        assert.equal(page.isEqualInAllStages(name), false, name);
});

test("lists are texts in the form and are refused with a reason", () => {
    const numbers = { type: "number", minimum: 0, maximum: 1 };
    const pair = { items: numbers, fewest: 2, most: 2 };
    assert.deepEqual(page.readList("0.1, 0.2", pair), [0.1, 0.2]);
    assert.match(page.readList("0.1", pair), /1 values; 2 are needed/);
    assert.match(page.readList("0.1, 3", pair), /3 is above 1/);
    assert.match(page.readList("0.1, much", pair), /"much" is no number/);
    const months = { items: { type: "integer", minimum: 1, maximum: 12 }, fewest: 0, most: 12 };
    assert.match(page.readList("4.5", months), /no whole number/);
    assert.deepEqual(page.readList("", months), []);
    const rows = { items: { items: numbers }, fewest: 0, most: 12 };
    assert.deepEqual(page.readList("0.5, 0.5; 1, 0, 0", rows), [
        [0.5, 0.5],
        [1, 0, 0],
    ]);
    assert.equal(page.listText([[0.5, 0.5], [1]], rows.items), "0.5, 0.5; 1");
    const sources = { items: { type: "string", maxLength: 8 }, fewest: 0, most: 2 };
    assert.deepEqual(page.readList("a, b; c", sources), ["a, b", "c"]);
    assert.match(page.readList("far too long", sources), /longer than 8/);
    assert.match(page.readList("a; b; c", sources), /at most 2/);
});

test("an axis bends until the stem would fold, and its angles are those of its ends", () => {
    const upright = page.uprightAxis(5);
    assert.deepEqual(page.anglesOf(upright), { bend_deg: 0, lean_deg: 0 });
    assert.equal(page.foldOf(upright, bolete), 0);
    const { axis, stopped } = page.bent(upright, 4, { x: 0.04, y: 1 }, bolete);
    assert.equal(stopped, false);
    const { bend_deg: bend, lean_deg: lean } = page.anglesOf(axis);
    assert.ok(bend > 5 && bend < 15 && lean < 5, `${bend}°, ${lean}°`);
    const fold = page.bent(upright, 2, { x: 1.5, y: 0.2 }, bolete);
    assert.equal(fold.stopped, true);
    assert.ok(page.foldOf(fold.axis, bolete) <= 0.81);
    assert.deepEqual(page.bent(upright, 0, { x: 1, y: 1 }, bolete).axis, upright, "the root stays");
});

test("an axis has as many points as wanted without another shape", () => {
    const axis = [0, 0.25, 0.5, 0.75, 1].map((y) => ({ x: 0.2 * y * y, y, z: 0 }));
    const { bend_deg: bend } = page.anglesOf(axis);
    for (const count of [4, 9, 13]) {
        const other = page.resampled(axis, count);
        assert.equal(other.length, count);
        assert.ok(Math.abs(page.anglesOf(other).bend_deg - bend) < 4);
        assert.ok(Math.abs(other.at(-1).x - 0.2) < 1e-9);
    }
    const more = page.withAxisPoint(axis, 1);
    assert.equal(more.length, 6);
    assert.deepEqual(page.withoutAxisPoint(more, 2), axis);
    assert.deepEqual(page.withoutAxisPoint(axis, 0), axis, "both ends stay");
    const full = page.resampled(axis, page.mostAxisPoints);
    assert.equal(page.withAxisPoint(full, 1).length, page.mostAxisPoints);
});

test("a model stands on the photograph where it was traced, along its own axis", () => {
    const line = [
        [400, 700],
        [400, 100],
    ];
    const traced = new page.AxisFrame(line, 0.12);
    const straight = page.placed({ silhouette: bolete }, traced);
    assert.equal(straight.frame, traced);
    const axis = [0, 0.5, 1].map((y) => ({ x: 0.1 * y, y, z: 0 }));
    const { frame, toPhoto, fromPhoto } = page.placed({ silhouette: bolete, axis }, traced);
    const { base, top } = page.stemOf(bolete);
    const [x, y] = frame.toPhoto({ r: 0, y: base }, 1);
    const root = traced.toPhoto({ r: 0, y: base }, 1);
    assert.ok(Math.hypot(x - root[0], y - root[1]) < 1e-6);
    const end = frame.toPhoto({ r: 0, y: top }, 1);
    const there = toPhoto(axis[2]);
    assert.ok(Math.hypot(end[0] - there[0], end[1] - there[1]) < 0.5);
    assert.ok(end[0] > 405, "it leans to the right");
    const back = fromPhoto(there);
    assert.ok(Math.hypot(back.x - 0.1, back.y - 1) < 1e-9);
});

test("the window on a picture zooms about a place and never leaves the picture", () => {
    const extent = { width: 1000, height: 500 };
    const whole = page.boundsWith(extent, undefined);
    assert.deepEqual(whole, { x: 0, y: 0, ...extent });
    assert.deepEqual(page.boundsWith(extent, { x: 10, y: 10, width: 300, height: 300 }), whole);
    const lower = page.boundsWith(extent, { x: 10, y: 10, width: 300, height: 600 });
    assert.deepEqual(lower, { x: 0, y: 0, width: 1000, height: 650 });
    const near = page.zoomed(whole, whole, 4, [250, 125]);
    assert.deepEqual(near, { x: 187.5, y: 93.75, width: 250, height: 125 });
    assert.deepEqual(page.zoomed(near, whole, 0.1, [0, 0]), whole);
    assert.equal(page.zoomed(near, whole, 1e9, [1000, 500]).width, 1000 / 16);
    const box = page.viewOf({ x: 900, y: 400, width: 50, height: 90 }, whole);
    assert.ok(box.x + box.width <= 1000 && box.y + box.height <= 500 && box.height >= 90);
});

test("steps of a history come back with it, and a stage has its outline and its words", () => {
    const first = new page.History(1);
    for (const value of [2, 3, 4]) first.push(value);
    first.undo();
    const again = new page.History(0);
    again.begin(first.value, first.steps.past, first.steps.future);
    assert.deepEqual([again.redo(), again.undo(), again.undo(), again.undo()], [4, 3, 2, 1]);
    assert.equal(again.undoable, false);
    const d = page.smallOutline(bolete);
    assert.match(d, /^M[\d. L-]+Z$/);
    for (const value of d.match(/[\d.]+/g).map(Number)) assert.ok(value >= 3.9 && value <= 96.1);
    const { title } = page.captionOf({ age: 0.3, name: "button", model: { silhouette: bolete } });
    assert.match(title, /^30 %, \d+ mm$/);
});

test("a search finds species by every word of it", () => {
    const cep = { id: "boletus_edulis", common_name: "Cep", form: "bolete" };
    for (const search of ["", "cep", "BOLETUS", "bolete cep"]) assert.ok(page.isFound(cep, search));
    assert.equal(page.isFound(cep, "cep agaric"), false);
});

test("the file of a species is opened on paper, and what is none is refused by its place", async () => {
    const stage = (age) => ({ age, name: "", model: { form: "swept", silhouette: bolete } });
    const species = { id: "own", stages: [stage(0), stage(0.5), stage(1)] };
    const refused = (value, reason) =>
        assert.throws(() => page.readSpecies(JSON.stringify(value)), reason);
    assert.throws(() => page.readSpecies("{"), /not JSON/);
    for (const none of [null, 7, {}, { stages: [] }, { stages: 3 }]) refused(none, /\/stages/);
    refused({ stages: [stage(0), { age: 1, model: {} }] }, /\/stages\/1\/model\/silhouette/);
    refused({ stages: [stage("old")] }, /\/stages\/0\/age/);
    const coral = { form: "branched", limbs: { height: 0.1 } };
    const branched = { id: "coral", stages: [{ age: 0.6, name: "", model: coral }] };
    const opened = await page.SpeciesFile.read(new Blob([JSON.stringify(branched)]));
    assert.deepEqual((await opened.trace()).species, branched, "branches have no outline");
    const file = await page.SpeciesFile.read(new Blob([JSON.stringify(species)]));
    const trace = await file.trace();
    assert.equal(trace.stage, 1);
    assert.deepEqual(trace.species, species, "nothing of it is lost");
    for (const [x, y] of [...trace.outline.left, ...trace.outline.right])
        assert.ok(x >= 50 && x <= 950 && y >= 50 && y <= 950, `${x}, ${y} is on the paper`);
    assert.deepEqual(
        page.rowsOf(trace).map(([name]) => name),
        ["Height", "Cap", "Method"],
    );
    assert.match(await (await file.picture()).text(), /^<svg /);
});

// --- Breeding ---

/** Returns a pedigree with three generations: a child of two founders, and two children of it. */
function threeGenerations() {
    const pedigree = new page.Pedigree();
    for (const [key, name] of [["boletus_edulis", "Cep"], ["amanita_muscaria", "Fly agaric"]])
        pedigree.add({ key, name, family: "swept" });
    const genes = { seed: 3, share: 0.25, mutation: 0.4, lock: ["surface.cap", "ring"] };
    const first = pedigree.addChild({ a: "boletus_edulis", b: "amanita_muscaria", genes }).key;
    const alone = pedigree.addCouple(first, first, { ...genes, seed: 10 });
    const second = pedigree.addChild({ a: first, b: first, genes: { ...genes, seed: 12 } }).key;
    const back = pedigree.addCouple(second, "amanita_muscaria", { ...genes, seed: 4294967290 });
    const other = pedigree.addCouple(first, "amanita_muscaria", genes);
    return { pedigree, first, second, alone, back, other };
}

test("the address of a couple has all that its children come from", () => {
    const { pedigree, back } = threeGenerations();
    const query = page.coupleQuery(pedigree, back);
    assert.match(query, /^[?&=.,;\w-]+$/, "nothing in it is escaped");
    const read = page.readCouple(query);
    const elsewhere = new page.Pedigree();
    for (const birth of read.births) elsewhere.addChild(birth);
    const couple = elsewhere.addCouple(read.a, read.b, read.genes);
    assert.equal(couple.key, back.key);
    assert.deepEqual({ ...couple.genes }, { ...back.genes, lock: ["ring", "surface.cap"] });
    assert.equal(page.coupleQuery(elsewhere, couple), query);
    assert.equal(page.readCouple("?species=x"), undefined);
    const library = page.readCouple("?a=~me.kid@3&b=own-0123456789a");
    assert.deepEqual([library.a, library.b], ["~me.kid@3", "own-0123456789a"]);
    for (const [wrong, said] of [
        ["?a=.2&line=x,y,1,0,0", /line has no child \.2/],
        ["?a=x&seed=4294967296", /seed '4294967296'/],
        ["?a=x&share=1.5", /share '1\.5'/],
        ["?a=x&mutation=much", /mutation 'much'/],
        ["?a=x&lock=a%20b", /lock 'a b'/],
        ["?a=../x", /'\.\.\/x'|no child/],
        ["?a=x&b=y%2F..", /'y\/\.\.' is no species/],
    ])
        assert.throws(() => page.readCouple(wrong), said, wrong);
});

test("a line that is too long for an address has none", () => {
    const { pedigree, back } = threeGenerations();
    let [a, depth] = [back.a, 0];
    for (; depth < 400; ++depth) {
        a = pedigree.addChild({ a, b: a, genes: { ...back.genes, seed: depth } }).key;
        const query = page.coupleQuery(pedigree, pedigree.addCouple(a, a, back.genes));
        if (query === undefined) break;
        assert.ok(query.length <= page.mostLetters);
    }
    assert.ok(depth > 60 && depth < 400, `${depth} generations have an address`);
});

test("children are named by generation and seed, and seeds go round", () => {
    const { pedigree, first, second, alone, back } = threeGenerations();
    assert.equal(pedigree.name(first), "F1·3");
    assert.equal(pedigree.name(second), "F2·12");
    assert.equal(pedigree.coupleName(alone), "F1·3 alone");
    assert.equal(pedigree.descent(back), "of F2·12 × Fly agaric");
    assert.equal(pedigree.get(second).family, "swept");
    const seeds = page.seedsFrom(4294967290);
    assert.deepEqual(seeds.slice(4), [4294967294, 4294967295, 0, 1, 2]);
    assert.equal(page.nextSeeds(4294967290), 3);
    const same = page.keyOfBirth({ a: "x", b: "y", genes: { seed: 1, share: 0, mutation: 0, lock: ["b", "a", "b"] } });
    assert.equal(same, page.keyOfBirth({ a: "x", b: "y", genes: { seed: 1, share: 0, mutation: 0, lock: ["a", "b"] } }));
    const hashes = new Set(Array.from({ length: 20000 }, (_, index) => page.hashOf(`x,y,${index},0.5,0.2,`)));
    assert.equal(hashes.size, 20000);
});

test("the family tree has a row for each couple, and branches in lanes of their own", () => {
    const { pedigree } = threeGenerations();
    pedigree.addCouple("amanita_muscaria", "amanita_muscaria", page.firstGenes);
    const rows = page.treeRows(pedigree).map(({ couple, lane, from, level }) => [pedigree.coupleName(couple), lane, from, level]);
    assert.deepEqual(rows, [
        ["Cep × Fly agaric", 0, undefined, 1],
        ["F1·3 alone", 0, 0, 2],
        ["F2·12 × Fly agaric", 0, 1, 3],
        ["F1·3 × Fly agaric", 1, 0, 2],
        ["Fly agaric alone", 0, undefined, 1],
    ]);
});

test("a branch is taken off the tree, but for what others come from", () => {
    const names = (pedigree) => page.treeRows(pedigree).map(({ couple }) => pedigree.coupleName(couple));
    const { pedigree, first, second, alone, back } = threeGenerations();
    const { species, couples } = pedigree.removeBranch(alone);
    assert.deepEqual(couples.sort(), [alone.key, back.key].sort());
    assert.deepEqual(species, [second]);
    assert.deepEqual(names(pedigree), ["Cep × Fly agaric", "F1·3 × Fly agaric"]);
    assert.equal(pedigree.get(second).birth, undefined);
    // A child of the branch is a mate elsewhere: its parents stay, with all that they come from.
    const crossed = threeGenerations();
    const other = crossed.pedigree.addChild({ a: "amanita_muscaria", b: "amanita_muscaria", genes: page.firstGenes }).key;
    const third = crossed.pedigree.addChild({ a: other, b: other, genes: page.firstGenes }).key;
    const deep = crossed.pedigree.addCouple(third, crossed.first, page.firstGenes);
    const gone = crossed.pedigree.removeBranch(crossed.pedigree.couple(page.keyOfCouple("boletus_edulis", "amanita_muscaria")));
    assert.ok(!gone.species.includes(first));
    assert.deepEqual(names(crossed.pedigree).sort(), ["Cep × Fly agaric", "F1·1 alone", "F2·1 × F1·3", "Fly agaric alone"].sort());
    assert.ok(crossed.pedigree.line([deep.a, deep.b]).every(({ birth }) => crossed.pedigree.couple(page.keyOfCouple(birth.a, birth.b))));
});

test("children of species of the service have an address, others are posted whole", () => {
    const { pedigree, first, back } = threeGenerations();
    const { birth } = pedigree.get(first);
    const { address, body } = page.requestFor(pedigree, birth, "glb", page.draftOptions);
    assert.equal(
        address,
        "v1/offspring/boletus_edulis/amanita_muscaria.glb?seed=3&share=0.25&mutation=0.4&lock=surface.cap,ring&lod=2&textures=none&variation=0",
    );
    assert.equal(body, undefined);
    assert.throws(() => page.requestFor(pedigree, back, "json"), /F2·12 is not in this browser/);
    pedigree.add({ key: back.a, text: '{"id":"bred"}' });
    const posted = page.requestFor(pedigree, back, "json");
    assert.equal(posted.address, "v1/offspring.json");
    const order = JSON.parse(posted.body);
    assert.deepEqual([order.a, order.b, order.seed], [{ id: "bred" }, "amanita_muscaria", 4294967290]);
    assert.equal(page.workOf("queue;dur=0.5, build;dur=2"), 2.5);
});

test("parts that can be locked come from the schema, those of the surface one by one", () => {
    const part = (title) => ({ title, properties: { x: { type: "number" } } });
    const model = {
        oneOf: [
            { properties: { form: { const: "swept" }, silhouette: part("silhouette") } },
            { properties: { form: { const: "branched" }, limbs: part("limbs") } },
        ],
        properties: { ring: part("ring"), surface: { title: "surface", properties: { cap: part("cap"), stem: part("stem") } } },
    };
    const schema = { properties: { spread: part("spread"), ecology: part("ecology"), stages: { items: { properties: { model } } } } };
    const names = (family) => page.locksOf(schema, family).map(({ label, locks }) => [label, locks.map(({ name }) => name)]);
    assert.deepEqual(names("swept"), [
        ["Shape", ["silhouette", "ring"]],
        ["Surface", ["surface.cap", "surface.stem"]],
        ["Whole", ["size", "stages", "spread", "ecology"]],
    ]);
    assert.deepEqual(names("branched")[0], ["Shape", ["limbs", "ring"]]);
});

test("species of the library are members of mixes like those that are built in", () => {
    const mix = "~me.cep@12:0.25,russula_vinosa:0.75";
    assert.ok(page.mixPattern.test(mix));
    assert.deepEqual(page.readShares(mix), [
        { id: "~me.cep@12", weight: 0.25 },
        { id: "russula_vinosa", weight: 0.75 },
    ]);
    assert.equal(page.canonicalMix(page.readShares(mix)), "russula_vinosa:0.75,~me.cep@12:0.25");
    assert.deepEqual(page.libraryIdsOf(mix), ["~me.cep@12"]);
    for (const wrong of ["~me.cep@", "~~me.cep", "me@cep"]) assert.equal(page.readShares(wrong), undefined);
    const listed = page.listedOf([
        { id: "~me.a_b", name: "a_b", title: "", form: "bolete", newest: 2 },
        { id: "~me.draft", name: "draft", title: "", form: "", newest: 0 },
    ]);
    assert.deepEqual(listed.map(({ id, common_name: name }) => [id, name]), [["~me.a_b@2", "a b"]]);
    assert.equal(page.pageQuery({ q: "é b", limit: 1 }), "q=%C3%A9+b&limit=1");
});

test("an axis on which the stem would fold is straighter where a model is grown alone", () => {
    const read = (id) => JSON.parse(readFileSync(path.join(root, `core/atlas/species/${id}.json`), "utf8"));
    for (const id of ["lactarius_deliciosus", "russula_vinosa"]) {
        const [{ model: button }, { model: young }] = read(id).stages;
        assert.ok(page.isFolded(button), id);
        assert.ok(!page.isFolded(young), id);
        assert.equal(page.asGrown(young), young);
        const { axis } = page.asGrown(button);
        const fold = page.foldOf(axis, button.silhouette);
        assert.ok(fold > 0.5 && fold <= 0.54, `${id}: ${fold}`);
        assert.deepEqual(axis.map(({ y }) => y), button.axis.map(({ y }) => y));
    }
    assert.equal(page.isFolded({}), false);
});

const worldSchema = {
    type: "object",
    properties: {
        seed: { type: "integer", minimum: 0, maximum: 4294967295, default: 1 },
        extent: { type: "integer", enum: [256, 1024, 4096], default: 1024 },
        climate: {
            type: "object",
            properties: { rain: { type: "number", minimum: 0, maximum: 3000, "x-default-from": "preset" } },
        },
        fungi: { type: "object", properties: { species: { type: "string", "x-default-from": "preset" } } },
    },
};
const worldFields = page.groupsOf(worldSchema, "world").flatMap((group) => group.fields);

test("the text of a world has its preset and what differs from it, in the order of the schema", () => {
    const settings = new page.world_settings.WorldSettings(worldFields, "beech");
    settings.set("fungi.species", "boletus_edulis+russula_emetica");
    settings.set("seed", 7);
    settings.set("climate.rain", 600);
    assert.equal(settings.text, "beech,seed=7,climate.rain=600,fungi.species=boletus_edulis+russula_emetica");
    const other = new page.world_settings.WorldSettings(worldFields, "spruce");
    assert.deepEqual(other.read(settings.text, ["spruce", "beech"]), []);
    assert.equal(other.text, settings.text);
    other.set("extent", 1024);
    other.choose("spruce");
    assert.equal(other.text, "spruce,seed=7", "what replaced values of the preset is dropped");
    assert.equal(other.extent, 1024);
});

test("what the text of a world gets wrong is named, and all else of it is used", () => {
    const settings = new page.world_settings.WorldSettings(worldFields, "beech");
    const rejected = settings.read("desert,seed=7,climate.rain=9000,moons=2,v=35-1a2b", ["beech"]);
    assert.deepEqual(rejected.map(({ parameter }) => parameter), ["world", "climate.rain", "moons"]);
    assert.equal(settings.text, "beech,seed=7");
});

test("the address of the page of worlds has all that is shown, and is read again", () => {
    const { worldQuery, readWorldQuery, firstState } = page.view_address;
    const state = {
        ...firstState,
        view: "fly",
        x: -20.5,
        y: 300,
        year: 12,
        day: 100,
        size: 16,
        hidden: new Set(["trees", "floor"]),
        map: "spores",
        species: "boletus_edulis",
        look: [90, -12.5, 4],
        why: [20.25, -5],
    };
    const query = worldQuery("beech,fungi.species=a+b", state);
    const read = readWorldQuery(query);
    assert.equal(read.world, "beech,fungi.species=a+b");
    assert.deepEqual(read.state, state);
    assert.deepEqual(read.rejected, []);
    assert.deepEqual(readWorldQuery("").state, firstState);
    const wrong = readWorldQuery("?day=366&year=1.5&x=far&view=swim&hide=sky&look=a&why=1");
    assert.deepEqual(
        wrong.rejected.map(({ parameter }) => parameter),
        ["x", "year", "day", "view", "hide", "look", "why"],
    );
    assert.deepEqual(wrong.state, firstState);
});

test("a plot stays inside its world with all its sides, and its season is that of one square of 64 m", () => {
    const { placeInside, seasonBox } = page.view_address;
    assert.deepEqual(placeInside(600, -700, 1024, 10), { x: 507, y: -507 });
    assert.deepEqual(placeInside(12.345, 0, 1024, 10), { x: 12.35, y: 0 });
    assert.deepEqual(seasonBox(20, -5, 1024), [0, -64, 64, 0]);
    assert.deepEqual(seasonBox(512, -512, 1024), [448, -512, 512, -448]);
});

test("days are dates, months and places of a graph", () => {
    const { dateOf, monthOf, dayAtX, xOfDay } = page.season_curves;
    assert.deepEqual([1, 31, 32, 270, 365].map(dateOf), ["1 Jan", "31 Jan", "1 Feb", "27 Sep", "31 Dec"]);
    assert.deepEqual([1, 59, 60, 365].map(monthOf), [1, 2, 3, 12]);
    const strip = { left: 30, right: 760, top: 0, bottom: 80 };
    for (let day = 1; day <= 365; ++day) assert.equal(dayAtX(xOfDay(day, strip), strip), day);
    assert.equal(dayAtX(-100, strip), 1);
    assert.equal(dayAtX(9999, strip), 365);
});

test("lines of a season grow with the square root, up to the greatest number of all", () => {
    const { rootLines, greatest, roundAbove, bars } = page.season_curves;
    const series = [1, 4, 0].map((count) => Array.from({ length: 365 }, (_, index) => (index === 99 ? count : 0)));
    assert.equal(greatest(series), 4);
    assert.deepEqual([0, 3, 5, 11, 40, 620].map(roundAbove), [1, 3, 6, 12, 40, 800]);
    const strip = { left: 0, right: 365, top: 0, bottom: 100 };
    const [first, second, none] = rootLines(series, 4, strip);
    assert.ok(first.includes("L99.5,50.0L"), "a quarter is half as high");
    assert.ok(second.includes("L99.5,0.0L"));
    assert.equal(none, "");
    assert.equal(bars([0, 5], 10, strip), "M1.0,100.0v-50.0h0.80v50.0z");
});

test("the richest place has most species, not most fruit bodies", () => {
    const { richestPlace } = page.richest_place;
    const at = (x, y, species) => ({ species, translation: [x, 3, -y] });
    const many = Array.from({ length: 40 }, (_, index) => at(-20 + (index % 7) / 10, 20, "a"));
    const box = [-32, -32, 32, 32];
    const place = richestPlace([...many, at(15, -12, "a"), at(16, -12, "b"), at(15, -13, "c"), at(15, -13, "d"), at(14, -12, "e"), at(15, -12, "f")], box, 10);
    assert.ok(Math.abs(place.x - 15) <= 4.5 && Math.abs(place.y + 12) <= 4.5, JSON.stringify(place));
    assert.equal(richestPlace([], box, 10), undefined);
});

test("heights between the points of a map are linear, and a ray comes down on them", () => {
    const { HeightField, numbersOfBytes } = page.height_field;
    assert.deepEqual([...numbersOfBytes(new Uint8Array([1, 2, 255, 0]).buffer)], [513, 255]);
    // A plane that rises by ten metres from west to east, on three columns.
    const field = new HeightField(Uint16Array.from([0, 32767.5, 65535, 0, 32767.5, 65535, 0, 32767.5, 65535]), 3, 0, 10, 100);
    for (const [east, height] of [[-50, 0], [-25, 2.5], [0, 5], [50, 10], [90, 10]])
        assert.ok(Math.abs(field.at(east, 7) - height) < 1e-3, `${east}`);
    const hit = field.hit({ origin: { x: 0, y: 15, z: 10 }, direction: { x: 0, y: -Math.SQRT1_2, z: -Math.SQRT1_2 } });
    assert.ok(Math.abs(hit.east) < 1e-6 && Math.abs(hit.north - 0) < 1e-2, JSON.stringify(hit));
    assert.equal(field.hit({ origin: { x: 0, y: 15, z: 0 }, direction: { x: 0, y: 1, z: 0 } }), undefined);
});

test("one who walks stays at the height of eyes, one who flies above the ground and inside the world", () => {
    const { moved, pushed, pushOf, turned, directionOf, eyeHeight, isMoving, speedAt } = page.fly_motion;
    const terrain = { extent: 100, at: (x) => 0.5 * x };
    const pose = { x: 0, y: 0, height: 3, heading: 90, pitch: -30 };
    const walked = moved(pose, 4, 0, 0, true, terrain);
    assert.ok(Math.abs(walked.x - 4) < 1e-9 && Math.abs(walked.y) < 1e-9);
    assert.equal(walked.height, eyeHeight);
    const flown = moved(pose, 2, 0, 0, false, terrain);
    assert.ok(Math.abs(flown.x - 2 * Math.cos(Math.PI / 6)) < 1e-9, "along the view");
    assert.equal(moved(pose, 100, 0, 0, false, terrain).height, 0.4, "not into the hill");
    assert.equal(moved(pose, 1000, 0, 0, true, terrain).x, 49.5, "not out of the world");
    assert.deepEqual(turned(pose, 300, -100).heading, 30);
    assert.equal(turned(pose, 0, -100).pitch, -89);
    const [east, up, south] = directionOf({ ...pose, pitch: 0 });
    assert.ok(Math.abs(east - 1) < 1e-9 && Math.abs(up) < 1e-9 && Math.abs(south) < 1e-9);
    assert.ok(isMoving("w") && isMoving("arrowleft") && !isMoving("x"));
    const { push, turn } = pushOf(["w", "d", "arrowright"], true);
    assert.deepEqual([push, turn], [{ ahead: 1, right: 1, up: 0, fast: true }, 70]);
    const aslant = pushed({ ...pose, pitch: 0 }, push, 1, true, terrain);
    assert.ok(Math.abs(Math.hypot(aslant.x, aslant.y) - speedAt(3, true, true)) < 1e-6, "aslant is not faster");
});

test("a map is coloured between its own least and greatest numbers, and pixels are places", () => {
    const { rangeOf, paint, colourAt, rampOf, placeOnMap, shareOfMap } = page.map_colours;
    const numbers = Uint16Array.from({ length: 1000 }, (_, index) => 1000 + index);
    numbers[3] = 65535;
    const [low, high] = rangeOf(numbers);
    assert.ok(low <= 1005 && high >= 1990 && high < 2100, `${low}..${high}`);
    assert.deepEqual(rangeOf(new Uint16Array(10).fill(7)), [7, 71]);
    const out = new Uint8ClampedArray(8);
    paint(Uint16Array.from([low, high]), [low, high], "height", out);
    const ramp = rampOf("height");
    assert.deepEqual([...out], [...colourAt(ramp, 0), 255, ...colourAt(ramp, 1), 255]);
    assert.deepEqual(placeOnMap(0, 0, 1024), { x: -512, y: 512 });
    assert.deepEqual(shareOfMap(-512, 512, 1024), { right: 0, down: 0 });
});

test("a clicked mushroom is the nearest one, and its address opens in the viewer", () => {
    const { nearestBody, viewerAddress, plotAddress } = page.plot_view;
    const body = (x, y) => ({ species: `at ${x}`, place_m: [x, y, 0] });
    const bodies = [body(0, 0), body(1, 0), body(3, 0)];
    assert.equal(nearestBody(bodies, 0.8, 0.1, 0.5), bodies[1]);
    assert.equal(nearestBody(bodies, 2, 0, 0.5), undefined);
    assert.equal(
        viewerAddress("/base/v1/mushrooms/boletus_edulis.glb?seed=5&age=0.6"),
        "./?species=boletus_edulis&seed=5&age=0.6",
    );
    assert.equal(viewerAddress("/v1/trees/birch.glb"), undefined);
    const state = { ...page.view_address.firstState, x: 1, y: 2, year: 80, day: 270 };
    assert.equal(
        plotAddress("beech", state, ".glb", ["fungi"]),
        "v1/worlds/beech/y80d270/plot.glb?x=1&y=2&size=10&layers=fungi&instancing=gpu",
    );
    const saved = plotAddress("beech", state, ".glb", page.view_address.layers, "none");
    assert.equal(saved, "v1/worlds/beech/y80d270/plot.glb?x=1&y=2&size=10");
    assert.equal(plotAddress("beech", state, ".json"), "v1/worlds/beech/y80d270/plot.json?x=1&y=2&size=10");
});

test("reasons begin with the species that fruit best", () => {
    const { byShare, verdict } = page.why_panel;
    const species = [
        { id: "c", share: 0, possible: false },
        { id: "a", share: 0, possible: false },
        { id: "b", share: 1, possible: true },
        { id: "d", share: 0.2, possible: true },
    ];
    assert.deepEqual(byShare(species, (id) => id).map(({ id }) => id), ["b", "d", "a", "c"]);
    assert.deepEqual(species.map(verdict), ["no", "no", "yes", "hardly"]);
});

test("a tile takes memory for what it alone has: each mesh and image once, and what it shares with other tiles not", async () => {
    const { BoxGeometry, DataTexture, InstancedMesh, Mesh, MeshStandardMaterial, Group } = page;
    const shared = new page.shared_meshes.SharedMeshes();
    const [own, tree] = [new BoxGeometry(), new BoxGeometry()];
    const material = new MeshStandardMaterial({ map: new DataTexture(new Uint8Array(64), 4, 4) });
    const bytes = [...Object.values(own.attributes), own.index].reduce((sum, { array }) => sum + array.byteLength, 0);
    const tile = new Group();
    tile.add(new Mesh(own, material), new Mesh(own, material));
    assert.equal(shared.ownBytes(tile), bytes + (64 * 4) / 3);
    // The loader asks the plugin for a mesh whose data are at an address of their own.
    const json = { accessors: [{ bufferView: 0 }], bufferViews: [{ buffer: 0 }], buffers: [{ uri: "tree.bin" }], meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }] };
    globalThis.location = { href: "http://127.0.0.1/" };
    const parser = { json, options: { path: "" }, loadMesh: async () => new Mesh(tree, new MeshStandardMaterial()) };
    const { geometry } = await shared.plugin(parser).loadMesh(0);
    delete globalThis.location;
    tile.add(new InstancedMesh(geometry, material, 5));
    assert.equal(shared.ownBytes(tile), bytes + (64 * 4) / 3 + 5 * 64);
});
