// What the tests of the OpenAPI document share: the servers under test, the document, its operations.
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
export const root = path.resolve(here, "../../..");

/** The page's room holds the packages; tests have none of their own. */
export const packages = createRequire(path.join(root, "web_viewer/package.json"));

/** Address of the running server, without a slash at its end; `SPOREPRINT_SIGNED_URL` is that of one with signing keys. */
export function serverUrl(variable = "SPOREPRINT_URL") {
    const url = process.env[variable];
    if (!url) throw new Error(`${variable} is not set: start a server and name it, or run tests/e2e/openapi/run`);
    return url.replace(/\/+$/, "");
}

export async function documentOf(url) {
    const response = await fetch(`${url}/openapi.json`);
    if (!response.ok) throw new Error(`/openapi.json answered ${response.status}`);
    return response.json();
}

/** Where "#/components/…" leads. */
export function follow(document, node) {
    let found = node;
    while (found?.$ref) {
        found = found.$ref.slice(2).split("/").reduce((at, key) => at[key.replaceAll("~1", "/").replaceAll("~0", "~")], document);
    }
    return found;
}

/** Every operation of a document: { method: "GET", path, operation }. */
export function operationsOf(document) {
    return Object.entries(document.paths).flatMap(([path_, item]) =>
        Object.entries(item).map(([verb, operation]) => ({ method: verb.toUpperCase(), path: path_, operation })));
}
