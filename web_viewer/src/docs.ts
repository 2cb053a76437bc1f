// The API page: reads openapi.json and shows routes, parameters, ranges, units and examples.
import "./docs.css";
import { make } from "./dom";
import { getJson, RequestFailed } from "./http";
import { unitSign } from "./schema";

interface Node_ {
    $ref?: string;
    type?: string | string[];
    title?: string;
    description?: string;
    default?: unknown;
    const?: unknown;
    enum?: unknown[];
    minimum?: number;
    maximum?: number;
    maxItems?: number;
    pattern?: string;
    example?: unknown;
    examples?: unknown;
    properties?: Record<string, Node_>;
    required?: string[];
    items?: Node_;
    additionalProperties?: boolean | Node_;
    oneOf?: Node_[];
    anyOf?: Node_[];
    allOf?: Node_[];
    [extension: `x-${string}`]: unknown;
}

interface Parameter {
    $ref?: string;
    name: string;
    in: string;
    required?: boolean;
    description?: string;
    schema?: Node_;
    example?: unknown;
    examples?: Record<string, { value?: unknown }>;
}

interface Content {
    schema?: Node_;
    example?: unknown;
    examples?: Record<string, { summary?: string; value?: unknown }>;
}

interface Operation {
    $ref?: string;
    summary?: string;
    description?: string;
    tags?: string[];
    parameters?: Parameter[];
    requestBody?: { $ref?: string; description?: string; content?: Record<string, Content> };
    responses?: Record<
        string,
        { $ref?: string; description?: string; content?: Record<string, Content> }
    >;
}

type PathItem = { parameters?: Parameter[] } & Partial<Record<string, Operation>>;

interface Document_ {
    info?: { title?: string; version?: string; description?: string; summary?: string };
    paths?: Record<string, PathItem>;
}

const verbs = ["get", "post", "put", "patch", "delete", "options"]; // HEAD agrees with GET
const deepest = 5;

let root: Document_ = {};

/** Resolves a reference such as "#/components/…". */
function follow<T extends { $ref?: string }>(node: T): T {
    let found = node;
    for (let hops = 0; found.$ref?.startsWith("#/") && hops < 16; ++hops) {
        let target: unknown = root;
        for (const part of found.$ref.slice(2).split("/")) {
            const name = decodeURIComponent(part).replaceAll("~1", "/").replaceAll("~0", "~");
            target = (target as Record<string, unknown> | undefined)?.[name];
        }
        const { $ref: _, ...rest } = found;
        found = { ...(target as T), ...rest };
    }
    return found;
}

function shortText(value: unknown): string {
    return typeof value === "string" ? value : JSON.stringify(value);
}

/** Returns a type and its range as text: "number, 0 to 1", "one of a, b". */
function typeText(schema: Node_): string {
    const types = (Array.isArray(schema.type) ? schema.type : [schema.type])
        .filter(Boolean)
        .join(" or ");
    if (schema.const !== undefined) return `always ${shortText(schema.const)}`;
    if (schema.enum) return `one of ${schema.enum.map(shortText).join(", ")}`;
    const { minimum, maximum } = schema;
    const range =
        minimum !== undefined && maximum !== undefined
            ? `${minimum} to ${maximum}`
            : minimum !== undefined
              ? `from ${minimum}`
              : maximum !== undefined
                ? `up to ${maximum}`
                : "";
    const items = schema.items ? ` of ${typeText(follow(schema.items))}` : "";
    const most = schema.maxItems === undefined ? "" : `, at most ${schema.maxItems}`;
    return [types + items + most, range].filter(Boolean).join(", ");
}

interface Row {
    name: string;
    place: string;
    type: string;
    fallback: string;
    unit: string;
    about: string;
    example: string;
    required: boolean;
}

