// The designer's page: passes events between the photograph, the service, the model and the list of
// what was found. The history holds whole drawings; each of them has one trace.
import { centimetres, standing, standingCloseUps, viewNames, type ViewName } from "../camera";
import { byId, make } from "../dom";
import { saveFile } from "../file_actions";
import { History } from "../history";
import { asRequestFailed, RequestFailed, type ProblemItem } from "../http";
import { showLight } from "../photo_tools";
import { ProblemBox } from "../problem_box";
import { showProgress } from "../progress_box";
import { showScaleBar } from "../scale_bar";
import { Stage } from "../stage";
import { announce } from "../status_line";
import { Sketch } from "./sketch";
import { Findings } from "./findings";
import {
    missingLine,
    mostStrokes,
    placeOf,
    startOfDrawing,
    strokeCount,
    strokesOf,
    tools,
    withStrokes,
    type Drawing,
    type Gesture,
    type PlaceOnPage,
    type Tool,
} from "./gesture";
import { forgetDraft, loadDraft, saveDraft } from "./draft";
import { LiveModel } from "./live_model";
import { withInserted, withRemoved, type Silhouette } from "./outline";
import { OutlineEditor } from "./outline_editor";
import { PointTable } from "./point_table";
import {
    checkOutline,
    Photograph,
    shapeOf,
    sizeOf,
    withShape,
    type Source,
    type Trace,
} from "./service";
import { SpeciesFile } from "./species_file";

interface ToolWords {
    label: string;
    sentence: string;
    title: string;
}

const words: Readonly<Record<Tool, ToolWords>> = {
    axis: {
        label: "Foot to top",
        sentence: "Draw from the foot to the top",
        title: "The line through the middle of the stem up to the top of the cap",
    },
    cap: {
        label: "Across the cap",
        sentence: "Now across the cap",
        title: "The line from margin to margin",
    },
    keep: {
        label: "Keep",
        sentence: "Something is missing? Draw on it",
        title: "A stroke on a part of the mushroom that the outline leaves out",
    },
    drop: {
        label: "Drop",
        sentence: "Too much? Draw on what is no part of it",
        title: "A stroke on something that the outline includes by mistake",
    },
    frame: {
        label: "Frame",
        sentence: "Draw a frame around the mushroom",
        title: "What is outside of the frame is background",
    },
};

const viewLabels: Readonly<Record<Exclude<ViewName, "roots">, string>> = {
    front: "Front",
    "three-quarter": "Three-quarter",
    side: "Side",
    top: "Top",
    below: "Below",
};

/** Returns true for the JSON of a species; all else is a picture, or refused by the service. */
function isSpeciesFile(file: Blob): boolean {
    return file.type === "application/json" || (file instanceof File && /\.json$/i.test(file.name));
}

/** Time after which a step is in the draft, milliseconds. */
const saveDelayMs = 300;

export class Designer {
    private readonly history = new History<Drawing>(startOfDrawing);
    private readonly sketch: Sketch;
    private readonly table = new PointTable((gesture) => this.change({ gesture }));
    private readonly findings: Findings;
    private readonly problems = new ProblemBox((item) => this.showBeside(item));
    private stage: Stage | undefined;
    private live: LiveModel | undefined;
    private readonly outline: OutlineEditor;
    private editing = false;
    private photograph: Source | undefined;
    private address: string | undefined;
    private opening: AbortController | undefined;
    private tracing: AbortController | undefined;
    private checking: AbortController | undefined;
    private saving: ReturnType<typeof setTimeout> | undefined;
    /** As the service traced it, and with the outline as it is edited. */
    private traced: Trace | undefined;
    private trace: Trace | undefined;
    private shownStage = 0;
    private file: ArrayBuffer | undefined;
    private fresh = true;

