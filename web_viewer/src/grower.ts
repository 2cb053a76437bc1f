// Keeps the stage equal to the settings: rough models while something is dragged, the chosen one
// after it, never two at a time, and the old one until the new one is ready.
import type { Object3D } from "three";
import { getJson, getModel, RequestFailed, type Answer } from "./http";
import { parseModel } from "./model";
import type { Paint } from "./paint";
import type { LoadProgress } from "./progress_box";
import type { Settings, Wanted } from "./settings";

export interface Grown {
    answer: Answer;
    model: Object3D;
    draft: boolean;
    /** Asked for to be played. */
    clip: boolean;
    /** What was asked for. */
    wanted: Wanted;
}

/** What the service tells of a model, as far as the page shows it. */
export interface Resource {
    effective?: unknown;
    /** In force, of a tree. */
    matrix?: number[][];
    /** Individuals of a colony. */
    made?: number;
}

export interface GrowerEvents {
    progress: (progress: LoadProgress) => void;
    /** Puts the model on the stage; `current` says whether it is still wanted. */
    show: (grown: Grown, refit: boolean, current: () => boolean) => Promise<boolean>;
    effective: (resource: Resource) => void;
    failed: (error: RequestFailed) => void;
}

const pauseMs = 120;

interface Wish {
    draft: boolean;
    clip: boolean;
}

interface Flight {
    draft: boolean;
    stop: AbortController;
}

export class Grower {
    private flight: Flight | undefined;
    private timer: ReturnType<typeof setTimeout> | undefined;
    private pending: Wish | undefined;
    private refit = true;
    private linked = true;
    private shown: string | undefined;
    private failure: { key: string; error: RequestFailed } | undefined;
    private waiting: (() => void)[] = [];

    constructor(
        private readonly settings: Settings,
        private readonly paint: Paint,
        private readonly events: GrowerEvents,
    ) {}

    /** Something is being moved: a rough model soon. */
    draft(pause = pauseMs): void {
        // A final model on its way is out of date; a draft on its way is finished first, so that
        // a long drag shows something also when the server is slow.
        if (this.flight && !this.flight.draft) this.stop();
        this.plan(true, pause);
    }

    /** The settings stand: the model as chosen. */
    final(refit = false, delay = 0): void {
        this.refit ||= refit;
        this.stop();
        this.plan(false, delay);
    }

    /** The growth of what the settings say, to be played. */
    clip(): void {
        this.stop();
        this.plan(false, 0, true);
    }

    /** Resolves when what stands on the stage is what the settings say. */
    async settled(): Promise<void> {
        for (;;) {
            const { key } = this.settings.wanted();
            const idle = !this.flight && !this.pending;
            if (idle && this.shown === key) return;
            if (idle && this.failure?.key === key) throw this.failure.error;
            await new Promise<void>((resolve) => this.waiting.push(resolve));
        }
    }

    private plan(draft: boolean, delay: number, clip = false): void {
        this.pending = { draft, clip };
        if (this.flight) return;
        if (this.timer !== undefined && draft) return;
        clearTimeout(this.timer);
        this.timer = setTimeout(() => {
            this.timer = undefined;
            void this.start();
        }, delay);
    }

    private stop(): void {
        this.flight?.stop.abort();
        this.flight = undefined;
        clearTimeout(this.timer);
        this.timer = undefined;
    }

    private async start(): Promise<void> {
        const pending = this.pending;
        if (!pending) return;
        this.pending = undefined;
        const { draft, clip } = pending;
        const flight: Flight = { draft, stop: new AbortController() };
        this.flight = flight;
        const replaced = draft
            ? this.settings.draftValues(this.linked)
            : clip
              ? this.settings.clipValues()
              : undefined;
        const wanted = this.settings.wanted(replaced);
        const current = (): boolean => this.flight === flight;
        try {
            const effective = draft ? undefined : this.readEffective(flight.stop.signal);
            const answer = await getModel(wanted, flight.stop.signal, (progress) => {
                if (current()) this.events.progress(progress);
            });
            if (!current()) return;
            this.events.progress({ stage: "unpacking" });
            const model = await parseModel(
                answer.bytes,
                answer.response.url,
                draft ? this.paint : undefined,
            );
            const refit = this.refit;
            if (!(await this.events.show({ answer, model, draft, clip, wanted }, refit, current)))
                return;
            this.refit = false;
            if (!draft) {
                const resource = await effective;
                if (!current()) return;
                if (resource) this.events.effective(resource);
                this.shown = clip ? this.settings.wanted().key : wanted.key;
                this.failure = undefined;
            }
        } catch (error) {
            if (!current()) return;
            this.fail(wanted, replaced?.has("textures") ?? false, pending, error);
        } finally {
            if (current()) {
                this.flight = undefined;
                this.events.progress({ stage: "idle" });
                const next = this.pending as Wish | undefined;
                if (next) this.plan(next.draft, 0, next.clip);
            }
            const waiting = this.waiting;
            this.waiting = [];
            for (const resolve of waiting) resolve();
        }
    }

    private fail(wanted: Wanted, linked: boolean, { draft, clip }: Wish, error: unknown): void {
        const known =
            error instanceof RequestFailed
                ? error
                : new RequestFailed(
                      "The model could not be shown",
                      error instanceof Error ? error.message : "",
                      0,
                  );
        if (
            draft &&
            linked &&
            known.status === 422 &&
            known.items.some(({ parameter }) => parameter.replace("/", "") === "textures")
        ) {
            // A server with signed URLs has no linked images: drafts embed them from now on.
            this.linked = false;
            this.pending ??= { draft: true, clip: false };
            return;
        }
        // Without its clip the model on the stage is still what the settings say.
        if (!draft && !clip) this.failure = { key: wanted.key, error: known };
        this.events.failed(known);
    }

    private async readEffective(signal: AbortSignal): Promise<Resource | undefined> {
        try {
            return await getJson(this.settings.address(".json"), signal);
        } catch {
            // The model's own request says what is wrong.
            return undefined;
        }
    }
}
