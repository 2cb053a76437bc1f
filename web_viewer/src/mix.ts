// Mixes of species: read from addresses, and written in the service's canonical form.

export interface Share {
    id: string;
    /** 0..1; the shares of a mix sum to one. */
    weight: number;
}

/** A morph has two to five species: the polygon has no space for more corners. */
export const fewestMembers = 2;
export const mostMembers = 5;

/** Returns weights in whole thousandths of their sum, by largest remainder, ties to the first; all
 *  zero if the sum is zero. */
export function thousandths(weights: readonly number[]): number[] {
    const sum = weights.reduce((all, weight) => all + weight, 0);
    if (sum <= 0) return weights.map(() => 0);
    const exact = weights.map((weight) => (weight / sum) * 1000);
    const whole = exact.map(Math.floor);
    const left = 1000 - whole.reduce((all, part) => all + part, 0);
    const order = exact.map((part, index) => ({ index, rest: part - Math.floor(part) }));
    order.sort((one, other) => other.rest - one.rest || one.index - other.index);
    for (const { index } of order.slice(0, left)) whole[index] = (whole[index] ?? 0) + 1;
    return whole;
}

/** Returns a mix in canonical form, "amanita_muscaria:0.7,boletus_edulis:0.3": sorted, in
 *  thousandths, without shares that round to zero. */
export function canonicalMix(shares: readonly Share[]): string {
    const sorted = [...shares].sort((one, other) => (one.id < other.id ? -1 : 1));
    const parts = thousandths(sorted.map((share) => share.weight));
    const nonzero = sorted.flatMap(({ id }, index) =>
        parts[index] ? [{ id, part: parts[index] }] : [],
    );
    if (nonzero.length === 1 && nonzero[0]) return nonzero[0].id;
    return nonzero.map(({ id, part }) => `${id}:${part / 1000}`).join(",");
}

/** Returns all shares in their own order, zeros included, for the page's address. */
export function sharesText(shares: readonly Share[]): string {
    const parts = thousandths(shares.map((share) => share.weight));
    return shares.map(({ id }, index) => `${id}:${(parts[index] ?? 0) / 1000}`).join(",");
}

/** Parses "a:0.5,b:0.5" or "a,b"; returns undefined unless these are shares of different species
 *  with a positive sum. */
export function readShares(text: string): Share[] | undefined {
    const shares: Share[] = [];
    for (const part of text.split(",")) {
        const match = /^(~?[a-z0-9_.]+(?:@\d+)?)(?::(\d+(?:\.\d+)?(?:[eE][+-]?\d+)?))?$/.exec(part);
        if (!match?.[1] || shares.some(({ id }) => id === match[1])) return undefined;
        shares.push({ id: match[1], weight: match[2] === undefined ? 1 : Number(match[2]) });
    }
    const sum = shares.reduce((all, { weight }) => all + weight, 0);
    if (!(sum > 0) || !Number.isFinite(sum)) return undefined;
    return shares.map(({ id, weight }) => ({ id, weight: weight / sum }));
}

/** Gives one member another weight; the others keep their proportions. */
export function reweighted(shares: readonly Share[], index: number, weight: number): Share[] {
    const others = shares.reduce((all, share, at) => (at === index ? all : all + share.weight), 0);
    const rest = 1 - weight;
    return shares.map(({ id, weight: before }, at) => {
        if (at === index) return { id, weight };
        return { id, weight: others > 0 ? (before / others) * rest : rest / (shares.length - 1) };
    });
}