    constructor() {
        this.sketch = new Sketch({
            drawn: (gesture) => this.drawn(gesture),
            pending: () => this.showOrder(),
            said: announce,
        });
        this.outline = new OutlineEditor((event) => this.sketch.exactly(event), {
            moving: (silhouette) => this.showDraft(silhouette),
            moved: (silhouette) =>
                this.reshape((old, stage) => (stage === this.traced?.stage ? silhouette : old)),
            // All stages have the same points, so that they can blend.
            insert: (at) => this.reshape((old) => withInserted(old, at)),
            remove: (at) => this.reshape((old) => withRemoved(old, at)),
            said: announce,
        });
        this.sketch.overlay(this.outline.element);
        this.findings = new Findings({
            template: (template) => this.change({ template }),
            stage: (index) => this.showStage(index),
        });
        for (const tool of tools) {
            const { label, title } = words[tool];
            const button = make("button", { type: "button", "data-tool": tool, title }, label);
            button.addEventListener("click", () => this.use(tool));
            byId("tools").append(button);
        }
        const edit = make(
            "button",
            { type: "button", "data-tool": "outline", title: "Move the points of the outline" },
            "Outline",
        );
        edit.addEventListener("click", () => this.edit());
        byId("tools").append(edit);
        this.connect();
        this.state = "empty";
    }

    /** Opens the draft of the last visit, if there is one. */
    async resume(): Promise<void> {
        const draft = await loadDraft();
        if (!draft || this.photograph || this.opening) return;
        await this.open(draft.file, { ...startOfDrawing, ...draft.drawing });
        if (this.photograph) announce("The draft of the last visit is open again.");
    }

    /** Opens a photograph in place of the last one. */
    async open(file: Blob, drawing = startOfDrawing): Promise<void> {
        this.opening?.abort();
        const opening = new AbortController();
        this.opening = opening;
        this.state = "busy";
        this.showProblemOfPhoto(undefined);
        byId("drop-here").classList.add("sending");
        announce(isSpeciesFile(file) ? "Reading the species." : "Sending the photograph.");
        try {
            const photograph = isSpeciesFile(file)
                ? await SpeciesFile.read(file)
                : await Photograph.upload(file, opening.signal, announce);
            const address = URL.createObjectURL(await photograph.picture(opening.signal));
            if (opening.signal.aborted) return URL.revokeObjectURL(address);
            this.begin(photograph, address, drawing);
        } catch (error) {
            if (opening.signal.aborted) return;
            this.state = this.photograph ? "ready" : "failed";
            this.showProblemOfPhoto(asRequestFailed(error, "The photograph cannot be read"));
        } finally {
            if (this.opening === opening) byId("drop-here").classList.remove("sending");
        }
    }

    private begin(photograph: Source, address: string, drawing: Drawing): void {
        this.photograph?.forget();
        if (this.address) URL.revokeObjectURL(this.address);
        this.photograph = photograph;
        this.address = address;
        this.history.begin(drawing);
        this.fresh = true;
        byId("welcome").hidden = true;
        for (const id of ["desk", "stage", "panel"]) byId(id).hidden = false;
        document.body.classList.add("working");
        this.makeStage();
        this.sketch.open(address, photograph.stored);
        this.showTrace(undefined);
        this.use(this.missing() ?? "keep");
        byId("sketch").focus();
        byId("sketch").classList.toggle("paper", !photograph.drawable);
        for (const button of byId("tools").children)
            (button as HTMLElement).hidden =
                !photograph.drawable && (button as HTMLElement).dataset["tool"] !== "outline";
        byId("size").hidden = !photograph.drawable;
        this.restored();
        if (!photograph.drawable) return this.edit();
        if (photograph.stored.alpha) announce("It is cut out already: traced at once.");
        else announce(`${byId("sentence").textContent}.`);
    }

    /** Forgets the photograph, here and at the service, and starts anew. */
    private forget(): void {
        clearTimeout(this.saving);
        this.photograph?.forget();
        void forgetDraft().finally(() => location.reload());
    }

