// How many processors, machines and bytes a fleet needs: simulates clients, an edge with a cache, replicas with caches
// and a shared store, with what making a file costs today.
//
//   node tests/bench/fleet_simulation.mjs                          the table of server/edge/README.md
//   node tests/bench/fleet_simulation.mjs --rate 5000 --replicas 4 --edge-gb 100
//
//   --rate N        requests a second (1000)
//   --variants N    files that clients ask for again and again, each in three levels of detail (100000)
//   --exponent X    of Zipf's law by which they do (0.9)
//   --one-hit X     share of requests for what nobody asks for again (0)
//   --replicas N    (3)
//   --memory-gb X   cache of each replica (0.25, as the default)
//   --affinity hash|none   whether the edge sends each address to one replica (hash)
//   --edge-gb X     cache of the edge (0)
//   --store-gb X    shared --store (0)
//   --requests N    simulated, after as many that fill the caches (1000000)
//   --costs FILE    milliseconds and bytes of a file by level of detail, as --measure prints
//   --measure       measures them on this machine with build/release/server/sporeprint
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import os from "node:os";
import path from "node:path";
import { pathToFileURL } from "node:url";

/** Shares of requests by level of detail, and what a file of it costs: measured in November 2026, two shared cores. */
export const today = [
    { lod: 0, share: 0.1, ms: 85.5, bytes: 2_270_000 },
    { lod: 1, share: 0.3, ms: 22.2, bytes: 336_000 },
    { lod: 2, share: 0.6, ms: 6.6, bytes: 69_800 },
];

/** Milliseconds of a replica's processor: of each request, and of reading a file of the store, by bytes. */
const requestMs = 0.06, storeMs = 0.3, storeMsPerByte = 1.2e-6;

/** Processors are planned to be busy so much of the time. */
const busy = 0.6;

/** A cache of so many bytes with the policy of the server, S3-FIFO: what is asked for once leaves soon. */
export class Cache {
    constructor(bytes) {
        this.most = bytes;
        this.entries = new Map();
        this.small = { first: 0, keys: [], bytes: 0 };
        this.main = { first: 0, keys: [], bytes: 0 };
        this.ghosts = new Set();
    }

    has(key) {
        const entry = this.entries.get(key);
        if (entry === undefined) return false;
        if (entry.uses < 3) ++entry.uses;
        return true;
    }

    add(key, bytes) {
        if (bytes > this.most / 8) return;
        const queue = this.ghosts.delete(key) ? this.main : this.small;
        this.push(queue, key, { bytes, uses: 0 });
        while (this.small.bytes + this.main.bytes > this.most) this.evict();
    }

    push(queue, key, entry) {
        queue.keys.push(key);
        queue.bytes += entry.bytes;
        this.entries.set(key, entry);
    }

    pop(queue) {
        const key = queue.keys[queue.first++];
        if (queue.first > 4096 && 2 * queue.first > queue.keys.length) {
            queue.keys.splice(0, queue.first);
            queue.first = 0;
        }
        const entry = this.entries.get(key);
        queue.bytes -= entry.bytes;
        this.entries.delete(key);
        return [key, entry];
    }

    evict() {
        if (this.small.bytes > this.most / 10 || this.main.bytes === 0) {
            const [key, entry] = this.pop(this.small);
            if (entry.uses > 0) return this.push(this.main, key, { ...entry, uses: 0 });
            this.ghosts.add(key);
            if (this.ghosts.size > this.entries.size + 64) this.ghosts.delete(this.ghosts.values().next().value);
            return undefined;
        }
        const [key, entry] = this.pop(this.main);
        if (entry.uses > 0) this.push(this.main, key, { ...entry, uses: entry.uses - 1 });
        return undefined;
    }
}

/** A generator of numbers that is the same in every run. */
export function draws(state) {
    return () => {
        state = (state + 0x6d2b79f5) | 0;
        let x = Math.imul(state ^ (state >>> 15), 1 | state);
        x = (x + Math.imul(x ^ (x >>> 7), 61 | x)) ^ x;
        return ((x ^ (x >>> 14)) >>> 0) / 4294967296;
    };
}

/** Returns a function that draws numbers below `count` by Zipf's law, from tables of 2048 equally frequent parts. */
export function zipf(count, exponent, draw) {
    const sums = new Float64Array(count);
    let sum = 0;
    for (let k = 0; k < count; ++k) sums[k] = sum += (k + 1) ** -exponent;
    const parts = 2048, begin = new Uint32Array(parts + 1).fill(count - 1);
    for (let k = 0, part = 0; part < parts; ++part) {
        while (sums[k] < (sum * part) / parts) ++k;
        begin[part] = k;
    }
    return () => {
        const at = draw() * parts, part = Math.floor(at);
        let low = begin[part], high = begin[part + 1];
        const wanted = (at / parts) * sum;
        while (low < high) {
            const middle = (low + high) >> 1;
            if (sums[middle] < wanted) low = middle + 1;
            else high = middle;
        }
        return low;
    };
}

const hash = (key) => {
    let x = Math.imul(key ^ (key >>> 16), 0x45d9f3b);
    x = Math.imul(x ^ (x >>> 16), 0x45d9f3b);
    return (x ^ (x >>> 16)) >>> 0;
};

export const defaults = {
    rate: 1000, variants: 100_000, exponent: 0.9, "one-hit": 0, replicas: 3, "memory-gb": 0.25, affinity: "hash",
    "edge-gb": 0, "store-gb": 0, requests: 1_000_000,
};

