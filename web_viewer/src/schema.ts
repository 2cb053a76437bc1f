// Turns the JSON Schema of the query parameters, which the service serves, into one flat list of
// fields. The rest of the page knows parameters from this list only.

export type Value = number | string | boolean;

export interface Schema {
    type?: string | string[];
    format?: string;
    title?: string;
    description?: string;
    default?: Value;
    minimum?: number;
    maximum?: number;
    enum?: Value[];
    const?: Value;
    properties?: Record<string, Schema>;
    anyOf?: Schema[];
    oneOf?: Schema[];
    allOf?: Schema[];
    $ref?: string;
    $defs?: Record<string, Schema>;
    "x-unit"?: string;
    "x-default-from"?: string;
    "x-group"?: string;
    "x-step"?: number;
}

export type Kind = "number" | "select" | "checkbox" | "color" | "text";

export interface Field {
    /** Query name, with dots if nested: "weathering.cracks". */
    name: string;
    label: string;
    kind: Kind;
    integer: boolean;
    min: number | undefined;
    max: number | undefined;
    /** Step of the slider: 1, 2 or 5 times a power of ten. */
    step: number;
    options: Value[];
    /** Default of the server; undefined if the default is that of a species or preset. */
    fallback: Value | undefined;
    /** "species" or "preset" if these have a value of their own; "" if there is a fallback. */
    owner: string;
    unit: string;
    description: string;
    /** Key of the group, "" for the top level. */
    group: string;
}

export interface Group {
    key: string;
    label: string;
    description: string;
    fields: Field[];
}

/** Query parameters without a control. */
const hidden = new Set(["v"]);

/** Returns the largest of 1, 2 and 5 times a power of ten that is not above `most`. */
export function niceStep(most: number): number {
    const power = 10 ** Math.floor(Math.log10(most));
    const step = [5, 2, 1].map((digit) => digit * power).find((size) => size <= most * 1.0000001);
    return Number((step ?? power).toPrecision(1));
}

/** Returns a name as a label: "bend_deg" -> "Bend", "texture_size" -> "Texture size". */
export function words(name: string): string {
    const text = name
        .replace(/_(deg|m|mm|px)$/, "")
        .replaceAll("_", " ")
        .replace(/\blod(s?)\b/, "LOD$1");
    return text.charAt(0).toUpperCase() + text.slice(1);
}

/** Returns the sign of a unit of the schema: "deg" -> "°". */
export function unitSign(unit: string): string {
    return (
        { deg: "°", degree: "°", degrees: "°", pixel: "px", pixels: "px", texels: "px" }[unit] ??
        unit
    );
}

