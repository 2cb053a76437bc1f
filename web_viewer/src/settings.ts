// The settings: a species, mix or preset, and the parameters that differ from the defaults. They
// are written to and read from the page's URL and the service's URLs.
import { arcsText, readArcs, type Arc } from "./arcs";
import type { ProblemItem } from "./http";
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
import { validationError, parsed, type Field, type Value } from "./schema";
import { readView, viewNames, viewQuery } from "./view_state";

/** A mix in the service's syntax: "boletus_edulis", "~owner.name@3" or "a:0.7,b:0.3". */
export const mixPattern =
    /^~?[a-z0-9_.]+(@\d+)?(:[0-9.eE+-]+)?(,~?[a-z0-9_.]+(@\d+)?(:[0-9.eE+-]+)?){0,7}$/;

/** State of the morph editor: all shares, zeros included, and the designer's arcs between two
 *  species. */
export interface Morph {
    shares: readonly Share[];
    arcs: readonly Arc[];
}

/** A request of a model. */
export interface ModelRequest {
    address: string;
    /** JSON body, if the settings do not fit into a query: own arcs or rows. */
    body: string | undefined;
    /** Equal for equal requests only. */
    key: string;
}

/** Names in the page's query that are not parameters of the product. */
const pageNames = new Set([
    ...products.map(({ queryName: kind }) => kind),
    ...viewNames,
    "shot",
    "morph",
    "arcs",
    "sheet",
    "rows",
]);

export class Settings {
    mix: string;
    /** Defined while the morph editor is open; `mix` is then the mix of its shares. */
    morph: Morph | undefined;
    /** Custom ramification matrix, sent in a body; undefined for a named one. */
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

    /** Sets a value; undefined, or one that equals the default, removes it. */
    set(name: string, value: Value | undefined): void {
        const field = this.field(name);
        if (!field) return;
        if (value === undefined || (!field.owner && value === field.fallback)) {
            this.values.delete(name);
        } else {
            this.values.set(name, value);
            // Only one of them chooses the level of detail.
            if (name === "lod") this.values.delete("triangles");
            if (name === "triangles") this.values.delete("lod");
        }
    }

    /** Chooses another species or preset and drops the values that replaced the last one's own. */
    choose(mix: string): void {
        this.mix = mix;
        this.rows = undefined;
        for (const field of this.fields) {
            // What follows from another parameter, such as the profile, belongs to no species.
            if (field.owner && !this.field(field.owner)) this.values.delete(field.name);
        }
    }

    /** Returns false for the frames and targets of a clip if there is no clip, and for a number of
     *  triangles if a level of detail replaces it. */
    applies(field: Field, replaced: ReadonlyMap<string, Value> = new Map()): boolean {
        if (field.name === "triangles") return !replaced.has("lod");
        if (field.name !== "frames" && field.name !== "targets") return true;
        const animation = this.field("animation");
        const chosen =
            replaced.get("animation") ?? this.values.get("animation") ?? animation?.fallback;
        return !animation || chosen !== animation.fallback;
    }

    /** Returns the query in schema order; `replaced` overrides single values. */
    query(replaced: ReadonlyMap<string, Value> = new Map()): string {
        const parts: string[] = [];
        for (const field of this.fields) {
            if (!this.applies(field, replaced)) continue;
            const value = replaced.get(field.name) ?? this.values.get(field.name);
            if (value === undefined || (!field.owner && value === field.fallback)) continue;
            parts.push(`${encodeURIComponent(field.name)}=${encodeURIComponent(String(value))}`);
        }
        return parts.join("&");
    }

    /** Returns the values that differ as a JSON body: dotted names become nested objects. */
    nested(replaced: ReadonlyMap<string, Value> = new Map()): Record<string, unknown> {
        const out: Record<string, unknown> = {};
        for (const field of this.fields) {
            if (!this.applies(field, replaced)) continue;
            const value = replaced.get(field.name) ?? this.values.get(field.name);
            if (value === undefined || (!field.owner && value === field.fallback)) continue;
            const path = field.name.split(".");
            let at = out;
            for (const part of path.slice(0, -1)) at = (at[part] ??= {}) as Record<string, unknown>;
            at[path.at(-1)!] = value;
        }
        return out;
    }

