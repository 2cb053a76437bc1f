// Truths about the simulation of fleets, by which machines are planned.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Cache, simulate } from "../bench/fleet_simulation.mjs";

const small = { variants: 2000, requests: 60_000, "memory-gb": 1000 };
const sum = ({ edge, memory, store, made }) => edge + memory + store + made;
const near = (a, b, within) => assert.ok(Math.abs(a - b) <= within, `${a} is not ${b}`);

test("a cache holds no more than its bytes, and what is used again", () => {
    const cache = new Cache(1000);
    for (let k = 0; k < 500; ++k) {
        cache.add(k, 10);
        assert.ok(cache.small.bytes + cache.main.bytes <= 1000);
        if (k >= 7) assert.ok(cache.has(7), `What is used again is lost at ${k}.`);
    }
    assert.ok(cache.has(499));
    assert.ok(!cache.has(100));
    cache.add("large", 126);
    assert.ok(!cache.has("large"), "One file may not fill a cache.");
    assert.ok(!new Cache(0).has(1));
});

test("every request is responded to by somebody", () => {
    for (const options of [{}, { affinity: "none" }, { "edge-gb": 0.05 }, { "store-gb": 0.1, "one-hit": 0.3 }])
        near(sum(simulate({ ...small, "memory-gb": 0.02, ...options })), 1, 1e-9);
});

test("with room for everything each file is made once, or once by each replica", () => {
    // After as many requests that filled the caches next to nothing is new.
    assert.ok(simulate(small).made < 0.02);
    const hash = simulate({ ...small, requests: 3000 }), any = simulate({ ...small, requests: 3000, affinity: "none" });
    assert.ok(any.made > hash.made, "Any replica makes what another one has.");
    near(simulate({ ...small, requests: 3000, "store-gb": 1000, affinity: "none" }).made, hash.made, 0.02);
    near(simulate({ ...small, "one-hit": 0.25 }).made, 0.25, 0.02);
});

test("what is before the replicas relieves them, and rates are in proportion", () => {
    const options = { ...small, "memory-gb": 0.01 };
    const plain = simulate(options), edge = simulate({ ...options, "edge-gb": 0.2 });
    assert.ok(edge.made < plain.made && edge.cores < plain.cores);
    near(edge.gigabits, plain.gigabits, 1e-9);
    near(simulate({ ...options, rate: 3000 }).cores, 3 * plain.cores, 1e-9);
    const free = [{ lod: 0, share: 1, ms: 0, bytes: 1000 }];
    near(simulate({ ...options, rate: 1000 }, free).cores, (1000 * 0.06) / 1000 / 0.6, 1e-9);
    near(simulate({ ...options, rate: 1000 }, free).gigabits, 0.008, 1e-9);
});
