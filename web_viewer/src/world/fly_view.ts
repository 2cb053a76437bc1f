// The whole world as 3D Tiles: one renderer of tiles for each layer, so that a new day replaces the fungi alone. What
// is shown stays until what replaces it has loaded all that is in view.
import { TilesRenderer } from "3d-tiles-renderer/three";
import { ImplicitTilingPlugin } from "3d-tiles-renderer/core/plugins";
import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import type { Object3D } from "three";
import { asRequestFailed, send, type RequestFailed } from "../http";
import { translucency } from "../translucency";
import { SharedMeshes } from "./shared_meshes";
import { monthOf } from "./season_curves";
import { layers, type Layer, type WorldState } from "./view_address";
import type { WorldStage } from "./world_stage";

/** Error on the screen at which a finer tile is wanted, pixels. */
const errorTarget = 16;
/** Memory of the graphics card for tiles, bytes: what is cached though not in view, and what no view may exceed. At 1920
 *  by 1080 pixels a view takes 0.5e9, and twice as much while a month follows another. */
const memory = { cached: 0.6e9, most: 1.2e9 };
/** A layer counts as loaded after this many frames in which nothing was on its way. */
const quietFrames = 4;

export interface FlyEvents {
    /** A layer shows other tiles than before. */
    shown: (layer: Layer) => void;
    /** Nothing is on its way any more. */
    settled: () => void;
    failed: (failure: RequestFailed) => void;
}

interface TileSet {
    address: string;
    tiles: TilesRenderer;
    /** Frames since something was on its way. */
    quiet: number;
    failed: boolean;
}

/** Returns the address of the tiles of a layer: fungi are those of a day, all else that of a month. */
export function tilesetAddress(world: string, state: WorldState, layer: Layer): string {
    const { year, day } = state;
    const time = layer === "fungi" ? `y${year}d${day}` : `y${year}m${monthOf(day)}`;
    return `v1/worlds/${world}/web/${time}/${layer}/tileset.json`;
}

/** Members of a renderer of tiles that its types do not name. */
interface TileInternals {
    stats: { queued: number; downloading: number; parsing: number; failed: number };
    calculateBytesUsed: (tile: object, scene: Object3D | null) => number;
}

/** Fetches a tileset or a tile. A busy server is requested again after the time that it names. */
async function fetchData(url: string, options: RequestInit): Promise<unknown> {
    const response = await send(url, options);
    if (!url.endsWith("/tileset.json")) return response;
    const tileset = (await response.json()) as { asset: { version: string } };
    // The renderer warns of every tileset of version 1.1, although it knows all that these have of it.
    tileset.asset.version = "1.0";
    return tileset;
}

export class FlyView {
    private readonly shown = new Map<Layer, TileSet>();
    private readonly coming = new Map<Layer, TileSet>();
    private readonly meshes = new SharedMeshes();
    private hiddenLayers: ReadonlySet<Layer> = new Set();
    private wasSettled = true;

    constructor(
        private readonly stage: WorldStage,
        private readonly events: FlyEvents,
    ) {
        // Tiles have z up.
        stage.tiles.rotation.x = -Math.PI / 2;
        stage.tiles.updateMatrixWorld(true);
    }

    /** Shows the tiles of a state. While a day is dragged only fungi follow. */
    show(world: string, state: WorldState, isDragged: boolean): void {
        for (const layer of isDragged ? (["fungi"] as const) : layers) {
            const address = tilesetAddress(world, state, layer);
            const coming = this.coming.get(layer);
            if (coming?.address === address) continue;
            // A drag does not cancel what is on its way.
            if (coming && isDragged) continue;
            if (coming) this.remove(this.coming, layer);
            if (this.shown.get(layer)?.address === address) continue;
            this.wasSettled = false;
            this.coming.set(layer, this.made(address));
        }
        this.stage.draw();
    }

    /** Removes all tiles: another world is shown, or no tiles. */
    clear(): void {
        for (const layer of layers) {
            this.remove(this.coming, layer);
            this.remove(this.shown, layer);
        }
        this.meshes.clear();
    }

    set hidden(hidden: ReadonlySet<Layer>) {
        this.hiddenLayers = hidden;
        for (const [layer, { tiles }] of this.shown) tiles.group.visible = !hidden.has(layer);
        this.stage.draw();
    }