function resolved(schema: Schema, root: Schema): Schema {
    let found = schema;
    for (let hops = 0; found.$ref !== undefined && hops < 16; ++hops) {
        let target: unknown = root;
        for (const part of found.$ref.replace(/^#\/?/, "").split("/").filter(Boolean)) {
            target = (target as Record<string, unknown> | undefined)?.[decodeURIComponent(part)];
        }
        const { $ref: _, ...rest } = found;
        found = { ...(target as Schema), ...rest };
    }
    const choices = found.anyOf ?? found.oneOf;
    if (choices && !found.type && !found.enum) {
        if (choices.every((choice) => choice.const !== undefined)) {
            return { ...found, enum: choices.map((choice) => choice.const as Value) };
        }
        const real = choices.filter((choice) => choice.type !== "null");
        if (real.length === 1 && real[0]) {
            const { anyOf: _, oneOf: __, ...rest } = found;
            return resolved({ ...real[0], ...rest }, root);
        }
    }
    return found;
}

function fieldOf(
    name: string,
    last: string,
    group: string,
    schema: Schema,
    owner: string,
): Field | undefined {
    const types = Array.isArray(schema.type) ? schema.type : [schema.type];
    const field: Field = {
        name,
        label: words(schema.title ?? last),
        kind: "text",
        integer: types.includes("integer"),
        min: schema.minimum,
        max: schema.maximum,
        step: 1,
        options: [],
        fallback: owner ? undefined : schema.default,
        owner,
        unit: unitSign(schema["x-unit"] ?? ""),
        description: schema.description ?? "",
        group,
    };
    if (schema.enum) {
        field.kind = "select";
        field.options = schema.enum.filter((option) => option !== null);
    } else if (types.includes("boolean")) {
        field.kind = "checkbox";
    } else if (types.includes("integer") || types.includes("number")) {
        field.kind = "number";
        if (!field.integer) {
            const span =
                field.min !== undefined && field.max !== undefined ? field.max - field.min : 1;
            field.step = schema["x-step"] ?? niceStep(span / 180);
        }
    } else if (schema.format === "color") {
        field.kind = "color";
    } else if (!types.includes("string")) {
        return undefined;
    }
    return field;
}

/** Returns the properties of an object in order, followed by those of its alternatives. A constant
 *  that differs between alternatives, such as `form`, becomes one list of names. */
function propertiesOf(schema: Schema, root: Schema): Map<string, Schema> {
    const found = new Map<string, Schema>();
    const take = (part: Schema): void => {
        for (const [name, raw] of Object.entries(part.properties ?? {})) {
            const sub = resolved(raw, root);
            const before = found.get(name);
            const names = [
                ...(before?.enum ?? []),
                ...(sub.const === undefined ? [] : [sub.const]),
            ];
            if (sub.const !== undefined)
                found.set(name, {
                    ...before,
                    ...sub,
                    const: undefined,
                    enum: [...new Set(names)],
                } as Schema);
            else if (!before) found.set(name, sub);
        }
        for (const choice of [
            ...(part.oneOf ?? []),
            ...(part.anyOf ?? []),
            ...(part.allOf ?? []),
        ]) {
            take(resolved(choice, root));
        }
    };
    take(schema);
    return found;
}

/** Returns all parameters in schema order; nested objects become dotted names and groups of their
 *  own. `whole` names the group of those at the top level. */
export function groupsOf(root: Schema, whole = "individual"): Group[] {
    const groups = new Map<string, Group>();
    const groupAt = (key: string, label: string, description = ""): Group => {
        const made = groups.get(key) ?? { key, label, description, fields: [] };
        groups.set(key, made);
        return made;
    };
    const walk = (schema: Schema, path: string[], owner: string): void => {
        for (const [key, sub] of propertiesOf(schema, root)) {
            const at = [...path, ...key.split(".")];
            const own = owner || (sub["x-default-from"] ?? "");
            if (propertiesOf(sub, root).size > 0) {
                const groupKey = at.join(".");
                groupAt(groupKey, words(sub.title ?? at.join(" · ")), sub.description);
                walk(sub, at, own);
                continue;
            }
            const name = at.join(".");
            if (hidden.has(name)) continue;
            const groupKey = at.slice(0, -1).join(".") || (sub["x-group"] ?? fileGroup(name));
            const field = fieldOf(name, at.at(-1) ?? name, groupKey, sub, own);
            if (field) groupAt(groupKey, words(groupKey || whole)).fields.push(field);
        }
    };
    walk(resolved(root, root), [], "");
    return [...groups.values()].filter((group) => group.fields.length > 0);
}

/** Returns the group of a top-level parameter that is about the file, "" for all others. */
function fileGroup(name: string): string {
    return /^(lod|triangles|textures?|texture_size|animation|frames|instancing)$/.test(name) ? "file" : "";
}

/** Returns the value of a dotted name in nested `effective` values, undefined if there is none. */
export function valueAt(effective: unknown, name: string): Value | undefined {
    let found: unknown = effective;
    for (const part of name.split(".")) {
        if (typeof found !== "object" || found === null) return undefined;
        found = (found as Record<string, unknown>)[part];
    }
    return typeof found === "number" || typeof found === "string" || typeof found === "boolean"
        ? found
        : undefined;
}

/** Returns what is wrong with a value, in words; undefined if it is valid. */
export function validationError(field: Field, value: Value): string | undefined {
    if (field.kind === "number") {
        if (typeof value !== "number" || !Number.isFinite(value)) return "needs a number";
        if (field.integer && !Number.isInteger(value)) return "needs a whole number";
        if (field.min !== undefined && value < field.min) return `is below ${field.min}`;
        if (field.max !== undefined && value > field.max) return `is above ${field.max}`;
    }
    if (field.kind === "select" && !field.options.includes(value)) {
        return `is none of ${field.options.join(", ")}`;
    }
    return undefined;
}

/** Parses the text of a query as a value of the field; returns undefined if it cannot be one. */
export function parsed(field: Field, text: string): Value | undefined {
    if (field.kind === "number") {
        return /^-?\d+(\.\d+)?([eE][+-]?\d+)?$/.test(text) ? Number(text) : undefined;
    }
    if (field.kind === "checkbox")
        return text === "true" ? true : text === "false" ? false : undefined;
    if (field.kind === "select") return field.options.find((option) => String(option) === text);
    return text;
}
