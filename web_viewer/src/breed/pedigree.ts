// Species by descent: founders, what was bred of them, and the couples whose children are shown. All keys follow from
// the contents, so equal things are one in the tree, in the browser's database and in addresses.

export type FamilyName = string;

/** What a bred species has of its parents. */
export interface Genes {
    seed: number;
    share: number;
    mutation: number;
    lock: readonly string[];
}

/** Keys of both parents, and the genes. */
export interface Birth {
    a: string;
    b: string;
    genes: Genes;
}

export interface Species {
    /** The id at the service, or "own-" or "bred-" and a hash. */
    key: string;
    /** Undefined for children, which are named by their generation and seed. */
    name?: string;
    /** Undefined until it is known. */
    family?: FamilyName;
    /** The whole document, of those that the service does not have; of children once it was fetched. */
    text?: string;
    birth?: Birth;
    /** A data URL. */
    picture?: string;
}

/** Two parents and the genes with which their nine children were looked at last. */
export interface Couple {
    key: string;
    a: string;
    b: string;
    genes: Genes;
    /** Couples are in this order in the tree. */
    made: number;
}

export const childCount = 9;
const seedCount = 2 ** 32;

export const firstGenes: Genes = { seed: 1, share: 0.5, mutation: 0.2, lock: [] };

/** Returns the seeds of the children that are shown from a first one. */
export function seedsFrom(first: number): number[] {
    return Array.from({ length: childCount }, (_, index) => (first + index) % seedCount);
}

/** Returns the first of the next nine seeds. */
export function nextSeeds(first: number): number {
    return (first + childCount) % seedCount;
}

/** Returns a hash of a text, 53 bits as 11 letters and digits: two rounds of FNV-1a with different primes. */
export function hashOf(text: string): string {
    let [low, high] = [0x811c9dc5, 0x9dc5811c];
    for (let index = 0; index < text.length; ++index) {
        const code = text.charCodeAt(index);
        low = Math.imul(low ^ code, 0x01000193);
        high = Math.imul(high ^ code, 0x85ebca6b);
        high ^= high >>> 13;
    }
    return ((low >>> 0) * 0x200000 + ((high >>> 0) & 0x1fffff)).toString(36).padStart(11, "0");
}

export function sortedLocks(lock: Iterable<string>): string[] {
    return [...new Set(lock)].sort();
}

function genesText({ seed, share, mutation, lock }: Genes): string {
    return [seed, share, mutation, sortedLocks(lock).join("-")].join(",");
}

export function keyOfBirth({ a, b, genes }: Birth): string {
    return `bred-${hashOf(`${a},${b},${genesText(genes)}`)}`;
}

export function keyOfCouple(a: string, b: string): string {
    return `${a}*${b}`;
}

/** Returns true for a species that the service has under its key. */
export function isAddressable(key: string): boolean {
    return !/^(own|bred)-/.test(key);
}

export class Pedigree {
    private readonly species = new Map<string, Species>();
    private readonly couples = new Map<string, Couple>();

    /** Adds a species, or what is known of it more than before; returns what is known. */
    add(species: Species): Species {
        const known = { ...this.species.get(species.key), ...species };
        this.species.set(species.key, known);
        return known;
    }

    /** Adds a child, and the couple of its parents unless it is there; returns the child. */
    addChild(birth: Birth): Species {
        const { a, b, genes } = birth;
        if (!this.couples.has(keyOfCouple(a, b))) this.addCouple(a, b, genes);
        const family = this.get(a).family;
        return this.add({ key: keyOfBirth(birth), birth, ...(family ? { family } : {}) });
    }

    /** Adds a couple, or sets its genes. */
    addCouple(a: string, b: string, genes: Genes, made?: number): Couple {
        const key = keyOfCouple(a, b);
        const last = Math.max(0, ...[...this.couples.values()].map((one) => one.made));
        const couple = { key, a, b, genes, made: made ?? this.couples.get(key)?.made ?? last + 1 };
        this.couples.set(key, couple);
        return couple;
    }

