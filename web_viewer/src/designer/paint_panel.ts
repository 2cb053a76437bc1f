// The panel of colours: a ramp and single colours of each part, an eyedropper for each of them, and
// whether a part has the photograph's image or is painted.
import { byId, draw, make } from "../dom";
import { modelPointer, type Details } from "./details";
import {
    fewestStops,
    hasImage,
    painted,
    paintedParts,
    paintOf,
    rampOf,
    readColour,
    withoutStop,
    withStop,
    type PaintedPart,
} from "./paint";
import type { DocumentSchema } from "./schemas";
import type { Species } from "./service";

export interface PaintEvents {
    /** A colour is being chosen. */
    moving: (changes: Details) => void;
    /** One step of undo; values that are listed are again as they were traced or opened. */
    changed: (changes: Details, restored: readonly string[]) => void;
    /** Lets a place of the photograph be chosen; undefined if it is given up. */
    pick: (name: string) => Promise<string | undefined>;
    said: (text: string) => void;
}

/** What is painted most often; the rest is in a list that can be opened. */
const mainParts = new Set(["surface/cap", "surface/stem", "surface/hymenium"]);
const mainColours = new Set(["top", "base", "colour", "edge", "depth"]);

export class PaintPanel {
    private readonly host = byId("paint");
    private readonly everyAge = byId<HTMLInputElement>("every-age");
    private parts: PaintedPart[] = [];
    private species: Species | undefined;
    private own: Species | undefined;
    private stage = 0;
    private canPick = false;
    private open = false;

    constructor(private readonly events: PaintEvents) {}

    use(model: DocumentSchema): void {
        this.parts = paintedParts(model);
        this.redraw();
    }

    /** Shows the colours of a stage; `own` is the species without changes. */
    show(
        species: Species | undefined,
        own: Species | undefined,
        stage: number,
        canPick: boolean,
    ): void {
        this.species = species;
        this.own = own;
        this.stage = stage;
        this.canPick = canPick;
        this.redraw();
    }

    private get models(): readonly Species["stages"][number]["model"][] {
        return (this.species?.stages ?? []).map(({ model }) => model);
    }

    private redraw(): void {
        const focused = document.activeElement?.id;
        const model = this.models[this.stage];
        if (!model) return this.host.replaceChildren();
        const rest = make("details", { class: "group" }, make("summary", {}, "More colours"));
        rest.open = this.open;
        rest.addEventListener("toggle", () => (this.open = rest.open));
        const main: HTMLElement[] = [];
        for (const part of this.parts) {
            if (mainParts.has(part.member)) main.push(this.section(part, model));
            const others = part.colours.filter(({ member }) => !this.isMain(part, member));
            if (others.length === 0) continue;
            rest.append(
                make("h3", {}, part.label),
                ...others.map((paint) => this.single(part, model, paint)),
            );
        }
        this.host.replaceChildren(...main, rest);
        if (focused && this.host.querySelector(`#${CSS.escape(focused)}`)) byId(focused).focus();
    }

    private isMain({ member: part }: PaintedPart, member: string): boolean {
        return mainParts.has(part) && mainColours.has(member.split("/").at(-1) ?? "");
    }

    private section(part: PaintedPart, model: unknown): HTMLElement {
        const rows: HTMLElement[] = [];
        if (part.hasImage) rows.push(...this.sources(part, model));
        if (part.ramp) {
            const ramp = rampOf(model, part);
            const strip = make("div", { class: "ramp", "aria-hidden": true });
            strip.style.setProperty("--ramp", ramp.join(","));
            rows.push(strip, ...ramp.map((_, at) => this.stop(part, ramp, at)));
            const add = make("button", { type: "button", id: "add-stop" }, "Add a colour");
            add.disabled = ramp.length >= part.ramp.most;
            add.title = `At most ${part.ramp.most}, as many in all stages`;
            add.addEventListener("click", () => {
                this.changeStops(part, (stops) => withStop(stops, Math.max(stops.length - 2, 0)));
                this.events.said("A colour was added, in all stages.");
            });
            rows.push(add);
        }
        for (const paint of part.colours)
            if (this.isMain(part, paint.member)) rows.push(this.single(part, model, paint));
        return make(
            "section",
            { "aria-label": part.label },
            make("h3", { title: part.description || undefined }, part.label),
            ...rows,
        );
    }