function rowsOf(
    schema: Node_,
    name: string,
    place: string,
    required: boolean,
    about = "",
    example: unknown = undefined,
    depth = 0,
): Row[] {
    const found = follow(schema);
    const own = found["x-default-from"] !== undefined;
    const given =
        example ?? found.example ?? (Array.isArray(found.examples) ? found.examples[0] : undefined);
    const parts = [
        found,
        ...(found.oneOf ?? []),
        ...(found.anyOf ?? []),
        ...(found.allOf ?? []),
    ].map(follow);
    const children =
        depth < deepest
            ? parts.flatMap((part) =>
                  Object.entries(part.properties ?? {}).map(([key, sub]) => ({
                      key,
                      sub,
                      required: part.required?.includes(key) ?? false,
                  })),
              )
            : [];
    const rows: Row[] = [];
    if (name !== "" && (children.length === 0 || about || found.description)) {
        rows.push({
            name,
            place,
            type: typeText(found),
            fallback:
                found.default !== undefined
                    ? shortText(found.default)
                    : own
                      ? "the species’ own"
                      : "",
            unit: unitSign(String(found["x-unit"] ?? "")),
            about: about || found.description || found.title || "",
            example: given === undefined ? "" : shortText(given),
            required,
        });
    }
    const seen = new Set<string>();
    for (const { key, sub, required: needed } of children) {
        if (seen.has(key)) continue;
        seen.add(key);
        rows.push(
            ...rowsOf(sub, name ? `${name}.${key}` : key, place, needed, "", undefined, depth + 1),
        );
    }
    const items = found.items && follow(found.items);
    if (items?.properties && depth < deepest)
        rows.push(
            ...rowsOf(
                { properties: items.properties },
                `${name}[]`,
                place,
                false,
                "",
                undefined,
                depth + 1,
            ),
        );
    return rows;
}

function table(rows: Row[]): HTMLElement {
    const columns: [string, (row: Row) => Node | string][] = [
        [
            "Name",
            (row) =>
                make(
                    "span",
                    {},
                    make("code", {}, row.name),
                    row.required
                        ? make("span", { class: "required", title: "required" }, " *")
                        : "",
                ),
        ],
        ["In", (row) => row.place],
        ["Type and range", (row) => row.type],
        ["Unit", (row) => row.unit],
        ["Default", (row) => row.fallback],
        ["Example", (row) => (row.example ? make("code", {}, row.example) : "")],
        ["Meaning", (row) => row.about],
    ];
    const used = columns.filter(([, cell]) => rows.some((row) => cell(row) !== ""));
    const cellsOf = (row: Row): HTMLElement[] => used.map(([, cell]) => make("td", {}, cell(row)));
    return make(
        "div",
        { class: "scroll", tabindex: 0, role: "region", "aria-label": "Parameters" },
        make(
            "table",
            {},
            make(
                "thead",
                {},
                make("tr", {}, ...used.map(([name]) => make("th", { scope: "col" }, name))),
            ),
            make("tbody", {}, ...rows.map((row) => make("tr", {}, ...cellsOf(row)))),
        ),
    );
}

function exampleOf(parameter: Parameter): unknown {
    const named = Object.values(parameter.examples ?? {})[0]?.value;
    const schema = parameter.schema ? follow(parameter.schema) : {};
    return (
        parameter.example ??
        named ??
        schema.example ??
        (Array.isArray(schema.examples) ? schema.examples[0] : undefined) ??
        schema.enum?.[0]
    );
}

/** Returns a curl command, ready to run if the description has examples for all path parameters. */
function curlOf(
    verb: string,
    path: string,
    parameters: Parameter[],
    body: [string, Content] | undefined,
): string {
    const filled = path.replace(/\{(\w+)\}/g, (all, name: string) => {
        const example = parameters.find((one) => one.in === "path" && one.name === name);
        const value = example && exampleOf(example);
        return value === undefined ? all : String(value);
    });
    const query = parameters
        .filter((one) => one.in === "query" && (one.example !== undefined || one.examples))
        .map((one) => `${one.name}=${encodeURIComponent(String(exampleOf(one)))}`)
        .join("&");
    const server = new URL(".", location.href).href.replace(/\/$/, "");
    const address = `${server}${filled}${query ? `?${query}` : ""}`;
    const parts = ["curl"];
    if (/\.(glb|jpg|png)$/.test(path)) parts.push(`-o out${path.slice(path.lastIndexOf("."))}`);
    if (verb !== "get") parts.push(`-X ${verb.toUpperCase()}`);
    if (body) {
        const [type, content] = body;
        const example = content.example ?? Object.values(content.examples ?? {})[0]?.value;
        parts.push(`-H 'Content-Type: ${type}'`);
        if (example !== undefined && type.includes("json"))
            parts.push(`-d '${JSON.stringify(example)}'`);
        else parts.push("--data-binary @file");
    }
    return `${parts.join(" ")} '${address}'`;
}

function example(text: string): HTMLElement {
    const button = make("button", { type: "button" }, "Copy");
    button.addEventListener("click", () => {
        void navigator.clipboard?.writeText(text).then(
            () => (button.textContent = "Copied"),
            () => undefined,
        );
    });
    return make("div", { class: "example" }, make("pre", { tabindex: 0 }, text), button);
}

function paragraphs(text: string | undefined): HTMLElement[] {
    return (text ?? "")
        .split(/\n\s*\n/)
        .filter(Boolean)
        .map((part) => make("p", {}, part));
}

