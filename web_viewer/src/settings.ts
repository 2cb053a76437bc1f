// What the person asks for: a species (or a mix) and the parameters that differ from what the
// server would take anyway. It is written to and read from the page's URL and the service's URLs.
import { fault, parsed, type Field, type Value } from "./schema";

export interface Fault {
    parameter: string;
    detail: string;
}

/** A mix as the service spells it: "boletus_edulis" or "a:0.7,b:0.3". */
export const mixPattern = /^[a-z0-9_]+(:[0-9.eE+-]+)?(,[a-z0-9_]+(:[0-9.eE+-]+)?){0,7}$/;

/** The page's own query names, which are no parameters of a mushroom. */
const pageNames = new Set(["species", "shot"]);

export class Settings {
    mix: string;
    readonly values = new Map<string, Value>();

    constructor(readonly fields: readonly Field[], mix: string) {
        this.mix = mix;
    }

    field(name: string): Field | undefined {
        return this.fields.find((field) => field.name === name);
    }

    /** Takes a value over; one that equals the default is the same as none. */
    set(name: string, value: Value | undefined): void {
        const field = this.field(name);
        if (!field) return;
        if (value === undefined || (!field.fromSpecies && value === field.fallback)) {
            this.values.delete(name);
        } else {
            this.values.set(name, value);
        }
    }

    /** Another species brings its own shape: what was set on top of the last one's is dropped. */
    choose(mix: string): void {
        this.mix = mix;
        for (const field of this.fields) {
            if (field.fromSpecies) this.values.delete(field.name);
        }
    }

    /** Query in schema order; `replaced` stands in for single values. */
    query(replaced: ReadonlyMap<string, Value> = new Map()): string {
        const parts: string[] = [];
        for (const field of this.fields) {
            const value = replaced.get(field.name) ?? this.values.get(field.name);
            if (value === undefined || (!field.fromSpecies && value === field.fallback)) continue;
            parts.push(`${encodeURIComponent(field.name)}=${encodeURIComponent(String(value))}`);
        }
        return parts.join("&");
    }

    /** Address of the model, ".glb" or ".json". */
    address(suffix: ".glb" | ".json", replaced?: ReadonlyMap<string, Value>): string {
        const query = this.query(replaced);
        return `/v1/mushrooms/${this.mix}${suffix}${query ? `?${query}` : ""}`;
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
        return replaced;
    }

    /** The page's own query: ?species=…&age=…, only what differs. */
    pageQuery(kept: URLSearchParams): string {
        const query = this.query();
        const shot = kept.get("shot");
        return `?species=${this.mix}${query ? `&${query}` : ""}${shot ? `&shot=${encodeURIComponent(shot)}` : ""}`;
    }

    /** Reads a query of the page or of a canonical URL; returns what it could not use. */
    read(query: URLSearchParams): Fault[] {
        const faults: Fault[] = [];
        this.values.clear();
        for (const [name, text] of query) {
            if (pageNames.has(name) || name === "v") continue;
            const field = this.field(name);
            if (!field) {
                faults.push({ parameter: name, detail: `'${name}' is no parameter of a mushroom` });
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