    /** The choice between the photograph's image and paint, where there is one. */
    private sources(part: PaintedPart, model: unknown): HTMLElement[] {
        const traced = this.own?.stages[this.stage]?.model;
        if (!hasImage(traced, part)) return [];
        const pointer = modelPointer(this.stage, `${part.member}/image`);
        const now = hasImage(model, part);
        const button = (label: string, pressed: boolean, act: () => void): HTMLElement => {
            const id = `source-${part.member.replaceAll("/", "-")}-${pressed === now ? "image" : "paint"}`;
            const made = make(
                "button",
                { type: "button", id, "aria-pressed": String(pressed) },
                label,
            );
            made.addEventListener("click", () => {
                if (!pressed) act();
            });
            return made;
        };
        return [
            make(
                "div",
                { class: "segments", role: "group", "aria-label": `${part.label}: skin` },
                button("From photo", now, () => this.events.changed({}, [pointer])),
                button("Painted", !now, () => this.events.changed({ [pointer]: undefined }, [])),
            ),
        ];
    }

    private inStages(stage: number): boolean {
        return this.everyAge.checked || stage === this.stage;
    }

    private changeStops(part: PaintedPart, changed: (ramp: string[]) => string[]): void {
        if (!part.ramp) return;
        const changes = painted(this.models, part, part.ramp.member, (model) =>
            changed(rampOf(model, part)),
        );
        this.events.changed(changes, []);
    }

    private stop(part: PaintedPart, ramp: readonly string[], at: number): HTMLElement {
        const member = part.ramp?.member ?? "";
        const place = at === 0 ? "Apex" : at === ramp.length - 1 ? "Margin" : `Colour ${at + 1}`;
        const row = this.row(
            `${member}/${at}`,
            part.label,
            place,
            part.ramp?.description ?? "",
            ramp[at] ?? "#000000",
            (colour) =>
                painted(this.models, part, member, (model, stage) =>
                    this.inStages(stage)
                        ? rampOf(model, part).map((old, index) => (index === at ? colour : old))
                        : undefined,
                ),
        );
        const off = make(
            "button",
            { type: "button", class: "off", "aria-label": `Remove colour ${at + 1} in all stages` },
            "×",
        );
        off.disabled = ramp.length <= fewestStops;
        off.addEventListener("click", () => {
            this.changeStops(part, (stops) => withoutStop(stops, at));
            this.events.said("The colour was removed, in all stages.");
        });
        row.append(off);
        return row;
    }

    private single(
        part: PaintedPart,
        model: unknown,
        paint: PaintedPart["colours"][number],
    ): HTMLElement {
        return this.row(
            paint.member,
            part.label,
            paint.label,
            paint.description,
            paintOf(model, paint),
            (colour) =>
                painted(this.models, part, paint.member, (_, stage) =>
                    this.inStages(stage) ? colour : undefined,
                ),
        );
    }

    private row(
        member: string,
        part: string,
        label: string,
        description: string,
        value: string,
        changes: (colour: string) => Details,
    ): HTMLElement {
        const id = `paint-${member.replaceAll("/", "-")}`;
        const name = `${part}, ${label.toLowerCase()}`;
        const swatch = make("input", {
            type: "color",
            id,
            value: value.toLowerCase(),
            "aria-label": name,
        });
        const text = make("input", {
            type: "text",
            id: `${id}-text`,
            value,
            maxlength: 7,
            spellcheck: "false",
            "aria-label": `${name}, as #RRGGBB`,
        });
        swatch.addEventListener("input", () => {
            const colour = readColour(swatch.value);
            if (!colour) return;
            text.value = colour;
            this.events.moving(changes(colour));
        });
        const take = (colour: string): void => {
            if (colour !== value) this.events.changed(changes(colour), []);
        };
        swatch.addEventListener("change", () => take(readColour(swatch.value) ?? value));
        text.addEventListener("change", () => {
            const colour = readColour(text.value);
            text.setAttribute("aria-invalid", String(!colour));
            if (colour) take(colour);
            else
                this.events.said(
                    `"${text.value}" is no colour; six digits are needed, as #C8A078.`,
                );
        });
        const row = make(
            "div",
            { class: "paint-row" },
            make("label", { for: id, title: description || undefined }, label),
            swatch,
            text,
        );
        if (!this.canPick) return row;
        const pipette = make(
            "button",
            {
                type: "button",
                class: "pipette",
                title: "From the photograph",
                "aria-label": `${name}: from the photograph`,
            },
            draw(
                "svg",
                { viewBox: "0 0 20 20", "aria-hidden": "true" },
                draw("path", { d: "M4 16l1-3 7-7 2 2-7 7zM11 5l1.5-1.5a1.9 1.9 0 0 1 3 3L14 8" }),
            ),
        );
        pipette.addEventListener("click", () => {
            void this.events.pick(name).then((colour) => {
                if (colour) take(colour);
                byId(id).focus();
            });
        });
        row.append(pipette);
        return row;
    }
}
