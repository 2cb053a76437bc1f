// What users have published in the library of the service: its list by pages, and single species of it.
import { getJson, RequestFailed } from "./http";

/** A species in lists and after writes. */
export interface LibrarySpecies {
    /** "~owner.name" */
    id: string;
    name: string;
    title: string;
    form: string;
    /** Number of the newest published version; 0 for none. */
    newest: number;
    state: "active" | "unlisted";
    updated_s: number;
    links: { self: string; published?: string; model?: string };
}

export interface LibraryPage {
    species: LibrarySpecies[];
    /** Where the next page begins; null at the end. */
    next: string | null;
}

/** A species of the gallery that is in the library. */
export interface ListedSpecies {
    /** "~owner.name@3" */
    id: string;
    common_name: string;
    scientific_name: string;
    form: string;
}

/** Returns true for "~owner.name" and "~owner.name@3". */
export function isOfLibrary(id: string): boolean {
    return id.startsWith("~");
}

let known: Promise<boolean> | undefined;

/** Returns true if the service has a library; one request is enough. */
export function hasLibrary(): Promise<boolean> {
    known ??= getJson<{ links: Record<string, string> }>("v1").then(({ links }) => "library" in links);
    known.catch(() => (known = undefined));
    return known;
}

/** Returns the query of a page of the list: those whose name or title contains a text, after a name. */
export function pageQuery({ q = "", after = "", limit = 50 }): string {
    const parts = { q: q.slice(0, 64), after, limit: String(limit) };
    return new URLSearchParams(Object.entries(parts).filter(([, value]) => value !== "")).toString();
}

/** Returns a page of what all users have published. */
export function publishedPage(
    wanted: { q?: string; after?: string; limit?: number },
    signal?: AbortSignal,
): Promise<LibraryPage> {
    return getJson<LibraryPage>(`v1/library?${pageQuery(wanted)}`, signal);
}

/** Returns published species as those of a gallery, by the number of their newest version. */
export function listedOf(species: readonly LibrarySpecies[]): ListedSpecies[] {
    return species
        .filter(({ newest }) => newest > 0)
        .map(({ id, name, title, form, newest }) => ({
            id: `${id}@${newest}`,
            common_name: title || name.replaceAll("_", " "),
            scientific_name: `${id}@${newest}`,
            form,
        }));
}

/** Returns the ids of the library in a mix. */
export function libraryIdsOf(mix: string): string[] {
    const ids = mix.split(",").map((member) => member.split(":")[0] ?? "");
    return [...new Set(ids.filter(isOfLibrary))];
}

/** Returns a published species; without a version the newest one.
 *
 *  throws  RequestFailed with status 404 or 410 if there is none */
export async function publishedSpecies(id: string): Promise<ListedSpecies> {
    const { mix } = await getJson<{ mix: { id: string }[] }>(`v1/mushrooms/${id}.json?lod=3`);
    const found = mix[0]?.id;
    if (!found) throw new RequestFailed(`'${id}' is no species`, "", 404);
    const { facts } = await getJson<{ facts?: { common_name?: string; form?: string } }>(
        `v1/library/${found}`,
    );
    const name = found.replace(/^.*\.|@.*$/g, "").replaceAll("_", " ");
    return {
        id: found,
        common_name: facts?.common_name || name,
        scientific_name: found,
        form: facts?.form ?? "",
    };
}
