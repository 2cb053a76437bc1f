// Processes of a fleet on this machine: replicas, edges, and clients that count what they receive.
import { execFileSync, spawn, spawnSync } from "node:child_process";
import { chmodSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import http from "node:http";
import net from "node:net";
import os from "node:os";
import path from "node:path";

export { draws, zipf } from "../bench/fleet_simulation.mjs";

export const binary = path.resolve("build/release/server/sporeprint");

/** The version of the generator, by which pools are named. */
export const generation = readFileSync("core/version.h", "utf8").match(/generator_version = (\d+)/)[1];

const running = new Set();
process.on("exit", () => running.forEach((one) => one.kill()));

/** Starts a program; its output is in `output`. */
export function start(program, args, env = process.env) {
    const child = spawn(program, args, { env, stdio: ["ignore", "pipe", "pipe"] });
    child.output = "";
    child.stdout.on("data", (data) => (child.output += data));
    child.stderr.on("data", (data) => (child.output += data));
    child.ended = new Promise((resolve) => child.on("exit", resolve));
    running.add(child);
    child.on("exit", () => running.delete(child));
    return child;
}

export async function stop(child, signal = "SIGTERM") {
    child.kill(signal);
    await child.ended;
}

/** Runs a program to its end, while servers of this process go on. */
export async function ended(program, args, env = process.env) {
    const child = start(program, args, env);
    const status = await child.ended;
    return { status, output: child.output };
}

export function folder(t) {
    const made = mkdtempSync(path.join(os.tmpdir(), "sporeprint_edge_"));
    chmodSync(made, 0o755); // Varnish reads its file as another user.
    t.after(() => rmSync(made, { recursive: true, force: true }));
    return made;
}

export function freePort() {
    return new Promise((resolve) => {
        const server = net.createServer().listen(0, "127.0.0.1", () => {
            const { port } = server.address();
            server.close(() => resolve(port));
        });
    });
}

export const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** Sends a request; resolves to status, headers and body, or to status 0 if there is no response. */
export function ask(port, target, { method = "GET", headers = {}, body = "", agent, local } = {}) {
    return new Promise((resolve) => {
        const begun = performance.now();
        const request = http.request(
            { host: "127.0.0.1", port, path: target, method, headers, agent, localAddress: local, timeout: 30_000 },
            (response) => {
                const parts = [];
                response.on("data", (part) => parts.push(part));
                const end = (status) =>
                    resolve({
                        status,
                        headers: response.headers,
                        body: Buffer.concat(parts),
                        ms: performance.now() - begun,
                    });
                response.on("end", () => end(response.statusCode));
                response.on("error", () => end(0));
            },
        );
        request.on("timeout", () => request.destroy());
        request.on("error", () => resolve({ status: 0, headers: {}, body: Buffer.alloc(0), ms: performance.now() - begun }));
        request.end(body);
    });
}

/** Waits until a port responds to a path with a status below 500. */
export async function ready(port, target, child) {
    for (let i = 0; i < 300; ++i) {
        const { status } = await ask(port, target);
        if (status > 0 && status < 500) return;
        if (child.exitCode !== null) break;
        await sleep(50);
    }
    throw new Error(`nothing responds at port ${port}: ${child.output}`);
}

/** Starts a replica on a port of its own, or on a given one. */
export async function replica(t, options = [], port = 0) {
    const own = port || (await freePort());
    const child = start(binary, ["--port", String(own), "--log-level", "off", ...options]);
    child.port = own;
    t.after(() => stop(child, "SIGKILL"));
    await ready(own, "/readyz", child);
    return child;
}

/** Returns the configuration that server/edge/configure prints. */
export function configured(edge, options) {
    const made = spawnSync("server/edge/configure", [edge, ...options], { encoding: "utf8" });
    if (made.status !== 0) throw new Error(made.stderr);
    return made.stdout;
}

/** Writes the configuration that server/edge/configure prints, after `edit`, to a file. */
export function configuredIn(file, edge, options, edit = (text) => text) {
    writeFileSync(file, edit(configured(edge, options)));
    return file;
}

export const addressesOf = (replicas) => replicas.map((one) => `127.0.0.1:${one.port}`).join(",");

/** Starts nginx with a configuration that reload() can replace. */
export async function nginx(t, options, { edit } = {}) {
    const own = folder(t), port = await freePort(), file = path.join(own, "nginx.conf");
    const all = (more) => ["--listen", `127.0.0.1:${port}`, "--run", own, "--cache", path.join(own, "cache"), ...more];
    configuredIn(file, "nginx", all(options), edit);
    const user = process.getuid() === 0 ? "user root;" : "";
    const child = start("nginx", ["-c", file, "-e", "stderr", "-g", `daemon off; ${user}`]);
    child.port = port;
    child.reload = async (more) => {
        configuredIn(file, "nginx", all(more), edit);
        execFileSync("nginx", ["-c", file, "-e", "stderr", "-s", "reload"]);
        await sleep(300);
    };
    t.after(() => stop(child, "SIGQUIT"));
    await ready(port, "/v1", child);
    return child;
}

export async function varnish(t, options, { memory = "64M", edit } = {}) {
    const own = folder(t), port = await freePort();
    const file = configuredIn(path.join(own, "edge.vcl"), "varnish", options, edit);
    const child = start("varnishd", [
        ...["-F", "-f", file, "-a", `127.0.0.1:${port}`, "-n", path.join(own, "work"), "-s", `malloc,${memory}`],
        ...["-p", "http_gzip_support=off", "-p", "nuke_limit=100000", "-T", "none", "-j", "none"],
    ]);
    child.port = port;
    t.after(() => stop(child));
    await ready(port, "/v1", child);
    return child;
}

export async function haproxy(t, options, { edit } = {}) {
    const own = folder(t), port = await freePort();
    const file = configuredIn(path.join(own, "haproxy.cfg"), "haproxy", ["--listen", `127.0.0.1:${port}`, ...options], edit);
    const child = start("haproxy", ["-db", "-f", file]);
    child.port = port;
    t.after(() => stop(child));
    await ready(port, "/v1", child);
    return child;
}

/** Starts a server in the place of a replica, or of something else, which responds as `respond` says; resolves to its port and close(). */
export function fake(t, respond) {
    const server = http.createServer(respond);
    const close = () => {
        server.close();
        server.closeAllConnections();
    };
    t.after(close);
    return new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve({ port: server.address().port, close })));
}

/** Returns the sum of a metric over its labels. */
export async function metric(port, name) {
    const { body } = await ask(port, "/metrics");
    let sum = 0;
    for (const line of body.toString().split("\n"))
        if ([`${name}{`, `${name} `].some((start) => line.startsWith(start))) sum += Number(line.split(" ").at(-1));
    return sum;
}

/** Files that a replica has made. */
export const made = (port) => metric(port, "sporeprint_generated_total");

/** Runs `call` for each of so many numbers, some at once. */
export async function together(count, atOnce, call) {
    let next = 0;
    await Promise.all(
        Array.from({ length: atOnce }, async () => {
            while (next < count) await call(next++);
        }),
    );
}

export const textOf = (file) => readFileSync(file, "utf8");
