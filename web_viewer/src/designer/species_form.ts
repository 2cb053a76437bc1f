// The form for all else of a species' document, made from its schema by the same controls as the
// parameters of the page: which fields there are, and their values as controls have them.
import { groupsOf, words, type Field, type Group, type Schema, type Value } from "../schema";
import type { ControlledValues } from "../controls";
import { atPointer, type Details, type Json } from "./details";
import type { DocumentSchema } from "./schemas";

/** Members of a model that other parts of the page edit, and the form of its shape, which stays. */
const editedElsewhere = new Set(["silhouette", "axis", "form", "image", "stages"]);

/** Members of a model that are equal in all stages, because stages blend. */
const equalInAllStages =
    /^((warts|scales|volva)\.(count|from|to|elongation|fray|unevenness)|spines\.(count|from|to)|peridioles\.count|receptacle\.meshes|surface\.hymenium\.pattern|surface\.(cap|stem)\.skin\.kind|ramification\..*|limbs\.trunks)$/;

export function isEqualInAllStages(name: string): boolean {
    return equalInAllStages.test(name);
}

/** How a list stands in a text field: what parts it, and what its items are. */
interface ListStyle {
    items: DocumentSchema;
    fewest: number;
    most: number;
}

/** What the form needs beside its fields: lists by the name of their field. */
export interface FormSchema {
    groups: Group[];
    fields: Field[];
    lists: ReadonlyMap<string, ListStyle>;
    /** Most letters of texts, by name. */
    lengths: ReadonlyMap<string, number>;
    /** Values that a document has where it states none, by name. */
    defaults: (document: unknown) => Record<string, unknown>;
}

function isColour({ format }: DocumentSchema): boolean {
    return format === "color";
}

/** Returns the schema as one of parameters: lists are texts, and colours of surfaces are left out. */
function plain(
    schema: DocumentSchema,
    path: readonly string[],
    lists: Map<string, ListStyle>,
    withColours: boolean,
): Schema {
    const { properties, items, ...rest } = schema;
    if (items) {
        const fewest = schema.minItems ?? 0;
        const most = schema.maxItems ?? Infinity;
        lists.set(path.join("."), { items, fewest, most });
        return {
            type: "string",
            description: `${rest.description ?? ""} ${listWords({ items, fewest, most })}`.trim(),
            ...(rest["x-unit"] ? { "x-unit": rest["x-unit"] } : {}),
        };
    }
    const of = (parts: readonly DocumentSchema[]): Schema[] =>
        parts.map((part) => plain(part, path, lists, withColours));
    const made = { ...rest } as Schema;
    for (const choice of ["oneOf", "anyOf", "allOf"] as const) {
        const parts = schema[choice] as DocumentSchema[] | undefined;
        if (parts) made[choice] = of(parts);
    }
    if (!properties) return made;
    const members = Object.entries(properties).filter(([name, sub]) => {
        if (editedElsewhere.has(name) && path[0] !== "facts") return false;
        // The colours of surfaces have a panel of their own.
        return withColours || !(isColour(sub) || (sub.items && isColour(sub.items)));
    });
    made.properties = Object.fromEntries(
        members.map(([name, sub]) => [name, plain(sub, [...path, name], lists, withColours)]),
    );
    return made;
}

function listWords({ items, fewest, most }: ListStyle): string {
    const count =
        fewest === most
            ? `${most} values`
            : Number.isFinite(most)
              ? `At most ${most} values`
              : "Values";
    const parted = items.items
        ? "rows with semicolons"
        : items.type === "string"
          ? "semicolons"
          : "commas";
    return `${count}, parted by ${parted}.`;
}

function filled(schema: DocumentSchema, document: unknown): unknown {
    const node = (typeof document === "object" && document !== null ? document : {}) as Record<
        string,
        unknown
    >;
    const found: Record<string, unknown> = {};
    const take = (part: DocumentSchema): void => {
        for (const [name, sub] of Object.entries(part.properties ?? {}))
            found[name] = sub.properties
                ? filled(sub, node[name])
                : (node[name] ?? sub["x-default"]);
        const choices = (part.oneOf ?? []) as DocumentSchema[];
        const chosen = choices.find(
            ({ properties }) => properties?.["form"]?.const === node["form"],
        );
        if (chosen ?? choices[0]) take((chosen ?? choices[0])!);
    };
    take(schema);
    return found;
}

/** Returns the form for a part of a document. */
export function formOf(schema: DocumentSchema, whole: string, withColours: boolean): FormSchema {
    const lists = new Map<string, ListStyle>();
    const lengths = new Map<string, number>();
    const noteLengths = ({ properties = {} }: DocumentSchema, path: string): void => {
        for (const [name, sub] of Object.entries(properties)) {
            if (sub.maxLength !== undefined) lengths.set(path + name, sub.maxLength);
            noteLengths(sub, `${path}${name}.`);
        }
    };
    noteLengths(schema, "");
    const root = plain(schema, [], lists, withColours);
    for (const sub of Object.values(root.properties ?? {})) sub["x-default-from"] = "species";
    for (const choice of root.oneOf ?? [])
        for (const sub of Object.values(choice.properties ?? {})) sub["x-default-from"] = "species";
    const groups = groupsOf(root, whole).map((group) => ({
        ...group,
        label: group.key ? group.key.split(".").map(words).join(" · ") : group.label,
    }));
    return {
        groups,
        fields: groups.flatMap(({ fields }) => fields),
        lists,
        lengths,
        defaults: (document) => filled(schema, document) as Record<string, unknown>,
    };
}