/** Returns what a fleet does: shares of requests, processors and bytes a second. */
export function simulate(options, costs = today) {
    const all = { ...defaults, ...options };
    const draw = draws(1), pick = zipf(all.variants, all.exponent, draw);
    const edge = new Cache(all["edge-gb"] * 1e9), store = new Cache(all["store-gb"] * 1e9);
    const replicas = Array.from({ length: all.replicas }, () => new Cache(all["memory-gb"] * 1e9));
    let next = all.variants, sums;
    const one = () => {
        const variant = draw() < all["one-hit"] ? next++ : pick();
        let at = draw(), level = 0;
        while (level + 1 < costs.length && at >= costs[level].share) at -= costs[level++].share;
        const key = variant * costs.length + level, { ms, bytes } = costs[level];
        sums.bytes += bytes;
        if (edge.has(key)) return ++sums.edge;
        const replica = replicas[all.affinity === "hash" ? hash(key) % all.replicas : Math.floor(draw() * all.replicas)];
        sums.ms += requestMs;
        edge.add(key, bytes);
        if (replica.has(key)) return ++sums.memory;
        replica.add(key, bytes);
        if (store.has(key)) {
            sums.ms += storeMs + storeMsPerByte * bytes;
            return ++sums.store;
        }
        store.add(key, bytes);
        sums.ms += ms;
        return ++sums.made;
    };
    for (let pass = 0; pass < 2; ++pass) {
        sums = { edge: 0, memory: 0, store: 0, made: 0, ms: 0, bytes: 0 };
        for (let i = 0; i < all.requests; ++i) one();
    }
    const of = (count) => count / all.requests;
    return {
        edge: of(sums.edge), memory: of(sums.memory), store: of(sums.store), made: of(sums.made),
        cores: (all.rate * of(sums.ms)) / 1000 / busy,
        gigabits: (all.rate * of(sums.bytes) * 8) / 1e9,
    };
}

/** Measures what a file costs on this machine, by `sporeprint bake` with one thread. */
export function measured() {
    const own = mkdtempSync(path.join(os.tmpdir(), "sporeprint_costs_"));
    try {
        return today.map(({ lod, share }) => {
            const manifest = {
                path: "/v1/mushrooms/{mix}.glb", count: 120, number: { seed: 1 }, fixed: { lod },
                choice: { mix: ["amanita_muscaria", "boletus_edulis", "cantharellus_cibarius", "morchella_esculenta", "trametes_versicolor"] },
                uniform: { age: [0.2, 1] },
            };
            const file = path.join(own, `${lod}.json`);
            writeFileSync(file, JSON.stringify(manifest));
            const { stderr, status } = spawnSync(
                "build/release/server/sporeprint",
                ["bake", file, "--out", path.join(own, `${lod}`), "--threads", "1", "--progress", "json"],
                { encoding: "utf8" },
            );
            if (status !== 0) throw new Error(stderr);
            const { items, seconds, bytes } = JSON.parse(stderr.trim().split("\n").at(-1));
            return { lod, share, ms: Number(((1000 * seconds) / items).toFixed(2)), bytes: Math.round(bytes / items) };
        });
    } finally {
        rmSync(own, { recursive: true, force: true });
    }
}

const percent = (share) => `${(100 * share).toFixed(1)} %`;

function print(rows) {
    const widths = rows[0].map((_, column) => Math.max(...rows.map((row) => row[column].length)));
    for (const row of rows) console.log(`| ${row.map((text, column) => text.padEnd(widths[column])).join(" | ")} |`);
}

function options(args) {
    const out = {};
    for (let i = 0; i < args.length; ++i) {
        const name = args[i].slice(2);
        if (name === "measure") out.measure = true;
        else if (name === "costs") out.costs = args[++i];
        else if (!(name in defaults)) throw new Error(`there is no ${args[i]}; the head of this file lists what there is`);
        else out[name] = name === "affinity" ? args[++i] : Number(args[++i]);
        if (typeof defaults[name] === "number" && !(out[name] >= 0)) throw new Error(`${args[i - 1]}: ${args[i]} is no number`);
    }
    return out;
}

function main(args) {
    const { measure, costs: file, ...given } = options(args);
    if (measure) return console.log(JSON.stringify(measured()));
    const costs = file ? JSON.parse(readFileSync(file, "utf8")) : today;
    const row = (name, more) => {
        const { edge, memory, store, made, cores, gigabits } = simulate({ ...given, ...more }, costs);
        return [name, percent(edge), percent(memory), percent(store), percent(made), cores.toFixed(1), gigabits.toFixed(2)];
    };
    const head = [["fleet", "edge", "memory", "store", "made", "cores", "Gbit/s"], Array(7).fill("---")];
    if (Object.keys(given).length > 0) return print([...head, row("as given", {})]);
    return print([
        ...head,
        row("3 replicas, any of them", { affinity: "none" }),
        row("3 replicas, one for each address", {}),
        row("with an edge of 10 GB", { "edge-gb": 10 }),
        row("with an edge of 100 GB", { "edge-gb": 100 }),
        row("with a shared store of 100 GB", { "store-gb": 100 }),
        row("edge of 100 GB, a fifth requested once", { "edge-gb": 100, "one-hit": 0.2 }),
    ]);
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) main(process.argv.slice(2));
