// The export panel: what a file costs, its levels of detail, debug views, and what can be copied.
// The switches of the file are controls of the schema's group "file" (controls.ts).
import { byId, make } from "./dom";
import { getJson } from "./http";
import { LevelList } from "./level_list";
import { rangesOf, type LevelReport, type LevelRange } from "./level_ranges";
import { countsOf, modelLevels, modelWind } from "./model";
import type { LoadedModel, ModelReport } from "./model_loader";
import { showNumbers } from "./number_list";
import { valueAt } from "./schema";
import type { Settings } from "./settings";
import { describedSolids, solidsOf } from "./solids";
import type { Stage } from "./stage";
import { windChannels, type ViewState, type ViewStore } from "./view_state";

export interface ExportPanelEvents {
    /** Another level of detail was chosen for the file; the settings have it already. */
    lodChosen: () => void;
}

export class ExportPanel {
    private loaded: LoadedModel | undefined;
    private report: ModelReport | undefined;
    /** Levels that are finer than the file of one level, as files of their own. */
    private finer: readonly LevelReport[] = [];
    private readonly list: LevelList;

    constructor(
        private readonly settings: Settings,
        private readonly stage: Stage,
        private readonly views: ViewStore,
        private readonly events: ExportPanelEvents,
    ) {
        views.listen(() => this.apply());
        this.list = new LevelList({
            changed: (camera) => views.change(camera),
            chosen: (lod) => this.chooseLevel(lod),
        });
        const solids = byId<HTMLButtonElement>("solids");
        solids.addEventListener("click", () => this.views.change({ solids: !this.view.solids }));
        for (const channel of windChannels) {
            const label = channel.charAt(0).toUpperCase() + channel.slice(1);
            const title = channel === "all" ? "Bend red, flutter green, phase blue" : undefined;
            const attributes = { type: "button", title, "data-channel": channel };
            const button = make("button", attributes, label);
            button.addEventListener("click", () =>
                this.views.change({ weights: this.view.weights === channel ? undefined : channel }),
            );
            byId("wind-channels").append(button);
        }
        this.apply();
    }

    /** The levels of detail from that of the file on. */
    get lods(): number[] {
        return (this.report?.levels ?? []).map(({ lod }) => lod);
    }

    /** Shows what the file of a model costs. */
    show(loaded: LoadedModel): void {
        this.loaded = loaded;
        this.apply();
    }

    /** Shows what the service reports about the shown model. */
    showReport(report: ModelReport): void {
        this.report = report;
        this.finer = [];
        const { collision } = report;
        if (collision && this.loaded && solidsOf(this.loaded.model).length === 0)
            this.stage.addSolids(describedSolids(collision));
        const lod = this.lods[0];
        if (!this.inFile && this.view.level !== undefined && this.view.level !== lod) {
            // The level was changed elsewhere.
            this.views.change({ level: lod });
        }
        this.apply();
        void this.addFinerLevels(report);
    }

    private get view(): ViewState {
        return this.views.current;
    }

    private get inFile(): boolean {
        return this.loaded !== undefined && modelLevels(this.loaded.model).length > 1;
    }

    /** All levels, with the triangles that the file has, as far as it is known. */
    private get levels(): LevelReport[] {
        const model = this.loaded?.draft === false ? this.loaded.model : undefined;
        const nodes = model && this.inFile ? modelLevels(model) : [model];
        const own = (this.report?.levels ?? []).map((level, index) => {
            const node = nodes[index];
            return node ? { ...level, triangles: countsOf(node).triangles } : level;
        });
        return [...this.finer, ...own];
    }

    private get ranges(): LevelRange[] {
        const { min, max } = this.report?.bounds_m ?? { min: [0], max: [0] };
        const size = Math.max(...max.map((high, axis) => high - (min[axis] ?? 0)));
        return rangesOf(this.levels, size, this.view.fov, this.view.screen);
    }

    private chooseLevel(lod: number | undefined): void {
        this.views.change({ level: lod });
        if (lod === undefined || this.inFile || lod === this.lods[0]) return;
        this.settings.set("lod", lod);
        this.events.lodChosen();
    }

    private apply(): void {
        const { view, stage, loaded } = this;
        const ranges = this.ranges;
        const index = ranges.findIndex(({ lod }) => lod === view.level);
        stage.showLevel(this.inFile ? Math.max(index, 0) : 0, ranges[index]?.pixels);
        stage.solidsShown = view.solids;
        stage.weightsShown = view.weights;
        this.list.show(ranges, view, this.inFile);
        const hasSolids = loaded !== undefined && solidsOf(loaded.model).length > 0;
        const hasWind = loaded !== undefined && modelWind(loaded.model) !== undefined;
        const solids = byId<HTMLButtonElement>("solids");
        solids.disabled = !hasSolids;
        solids.setAttribute("aria-pressed", String(hasSolids && view.solids));
        byId("solids-missing").hidden = hasSolids;
        byId("wind-missing").hidden = hasWind;
        for (const button of byId("wind-channels").querySelectorAll("button")) {
            button.disabled = !hasWind;
            const shown = hasWind && button.dataset["channel"] === view.weights;
            button.setAttribute("aria-pressed", String(shown));
        }
        if (loaded) showNumbers(loaded);
    }

    /** Adds the levels above that of a file of one level, which the service describes for the
     *  finest one. */
    private async addFinerLevels(report: ModelReport): Promise<void> {
        const field = this.settings.field("lod");
        const lod = valueAt(report.effective, "lod");
        if (this.inFile || !report.levels?.length || field?.min === undefined) return;
        if (typeof lod !== "number" || lod <= field.min || this.settings.rows) return;
        const finest = new Map([["lod", field.min]]);
        const whole = await getJson<ModelReport>(this.settings.address(".json", finest)).catch(
            () => undefined,
        );
        if (this.report !== report || !whole?.levels) return;
        this.finer = whole.levels.filter((level) => level.lod < lod);
        this.apply();
    }
}
