// What the person asks for: a species (or a mix) and the parameters that differ from what the
// server would take anyway. It is written to and read from the page's URL and the service's URLs.
import { arcsText, readArcs, type Arc } from "./arcs";
import {
    canonicalMix,
    fewestMembers,
    mostMembers,
    readShares,
    sharesText,
    type Share,
} from "./mix";
import { mushrooms, products, type Product } from "./products";
import { readRows, rowsText } from "./rows";
import { fault, parsed, type Field, type Value } from "./schema";

export interface Fault {
    parameter: string;
    detail: string;
}

/** A mix as the service spells it: "boletus_edulis" or "a:0.7,b:0.3". */
export const mixPattern = /^[a-z0-9_]+(:[0-9.eE+-]+)?(,[a-z0-9_]+(:[0-9.eE+-]+)?){0,7}$/;

/** What stands on the morph bench: every share, also those of nothing, and the designer's arcs between two. */
export interface Morph {
    shares: readonly Share[];
    arcs: readonly Arc[];
}

/** What is asked of the service. */
export interface Wanted {
    address: string;
    /** JSON, where own arcs have to be told. */
    body: string | undefined;
    /** Tells one model from another. */
    key: string;
}

/** The page's own query names, which are no parameters of what grows. */
const pageNames = new Set([
    ...products.map(({ kind }) => kind),
    "shot",
    "morph",
    "arcs",
    "sheet",
    "rows",
]);

export class Settings {
    mix: string;
    /** While the bench is open; `mix` is then what its shares make. */
    morph: Morph | undefined;
    /** A matrix of one's own, told in a body; undefined for the one of the settings. */
    rows: readonly (readonly number[])[] | undefined;
    readonly values = new Map<string, Value>();

    constructor(
        readonly fields: readonly Field[],
        mix: string,
        readonly product: Product = mushrooms,
    ) {
        this.mix = mix;
    }

    field(name: string): Field | undefined {
        return this.fields.find((field) => field.name === name);
    }

    /** Takes a value over; one that equals the default is the same as none. */
    set(name: string, value: Value | undefined): void {
        const field = this.field(name);
        if (!field) return;
        if (value === undefined || (!field.owner && value === field.fallback)) {
            this.values.delete(name);
        } else {
            this.values.set(name, value);
        }
    }

    /** Another species brings its own shape: what was set on top of the last one's is dropped. */
    choose(mix: string): void {
        this.mix = mix;
        this.rows = undefined;
        for (const field of this.fields) {
            if (field.owner) this.values.delete(field.name);
        }
    }

    /** Whether a field says anything: the frames of a clip do not while there is none. */
    matters(field: Field, replaced: ReadonlyMap<string, Value> = new Map()): boolean {
        if (field.name !== "frames") return true;
        const animation = this.field("animation");
        const chosen =
            replaced.get("animation") ?? this.values.get("animation") ?? animation?.fallback;
        return !animation || chosen !== animation.fallback;
    }

    /** Query in schema order; `replaced` stands in for single values. */
    query(replaced: ReadonlyMap<string, Value> = new Map()): string {
        const parts: string[] = [];
        for (const field of this.fields) {
            if (!this.matters(field, replaced)) continue;
            const value = replaced.get(field.name) ?? this.values.get(field.name);
            if (value === undefined || (!field.owner && value === field.fallback)) continue;
            parts.push(`${encodeURIComponent(field.name)}=${encodeURIComponent(String(value))}`);
        }
        return parts.join("&");
    }

    /** The values that differ, as the JSON body of a request: dotted names become objects. */
    private nested(replaced: ReadonlyMap<string, Value>): Record<string, unknown> {
        const out: Record<string, unknown> = {};
        for (const field of this.fields) {
            if (!this.matters(field, replaced)) continue;
            const value = replaced.get(field.name) ?? this.values.get(field.name);
            if (value === undefined || (!field.owner && value === field.fallback)) continue;
            const path = field.name.split(".");
            let at = out;
            for (const part of path.slice(0, -1)) at = (at[part] ??= {}) as Record<string, unknown>;
            at[path.at(-1)!] = value;
        }
        return out;
    }

    /** Address of the model, ".glb" or ".json". */
    address(suffix: ".glb" | ".json", replaced?: ReadonlyMap<string, Value>): string {
        const query = this.query(replaced);
        return `${this.product.path}/${this.mix}${suffix}${query ? `?${query}` : ""}`;
    }

    setMorph(morph: Morph | undefined): void {
        this.morph = morph;
        if (morph) this.mix = canonicalMix(morph.shares);
    }

