// Requests for children: by address where the service has both parents, otherwise with whole species.
import { getModel, send } from "../http";
import { isAddressable, type Birth, type Pedigree } from "./pedigree";

export interface Request {
    address: string;
    body?: string;
}

/** Options of files, as the service names them. */
export type Options = Readonly<Record<string, string | number>>;

/** Small files without images, which arrive at once. */
export const draftOptions: Options = { lod: 2, textures: "none", variation: 0 };

/** What replaces them. */
export const finalOptions: Options = { lod: 1, textures: "embedded", texture_size: 256, variation: 0 };

/** The file that is saved. */
export const savedOptions: Options = { lod: 0, variation: 0 };

function queryOf(parts: Options): string {
    return Object.entries(parts)
        .map(([name, value]) => `${name}=${encodeURIComponent(value).replaceAll("%2C", ",")}`)
        .join("&");
}

/** Returns the request for a child: its file, or as JSON its species.
 *
 *  throws  Error if the document of a parent is missing that the service does not have */
export function requestFor(
    pedigree: Pedigree,
    { a, b, genes }: Birth,
    ending: "glb" | "json",
    options: Options = {},
): Request {
    const { seed, share, mutation, lock } = genes;
    if (isAddressable(a) && isAddressable(b)) {
        const locks: Options = lock.length > 0 ? { lock: lock.join(",") } : {};
        const query = queryOf({ seed, share, mutation, ...locks, ...options });
        return { address: `v1/offspring/${a}/${b}.${ending}?${query}` };
    }
    const parent = (key: string): string => {
        if (isAddressable(key)) return JSON.stringify(key);
        const { text } = pedigree.get(key);
        if (text === undefined) throw new Error(`${pedigree.name(key)} is not in this browser`);
        return text;
    };
    const rest = JSON.stringify({ seed, share, mutation, lock, ...options });
    return {
        address: `v1/offspring.${ending}`,
        body: `{"a":${parent(a)},"b":${parent(b)},${rest.slice(1)}`,
    };
}

export interface ChildFile {
    bytes: ArrayBuffer;
    /** Address of the bytes. */
    from: string;
    /** Time that the service worked on it, milliseconds; 0 for a file of the browser's cache. */
    workMs: number;
}

/** Returns the sum of the durations of a Server-Timing header, milliseconds. */
export function workOf(timing: string | null): number {
    const durations = [...(timing ?? "").matchAll(/;dur=([\d.]+)/g)].map(([, text]) => Number(text));
    return durations.reduce((sum, one) => sum + one, 0);
}

export async function fetchFile(
    pedigree: Pedigree,
    birth: Birth,
    options: Options,
    signal: AbortSignal,
): Promise<ChildFile> {
    const { bytes, response, source } = await getModel(requestFor(pedigree, birth, "glb", options), signal);
    const workMs = source === "server" ? workOf(response.headers.get("server-timing")) : 0;
    return { bytes, from: response.url, workMs };
}

/** Returns the whole document of a child as text. */
export async function fetchSpecies(pedigree: Pedigree, birth: Birth, signal?: AbortSignal): Promise<string> {
    const { address, body } = requestFor(pedigree, birth, "json");
    const posted = body === undefined ? {} : { method: "POST", body, headers: { "Content-Type": "application/json" } };
    return (await send(address, { ...posted, ...(signal ? { signal } : {}) })).text();
}
