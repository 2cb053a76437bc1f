// What tests and tools read of the page: `window.worlds`.
import type { Layer, WorldState } from "./view_address";
import type { WorldPage } from "./world_page";

export interface WorldHandle {
    /** What the page shows. */
    readonly state: WorldState;
    /** Addresses of the files or tiles that are on the stage, by layer. */
    shown: () => Record<Layer, string>;
    /** Where a place is in the window, pixels; `above` the ground, metres. */
    pixelOf: (x: number, y: number, above?: number) => { x: number; y: number };
    /** Places of the fruit bodies of the plot, and their species. */
    bodies: () => { species: string; x: number; y: number; above: number }[];
    /** Draw calls and triangles of the last frame, and frames so far. */
    readonly renderer: { calls: number; triangles: number; frames: number };
}

declare global {
    interface Window {
        worlds: WorldHandle;
    }
}

export function installHandle(page: WorldPage): void {
    window.worlds = {
        get state() {
            return page.state;
        },
        shown: () => page.shown,
        pixelOf: (x, y, above = 0) => page.pixelOf(x, y, above),
        bodies: () =>
            page.bodies.map(({ species, place_m: [x, y], above_ground_m: above }) => ({ species, x, y, above })),
        get renderer() {
            return page.rendering;
        },
    };
}
