// Where most species of fungi stand close together. Pure.

/** Where a fruit body stands, as placements.json has it: x to the east, y up, z to the south. */
export interface Placement {
    species: string;
    translation: [number, number, number];
}

/** Distance between places that are compared, metres. */
const step = 3;

/** Returns the middle of the square of a size in which most species stand, among those with as many the one with most
 *  fruit bodies; undefined if nothing stands anywhere. One more of a frequent species counts less than one of a rare
 *  one. */
export function richestPlace(
    bodies: readonly Placement[],
    [west, south, east, north]: readonly [number, number, number, number],
    size: number,
): { x: number; y: number } | undefined {
    let best: { x: number; y: number } | undefined;
    let most = 0;
    const reach = 0.45 * size;
    for (let x = west + size / 2; x <= east - size / 2; x += step) {
        for (let y = south + size / 2; y <= north - size / 2; y += step) {
            const counts = new Map<string, number>();
            for (const { species, translation } of bodies) {
                if (Math.abs(translation[0] - x) > reach || Math.abs(-translation[2] - y) > reach) continue;
                counts.set(species, (counts.get(species) ?? 0) + 1);
            }
            const score = [...counts.values()].reduce((sum, count) => sum + Math.log1p(count), 0);
            if (score > most) [best, most] = [{ x, y }, score];
        }
    }
    return best;
}