function routeSection(
    id: string,
    verb: string,
    path: string,
    item: PathItem,
    operation: Operation,
): HTMLElement {
    const parameters = [...(item.parameters ?? []), ...(operation.parameters ?? [])].map(follow);
    const body = operation.requestBody && follow(operation.requestBody);
    const bodies = Object.entries(body?.content ?? {});
    const section = make(
        "section",
        { class: "route", id },
        make("h2", {}, make("span", { class: `verb ${verb}` }, verb.toUpperCase()), path),
        ...paragraphs(operation.summary),
        ...paragraphs(operation.description === operation.summary ? "" : operation.description),
    );
    if (parameters.length > 0) {
        const rows = parameters.flatMap((one) =>
            rowsOf(
                one.schema ?? {},
                one.name,
                one.in,
                one.required ?? false,
                one.description,
                one.example ?? Object.values(one.examples ?? {})[0]?.value,
            ),
        );
        section.append(make("h3", {}, "Parameters"), table(rows));
    }
    for (const [type, content] of bodies) {
        section.append(make("h3", {}, `Body: ${type}`), ...paragraphs(body?.description));
        const rows = content.schema ? rowsOf(content.schema, "", "body", false) : [];
        if (rows.length > 0) section.append(table(rows));
    }
    section.append(make("h3", {}, "Example"), example(curlOf(verb, path, parameters, bodies[0])));
    const responses = Object.entries(operation.responses ?? {}).map(([status, raw]) => {
        const response = follow(raw);
        return make(
            "tr",
            {},
            make("td", {}, make("code", {}, status)),
            make("td", {}, Object.keys(response.content ?? {}).join(", ")),
            make("td", {}, response.description ?? ""),
        );
    });
    if (responses.length > 0) {
        section.append(
            make(
                "details",
                {},
                make(
                    "summary",
                    {},
                    `Responses: ${Object.keys(operation.responses ?? {}).join(", ")}`,
                ),
                make(
                    "div",
                    { class: "scroll" },
                    make(
                        "table",
                        {},
                        make(
                            "thead",
                            {},
                            make(
                                "tr",
                                {},
                                ...["Status", "Type", "Meaning"].map((name) =>
                                    make("th", { scope: "col" }, name),
                                ),
                            ),
                        ),
                        make("tbody", {}, ...responses),
                    ),
                ),
            ),
        );
    }
    return section;
}

async function open(): Promise<void> {
    root = await getJson<Document_>("openapi.json");
    const main = document.getElementById("content");
    const list = document.getElementById("routes");
    if (!main || !list) return;
    const { title = "API", version = "", description, summary } = root.info ?? {};
    const sections: HTMLElement[] = [];
    const groups = new Map<string, HTMLElement[]>();
    // Product routes come first, operations last.
    const isProduct = (path: string): boolean => path.startsWith("/v1/");
    const paths = Object.entries(root.paths ?? {}).sort(
        ([a], [b]) => Number(isProduct(b)) - Number(isProduct(a)),
    );
    for (const [path, item] of paths) {
        for (const verb of verbs) {
            const operation = item[verb];
            if (!operation) continue;
            const id = `${verb}${path.replace(/[^a-z0-9]+/gi, "-")}`;
            sections.push(routeSection(id, verb, path, item, operation));
            const tag =
                operation.tags?.[0] ??
                (isProduct(path) ? path.split("/")[2]?.replace(/\W.*$/, "") : undefined) ??
                "service";
            const link = make(
                "a",
                { href: `#${id}`, title: operation.summary },
                make("span", { class: `verb ${verb}` }, verb.toUpperCase()),
                path,
            );
            groups.set(tag, [...(groups.get(tag) ?? []), link]);
        }
    }
    list.append(
        ...[...groups].flatMap(([tag, links]) => [
            make("h2", {}, tag.charAt(0).toUpperCase() + tag.slice(1)),
            ...links,
        ]),
    );
    main.replaceChildren(
        make("h2", {}, `${title} ${version}`.trim()),
        make("p", { class: "lead" }, [summary, description].filter(Boolean).join("\n\n")),
        ...sections,
        make("footer", {}, "Sporeprint is for pictures, never for identifying mushrooms to eat."),
    );
    document.documentElement.dataset["docs"] = "complete";
    if (location.hash) document.getElementById(location.hash.slice(1))?.scrollIntoView();
}

open().catch((error: unknown) => {
    const text =
        error instanceof RequestFailed
            ? error.message
            : `The description could not be shown: ${String(error)}`;
    document
        .getElementById("content")
        ?.replaceChildren(make("p", { class: "problem", role: "alert" }, text));
});
