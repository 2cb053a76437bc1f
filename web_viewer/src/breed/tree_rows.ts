// Where couples stand in the family tree: one row each, children below their parents, each branch in a lane of its own.
import type { Couple, Pedigree } from "./pedigree";

export interface TreeRow {
    couple: Couple;
    row: number;
    lane: number;
    /** Row of the couple that it comes from; undefined for founders. */
    from: number | undefined;
    level: number;
}

/** Returns the rows of all couples: the first child goes on in the lane of its parents. */
export function treeRows(pedigree: Pedigree): TreeRow[] {
    const rows: TreeRow[] = [];
    /** Adds a couple and what comes from it; returns the last lane that it needs. */
    const add = (couple: Couple, lane: number, from: number | undefined, level: number): number => {
        const row = rows.length;
        rows.push({ couple, row, lane, from, level });
        let last = lane;
        pedigree.offspring(couple).forEach((child, index) => {
            last = add(child, index === 0 ? lane : last + 1, row, level + 1);
        });
        return last;
    };
    for (const founders of pedigree.offspring(undefined)) add(founders, 0, undefined, 1);
    return rows;
}
