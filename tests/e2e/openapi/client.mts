// One call of every operation of the document, by the types that openapi-typescript makes of it with its default flags. That it
// compiles under `strict` is half of the test.
import createClient from "openapi-fetch";
import type { components, paths } from "./api.js";

/** A body with what is required and nothing else. */
type Body<Name extends keyof components["requestBodies"]> = components["requestBodies"][Name]["content"]["application/json"];
const mushroom: Body<"mushroom_order"> = { mix: { amanita_muscaria: 1 } };
const model: Body<"mushroom_order"> = { model: { form: "branched" } };
const colony: Body<"colony_order"> = { mix: { hypholoma_fasciculare: 1 } };
const leaf: Body<"leaf_order"> = { preset: "maple" };
const tree: Body<"tree_order"> = { preset: "herb" };
const morph: Body<"morph_order"> = {};

/** An exported version under another name, which is part of its text. */
async function renamed<Version extends { text: string; sha256: string }>(version: Version, from: string, to: string): Promise<Version> {
    const text = version.text.replace(`"id":"${from}"`, `"id":"${to}"`);
    const digest = new Uint8Array(await crypto.subtle.digest("SHA-256", new TextEncoder().encode(text)));
    return { ...version, text, sha256: [...digest].map((byte) => byte.toString(16).padStart(2, "0")).join("") };
}

type Client = ReturnType<typeof createClient<paths>>;

/** Calls every operation of the library. */
async function callLibrary(client: Client, token: string, both: (head: Promise<Result>, get: Promise<Result>) => Promise<void>): Promise<void> {
    const headers = { Authorization: `Bearer ${token}` };
    const { data: template } = await client.GET("/v1/species/{id}", { params: { path: { id: "boletus_edulis" } } });
    if (!template) throw new Error("there is no species to begin with");
    const own = { ...template, id: "typed_bolete" };
    const { data: created } = await client.POST("/v1/library", { headers, body: own });
    const draft: string = created?.draft ?? "";
    const path = { species: created?.id ?? "" };
    const condition = { path, header: { "If-Match": draft } };
    await client.PUT("/v1/library/{species}", { headers, params: condition, body: own });
    const { data: published } = await client.POST("/v1/library/{species}/publish", { headers, params: condition, body: { note: "first", bake: [3] } });
    if (published?.newest !== 1) throw new Error("the species is not published");
    const version = { params: { path: { species: `${path.species}@${published.newest}` } } };
    await both(client.HEAD("/v1/library/{species}", version), client.GET("/v1/library/{species}", version));
    await both(client.HEAD("/v1/library/{species}/baked.json", version), client.GET("/v1/library/{species}/baked.json", version));
    const baked = { params: { path: { ...version.params.path, lod: "3" } } };
    await client.HEAD("/v1/library/{species}/baked/{lod}.glb", baked);
    await client.GET("/v1/library/{species}/baked/{lod}.glb", { ...baked, parseAs: "arrayBuffer" });
    await client.HEAD("/v1/library", {});
    const { data: listed } = await client.GET("/v1/library", { params: { query: { q: "typed" } } });
    if (listed?.species[0]?.id !== path.species) throw new Error("the species is not listed");
    await client.POST("/v1/library/{species}/fork", { headers, params: { path }, body: { name: "typed_fork" } });
    await both(client.HEAD("/v1/library/quota", { headers }), client.GET("/v1/library/quota", { headers }));

    const { data: key } = await client.POST("/v1/library/{species}/shares", { headers, params: { path }, body: { expires_s: 3600 } });
    await both(client.HEAD("/v1/library/{species}/shares", { headers, params: { path } }), client.GET("/v1/library/{species}/shares", { headers, params: { path } }));
    await client.DELETE("/v1/library/{species}/shares/{share}", { headers, params: { path: { ...path, share: key?.id ?? "" } } });

    await client.HEAD("/v1/library/{species}/export.json", { headers, params: { path } });
    const { data: exported } = await client.GET("/v1/library/{species}/export.json", { headers, params: { path } });
    if (!exported) throw new Error("the species is not exported");
    await client.DELETE("/v1/library/{species}", { headers, params: { ...condition, query: { purge: true } } });
    const versions = await Promise.all(exported.versions.map(async (one) => renamed(one, "typed_bolete", "typed_import")));
    await client.POST("/v1/library/import", { headers, body: { ...exported, name: "typed_import", versions } });

    await both(client.HEAD("/v1/tokens", { headers }), client.GET("/v1/tokens", { headers }));
    const { data: made } = await client.POST("/v1/tokens", { headers, body: { label: "for a test", scope: "read" } });
    await client.DELETE("/v1/tokens/{token}", { headers, params: { path: { token: made?.id ?? "" } } });
}

