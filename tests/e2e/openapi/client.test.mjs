// A typed client, generated from the document when the test runs, compiles under `strict` and calls every operation.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { webcrypto } from "node:crypto";
import { copyFile, mkdir, readFile, rm, symlink, writeFile } from "node:fs/promises";
import path from "node:path";
import test from "node:test";
import { pathToFileURL } from "node:url";
import { documentOf, operationsOf, root, serverUrl } from "./shared.mjs";

const folder = path.join(root, "build/contract");
const modules = path.join(root, "web_viewer/node_modules");

function run(program, ...options) {
    try {
        return execFileSync(process.execPath, [path.join(modules, program), ...options], { cwd: folder, encoding: "utf8", stdio: "pipe" });
    } catch (error) {
        throw new Error(`${program}: ${error.stdout}${error.stderr}`);
    }
}

test("a generated client compiles and calls every operation of the document", async () => {
    const url = serverUrl();
    const document = await documentOf(url);
    await rm(folder, { recursive: true, force: true });
    await mkdir(folder, { recursive: true });
    await symlink(modules, path.join(folder, "node_modules"));
    await writeFile(path.join(folder, "openapi.json"), JSON.stringify(document));
    await copyFile(path.join(root, "tests/e2e/openapi/client.mts"), path.join(folder, "client.mts"));
    run("openapi-typescript/bin/cli.js", "openapi.json", "-o", "api.ts");
    const compilerOptions = {
        strict: true, noUncheckedIndexedAccess: true, exactOptionalPropertyTypes: true, skipLibCheck: true,
        target: "ES2022", lib: ["ES2022", "DOM", "DOM.Iterable"], module: "NodeNext", types: [],
    };
    await writeFile(path.join(folder, "tsconfig.json"), JSON.stringify({ compilerOptions, files: ["client.mts"] }));
    run("typescript/bin/tsc");

    // Browsers and later versions of Node have it; that of Debian bookworm, 18, has not.
    globalThis.crypto ??= webcrypto;
    const { callAll } = await import(pathToFileURL(path.join(folder, "client.mjs")));
    const statuses = await callAll(url, process.env.SPOREPRINT_TOKEN ?? "");
    const uncalled = operationsOf(document).map(({ method, path: at }) => `${method} ${at}`).filter((one) => !statuses.has(one));
    assert.deepEqual(uncalled, [], "operations that no call of the client is of");
    const refused = [...statuses].filter(([, status]) => ![200, 201, 204].includes(status));
    assert.deepEqual(refused, []);
});

test("the types of the client kit for three.js are those of the document", async () => {
    const kit = path.join(root, "web_viewer/clients/three");
    const types = execFileSync(process.execPath, [path.join(kit, "types.mjs"), serverUrl()], { encoding: "utf8" });
    assert.equal(types, await readFile(path.join(kit, "api.ts"), "utf8"), "run types.mjs again");
});
