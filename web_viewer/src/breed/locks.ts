// Tick boxes for the parts that stay as in the first parent, from the schema of a species.
import { make } from "../dom";
import { words } from "../schema";
import type { DocumentSchema } from "../designer/schemas";

export interface Lock {
    name: string;
    label: string;
    description: string;
}

export interface LockGroup {
    label: string;
    locks: Lock[];
}

/** Parts that the schema has no object for. */
const ofWhole: readonly Lock[] = [
    { name: "size", label: "Size", description: "How large it is." },
    { name: "stages", label: "Ages", description: "How many stages it has, at which ages." },
];

function lockOf(path: string, schema: DocumentSchema): Lock {
    const last = path.split(".").at(-1) ?? path;
    return { name: path, label: words(schema.title ?? last), description: schema.description ?? "" };
}

/** A part of parts, such as the surface, is a group; others are one tick box each. */
function isOfParts({ properties = {} }: DocumentSchema): boolean {
    const parts = Object.values(properties);
    return parts.length > 1 && parts.every((part) => part.properties);
}

/** Returns the parts of species of a family that can be locked, by the schema of a species. */
export function locksOf(species: DocumentSchema, family: string): LockGroup[] {
    const whole: LockGroup = { label: "Whole", locks: [...ofWhole] };
    for (const name of ["spread", "ground", "ecology"]) {
        const part = species.properties?.[name];
        if (part) whole.locks.push(lockOf(name, part));
    }
    const shape: LockGroup = { label: "Shape", locks: [] };
    const groups: LockGroup[] = [];
    const take = (name: string, part: DocumentSchema): void => {
        if (part.const !== undefined || name === "form") return;
        if (!isOfParts(part)) return void shape.locks.push(lockOf(name, part));
        const locks = Object.entries(part.properties ?? {}).map(([sub, schema]) => lockOf(`${name}.${sub}`, schema));
        groups.push({ label: words(part.title ?? name), locks });
    };
    const model = species.properties?.["stages"]?.items?.properties?.["model"] ?? {};
    const choices = (model.oneOf ?? []) as DocumentSchema[];
    const form = choices.find(({ properties }) => properties?.["form"]?.const === family) ?? choices[0];
    for (const [name, part] of Object.entries({ ...form?.properties, ...model.properties })) take(name, part);
    return [shape, ...groups, whole];
}

export class LockList {
    private readonly boxes = new Map<string, HTMLInputElement>();
    private readonly smaller = make("fieldset", { hidden: true }, make("legend", {}, "Smaller parts"));

    constructor(
        private readonly host: HTMLElement,
        private readonly changed: (lock: string[]) => void,
    ) {}

    make(groups: readonly LockGroup[]): void {
        this.boxes.clear();
        this.smaller.replaceChildren(...[...this.smaller.children].slice(0, 1));
        this.host.replaceChildren(
            ...groups.map(({ label, locks }) =>
                make("fieldset", {}, make("legend", {}, label), ...locks.map((lock) => this.row(lock))),
            ),
            this.smaller,
        );
    }

    /** Ticks these. A lock on a smaller part, which an address can have, gets a box of its own. */
    show(lock: readonly string[]): void {
        for (const name of lock)
            if (!this.boxes.has(name)) this.smaller.append(this.row({ name, label: name, description: "" }));
        this.smaller.hidden = this.smaller.children.length < 2;
        for (const [name, box] of this.boxes) box.checked = lock.includes(name);
    }

    private row({ name, label, description }: Lock): HTMLElement {
        const box = make("input", { type: "checkbox", name: `lock-${name}`, "data-lock": name });
        box.addEventListener("change", () => this.changed(this.ticked));
        this.boxes.set(name, box);
        return make("label", { class: "check", title: description || undefined }, box, ` ${label}`);
    }

    private get ticked(): string[] {
        return [...this.boxes].filter(([, box]) => box.checked).map(([name]) => name);
    }
}
