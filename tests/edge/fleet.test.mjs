// Replicas behind the edges of server/edge, as real processes: what clients see when replicas die, upgrade or are full.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { cpSync, mkdirSync, writeFileSync } from "node:fs";
import http from "node:http";
import path from "node:path";
import { test } from "node:test";
import * as fleet from "./support.mjs";

const { ask, addressesOf, generation } = fleet;

const variant = (k) =>
    `/v1/mushrooms/${k % 2 ? "boletus_edulis" : "amanita_muscaria"}.glb?seed=${k + 1}&lod=3&texture_size=128`;

test("configurations are valid, and what is wrong is named", (t) => {
    const own = fleet.folder(t), keys = path.join(own, "keys");
    writeFileSync(keys, "# first\nk1 00112233445566778899aabbccddeeff\n");
    const one = ["--pool", "37=127.0.0.1:1,127.0.0.1:2"];
    const two = [...one, "--pool", "38a=127.0.0.1:3", "--pool", "38b=127.0.0.1:4", "--today", "38a"];
    const archive = ["--archive", "127.0.0.1:9/bucket", "--run", own, "--cache", path.join(own, "cache")];
    const file = path.join(own, "conf");
    for (const pools of [one, two]) {
        fleet.configuredIn(file, "nginx", [...pools, ...archive]);
        execFileSync("nginx", ["-t", "-q", "-c", file, "-e", "stderr"], { stdio: "pipe" });
        fleet.configuredIn(file, "varnish", pools);
        execFileSync("varnishd", ["-C", "-f", file], { stdio: "pipe" });
        fleet.configuredIn(file, "haproxy", [...one, ...(pools === one ? [] : ["--pool", "38b=127.0.0.1:3"]), "--keys", keys]);
        execFileSync("haproxy", ["-c", "-q", "-f", file], { stdio: "pipe" });
    }
    // As Debian's service reads it: its unit names this process file, which nginx -t would create.
    const system = fleet.configured("nginx", [...one, "--cache", path.join(own, "cache")]);
    assert.match(system, /^user www-data;\npid \/run\/nginx\.pid;$/m);
    writeFileSync(file, system.replace("/run/nginx.pid", path.join(own, "pid")));
    execFileSync("nginx", ["-t", "-q", "-c", file, "-e", "stderr"], { stdio: "pipe" });
    const refuses = (args, what) => {
        const { status, stderr } = spawnSync("server/edge/configure", args, { encoding: "utf8" });
        assert.equal(status, 2, args.join(" "));
        assert.match(stderr, what);
    };
    refuses([], /configure nginx .*--pool/);
    refuses(["apache"], /not 'apache'/);
    assert.match(execFileSync("server/edge/configure", ["--help"], { encoding: "utf8" }), /--archive HOST:PORT\/BUCKET/);
    refuses(["nginx"], /--pool is missing/);
    refuses(["nginx", "--pool", "x=1"], /'x=1' is not allowed/);
    refuses(["nginx", "--pool", "37=host"], /'host' is not HOST:PORT/);
    refuses(["nginx", "--pool", "37=a:1;b"], /is not HOST:PORT/);
    refuses(["nginx", "--pool", "37="], /'37=' has no HOST:PORT/);
    refuses(["nginx", "--pool", "37=a:1,"], /'' is not HOST:PORT/);
    refuses(["nginx", ...one, ...one], /there are two pools '37'; the second of one number is '37b'/);
    refuses(["nginx", ...one, "--keys", keys], /--keys is not an option of nginx/);
    refuses(["varnish", ...one, "--cache-gb", "1"], /--cache-gb is not an option of varnish/);
    refuses(["nginx", ...one, "--today", "36"], /there is no pool '36'/);
    refuses(["nginx", ...one, "--listen", "80"], /'80' is not HOST:PORT/);
    refuses(["nginx", ...one, "--cache-gb", "0"], /'0' is not a positive integer/);
    refuses(["nginx", ...one, "--archive", "host:1"], /'host:1' is not HOST:PORT\/BUCKET/);
    refuses(["nginx", ...one, "--speed", "1"], /there is no --speed/);
    refuses(["nginx", "--pool"], /--pool needs a value/);
    refuses(["nginx", "--edges", "a:1"], /--edges is not an option of nginx/);
    refuses(["haproxy", ...one, "--edges", "a:1"], /HAProxy before them does not/);
    refuses(["haproxy", ...two], /HAProxy cannot ask a second pool of number 38; nginx and Varnish can/);
    refuses(["haproxy", "--edges", "a"], /'a' is not HOST:PORT/);
    refuses(["haproxy", ...one, "--keys", "/nowhere"], /\/nowhere cannot be read/);
    refuses(["haproxy", ...one, "--base-path", "sp/"], /'sp\/' is not like \/sporeprint/);
    for (const [text, what] of [["# none\n", /has no key/], ["k1 0011\n", /line 1 of/], [`a b\nk1 ${"00".repeat(16)} more\n`, /line 1 of/]]) {
        writeFileSync(keys, text);
        refuses(["haproxy", ...one, "--keys", keys], what);
    }
});

