// The live model drawn over the photograph, at the place and in the scale of the photograph.
import { byId, draw, make } from "../dom";
import { stemOf, type ModelShape } from "./axis_line";
import type { Extent } from "./gesture";
import type { AxisFrame } from "./outline";
import type { Portraits, Window } from "./portraits";

/** The longer side of the drawn picture, pixels. */
const longest = 1024;

/** Returns what of the space around a model the photograph shows: the root of the model is where the
 *  traced axis has its height. */
export function windowOf({ silhouette }: ModelShape, traced: AxisFrame, extent: Extent): Window {
    const base = silhouette ? stemOf(silhouette).base : 0;
    const [x, y] = traced.toPhoto({ r: 0, y: base }, 1);
    const metres = (pixels: number): number => pixels / traced.scale;
    return {
        left: metres(-x),
        right: metres(extent.width - x),
        top: base + metres(y),
        bottom: base - metres(extent.height - y),
    };
}

export class OverPhoto {
    readonly element = draw("g", { class: "over-photo" });
    private readonly canvas = make("canvas", {});
    private readonly box = draw("foreignObject", { x: 0, y: 0 }, this.canvas);
    private wanted: { bytes: ArrayBuffer; seen: Window } | undefined;
    private drawing = false;

    constructor(private readonly portraits: () => Portraits) {
        this.element.append(this.box);
    }

    get shown(): boolean {
        return byId<HTMLInputElement>("over-photo").checked;
    }

    open({ width, height }: Extent): void {
        const scale = Math.min(1, longest / Math.max(width, height));
        this.canvas.width = Math.round(width * scale);
        this.canvas.height = Math.round(height * scale);
        this.box.setAttribute("width", String(width));
        this.box.setAttribute("height", String(height));
        this.clear();
    }

    clear(): void {
        this.wanted = undefined;
        this.canvas.getContext("2d")?.clearRect(0, 0, this.canvas.width, this.canvas.height);
    }

    /** Draws the model of a file; while one is drawn the newest waits. */
    async show(bytes: ArrayBuffer, seen: Window): Promise<void> {
        this.wanted = { bytes, seen };
        if (this.drawing) return;
        this.drawing = true;
        try {
            while (this.wanted) {
                const { bytes: newest, seen: window } = this.wanted;
                this.wanted = undefined;
                await this.portraits().file(newest, window, this.canvas);
                // It may have become unwanted in the meantime.
                if (!this.shown) this.clear();
            }
        } finally {
            this.drawing = false;
        }
    }
}
