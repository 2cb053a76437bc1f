// The toolbar over the stage: views, levels of detail, wireframe, wind and dusk.
import type { ViewName } from "./camera";
import { byId, make } from "./dom";
import { valueAt } from "./schema";
import type { Settings } from "./settings";
import type { Stage } from "./stage";

export interface ToolbarEvents {
    view: (name: ViewName) => void;
    /** A variant of the material was chosen; "" for the requested one. */
    variant: (name: string) => void;
    /** Another level of detail was chosen; the settings have it already. */
    lodChosen: () => void;
}

const viewLabels: Record<ViewName, string> = {
    "three-quarter": "¾",
    front: "Front",
    side: "Side",
    top: "Top",
    below: "Below",
    roots: "Roots",
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

/** Switches the colours of page and stage between day and dusk. */
function setDusk(stage: Stage, dusk: boolean): void {
    document.documentElement.classList.toggle("dusk", dusk);
    const style = getComputedStyle(document.documentElement);
    stage.setColours(
        style.getPropertyValue("--rule").trim(),
        style.getPropertyValue("--shade").trim(),
    );
}

export class Toolbar {
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
        makeToggle("night", (on) => setDusk(stage, on));
        setDusk(stage, false);
        const select = byId<HTMLSelectElement>("variant");
        select.addEventListener("change", () => this.events.variant(select.value));
    }

    /** Marks the view of the roots, the only one that hides a part of the model. */
    markView(name: ViewName): void {
        const button = byId("views").querySelector('[data-view="roots"]');
        button?.setAttribute("aria-pressed", String(name === "roots"));
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
        for (const name of this.settings.product.views) {
            const title =
                name === "roots"
                    ? "Roots and stems from above, without what stands on them"
                    : `Look from: ${name}`;
            const attributes = { type: "button", title, "data-view": name };
            const button = make("button", attributes, viewLabels[name]);
            button.addEventListener("click", () => this.events.view(name));
            byId("views").append(button);
        }
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