    /** The stage needs a size, which it has once it is shown. */
    private makeStage(): void {
        if (this.stage) return;
        const stage = new Stage(byId("stage"), byId<HTMLCanvasElement>("canvas"), {
            reducedMotion: matchMedia("(prefers-reduced-motion: reduce)").matches,
            withoutMargins: false,
            directions: standing,
            closeUps: standingCloseUps,
            liesOnGround: false,
        });
        showLight(stage, "daylight");
        const look = (view: ViewName): void => {
            stage.look(view, false);
            for (const button of byId("views").children)
                button.setAttribute("aria-pressed", String(button.id === `view-${view}`));
        };
        const names = ["front", "three-quarter", "side", "top", "below"] as const;
        for (const name of names) {
            const button = make("button", { type: "button", id: `view-${name}` }, viewLabels[name]);
            button.addEventListener("click", () => look(name));
            byId("views").append(button);
        }
        stage.onTurned = () => {
            for (const button of byId("views").children)
                button.setAttribute("aria-pressed", "false");
        };
        stage.onKey = (view) => {
            if (view === "home") return stage.fit();
            const name = viewNames[view];
            if (name) look(name);
        };
        stage.onFrame = () => showScaleBar(stage, "mushroom");
        look("front");
        this.stage = stage;
        this.live = new LiveModel(stage, {
            progress: showProgress,
            failed: (error) => {
                this.state = "failed";
                this.showFailure(error);
            },
            shown: (file) => {
                this.file = file;
                byId("stage-hint").hidden = true;
                byId<HTMLButtonElement>("download-glb").disabled = false;
                void stage.drawn().then(() => {
                    if (this.live?.idle && !this.tracing) this.state = "ready";
                });
            },
        });
    }

    private connect(): void {
        const input = byId<HTMLInputElement>("file");
        for (const id of ["choose", "another"])
            byId(id).addEventListener("click", () => input.click());
        input.addEventListener("change", () => {
            const chosen = input.files?.[0];
            input.value = "";
            if (chosen) void this.open(chosen);
        });
        byId("undo").addEventListener("click", () => this.step("undo"));
        byId("redo").addEventListener("click", () => this.step("redo"));
        byId("finish").addEventListener("click", () => this.sketch.finish());
        byId("take-back").addEventListener("click", () => this.sketch.takeBack());
        byId("clear").addEventListener("click", () => {
            const { gesture } = this.history.value;
            this.change({ gesture: withStrokes(gesture, this.sketch.tool, []) });
        });
        byId("forget").addEventListener("click", () => this.forget());
        byId("trace-now").addEventListener("click", () => void this.retrace(true));
        const shown = byId<HTMLInputElement>("show-trace");
        shown.addEventListener("change", () =>
            byId("sketch").classList.toggle("bare", !shown.checked),
        );
        const height = byId<HTMLInputElement>("height");
        height.addEventListener("change", () => {
            if (height.validity.badInput) return this.say("height", "This is not a number.");
            const heightMm = height.value === "" ? undefined : height.valueAsNumber;
            this.change({ heightMm });
        });
        const form = byId<HTMLSelectElement>("form");
        form.addEventListener("change", () => this.change({ form: form.value }));
        const images = byId<HTMLInputElement>("images");
        images.addEventListener("change", () => this.change({ images: images.checked }));
        byId("download-glb").addEventListener("click", () => {
            if (!this.file || !this.trace) return;
            const blob = new Blob([this.file], { type: "model/gltf-binary" });
            saveFile(blob, `${this.trace.species.id}.glb`);
        });
        byId("download-json").addEventListener("click", () => {
            if (!this.trace) return;
            const { species } = this.trace;
            const text = `${JSON.stringify(species, null, 2)}\n`;
            saveFile(new Blob([text], { type: "application/json" }), `${species.id}.json`);
        });
        addEventListener("keydown", (event) => this.key(event));
    }

