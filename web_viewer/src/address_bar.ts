// The page's URL: every change of a setting is written to it, and it is read on load and on
// history navigation.
import type { ProblemItem } from "./http";
import { libraryIdsOf } from "./library_list";
import { productOf } from "./products";
import { mixPattern, type Settings } from "./settings";
import type { SheetKind } from "./sheet";
import { viewNames, viewQuery, type ViewState } from "./view_state";

/** Changes of one setting within this time are one step of the browser's history. */
const sameStepMs = 1500;
/** Browsers refuse many writes in a short time: at most one is made in this time. */
const writeIntervalMs = 250;

/** What the page's URL says besides the settings. */
export interface AddressContents {
    /** The URL names another species or mix than the settings did. */
    otherMix: boolean;
    /** Settings that cannot be used. */
    rejected: ProblemItem[];
    sheet: string | null;
}

export class AddressBar {
    private lastWrite: { change: string; at: number } | undefined;
    private timer: ReturnType<typeof setTimeout> | undefined;

    /** `species` are those of the gallery, or its presets; the first is the default. `refused` has what the service
     *  says of others. */
    constructor(
        private readonly settings: Settings,
        private readonly species: readonly { id: string }[],
        private readonly refused: ReadonlyMap<string, string>,
    ) {}

    /** Writes the settings to the URL: one history step per drag or run of key presses. `change`
     *  names what was changed. */
    write(change: string): void {
        const now = performance.now();
        const last = this.lastWrite;
        const sameStep = last?.change === change && now - last.at < sameStepMs;
        if (sameStep && now - last.at < writeIntervalMs) {
            clearTimeout(this.timer);
            this.timer = setTimeout(() => this.flush(), writeIntervalMs);
            return;
        }
        this.flush();
        this.store(sameStep);
        this.lastWrite = { change, at: now };
    }

    /** Writes a delayed change at once. */
    flush(): void {
        if (this.timer === undefined) return;
        this.cancelWrite();
        this.store(true);
    }

    /** Writes which sheet is open; undefined for none. */
    writeSheet(kind: SheetKind | undefined): void {
        const query = new URLSearchParams(location.search);
        if ((query.get("sheet") ?? undefined) === kind) return;
        this.flush();
        const address = this.settings.pageQuery(query) + (kind ? `&sheet=${kind}` : "");
        history[kind ? "pushState" : "replaceState"](null, "", address);
    }

    /** Writes the state of the views, which is no step of the history. */
    writeView(view: ViewState): void {
        this.flush();
        const query = new URLSearchParams(location.search);
        for (const name of viewNames) query.delete(name);
        for (const [name, value] of new URLSearchParams(viewQuery(view))) query.set(name, value);
        const sheet = query.get("sheet");
        const address = this.settings.pageQuery(query) + (sheet ? `&sheet=${sheet}` : "");
        history.replaceState(null, "", address);
    }

    /** Reads the URL into the settings. Returns undefined, and loads the page anew, if the URL is
     *  of another product. */
    read(): AddressContents | undefined {
        this.cancelWrite();
        const { settings } = this;
        const { queryName: kind, ofSpecies } = settings.product;
        const query = new URLSearchParams(location.search);
        if (productOf(query) !== settings.product) {
            location.reload();
            return undefined;
        }
        const requested = query.get(kind);
        const before = settings.mix;
        const rejected = settings.readMorph(query, (id) => this.has(id));
        const usable = requested && this.canShow(requested) ? requested : (this.species[0]?.id ?? "");
        const mix = settings.morph ? settings.mix : usable;
        settings.mix = mix;
        rejected.push(...settings.read(query), ...settings.readMatrix(query));
        if (requested && requested !== mix) {
            const noun = ofSpecies ? "species" : kind;
            const why = libraryIdsOf(requested).map((id) => this.refused.get(id));
            const detail = why.find(Boolean) ?? `'${requested}' is no ${noun} here`;
            rejected.push({ parameter: kind, detail });
        }
        this.lastWrite = undefined;
        return { otherMix: mix !== before, rejected, sheet: query.get("sheet") };
    }

    private cancelWrite(): void {
        clearTimeout(this.timer);
        this.timer = undefined;
    }

    private store(replace: boolean): void {
        const address = this.settings.pageQuery(new URLSearchParams(location.search));
        if (address === location.search) return;
        history[replace ? "replaceState" : "pushState"](null, "", address);
    }

    /** Returns true if all members of a mix are species of this server. */
    private canShow(mix: string): boolean {
        const members = mix.split(",").map((member) => member.split(":")[0] ?? "");
        return mixPattern.test(mix) && members.every((id) => this.has(id));
    }

    private has(id: string): boolean {
        return this.species.some((one) => one.id === id);
    }
}
