// Random requests that the OpenAPI document describes, most of them valid, some with one error.
import { follow } from "./shared.mjs";

/** mulberry32: the same requests of the same seed. */
export function random(state) {
    const uniform = () => {
        state = (state + 0x6d2b79f5) | 0;
        let t = Math.imul(state ^ (state >>> 15), 1 | state);
        t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
        return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
    };
    const chance = (share) => uniform() < share;
    const below = (n) => Math.floor(uniform() * n);
    const pick = (list) => list[below(list.length)];
    return { uniform, chance, below, pick };
}

/** Expensive parameters get small values. */
const cheap = { texture_size: [128, 128, 256], side: [16, 128], lod: [3, 3, 2], count: [1, 2, 7], distinct: [1, 2], trunks: [1, 2], frames: [2, 3], order: [2, 3, 4], per_tip: [0, 1, 2], seeds: [1, 2], levels: [[3], [2, 3]], width: [16, 32, 48], height: [16, 32, 48] };

/** A mask of 2 x 2 pixels. */
const quarters = "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAAAAABX3VL4AAAADklEQVR4nGNg+M/wvwEABoACf2fsDmUAAAAASUVORK5CYII=";

export class Generator {
    constructor(document, lists, dice) {
        Object.assign(this, { document, lists, dice });
    }

    number(schema) {
        const { dice } = this;
        const low = schema.minimum ?? schema.exclusiveMinimum ?? 0, high = schema.maximum ?? low + 1;
        const value = dice.chance(0.15) ? dice.pick([schema.minimum ?? high, high]) : low + dice.uniform() * (high - low);
        return schema.type === "integer" ? Math.round(value) : Math.max(low, Math.min(high, dice.chance(0.3) ? value : Number(value.toPrecision(3))));
    }

    /** A value that the schema allows. */
    right(given, name = "", depth = 0) {
        const { dice } = this;
        const schema = follow(this.document, given);
        if (cheap[name] && !schema.properties && !dice.chance(0.01)) {
            const fitting = cheap[name].filter((one) => (schema.enum?.includes(one) ?? true) && one >= (schema.minimum ?? one) && one <= (schema.maximum ?? one));
            if (fitting.length) return dice.pick(fitting);
        }
        if ("const" in schema) return schema.const;
        if (schema.enum) return dice.pick(schema.enum);
        // Of a body for a part of a world.
        if (name === "world" && schema.type === "string") return dice.pick(["meadow,extent=256", "meadow,extent=256,fungi.abundance=2"]);
        if (name === "time" && schema.type === "string") return dice.pick(["y80d270", "y200d365"]);
        if (name === "founders") return dice.pick([[], [{ species: "marasmius_oreades", x: 3, y: -4.5, year: 20 }]]);
        if (name === "ecology" && schema.additionalProperties?.properties) return dice.pick([{}, { marasmius_oreades: { months: [7], genet: { speed: 0.3 } } }]);
        if (name === "masks") return dice.pick([{}, { fungi: quarters }, { trees: quarters, marasmius_oreades: quarters }]);
        if ((name === "a" || name === "b") && schema.oneOf) return dice.pick(dice.pick(this.lists.families)); // a parent
        if (schema.oneOf || schema.properties || schema.type === "object") return this.object(schema, name, depth);
        if (name === "lod" && schema.type === "string") return dice.pick(["0", "3"]);
        if (name === "bbox") return dice.pick(["", "-32,-16,32,16", "0,0,1,100.5"]);
        if ((name === "x" || name === "y") && schema.type === "number") {
            const places = [0, -7.5, 20].filter((one) => one >= (schema.minimum ?? one) && one <= (schema.maximum ?? one));
            return places.length ? dice.pick(places) : this.number(schema);
        }
        if (name === "species" && schema.type === "string") return dice.pick(["", "marasmius_oreades"]); // of a meadow
        if (name === "species") return this.someSpecies();
        if (name === "layers") return dice.pick(["", "fungi", "ground+trees"]);
        if (name === "substrates") return dice.pick(["", `${this.lists.material}:grass`, `${this.lists.material}:beech`]);
        if (name === "kinds") return dice.pick(["", "tree", "fungus+log"]);
        if (name === "photo") return dice.pick(this.lists.photos);
        if (name === "lock") return schema.type === "array" ? ["surface.cap", "size"].slice(dice.below(3)) : dice.pick(["surface.cap", "size,surface.stem", "deformation.bend_deg"]);
        if (schema.type === "array") {
            const length = schema.minItems ?? Math.min(schema.maxItems ?? 3, dice.below(4));
            const list = Array.from({ length }, () => this.right(schema.items, "", depth + 1));
            if (schema.uniqueItems) return [...new Set(list)];
            return length === 2 && schema.maxItems === 2 && list.every((one) => typeof one === "number") ? list.sort((a, b) => a - b) : list;
        }
        if (schema.type === "boolean") return dice.chance(0.5);
        if (schema.pattern) return dice.pick(["#D22B1F", "#00ff7A"]);
        if (schema.contentEncoding) return ""; // no image; what is none is for the test of uploads
        if (schema.type === "string") return dice.pick(["", "wood", "soil", "Ünïcode ✓"]).slice(0, schema.maxLength ?? 20);
        return this.number(schema);
    }

