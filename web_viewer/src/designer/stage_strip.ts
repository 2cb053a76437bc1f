// All stages of a species side by side: outline and small picture of each. A click edits the outline
// of that stage.
import { byId, draw, make } from "../dom";
import { polylineOf, type Silhouette } from "./outline";
import type { Portraits } from "./portraits";
import { millimetres, sizeOf, type Species, type Stage } from "./service";

/** Pixels of a small picture. */
const side = 120;

/** Time without a change after which pictures are drawn, milliseconds. */
const restMs = 500;

/** Returns the outline of a stage as a path in a square of 100 with its height to scale. */
export function smallOutline(silhouette: Silhouette): string {
    const line = polylineOf(silhouette, 6);
    const low = Math.min(...line.map(({ y }) => y));
    const high = Math.max(...line.map(({ y }) => y));
    const wide = Math.max(...line.map(({ r }) => r));
    const scale = 92 / Math.max(high - low, 2 * wide, 1e-6);
    const on = (which: -1 | 1): string[] =>
        line.map(
            ({ r, y }) =>
                `${(50 + which * r * scale).toFixed(1)} ${(50 + ((high + low) / 2 - y) * scale).toFixed(1)}`,
        );
    return `M${[...on(-1), ...on(1).reverse()].join("L")}Z`;
}

/** Returns the words under the picture of a stage. */
export function captionOf({ age, name, model }: Stage): { title: string; detail: string } {
    const size = sizeOf(model);
    const tall = size ? `, ${millimetres(size.height)}` : "";
    return { title: `${Math.round(age * 100)} %${tall}`, detail: name };
}

interface Panel {
    button: HTMLButtonElement;
    outline: SVGPathElement;
    canvas: HTMLCanvasElement;
    title: HTMLElement;
    detail: HTMLElement;
    /** The model that the picture shows. */
    drawn: string;
}

export class StageStrip {
    private readonly list = byId("stage-list");
    private panels: Panel[] = [];
    private stages: readonly Stage[] = [];
    private timer: ReturnType<typeof setTimeout> | undefined;
    private drawing: AbortController | undefined;

    /** `portraits` is called once pictures are needed; while `busy` returns true they wait. */
    constructor(
        private readonly chosen: (stage: number) => void,
        private readonly portraits: () => Portraits,
        private readonly busy: () => boolean,
    ) {
        this.list.addEventListener("keydown", (event) => {
            const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
            if (step === undefined) return;
            const at = this.panels.findIndex(({ button }) => button === document.activeElement);
            this.panels[at + step]?.button.focus();
            event.preventDefault();
        });
    }

    /** Shows the stages of a species, of which one is edited and one photographed. */
    show(species: Species | undefined, shown: number, photographed: number | undefined): void {
        this.stages = species?.stages ?? [];
        byId("stages").hidden = this.stages.length === 0;
        if (this.panels.length !== this.stages.length) {
            this.panels = this.stages.map((_, index) => this.panel(index));
            this.list.replaceChildren(...this.panels.map(({ button }) => make("li", {}, button)));
        }
        this.stages.forEach((stage, index) => {
            const panel = this.panels[index];
            if (!panel) return;
            const { title, detail } = captionOf(stage);
            panel.title.textContent = title;
            panel.detail.textContent = index === photographed ? `${detail} · photograph` : detail;
            panel.button.setAttribute("aria-pressed", String(index === shown));
            const { silhouette } = stage.model;
            panel.outline.setAttribute("d", silhouette ? smallOutline(silhouette) : "");
        });
        this.reveal(shown);
        this.later();
    }

    /** Scrolls the strip, and nothing else, to a stage. */
    private reveal(stage: number): void {
        const item = this.panels[stage]?.button.parentElement;
        const host = byId("stages");
        if (!item) return;
        const [left, right] = [item.offsetLeft, item.offsetLeft + item.offsetWidth];
        if (left < host.scrollLeft) host.scrollLeft = left;
        else if (right > host.scrollLeft + host.clientWidth)
            host.scrollLeft = right - host.clientWidth;
    }

    /** Shows the outline of a stage that is being dragged. */
    dragging(stage: number, silhouette: Silhouette): void {
        this.panels[stage]?.outline.setAttribute("d", smallOutline(silhouette));
    }

    private panel(index: number): Panel {
        const outline = draw("path");
        const svg = draw("svg", { viewBox: "0 0 100 100", "aria-hidden": "true" }, outline);
        const canvas = make("canvas", { width: side, height: side, "aria-hidden": "true" });
        const title = make("b");
        const detail = make("small");
        const button = make(
            "button",
            { type: "button", "data-stage": index },
            make("span", { class: "pair" }, svg, canvas),
            make("span", { class: "caption" }, title, detail),
        );
        button.addEventListener("click", () => this.chosen(index));
        return { button, outline, canvas, title, detail, drawn: "" };
    }

    private later(): void {
        this.drawing?.abort();
        clearTimeout(this.timer);
        byId("stages").dataset["pictures"] = "waiting";
        this.timer = setTimeout(() => void this.draw(), restMs);
    }

    /** Draws the pictures that are out of date, one after the other. */
    private async draw(): Promise<void> {
        if (this.busy()) return this.later();
        const drawing = new AbortController();
        this.drawing = drawing;
        for (const [index, { model }] of this.stages.entries()) {
            const panel = this.panels[index];
            const text = JSON.stringify(model);
            if (!panel || panel.drawn === text) continue;
            try {
                await this.portraits().small(model, panel.canvas, drawing.signal);
                panel.button.classList.remove("refused");
            } catch {
                // Its own request says why it cannot be grown, once it is chosen.
                if (drawing.signal.aborted) return;
                panel.button.classList.add("refused");
            }
            if (drawing.signal.aborted) return;
            panel.drawn = text;
        }
        byId("stages").dataset["pictures"] = "complete";
    }
}