    private key(event: KeyboardEvent): void {
        if (!(event.ctrlKey || event.metaKey) || event.altKey || !this.photograph) return;
        // Fields of text have an undo of their own.
        if (event.target instanceof HTMLInputElement && event.target.type === "number") return;
        const pressed = event.key.toLowerCase();
        if (pressed !== "z" && pressed !== "y") return;
        event.preventDefault();
        this.step(pressed === "y" || event.shiftKey ? "redo" : "undo");
    }

    private step(kind: "undo" | "redo"): void {
        if (kind === "undo" && this.sketch.takeBack()) return;
        if (!(kind === "undo" ? this.history.undoable : this.history.redoable)) return;
        this.history[kind]();
        announce(kind === "undo" ? "Undone." : "Done again.");
        const missing = this.missing();
        if (missing && missing !== this.sketch.tool) this.use(missing);
        this.restored();
    }

    /** A stroke is complete: the next one follows by itself. */
    private drawn(gesture: Gesture): void {
        if (strokeCount(gesture) > mostStrokes) {
            announce(
                `A photograph takes ${mostStrokes} strokes at most; clear some of them first.`,
            );
            this.sketch.gesture = this.history.value.gesture;
            return;
        }
        const { tool } = this.sketch;
        const first = strokesOf(this.history.value.gesture, tool).length === 0;
        this.change({ gesture });
        const missing = this.missing();
        if (missing && missing !== tool) {
            this.use(missing);
            announce(`${words[missing].sentence}.`);
        } else if (!missing && first && tool === "cap") {
            this.use("keep");
        }
    }

    /** A change of what is traced discards an edited outline; undo brings it back. */
    private change(change: Partial<Drawing>): void {
        this.history.push({ ...this.history.value, shape: undefined, ...change });
        this.restored();
    }

    /** Changes the outlines of all stages. */
    private reshape(changed: (old: Silhouette, stage: number) => Silhouette): void {
        const shape = this.trace && shapeOf(this.trace.species);
        if (shape) this.change({ shape: shape.map(changed) });
    }

    /** Shows the model with an outline that is being dragged. */
    private showDraft(silhouette: Silhouette): void {
        const { traced } = this;
        const model = traced?.species.stages[traced.stage]?.model;
        if (model) this.live?.show({ ...model, silhouette }, { draft: true });
    }

    /** Lets the service judge an edited outline. */
    private async check(): Promise<void> {
        this.checking?.abort();
        const { trace } = this;
        const model = trace?.species.stages[trace.stage]?.model;
        if (!trace || !model || (trace.certificate && !this.history.value.shape)) return;
        const checking = new AbortController();
        this.checking = checking;
        try {
            const { simple, method, problem } = await checkOutline(model, checking.signal);
            if (checking.signal.aborted) return;
            const certificate = { simple, method };
            this.findings.show({ ...trace, certificate }, this.history.value);
            if (problem) this.say("outline", problem.detail);
        } catch (error) {
            if (checking.signal.aborted) return;
            this.showFailure(asRequestFailed(error, "The outline cannot be checked"));
        }
    }

    /** Shows the points of the outline in place of the lines. */
    private edit(): void {
        this.editing = true;
        this.sketch.idle = true;
        this.showOutline();
        this.showTools();
        if (this.trace && this.shownStage !== this.trace.stage) this.showStage(this.trace.stage);
        this.outline.focus();
    }

    private showOutline(): void {
        const { trace, editing } = this;
        const model = editing ? trace?.species.stages[trace.stage]?.model : undefined;
        this.outline.show(model?.silhouette, trace?.outline.axis ?? []);
    }

    /** Shows the drawing that the history is at, and traces it. */
    private restored(): void {
        const { gesture, heightMm, form, images } = this.history.value;
        this.sketch.gesture = gesture;
        byId<HTMLSelectElement>("form").value = form;
        byId<HTMLInputElement>("images").checked = images;
        byId<HTMLInputElement>("height").value = heightMm === undefined ? "" : String(heightMm);
        byId<HTMLButtonElement>("undo").disabled = !this.history.undoable;
        byId<HTMLButtonElement>("redo").disabled = !this.history.redoable;
        this.showTools();
        this.save();
        void this.retrace(false);
    }

