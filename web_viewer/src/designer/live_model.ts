// The model of the traced stage: one request at a time, and the newest one wins.
import { asRequestFailed, getModel, type RequestFailed } from "../http";
import { parseModel } from "../model";
import type { LoadProgress } from "../progress_box";
import type { Stage } from "../stage";
import { asGrown, type ModelShape } from "./axis_line";

export interface LiveModelEvents {
    progress: (progress: LoadProgress) => void;
    failed: (error: RequestFailed) => void;
    /** The bytes of a model have arrived, also of a draft. */
    arrived: (file: ArrayBuffer) => void;
    /** A final model is on the stage, and these are the bytes of its file. */
    shown: (file: ArrayBuffer) => void;
}

/** Time in which quick steps of undo become one request, milliseconds. */
const pauseMs = 60;

interface Wanted {
    /** The model as JSON. */
    text: string;
    draft: boolean;
    refit: boolean;
}

export class LiveModel {
    private active: { wanted: Wanted; stop: AbortController } | undefined;
    private next: Wanted | undefined;
    private timer: ReturnType<typeof setTimeout> | undefined;

    constructor(
        private readonly stage: Stage,
        private readonly events: LiveModelEvents,
    ) {}

    get idle(): boolean {
        return !this.active && !this.next;
    }

    /** Shows a model: as a draft coarse and with small images, otherwise as the file that can be
     *  saved. A draft that is on its way is completed first: a long drag shows something. */
    show(model: ModelShape, { draft = false, refit = false } = {}): void {
        this.next = { text: JSON.stringify(asGrown(model)), draft, refit: refit || !!this.next?.refit };
        if (this.active && (!draft || !this.active.wanted.draft)) this.stop();
        clearTimeout(this.timer);
        if (!this.active) this.timer = setTimeout(() => void this.start(), draft ? 0 : pauseMs);
    }

    private stop(): void {
        this.active?.stop.abort();
        this.active = undefined;
    }

    /** Forgets what is wanted and on its way. */
    cancel(): void {
        clearTimeout(this.timer);
        this.next = undefined;
        this.stop();
    }

    private async start(): Promise<void> {
        const wanted = this.next;
        if (!wanted) return;
        this.next = undefined;
        const active = { wanted, stop: new AbortController() };
        this.active = active;
        const current = (): boolean => this.active === active;
        const { text, draft, refit } = wanted;
        const options = draft ? '"lod":1,"texture_size":256' : '"lod":0';
        try {
            const { bytes, response } = await getModel(
                { address: "v1/mushrooms.glb", body: `{"model":${text},${options}}` },
                active.stop.signal,
                (progress) => {
                    if (current() && !draft) this.events.progress(progress);
                },
            );
            if (!current()) return;
            this.events.arrived(bytes);
            const model = await parseModel(bytes.slice(0), response.url);
            const shown = await this.stage.show(model, refit, current);
            if (shown && !draft) this.events.shown(bytes);
        } catch (error) {
            if (current()) this.events.failed(asRequestFailed(error, "The model cannot be shown"));
        } finally {
            if (current()) {
                this.active = undefined;
                this.events.progress({ stage: "idle" });
                void this.start();
            }
        }
    }
}
