// Requests the models of the settings: drafts while something is dragged and the final model after
// it, one request at a time; the old model stays until the new one is ready.
import type { Object3D } from "three";
import { asRequestFailed, getJson, getModel, type RequestFailed, type FetchedModel } from "./http";
import { parseModel } from "./model";
import type { DraftTextures } from "./draft_textures";
import type { LevelReport } from "./level_ranges";
import type { LoadProgress } from "./progress_box";
import type { Settings, ModelRequest } from "./settings";
import type { CollisionReport } from "./solids";

export interface LoadedModel {
    fetched: FetchedModel;
    model: Object3D;
    draft: boolean;
    /** It has an animation clip to be played. */
    clip: boolean;
    /** The request it was made from. */
    request: ModelRequest;
}

/** The part of the service's JSON about a model that the page shows. */
export interface ModelReport {
    effective?: unknown;
    /** Ramification matrix in force, of a tree. */
    matrix?: number[][];
    /** The level of detail that is shown and all below it. */
    levels?: LevelReport[];
    bounds_m?: { min: number[]; max: number[] };
    /** Solids of a file with collision. */
    collision?: CollisionReport;
    /** Number of individuals, of a colony. */
    made?: number;
}

export interface ModelLoaderEvents {
    progress: (progress: LoadProgress) => void;
    /** Puts the model on the stage, unless `current` returns false; returns whether it did. */
    show: (loaded: LoadedModel, refit: boolean, current: () => boolean) => Promise<boolean>;
    effective: (resource: ModelReport) => void;
    failed: (error: RequestFailed) => void;
}

const pauseMs = 120;

interface PendingLoad {
    draft: boolean;
    clip: boolean;
}

interface ActiveLoad {
    draft: boolean;
    stop: AbortController;
}

export class ModelLoader {
    private active: ActiveLoad | undefined;
    private timer: ReturnType<typeof setTimeout> | undefined;
    private pending: PendingLoad | undefined;
    private refit = true;
    private linked = true;
    private shownKey: string | undefined;
    private failure: { key: string; error: RequestFailed } | undefined;
    private waiters: (() => void)[] = [];

    constructor(
        private readonly settings: Settings,
        private readonly sharedTextures: DraftTextures,
        private readonly events: ModelLoaderEvents,
    ) {}

    /** Requests a draft after a pause: something is being dragged. */
    loadDraft(pause = pauseMs): void {
        // A final model that is being loaded is out of date; a draft is completed first, so that a
        // long drag shows something also when the server is slow.
        if (this.active && !this.active.draft) this.stop();
        this.schedule(true, pause);
    }

    /** Requests the final model of the settings. */
    loadFinal(refit = false, delay = 0): void {
        this.refit ||= refit;
        this.stop();
        this.schedule(false, delay);
    }

    /** Requests the settings' model with its growth clip. */
    loadClip(): void {
        this.stop();
        this.schedule(false, 0, true);
    }

    /** Resolves when the stage shows the model of the settings; rejects if it cannot be made. */
    async settled(): Promise<void> {
        for (;;) {
            const { key } = this.settings.request();
            const idle = !this.active && !this.pending;
            if (idle && this.shownKey === key) return;
            if (idle && this.failure?.key === key) throw this.failure.error;
            await new Promise<void>((resolve) => this.waiters.push(resolve));
        }
    }

    private schedule(draft: boolean, delay: number, clip = false): void {
        this.pending = { draft, clip };
        if (this.active) return;
        if (this.timer !== undefined && draft) return;
        clearTimeout(this.timer);
        this.timer = setTimeout(() => {
            this.timer = undefined;
            void this.start();
        }, delay);
    }

    private stop(): void {
        this.active?.stop.abort();
        this.active = undefined;
        clearTimeout(this.timer);
        this.timer = undefined;
    }

    private async start(): Promise<void> {
        const pending = this.pending;
        if (!pending) return;
        this.pending = undefined;
        const { draft, clip } = pending;
        const load: ActiveLoad = { draft, stop: new AbortController() };
        this.active = load;
        const replaced = draft
            ? this.settings.draftValues(this.linked)
            : clip
              ? this.settings.clipValues()
              : undefined;
        const request = this.settings.request(replaced);
        const current = (): boolean => this.active === load;
        try {
            const effective = draft ? undefined : this.readEffective(load.stop.signal);
            const fetched = await getModel(request, load.stop.signal, (progress) => {
                if (current()) this.events.progress(progress);
            });
            if (!current()) return;
            this.events.progress({ stage: "unpacking" });
            const model = await parseModel(
                fetched.bytes,
                fetched.response.url,
                draft ? this.sharedTextures : undefined,
            );
            const refit = this.refit;
            if (!(await this.events.show({ fetched, model, draft, clip, request }, refit, current)))
                return;
            this.refit = false;
            if (!draft) {
                const resource = await effective;
                if (!current()) return;
                if (resource) this.events.effective(resource);
                this.shownKey = clip ? this.settings.request().key : request.key;
                this.failure = undefined;
            }
        } catch (error) {
            if (!current()) return;
            this.fail(request, replaced?.has("textures") ?? false, pending, error);
        } finally {
            if (current()) {
                this.active = undefined;
                this.events.progress({ stage: "idle" });
                const next = this.pending as PendingLoad | undefined;
                if (next) this.schedule(next.draft, 0, next.clip);
            }
            const waiting = this.waiters;
            this.waiters = [];
            for (const resolve of waiting) resolve();
        }
    }

    private fail(
        request: ModelRequest,
        linked: boolean,
        { draft, clip }: PendingLoad,
        error: unknown,
    ): void {
        const known = asRequestFailed(error, "The model could not be shown");
        if (
            draft &&
            linked &&
            known.status === 422 &&
            known.items.some(({ parameter }) => parameter.replace("/", "") === "textures")
        ) {
            // A server with signed URLs has no linked images: from now on drafts embed them.
            this.linked = false;
            this.pending ??= { draft: true, clip: false };
            return;
        }
        // Without its clip the model on the stage is still the one of the settings.
        if (!draft && !clip) this.failure = { key: request.key, error: known };
        this.events.failed(known);
    }

    private async readEffective(signal: AbortSignal): Promise<ModelReport | undefined> {
        try {
            return await getJson(this.settings.address(".json"), signal);
        } catch {
            // The request of the model itself reports the problem.
            return undefined;
        }
    }
}