    /** Returns a species; one that is not known yet has its key alone. */
    get(key: string): Species {
        return this.species.get(key) ?? { key };
    }

    couple(key: string): Couple | undefined {
        return this.couples.get(key);
    }

    get all(): { species: Species[]; couples: Couple[] } {
        return { species: [...this.species.values()], couples: [...this.couples.values()] };
    }

    /** Returns 0 for founders and 1 more than the later of its parents for a child. */
    generation(key: string): number {
        const birth = this.get(key).birth;
        return birth ? 1 + Math.max(this.generation(birth.a), this.generation(birth.b)) : 0;
    }

    /** Returns a name: that of a founder, or "F2·14" for the child with seed 14 in the second generation. */
    name(key: string): string {
        const { name, birth } = this.get(key);
        if (birth) return `F${this.generation(key)}·${birth.genes.seed}`;
        return name ?? key;
    }

    /** Returns "Cep × Fly agaric", or "Cep alone" for one that is bred with itself. */
    coupleName({ a, b }: { a: string; b: string }): string {
        return a === b ? `${this.name(a)} alone` : `${this.name(a)} × ${this.name(b)}`;
    }

    /** Returns where a child comes from: "of Cep × Fly agaric", "mutated from F1·2". */
    descent({ a, b }: { a: string; b: string }): string {
        return a === b ? `mutated from ${this.name(a)}` : `of ${this.name(a)} × ${this.name(b)}`;
    }

    /** Returns the parent of a couple that stands for it in the tree: its youngest. */
    childOf({ a, b }: Couple): string {
        return this.generation(b) > this.generation(a) ? b : a;
    }

    /** Returns the couple of whose children one is in this couple; undefined for founders. */
    origin(couple: Couple): Couple | undefined {
        const birth = this.get(this.childOf(couple)).birth;
        return birth && this.couples.get(keyOfCouple(birth.a, birth.b));
    }

    /** Returns the couples that come from a couple, or founders without one, as they were made. */
    offspring(of: Couple | undefined): Couple[] {
        return [...this.couples.values()]
            .filter((one) => this.origin(one)?.key === of?.key)
            .sort((one, other) => one.made - other.made);
    }

    /** Returns all children that these come from, and themselves, parents before children. */
    line(keys: readonly string[]): Species[] {
        const found = new Map<string, Species>();
        const visit = (key: string): void => {
            const one = this.get(key);
            if (!one.birth || found.has(key)) return;
            visit(one.birth.a);
            visit(one.birth.b);
            found.set(key, one);
        };
        for (const key of keys) visit(key);
        return [...found.values()];
    }

    /** Takes a couple and all that come from it off the tree, but for what other branches come from; returns the keys of
     *  what is gone. */
    removeBranch(couple: Couple): { species: string[]; couples: string[] } {
        const branch = new Set<string>();
        const visit = (one: Couple): void => {
            branch.add(one.key);
            this.offspring(one).forEach(visit);
        };
        visit(couple);
        const others = [...this.couples.values()].filter(({ key }) => !branch.has(key));
        const line = this.line(others.flatMap(({ a, b }) => [a, b]));
        const couplesOfLine = new Set(line.map(({ birth }) => keyOfCouple(birth!.a, birth!.b)));
        const couples = [...branch].filter((key) => !couplesOfLine.has(key));
        for (const key of couples) this.couples.delete(key);
        const keysOfLine = new Set(line.map(({ key }) => key));
        const species = [...this.species.values()]
            .filter(({ key, birth }) => birth && !keysOfLine.has(key) && branch.has(keyOfCouple(birth.a, birth.b)))
            .map(({ key }) => key);
        for (const key of species) this.species.delete(key);
        return { species, couples };
    }

    clear(): void {
        this.couples.clear();
        for (const [key, { birth }] of this.species) if (birth) this.species.delete(key);
    }
}
