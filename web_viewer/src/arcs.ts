// Arcs of the correspondence graph: links between two outlines, as shares of a sub-curve's length.

export const curveNames = ["stem", "hymenium", "cap"] as const;
export type CurveName = (typeof curveNames)[number];

export interface Arc {
    curve: CurveName;
    /** Fractions of the sub-curve's arc length on the two outlines, 0..1. */
    a: number;
    b: number;
}

/** The number of arcs a designer may set at most; readArcs() refuses longer lists. */
export const mostArcs = 24;

/** Rounds to three decimals: finer than a pointer can place an arc on an outline. */
export function rounded(share: number): number {
    return Math.round(Math.min(Math.max(share, 0), 1) * 1000) / 1000;
}

/** Returns arcs as text of an address: "cap:0.25:0.4,stem:0.1:0.2". */
export function arcsText(arcs: readonly Arc[]): string {
    return arcs.map(({ curve, a, b }) => `${curve}:${a}:${b}`).join(",");
}

/** Parses the text of arcsText(); returns undefined for any other text. */
export function readArcs(text: string): Arc[] | undefined {
    if (text === "") return [];
    const arcs = text.split(",").map((part) => {
        const match = /^(stem|hymenium|cap):(\d(?:\.\d+)?):(\d(?:\.\d+)?)$/.exec(part);
        const [a, b] = [Number(match?.[2]), Number(match?.[3])];
        return match && a <= 1 && b <= 1 ? { curve: match[1] as CurveName, a, b } : undefined;
    });
    if (arcs.length > mostArcs || arcs.some((arc) => !arc)) return undefined;
    return arcs as Arc[];
}

/** Returns true if two arcs of one sub-curve cross or meet: a morph along both would fold the
 *  outline. */
export function crosses(one: Arc, other: Arc): boolean {
    return one.curve === other.curve && (one.a - other.a) * (one.b - other.b) <= 0;
}

/** Returns for each arc whether it crosses another one. */
export function crossing(arcs: readonly Arc[]): boolean[] {
    return arcs.map((arc, index) => arcs.some((other, at) => at !== index && crosses(arc, other)));
}

/** Returns the position on the other outline that corresponds to a position on this one: linear
 *  between the arcs and the ends of the sub-curve. */
export function matched(
    arcs: readonly Arc[],
    curve: CurveName,
    share: number,
    from: "a" | "b",
): number {
    const to = from === "a" ? "b" : "a";
    const ends: Arc[] = [
        { curve, a: 0, b: 0 },
        { curve, a: 1, b: 1 },
    ];
    const known = [...ends, ...arcs.filter((arc) => arc.curve === curve)].sort(
        (one, other) => one[from] - other[from],
    );
    const next = known.findIndex((arc, index) => index > 0 && arc[from] >= share);
    const [low, high] = [known[Math.max(next - 1, 0)]!, known[Math.max(next, 1)]!];
    const span = high[from] - low[from];
    return span > 0 ? low[to] + ((share - low[from]) / span) * (high[to] - low[to]) : low[to];
}

/** Returns a further arc of a sub-curve, in the middle of the widest gap between its arcs. */
export function widestGap(arcs: readonly Arc[], curve: CurveName): Arc {
    const own = arcs.filter((arc) => arc.curve === curve).sort((one, other) => one.a - other.a);
    const known = [{ curve, a: 0, b: 0 }, ...own, { curve, a: 1, b: 1 }];
    let best = { curve, a: 0.5, b: 0.5 };
    let widest = -1;
    for (let index = 1; index < known.length; ++index) {
        const [low, high] = [known[index - 1]!, known[index]!];
        const width = Math.min(high.a - low.a, high.b - low.b);
        if (width > widest) {
            widest = width;
            best = { curve, a: (low.a + high.a) / 2, b: (low.b + high.b) / 2 };
        }
    }
    return best;
}
