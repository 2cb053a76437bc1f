// Rows of a ramification matrix as text of an address and as a table to change: row k has k shares that sum to one, of order 2 on.

export type Rows = readonly (readonly number[])[];

/** Highest order that the service grows, and so rows and one. */
export const mostOrder = 12;

/** "0.5,0.5;0.25,0.5,0.25" */
export function rowsText(rows: Rows): string {
    return rows
        .map((row) => row.map((share) => String(Number(share.toPrecision(6)))).join(","))
        .join(";");
}

/** Rows of the right lengths; what else is against them the service says. */
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

/** The row with one share changed and the others as they were to each other, so that it sums to one again. */
export function withShare(row: readonly number[], at: number, share: number): number[] {
    const held = Math.min(Math.max(share, 0), 1);
    const others = row.reduce((sum, value, index) => (index === at ? sum : sum + value), 0);
    const rest = (value: number): number =>
        others > 0 ? (value * (1 - held)) / others : (1 - held) / (row.length - 1);
    const made = row.map((value, index) => Number((index === at ? held : rest(value)).toFixed(4)));
    // Rounding is taken up by the largest of the others.
    const last = made.reduce(
        (best, value, index) =>
            index !== at && (best < 0 || value > (made[best] ?? 0)) ? index : best,
        -1,
    );
    const sum = made.reduce((all, value) => all + value, 0);
    if (last >= 0) made[last] = Number(((made[last] ?? 0) + 1 - sum).toFixed(4));
    return made;
}

/** One order more: its branches fork as those of the order below do, and bear as many of each. */
export function grownBy(rows: Rows): number[][] {
    const below = rows.at(-1) ?? [0.5, 0.5];
    return [...rows.map((row) => [...row]), [0, ...below]];
}