    /** Loads what the camera sees; called before each frame. Returns true while another frame has to follow. */
    update(): boolean {
        const { renderer, flyingCamera, tiles: root } = this.stage;
        flyingCamera.updateMatrixWorld();
        let isBusy = false;
        for (const set of [...this.shown.values(), ...this.coming.values()]) {
            const { tiles } = set;
            tiles.setCamera(flyingCamera);
            tiles.setResolutionFromRenderer(flyingCamera, renderer);
            // A group that is not in the scene yet is where it will be.
            if (!tiles.group.parent) {
                tiles.group.matrixWorld.copy(root.matrixWorld);
                tiles.group.matrixWorldInverse.copy(root.matrixWorld).invert();
            }
            tiles.update();
            const { queued, downloading, parsing } = (tiles as unknown as TileInternals).stats;
            const isQuiet = (tiles.root !== null || set.failed) && queued + downloading + parsing === 0;
            set.quiet = isQuiet ? set.quiet + 1 : 0;
            isBusy ||= set.quiet < quietFrames;
        }
        for (const [layer, set] of this.coming) if (set.quiet >= quietFrames) this.swap(layer, set);
        if (!isBusy && !this.wasSettled) {
            this.wasSettled = true;
            this.events.settled();
        }
        this.wasSettled &&= !isBusy;
        return isBusy;
    }

    get isSettled(): boolean {
        return this.wasSettled && this.coming.size === 0;
    }

    /** Returns what a layer shows, undefined before its first tiles. */
    group(layer: Layer): Object3D | undefined {
        return this.shown.get(layer)?.tiles.group;
    }

    shownAddress(layer: Layer): string {
        return this.shown.get(layer)?.address ?? "";
    }

    /** Memory that the tiles take, bytes, and whether there is none left for more. */
    get memory(): { bytes: number; isFull: boolean } {
        const cache = this.shown.get("ground")?.tiles.lruCache as { cachedBytes: number; isFull: () => boolean } | undefined;
        return { bytes: cache?.cachedBytes ?? 0, isFull: cache?.isFull() ?? false };
    }

    /** Tiles of a layer in the picture. */
    visibleTiles(layer: Layer): number {
        return this.shown.get(layer)?.tiles.visibleTiles.size ?? 0;
    }

    private swap(layer: Layer, set: TileSet): void {
        this.coming.delete(layer);
        this.remove(this.shown, layer);
        this.shown.set(layer, set);
        this.stage.tiles.add(set.tiles.group);
        set.tiles.group.visible = !this.hiddenLayers.has(layer);
        this.stage.draw();
        this.events.shown(layer);
    }

    private remove(from: Map<Layer, TileSet>, layer: Layer): void {
        const set = from.get(layer);
        if (!set) return;
        from.delete(layer);
        this.stage.tiles.remove(set.tiles.group);
        set.tiles.dispose();
    }

    private made(address: string): TileSet {
        const tiles = new TilesRenderer(new URL(address, location.href).href);
        const set: TileSet = { address, tiles, quiet: 0, failed: false };
        tiles.errorTarget = errorTarget;
        // All renderers of tiles have the same cache.
        tiles.lruCache.minBytesSize = memory.cached;
        tiles.lruCache.maxBytesSize = memory.most;
        // The renderer would count a tree once for each tile that shows it, and stop loading: its cache seems full.
        (tiles as unknown as TileInternals).calculateBytesUsed = (_, scene) => (scene ? this.meshes.ownBytes(scene) : 0);
        tiles.registerPlugin(new ImplicitTilingPlugin());
        const loader = new GLTFLoader(tiles.manager).setMeshoptDecoder(MeshoptDecoder);
        loader.register(this.meshes.plugin).register(translucency(new Set()));
        tiles.manager.addHandler(/\.glb$/, loader);
        tiles.registerPlugin({ name: "SPOREPRINT_requests", fetchData });
        tiles.addEventListener("load-model", () => this.stage.draw());
        tiles.addEventListener("needs-update", () => this.stage.draw());
        tiles.addEventListener("load-error", ({ error }) => {
            if (error.name === "AbortError") return;
            set.failed = true;
            this.events.failed(asRequestFailed(error, "A tile cannot be shown"));
            this.stage.draw();
        });
        return set;
    }
}