    object(schema, name, depth) {
        const { dice } = this;
        if (name === "mix") return Object.fromEntries(this.someSpecies().map((id) => [id, Number((dice.uniform() * 9 + 0.1).toPrecision(3))]));
        const out = {};
        const wanted = depth === 0 ? 0.12 : 0.3;
        const add = (part) => {
            for (const [key, property] of Object.entries(part.properties ?? {}))
                if (!(key in out) && (part.required?.includes(key) || dice.chance(wanted)) && !this.avoided(key, depth)) out[key] = this.right(property, key, depth + 1);
        };
        const choices = [...(schema.oneOf ? [schema.oneOf] : []), ...(schema.allOf ?? []).map((one) => one.oneOf)];
        for (const choice of choices) {
            const one = dice.pick(choice);
            for (const key of one.required ?? []) if (!one.properties?.[key] && schema.properties?.[key]) out[key] = this.right(schema.properties[key], key, depth + 1);
            add(one);
        }
        add({ ...schema, properties: Object.fromEntries(Object.entries(schema.properties ?? {}).filter(([key]) => !choices.flat().some((one) => one.required?.includes(key)))) });
        return out;
    }

    avoided(key, depth) {
        return depth === 0 && (key === "v" || key === "arcs" || key === "rows") && this.dice.chance(0.7) || key === "v";
    }

    /** Returns a value that the schema forbids, if one of the known kinds exists. */
    wrong(given, inQuery) {
        const { dice } = this;
        const schema = follow(this.document, given);
        const isObject = schema.type === "object" || schema.oneOf, isList = schema.type === "array";
        const candidates = inQuery ? ["nothing", ""] : [null, isObject ? 7 : {}, isList ? "x" : [{}]];
        if (schema.maximum !== undefined) candidates.push(schema.maximum + 1, schema.maximum * 1000 + 1);
        if (schema.minimum !== undefined) candidates.push(schema.minimum - 1);
        if (schema.type === "integer") candidates.push((schema.minimum ?? 0) + 0.5);
        if (schema.type === "string" && !schema.enum && !schema.pattern && inQuery) return "x".repeat((schema.maxLength ?? 40) + 1);
        return dice.pick(candidates);
    }

    someSpecies() {
        const { dice } = this;
        const family = dice.pick(this.lists.families);
        return [...new Set(Array.from({ length: dice.pick([1, 1, 2, 2, 3, 5]) }, () => dice.pick(family)))];
    }

    pathValue(name, path) {
        const { dice, lists } = this;
        if (name === "mix") {
            const ids = this.someSpecies();
            return ids.length === 1 ? ids[0] : ids.map((id) => `${id}:${(dice.uniform() + 0.05).toFixed(2)}`).join(",");
        }
        if (name === "id" || name === "a" || name === "b") return dice.pick(dice.pick(lists.families));
        if (name === "preset") return dice.pick(path.startsWith("/v1/trees/{") ? lists.trees : lists.leaves);
        if (name === "world" && /season|plot|placements|limits|maps|profile|scenes/.test(path)) return "meadow,extent=256"; // others take seconds
        if (name === "world") {
            const texts = [",extent=256", ",seed=7,extent=256", ",climate.rain=600,climate.latitude_deg=-40"];
            return dice.pick(lists.worlds) + dice.pick(texts);
        }
        if (name === "time") return dice.pick(["y80d270", "y0d1", "y200d365"]);
        if (name === "layertime") return (this.layer = dice.pick(["ground", "trees", "floor", "fungi"])) === "fungi" ? "y80d270" : "y80m10";
        if (name === "layer") return this.layer;
        if (name === "level") return dice.pick(["0", "3"]); // of which there are subtrees
        if (name === "x" || name === "y") return "0";
        if (name === "type") return dice.pick(lists.types);
        if (name === "photo") return dice.pick(lists.photos);
        if (name === "terrain") return dice.pick(lists.terrains);
        if (name === "scene") return dice.pick(lists.scenes);
        if (name === "map" && path.startsWith("/v1/scenes/")) return dice.pick(["light", "wetness", "rain", "spores:marasmius_oreades", "probability:hygrocybe_conica"]);
        if (name === "lod") return dice.pick(["0", "3"]);
        if (name === "species") return dice.pick(lists.library) + dice.pick(["", "@1", "@2"]);
        if (name === "name") return dice.pick(["favicon.svg", "index.html"]);
        return undefined;
    }