test("behind nginx a replica dies twice, and every response is 200", async (t) => {
    const replicas = await Promise.all([1, 2, 3].map(() => fleet.replica(t, ["--threads", "1"])));
    const edge = await fleet.nginx(t, ["--pool", `${generation}=${addressesOf(replicas)}`]);
    const agent = new http.Agent({ keepAlive: true, maxSockets: 12 });
    t.after(() => agent.destroy());
    const draw = fleet.draws(1), pick = fleet.zipf(400, 0.9, draw);
    const seen = new Set(), wrong = [];
    let lost = 0, slowest = 0;
    await fleet.together(2000, 12, async (i) => {
        if (i === 600 || i === 1300) {
            // The last count of one that is killed, which a new one begins at 0.
            lost += await fleet.made(replicas[1].port);
            await fleet.stop(replicas[1], "SIGKILL");
            replicas[1] = await fleet.replica(t, ["--threads", "1"], replicas[1].port);
        }
        const k = pick();
        seen.add(k);
        const { status, body, ms } = await ask(edge.port, variant(k), { agent });
        slowest = Math.max(slowest, ms);
        if (status !== 200 || body.subarray(0, 4).toString() !== "glTF") wrong.push(`${status} ${variant(k)}`);
    });
    assert.deepEqual(wrong, []);
    let made = lost;
    for (const one of replicas) made += await fleet.made(one.port);
    t.diagnostic(`${made} made of ${seen.size} distinct, slowest ${slowest.toFixed(0)} ms`);
    // Each of four replicas and more has made a file for its test of itself.
    assert.ok(made - 5 <= 1.3 * seen.size, `${made} made of ${seen.size} distinct`);
    const again = await ask(edge.port, variant(0), { agent });
    assert.equal(again.headers["cache-status"], "edge; hit");
    assert.match((await ask(edge.port, variant(1000))).headers["cache-status"], /^sporeprint.*; stored, edge; fwd=miss$/);
    assert.equal((await ask(edge.port, "/v1/none")).headers["cache-status"], "edge; fwd=miss");
    for (const [target, status, options] of [
        ["/v1/mushrooms/none.glb", 404], ["/v1/mushrooms.glb", 415, { method: "POST", body: "{" }], ["/v1/species", 405, { method: "DELETE" }],
        [`${variant(0)}&v=${generation}-00000000`, 410],
    ]) {
        const refused = await ask(edge.port, target, options);
        assert.equal(refused.status, status, target);
        assert.equal(refused.headers["x-request-id"], JSON.parse(refused.body).instance, "The id is that of the replica's log.");
        assert.match(refused.headers["cache-status"], /^edge; fwd=(miss|bypass)$/, target);
    }
    const hidden = await ask(edge.port, "/metrics");
    assert.equal(hidden.status, 404);
    assert.match(hidden.headers["x-request-id"], /^[0-9a-f]{32}$/);
    assert.equal(hidden.headers["cache-status"], undefined);
    for (const target of [variant(0), variant(1001)]) {
        // Node joins what is sent twice by a comma.
        const beyond = await ask(edge.port, target, { headers: { Range: "bytes=99999999-" } });
        assert.equal(beyond.status, 416);
        assert.match(beyond.headers["cache-status"], /^edge; hit$|^sporeprint.*stored, edge; fwd=miss$/);
        assert.match(beyond.headers["x-request-id"], /^[0-9a-f]+$/);
    }
    const range = await ask(edge.port, variant(0), { headers: { Range: "bytes=0-3" } });
    assert.equal(range.status, 206);
    assert.equal(range.body.toString(), "glTF");
    const same = await ask(edge.port, variant(0), { headers: { "If-None-Match": again.headers.etag } });
    assert.equal(same.status, 304);
});

/** Returns a folder of templates that differ in a number of a species and one of a world. */
function otherTemplates(t) {
    const own = fleet.folder(t);
    for (const [kind, from] of [["species", "species"], ["leaves", "leaves"], ["trees", "trees"], ["worlds", "worlds"]]) {
        mkdirSync(path.join(own, kind));
        cpSync(`core/atlas/${from}`, path.join(own, kind), { recursive: true });
    }
    const file = path.join(own, "species/boletus_edulis.json");
    const species = JSON.parse(fleet.textOf(file));
    species.spread.lightness += 0.01;
    writeFileSync(file, JSON.stringify(species));
    const world = path.join(own, "worlds/beech.json"), beech = JSON.parse(fleet.textOf(world));
    beech.terrain.relief += 1;
    writeFileSync(world, JSON.stringify(beech));
    return own;
}

/** Returns a folder with one species. */
function oneSpecies(t) {
    const own = fleet.folder(t);
    mkdirSync(path.join(own, "species"));
    cpSync("core/atlas/species/boletus_edulis.json", path.join(own, "species/boletus_edulis.json"));
    return own;
}

/** The addresses of the images that a file links to. */
function linksOf(body, target) {
    const length = body.readUInt32LE(12);
    const file = JSON.parse(body.subarray(20, 20 + length).toString());
    return file.images.map(({ uri }) => {
        const { pathname, search } = new URL(uri, `http://host${target}`);
        return pathname + search;
    });
}

for (const kind of ["nginx", "varnish"])
    test(`an upgrade behind ${kind}, and back, loses no image of a file`, async (t) => {
        const before = await fleet.replica(t), after = await fleet.replica(t, ["--atlas", otherTemplates(t)]);
        const pools = ["--pool", `${generation}a=127.0.0.1:${before.port}`, "--pool", `${generation}b=127.0.0.1:${after.port}`];
        const address = (k) => `/v1/mushrooms/boletus_edulis.glb?seed=${k}&lod=3&texture_size=128&textures=linked&age=0.${10 + k}`;
        const own = new Map();
        for (const one of [before, after]) {
            const { headers } = await ask(one.port, address(1));
            own.set(one, headers["content-location"].match(/v=([^&]+)/)[1]);
        }
        assert.notEqual(own.get(before), own.get(after), "The templates are the same.");
        let edge = await fleet[kind](t, [...pools, "--today", `${generation}a`]);
        const counts = {};
        const links = [], versions = [];
        const use = async (first) => {
            for (let k = first; k < first + 12; ++k) {
                const file = await ask(edge.port, address(k));
                assert.equal(file.status, 200);
                versions.push(file.headers["content-location"].match(/v=([^&]+)/)[1]);
                links.push(...linksOf(file.body, address(k)));
            }
            for (const link of links) {
                const { status } = await ask(edge.port, link);
                counts[status] = (counts[status] ?? 0) + 1;
            }
        };
        const switchTo = async (today) => {
            const options = [...pools, "--today", today];
            if (kind === "nginx") return edge.reload(options);
            await fleet.stop(edge);
            edge = await fleet.varnish(t, options);
        };
        await use(1);
        await switchTo(`${generation}b`);
        await use(1);
        await switchTo(`${generation}a`);
        await use(20);
        assert.equal(links.length, 3 * 36);
        assert.ok(new Set(links).size > 36, "All files have the same images.");
        assert.deepEqual(Object.keys(counts), ["200"]);
        assert.deepEqual(
            [...versions],
            [before, after, before].flatMap((one) => Array(12).fill(own.get(one))),
        );
        // What nobody has stays gone, with the name that it has today.
        const gone = await ask(edge.port, `${address(1)}&v=${generation}-00000000`);
        assert.equal(gone.status, 410);
        assert.ok(JSON.parse(gone.body).canonical.includes(`v=${own.get(before)}`), gone.body.toString());
    });

