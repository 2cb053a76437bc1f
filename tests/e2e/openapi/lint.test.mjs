// The document keeps the rules of a linter, as it is served with and without signing keys.
import assert from "node:assert/strict";
import test from "node:test";
import { documentOf, operationsOf, packages, serverUrl } from "./shared.mjs";

const { createConfig, formatProblems, lintFromString } = packages("@redocly/openapi-core");

async function lint(document) {
    const config = await createConfig({
        extends: ["recommended-strict"],
        rules: {
            "operation-4xx-response": "error",
            "operation-description": "error",
            "operation-tag-defined": "error",
            "tag-description": "error",
            "parameter-description": "error",
            "no-unused-components": "error",
            "path-parameters-defined": "error",
            "security-defined": "error",
        },
    });
    const problems = await lintFromString({ source: JSON.stringify(document), absoluteRef: "openapi.json", config });
    return problems.map((one) => `${one.ruleId} ${one.location?.[0]?.pointer}: ${one.message}`);
}

test("the linter finds a fault where there is one", async () => {
    const document = await documentOf(serverUrl());
    delete document.paths["/v1"].get.operationId;
    document.paths["/v1"].get.responses["200"].content["application/json"].schema = { $ref: "#/components/schemas/nowhere" };
    const faults = await lint(document);
    assert.ok(faults.some((one) => one.startsWith("operation-operationId")), faults.join("\n"));
    assert.ok(faults.some((one) => one.startsWith("no-unresolved-refs")), faults.join("\n"));
});

test("the document has no fault", async () => {
    assert.deepEqual(await lint(await documentOf(serverUrl())), []);
});

test("the document of a server that asks for signatures has no fault, and says so", async () => {
    const plain = await documentOf(serverUrl());
    const signed = await documentOf(serverUrl("SPOREPRINT_SIGNED_URL"));
    assert.deepEqual(await lint(signed), []);
    let protectedOnes = 0;
    for (const { method, path, operation } of operationsOf(signed)) {
        if (operation.security?.some((one) => "token" in one)) continue; // those of the library need a token instead
        const names = (operation.parameters ?? []).map((one) => one.name);
        const isProtected = operation.security?.length > 0;
        const what = `${method} ${path}`;
        assert.equal("403" in operation.responses, isProtected, what);
        for (const name of ["key", "expires", "sig"]) assert.equal(names.includes(name), isProtected, what);
        protectedOnes += isProtected ? 1 : 0;
        if (method === "HEAD" || path.includes("{")) continue;
        const answer = await fetch(serverUrl("SPOREPRINT_SIGNED_URL") + path, { method });
        assert.equal(answer.status === 403, isProtected, `${what} answers ${answer.status}`);
    }
    assert.ok(protectedOnes > 20);
    assert.ok(signed.components.securitySchemes.signature);
    assert.equal(plain.components.securitySchemes.signature, undefined);
    for (const { path, operation } of operationsOf(plain)) {
        const needsToken = /^\/v1\/(library|tokens)/.test(path);
        assert.equal("403" in operation.responses, needsToken, path);
        // Drafts need one wherever a species can be named; what is public needs none.
        const isOptional = (operation.security ?? []).some((one) => Object.keys(one).length === 0);
        assert.equal("security" in operation, needsToken || "401" in operation.responses, path);
        if (!needsToken && "security" in operation) assert.ok(isOptional, path);
    }
});
