// The request of a set whose files are written like the shown one.
import type { Settings } from "./settings";

/** Individuals of each species, and in the scene, of a copied request: a start to be changed. */
const seeds = 8;
const individuals = 100;

/** Returns the body of POST /v1/sets.json for the species and options of the settings; undefined if
 *  a set cannot have them. A set consists of mushrooms, and chooses seeds, ages and levels itself.
 *
 *  @param levels levels of detail of each individual, finest first */
export function setRequestOf(settings: Settings, levels: readonly number[]): string | undefined {
    const { product, morph, mix } = settings;
    if (product.noun !== "mushroom" || morph?.arcs.length) return undefined;
    const { seed, age, lod, ...options } = settings.nested();
    const own = levels.filter((level) => Number.isInteger(level));
    const order = {
        species: [mix],
        ...(age === undefined ? {} : { ages: [age] }),
        ...(seed === undefined ? {} : { first_seed: seed }),
        seeds,
        levels: own.length > 0 ? own : [lod ?? 0],
        individuals,
        ...options,
    };
    return JSON.stringify(order, undefined, 2);
}