    /** A request: { method, target, headers, body, right: nothing of it is wrong by the document, wrong: something surely is }. */
    request({ method, path, operation }) {
        const { dice } = this;
        const headers = {};
        const query = [];
        // A photograph may have been deleted by then, few lines are those of a mushroom or enough for an outline, and a
        // species of the library is there for some and not for others.
        const ofLibrary = /^\/v1\/(library|tokens)/.test(path);
        if (ofLibrary && dice.chance(0.8)) headers.Authorization = `Bearer ${this.lists.token}`;
        let right = !path.startsWith("/v1/photos/") && path !== "/v1/traces" && path !== "/v1/outlines/check" && !ofLibrary, wrong = false, target = path;
        for (const parameter of operation.parameters ?? []) {
            if (parameter.in !== "path") continue;
            let value = this.pathValue(parameter.name, path) ?? this.right(parameter.schema, parameter.name);
            if (dice.chance(0.04)) [value, right] = [dice.pick(["nobody", "amanita_muscara", "%", "a:0,b:-1", "ä", "..", "x".repeat(300)]), false];
            target = target.replace(`{${parameter.name}}`, encodeURIComponent(value).replaceAll("%3A", ":").replaceAll("%2C", ",").replaceAll("%3D", "="));
        }
        const known = (operation.parameters ?? []).filter((one) => one.in === "query" && one.name !== "v");
        const small = known.filter((one) => ["lod", "texture_size", "count"].includes(one.name));
        for (const parameter of known) {
            const chosen = parameter.required || small.includes(parameter) || dice.chance(Math.min(0.5, 3 / known.length));
            if (!chosen) continue;
            const spoilt = dice.chance(0.06);
            if (spoilt) [right, wrong] = [false, true];
            query.push([parameter.name, spoilt ? this.wrong(parameter.schema, true) : this.right(parameter.schema, parameter.name.split(".").pop())]);
        }
        // A picture with the world round its plot takes seconds; few of them have it.
        const isAlone = path.endsWith("/plot.png") && dice.chance(0.8);
        if (isAlone && operation.parameters?.some((one) => one.name === "background") && !query.some(([key]) => key === "background")) query.push(["background", "grey"]);
        if (known.length && dice.chance(0.02)) [right] = [false, query.push(...query.slice(0, 1))];
        if (dice.chance(0.02)) [right] = [false, query.push([dice.pick(["sed", "v", "", "__proto__", "lod.x"]), "1"])];
        if (query.length) target += `?${query.map(([key, value]) => `${encodeURIComponent(key)}=${encodeURIComponent(value)}`).join("&")}`;
        if (dice.chance(0.005)) [right, target] = [false, `${target}${target.includes("?") ? "&" : "?"}a=${"y".repeat(5000)}`];
        if (dice.chance(0.005)) [right, target] = [false, `${target}${target.includes("?") ? "&" : "?"}a=%zz`];

        let body;
        const [type, content] = Object.entries(follow(this.document, operation.requestBody)?.content ?? {})[0] ?? [];
        if (type) {
            headers["Content-Type"] = type;
            if (type === "application/json") {
                const schema = follow(this.document, content.schema);
                const { properties } = schema;
                let value = this.right(schema);
                if ("texture_size" in properties) value = { texture_size: follow(this.document, properties.texture_size).enum[0], ...value };
                if ("lod" in properties) value = { lod: Math.min(3, follow(this.document, properties.lod).maximum), ...value };
                if ("count" in properties) value = { count: 2, ...value };
                if (isAlone) value = { background: "grey", ...value };
                if (dice.chance(0.15)) {
                    const key = dice.pick(Object.keys(properties));
                    value = { ...value, [key]: this.wrong(properties[key], false) };
                    [right, wrong] = [false, true];
                } else if (dice.chance(0.04)) {
                    [right, wrong, value] = [false, true, dice.pick([{ ...value, sed: 1 }, [], 7, null, { ...value, mix: { nobody: 1 } }])];
                }
                body = JSON.stringify(value);
                if (dice.chance(0.02)) [right, wrong, body] = [false, true, body.slice(0, -1)];
            } else {
                const file = path === "/v1/terrains" ? this.lists.heights : type.startsWith("image/") ? this.lists.picture : this.lists.file;
                body = file;
                if (dice.chance(0.5)) {
                    right = false;
                    body = Uint8Array.from(dice.pick([file.slice(0, dice.below(file.length)), new Uint8Array(dice.below(200)), file.map((one, i) => (i < 400 && dice.chance(0.02) ? dice.below(256) : one))]));
                }
            }
            if (dice.chance(0.02)) [right, wrong, headers["Content-Type"]] = [false, true, "text/plain"];
            if (dice.chance(0.01)) [right, wrong, headers["Content-Encoding"]] = [false, true, "gzip"];
        }
        headers["Accept-Encoding"] = dice.pick(["gzip", "identity"]);
        if (method === "GET" && dice.chance(0.1)) headers["Range"] = dice.pick(["bytes=0-99", "bytes=-20", "bytes=5-", "bytes=0-1,5-9", "bytes=99999999999-", "lines=1-2"]);
        if (dice.chance(0.03)) headers["If-None-Match"] = dice.pick(["*", '"nothing"', 'W/"x", "y"']);
        if (dice.chance(ofLibrary ? 0.6 : 0.02)) headers["If-Match"] = dice.pick(["*", '"nothing"']);
        return { method, target, headers, body, right, wrong };
    }
}

