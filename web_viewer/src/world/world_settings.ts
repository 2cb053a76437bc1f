// The world that the page shows: a preset and the parameters that differ from it, to and from the text that names it
// in URLs. Pure.
import type { ControlledValues } from "../controls";
import type { ProblemItem } from "../http";
import { parsed, validationError, type Field, type Value } from "../schema";

/** Escapes a value as a path has it: the signs of lists stay as they are. */
function escaped(value: Value): string {
    return encodeURIComponent(String(value)).replaceAll("%2B", "+").replaceAll("%3A", ":");
}

export class WorldSettings implements ControlledValues {
    readonly values = new Map<string, Value>();

    constructor(
        readonly fields: readonly Field[],
        public preset: string,
    ) {}

    field(name: string): Field | undefined {
        return this.fields.find((field) => field.name === name);
    }

    set(name: string, value: Value | undefined): void {
        const field = this.field(name);
        if (!field) return;
        if (value === undefined || (!field.owner && value === field.fallback)) this.values.delete(name);
        else this.values.set(name, value);
    }

    applies(): boolean {
        return true;
    }

    /** Chooses another preset. What replaced values of the last one is dropped; seed and size stay. */
    choose(preset: string): void {
        this.preset = preset;
        for (const { name, owner } of this.fields) if (owner) this.values.delete(name);
    }

    /** Returns the length of each side of the world, metres. */
    get extent(): number {
        return Number(this.values.get("extent") ?? this.field("extent")?.fallback ?? 1024);
    }

    /** Returns the text that names the world in a path: "beech,seed=7,climate.rain=600". */
    get text(): string {
        const pairs = this.fields.flatMap(({ name }) => {
            const value = this.values.get(name);
            return value === undefined ? [] : [`,${name}=${escaped(value)}`];
        });
        return this.preset + pairs.join("");
    }

    /** Reads such a text, without escapes. Returns what it could not use.
     *
     *  presets  those of this server; the first replaces an unknown one */
    read(text: string, presets: readonly string[]): ProblemItem[] {
        const rejected: ProblemItem[] = [];
        const [preset = "", ...pairs] = text.split(",");
        this.values.clear();
        if (!presets.includes(preset)) rejected.push({ parameter: "world", detail: `'${preset}' is no world here` });
        this.preset = presets.includes(preset) ? preset : (presets[0] ?? preset);
        for (const pair of pairs) {
            const [name = "", ...rest] = pair.split("=");
            if (name === "v") continue;
            const field = this.field(name);
            if (!field) {
                rejected.push({ parameter: name, detail: `'${name}' is no parameter of a world` });
                continue;
            }
            const value = parsed(field, rest.join("="));
            const wrong = value === undefined ? "cannot be read" : validationError(field, value);
            if (value === undefined || wrong) rejected.push({ parameter: name, detail: `'${rest.join("=")}' ${wrong}` });
            else this.set(name, value);
        }
        return rejected;
    }
}
