// `window.sporeprint`: what tests and tools read from the page, and do with it.
import type { LookName } from "./camera";
import type { Counts } from "./model";
import type { ColonyCount } from "./name_plate";
import type { Page } from "./page";
import type { Frame, Size, Stage } from "./stage";

interface TestHandle {
    /** Resolves when the shown model equals the controls and a frame of it was drawn. */
    ready(): Promise<void>;
    view(name: LookName): void;
    /** Counts of the last frame and of the graphics card's memory; `frames` is the number of frames
     *  drawn so far. */
    readonly renderer: {
        frames: number;
        calls: number;
        triangles: number;
        geometries: number;
        textures: number;
    };
    readonly counts: Counts;
    /** What the picture shows at the depth of the camera's target, and the target, metres. */
    readonly frame: Frame;
    /** Triangles of the level of detail that is shown, and pixels of its longest side. */
    readonly shown: { triangles: number; pixels: number };
    /** The age that an animation clip shows, undefined if it shows none, and whether it plays. */
    readonly growth: { age: number | undefined; playing: boolean };
    readonly made: ColonyCount | undefined;
    /** Metres. */
    readonly size: Size;
}

declare global {
    interface Window {
        sporeprint: TestHandle;
    }
}

/** Sets `window.sporeprint`. */
export function installTestHandle(page: Page, stage: Stage): void {
    window.sporeprint = {
        ready: async () => {
            await page.settled();
            await stage.drawn();
        },
        view: (name) => page.view(name),
        get renderer() {
            const { render, memory } = stage.renderer.info;
            const { frame: frames, calls, triangles } = render;
            return { frames, calls, triangles, ...memory };
        },
        get counts() {
            return page.counts;
        },
        get frame() {
            return stage.frameShown;
        },
        get shown() {
            const { width, height, depth } = stage.size;
            const pixels = Math.max(width, height, depth) * stage.pixelsPerMetre;
            return { triangles: page.counts.triangles, pixels };
        },
        get growth() {
            return page.growth;
        },
        get made() {
            return page.colonyCount;
        },
        get size() {
            return stage.size;
        },
    };
}
