// Prints URLs of GLBs that cover what can be requested, one per line, for validate_glbs.mjs.
//
//   node tests/web_viewer/glb_urls.mjs SERVER 2         every pair of values of two parameters
//   node tests/web_viewer/glb_urls.mjs SERVER 3         every triple
//   node tests/web_viewer/glb_urls.mjs SERVER product   every combination
//
// The same server and strength give the same URLs. The file with default parameters is always one
// of them.
import { fileURLToPath } from "node:url";

/**
 * Returns rows that together contain every combination of values of `strength` factors (a covering
 * array), found greedily: each row begins with a combination that no row has yet, and uses for every
 * other factor the value that adds most new combinations.
 *
 * @param {number[]} sizes number of values of each factor
 * @param {number} strength from 1 to the number of factors
 * @returns {number[][]} indices of values, one for each factor
 */
export function coveringArray(sizes, strength) {
    const groups = [];
    const choose = (from, group) => {
        if (group.length === strength) return void groups.push(group);
        for (let i = from; i < sizes.length; ++i) choose(i + 1, [...group, i]);
    };
    choose(0, []);
    // Combinations that no row contains yet: for each group of factors, the numbers of the
    // combinations of their values.
    const missing = groups.map(
        (group) => new Set(Array(group.reduce((n, i) => n * sizes[i], 1)).keys()),
    );
    const place = (group, row) => group.reduce((n, i) => n * sizes[i] + row[i], 0);
    const rows = [];
    for (let g = 0; g < groups.length; ++g) {
        while (missing[g].size > 0) {
            const row = Array(sizes.length).fill(-1);
            let [rest] = missing[g];
            for (const i of [...groups[g]].reverse()) {
                row[i] = rest % sizes[i];
                rest = Math.floor(rest / sizes[i]);
            }
            for (let i = 0; i < sizes.length; ++i) {
                if (row[i] >= 0) continue;
                const complete = groups
                    .map((group, k) => [group, k])
                    .filter(
                        ([group]) =>
                            group.includes(i) && group.every((j) => j === i || row[j] >= 0),
                    );
                let best = 0;
                let most = -1;
                // Ties are resolved differently in each row, so that all values are used equally
                // often.
                for (let n = 0; n < sizes[i]; ++n) {
                    const value = (n + rows.length) % sizes[i];
                    row[i] = value;
                    const gain = complete.filter(([group, k]) =>
                        missing[k].has(place(group, row)),
                    ).length;
                    if (gain > most) [most, best] = [gain, value];
                }
                row[i] = best;
            }
            groups.forEach((group, k) => missing[k].delete(place(group, row)));
            rows.push(row);
        }
    }
    return rows;
}

/** Returns all rows of a Cartesian product. */
export function product(sizes) {
    return sizes.reduce(
        (rows, size) =>
            rows.flatMap((row) => [...Array(size).keys()].map((value) => [...row, value])),
        [[]],
    );
}

const small = "texture_size=128";
const images = [
    small,
    `${small}&image_format=webp&wind=uv`,
    `${small}&image_format=webp_jpg&wind=color`,
    `${small}&materials=rich`,
    "textures=external",
    "textures=none",
    "textures=none&wind=attribute",
];
// Instanced leaves have no wind.
const tree_images = [
    ...images,
    `${small}&instancing=gpu`,
    "textures=none&instancing=gpu",
];
const variants = [...images, `${small}&variants=weather`];
const lods = ["", "lod=1", "lod=2", "lod=3", "triangles=9000"];

/** Returns tiles of a world that show something: of each profile and layer from the coarsest to the finest. */
function tiles(world) {
    const places = {
        "y80m10/ground": ["0/0/0", "3/4/3", "5/14/21", "5/0/31"],
        "y80m10/trees": ["1/1/0", "3/3/5", "4/7/10", "5/0/31"],
        "y80m6/floor": ["3/3/5", "4/7/10", "5/14/21", "5/0/31"],
        "y80d270/fungi": ["3/3/5", "3/2/2", "4/7/10", "5/14/21"],
    };
    return ["core", "web"].flatMap((profile) =>
        Object.entries(places).flatMap(([layer, all]) => all.map((place) => `${world}/${profile}/${layer}/${place}`)),
    );
}

/** Returns for each product its route and its factors; the values are parts of a query. Some
 *  requests are listed alone, because each of their factors has one value. */