interface Result {
    response: Response;
    data?: unknown;
}

/**
 * Calls every operation; tells which, as "GET /v1", and with what status each was answered.
 *
 * token  of an owner of species, with the scope admin
 */
export async function callAll(baseUrl: string, token: string): Promise<Map<string, number>> {
    const client = createClient<paths>({ baseUrl });
    const statuses = new Map<string, number>();
    client.use({
        onResponse({ request, response, schemaPath }) {
            statuses.set(`${request.method} ${schemaPath}`, response.status);
        },
    });
    const both = async (head: Promise<Result>, get: Promise<Result>): Promise<void> => {
        await head;
        await get;
    };
    const small = { lod: 3, texture_size: 128 } as const;
    const binary = { parseAs: "arrayBuffer" } as const;
    const text = { parseAs: "text" } as const;

    await both(client.HEAD("/", {}), client.GET("/", text));
    await both(client.HEAD("/docs", {}), client.GET("/docs", text));
    await both(client.HEAD("/editor", {}), client.GET("/editor", text));
    await both(client.HEAD("/breed", {}), client.GET("/breed", text));
    await both(client.HEAD("/world", {}), client.GET("/world", text));
    const asset = { params: { path: { name: "favicon.svg" } } };
    await both(client.HEAD("/assets/{name}", asset), client.GET("/assets/{name}", { ...asset, ...text }));
    await both(client.HEAD("/livez", {}), client.GET("/livez", text));
    await both(client.HEAD("/readyz", {}), client.GET("/readyz", text));
    await both(client.HEAD("/metrics", {}), client.GET("/metrics", text));
    await both(client.HEAD("/openapi.json", {}), client.GET("/openapi.json", {}));
    await both(client.HEAD("/v1", {}), client.GET("/v1", {}));

    const filter = { params: { query: { family: "swept", month: 9 } } } as const;
    await client.HEAD("/v1/species", filter);
    const { data: species } = await client.GET("/v1/species", filter);
    const id: string = species?.species[0]?.id ?? "";
    const other: string = species?.species[1]?.id ?? "";
    await both(client.HEAD("/v1/species/{id}", { params: { path: { id } } }), client.GET("/v1/species/{id}", { params: { path: { id } } }));

    await client.HEAD("/v1/mushrooms", {});
    const { data: mushrooms } = await client.GET("/v1/mushrooms", {});
    const name: string = mushrooms?.mushrooms[0]?.name ?? "";
    if (!name) throw new Error("the list of mushrooms is empty");
    await both(client.HEAD("/v1/mushrooms/schema", {}), client.GET("/v1/mushrooms/schema", {}));
    const mix = { params: { path: { mix: `${id}:0.7,${other}:0.3` }, query: { ...small, age: 0.5 } } };
    await both(client.HEAD("/v1/mushrooms/{mix}.glb", mix), client.GET("/v1/mushrooms/{mix}.glb", { ...mix, ...binary }));
    await both(client.HEAD("/v1/mushrooms/{mix}.bin", mix), client.GET("/v1/mushrooms/{mix}.bin", { ...mix, ...binary }));
    await client.HEAD("/v1/mushrooms/{mix}.json", mix);
    const { data: described } = await client.GET("/v1/mushrooms/{mix}.json", mix);
    const age: number = described?.effective.age ?? Number.NaN;
    const bend: number | undefined = described?.effective.deformation.bend_deg;
    if (age !== 0.5 || bend === undefined) throw new Error("the effective parameters are not told");
    const drawn = { width: 32, height: 32 };
    const portrait = { params: { path: { mix: id }, query: { ...small, ...drawn, view: "below" } } } as const;
    await both(client.HEAD("/v1/mushrooms/{mix}.png", portrait), client.GET("/v1/mushrooms/{mix}.png", { ...portrait, ...binary }));
    const { data: made } = await client.POST("/v1/mushrooms.glb", { body: { ...mushroom, ...small }, ...binary });
    if (!(made instanceof ArrayBuffer)) throw new Error("no file");
    void model;

    await client.HEAD("/v1/mushrooms/{mix}/{image}.jpg", { params: { path: { mix: id, image: "normal" }, query: { side: 128 } } });
    await client.GET("/v1/mushrooms/{mix}/{image}.jpg", { params: { path: { mix: id, image: "normal" }, query: { side: 128 } }, ...binary });

    const scales = { params: { path: { mix: id, image: "orm" }, query: { side: 128 } } } as const;
    await both(client.HEAD("/v1/mushrooms/{mix}/{image}.webp", scales), client.GET("/v1/mushrooms/{mix}/{image}.webp", { ...scales, ...binary }));

    const set = { species: [id, other], levels: [3], texture_size: 128 as const };
    const { data: manifest } = await client.POST("/v1/sets.json", { body: set });
    const url: string | undefined = manifest?.files[0]?.url;
    if (!url) throw new Error("the manifest names no file");
    await client.POST("/v1/sets.zip", { body: set, ...binary });
    await client.POST("/v1/sets.glb", { body: { ...set, lods: "msft", share: "species", atlas: "set" }, ...binary });

    const pair = { params: { path: { a: id, b: other } } };
    await client.HEAD("/v1/morphs/{a}/{b}", pair);
    const { data: correspondence } = await client.GET("/v1/morphs/{a}/{b}", pair);
    if (correspondence?.family === "swept") void correspondence.outlines.a.cap;
    await client.POST("/v1/morphs/{a}/{b}.glb", { ...pair, body: { ...morph, ...small }, ...binary });

    const parents = { path: { a: id, b: other } }, genes = { seed: 7, share: 0.5, mutation: 0.2, lock: "surface.cap,size" };
    await client.HEAD("/v1/offspring/{a}/{b}.json", { params: { ...parents, query: genes } });
    const { data: child } = await client.GET("/v1/offspring/{a}/{b}.json", { params: { ...parents, query: genes } });
    if (!child?.stages?.length) throw new Error("the offspring is no whole species");
    const offspring = { params: { ...parents, query: { ...genes, ...small, individual: 3 } } };
    await both(client.HEAD("/v1/offspring/{a}/{b}.glb", offspring), client.GET("/v1/offspring/{a}/{b}.glb", { ...offspring, ...binary }));
    const grandchild = { a: id, b: other, ...genes, lock: ["surface.cap"] };
    await client.POST("/v1/offspring.json", { body: grandchild });
    await client.POST("/v1/offspring.glb", { body: { ...grandchild, ...small }, ...binary });
    const looks = { params: { ...parents, query: { ...genes, ...small, ...drawn } } };
    await both(client.HEAD("/v1/offspring/{a}/{b}.png", looks), client.GET("/v1/offspring/{a}/{b}.png", { ...looks, ...binary }));

    await both(client.HEAD("/v1/colonies", {}), client.GET("/v1/colonies", {}));
    await both(client.HEAD("/v1/colonies/schema", {}), client.GET("/v1/colonies/schema", {}));
    const some = { params: { path: { mix: id }, query: { ...small, count: 3 } } };
    await both(client.HEAD("/v1/colonies/{mix}.glb", some), client.GET("/v1/colonies/{mix}.glb", { ...some, ...binary }));
    await client.HEAD("/v1/colonies/{mix}.json", some);
    const { data: stand } = await client.GET("/v1/colonies/{mix}.json", some);
    const count: number = stand?.effective.count ?? Number.NaN;
    if (count !== 3) throw new Error("the effective count is not told");
    const group = { params: { path: { mix: id }, query: { ...small, ...drawn, count: 3 } } };
    await both(client.HEAD("/v1/colonies/{mix}.png", group), client.GET("/v1/colonies/{mix}.png", { ...group, ...binary }));
    const cap = { params: { path: { mix: id, image: "normal" }, query: { side: 128 } } } as const;
    await both(client.HEAD("/v1/colonies/{mix}/{image}.jpg", cap), client.GET("/v1/colonies/{mix}/{image}.jpg", { ...cap, ...binary }));
    await both(client.HEAD("/v1/colonies/{mix}/{image}.webp", cap), client.GET("/v1/colonies/{mix}/{image}.webp", { ...cap, ...binary }));
    const wood = { params: { path: { wood: "birch", image: "normal" }, query: { side: 128 } } } as const;
    await both(client.HEAD("/v1/colonies/wood/{wood}/{image}.jpg", wood), client.GET("/v1/colonies/wood/{wood}/{image}.jpg", { ...wood, ...binary }));
    await both(client.HEAD("/v1/colonies/wood/{wood}/{image}.webp", wood), client.GET("/v1/colonies/wood/{wood}/{image}.webp", { ...wood, ...binary }));
    await both(client.HEAD("/v1/mushrooms/wood/{wood}/{image}.jpg", wood), client.GET("/v1/mushrooms/wood/{wood}/{image}.jpg", { ...wood, ...binary }));
    await both(client.HEAD("/v1/mushrooms/wood/{wood}/{image}.webp", wood), client.GET("/v1/mushrooms/wood/{wood}/{image}.webp", { ...wood, ...binary }));
    await client.POST("/v1/colonies.glb", { body: { ...colony, ...small, count: 3 }, ...binary });

    await both(client.HEAD("/v1/leaves", {}), client.GET("/v1/leaves", {}));
    await both(client.HEAD("/v1/leaves/schema", {}), client.GET("/v1/leaves/schema", {}));
    const maple = { params: { path: { preset: "maple" }, query: small } };
    await both(client.HEAD("/v1/leaves/{preset}.glb", maple), client.GET("/v1/leaves/{preset}.glb", { ...maple, ...binary }));
    await both(client.HEAD("/v1/leaves/{preset}.json", maple), client.GET("/v1/leaves/{preset}.json", maple));
    const plate = { params: { path: { preset: "maple" }, query: { ...small, ...drawn } } };
    await both(client.HEAD("/v1/leaves/{preset}.png", plate), client.GET("/v1/leaves/{preset}.png", { ...plate, ...binary }));
    await client.POST("/v1/leaves.glb", { body: { ...leaf, ...small }, ...binary });
    const vein = { params: { path: { preset: "maple", image: "orm" }, query: { side: 128 } } } as const;
    await both(client.HEAD("/v1/leaves/{preset}/{image}.jpg", vein), client.GET("/v1/leaves/{preset}/{image}.jpg", { ...vein, ...binary }));
    await both(client.HEAD("/v1/leaves/{preset}/{image}.webp", vein), client.GET("/v1/leaves/{preset}/{image}.webp", { ...vein, ...binary }));
    const shoot = { params: { path: { preset: "shoot", image: "base_color" }, query: { side: 128 } } } as const;
    await both(client.HEAD("/v1/leaves/{preset}/{image}.png", shoot), client.GET("/v1/leaves/{preset}/{image}.png", { ...shoot, ...binary }));

    await both(client.HEAD("/v1/trees", {}), client.GET("/v1/trees", {}));
    await both(client.HEAD("/v1/trees/schema", {}), client.GET("/v1/trees/schema", {}));
    const herb = { params: { path: { preset: "herb" }, query: small } };
    await both(client.HEAD("/v1/trees/{preset}.glb", herb), client.GET("/v1/trees/{preset}.glb", { ...herb, ...binary }));
    await both(client.HEAD("/v1/trees/{preset}.bin", herb), client.GET("/v1/trees/{preset}.bin", { ...herb, ...binary }));
    await client.HEAD("/v1/trees/{preset}.json", herb);
    const { data: plant } = await client.GET("/v1/trees/{preset}.json", herb);
    const rows: number[][] | undefined = plant?.matrix;
    if (!rows?.length) throw new Error("the matrix is not told");
    const habit = { params: { path: { preset: "herb" }, query: { ...small, ...drawn } } };
    await both(client.HEAD("/v1/trees/{preset}.png", habit), client.GET("/v1/trees/{preset}.png", { ...habit, ...binary }));
    await client.POST("/v1/trees.glb", { body: { ...tree, ...small }, ...binary });
    await both(client.HEAD("/v1/trees/leaves/{preset}/{image}.jpg", vein), client.GET("/v1/trees/leaves/{preset}/{image}.jpg", { ...vein, ...binary }));
    await both(client.HEAD("/v1/trees/leaves/{preset}/{image}.webp", vein), client.GET("/v1/trees/leaves/{preset}/{image}.webp", { ...vein, ...binary }));
    await both(client.HEAD("/v1/trees/leaves/{preset}/{image}.png", shoot), client.GET("/v1/trees/leaves/{preset}/{image}.png", { ...shoot, ...binary }));
    const bark = { params: { path: { preset: "herb", image: "base_color" }, query: { side: 128 } } } as const;
    await both(client.HEAD("/v1/trees/{preset}/{image}.jpg", bark), client.GET("/v1/trees/{preset}/{image}.jpg", { ...bark, ...binary }));
    await both(client.HEAD("/v1/trees/{preset}/{image}.webp", bark), client.GET("/v1/trees/{preset}/{image}.webp", { ...bark, ...binary }));

    await both(client.HEAD("/v1/worlds", {}), client.GET("/v1/worlds", {}));
    await both(client.HEAD("/v1/worlds/schema", {}), client.GET("/v1/worlds/schema", {}));
    const wet = { params: { path: { world: "beech,seed=7,climate.rain=1200" } } };
    await client.HEAD("/v1/worlds/{world}.json", wet);
    const { data: world } = await client.GET("/v1/worlds/{world}.json", wet);
    if (world?.effective.climate.rain !== 1200) throw new Error("the effective rain is not told");
    const eightieth = { params: { ...wet.params, query: { year: 80 } } };
    await client.HEAD("/v1/worlds/{world}/weather.json", eightieth);
    const { data: weather } = await client.GET("/v1/worlds/{world}/weather.json", eightieth);
    if (weather?.days.rain_mm.length !== 365) throw new Error("the year is not whole");

    const here = { path: { world: "meadow,extent=256", time: "y80d270", map: "wetness" } } as const;
    const square = { params: { ...here, query: { size: 65, bbox: "-32,-32,32,32" } } };
    await both(client.HEAD("/v1/worlds/{world}/{time}/maps/{map}.png", square), client.GET("/v1/worlds/{world}/{time}/maps/{map}.png", { ...square, ...binary }));
    await both(client.HEAD("/v1/worlds/{world}/{time}/maps/{map}.r16", square), client.GET("/v1/worlds/{world}/{time}/maps/{map}.r16", { ...square, ...binary }));
    await client.HEAD("/v1/worlds/{world}/{time}/maps/{map}.json", square);
    const { data: map } = await client.GET("/v1/worlds/{world}/{time}/maps/{map}.json", square);
    if (map?.width !== 65 || map.step_m[0] !== 1) throw new Error("the map is not described");
    const year = { params: { path: { world: "meadow,extent=256" }, query: { year: 80, bbox: "-8,-8,8,8" } } };
    await client.HEAD("/v1/worlds/{world}/season.json", year);
    const { data: season } = await client.GET("/v1/worlds/{world}/season.json", year);
    if (season?.species[0]?.standing.length !== 365) throw new Error("the season is not whole");
    const plot = { params: { path: { world: "meadow,extent=256", time: "y80d270" }, query: { size: 4, texture_size: 256 } } } as const;
    await both(client.HEAD("/v1/worlds/{world}/{time}/plot.glb", plot), client.GET("/v1/worlds/{world}/{time}/plot.glb", { ...plot, ...binary }));
    await client.HEAD("/v1/worlds/{world}/{time}/plot.json", plot);
    const { data: onIt } = await client.GET("/v1/worlds/{world}/{time}/plot.json", plot);
    if (onIt?.bbox[2] !== 2) throw new Error("the plot is not described");
    const seen = { params: { path: plot.params.path, query: { size: 4, texture_size: 256, width: 96, height: 64, view: "kneeling" } } } as const;
    await both(client.HEAD("/v1/worlds/{world}/{time}/plot.png", seen), client.GET("/v1/worlds/{world}/{time}/plot.png", { ...seen, ...binary }));
    const placed = { params: { path: { world: "meadow,extent=256", time: "y80d270" }, query: { bbox: "-8,-8,8,8", kinds: "tree+fungus" } } };
    await both(client.HEAD("/v1/worlds/{world}/{time}/placements.csv", placed), client.GET("/v1/worlds/{world}/{time}/placements.csv", { ...placed, ...text }));
    await both(client.HEAD("/v1/worlds/{world}/{time}/placements.bin", placed), client.GET("/v1/worlds/{world}/{time}/placements.bin", { ...placed, ...binary }));
    await client.HEAD("/v1/worlds/{world}/{time}/placements.json", placed);
    const { data: list } = await client.GET("/v1/worlds/{world}/{time}/placements.json", placed);
    if (list?.count !== list?.placements.length) throw new Error("the rows are not counted");
    const tiled = { params: { path: { world: "meadow,extent=256", profile: "web", time: "y80d270" } } } as const;
    await client.HEAD("/v1/worlds/{world}/{profile}/{time}/tileset.json", tiled);
    const { data: tileset } = await client.GET("/v1/worlds/{world}/{profile}/{time}/tileset.json", tiled);
    if (!tileset?.geometricError) throw new Error("the tileset has no error");
    const layer = { params: { path: { world: "meadow,extent=256", profile: "core", layertime: "y80m10", layer: "floor" } } } as const;
    await client.HEAD("/v1/worlds/{world}/{profile}/{layertime}/{layer}/tileset.json", layer);
    await client.GET("/v1/worlds/{world}/{profile}/{layertime}/{layer}/tileset.json", layer);
    const tile = { params: { path: { ...layer.params.path, level: 3, x: 4, y: 4 } } } as const;
    await both(client.HEAD("/v1/worlds/{world}/{profile}/{layertime}/{layer}/{level}/{x}/{y}.subtree", tile), client.GET("/v1/worlds/{world}/{profile}/{layertime}/{layer}/{level}/{x}/{y}.subtree", { ...tile, ...binary }));
    await both(client.HEAD("/v1/worlds/{world}/{profile}/{layertime}/{layer}/{level}/{x}/{y}.glb", tile), client.GET("/v1/worlds/{world}/{profile}/{layertime}/{layer}/{level}/{x}/{y}.glb", { ...tile, ...binary }));
    const spot = { params: { path: { world: "meadow,extent=256", time: "y80d270" }, query: { x: 3, y: -4.5 } } };
    await client.HEAD("/v1/worlds/{world}/{time}/limits.json", spot);
    const { data: limits } = await client.GET("/v1/worlds/{world}/{time}/limits.json", spot);
    if (!limits?.species[0]?.why) throw new Error("it is not said what limits a species");
    const edited = {
        world: "meadow,extent=256", time: "y80d270",
        ecology: { marasmius_oreades: { months: [7, 8, 9, 10] } },
        founders: [{ species: "marasmius_oreades", x: 3, y: -4.5, year: 0 }],
        masks: { fungi: "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAAAAABX3VL4AAAADklEQVR4nGNg+M/wvwEABoACf2fsDmUAAAAASUVORK5CYII=" },
    };
    const smallPlot = { size: 4, texture_size: 256 } as const;
    await client.POST("/v1/worlds/plot.glb", { body: { ...edited, ...smallPlot }, ...binary });
    const { data: onOwn } = await client.POST("/v1/worlds/plot.json", { body: { ...edited, size: 4 } });
    if (onOwn?.bbox[2] !== 2) throw new Error("the plot of an edited world is not described");
    await client.POST("/v1/worlds/plot.png", { body: { ...edited, ...smallPlot, width: 96, height: 64 }, ...binary });
    await client.POST("/v1/worlds/placements.csv", { body: { ...edited, bbox: "-8,-8,8,8" }, ...text });
    const { data: ownRows } = await client.POST("/v1/worlds/placements.json", { body: { ...edited, bbox: "-8,-8,8,8" } });
    if (ownRows?.count !== ownRows?.placements.length) throw new Error("the rows of an edited world are not counted");
    const spores = { params: { path: { map: "spores" } } } as const;
    await client.POST("/v1/worlds/maps/{map}.png", { ...spores, body: { ...edited, size: 65 }, ...binary });
    const { data: spread } = await client.POST("/v1/worlds/maps/{map}.json", { ...spores, body: { ...edited, size: 65 } });
    if (spread?.width !== 65) throw new Error("the map of an edited world is not described");

    const { data: heights } = await client.GET("/v1/worlds/{world}/{time}/maps/{map}.png", { params: { path: { world: "meadow,extent=256", time: "y80d270", map: "height" }, query: { size: 65 } }, ...binary });
    const { data: sent } = await client.POST("/v1/terrains", {
        params: { query: { metres: 320, max: 40 } },
        body: heights as unknown as string,
        bodySerializer: (file: unknown) => file as ArrayBuffer,
        headers: { "Content-Type": "image/png" },
    });
    const terrain: string = sent?.terrain ?? "";
    const ofTerrain = { params: { path: { terrain } } };
    await client.HEAD("/v1/terrains/{terrain}.json", ofTerrain);
    const { data: ground } = await client.GET("/v1/terrains/{terrain}.json", ofTerrain);
    if (ground?.side !== 65 || ground.metres !== 320) throw new Error("a terrain is not described as it was sent");
    await both(client.HEAD("/v1/terrains/{terrain}.png", ofTerrain), client.GET("/v1/terrains/{terrain}.png", { ...ofTerrain, ...binary }));
    await client.GET("/v1/worlds/{world}.json", { params: { path: { world: `meadow,extent=256,terrain.id=${terrain}` } } });

    const { data: surface } = await client.GET("/v1/leaves/{preset}.glb", { params: { path: { preset: "maple" }, query: { lod: 3, texture_size: 128 } }, ...binary });
    const { data: placedOn } = await client.POST("/v1/scenes", {
        body: surface as unknown as string,
        bodySerializer: (file: unknown) => file as ArrayBuffer,
        headers: { "Content-Type": "model/gltf-binary" },
    });
    const scene: string = placedOn?.scene ?? "";
    const ofScene = { params: { path: { scene } } };
    await client.HEAD("/v1/scenes/{scene}.json", ofScene);
    const { data: surfaces } = await client.GET("/v1/scenes/{scene}.json", ofScene);
    if (!surfaces?.triangles || surfaces.materials.length !== 1) throw new Error("a scene is not described as it was sent");
    const onScene = { params: { path: { scene, world: "meadow,seed=7", time: "y80d270" } } };
    await both(client.HEAD("/v1/scenes/{scene}/{world}/{time}/fungi.glb", onScene), client.GET("/v1/scenes/{scene}/{world}/{time}/fungi.glb", { ...onScene, ...binary }));
    await both(client.HEAD("/v1/scenes/{scene}/{world}/{time}/placements.csv", onScene), client.GET("/v1/scenes/{scene}/{world}/{time}/placements.csv", { ...onScene, ...text }));
    await client.HEAD("/v1/scenes/{scene}/{world}/{time}/placements.json", onScene);
    const { data: onSurfaces } = await client.GET("/v1/scenes/{scene}/{world}/{time}/placements.json", onScene);
    if (onSurfaces?.count !== onSurfaces?.placements.length) throw new Error("the rows of a scene are not counted");
    await both(client.HEAD("/v1/scenes/{scene}/{world}/{time}/placements.bin", onScene), client.GET("/v1/scenes/{scene}/{world}/{time}/placements.bin", { ...onScene, ...binary }));
    const lightOf = { params: { path: { ...onScene.params.path, map: "light" } } };
    await both(client.HEAD("/v1/scenes/{scene}/{world}/{time}/maps/{map}.bin", lightOf), client.GET("/v1/scenes/{scene}/{world}/{time}/maps/{map}.bin", { ...lightOf, ...binary }));
    await client.HEAD("/v1/scenes/{scene}/{world}/{time}/maps/{map}.json", lightOf);
    const { data: light } = await client.GET("/v1/scenes/{scene}/{world}/{time}/maps/{map}.json", lightOf);
    if (light?.count !== surfaces.vertices) throw new Error("a map of a scene has not a number for each vertex");

    const { data: picture } = await client.GET("/v1/mushrooms/{mix}.png", { params: { path: { mix: id }, query: { lod: 2, width: 320, height: 320, view: "front", background: "grey" } }, ...binary });
    const { data: uploaded } = await client.POST("/v1/photos", {
        body: picture as unknown as string,
        bodySerializer: (file: unknown) => file as ArrayBuffer,
        headers: { "Content-Type": "image/png" },
    });
    const photo: string = uploaded?.photo ?? "";
    const stored = { params: { path: { photo } } };
    await both(client.HEAD("/v1/photos/{photo}.jpg", stored), client.GET("/v1/photos/{photo}.jpg", { ...stored, ...binary }));
    const axis = [[160, 290], [160, 60]];
    const { data: traced } = await client.POST("/v1/traces", { body: { views: { side: { photo, gesture: { axis } } }, height_m: 0.08 } });
    if (!traced) throw new Error("there is no trace");
    const outline = traced.species.stages?.[traced.stage]?.model;
    if (outline?.form !== "swept" || !outline.silhouette) throw new Error("the traced species has no outline");
    const { form, template, marks, outline: lines } = traced;
    const { data: marked } = await client.POST("/v1/traces", { body: { views: { side: { photo } }, outline: lines, marks, form, template, height_m: 0.08 } });
    const same = marked?.species.stages?.[marked.stage]?.model;
    if (same?.form !== "swept" || JSON.stringify(same.silhouette) !== JSON.stringify(outline.silhouette)) throw new Error("a trace of its own outline and marks has another shape");
    const { data: checked } = await client.POST("/v1/outlines/check", { body: { silhouette: outline.silhouette } });
    if (checked?.simple !== true) throw new Error("the traced outline can not be grown");
    await client.DELETE("/v1/photos/{photo}.jpg", stored);

    await callLibrary(client, token, both);

    const { data: inspected } = await client.POST("/v1/inspect", {
        body: made as unknown as string, // a file: its type is "string" of format "binary"
        bodySerializer: (file: unknown) => file as ArrayBuffer,
        headers: { "Content-Type": "model/gltf-binary" },
    });
    const canonical: string | null | undefined = inspected?.canonical;
    if (!canonical?.startsWith("/v1/mushrooms/")) throw new Error("the file does not tell what made it");

    const { error } = await client.GET("/v1/mushrooms/{mix}.json", { params: { path: { mix: id }, query: { age: 1.7 } } });
    const parameter: string | undefined = error?.errors?.[0]?.parameter;
    if (parameter !== "age") throw new Error("the culprit is not named");
    await client.GET("/v1/mushrooms/{mix}.json", mix);
    const type = { params: { path: { type: error?.type.split("/").pop() ?? "" } } };
    await both(client.HEAD("/problems/{type}", type), client.GET("/problems/{type}", { ...type, ...text }));
    return statuses;
}
