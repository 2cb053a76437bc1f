// The tools of a photograph: light, depth of field, and a button that saves the picture.
import { byId, make } from "./dom";
import { fNumbers, usualFNumber, type FNumber } from "./depth_of_field";
import { lightNames, lights, type LightName } from "./lights";
import type { Stage } from "./stage";
import type { ViewState, ViewStore } from "./view_state";

/** Shows the page and the stage in a light: the style has the colours. */
export function showLight(stage: Stage, name: LightName): void {
    const root = document.documentElement;
    root.dataset["light"] = name;
    stage.useLight(name);
    const style = getComputedStyle(root);
    const colour = (variable: string): string => style.getPropertyValue(variable).trim();
    stage.setColours({
        ink: colour("--rule"),
        shadow: colour("--shade"),
        sheet: [colour("--stage-near"), colour("--stage-mid"), colour("--stage-far")],
    });
}

export class PhotoTools {
    private readonly light = byId<HTMLSelectElement>("light");
    private readonly depth = byId<HTMLButtonElement>("depth");
    private readonly aperture = byId<HTMLInputElement>("aperture");
    private lastFNumber: FNumber = usualFNumber;
    private shownLight: LightName | undefined;

    /** `save` saves the picture and reports on its own if that fails. */
    constructor(
        private readonly stage: Stage,
        views: ViewStore,
        save: () => Promise<void>,
    ) {
        for (const name of lightNames) {
            const { label, title } = lights[name];
            this.light.append(make("option", { value: name, title }, label));
        }
        this.light.addEventListener("change", () =>
            views.change({ light: this.light.value as LightName }),
        );
        this.aperture.max = String(fNumbers.length - 1);
        this.depth.addEventListener("click", () => {
            const off = views.current.aperture === undefined;
            views.change({ aperture: off ? this.lastFNumber : undefined });
        });
        this.aperture.addEventListener("input", () =>
            views.change({ aperture: fNumbers[Number(this.aperture.value)] }),
        );
        if (!stage.hasDepthOfField) {
            this.depth.disabled = true;
            this.depth.title = "This graphics card cannot add up the pictures that it needs";
        }
        const button = byId<HTMLButtonElement>("picture");
        button.addEventListener("click", () => {
            button.disabled = true;
            void save().finally(() => (button.disabled = false));
        });
        views.listen((view) => this.show(view));
        this.show(views.current);
    }

    private show({ light, aperture }: ViewState): void {
        if (this.shownLight !== light) {
            this.shownLight = light;
            this.light.value = light;
            this.light.title = lights[light].title;
            showLight(this.stage, light);
        }
        const fNumber = this.stage.hasDepthOfField ? aperture : undefined;
        this.stage.aperture = fNumber;
        if (fNumber !== undefined) this.lastFNumber = fNumber;
        this.depth.setAttribute("aria-pressed", String(fNumber !== undefined));
        byId("aperture-row").hidden = fNumber === undefined;
        this.aperture.value = String(fNumbers.indexOf(this.lastFNumber));
        const text = `f/${this.lastFNumber}`;
        this.aperture.setAttribute("aria-valuetext", text);
        byId("aperture-text").textContent = text;
    }
}
