// The controls, made from the fields of the schema: native inputs whose `name` is the query name.
import { make } from "./dom";
import { validationError, valueAt, type Field, type Group, type Value } from "./schema";

/** Where the values of controls are. */
export interface ControlledValues {
    /** Those that differ from the owner's, by the name of the field. */
    readonly values: ReadonlyMap<string, Value>;
    field(name: string): Field | undefined;
    /** Sets a value; undefined goes back to the owner's. */
    set(name: string, value: Value | undefined): void;
    /** Returns false for a field that has no effect now. */
    applies(field: Field): boolean;
}

export interface ControlEvents {
    /** A control is being dragged; the settings have the new value already. */
    moving: (field: Field) => void;
    /** A control was released. */
    moved: (field: Field) => void;
    /** A message is shown below this element. */
    errorShown: (element: HTMLElement) => void;
}

type Entry = HTMLInputElement | HTMLSelectElement;

/** Returns the possessive form of a field's owner: "species'", "preset's". */
function ownerOf({ owner }: Field): string {
    return owner.endsWith("s") ? `${owner}'` : `${owner}'s`;
}

class Control {
    readonly row: HTMLElement;
    private readonly entries: Entry[] = [];
    private readonly message = make("p", { class: "validation-error", hidden: true });
    private readonly reset = make("button", { type: "button", class: "reset" }, "↺");

    constructor(
        readonly field: Field,
        private readonly settings: ControlledValues,
        private readonly events: ControlEvents,
    ) {
        const id = `control-${field.name}`;
        const describedBy = `${id}-about ${id}-error`;
        const shared = {
            name: field.name,
            title: field.description || undefined,
            "aria-describedby": describedBy,
        };
        this.message.id = `${id}-error`;
        const label = make(
            "label",
            { for: id, title: field.description || undefined },
            field.label,
        );
        const about = make("p", { class: "about", id: `${id}-about` }, this.aboutText());
        const reset = field.owner ? `Back to the ${ownerOf(field)} own` : "Back to the default";
        this.reset.title = reset;
        this.reset.setAttribute("aria-label", `${field.label}: ${reset.toLowerCase()}`);
        this.reset.addEventListener("click", () => {
            this.settings.set(field.name, undefined);
            this.showError(undefined);
            this.events.moved(field);
            this.entries[0]?.focus();
        });

        const body = make("div", { class: "entry" });
        if (field.kind === "checkbox") {
            body.append(this.listen(make("input", { ...shared, id, type: "checkbox" })));
        } else if (field.kind === "select") {
            const options = field.options.map((option) =>
                make("option", { value: String(option) }, String(option)),
            );
            body.append(this.listen(make("select", { ...shared, id }, ...options)));
        } else if (field.kind === "color") {
            body.append(this.listen(make("input", { ...shared, id, type: "color" })));
        } else if (field.kind === "text") {
            body.append(this.listen(make("input", { ...shared, id, type: "text" })));
        } else {
            const { min, max } = field;
            if (min !== undefined && max !== undefined) {
                body.append(
                    this.listen(
                        make("input", { ...shared, id, type: "range", min, max, step: field.step }),
                    ),
                );
            }
            const number = make("input", {
                ...shared,
                id: this.entries.length ? `${id}-number` : id,
                type: "number",
                min,
                max,
                step: field.integer ? 1 : "any",
                "aria-label": `${field.label}, as a number`,
                inputmode: field.integer ? "numeric" : "decimal",
            });
            body.append(this.listen(number));
        }
        const unit = make("span", { class: "unit", "aria-hidden": true }, field.unit);
        const head = make("div", { class: "head" }, label, this.reset);
        body.append(unit);
        if (field.name === "seed" && field.kind === "number") body.append(this.dice());
        this.row = make(
            "div",
            { class: `control ${field.kind}`, "data-name": field.name },
            head,
            body,
            about,
            this.message,
        );
        this.row.classList.toggle("integer", field.integer);
    }

    /** Shows the value of the settings, or else the species' own. */
    show(effective: unknown): void {
        const set = this.settings.values.get(this.field.name);
        const own = this.field.owner ? valueAt(effective, this.field.name) : this.field.fallback;
        const value = set ?? own;
        this.row.classList.toggle("set", set !== undefined);
        this.row.classList.toggle("inherited", set === undefined && this.field.owner !== "");
        this.reset.hidden = set === undefined;
        // Hides what the species cannot have. What follows from another parameter may have no value.
        const isOfSpecies =
            this.field.owner !== "" && this.settings.field(this.field.owner) === undefined;
        this.row.hidden =
            !this.settings.applies(this.field) ||
            (isOfSpecies && set === undefined && effective !== undefined && own === undefined);
        for (const entry of this.entries) {
            if (entry instanceof HTMLInputElement && entry.type === "checkbox") {
                entry.checked = value === true;
            } else if (
                document.activeElement !== entry ||
                entry.type !== "number" ||
                Number(entry.value) !== value
            ) {
                entry.value = value === undefined ? "" : this.text(value, entry);
            }
            if (entry.type === "range") this.fill(entry as HTMLInputElement, value);
        }
    }