/** Fetches the ids that requests are made of: species by family, presets, types of problems, a file to inspect, a picture, the names of photographs, and species of the library. */
export async function listsOf(url, document) {
    const bytesOf = async (path) => new Uint8Array(await (await fetch(url + path)).arrayBuffer());
    const picture = await bytesOf("/v1/mushrooms/boletus_edulis.png?width=256&height=256&view=front&background=grey&lod=2");
    const uploaded = async () => (await (await fetch(`${url}/v1/photos`, { method: "POST", headers: { "Content-Type": "image/png" }, body: picture })).json()).photo;
    const heights = await bytesOf("/v1/worlds/meadow,extent=256/y80d270/maps/height.png?size=65");
    const terrain = async (metres) => (await (await fetch(`${url}/v1/terrains?metres=${metres}&max=30`, { method: "POST", headers: { "Content-Type": "image/png" }, body: heights })).json()).terrain;
    const file = await bytesOf("/v1/leaves/maple.glb?lod=3&texture_size=128");
    const scene = async () => (await (await fetch(`${url}/v1/scenes`, { method: "POST", headers: { "Content-Type": "model/gltf-binary" }, body: file })).json()).scene;
    const ofLeaf = await scene();
    const token = process.env.SPOREPRINT_TOKEN ?? "";
    const template = await (await fetch(`${url}/v1/species/boletus_edulis`)).json();
    const published = async (name) => {
        const send = (method, path, body, headers = {}) =>
            fetch(url + path, { method, headers: { Authorization: `Bearer ${token}`, "Content-Type": "application/json", ...headers }, body: JSON.stringify(body) });
        await send("POST", "/v1/library", { ...template, id: name });
        await send("POST", `/v1/library/~me.${name}/publish`, { bake: [3] }, { "If-Match": "*" });
        return `~me.${name}`;
    };
    const list = async (path, key) => (await (await fetch(url + path)).json())[key].map((one) => one.id);
    return {
    families: [await list("/v1/species?family=swept", "species"), await list("/v1/species?family=branched", "species")],
    leaves: await list("/v1/leaves", "leaves"),
    trees: await list("/v1/trees", "trees"),
    worlds: await list("/v1/worlds", "worlds"),
    types: Object.values(document.components.responses).map((one) => one.content?.["application/problem+json"]?.example.type.split("/").pop()).filter(Boolean),
    file,
    picture,
    heights,
    terrains: await Promise.all([320, 1280].map(terrain)),
    scenes: [ofLeaf],
    material: (await (await fetch(`${url}/v1/scenes/${ofLeaf}.json`)).json()).materials[0].name,
    photos: await Promise.all(Array.from({ length: 12 }, uploaded)),
    token,
    library: await Promise.all(["one", "two", "three", "four"].map(published)),
    };
}