async function requestFactors(server) {
    const list = async (route, key) => {
        const response = await fetch(`${server}${route}`);
        if (!response.ok) throw new Error(`${route} responded with ${response.status}`);
        const found = (await response.json())[key].map(({ id }) => id);
        if (found.length < 3) throw new Error(`${route} has only ${found.length} ${key}`);
        return found;
    };
    const species = await list("/v1/species", "species");
    const mixes = [];
    for (const family of ["swept", "branched"]) {
        const related = await list(`/v1/species?family=${family}`, "species");
        for (let i = 1; i < related.length; ++i)
            mixes.push(`${related[i - 1]}:0.4,${related[i]}:0.6`);
    }
    const leaves = await list("/v1/leaves", "leaves");
    const trees = await list("/v1/trees", "trees");
    const ages = ["age=0", "age=0.25", "age=0.5", "age=0.75", "age=1"];
    const storage = ["", "", "compress=quantize", "compress=meshopt"];
    // OMI_physics_shape needs geometry as floats.
    const solid = [...storage, "collision=omi", "compress=meshopt&collision=nodes"];
    const levels = ["", "", "lods=nodes", "lods=msft"];
    // A clip moves one level of detail.
    const clips = [
        ...levels,
        "animation=growth",
        "animation=growth&frames=2",
        "animation=growth&frames=16&targets=position",
    ];
    const impostors = [
        `lod=4&${small}`,
        `lod=4&${small}&image_format=webp&wind=attribute`,
        `lod=4&${small}&image_format=webp_jpg&compress=meshopt&collision=nodes`,
        `lod=3&${small}&lods=nodes&impostor=true`,
        `lod=2&${small}&lods=msft&impostor=true&profile=web`,
    ];
    return [
        {
            route: "mushrooms",
            factors: [
                species,
                ages,
                lods,
                ["seed=7", "seed=8&share=species", "seed=9&variation=1"],
                variants,
                clips,
                solid,
            ],
        },
        {
            route: "mushrooms",
            factors: [mixes, ["age=0", "age=0.37", "age=0.5", "age=1"], lods, variants, clips, storage],
        },
        {
            route: "leaves",
            factors: [
                leaves,
                ["autumn=0", "autumn=0.5", "autumn=1"],
                lods,
                ["seed=7", "seed=7&variation=1"],
                images,
                ["", "curl_deg=180&size=0.25", "venation.teeth=1&venation.teeth_per_vein=6"],
                storage,
                levels,
            ],
        },
        {
            route: "trees",
            factors: [
                trees,
                ["autumn=0", "autumn=0.5"],
                lods,
                ["seed=7", "seed=8"],
                tree_images,
                ["", "size=0.25", "leaves.per_tip=0"],
                ["", "growth=drawn"],
                solid,
                levels,
            ],
        },
        {
            route: "colonies",
            factors: [
                [...species, "amanita_muscaria:0.5,boletus_edulis:0.5"],
                lods,
                ["count=9&distinct=3", "count=3&distinct=1&share=species"],
                ["seed=7", "seed=8"],
                variants,
                ["", "", "instancing=gpu"],
                solid,
                levels,
            ],
        },
        { route: "mushrooms", factors: [[...species, mixes[0]], impostors] },
        { route: "trees", factors: [trees, impostors] },
        { route: "colonies", factors: [["armillaria_mellea", "trametes_versicolor"], impostors] },
        { route: "mushrooms", factors: [species] },
        { route: "leaves", factors: [leaves] },
        { route: "trees", factors: [trees] },
        { route: "colonies", factors: [["hypholoma_fasciculare"]] },
        {
            route: "colonies",
            factors: [
                ["amanita_muscaria:0.5,boletus_edulis:0.5"],
                ["habit=rooted&textures=none&roots=shown"],
            ],
        },
        {
            route: "worlds",
            factors: [
                [
                    "beech,seed=7,extent=256/y80d270/plot",
                    "mixed,extent=256/y200d20/plot",
                    "meadow,extent=256/y10d150/plot",
                ],
                ["size=2", "size=4&x=20&y=-5", "size=4&layers=ground%2Bfungi"],
                ["lod=1", "lod=2"],
                ["texture_size=256", "texture_size=256&image_format=webp", "textures=none"],
                ["", "instancing=gpu"],
                ["", "compress=quantize", "compress=meshopt"],
            ],
        },
        { route: "worlds", factors: [tiles("beech,seed=7,extent=256")] },
    ];
}

async function main() {
    const [server, strength] = process.argv.slice(2);
    if (!/^https?:/.test(server ?? "") || !/^([23]|product)$/.test(strength ?? "")) {
        console.error("usage: glb_urls.mjs SERVER 2|3|product");
        process.exit(2);
    }
    const urls = new Set();
    for (const { route, factors } of await requestFactors(server.replace(/\/+$/, ""))) {
        // A value that is listed twice is used more often; in a whole product once is enough.
        const values = strength === "product" ? factors.map((list) => [...new Set(list)]) : factors;
        const sizes = values.map((list) => list.length);
        const rows =
            strength === "product"
                ? product(sizes)
                : coveringArray(sizes, Math.min(Number(strength), sizes.length));
        for (const row of rows) {
            const [id, ...query] = row.map((value, i) => values[i][value]);
            const parameters = query.filter(Boolean).join("&");
            urls.add(`${server}/v1/${route}/${id}.glb${parameters && `?${parameters}`}`);
        }
    }
    console.log([...urls].join("\n"));
}

if (process.argv[1] === fileURLToPath(import.meta.url)) await main();
