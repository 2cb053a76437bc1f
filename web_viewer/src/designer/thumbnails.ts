// Small pictures of species of the library: the service's own of what is published, and of drafts, which have none,
// one that the page draws.
import { make } from "../dom";
import type { LibrarySpecies } from "../library_list";
import type { Portraits } from "./portraits";
import type { Species } from "./service";
import { pictureOf } from "./species_chooser";
import { readSpecies, stageOf } from "./species_file";

/** Pixels of a picture. */
const side = 128;

/** Time until it is seen again whether the page is busy, milliseconds. */
const waitMs = 400;

export class Thumbnails {
    /** Pictures of drafts by id and time of the last change. */
    private readonly drawn = new Map<string, Promise<HTMLCanvasElement>>();
    /** Pictures follow each other, since there is one renderer. */
    private last: Promise<unknown> = Promise.resolve();

    /** `draft` returns the document of a draft; while `busy` returns true no picture is begun. */
    constructor(
        private readonly portraits: () => Portraits,
        private readonly busy: () => boolean,
        private readonly draft: (id: string) => Promise<string>,
    ) {}

    /** Returns the picture of a species; that of a draft is drawn once it is seen. */
    of({ id, newest, updated_s: updated }: LibrarySpecies): HTMLElement {
        if (newest > 0) return pictureOf(`${id}@${newest}`);
        const canvas = make("canvas", { width: side, height: side, "aria-hidden": true });
        const seen = new IntersectionObserver((entries) => {
            if (!entries.some(({ isIntersecting }) => isIntersecting)) return;
            seen.disconnect();
            void this.draw(id, `${id} ${updated}`, canvas);
        });
        seen.observe(canvas);
        return canvas;
    }

    private async draw(id: string, key: string, canvas: HTMLCanvasElement): Promise<void> {
        const drawn = this.drawn.get(key) ?? this.queued(id);
        this.drawn.set(key, drawn);
        try {
            canvas.getContext("2d")?.drawImage(await drawn, 0, 0);
            canvas.dataset["drawn"] = "true";
        } catch {
            // A draft need not be one that can be grown; it can be opened all the same.
            this.drawn.delete(key);
        }
    }

    private queued(id: string): Promise<HTMLCanvasElement> {
        const made = this.last.then(async () => {
            while (this.busy()) await new Promise((done) => setTimeout(done, waitMs));
            const species: Species = readSpecies(await this.draft(id));
            const canvas = make("canvas", { width: side, height: side });
            const { model = {} } = species.stages[stageOf(species)] ?? {};
            await this.portraits().small(model, canvas, new AbortController().signal);
            return canvas;
        });
        this.last = made.catch(() => undefined);
        return made;
    }
}