for (const kind of ["nginx", "varnish", "haproxy"])
    test(`a burst beyond all replicas behind ${kind} is 503 with Retry-After, and what costs nothing goes on`, async (t) => {
        const busy = [0, 0, 0];
        const replicas = await Promise.all(
            busy.map((_, i) =>
                fleet.fake(t, async (request, response) => {
                    if (request.method === "POST") {
                        let bytes = 0;
                        for await (const part of request) bytes += part.length;
                        return i ? response.writeHead(503).end() : response.end(String(bytes));
                    }
                    if (!request.url.startsWith("/v1/mushrooms/")) return response.end("free");
                    if (busy[i] >= 10) return response.writeHead(503, { "Retry-After": "7" }).end("full");
                    ++busy[i];
                    await fleet.sleep(250);
                    --busy[i];
                    response.end(`made by ${i}`);
                }),
            ),
        );
        const edge = await fleet[kind](t, ["--pool", `${generation}=${addressesOf(replicas)}`]);
        const burst = (count, name) => Promise.all(Array.from({ length: count }, (_, k) => ask(edge.port, `/v1/mushrooms/${name}${k}.glb`)));
        const all = burst(200, "burst"), free = [];
        for (let i = 0; i < 10; ++i) {
            free.push((await ask(edge.port, `/v1/trees?${i}`)).status);
            await fleet.sleep(10);
        }
        assert.deepEqual(new Set(free), new Set([200]));
        const counts = {};
        for (const { status, headers } of await all) {
            counts[status] = (counts[status] ?? 0) + 1;
            if (status === 503) assert.equal(headers["retry-after"], "7");
        }
        assert.deepEqual(Object.keys(counts), ["200", "503"], JSON.stringify(counts));
        // All have room for 30, each for 10.
        assert.deepEqual(new Set((await burst(22, "few")).map(({ status }) => status)), new Set([200]));
        // Two of three are full for what is sent, with its body.
        if (kind !== "haproxy")
            for (let k = 0; k < 10; ++k) assert.equal((await ask(edge.port, "/v1/sets.glb", { method: "POST", body: "x".repeat(100_000) })).body.toString(), "100000");
        // One dies.
        replicas[0].close();
        const began = performance.now();
        for (let k = 0; k < 20; ++k) assert.equal((await ask(edge.port, `/v1/trees?dead${k}`)).status, 200);
        assert.ok(performance.now() - began < 1000, "It is passed over at once.");
    });

