// Requests generated from the document, right ones and wrong ones: no answer contradicts it.
//   SPOREPRINT_REQUESTS=20000 SPOREPRINT_SEED=1 SPOREPRINT_URL=http://127.0.0.1:8080 node --test tests/e2e/openapi/requests.test.mjs
import assert from "node:assert/strict";
import test from "node:test";
import { Generator, listsOf, random } from "./generator.mjs";
import { documentOf, follow, operationsOf, packages, serverUrl } from "./shared.mjs";

const Ajv = packages("ajv/dist/2020").default;
const count = Number(process.env.SPOREPRINT_REQUESTS ?? 600);
const seed = Number(process.env.SPOREPRINT_SEED ?? 1);
const parallel = 2;

class Judge {
    constructor(document) {
        this.document = document;
        this.ajv = new Ajv({ strict: false, validateFormats: false });
        this.ajv.addSchema(document, "openapi");
        this.compiled = new Map();
    }

    schemaOf(pointer) {
        if (!this.compiled.has(pointer)) this.compiled.set(pointer, this.ajv.compile({ $ref: `openapi#${pointer}` }));
        return this.compiled.get(pointer);
    }

    /** What of an answer contradicts the document, in sentences. */
    errors({ method, path, operation }, request, response, bytes) {
        const { status } = response;
        if (status >= 500) return [`answered ${status}`];
        const declared = operation.responses[status];
        if (!declared) return [`${status} is not declared`];
        const errors = [];
        const answer = follow(this.document, declared);
        for (const [name, header] of Object.entries(answer.headers ?? {})) {
            const { required, schema } = follow(this.document, header);
            const value = response.headers.get(name);
            if (value === null && required) errors.push(`${name} is missing`);
            if (value !== null && schema.type === "integer" && !/^\d+$/.test(value)) errors.push(`${name} is no whole number: ${value}`);
        }
        const type = (response.headers.get("content-type") ?? "").split(";")[0].trim();
        if (!answer.content || method === "HEAD") {
            if (bytes.length) errors.push(`${bytes.length} bytes where none are declared`);
        } else if (!(type in answer.content) && !("*/*" in answer.content)) {
            errors.push(`is ${type}, declared ${Object.keys(answer.content)}`);
        } else if (/[/+]json$/.test(type) && !("*/*" in answer.content)) {
            const segments = declared.$ref ? declared.$ref.slice(2).split("/") : ["paths", path, method.toLowerCase(), "responses", String(status)];
            const pointer = [...segments, "content", type, "schema"].map((one) => `/${encodeURIComponent(one.replaceAll("~", "~0").replaceAll("/", "~1"))}`).join("");
            const valid = this.schemaOf(pointer);
            const json = JSON.parse(new TextDecoder().decode(bytes));
            if (!valid(json)) errors.push(`${this.ajv.errorsText(valid.errors.slice(0, 3))}`);
            if (type === "application/problem+json" && json.status !== status) errors.push(`the problem says ${json.status}`);
        }
        if (request.right && ![200, 201, 206, 304, 412, 416, 422].includes(status)) errors.push(`${status} although nothing of the request is wrong by the document`);
        if (request.wrong && status < 400) errors.push(`${status} although the document forbids it`);
        return errors;
    }
}

test(`${count} requests of seed ${seed} contradict the document nowhere`, { timeout: 3_000_000 }, async (t) => {
    const url = serverUrl();
    const document = await documentOf(url);
    const lists = await listsOf(url, document);
    const operations = operationsOf(document);
    const judge = new Judge(document);
    const dice = random(seed);
    const generator = new Generator(document, lists, dice);
    const seen = new Map(), contradictions = [];
    let begun = 0, slowest = 0;
    const work = async () => {
        while (begun < count && contradictions.length < 20) {
            const one = operations[begun++ % operations.length];
            const request = generator.request(one);
            const { method, target, headers, body } = request;
            const started = performance.now();
            const response = await fetch(url + target, { method, headers, body });
            const bytes = new Uint8Array(await response.arrayBuffer());
            slowest = Math.max(slowest, performance.now() - started);
            const key = `${one.method} ${one.path}`;
            seen.set(key, (seen.get(key) ?? new Set()).add(response.status));
            for (const error of judge.errors(one, request, response, bytes)) {
                const shown = typeof body === "string" ? ` ${body}` : "";
                const said = response.status >= 400 ? ` ${new TextDecoder().decode(bytes)}` : "";
                contradictions.push(`${method} ${target}${shown} ${JSON.stringify(headers)}: ${error}${said}`.slice(0, 2500));
            }
        }
    };
    await Promise.all(Array.from({ length: parallel }, work));
    assert.deepEqual(contradictions, []);
    assert.equal(seen.size, operations.length, "every operation is asked");
    const statuses = new Set([...seen.values()].flatMap((one) => [...one]));
    if (count >= 400) for (const status of [200, 400, 404, 422]) assert.ok(statuses.has(status), `${status} is among the answers`);
    t.diagnostic(`${count} requests, statuses ${[...statuses].sort().join(" ")}, slowest ${Math.round(slowest)} ms`);
});
