// What the page grows: mushrooms and colonies of them, or what grows from a preset. Where each has its routes, its list and its words.
import { lying, spread, standing, type Directions, type ViewName, viewNames } from "./camera";
import type { Species } from "./gallery";
import { getJson } from "./http";

export interface Product {
    /** "mushroom": what one of them is called. */
    noun: string;
    /** Its link in the navigation. */
    label: string;
    /** What its parameters are about. */
    whole: string;
    /** What names one of its list: "species", also in the page's query. */
    kind: string;
    /** Where the service grows it, relative to the page: it may stand under a prefix. */
    path: string;
    /** Two of them can be mixed in the morph editor. */
    canMorph: boolean;
    /** Whether it is of a species of the atlas or a mix of them. */
    ofSpecies: boolean;
    /** The views that its buttons offer. */
    views: readonly ViewName[];
    /** Where to stand, by the name of a view. */
    directions: Directions;
    /** The same for the pictures of its list. */
    portraits: Directions;
    /** What of it is never sunk into the ground. */
    lies: boolean;
    /** Whether it grows from a matrix, which may be one's own. */
    ramifies: boolean;
    list: () => Promise<Species[]>;
}

interface Preset {
    id: string;
    name: string;
}

export const mushrooms: Product = {
    noun: "mushroom",
    label: "Species",
    whole: "individual",
    kind: "species",
    path: "v1/mushrooms",
    canMorph: true,
    ofSpecies: true,
    views: viewNames,
    directions: standing,
    portraits: standing,
    lies: false,
    ramifies: false,
    list: listSpecies,
};

/** Many of a species or mix; the list shows one of each. */
export const colonies: Product = {
    noun: "colony",
    label: "Colonies",
    whole: "colony",
    kind: "colony",
    path: "v1/colonies",
    canMorph: false,
    ofSpecies: true,
    views: [...viewNames, "roots"],
    directions: spread,
    portraits: standing,
    lies: false,
    ramifies: false,
    list: listSpecies,
};

export const leaves: Product = {
    noun: "leaf",
    label: "Leaves",
    whole: "individual",
    kind: "leaf",
    path: "v1/leaves",
    canMorph: false,
    ofSpecies: false,
    views: viewNames,
    directions: lying,
    portraits: lying,
    lies: true,
    ramifies: false,
    list: async () => listed((await getJson<{ leaves: Preset[] }>("v1/leaves")).leaves),
};

export const trees: Product = {
    noun: "tree",
    label: "Trees",
    whole: "individual",
    kind: "tree",
    path: "v1/trees",
    canMorph: false,
    ofSpecies: false,
    views: viewNames,
    directions: standing,
    portraits: standing,
    lies: false,
    ramifies: true,
    list: async () => listed((await getJson<{ trees: Preset[] }>("v1/trees")).trees),
};

/** All products, in the order of their links. */
export const products: readonly Product[] = [mushrooms, colonies, leaves, trees];

async function listSpecies(): Promise<Species[]> {
    return (await getJson<{ species: Species[] }>("v1/species")).species;
}

function listed(presets: readonly Preset[]): Species[] {
    return presets.map(({ id, name }) => ({ id, common_name: name, scientific_name: "" }));
}

/** What a page's query is about. */
export function productOf(query: URLSearchParams): Product {
    return products.find(({ kind }) => query.has(kind)) ?? mushrooms;
}

/** What grew at a canonical address, and which of its list. */
export function grownAt(path: string): { product: Product; id: string } | undefined {
    for (const product of products) {
        const id = new RegExp(`^/${product.path}/([^/]+)\\.(?:glb|json)$`).exec(path)?.[1];
        if (id) return { product, id };
    }
    return undefined;
}