/** Returns a list as the text of its field. */
export function listText(list: readonly unknown[], items: DocumentSchema): string {
    if (items.items) return list.map((row) => (row as unknown[]).join(", ")).join("; ");
    return list.join(items.type === "string" ? "; " : ", ");
}

/** Returns the list of a text, or what is wrong with it. */
export function readList(text: string, style: ListStyle): Json[] | string {
    const { items, fewest, most } = style;
    const parts = text
        .split(items.items || items.type === "string" ? ";" : ",")
        .map((part) => part.trim())
        .filter((part) => part !== "");
    if (parts.length < fewest || parts.length > most)
        return fewest === most
            ? `${parts.length} values; ${most} are needed`
            : `${parts.length} values; at most ${most} are allowed`;
    const found: Json[] = [];
    for (const part of parts) {
        if (items.items) {
            const row = readList(part, {
                items: items.items,
                fewest: items.minItems ?? 0,
                most: items.maxItems ?? Infinity,
            });
            if (typeof row === "string") return row;
            found.push(row);
        } else if (items.type === "string") {
            if (part.length > (items.maxLength ?? Infinity))
                return `"${part.slice(0, 20)}…" is longer than ${items.maxLength} letters`;
            found.push(part);
        } else {
            const value = Number(part);
            if (!Number.isFinite(value)) return `"${part}" is no number`;
            if (items.type === "integer" && !Number.isInteger(value))
                return `${part} is no whole number`;
            if (items.minimum !== undefined && value < items.minimum)
                return `${part} is below ${items.minimum}`;
            if (items.maximum !== undefined && value > items.maximum)
                return `${part} is above ${items.maximum}`;
            found.push(value);
        }
    }
    return found;
}

function pointerOf(prefix: string, name: string): string {
    return `${prefix}/${name.replaceAll(".", "/")}`;
}

/** Values of a part of a document, as controls have them: those that were changed, and those of the
 *  document as it was opened. */
export class DocumentValues implements ControlledValues {
    readonly values = new Map<string, Value>();
    /** What the document has without changes, nested. */
    effective: unknown = {};
    private prefix = "";

    constructor(readonly schema: FormSchema) {}

    field(name: string): Field | undefined {
        return this.schema.fields.find((field) => field.name === name);
    }

    set(name: string, value: Value | undefined): void {
        if (value === undefined) this.values.delete(name);
        else this.values.set(name, value);
    }

    applies(): boolean {
        return true;
    }

    /** Reads a part of a document at a pointer. */
    read(own: unknown, details: Details | undefined, prefix: string): void {
        this.prefix = prefix;
        this.effective = this.withTexts(this.schema.defaults(atPointer(own, prefix) ?? {}));
        this.values.clear();
        for (const { name } of this.schema.fields) {
            const pointer = pointerOf(prefix, name);
            if (!details || !(pointer in details)) continue;
            const value = this.asValue(name, details[pointer]);
            if (value !== undefined) this.values.set(name, value);
        }
    }

    /** Returns the pointer and the new value of a field: undefined where it is again as it was.
     *
     *  throws  Error that says what is wrong with a text */
    change(name: string): { pointer: string; value: Json | undefined } {
        const pointer = pointerOf(this.prefix, name);
        const value = this.values.get(name);
        const style = this.schema.lists.get(name);
        const most = this.schema.lengths.get(name);
        if (typeof value === "string" && most !== undefined && value.length > most)
            throw new Error(`has ${value.length} letters; at most ${most} are allowed`);
        if (name === "id" && !/^[a-z0-9_]+$/.test(String(value ?? "_")))
            throw new Error("needs letters a to z, digits and underscores alone");
        if (!style || value === undefined) return { pointer, value };
        const list = readList(String(value), style);
        if (typeof list === "string") throw new Error(list);
        return { pointer, value: list };
    }

    private asValue(name: string, value: unknown): Value | undefined {
        const style = this.schema.lists.get(name);
        if (style && Array.isArray(value)) return listText(value, style.items);
        return typeof value === "number" || typeof value === "string" || typeof value === "boolean"
            ? value
            : undefined;
    }

    private withTexts(node: unknown, path = ""): unknown {
        if (Array.isArray(node)) return this.asValue(path, node);
        if (typeof node !== "object" || node === null) return node;
        return Object.fromEntries(
            Object.entries(node).map(([name, sub]) => [
                name,
                this.withTexts(sub, path ? `${path}.${name}` : name),
            ]),
        );
    }
}
