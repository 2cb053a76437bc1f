// A couple in the page's address: both parents, the genes, and how each parent that is a child came about, so that
// another browser breeds the same.
import {
    firstGenes,
    keyOfBirth,
    sortedLocks,
    type Birth,
    type Couple,
    type Genes,
    type Pedigree,
} from "./pedigree";

/** Longer addresses are cut off by some programs that pass them on. */
export const mostLetters = 6000;

export interface ReadCouple {
    a: string;
    b: string;
    genes: Genes;
    /** Children among the ancestors, parents before children. */
    births: Birth[];
}

/** What stands between genes, between births, and between locks. */
const marks = { member: ",", birth: ";", lock: "-" };

const seedPattern = /^\d{1,10}$/;
const sharePattern = /^\d+(\.\d+)?(e-\d+)?$/;
const lockPattern = /^[a-z0-9_.]{1,64}$/;
const idPattern = /^(~?[a-z0-9_]+(\.[a-z0-9_]+)?(@\d+)?|own-[a-z0-9]{11})$/;

function escaped(text: string): string {
    return encodeURIComponent(text).replaceAll("%2C", ",").replaceAll("%3B", ";").replaceAll("%40", "@");
}

/** Returns the query of a couple; undefined if it would be too long to be passed on. */
export function coupleQuery(pedigree: Pedigree, { a, b, genes }: Couple): string | undefined {
    const line = pedigree.line([a, b]);
    const places = new Map(line.map(({ key }, index) => [key, `.${index + 1}`]));
    const place = (key: string): string => places.get(key) ?? key;
    const births = line.map(({ birth }) => {
        const { a: first, b: second, genes: of } = birth!;
        const members = [of.seed, of.share, of.mutation, sortedLocks(of.lock).join(marks.lock)];
        return [place(first), place(second), ...members].join(marks.member).replace(/,$/, "");
    });
    const parts: [string, string][] = [
        ["a", place(a)],
        ["b", place(b)],
        ["seed", String(genes.seed)],
        ["share", String(genes.share)],
        ["mutation", String(genes.mutation)],
    ];
    if (genes.lock.length > 0) parts.push(["lock", sortedLocks(genes.lock).join(",")]);
    if (births.length > 0) parts.push(["line", births.join(marks.birth)]);
    const query = `?${parts.map(([name, value]) => `${name}=${escaped(value)}`).join("&")}`;
    return query.length <= mostLetters ? query : undefined;
}

function readGenes(seed: string, share: string, mutation: string, lock: readonly string[]): Genes {
    if (!seedPattern.test(seed) || Number(seed) > 4294967295)
        throw new Error(`seed '${seed}' is no whole number from 0 to 4294967295`);
    for (const [name, text] of [["share", share], ["mutation", mutation]] as const)
        if (!sharePattern.test(text) || Number(text) > 1) throw new Error(`${name} '${text}' is no number from 0 to 1`);
    for (const one of lock)
        if (!lockPattern.test(one)) throw new Error(`lock '${one}' names no part of a species`);
    return {
        seed: Number(seed),
        share: Number(share),
        mutation: Number(mutation),
        lock: sortedLocks(lock),
    };
}

function list(text: string, mark: string): string[] {
    return text.split(mark).filter((part) => part !== "");
}

/** Reads the couple of an address; undefined if it names none.
 *
 *  throws  Error that says what of it cannot be used */
export function readCouple(search: string): ReadCouple | undefined {
    const query = new URLSearchParams(search);
    const first = query.get("a");
    if (first === null) return undefined;
    const births: Birth[] = [];
    const place = (text: string): string => {
        if (text.startsWith(".")) {
            const birth = births[Number(text.slice(1)) - 1];
            if (!birth) throw new Error(`line has no child ${text}`);
            return keyOfBirth(birth);
        }
        if (!idPattern.test(text)) throw new Error(`'${text}' is no species`);
        return text;
    };
    for (const text of list(query.get("line") ?? "", marks.birth)) {
        const [a = "", b = "", seed = "", share = "", mutation = "", lock = ""] = text.split(marks.member);
        const genes = readGenes(seed, share, mutation, list(lock, marks.lock));
        births.push({ a: place(a), b: place(b), genes });
    }
    const genes = readGenes(
        query.get("seed") ?? String(firstGenes.seed),
        query.get("share") ?? String(firstGenes.share),
        query.get("mutation") ?? String(firstGenes.mutation),
        list(query.get("lock") ?? "", ","),
    );
    return { a: place(first), b: place(query.get("b") ?? first), genes, births };
}