    /** The model, with the designer's own arcs where there are any. */
    wanted(replaced: ReadonlyMap<string, Value> = new Map()): Wanted {
        if (this.rows) {
            const address = `${this.product.path}.glb`;
            // What the matrix is and how high it reaches is said by the rows.
            const { matrix: _, blend: __, order, ...rest } = this.nested(replaced);
            const reached = Math.min(Number(order ?? this.rows.length + 1), this.rows.length + 1);
            const body = JSON.stringify({
                preset: this.mix,
                ...rest,
                order: reached,
                rows: this.rows,
            });
            return { address, body, key: address + body };
        }
        const [a, b] = this.morph?.shares ?? [];
        const between = this.morph?.shares.length === 2 && a && b && a.weight > 0 && b.weight > 0;
        if (!between || !this.morph?.arcs.length) {
            const address = this.address(".glb", replaced);
            return { address, body: undefined, key: address };
        }
        const address = `v1/morphs/${a.id}/${b.id}.glb`;
        const body = JSON.stringify({
            t: b.weight,
            arcs: this.morph.arcs,
            ...this.nested(replaced),
        });
        return { address, body, key: address + body };
    }

    /** What a drag asks for: linked textures and at most the second level of detail. */
    draftValues(linked: boolean): Map<string, Value> {
        const replaced = new Map<string, Value>();
        const lod = this.field("lod");
        if (lod?.max !== undefined && lod.max >= 1) {
            const chosen = Number(this.values.get("lod") ?? lod.fallback ?? 0);
            replaced.set("lod", Math.max(chosen, 1));
        }
        const textures = this.field("textures");
        const chosen = this.values.get("textures") ?? textures?.fallback;
        if (linked && textures?.options.includes("linked") && chosen === "embedded") {
            replaced.set("textures", "linked");
        }
        const still = this.field("animation")?.fallback;
        if (still !== undefined) replaced.set("animation", still);
        return replaced;
    }

    /** Whether this server makes clips of growth. */
    get grows(): boolean {
        return this.field("animation")?.options.includes("growth") ?? false;
    }

    /** What playing asks for: the growth of these settings, at most at the second level of detail. */
    clipValues(): Map<string, Value> {
        const replaced = new Map<string, Value>([["animation", "growth"]]);
        const lod = this.field("lod");
        if (lod?.max !== undefined && lod.max >= 1) {
            replaced.set("lod", Math.max(Number(this.values.get("lod") ?? lod.fallback ?? 0), 1));
        }
        return replaced;
    }

    /** The page's own query: ?species=…&age=…, only what differs. */
    pageQuery(kept: URLSearchParams): string {
        const query = this.query();
        const shot = kept.get("shot");
        const arcs =
            this.morph?.shares.length === 2 && this.morph.arcs.length
                ? `&arcs=${arcsText(this.morph.arcs)}`
                : "";
        const what = this.morph
            ? `morph=${sharesText(this.morph.shares)}${arcs}`
            : `${this.product.kind}=${this.mix}`;
        const rows = this.rows ? `&rows=${rowsText(this.rows)}` : "";
        return `?${what}${rows}${query ? `&${query}` : ""}${shot ? `&shot=${encodeURIComponent(shot)}` : ""}`;
    }

    /** Reads the matrix of one's own out of the page's query. */
    readMatrix(query: URLSearchParams): Fault[] {
        this.rows = undefined;
        const text = query.get("rows");
        if (text === null || !this.product.ramifies) return [];
        this.rows = readRows(text);
        return this.rows
            ? []
            : [
                  {
                      parameter: "rows",
                      detail: `'${text}' is no matrix: rows of 2, 3 and so on shares, as in 0.5,0.5;0.25,0.5,0.25`,
                  },
              ];
    }

    /** Reads the bench's part of the page's query; `known` says whether a species is there. */
    readMorph(query: URLSearchParams, known: (id: string) => boolean): Fault[] {
        this.morph = undefined;
        const text = query.get("morph");
        if (text === null) return [];
        const shares = readShares(text);
        if (!shares)
            return [
                { parameter: "morph", detail: `'${text}' is no list of species and their shares` },
            ];
        const stranger = shares.find(({ id }) => !known(id));
        if (stranger)
            return [{ parameter: "morph", detail: `'${stranger.id}' is no species here` }];
        if (shares.length < fewestMembers || shares.length > mostMembers) {
            return [
                {
                    parameter: "morph",
                    detail: `a morph has ${fewestMembers} to ${mostMembers} species`,
                },
            ];
        }
        const written = query.get("arcs") ?? "";
        const arcs = shares.length === 2 ? readArcs(written) : undefined;
        this.setMorph({ shares, arcs: arcs ?? [] });
        return arcs || written === ""
            ? []
            : [{ parameter: "arcs", detail: `'${written}' are no arcs between two species` }];
    }

    /** Reads a query of the page or of a canonical URL; returns what it could not use. */
    read(query: URLSearchParams): Fault[] {
        const faults: Fault[] = [];
        this.values.clear();
        for (const [name, text] of query) {
            if (pageNames.has(name) || name === "v") continue;
            const field = this.field(name);
            if (!field) {
                faults.push({
                    parameter: name,
                    detail: `'${name}' is no parameter of a ${this.product.noun}`,
                });
                continue;
            }
            const value = parsed(field, text);
            const wrong = value === undefined ? "cannot be read" : fault(field, value);
            if (value === undefined || wrong) {
                faults.push({ parameter: name, detail: `'${text}' ${wrong}` });
            } else {
                this.set(name, value);
            }
        }
        return faults;
    }
}
