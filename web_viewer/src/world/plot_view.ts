// The plot on the stage: one file for each layer, so that a new day brings its fungi at once and all else after them.
import type { Object3D } from "three";
import { asRequestFailed, getJson, getModel, type Progress, type RequestFailed } from "../http";
import { disposeModel, parseModel } from "../model";
import { layers, type Layer, type WorldState } from "./view_address";
import type { WorldStage } from "./world_stage";

/** A fruit body, as plot.json describes it. */
export interface FruitBodyFacts {
    id: string;
    species: string;
    /** East, north, height, metres. */
    place_m: [number, number, number];
    above_ground_m: number;
    age: number;
    days_old: number;
    /** Address of its model. */
    model: string;
}

interface PlotFacts {
    fruit_bodies: FruitBodyFacts[];
    trees: { kind: string; height_m: number }[];
    dead_wood: unknown[];
}

export interface PlotEvents {
    progress: (progress: Progress | { stage: "unpacking" } | { stage: "idle" }) => void;
    /** A layer has arrived. */
    shown: (layer: Layer) => void;
    facts: (facts: PlotFacts) => void;
    /** Nothing is on its way any more. */
    settled: () => void;
    failed: (failure: RequestFailed) => void;
}

/** The file of one layer: what is shown, what is wanted, and what is on its way. */
interface Slot {
    shown: string;
    wanted: string;
    model: Object3D | undefined;
    loading: AbortController | undefined;
    /** Address of what is on its way. */
    requested: string;
}

/** Returns the address of files of a plot: "plot.glb" and its query, with the layers that are named. The files of the
 *  stage repeat leaves and fruit bodies on the graphics card; those that are saved do not. */
export function plotAddress(
    world: string,
    state: WorldState,
    ending: string,
    only: readonly Layer[] = layers,
    instancing: "gpu" | "none" = "gpu",
): string {
    const { x, y, year, day, size } = state;
    const query = [`x=${x}`, `y=${y}`, `size=${size}`];
    if (only.length < layers.length) query.push(`layers=${only.join("+")}`);
    if (ending === ".glb" && instancing === "gpu") query.push("instancing=gpu");
    return `v1/worlds/${world}/y${year}d${day}/plot${ending}?${query.join("&")}`;
}

export class PlotView {
    bodies: readonly FruitBodyFacts[] = [];
    private readonly slots = new Map<Layer, Slot>(
        layers.map((layer) => [layer, { shown: "", wanted: "", model: undefined, loading: undefined, requested: "" }]),
    );
    private factsOf = "";
    private loadingFacts: AbortController | undefined;

    constructor(
        private readonly stage: WorldStage,
        private readonly events: PlotEvents,
    ) {}

    /** Shows the plot of a state. While a day is dragged only its fungi follow, one file at a time. */
    show(world: string, state: WorldState, isDragged: boolean): void {
        const wanted: Layer[] = isDragged ? ["fungi"] : ["fungi", "ground", "floor", "trees"];
        for (const layer of wanted) {
            const slot = this.slot(layer);
            slot.wanted = plotAddress(world, state, ".glb", [layer]);
            if (slot.loading && (isDragged || slot.requested === slot.wanted)) continue;
            slot.loading?.abort();
            slot.loading = undefined;
            void this.load(layer);
        }
        if (!isDragged) void this.loadFacts(plotAddress(world, state, ".json"));
    }

    /** Forgets what is wanted, so that nothing follows. */
    stop(): void {
        for (const slot of this.slots.values()) {
            slot.loading?.abort();
            slot.loading = undefined;
            slot.wanted = slot.shown;
        }
        this.loadingFacts?.abort();
        this.events.progress({ stage: "idle" });
    }

    set hidden(hidden: ReadonlySet<Layer>) {
        for (const [layer, { model }] of this.slots) if (model) model.visible = !hidden.has(layer);
        this.hiddenLayers = hidden;
        this.stage.draw();
    }