test("the most frequent addresses are compared before an upgrade", async (t) => {
    const own = fleet.folder(t), log = path.join(own, "log"), list = path.join(own, "list");
    const before = await fleet.replica(t), after = await fleet.replica(t, ["--atlas", otherTemplates(t)]);
    const edge = await fleet.nginx(t, ["--pool", `${generation}=127.0.0.1:${before.port}`, "--log", log]);
    const cep = "/v1/mushrooms/boletus_edulis.glb?lod=3&textures=none", agaric = cep.replace("boletus_edulis", "amanita_muscaria");
    const pinned = (await ask(edge.port, agaric)).headers["content-location"];
    assert.match(pinned, /&v=/);
    const map = "/v1/worlds/beech,seed=7/y0/maps/height.json?size=65", version = new URL(pinned, "http://host").searchParams.get("v");
    const mapPinned = map.replace("seed=7/", `seed=7,v=${version}/`);
    for (const [target, times] of [[cep, 3], [agaric, 4], [pinned, 2], [`${cep}&age=7`, 5], ["/v1", 9], [map, 1], [mapPinned, 1], [`${cep}&key=k1&expires=9999999999&sig=x`, 1]])
        for (let i = 0; i < times; ++i) await ask(edge.port, target);
    await fleet.sleep(1300);
    const asked = execFileSync("server/edge/most_asked", [log, "3"], { encoding: "utf8" });
    assert.equal(asked, `${agaric}\n${cep}\n${map}\n`);
    const signed = path.join(own, "signed");
    writeFileSync(signed, `200 GET ${cep}&key=k1&expires=9999999999&sig=x id\n200 GET ${mapPinned} id\n`);
    assert.equal(execFileSync("server/edge/most_asked", [signed], { encoding: "utf8" }), `${cep}\n${map}\n`);
    writeFileSync(signed, '127.0.0.1 - - [30/Nov/2026] "GET /v1/trees/birch.glb HTTP/1.1" 200 5\n');
    const other = spawnSync("server/edge/most_asked", [signed], { encoding: "utf8" });
    assert.equal(other.status, 1);
    assert.match(other.stderr, /has no line such as '200 GET/);
    writeFileSync(list, asked);
    const url = (one) => `http://127.0.0.1:${one.port}`;
    const canary = (a, b, ...more) => spawnSync("server/edge/canary", [url(a), url(b), list, ...more], { encoding: "utf8" });
    const same = canary(before, before);
    assert.equal(same.status, 0, same.stderr);
    assert.equal(same.stdout, "2 compared, 0 different, bytes differ in 0\n");
    writeFileSync(list, `${asked}/v1/mushrooms/boletus_edulis.glb?lod=3&age=8\n`);
    assert.equal(canary(before, before).status, 0, "What neither can make is equal.");
    const gone = await fleet.replica(t, ["--atlas", oneSpecies(t)]);
    const changed = canary(before, gone);
    assert.equal(changed.status, 1);
    assert.match(changed.stdout, /amanita_muscaria.*: 404 instead of 200/);
    assert.match(changed.stdout, /3 compared, 1 different, bytes differ in 0/);
    writeFileSync(list, `${agaric}\n/v1/mushrooms/boletus_edulis.glb?lod=3&texture_size=128`); // The last line has no end.
    const coloured = canary(before, after, "0");
    assert.equal(coloured.status, 0, "Colours alone are to be looked at.");
    assert.equal(coloured.stdout, "2 compared, 0 different, bytes differ in 1\n");
    writeFileSync(list, "/v1/trees/a.glb\n");
    const generatorIs = (text) => fleet.fake(t, (request, response) => response.end(request.method === "POST" ? "{}" : `glTF{"asset":{"generator":"Sporeprint ${text}`));
    const named = await Promise.all(['37"}}', '38"}}', '38"},"a":1}'].map(generatorIs));
    assert.match((await fleet.ended("server/edge/canary", [url(named[0]), url(named[1]), list])).output, /bytes differ in 0/);
    assert.match((await fleet.ended("server/edge/canary", [url(named[0]), url(named[2]), list])).output, /bytes differ in 1/);
    writeFileSync(list, "# none\n");
    const none = canary(before, before);
    assert.equal(none.status, 2);
    assert.match(none.stderr, /list has no address of a GLB file/);
    writeFileSync(list, asked);
    assert.equal(canary(before, after, "x").status, 2);
    const silent = canary(before, { port: await fleet.freePort() });
    assert.equal(silent.status, 2);
    assert.match(silent.stderr, /does not respond to \/v1\/mushrooms/);
});

test("what a retired version left is served from an archive", async (t) => {
    // An object store, as far as rclone and nginx use it.
    const objects = new Map();
    const reads = [];
    let puts = 0, refusing = false;
    const store = http.createServer((request, response) => {
        const key = decodeURIComponent(request.url.split("?")[0]);
        if (request.method === "PUT") {
            ++puts;
            if (refusing) return response.writeHead(403).end();
            const parts = [];
            request.on("data", (part) => parts.push(part));
            request.on("end", () => {
                const body = Buffer.concat(parts);
                objects.set(key, { body, headers: request.headers });
                response.writeHead(200, { ETag: `"${createHash("md5").update(body).digest("hex")}"` });
                response.end();
            });
            return;
        }
        reads.push(request.url);
        const found = objects.get(key);
        if (!found) return response.writeHead(404).end();
        const { body, headers } = found;
        response.writeHead(200, {
            "Content-Type": headers["content-type"], "Content-Length": body.length, "x-amz-meta-etag": headers["x-amz-meta-etag"],
            "x-amz-meta-mtime": headers["x-amz-meta-mtime"], "x-amz-request-id": "1", ETag: `"${createHash("md5").update(body).digest("hex")}"`,
            "Last-Modified": new Date().toUTCString(),
        });
        response.end(request.method === "HEAD" ? undefined : body);
    });
    await new Promise((resolve) => store.listen(0, "127.0.0.1", resolve));
    t.after(() => store.close());
    t.after(() => store.closeAllConnections());
    const own = fleet.folder(t), manifest = path.join(own, "list"), out = path.join(own, "set");
    const targets = [1, 2, 3].map((k) => `/v1/mushrooms/boletus_edulis:0.5,amanita_muscaria:0.5.glb?seed=${k}&lod=1&texture_size=512`);
    const linked = "/v1/mushrooms/boletus_edulis.glb?seed=1&lod=3&texture_size=128&textures=linked";
    targets.push(linked, "/v1/worlds/beech,seed=7/y0/maps/height.json", "/v1/worlds/beech,seed=7/y0/maps/height.png?size=65");
    writeFileSync(manifest, `${targets.join("\n")}\n/v1/mushrooms/none.glb\n`);
    const retired = ["--atlas", otherTemplates(t)];
    const bake = (...more) => execFileSync(fleet.binary, ["bake", manifest, "--out", out, ...more, ...retired], { stdio: "pipe" });
    bake();
    const environment = {
        ...Object.fromEntries(Object.entries(process.env).filter(([name]) => !name.startsWith("AWS_"))),
        RCLONE_CONFIG: path.join(own, "rclone.conf"), RCLONE_CONFIG_S_TYPE: "s3", RCLONE_CONFIG_S_PROVIDER: "Other",
        RCLONE_CONFIG_S_ACCESS_KEY_ID: "id", RCLONE_CONFIG_S_SECRET_ACCESS_KEY: "secret",
        RCLONE_CONFIG_S_ENDPOINT: `http://127.0.0.1:${store.address().port}`, RCLONE_CONFIG_S_FORCE_PATH_STYLE: "true",
    };
    const archive = (from = out) => fleet.ended("server/edge/archive", [from, "s:bucket"], environment);
    const unfinished = await archive();
    assert.equal(unfinished.status, 2);
    assert.match(unfinished.output, /not complete/);
    assert.throws(() => bake("--finish"), { status: 5 });  // one of them cannot be made
    const index = path.join(out, "000000.jsonl");
    const lines = fleet.textOf(index).trim().split("\n").map((line) => JSON.parse(line));
    const { url: canonical, listed: spelled } = lines.find(({ url }) => url?.includes("linked")), version = canonical.match(/v=([^&]+)/)[1];
    assert.doesNotMatch(canonical, /seed=/);
    assert.equal(spelled, `${linked}&v=${version}`, "The address as the list spells it.");
    const names = new Set(lines.flatMap(({ url, listed }) => [url, listed].filter((name) => name !== undefined)));
    const done = await archive();
    assert.equal(done.status, 0, done.output);
    assert.equal(objects.size, names.size);
    assert.match(done.output, /link to 3 files that are not in/);
    assert.match(done.output, new RegExp(`^/v1/mushrooms/boletus_edulis/base_color\\.jpg\\?.*v=${version}$`, "m"));
    assert.match(done.output, new RegExp(`archive: ${names.size} objects$`, "m"));
    const before = puts;
    objects.delete(`/bucket${canonical}`);
    refusing = true;
    const failed = await archive();
    refusing = false;
    assert.equal(failed.status, 1);
    assert.match(failed.output, /1 objects of .* could not be written/);
    assert.equal((await archive()).status, 0);
    assert.equal(puts, before + 2, "What is there is not sent again.");
    const files = path.join(own, "files");
    mkdirSync(files);
    writeFileSync(path.join(files, "bake.json"), JSON.stringify({ layout: "files" }));
    const folder = await archive(files);
    assert.equal(folder.status, 2);
    assert.match(folder.output, /has the layout files; bake it with --layout tar/);
    const today = await fleet.replica(t);
    const edge = await fleet.nginx(t, [
        ...["--pool", `${generation}=127.0.0.1:${today.port}`, "--archive", `127.0.0.1:${store.address().port}/bucket`],
    ]);
    const own200 = (await ask(today.port, targets[0])).headers;
    for (const { url, etag, sha256, type, listed } of lines.slice(1).flatMap((line) => [line, ...(line.listed ? [{ ...line, url: line.listed }] : [])])) {
        if (!url) continue;
        assert.equal((await ask(today.port, url)).status, 410, url);
        const archived = await ask(edge.port, url);
        assert.equal(archived.status, 200, url);
        assert.equal(createHash("sha256").update(archived.body).digest("hex"), sha256);
        const again = await ask(edge.port, url, { headers: { "If-None-Match": etag } });
        assert.equal(again.status, 304, url);
        for (const { headers } of [archived, again]) {
            assert.equal(headers.etag, etag);
            assert.equal(headers["cache-control"], "public, max-age=31536000, immutable");
            for (const name of Object.keys(own200).filter((one) => /^access-control|^cross-origin|^timing|^x-content/.test(one)))
                assert.equal(headers[name], own200[name], name);
            assert.deepEqual(Object.keys(headers).filter((one) => /^x-amz|last-modified/.test(one)), []);
        }
        assert.equal(archived.headers["content-type"], type);
        assert.equal(archived.headers["cache-status"], "edge; fwd=miss; detail=archive");
        assert.equal(again.headers["cache-status"], "edge; hit; detail=archive");
        assert.equal((await ask(edge.port, url, { headers: { "If-None-Match": '"other"' } })).status, 200);
    }
    for (const other of ["/%3Flist-type=2", "/", "/a?b?acl", "/a%0d%0aX:%20y"]) {
        const before = reads.length;
        assert.equal((await ask(edge.port, other, { headers: { Host: "archive.invalid" } })).status, 404, other);
        assert.doesNotMatch(reads.slice(before).join(), /\?|bucket\/$|\r/, "No list of the bucket.");
    }
    const gone = await ask(edge.port, `${targets[0]}&v=${generation}-00000000`);
    assert.equal(gone.status, 410);
    assert.match(JSON.parse(gone.body).canonical, /v=/);
});

test("Varnish shares spellings, retries a full replica and answers ranges", async (t) => {
    const requests = [];
    let full = 2;
    const fake = (name) =>
        new Promise((resolve) => {
            const server = http.createServer((request, response) => {
                if (request.url === "/readyz") return response.end();
                requests.push(`${name} ${request.method} ${request.url}`);
                if (request.url.startsWith("/full") && full-- > 0) {
                    response.writeHead(503);
                    return response.end("full");
                }
                response.writeHead(200, { ETag: '"tag"', "Cache-Control": "public, max-age=3600", "Server-Timing": "build;dur=9", "X-Request-Id": "first" });
                response.end("0123456789");
            });
            server.listen(0, "127.0.0.1", () => resolve(server));
            t.after(() => server.close());
            t.after(() => server.closeAllConnections());
        });
    const servers = [await fake("a"), await fake("b"), await fake("c")];
    const pool = servers.map((one) => `127.0.0.1:${one.address().port}`).join(",");
    const edge = await fleet.varnish(t, ["--pool", `${generation}=${pool}`]);
    requests.length = 0;
    const first = await ask(edge.port, "/v1/x.glb?b=2&a=1");
    assert.equal(first.headers["server-timing"], "build;dur=9");
    assert.equal(first.headers["cache-status"], "edge; fwd=miss");
    const second = await ask(edge.port, "/v1/x.glb?a=1&b=2");
    assert.equal(requests.length, 1, "One object for both spellings.");
    assert.match(requests[0], /b=2&a=1$/, "It is sent on as it came.");
    assert.equal(second.headers["cache-status"], "edge; hit");
    assert.equal(second.headers["server-timing"], undefined);
    assert.notEqual(second.headers["x-request-id"], "first");
    assert.equal((await ask(edge.port, "/v1/x.glb?a=1&b=2", { headers: { Range: "bytes=2-4" } })).body.toString(), "234");
    assert.equal((await ask(edge.port, "/v1/x.glb?a=1&b=2", { headers: { "If-None-Match": '"tag"' } })).status, 304);
    requests.length = 0;
    assert.equal((await ask(edge.port, "/full.glb")).status, 200);
    assert.equal(new Set(requests.map((one) => one[0])).size, 3, requests.join("; "));
    requests.length = 0;
    for (let i = 0; i < 30; ++i) assert.equal((await ask(edge.port, "/v1/y", { method: "POST" })).status, 200);
    for (const name of "abc") assert.equal(requests.filter((one) => one.startsWith(name)).length, 10);
    full = 2;
    assert.equal((await ask(edge.port, "/full", { method: "POST", body: "{}" })).status, 200, "Another one makes it.");
    for (const hidden of ["/metrics", "/metrics?x", "/%6detrics", "/readyz", "/sp/metrics", "/sp/a/readyz?x=1"])
        assert.equal((await ask(edge.port, hidden)).status, 404, hidden);
    assert.equal((await ask(edge.port, "/sp/v1/species/metrics")).status, 200);
});

test("Varnish makes room for a large file by dropping many small ones", async (t) => {
    const server = http.createServer((request, response) => {
        if (request.url === "/readyz") return response.end();
        response.writeHead(200, { "Cache-Control": "public, max-age=3600" });
        response.end(Buffer.alloc(request.url.startsWith("/large") ? 8e6 : 2e4, "x"));
    });
    await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
    t.after(() => server.close());
    t.after(() => server.closeAllConnections());
    const edge = await fleet.varnish(t, ["--pool", `${generation}=127.0.0.1:${server.address().port}`], { memory: "16M" });
    await fleet.together(1000, 8, async (i) => assert.equal((await ask(edge.port, `/small${i}`)).status, 200));
    for (let i = 0; i < 3; ++i) assert.equal((await ask(edge.port, `/large${i}`)).body.length, 8e6);
});

test("what a replica that hangs was sent is sent to another, behind each edge", async (t) => {
    let hangs = false;
    const good = (_, response) => response.writeHead(200, { ETag: '"tag"', "Cache-Control": "public, max-age=3600" }).end("good");
    const [hanging, other] = [
        await fleet.fake(t, (request, response) => hangs || good(request, response)),
        await fleet.fake(t, good),
    ];
    const pool = ["--pool", `${generation}=127.0.0.1:${hanging.port},127.0.0.1:${other.port}`];
    const impatient = (text) => {
        assert.match(text, /\b25s/, "as long as a replica may take, and its response");
        return text.replaceAll(/\b25s/g, "2s");
    };
    const edges = [
        await fleet.nginx(t, pool, { edit: impatient }),
        await fleet.varnish(t, pool, { edit: impatient }),
        await fleet.haproxy(t, pool, { edit: impatient }),
    ];
    hangs = true;
    const asked = edges.flatMap(({ port }) => Array.from({ length: 8 }, (_, i) => ask(port, `/v1/${i}.glb`)));
    for (const { status, ms } of await Promise.all(asked)) {
        assert.equal(status, 200);
        assert.ok(ms < 12_000, `${ms} ms`);
    }
    // These two find out that it hangs, after a few checks, and then ask the other one at once.
    for (const { port } of edges.slice(1)) {
        let quick = 0;
        for (let i = 0; i < 40 && quick < 8; ++i) {
            const { status, ms } = await ask(port, `/v1/later${i}.glb`);
            assert.equal(status, 200);
            quick = ms < 1500 ? quick + 1 : 0;
        }
        assert.equal(quick, 8);
    }
});

test("what users write is sent once, even if the replica dies of it, and all else to another one", async (t) => {
    const sent = [];
    const mortal = (request, response) => {
        if (request.method === "GET") return response.end("good");
        request.resume().on("end", () => {
            sent.push(`${request.method} ${request.url}`);
            request.socket.destroy();
        });
    };
    const replicas = [await fleet.fake(t, mortal), await fleet.fake(t, mortal), await fleet.fake(t, mortal)];
    const pool = ["--pool", `${generation}=${fleet.addressesOf(replicas)}`];
    const keys = path.join(fleet.folder(t), "keys");
    writeFileSync(keys, "k1 00112233445566778899aabbccddeeff\n");
    const edges = {
        nginx: await fleet.nginx(t, pool),
        Varnish: await fleet.varnish(t, pool),
        HAProxy: await fleet.haproxy(t, pool),
        "HAProxy with keys": await fleet.haproxy(t, [...pool, "--keys", keys, "--base-path", "/sp"]),
    };
    for (const [name, { port }] of Object.entries(edges)) {
        let total = 0;
        sent.length = 0;
        await ask(port, "/v1/mushrooms.glb", { method: "POST", body: "{}" });
        assert.ok(name.endsWith("keys") || sent.length > 1, `${name}: ${sent}`);
        for (const [method, target, body = "{}"] of [
            ["POST", "/v1/library"],
            ["POST", "/sp/v1/tokens?x=1"],
            ["POST", "/v1/librar%79/a/publish"],
            ["PUT", "/v1/library/a"],
            ["DELETE", "/v1/library/a", ""],
            ["POST", "/v1/library/a/publish", ""],
            ["DELETE", "/v1/tokens/a", ""],
        ].flatMap((one) => [one, one])) {
            // Connections to replicas are open already.
            await Promise.all([1, 2, 3, 4, 5, 6].map((i) => ask(port, `/v1/${Math.random()}/${i}.glb`)));
            sent.length = 0;
            const { status } = await ask(port, target, { method, body });
            // Where the connection to the replica was used before, that to the client may be closed instead.
            assert.ok(status === 502 || status === 0, `${name}: ${method} ${target}: ${status}`);
            assert.ok(sent.length <= 1, `${name}: ${sent}`);
            total += sent.length;
        }
        // nginx leaves out replicas of which it has seen two failures.
        assert.ok(total > 5, `${name}: ${total}`);
    }
});

test("replicas of other threads and instructions send the same bytes", async (t) => {
    const replicas = await Promise.all(
        [["--threads", "1", "--simd", "scalar"], ["--threads", "2"], ["--threads", "2", "--simd", "sse4"]].map((options) =>
            fleet.replica(t, options),
        ),
    );
    for (const target of [
        "/v1/mushrooms/russula_emetica.glb?lod=1&seed=4&texture_size=256",
        "/v1/colonies/hypholoma_fasciculare.glb?count=7&lod=2&texture_size=128",
        "/v1/trees/birch.glb?lod=2&texture_size=128",
        "/v1/leaves/maple.glb?texture_size=128",
        "/v1/worlds/meadow,seed=3/y0/maps/height.png?size=129",
    ]) {
        const hashes = new Set(), tags = new Set();
        for (const one of replicas) {
            const { status, body, headers } = await ask(one.port, target);
            assert.equal(status, 200, target);
            hashes.add(createHash("sha256").update(body).digest("hex"));
            tags.add(headers.etag);
        }
        assert.equal(hashes.size, 1, target);
        assert.equal(tags.size, 1, target);
    }
});

test("HAProxy and a replica agree about signed addresses", async (t) => {
    const own = fleet.folder(t), keys = path.join(own, "keys"), older = path.join(own, "older");
    const first = "k1 00112233445566778899aabbccddeeff00112233445566778899aabbccddeeff\n";
    writeFileSync(older, first);
    writeFileSync(keys, `# The newest signs.\nk2 ffeeddccbbaa99887766554433221100\n\n${first.trim()}`);
    const open = await fleet.replica(t), closed = await fleet.replica(t, ["--sign-keys", keys]);
    const edge = await fleet.haproxy(t, ["--pool", `${generation}=127.0.0.1:${open.port}`, "--keys", keys]);
    const signedBy = (file, target, ...more) =>
        execFileSync(fleet.binary, ["--sign-keys", file, "--sign", target, ...more], { encoding: "utf8" }).trim();
    const signed = (...all) => signedBy(keys, ...all);
    const plain = "/v1/mushrooms/boletus_edulis.glb?lod=3&textures=none", bare = "/v1/mushrooms/boletus_edulis.glb";
    const pinned = (await ask(open.port, plain)).headers["content-location"];
    assert.match(pinned, /v=/);
    const good = signed(plain), soon = signed(plain, "--sign-for", "20"), brief = signed(plain, "--sign-for", "1");
    const long = ["--sign-for", "86400"], signedAt = performance.now();
    const cases = [
        [good, 200],
        [signed(bare), 200],
        [soon, 200],
        [plain, 403],
        [good.replace(/sig=./, "sig=-"), 403],
        [good.replace("lod=3", "lod=2"), 403],
        [good.replace("key=k2", "key=k1"), 403],
        [good.replace("key=k2", "key=k3"), 403],
        [soon.replace(/expires=\d/, "expires=9"), 403],
        [signedBy(older, plain), 200],
        [signedBy(older, plain, ...long), 200],
        [signed(plain, ...long), 200],
        [signed(pinned), 200],
        [signed(pinned, ...long), 200],
        [signed(pinned, "--sign-for", "20"), 200],
        [signed("/v1/mushrooms/none.glb", ...long), 404],
        [signed(`${bare}?lod=9`, ...long), 400],
        [signed(`${bare}?textures=linked`, ...long), 422],
        [signed(`${bare}?textures=link%65d&lod=3`, ...long), 422],
        [signed(`${plain}&v=${generation}-00000000`, ...long), 410],
        ["/v1/mushrooms/schema", 200],
        ["/v1/mushrooms?expires=9999999999", 400],
        [brief, 403],
    ];
    const freshness = ({ headers }) => {
        const text = headers["cache-control"], [age] = text.match(/(?<=max-age=)\d+/) ?? ["0"];
        return { text: text.replace(/\d+/, "N"), age: Number(age) };
    };
    for (const [target, status] of cases) {
        if (target === brief) await fleet.sleep(Math.max(0, signedAt + 2100 - performance.now()));
        for (const headers of [{}, { "If-None-Match": "*" }]) {
            const by = { edge: await ask(edge.port, target, { headers }), replica: await ask(closed.port, target, { headers }) };
            assert.equal(by.edge.status, by.replica.status, target);
            assert.equal(by.edge.status, status === 200 && headers["If-None-Match"] ? 304 : status, `edge: ${target}`);
            if (status === 200) assert.deepEqual(by.edge.body, by.replica.body);
            const [ours, theirs] = [freshness(by.edge), freshness(by.replica)];
            assert.equal(ours.text, theirs.text, target);
            assert.ok(Math.abs(ours.age - theirs.age) <= 1, `${target}: ${ours.age}, ${theirs.age}`);
            if (target === soon) assert.ok(ours.age > 0 && ours.age <= 20, `${ours.age} s`);
            assert.equal(by.edge.headers["content-location"], by.replica.headers["content-location"], target);
            if (status !== 403) continue;
            assert.equal(by.edge.headers["content-type"], "application/problem+json");
            assert.equal(JSON.parse(by.edge.body).status, 403);
        }
    }
});

test("nginx and HAProxy hide what is the operator's, and HAProxy with keys what it does not know, below a base path", async (t) => {
    const keys = path.join(fleet.folder(t), "keys");
    writeFileSync(keys, "k1 00112233445566778899aabbccddeeff00112233445566778899aabbccddeeff\n");
    const one = await fleet.replica(t, ["--base-path", "/sp"]);
    const pool = ["--pool", `${generation}=127.0.0.1:${one.port}`];
    const made = "/sp/v1/mushrooms/boletus_edulis.glb?lod=3&textures=none";
    for (const edge of await Promise.all([fleet.nginx(t, pool), fleet.haproxy(t, pool)])) {
        for (const hidden of ["/metrics", "/sp/metrics", "/sp/readyz?x=1", "/sp/livez"]) assert.equal((await ask(edge.port, hidden)).status, 404, hidden);
        for (const shown of [made, "/sp/v1/species", "/sp/v1/mushrooms/schema"]) assert.equal((await ask(edge.port, shown)).status, 200, shown);
    }
    const known = await fleet.haproxy(t, [...pool, "--keys", keys, "--base-path", "/sp"]), unknown = await fleet.haproxy(t, [...pool, "--keys", keys]);
    const good = execFileSync(fleet.binary, ["--sign-keys", keys, "--sign", made], { encoding: "utf8" }).trim();
    for (const [target, ...wanted] of [
        [made, 403, 403], [made.slice(3), 403, 403], [good, 200, 200], ["/sp/v1", 200, 200], ["/v1/species", 200, 200],
        ["/sp/v1/species", 200, 403], ["/sp/v1/mushrooms/schema", 200, 403], ["/%73p/v1/mushrooms/boletus_edulis.glb", 403, 403],
        ["/sp/v1/library", 404, 403], ["/sp/metrics", 404, 404],
    ])
        assert.deepEqual([(await ask(known.port, target)).status, (await ask(unknown.port, target)).status], wanted, target);
    const { headers, body } = await ask(known.port, "/sp/metrics");
    assert.equal(headers["content-type"], "application/problem+json");
    assert.match(JSON.parse(body).detail, /operator/);
});

test("HAProxy lets nothing through that a replica with keys would not", async (t) => {
    const keys = path.join(fleet.folder(t), "keys");
    writeFileSync(keys, "k1 00112233445566778899aabbccddeeff00112233445566778899aabbccddeeff\n");
    const library = (name) => ["--library", path.join(fleet.folder(t), name)];
    const open = await fleet.replica(t, library("open")), closed = await fleet.replica(t, ["--sign-keys", keys, ...library("closed")]);
    const edge = await fleet.haproxy(t, ["--pool", `${generation}=127.0.0.1:${open.port}`, "--keys", keys]);
    const names = {
        mix: "boletus_edulis", a: "boletus_edulis", b: "amanita_muscaria", preset: "birch", world: "beech", time: "y80d270", map: "height",
        wood: "beech", image: "cap", lod: "0", level: "0", x: "0", y: "0", profile: "web", layer: "fungi", layertime: "y80d270", id: "boletus_edulis",
    };
    const api = JSON.parse((await ask(closed.port, "/openapi.json")).body);
    let compared = 0, refused = 0;
    for (const [template, methods] of Object.entries(api.paths)) {
        if (/^\/(metrics|livez|readyz)$/.test(template)) continue;
        const target = template.replace(/\{(\w+)\}/g, (_, name) => names[name] ?? "none");
        for (const method of Object.keys(methods).filter((one) => /^(get|post|put|delete)$/.test(one))) {
            const options = { method: method.toUpperCase(), ...(method === "get" ? {} : { body: "{}" }) };
            const [by, wanted] = [await ask(edge.port, target, options), await ask(closed.port, target, options)].map(({ status }) => status === 403);
            // Without a body that is complete a replica says what is wrong with it first.
            if (method === "get" || wanted || /^\/v1\/(library|tokens)/.test(target)) assert.equal(by, wanted, `${method} ${target}`);
            ++compared;
            if (wanted) ++refused;
        }
    }
    assert.ok(compared > 80 && refused > 60 && compared - refused > 15, `${refused} of ${compared}`);
    for (const spelling of ["/v1/%6dushrooms/boletus_edulis.glb", "/v%31/mushrooms/boletus_edulis.glb", "/v1/mushrooms%2Fboletus_edulis.glb", "/%761/trees/birch.glb?lod=3"])
        assert.equal((await ask(edge.port, spelling)).status, 403, spelling);
    assert.equal((await ask(edge.port, "/%6detrics")).status, 404);
});

test("HAProxy stands in front of nginx and of Varnish", async (t) => {
    const keys = path.join(fleet.folder(t), "keys");
    writeFileSync(keys, "k1 00112233445566778899aabbccddeeff00112233445566778899aabbccddeeff\n");
    const sign = (target) => execFileSync(fleet.binary, ["--sign-keys", keys, "--sign", target], { encoding: "utf8" }).trim();
    const small = "/v1/mushrooms/boletus_edulis.glb?lod=3&textures=none", signedSmall = sign(small);
    const large = [1, 2, 3].map((k) => sign(`/v1/mushrooms/boletus_edulis.glb?lod=1&texture_size=512&seed=${k}`));
    const edges = await Promise.all(
        ["nginx", "varnish"].map(async (kind) => {
            const one = await fleet.replica(t, ["--client-work", "1", "--client-burst", "5", "--trusted-proxies", "127.0.0.1"]);
            const cache = await fleet[kind](t, ["--pool", `${generation}=127.0.0.1:${one.port}`]);
            return fleet.haproxy(t, ["--edges", `127.0.0.1:${cache.port}`, "--keys", keys]);
        }),
    );
    // Whoever does not pass two checks, one a second, is taken out.
    await fleet.sleep(2500);
    for (const edge of edges) {
        assert.equal((await ask(edge.port, small)).status, 403);
        for (const seen of [/fwd=miss/, /^edge; hit/]) {
            const { status, headers } = await ask(edge.port, signedSmall, { local: "127.0.0.4" });
            assert.equal(status, 200);
            assert.match(headers["cache-status"], seen);
        }
        // Each client has a budget, although two proxies are between.
        const statuses = [];
        for (const [k, local] of [[0, "127.0.0.2"], [1, "127.0.0.2"], [2, "127.0.0.3"]]) statuses.push((await ask(edge.port, large[k], { local })).status);
        assert.deepEqual(statuses, [200, 429, 200]);
    }
});

test("behind nginx each client has its budget, and a forged address changes nothing", async (t) => {
    const one = await fleet.replica(t, [
        ...["--client-work", "1", "--client-burst", "25", "--trusted-proxies", "127.0.0.1"],
    ]);
    const edge = await fleet.nginx(t, ["--pool", `${generation}=127.0.0.1:${one.port}`]);
    const statuses = async (local, headers = {}) => {
        const out = [];
        // One of these empties the budget for so long that no pause makes up for it.
        for (let k = 0; k < 6; ++k)
            out.push((await ask(edge.port, `/v1/mushrooms/boletus_edulis.glb?lod=0&texture_size=1024&seed=${k}&age=0.${local.at(-1)}${headers.extra ?? 1}`, { local, headers })).status);
        return out;
    };
    const first = await statuses("127.0.0.2");
    assert.ok(first.includes(200) && first.at(-1) === 429, first.join());
    const second = await statuses("127.0.0.3");
    assert.equal(second[0], 200, "The second client has a budget of its own.");
    const forged = await statuses("127.0.0.2", { "X-Forwarded-For": "127.0.0.9", extra: 2 });
    assert.deepEqual(new Set(forged), new Set([429]));
});