    showError(detail: string | undefined): void {
        this.message.hidden = detail === undefined;
        this.message.textContent = detail ?? "";
        this.row.classList.toggle("failed", detail !== undefined);
        if (detail !== undefined) this.row.hidden = false;
        for (const entry of this.entries) {
            if (detail === undefined) entry.removeAttribute("aria-invalid");
            else entry.setAttribute("aria-invalid", "true");
        }
    }

    private aboutText(): string {
        const { field } = this;
        const range =
            field.min !== undefined && field.max !== undefined
                ? `${field.min} to ${field.max}`
                : "";
        const span = [range, field.unit].filter(Boolean).join(" ");
        const start = field.owner ? `the ${ownerOf(field)} own unless moved` : "";
        const facts = [span, start].filter(Boolean).join("; ");
        return [field.description, facts && `(${facts})`].filter(Boolean).join(" ");
    }

    /** Rounds values of a species, which have more digits than are readable. */
    private text(value: Value, entry: Entry): string {
        if (
            typeof value !== "number" ||
            entry.type !== "number" ||
            this.settings.values.has(this.field.name)
        ) {
            return String(value);
        }
        return String(this.field.integer ? value : Number(value.toPrecision(3)));
    }

    private fill(range: HTMLInputElement, value: Value | undefined): void {
        const { min = 0, max = 1 } = this.field;
        const part = typeof value === "number" ? (value - min) / (max - min) : 0;
        const zero = min < 0 && max > 0 ? -min / (max - min) : 0;
        range.style.setProperty("--from", `${100 * Math.min(part, zero)}%`);
        range.style.setProperty("--to", `${100 * Math.max(part, zero)}%`);
    }

    private listen<T extends Entry>(entry: T): T {
        this.entries.push(entry);
        entry.addEventListener("input", () => this.take(entry, false));
        entry.addEventListener("change", () => this.take(entry, true));
        return entry;
    }

    private take(entry: Entry, letGo: boolean): void {
        const { field } = this;
        let value: Value;
        if (entry instanceof HTMLInputElement && entry.type === "checkbox") value = entry.checked;
        else if (field.kind === "select")
            value = field.options.find((option) => String(option) === entry.value) ?? "";
        else if (field.kind === "number")
            value = entry.value === "" ? Number.NaN : Number(entry.value);
        else value = entry.value;
        const wrong = validationError(field, value);
        this.showError(wrong);
        if (wrong) return;
        this.settings.set(field.name, value);
        if (letGo) this.events.moved(field);
        else this.events.moving(field);
    }

    private dice(): HTMLElement {
        const button = make(
            "button",
            {
                type: "button",
                class: "dice",
                title: "Another individual",
                "aria-label": "Another individual: a new seed",
            },
            "⚄",
        );
        button.addEventListener("click", () => {
            const { min = 0, max = 0xffffffff } = this.field;
            const random = crypto.getRandomValues(new Uint32Array(1))[0] ?? 0;
            // Short seeds are easier to pass on.
            const span = Math.min(max - min, 99999);
            this.settings.set(this.field.name, min + (random % (span + 1)));
            this.showError(undefined);
            this.events.moved(this.field);
        });
        return button;
    }
}

export class Controls {
    private readonly controls: Control[] = [];
    private readonly sections: { element: HTMLElement; controls: Control[] }[] = [];
    private effective: unknown;

    constructor(
        hostOf: (group: Group) => HTMLElement,
        groups: readonly Group[],
        settings: ControlledValues,
        private readonly events: ControlEvents,
    ) {
        groups.forEach((group, index) => {
            const made = group.fields.map((field) => new Control(field, settings, events));
            const fields = made.map((control) => control.row);
            const title = make("span", {}, group.label);
            const element = make(
                "details",
                { class: "group", open: index < 2, title: group.description || undefined },
                make("summary", {}, title),
                make(
                    "div",
                    { class: "fields", role: "group", "aria-label": group.label },
                    ...fields,
                ),
            );
            const host = hostOf(group);
            element.open ||= host.childElementCount === 0;
            host.append(element);
            this.controls.push(...made);
            this.sections.push({ element, controls: made });
        });
    }

    /** Updates every control to the settings; `effective` are the values that the server reports as
     *  used. */
    show(effective: unknown = this.effective): void {
        this.effective = effective;
        for (const control of this.controls) control.show(effective);
        for (const { element, controls } of this.sections) {
            element.hidden = controls.every((control) => control.row.hidden);
            element.classList.toggle(
                "set",
                controls.some((control) => control.row.classList.contains("set")),
            );
        }
    }

    /** Shows a message next to the control it is about; returns false if there is no such
     *  control. */
    showError(name: string, detail: string): boolean {
        const found = this.controls.find((control) => control.field.name === name);
        if (!found) return false;
        found.showError(detail);
        const details = found.row.closest("details");
        if (details) {
            details.open = true;
            details.hidden = false;
            // The message may be in a panel that is not open.
            this.events.errorShown(details);
        }
        return true;
    }

    clearErrors(): void {
        for (const control of this.controls) control.showError(undefined);
    }
}
