// Changes of single values of a species' document, by JSON pointer. All values are immutable, so that
// undo restores whole documents.

export type Json =
    null | boolean | number | string | readonly Json[] | { readonly [name: string]: Json };

/** New values by JSON pointer; undefined removes a member. */
export type Details = Readonly<Record<string, Json | undefined>>;

function partsOf(pointer: string): string[] {
    return pointer
        .split("/")
        .slice(1)
        .map((part) => part.replaceAll("~1", "/").replaceAll("~0", "~"));
}

/** Returns the value at a JSON pointer, undefined if there is none. */
export function atPointer(document: unknown, pointer: string): unknown {
    let found = document;
    for (const part of partsOf(pointer)) {
        if (typeof found !== "object" || found === null) return undefined;
        found = (found as Record<string, unknown>)[part];
    }
    return found;
}

function written(node: unknown, parts: readonly string[], value: Json | undefined): unknown {
    const [name, ...rest] = parts;
    if (name === undefined) return value;
    if (Array.isArray(node)) {
        const index = Number(name);
        // What is not there, such as a stage that another species has, is not made.
        if (!(index >= 0 && index < node.length)) return node;
        return (node as unknown[]).map((each, at) =>
            at === index ? written(each, rest, value) : each,
        );
    }
    const object = (typeof node === "object" && node !== null ? node : {}) as Record<
        string,
        unknown
    >;
    if (value === undefined && !(name in object)) return object;
    if (value === undefined && rest.length === 0) {
        const { [name]: _, ...others } = object;
        return others;
    }
    return { ...object, [name]: written(object[name], rest, value) };
}

/** Returns a document with another value at a JSON pointer; objects on the way to it are made. */
export function withPointer<T>(document: T, pointer: string, value: Json | undefined): T {
    return written(document, partsOf(pointer), value) as T;
}

/** Returns a document with all changes. */
export function withDetails<T>(document: T, details: Details | undefined): T {
    return Object.entries(details ?? {}).reduce(
        (changed, [pointer, value]) => withPointer(changed, pointer, value),
        document,
    );
}

/** Returns changes of which those are left whose pointer passes a test; undefined if none is. */
export function filtered(
    details: Details | undefined,
    passes: (pointer: string) => boolean,
): Details | undefined {
    const left = Object.entries(details ?? {}).filter(([pointer]) => passes(pointer));
    return left.length > 0 ? Object.fromEntries(left) : undefined;
}

/** Returns the pointer of a member of a stage's model. */
export function modelPointer(stage: number, member: string): string {
    return `/stages/${stage}/model/${member}`;
}

/** Members of a model that a photograph determines: a new trace discards their changes. */
const ofTheTrace = /^\/stages\/\d+\/model\/(axis|deformation\/(bend|lean)_deg)$/;

/** Returns true if the axis or an angle of a stage was changed. */
export function hasGeometry(details: Details | undefined): boolean {
    return Object.keys(details ?? {}).some((pointer) => ofTheTrace.test(pointer));
}

/** Returns the changes that stay when the same species is traced anew. */
export function withoutGeometry(details: Details | undefined): Details | undefined {
    return filtered(details, (pointer) => !ofTheTrace.test(pointer));
}

/** Returns the changes that stay when another species lends the stages. */
export function withoutStages(details: Details | undefined): Details | undefined {
    return filtered(details, (pointer) => !pointer.startsWith("/stages/"));
}
