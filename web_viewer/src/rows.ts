// Rows of a ramification matrix as text of an address and as an editable table: row k, from order 2
// on, has k shares that sum to one.

export type Rows = readonly (readonly number[])[];

/** The highest order that the service makes: one more than the rows. */
export const mostOrder = 12;

/** Returns rows as text: "0.5,0.5;0.25,0.5,0.25". */
export function rowsText(rows: Rows): string {
    return rows
        .map((row) => row.map((share) => String(Number(share.toPrecision(6)))).join(","))
        .join(";");
}

/** Parses rows; returns undefined if their lengths are wrong. All else is checked by the
 *  service. */
export function readRows(text: string): Rows | undefined {
    const rows = text
        .split(";")
        .map((row) =>
            row
                .split(",")
                .map((share) =>
                    /^-?\d*\.?\d+(?:[eE][+-]?\d+)?$/.test(share) ? Number(share) : Number.NaN,
                ),
        );
    const whole =
        rows.length < mostOrder &&
        rows.every((row, index) => row.length === index + 2 && row.every(Number.isFinite));
    return whole ? rows : undefined;
}

/** Returns a row with one share changed; the others keep their proportions, so that the sum is
 *  one. */
export function withShare(row: readonly number[], at: number, share: number): number[] {
    const held = Math.min(Math.max(share, 0), 1);
    const others = row.reduce((sum, value, index) => (index === at ? sum : sum + value), 0);
    const rest = (value: number): number =>
        others > 0 ? (value * (1 - held)) / others : (1 - held) / (row.length - 1);
    const made = row.map((value, index) => Number((index === at ? held : rest(value)).toFixed(4)));
    // The largest of the others absorbs the rounding error.
    const last = made.reduce(
        (best, value, index) =>
            index !== at && (best < 0 || value > (made[best] ?? 0)) ? index : best,
        -1,
    );
    const sum = made.reduce((all, value) => all + value, 0);
    if (last >= 0) made[last] = Number(((made[last] ?? 0) + 1 - sum).toFixed(4));
    return made;
}

/** Adds one order, whose branches fork and bear side branches as those of the order below do. */
export function grownBy(rows: Rows): number[][] {
    const below = rows.at(-1) ?? [0.5, 0.5];
    return [...rows.map((row) => [...row]), [0, ...below]];
}
