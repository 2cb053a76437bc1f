// The list of levels of detail: triangles, size on the screen and distances of each, a bar of the
// distances, and buttons that show a level as large as it is drawn last.
import { byId, grouped, make } from "./dom";
import { metres, type LevelRange } from "./level_ranges";
import { fovRange, screenHeights, type ViewState } from "./view_state";

export interface LevelListEvents {
    /** The field of view or the height of the screen was changed. */
    changed: (camera: Pick<ViewState, "fov" | "screen">) => void;
    /** A level was chosen to be shown; undefined for none. */
    chosen: (lod: number | undefined) => void;
}

export class LevelList {
    private readonly fov = make("input", {
        id: "level-fov",
        type: "number",
        min: fovRange.min,
        max: fovRange.max,
        inputmode: "decimal",
    });
    private readonly screen = make(
        "select",
        { id: "level-screen" },
        ...screenHeights.map((height) => make("option", { value: height }, `${height} px`)),
    );
    private readonly bar = make("div", { class: "level-bar", "aria-hidden": "true" });
    private readonly rows = make("tbody");
    private readonly note = make("p", { class: "hint", id: "level-note" });

    constructor(private readonly events: LevelListEvents) {
        const head = ["Level", "Triangles", "Down to", "Out to", ""].map((title) =>
            make("th", { scope: "col" }, title),
        );
        byId("levels").append(
            make(
                "div",
                { class: "level-camera" },
                make("label", { for: "level-fov" }, "Field of view"),
                this.fov,
                "°",
                make("label", { for: "level-screen" }, "Screen"),
                this.screen,
            ),
            this.bar,
            make(
                "table",
                { "aria-labelledby": "levels-title", "aria-describedby": "level-note" },
                make("thead", {}, make("tr", {}, ...head)),
                this.rows,
            ),
            this.note,
        );
        const changed = (): void => {
            if (!this.fov.checkValidity() || this.fov.value === "") return;
            this.events.changed({ fov: Number(this.fov.value), screen: Number(this.screen.value) });
        };
        this.fov.addEventListener("input", changed);
        this.screen.addEventListener("change", changed);
    }

    /** Shows levels, finest first.
     *
     *  @param inFile whether one file has all of them */
    show(ranges: readonly LevelRange[], view: ViewState, inFile: boolean): void {
        byId("levels").hidden = ranges.length === 0;
        if (document.activeElement !== this.fov) this.fov.value = String(view.fov);
        this.screen.value = String(view.screen);
        this.drawBar(ranges);
        // The focus stays on the button of the level.
        const focused = (document.activeElement as HTMLElement | null)?.dataset["level"];
        this.rows.replaceChildren(...ranges.map((range) => this.row(range, view.level)));
        if (focused !== undefined)
            this.rows.querySelector<HTMLElement>(`[data-level="${focused}"]`)?.focus();
        this.note.textContent = inFile
            ? "One file has all levels. Sizes are those of the longest side."
            : "Each level is a file of its own, chosen by lod; “lods” puts them into one. " +
              "Sizes are those of the longest side.";
    }

    private row(range: LevelRange, shown: number | undefined): HTMLElement {
        const { lod, triangles, screen_coverage: coverage, pixels, far } = range;
        const pressed = lod === shown;
        const button = make(
            "button",
            {
                type: "button",
                "data-level": lod,
                "aria-pressed": String(pressed),
                "aria-label": `Show level ${lod} at ${Math.round(pixels)} pixels`,
            },
            "Show",
        );
        button.addEventListener("click", () => this.events.chosen(pressed ? undefined : lod));
        const share = `${(100 * coverage).toPrecision(2)} % of the height of the screen`;
        return make(
            "tr",
            {},
            make("th", { scope: "row" }, `L${lod}`),
            make("td", {}, grouped(triangles)),
            make(
                "td",
                { title: share },
                `${pixels >= 10 ? Math.round(pixels) : pixels.toPrecision(2)} px`,
            ),
            make("td", {}, metres(far)),
            make("td", {}, button),
        );
    }

    /** Draws distances on a logarithmic scale; the finest level begins at a quarter of its end. */
    private drawBar(ranges: readonly LevelRange[]): void {
        const segments = ranges.map(({ lod, near, far }) => {
            const segment = make("span", {}, `L${lod}`);
            segment.style.flexGrow = String(Math.log2(far / (near || far / 4)));
            return segment;
        });
        this.bar.replaceChildren(...segments);
    }
}