    /** Returns the address of the model (".glb") or of its description (".json"). */
    address(suffix: ".glb" | ".json", replaced?: ReadonlyMap<string, Value>): string {
        const query = this.query(replaced);
        return `${this.product.path}/${this.mix}${suffix}${query ? `?${query}` : ""}`;
    }

    setMorph(morph: Morph | undefined): void {
        this.morph = morph;
        if (morph) this.mix = canonicalMix(morph.shares);
    }

    /** Returns the request of the model, as a POST if there are own arcs or rows. */
    request(replaced: ReadonlyMap<string, Value> = new Map()): ModelRequest {
        if (this.rows) {
            const address = `${this.product.path}.glb`;
            // The rows replace the name of a matrix, and limit the order.
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

    /** Returns the values that a draft overrides: linked textures, and level of detail 1 or
     *  coarser. */
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

    /** Returns true if this server makes growth clips. */
    get hasGrowthClips(): boolean {
        return this.field("animation")?.options.includes("growth") ?? false;
    }

    /** Returns the values that a growth clip overrides: animation, and level of detail 1 or
     *  coarser. */
    clipValues(): Map<string, Value> {
        const replaced = new Map<string, Value>([["animation", "growth"]]);
        const lod = this.field("lod");
        if (lod?.max !== undefined && lod.max >= 1) {
            replaced.set("lod", Math.max(Number(this.values.get("lod") ?? lod.fallback ?? 0), 1));
        }
        return replaced;
    }

    /** Returns the page's own query, with what differs from the defaults: "?species=…&age=…". The
     *  state of the views is that of the `current` one. */
    pageQuery(current: URLSearchParams): string {
        const query = this.query();
        const shot = current.get("shot");
        const alone = shot ? `&shot=${encodeURIComponent(shot)}` : "";
        const arcs =
            this.morph?.shares.length === 2 && this.morph.arcs.length
                ? `&arcs=${arcsText(this.morph.arcs)}`
                : "";
        const what = this.morph
            ? `morph=${sharesText(this.morph.shares)}${arcs}`
            : `${this.product.queryName}=${this.mix}`;
        const rows = this.rows ? `&rows=${rowsText(this.rows)}` : "";
        const parameters = query ? `&${query}` : "";
        const views = viewQuery(readView(current));
        return `?${what}${rows}${parameters}${views}${alone}`;
    }

    /** Reads a custom matrix from the page's query; returns what it could not use. */
    readMatrix(query: URLSearchParams): ProblemItem[] {
        this.rows = undefined;
        const text = query.get("rows");
        if (text === null || !this.product.hasMatrix) return [];
        this.rows = readRows(text);
        return this.rows
            ? []
            : [
                  {
                      parameter: "rows",
                      detail:
                          `'${text}' is no matrix: ` +
                          "rows of 2, 3 and so on shares, as in 0.5,0.5;0.25,0.5,0.25",
                  },
              ];
    }

    /** Reads the morph from the page's query; `known` returns true for species of this server.
     *  Returns what it could not use. */
    readMorph(query: URLSearchParams, known: (id: string) => boolean): ProblemItem[] {
        this.morph = undefined;
        const text = query.get("morph");
        if (text === null) return [];
        const shares = readShares(text);
        if (!shares)
            return [
                { parameter: "morph", detail: `'${text}' is no list of species and their shares` },
            ];
        const missing = shares.find(({ id }) => !known(id));
        if (missing) return [{ parameter: "morph", detail: `'${missing.id}' is no species here` }];
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

    /** Reads the parameters of a query of the page or of a canonical URL; returns what it could not
     *  use. */
    read(query: URLSearchParams): ProblemItem[] {
        const rejected: ProblemItem[] = [];
        this.values.clear();
        for (const [name, text] of query) {
            if (pageNames.has(name) || name === "v") continue;
            const field = this.field(name);
            if (!field) {
                rejected.push({
                    parameter: name,
                    detail: `'${name}' is no parameter of a ${this.product.noun}`,
                });
                continue;
            }
            const value = parsed(field, text);
            const wrong = value === undefined ? "cannot be read" : validationError(field, value);
            if (value === undefined || wrong) {
                rejected.push({ parameter: name, detail: `'${text}' ${wrong}` });
            } else {
                this.set(name, value);
            }
        }
        return rejected;
    }
}
