// The products that the page shows, one table: mushrooms, colonies of them, and what is made from
// presets. Routes, navigation, views and words of each are described here only.
import {
    lying,
    lyingCloseUps,
    spread,
    spreadCloseUps,
    standing,
    standingCloseUps,
    treeCloseUps,
    type Directions,
    type ViewName,
    viewNames,
} from "./camera";
import type { CloseUpRules } from "./close_ups";
import type { Species } from "./gallery";
import { getJson } from "./http";

export interface Product {
    /** The singular: "mushroom". */
    noun: string;
    /** Text of its link in the navigation. */
    label: string;
    /** Name of the group of top-level parameters. */
    groupName: string;
    /** Name in the page's query: "species". */
    queryName: string;
    /** Route of the service, relative to the page, which may have a path prefix. */
    path: string;
    /** Two of them can be mixed in the morph editor. */
    canMorph: boolean;
    /** It is made of a species of the atlas or a mix of them, not of a preset. */
    ofSpecies: boolean;
    /** Views with a button, in this order. */
    views: readonly ViewName[];
    /** Camera directions by name of a view. */
    directions: Directions;
    closeUps: CloseUpRules;
    /** Query of the pictures of its gallery, twice as large as they are shown. */
    pictureQuery: string;
    /** It is lifted so that nothing of it is below the ground. */
    liesOnGround: boolean;
    /** It has a ramification matrix, which can be replaced by a custom one. */
    hasMatrix: boolean;
    list: () => Promise<Species[]>;
}

const pictureQuery = "lod=1&width=192&height=192";

interface Preset {
    id: string;
    name: string;
}

export const mushrooms: Product = {
    noun: "mushroom",
    label: "Species",
    groupName: "individual",
    queryName: "species",
    path: "v1/mushrooms",
    canMorph: true,
    ofSpecies: true,
    views: viewNames,
    directions: standing,
    closeUps: standingCloseUps,
    pictureQuery,
    liesOnGround: false,
    hasMatrix: false,
    list: listSpecies,
};

/** Many individuals of a species or mix; the gallery shows single mushrooms. */
export const colonies: Product = {
    noun: "colony",
    label: "Colonies",
    groupName: "colony",
    queryName: "colony",
    path: "v1/colonies",
    canMorph: false,
    ofSpecies: true,
    views: [...viewNames, "roots"],
    directions: spread,
    closeUps: spreadCloseUps,
    pictureQuery,
    liesOnGround: false,
    hasMatrix: false,
    list: listSpecies,
};

export const leaves: Product = {
    noun: "leaf",
    label: "Leaves",
    groupName: "individual",
    queryName: "leaf",
    path: "v1/leaves",
    canMorph: false,
    ofSpecies: false,
    views: viewNames,
    directions: lying,
    closeUps: lyingCloseUps,
    pictureQuery,
    liesOnGround: true,
    hasMatrix: false,
    list: async () => listed((await getJson<{ leaves: Preset[] }>("v1/leaves")).leaves),
};

export const trees: Product = {
    noun: "tree",
    label: "Trees",
    groupName: "individual",
    queryName: "tree",
    path: "v1/trees",
    canMorph: false,
    ofSpecies: false,
    views: viewNames,
    directions: standing,
    closeUps: treeCloseUps,
    pictureQuery,
    liesOnGround: false,
    hasMatrix: true,
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

/** Returns the product that a page's query is about. */
export function productOf(query: URLSearchParams): Product {
    return products.find(({ queryName: kind }) => query.has(kind)) ?? mushrooms;
}

/** Returns the product and the species or preset of a canonical path, undefined for other paths. */
export function modelAt(path: string): { product: Product; id: string } | undefined {
    for (const product of products) {
        const id = new RegExp(`^/${product.path}/([^/]+)\\.(?:glb|json)$`).exec(path)?.[1];
        if (id) return { product, id };
    }
    return undefined;
}
