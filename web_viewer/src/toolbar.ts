// The toolbar over the stage: views, close-ups, levels of detail, wireframe and wind.
import type { LookName } from "./camera";
import { closeUpNames, type CloseUpName } from "./close_ups";
import { byId, make } from "./dom";
import { valueAt } from "./schema";
import type { Settings } from "./settings";
import type { Stage } from "./stage";

export interface ToolbarEvents {
    view: (name: LookName) => void;
    /** A variant of the material was chosen; "" for the requested one. */
    variant: (name: string) => void;
    /** Another level of detail was chosen; the settings have it already. */
    lodChosen: () => void;
}

const viewLabels: Record<LookName, string> = {
    "three-quarter": "¾",
    front: "Front",
    side: "Side",
    top: "Top",
    below: "Below",
    roots: "Roots",
    margin: "Margin",
    underside: "Underside",
    base: "Base",
};

const viewTitles: Partial<Record<LookName, string>> = {
    "three-quarter": "The whole, from the front and the side",
    roots: "Roots and stems from above, without what stands on them",
    margin: "Close-up of the margin",
    underside: "Close-up of the underside",
    base: "Close-up of the base",
};

/** Levels of detail have a button each if there are at most this many. */
const mostLods = 8;

/** Lets a button switch between on and off. */
function makeToggle(id: string, act: (on: boolean) => void): void {
    const button = byId<HTMLButtonElement>(id);
    button.addEventListener("click", () => {
        const on = button.getAttribute("aria-pressed") !== "true";
        button.setAttribute("aria-pressed", String(on));
        act(on);
    });
}

export class Toolbar {
    private readonly views = new Map<LookName, HTMLButtonElement>();
    private readonly lods = new Map<number, HTMLButtonElement>();

    constructor(
        private readonly settings: Settings,
        stage: Stage,
        private readonly events: ToolbarEvents,
    ) {
        this.makeViews();
        this.makeLods();
        makeToggle("wireframe", (on) => (stage.wireframe = on));
        makeToggle("breeze", (on) => (stage.swaying = on));
        const select = byId<HTMLSelectElement>("variant");
        select.addEventListener("change", () => this.events.variant(select.value));
    }

    /** Views and close-ups with a button, in its order; keys count them from 1. */
    get looks(): readonly LookName[] {
        return [...this.settings.product.views, ...closeUpNames];
    }

    /** Marks the view that the camera has; undefined for one of the user's own. */
    markView(name: LookName | undefined): void {
        for (const [look, button] of this.views)
            button.setAttribute("aria-pressed", String(look === name));
    }

    /** Offers a close-up, or says why there is none. */
    offerCloseUp(name: CloseUpName, missing: string | undefined): void {
        const button = this.views.get(name);
        if (!button) return;
        button.disabled = missing !== undefined;
        button.title = missing ?? this.titleOf(name);
    }

    /** Offers the variants of the material of a model, the requested one first. */
    offerVariants(names: readonly string[]): void {
        const select = byId<HTMLSelectElement>("variant");
        select.hidden = names.length === 0;
        select.replaceChildren(
            make("option", { value: "" }, "As requested"),
            ...names.map((name) => make("option", { value: name }, name)),
        );
    }

    /** Shows the button of wind if the model has its weights. */
    offerWind(offered: boolean): void {
        byId("breeze").hidden = !offered;
    }

    /** Marks the level of detail of the settings; without one, that of the values that the server
     *  reports as `effective`, which a profile may have chosen. */
    markLod(effective?: unknown): void {
        const lod = this.settings.values.get("lod") ?? valueAt(effective, "lod") ?? 0;
        for (const [level, button] of this.lods) {
            button.setAttribute("aria-pressed", String(level === lod));
        }
    }

    private makeViews(): void {
        for (const [index, name] of this.looks.entries()) {
            const attributes = {
                type: "button",
                title: this.titleOf(name),
                "data-view": name,
                "aria-pressed": "false",
                "aria-keyshortcuts": index + 1,
            };
            const button = make("button", attributes, viewLabels[name]);
            button.addEventListener("click", () => this.events.view(name));
            byId(closeUpNames.some((one) => one === name) ? "close-ups" : "views").append(button);
            this.views.set(name, button);
        }
    }

    private titleOf(name: LookName): string {
        const key = this.looks.indexOf(name) + 1;
        return `${viewTitles[name] ?? `Look from: ${name}`} (key ${key} on the picture)`;
    }

    private makeLods(): void {
        const lod = this.settings.field("lod");
        if (lod?.min === undefined || lod.max === undefined || lod.max - lod.min >= mostLods) {
            byId("lods").hidden = true;
            return;
        }
        for (let level = lod.min; level <= lod.max; ++level) {
            const title = `Level of detail ${level}`;
            const attributes = { type: "button", "aria-pressed": "false", title };
            const button = make("button", attributes, `L${level}`);
            button.addEventListener("click", () => {
                this.settings.set("lod", level);
                this.events.lodChosen();
            });
            this.lods.set(level, button);
            byId("lods").append(button);
        }
    }
}