    private hiddenLayers: ReadonlySet<Layer> = new Set();

    /** Returns the model of a layer, undefined until it has arrived. */
    model(layer: Layer): Object3D | undefined {
        return this.slot(layer).model;
    }

    /** Address of the file of a layer that is on the stage. */
    shownAddress(layer: Layer): string {
        return this.slot(layer).shown;
    }

    get isSettled(): boolean {
        return [...this.slots.values()].every(({ loading }) => !loading) && !this.loadingFacts;
    }

    private slot(layer: Layer): Slot {
        return this.slots.get(layer)!;
    }

    private async load(layer: Layer): Promise<void> {
        const slot = this.slot(layer);
        while (slot.wanted !== slot.shown) {
            const loading = new AbortController();
            const { signal } = loading;
            const address = slot.wanted;
            slot.loading = loading;
            slot.requested = address;
            try {
                const { bytes, response } = await getModel({ address }, signal, (progress) =>
                    this.events.progress(progress),
                );
                this.events.progress({ stage: "unpacking" });
                const model = await parseModel(bytes, response.url);
                if (signal.aborted) return disposeModel(model);
                await this.put(layer, model, signal);
                if (signal.aborted) return;
                slot.shown = address;
                this.events.shown(layer);
            } catch (error) {
                if (signal.aborted) return;
                slot.loading = undefined;
                slot.wanted = slot.shown;
                this.events.failed(asRequestFailed(error, "The plot cannot be shown"));
                return this.end();
            }
        }
        slot.loading = undefined;
        this.end();
    }

    private end(): void {
        if (!this.isSettled) return;
        this.events.progress({ stage: "idle" });
        this.events.settled();
    }

    /** Replaces the model of a layer, once the graphics card has the new one. */
    private async put(layer: Layer, model: Object3D, signal: AbortSignal): Promise<void> {
        const { renderer, scene, camera, plot } = this.stage;
        if (renderer.getContext().getExtension("KHR_parallel_shader_compile"))
            await renderer.compileAsync(model, camera, scene);
        if (signal.aborted) return disposeModel(model);
        const slot = this.slot(layer);
        if (slot.model) {
            plot.remove(slot.model);
            disposeModel(slot.model);
        }
        slot.model = model;
        model.name = layer;
        model.visible = !this.hiddenLayers.has(layer);
        plot.add(model);
        this.stage.draw();
    }

    private async loadFacts(address: string): Promise<void> {
        if (address === this.factsOf) return;
        this.loadingFacts?.abort();
        const loading = new AbortController();
        this.loadingFacts = loading;
        try {
            const facts = await getJson<PlotFacts>(address, loading.signal);
            this.bodies = facts.fruit_bodies;
            this.factsOf = address;
            this.events.facts(facts);
        } catch (error) {
            if (loading.signal.aborted) return;
            this.events.failed(asRequestFailed(error, "The plot cannot be described"));
        }
        if (this.loadingFacts !== loading) return;
        this.loadingFacts = undefined;
        this.end();
    }
}

/** Returns the fruit body that is nearest to a place, undefined if none is within `reach` metres. */
export function nearestBody(
    bodies: readonly FruitBodyFacts[],
    x: number,
    y: number,
    reach: number,
): FruitBodyFacts | undefined {
    let [nearest, distance]: [FruitBodyFacts | undefined, number] = [undefined, reach];
    for (const body of bodies) {
        const away = Math.hypot(body.place_m[0] - x, body.place_m[1] - y);
        if (away >= distance) continue;
        [nearest, distance] = [body, away];
    }
    return nearest;
}

/** Returns the address of a model as the address of the page that shows it. */
export function viewerAddress(model: string): string | undefined {
    const found = /\/v1\/mushrooms\/([^/?]+)\.glb(?:\?(.*))?$/.exec(model);
    return found ? `./?species=${found[1]}${found[2] ? `&${found[2]}` : ""}` : undefined;
}