    /** Saves the draft, once for quick steps. */
    private save(): void {
        clearTimeout(this.saving);
        this.saving = setTimeout(() => {
            const { photograph } = this;
            if (photograph) void saveDraft({ file: photograph.file, drawing: this.history.value });
        }, saveDelayMs);
    }

    private missing(): "axis" | "cap" | undefined {
        const cutOut = this.photograph?.stored.alpha ?? false;
        return missingLine(this.history.value.gesture, cutOut);
    }

    private use(tool: Tool): void {
        this.editing = false;
        this.sketch.idle = false;
        this.showOutline();
        this.sketch.tool = tool;
        this.showTools();
    }

    private showTools(): void {
        const { gesture } = this.history.value;
        for (const button of byId("tools").children) {
            const name = (button as HTMLElement).dataset["tool"];
            const tool = tools.find((one) => one === name);
            const pressed = tool ? !this.editing && tool === this.sketch.tool : this.editing;
            button.setAttribute("aria-pressed", String(pressed));
            const done = tool ? strokesOf(gesture, tool).length > 0 : !!this.history.value.shape;
            button.classList.toggle("done", done);
            if (!tool) (button as HTMLButtonElement).disabled = !this.trace;
        }
        this.showOrder();
        byId("points").hidden = this.editing;
        if (this.photograph) this.table.show(gesture, this.sketch.tool, this.photograph.stored);
    }

    private showOrder(): void {
        const { tool, pending } = this.sketch;
        const { gesture } = this.history.value;
        const drawn = strokesOf(gesture, tool).length > 0;
        if (this.editing) {
            byId("sentence").textContent = "Drag a point, or move it by arrows";
            for (const id of ["stroke-tools", "clear", "trace-now"]) byId(id).hidden = true;
            return;
        }
        const moves = drawn && tool !== "keep" && tool !== "drop";
        byId("sentence").textContent = moves
            ? "Drag its points, or draw it anew"
            : words[tool].sentence;
        byId("stroke-tools").hidden = pending === 0;
        byId<HTMLButtonElement>("finish").disabled = pending < 2;
        byId("clear").hidden = !drawn || pending > 0;
        byId("trace-now").hidden = tool !== "cap" || this.missing() !== "cap" || pending > 0;
    }

    /** Traces the drawing if it has the lines for it; `bare` does without the line of the cap. */
    private async retrace(bare: boolean): Promise<void> {
        this.tracing?.abort();
        this.tracing = undefined;
        byId("busy").hidden = true;
        this.problems.hide();
        this.clearErrors();
        const missing = this.missing();
        const { photograph } = this;
        if (!photograph || missing === "axis" || (missing === "cap" && !bare)) {
            this.showTrace(undefined);
            this.state = "ready";
            return;
        }
        const tracing = new AbortController();
        this.tracing = tracing;
        this.state = "busy";
        const busy = setTimeout(() => (byId("busy").hidden = false), 120);
        try {
            const trace = await photograph.trace(this.history.value, tracing.signal);
            if (tracing.signal.aborted) return;
            this.tracing = undefined;
            this.showTrace(trace);
            // What an edit has done is announced where it is done.
            if (!this.history.value.shape) announce(this.summary(trace));
        } catch (error) {
            if (tracing.signal.aborted) return;
            this.tracing = undefined;
            this.state = "failed";
            this.stale = true;
            this.showFailure(asRequestFailed(error, "The photograph cannot be traced"));
        } finally {
            clearTimeout(busy);
            if (!this.tracing) byId("busy").hidden = true;
        }
    }

    private summary({ species, stage, nearest, error_pct: error }: Trace): string {
        const size = sizeOf(species.stages[stage]?.model ?? {});
        const tall = size ? `${centimetres(size.height, 1)} high` : "";
        if (error === undefined)
            return `Opened: ${species.facts?.common_name ?? species.id}, ${tall}.`;
        const like = nearest[0] ? ` It looks like our ${nearest[0].name}.` : "";
        return `Traced: ${tall}, error ${error.toFixed(1)} %.${like}`;
    }

    private showTrace(traced: Trace | undefined): void {
        const { shape } = this.history.value;
        const trace = traced && withShape(traced, shape);
        this.traced = traced;
        this.trace = trace;
        this.stale = false;
        this.sketch.showTrace(trace);
        this.findings.show(trace, this.history.value);
        if (!trace && this.editing && this.photograph?.drawable) this.use(this.missing() ?? "keep");
        this.showOutline();
        this.showTools();
        void this.check();
        byId("panel-hint").hidden = !!trace;
        const height = trace && sizeOf(trace.species.stages[trace.stage]?.model ?? {})?.height;
        byId<HTMLInputElement>("height").placeholder =
            height === undefined ? "" : String(Math.round(height * 1000));
        if (trace) return this.showStage(trace.stage);
        this.live?.cancel();
        this.findings.showStages(undefined, 0);
    }

    /** Shows the model of one stage of the species. */
    private showStage(index: number): void {
        const stage = this.trace?.species.stages[index];
        if (!stage) return;
        this.state = "busy";
        this.shownStage = index;
        this.findings.showStages(this.trace, index);
        this.file = undefined;
        byId<HTMLButtonElement>("download-glb").disabled = true;
        this.live?.show(stage.model, { refit: this.fresh });
        this.fresh = false;
    }

    private showFailure(error: RequestFailed): void {
        announce(error.message);
        const elsewhere = error.items.filter((item) => !this.showBeside(item));
        if (error.items.length > 0 && elsewhere.length === 0) return;
        this.problems.show(
            new RequestFailed(error.title, error.detail, error.status, elsewhere),
            () => void this.retrace(false),
        );
    }

    /** Shows what the service says beside what it is about. */
    private showBeside({ parameter, detail }: ProblemItem): boolean {
        const place = placeOf(parameter);
        if (!place) return false;
        this.say(place, detail);
        return true;
    }

    private say(place: PlaceOnPage, detail: string): void {
        if (place === "height" || place === "template" || place === "form") {
            const line = byId(`${place}-error`);
            line.hidden = false;
            line.textContent = detail;
            if (place !== "template") byId(place).setAttribute("aria-invalid", "true");
            // Without a trace the list of species is not shown.
            if (place === "template") byId("findings").hidden = false;
            return;
        }
        const tool = tools.find((name) => name === place);
        const name = tool ? words[tool].label : place === "outline" ? "Outline" : "Photograph";
        const line = make("li", { "data-place": place }, make("b", {}, name), ` ${detail}`);
        byId("gesture-errors").append(line);
        if (tool) byId("tools").querySelector(`[data-tool="${tool}"]`)?.classList.add("failed");
    }

    private clearErrors(): void {
        byId("gesture-errors").replaceChildren();
        for (const button of byId("tools").children) button.classList.remove("failed");
        for (const place of ["height", "template", "form"]) byId(`${place}-error`).hidden = true;
        for (const place of ["height", "form"]) byId(place).removeAttribute("aria-invalid");
    }

    /** Says why a file was not taken, beside where it was given. */
    private showProblemOfPhoto(error: RequestFailed | undefined): void {
        const line = byId("welcome-error");
        line.hidden = !error || !!this.photograph;
        byId("gesture-errors").replaceChildren();
        if (!error) return;
        const text = error.items.map(({ detail }) => detail).join(" ") || error.message;
        line.textContent = text;
        if (this.photograph) this.say("photo", text);
        announce(text);
    }

    /** What is shown belongs to an earlier drawing, because this one cannot be traced. */
    private set stale(stale: boolean) {
        document.body.classList.toggle("stale", stale);
    }

    /** What the page is at, for its style and for tests. */
    private set state(state: "empty" | "busy" | "ready" | "failed") {
        document.documentElement.dataset["designer"] = state;
    }
}
