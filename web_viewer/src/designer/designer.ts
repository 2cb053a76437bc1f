// The designer's page: passes events between the photograph, the service, the model and the list of
// what was found. The history holds whole drawings; each of them has one trace.
import { centimetres, standing, standingCloseUps, viewLabels, viewNames, type ViewName } from "../camera";
import { byId, make } from "../dom";
import { saveFile } from "../file_actions";
import { History } from "../history";
import { asRequestFailed, RequestFailed, send, type ProblemItem } from "../http";
import { showLight } from "../photo_tools";
import { ProblemBox } from "../problem_box";
import { showProgress } from "../progress_box";
import { showScaleBar } from "../scale_bar";
import { Stage } from "../stage";
import { announce } from "../status_line";
import { Sketch, type View } from "./sketch";
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
    sourcesOf,
    type Point,
    type Tool,
} from "./gesture";
import { forgetDraft, loadDraft, saveDraft } from "./draft";
import { LibraryPanel } from "./library_panel";
import { storedLink } from "./library_session";
import { LiveModel } from "./live_model";
import { AxisEditor } from "./axis_editor";
import {
    anglesOf,
    axisOf,
    placed,
    resampled,
    uprightAxis,
    withAxisPoint,
    withoutAxisPoint,
    type AxisPoint,
} from "./axis_line";
import {
    hasGeometry,
    modelPointer,
    withoutGeometry,
    withDetails,
    withoutStages,
    type Details,
    type Json,
} from "./details";
import { DetailsPanel, showFormProblem } from "./details_panel";
import { titleOfFile } from "./file_title";
import { Loupe } from "./loupe";
import { AxisFrame, polylineOf, withInserted, withRemoved, type Silhouette } from "./outline";
import { OutlineEditor, type ShownOutline } from "./outline_editor";
import { CapPhotos } from "./cap_photos";
import { OverPhoto, windowOf } from "./over_photo";
import { meanColour } from "./paint";
import { PaintPanel } from "./paint_panel";
import { PanelTabs } from "../panel_tabs";
import { Portraits } from "./portraits";
import { speciesSchema, tracedForms } from "./schemas";
import { SpeciesChooser } from "./species_chooser";
import { Sources, type Opened } from "./sources";
import { StageStrip } from "./stage_strip";
import { PointTable } from "./point_table";
import {
    checkOutline,
    Photograph,
    shapeOf,
    sizeOf,
    withEdits,
    type Source,
    type Stage as SpeciesStage,
    type Trace,
} from "./service";
import { SpeciesFile } from "./species_file";
import { words } from "./tool_words";

/** Returns true for the JSON of a species; all else is a picture, or refused by the service. */
function isSpeciesFile(file: Blob): boolean {
    return file.type === "application/json" || (file instanceof File && /\.json$/i.test(file.name));
}

/** Names of forms in the list; others are shown as the service names them. */
const formNames: Readonly<Record<string, string>> = {
    auto: "as it looks",
    capped: "stem and cap",
    morel: "morel: a head on a stem",
};

/** An axis with fewer points is easier to bend. */
const fewPoints = 5;

/** The most that the service takes, degrees. */
const mostBend = 90;
const mostLean = 45;

/** The eyedropper takes the mean of so many pixels of a photograph to each side. */
const eyedropperReach = 2;

/** Where a species has its title. */
const titlePointer = "/facts/common_name";

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
    private readonly axis: AxisEditor;
    private readonly strip: StageStrip;
    private readonly overPhoto: OverPhoto;
    private portraits: Portraits | undefined;
    private readonly paint: PaintPanel;
    private readonly details: DetailsPanel;
    private formsRequested = false;
    /** Lines are drawn, or points of the outline or of the axis are moved. */
    private mode: "draw" | "outline" | "bend" = "draw";
    private readonly library = new LibraryPanel(
        (file) => this.open(file),
        (title) => this.write({ [titlePointer]: title }),
        () => this.portraitRenderer,
        () => this.isBusy,
    );
    private readonly sources = new Sources();
    private readonly capPhotos = new CapPhotos(this.sources, (views, said) => {
        this.edited({ views });
        announce(said);
    });
    private shownSource: number | undefined;
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
            pinching: () => {
                this.outline.giveUp();
                this.axis.giveUp();
            },
            said: announce,
        });
        const loupe = new Loupe(() => this.sketch.ratio);
        const toPicture = (place: { clientX: number; clientY: number }): Point =>
            this.sketch.exactly(place);
        const shared = {
            covered: (place: Point | undefined) => loupe.show(place),
            focused: (place: Point) => this.sketch.reveal(place),
            said: announce,
        };
        this.outline = new OutlineEditor(toPicture, {
            ...shared,
            moving: (silhouette) => {
                this.strip.dragging(this.shownStage, silhouette);
                this.showDraft({ silhouette });
            },
            moved: (silhouette) =>
                this.reshape((old, stage) => (stage === this.shownStage ? silhouette : old)),
            // All stages have the same points, so that they can blend.
            insert: (at, share) => {
                this.reshape((old) => withInserted(old, at, share));
                announce("A point was added, in all stages.");
            },
            remove: (at) => {
                this.reshape((old) => withRemoved(old, at));
                announce("The point was removed, in all stages.");
            },
            whole: (whole) => this.moveWhole(whole),
        });
        this.axis = new AxisEditor(toPicture, {
            ...shared,
            moving: (axis) => this.showDraft({ axis }),
            moved: (axis) => this.bend((old, stage) => (stage === this.shownStage ? axis : old)),
            insert: (at) => this.bend((old) => withAxisPoint(old, at)),
            remove: (at) => this.bend((old) => withoutAxisPoint(old, at)),
        });
        const portraits = (): Portraits => this.portraitRenderer;
        this.overPhoto = new OverPhoto(portraits);
        for (const { element } of [this.overPhoto, this.outline, this.axis])
            this.sketch.overlay(element);
        this.strip = new StageStrip(
            (stage) => this.editStage(stage),
            portraits,
            () => this.isBusy,
        );
        this.findings = new Findings({ template: (template) => this.change({ template }) });
        const forms = {
            moving: (changes: Details) => this.showDraftOf(changes),
            changed: (changes: Details, restored: readonly string[]) =>
                this.write(changes, restored),
        };
        this.paint = new PaintPanel({
            ...forms,
            pick: (name) => this.pickColour(name),
            said: announce,
        });
        const everyAge = byId<HTMLInputElement>("every-age");
        // Colours seldom change with age, all else does.
        const ofEveryAge = { paint: true, ornaments: false, more: false };
        let form: keyof typeof ofEveryAge = "paint";
        everyAge.addEventListener("change", () => (ofEveryAge[form] = everyAge.checked));
        this.details = new DetailsPanel(() => everyAge.checked, forms);
        const panels = ["found", "paint", "ornaments", "more", "library"] as const;
        new PanelTabs(panels, (panel) => {
            const isForm = panel !== "found" && panel !== "library";
            byId("of-stage").hidden = !isForm;
            if (!isForm) return;
            form = panel;
            everyAge.checked = ofEveryAge[panel];
            void this.makeForms();
        });
        new SpeciesChooser(this.library, (file) => void this.open(file));
        void this.library.begin();
        for (const tool of tools) {
            const { label, title } = words[tool];
            const button = make("button", { type: "button", "data-tool": tool, title }, label);
            button.addEventListener("click", () => this.use(tool));
            byId("tools").append(button);
        }
        const modes = [
            ["outline", "Outline", "Move the points of the outline"],
            ["bend", "Axis", "Bend the stem"],
        ] as const;
        for (const [mode, label, title] of modes) {
            const button = make("button", { type: "button", "data-tool": mode, title }, label);
            button.addEventListener("click", () => this.edit(mode));
            byId("tools").append(button);
        }
        this.connect();
        this.state = "empty";
    }

    /** The renderer of small pictures, made once it is needed. */
    private get portraitRenderer(): Portraits {
        return (this.portraits ??= new Portraits());
    }

    /** Small pictures wait while this is true. */
    private get isBusy(): boolean {
        return (!!this.live && !this.live.idle) || !!this.tracing;
    }

    /** Opens the draft of the last visit, if there is one. */
    async resume(): Promise<void> {
        const draft = await loadDraft();
        if (!draft || this.photograph || this.opening) return;
        const whole = (each: Drawing): Drawing => ({ ...startOfDrawing, ...each });
        const linked = storedLink();
        this.sources.restore(draft.files);
        this.history.begin(whole(draft.drawing), draft.past.map(whole), draft.future.map(whole));
        if (!(await this.goTo(draft.drawing.source))) return this.history.begin(startOfDrawing);
        if (linked) this.library.resume(linked);
        announce("The draft of the last visit is open again.");
    }

    /** Opens a species of the library: a published version, or a draft with a key of its owner. */
    async openShared({ id, key }: { id: string; key: string | undefined }): Promise<void> {
        try {
            const query = key === undefined ? "" : `?share=${encodeURIComponent(key)}`;
            const text = await (await send(`v1/library/${id}${query}`)).text();
            const name = id.replace(/^.*\.|@.*$/g, "");
            await this.open(new File([text], `${name}.json`, { type: "application/json" }));
        } catch (error) {
            if (!this.photograph) this.state = "failed";
            this.showProblemOfPhoto(asRequestFailed(error, `${id} cannot be opened`));
        }
    }

    /** Takes a file that was dropped on a part of the page, or pasted while it has the focus. */
    receive(file: File, on: EventTarget | null): void {
        const side = this.capPhotos.sideAt(on);
        if (side) void this.capPhotos.choose(side, file);
        else void this.open(file);
    }

    /** Opens a photograph or the file of a species: one step, which undo takes back. Returns false if it cannot. */
    async open(file: Blob): Promise<boolean> {
        const opened = await this.read(file);
        if (!opened) return false;
        const { photograph } = this;
        const { source } = opened;
        if (photograph instanceof Photograph && source instanceof Photograph && photograph.isAgain(source)) {
            source.adopt(photograph);
            Object.assign(this.sources.at(this.history.value.source) ?? {}, opened);
            this.begin(opened);
            announce("The photograph is here again, with its lines.");
            return true;
        }
        const title = source.drawable && file instanceof File ? titleOfFile(file.name) : undefined;
        const drawing = {
            ...startOfDrawing,
            source: this.sources.add(opened),
            details: title === undefined ? undefined : { [titlePointer]: title },
        };
        this.leave();
        if (photograph || this.history.undoable) this.history.push(drawing);
        else this.history.begin(drawing);
        this.begin(opened);
        return true;
    }

    /** Reads a file and its picture; undefined if that fails, which is said, or if another file is opened meanwhile. */
    private async read(file: Blob): Promise<(Opened & { source: Source; address: string }) | undefined> {
        this.opening?.abort();
        const opening = new AbortController();
        this.opening = opening;
        this.state = "busy";
        this.showProblemOfPhoto(undefined);
        byId("drop-here").classList.add("sending");
        announce(isSpeciesFile(file) ? "Reading the species." : "Sending the photograph.");
        try {
            const source = isSpeciesFile(file)
                ? await SpeciesFile.read(file)
                : await Photograph.upload(file, opening.signal, announce);
            const address = URL.createObjectURL(await source.picture(opening.signal));
            if (!opening.signal.aborted) return { file, source, address };
            URL.revokeObjectURL(address);
        } catch (error) {
            if (opening.signal.aborted) return undefined;
            this.state = this.photograph ? "ready" : "failed";
            this.showProblemOfPhoto(asRequestFailed(error, "The photograph cannot be read"));
        } finally {
            if (this.opening === opening) {
                this.opening = undefined;
                byId("drop-here").classList.remove("sending");
            }
        }
        return undefined;
    }

    /** Shows what a step of the history has opened; returns false if it cannot be opened again. */
    private async goTo(number: number | undefined): Promise<boolean> {
        const opened = this.sources.at(number);
        this.leave();
        if (!opened) {
            this.showNothing();
            return true;
        }
        if (!opened.source && opened.file) {
            const again = await this.read(opened.file);
            if (!again) return false;
            Object.assign(opened, again);
        }
        if (opened.source && !opened.address) {
            const picture = await opened.source.picture(new AbortController().signal);
            opened.address = URL.createObjectURL(picture);
        }
        this.begin(opened);
        return true;
    }

    /** What is worked on is to be left: its draft in the library is found again when undo comes back to it. */
    private leave(): void {
        this.tracing?.abort();
        this.capPhotos.leave();
        const left = this.sources.at(this.shownSource);
        if (left) left.link = this.library.linked;
        this.library.forget();
    }

    /** Shows what the history is at. */
    private begin({ source: photograph, address, link }: Opened): void {
        if (!photograph || !address) return;
        const isOther = this.photograph !== photograph;
        this.shownSource = this.history.value.source;
        this.photograph = photograph;
        this.address = address;
        this.fresh = isOther;
        byId("welcome").hidden = true;
        for (const id of ["desk", "stage", "panel"]) byId(id).hidden = false;
        document.body.classList.add("working");
        this.makeStage();
        this.sketch.open(address, photograph.stored);
        this.overPhoto.open(photograph.stored);
        this.showTrace(undefined);
        this.use(this.missing() ?? "keep");
        byId("sketch").focus();
        byId("sketch").classList.toggle("paper", !photograph.drawable);
        for (const button of byId("tools").children)
            (button as HTMLElement).hidden =
                !photograph.drawable &&
                tools.some((tool) => tool === (button as HTMLElement).dataset["tool"]);
        for (const id of ["size", "cap-photos"]) byId(id).hidden = !photograph.drawable;
        byId("forgotten").hidden = !photograph.isForgotten;
        byId("forget").hidden = photograph.isForgotten;
        if (link) this.library.resume(link);
        this.restored();
        if (photograph.isForgotten) announce(byId("forgotten-text").textContent ?? "");
        if (!photograph.drawable) return this.edit("outline");
        if (photograph.stored.alpha) announce("It is cut out already: traced at once.");
        else announce(`${byId("sentence").textContent}.`);
    }

    /** Shows the page as it is before something is opened. */
    private showNothing(): void {
        this.photograph = undefined;
        this.shownSource = undefined;
        this.showTrace(undefined);
        document.body.classList.remove("working");
        for (const id of ["desk", "stage", "panel"]) byId(id).hidden = true;
        byId("welcome").hidden = false;
        byId("bring-back").hidden = !this.history.undoable;
        byId("choose").focus();
        this.state = "empty";
    }

    /** Forgets the photograph, here and at the service, and the draft. The step can be undone as far as the shape is
     *  concerned. */
    private forget(): void {
        clearTimeout(this.saving);
        const opened = this.sources.at(this.shownSource);
        const { past, future } = this.history.steps;
        const steps = [...past, this.history.value, ...future];
        const alike = steps.filter(({ source }) => source === this.shownSource);
        this.sources.forget(new Set(alike.flatMap(sourcesOf)));
        this.history.push(startOfDrawing);
        void this.goTo(undefined);
        void forgetDraft();
        announce(
            opened?.file
                ? "The species is put away. Undo brings it back."
                : "The photograph is forgotten, here and at the service. Undo brings back its shape.",
        );
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
            arrived: (file) => this.showOverPhoto(file),
            shown: (file) => {
                this.file = file;
                this.formerModel = undefined;
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
        const overPhoto = byId<HTMLInputElement>("over-photo");
        overPhoto.addEventListener("change", () => {
            if (!overPhoto.checked) this.overPhoto.clear();
            else if (this.file) this.showOverPhoto(this.file);
        });
        byId("zoom-in").addEventListener("click", () => this.sketch.zoomIn());
        byId("zoom-out").addEventListener("click", () => this.sketch.zoomOut());
        byId("zoom-whole").addEventListener("click", () => this.sketch.zoomWhole());
        const editor = (): OutlineEditor | AxisEditor =>
            this.mode === "bend" ? this.axis : this.outline;
        byId("add-point").addEventListener("click", () => editor().insert());
        byId("remove-point").addEventListener("click", () => editor().remove());
        byId("whole-curve").addEventListener("click", () => {
            this.moveWhole(byId("whole-curve").getAttribute("aria-pressed") !== "true");
        });
        byId("bend-axis").addEventListener("click", () => {
            this.bend(() => uprightAxis());
            this.axis.focus();
            announce("The stem has an axis of four points; move them to bend it.");
        });
        byId("fewer-points").addEventListener("click", () => {
            this.bend((old) => resampled(old, fewPoints));
            announce(`The axis has ${fewPoints} points now, in all stages.`);
        });
        byId("straighten").addEventListener("click", () => this.straighten());
        byId("finish").addEventListener("click", () => this.sketch.finish());
        byId("take-back").addEventListener("click", () => this.sketch.takeBack());
        byId("clear").addEventListener("click", () => {
            const { gesture } = this.history.value;
            this.change({ gesture: withStrokes(gesture, this.sketch.tool, []) });
        });
        byId("forget").addEventListener("click", () => this.forget());
        byId("bring-back").addEventListener("click", () => this.step("undo"));
        byId("load-again").addEventListener("click", () => input.click());
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
        void this.listForms();
    }

    /** Fills the list of forms with those that the service can look for. */
    private async listForms(): Promise<void> {
        const form = byId<HTMLSelectElement>("form");
        try {
            const options = (await tracedForms()).map((name) =>
                make("option", { value: name }, formNames[name] ?? name),
            );
            if (options.length > 0) form.replaceChildren(...options);
            form.value = this.history.value.form;
        } catch (error) {
            this.say("form", asRequestFailed(error, "The forms cannot be listed").message);
        }
    }

    private key(event: KeyboardEvent): void {
        if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
        // Fields of text have an undo of their own.
        const { target } = event;
        if (target instanceof HTMLInputElement && /^(number|text|search)$/.test(target.type))
            return;
        const pressed = event.key.toLowerCase();
        if (pressed !== "z" && pressed !== "y") return;
        event.preventDefault();
        this.step(pressed === "y" || event.shiftKey ? "redo" : "undo");
    }

    private step(kind: "undo" | "redo"): void {
        if (kind === "undo" && this.sketch.takeBack()) return;
        if (!(kind === "undo" ? this.history.undoable : this.history.redoable)) return;
        const before = this.history.value;
        this.history[kind]();
        announce(kind === "undo" ? "Undone." : "Done again.");
        if (this.history.value.source !== this.shownSource) return void this.stepTo(kind);
        this.followStep(before, this.history.value);
        const missing = this.missing();
        if (missing && missing !== this.sketch.tool) this.use(missing);
        this.restored();
    }

    /** Shows what another step has opened; if that cannot be had, the step is taken back. */
    private async stepTo(kind: "undo" | "redo"): Promise<void> {
        const { value } = this.history;
        if (await this.goTo(value.source)) return;
        if (this.history.value !== value) return;
        this.history[kind === "undo" ? "redo" : "undo"]();
        const now = this.sources.at(this.history.value.source);
        if (!now) return this.showNothing();
        this.begin(now);
        this.say("photo", "What was open before cannot be opened again.");
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

    /** Undo and redo show the stage whose outline they change. */
    private followStep(before: Drawing, after: Drawing): void {
        const count = Math.max(before.shape?.length ?? 0, after.shape?.length ?? 0);
        const traced = this.traced && shapeOf(this.traced.species);
        const of = (drawing: Drawing, stage: number): unknown =>
            drawing.shape?.[stage] ?? traced?.[stage];
        const changed = Array.from({ length: count }, (_, stage) => stage).filter(
            (stage) => of(before, stage) !== of(after, stage),
        );
        if (changed.length > 0 && !changed.includes(this.shownStage))
            this.shownStage = changed[0] ?? this.shownStage;
    }

    /** A change of what is traced discards an edited outline and axis, and one of the species that
     *  lends the rest discards all changes of its stages; undo brings them back. */
    private change(change: Partial<Drawing>): void {
        const { details } = this.history.value;
        const lent = "template" in change || "form" in change;
        const left = lent ? withoutStages(details) : withoutGeometry(details);
        this.history.push({ ...this.history.value, shape: undefined, details: left, ...change });
        this.restored();
    }

    /** Changes the species itself: one step of undo. */
    private edited(change: Pick<Drawing, "shape" | "details" | "views">): void {
        this.history.push({ ...this.history.value, ...change });
        this.restored();
    }

    /** Changes the outlines of all stages. */
    private reshape(changed: (old: Silhouette, stage: number) => Silhouette): void {
        const shape = this.trace && shapeOf(this.trace.species);
        if (shape) this.edited({ shape: shape.map(changed) });
    }

    /** Changes values of the document, by JSON pointer; those of a second list are again as they
     *  were traced or opened. */
    private write(changes: Details, restored: readonly string[] = []): void {
        const details = { ...this.history.value.details };
        for (const pointer of restored) delete details[pointer];
        // A changed pointer is the last, so that it has its effect.
        for (const [pointer, value] of Object.entries(changes)) {
            delete details[pointer];
            details[pointer] = value;
        }
        this.edited({ details: Object.keys(details).length > 0 ? details : undefined });
    }

    /** Shows the model with values that are being changed. */
    private showDraftOf(changes: Details): void {
        const species = this.trace && withDetails(this.trace.species, changes);
        const model = species?.stages[this.shownStage]?.model;
        if (model) this.live?.show(model, { draft: true });
    }

    /** Makes the forms from the service's schema, once they are wanted. */
    private async makeForms(): Promise<void> {
        if (this.formsRequested) return;
        this.formsRequested = true;
        try {
            const schema = await speciesSchema();
            for (const id of ["paint", "ornaments", "more"]) byId(id).replaceChildren();
            this.paint.use(schema.properties?.["stages"]?.items?.properties?.["model"] ?? {});
            this.details.use(schema);
        } catch (error) {
            this.formsRequested = false;
            showFormProblem(asRequestFailed(error, "The form cannot be made").message);
        }
    }

    private showForms(): void {
        const { trace, traced, shownStage } = this;
        const { age, name } = this.stages[shownStage] ?? { age: 0, name: "" };
        byId("of-stage-name").textContent = `Age ${Math.round(age * 100)} %: ${name}`;
        const canPick = this.photograph?.drawable ?? false;
        this.paint.show(trace?.species, traced?.species, shownStage, canPick);
        const ages = this.stages.map((stage) => stage.age);
        this.details.show(traced?.species, ages, this.history.value.details, shownStage);
    }

    /** Lets a place of the photograph be chosen and returns its colour. */
    private async pickColour(name: string): Promise<string | undefined> {
        const text = `Choose a place for ${name}`;
        byId("sentence").textContent = text;
        announce(`${text}: click, or move the crosshair and press Enter. Escape gives up.`);
        const place = await new Promise<Point | undefined>((done) => this.sketch.pick(done));
        this.showOrder();
        const { address } = this;
        if (!place || !address) return undefined;
        const picture = new Image();
        picture.src = address;
        await picture.decode();
        const side = 2 * eyedropperReach + 1;
        const canvas = make("canvas", { width: side, height: side });
        const context = canvas.getContext("2d");
        context?.drawImage(picture, eyedropperReach - place[0], eyedropperReach - place[1]);
        if (!context) return undefined;
        const colour = meanColour(context.getImageData(0, 0, side, side).data);
        if (colour) announce(`${name}: ${colour}.`);
        return colour;
    }

    private get stages(): readonly SpeciesStage[] {
        return this.trace?.species.stages ?? [];
    }

    /** Changes the axes of all stages. */
    private bend(changed: (old: AxisPoint[], stage: number) => AxisPoint[]): void {
        const changes = this.stages.map(({ model }, stage): [string, Json] => [
            modelPointer(stage, "axis"),
            changed(axisOf(model), stage).map(({ x, y, z }) => ({ x, y, z })),
        ]);
        this.write(Object.fromEntries(changes));
    }

    /** Turns the axes of all stages into angles, whose directions are each individual's own. */
    private straighten(): void {
        const changes: Record<string, Json> = {};
        const rounded = (value: number, most: number): number =>
            Math.min(Math.round(10 * value) / 10, most);
        for (const [stage, { model }] of this.stages.entries()) {
            const { bend_deg: bend, lean_deg: lean } = anglesOf(axisOf(model));
            const { deformation } = model;
            const pointer = (member: string): string => modelPointer(stage, member);
            changes[pointer("axis")] = [];
            const bends = (deformation?.bend_deg ?? 0) + bend;
            const leans = (deformation?.lean_deg ?? 0) + lean;
            changes[pointer("deformation/bend_deg")] = rounded(bends, mostBend);
            changes[pointer("deformation/lean_deg")] = rounded(leans, mostLean);
        }
        this.write(changes);
        const { deformation } = this.stages[this.shownStage]?.model ?? {};
        announce(
            `The axis is straight: the stem bends by ${deformation?.bend_deg ?? 0}° and leans by ` +
                `${deformation?.lean_deg ?? 0}°, each individual in a direction of its own.`,
        );
    }

    private moveWhole(whole: boolean): void {
        this.outline.wholeCurves = whole;
        byId("whole-curve").setAttribute("aria-pressed", String(whole));
        announce(whole ? "Whole curves are moved." : "Single points are moved.");
    }

    /** Shows the model with what is being dragged. */
    private showDraft(change: Partial<SpeciesStage["model"]>): void {
        const model = this.stages[this.shownStage]?.model;
        if (model) this.live?.show({ ...model, ...change }, { draft: true });
    }

    /** Where the traced axis is on the photograph, in metres of the traced stage. */
    private get tracedFrame(): AxisFrame | undefined {
        const { traced } = this;
        const apex = traced?.species.stages[traced.stage]?.model.silhouette?.cap.at(-1)?.y;
        if (!traced || !apex || traced.outline.axis.length < 2) return undefined;
        return new AxisFrame(traced.outline.axis, apex);
    }

    /** Draws a model over the photograph, if that is wanted. */
    private showOverPhoto(file: ArrayBuffer): void {
        const model = this.stages[this.shownStage]?.model;
        const { tracedFrame: frame, photograph } = this;
        if (!this.overPhoto.shown || !model || !frame || !photograph) return;
        const seen = windowOf(model, frame, photograph.stored);
        this.overPhoto.show(file, seen).catch((error: unknown) => {
            this.showFailure(
                asRequestFailed(error, "The model cannot be drawn over the photograph"),
            );
        });
    }

    /** Edits the outline of a stage, near enough to see it. */
    private editStage(stage: number): void {
        const before = this.shownStage;
        this.shownStage = stage;
        if (this.mode === "draw") this.edit("outline");
        else this.showOutline();
        this.showStage(stage);
        if (stage !== before || this.mode === "draw") this.comeNear();
        const { age, name } = this.stages[stage] ?? { age: 0, name: "" };
        announce(`Age ${Math.round(age * 100)} %: ${name}.`);
    }

    private comeNear(): void {
        const box = this.boxOfOutline();
        if (box) this.sketch.zoomTo(box);
    }

    /** Returns what of the picture the outline of the shown stage takes. */
    private boxOfOutline(): View | undefined {
        const model = this.stages[this.shownStage]?.model;
        const frame = this.tracedFrame;
        const place = model && frame && placed(model, frame);
        if (!model?.silhouette || !place) return undefined;
        const points = polylineOf(model.silhouette).flatMap((each) => [
            place.frame.toPhoto(each, -1),
            place.frame.toPhoto(each, 1),
        ]);
        const xs = points.map(([x]) => x);
        const ys = points.map(([, y]) => y);
        const [x, y] = [Math.min(...xs), Math.min(...ys)];
        return { x, y, width: Math.max(...xs) - x, height: Math.max(...ys) - y };
    }

    /** Lets the service judge edited outlines, that of the shown stage first. */
    private async check(): Promise<void> {
        this.checking?.abort();
        const { trace, shownStage } = this;
        const { shape, details } = this.history.value;
        const isEdited = !!shape || hasGeometry(details);
        if (!trace || (trace.certificate && !isEdited && shownStage === trace.stage)) return;
        const checking = new AbortController();
        this.checking = checking;
        byId("gesture-errors").querySelector('[data-place="outline"]')?.remove();
        const others = isEdited ? trace.species.stages.map((_, stage) => stage) : [];
        try {
            for (const stage of [shownStage, ...others.filter((one) => one !== shownStage)]) {
                const { model, name } = trace.species.stages[stage] ?? {};
                if (!model?.silhouette) continue;
                const { simple, method, problem } = await checkOutline(model, checking.signal);
                if (checking.signal.aborted) return;
                if (stage === shownStage) {
                    const certificate = { simple, method };
                    const shown = { ...trace, certificate };
                    this.findings.show(shown, this.history.value, shownStage);
                }
                if (!problem) continue;
                const where = stage === shownStage ? "" : `At the age of ${name}: `;
                return this.say("outline", where + problem.detail);
            }
        } catch (error) {
            if (checking.signal.aborted) return;
            this.showFailure(asRequestFailed(error, "The outline cannot be checked"));
        }
    }

    /** Shows the points of the outline or of the axis in place of the lines. */
    private edit(mode: "outline" | "bend"): void {
        this.mode = mode;
        this.sketch.idle = true;
        this.showOutline();
        this.showTools();
        (mode === "bend" ? this.axis : this.outline).focus();
    }

    private showOutline(): void {
        const model = this.stages[this.shownStage]?.model;
        const silhouette = model?.silhouette;
        const traced = this.tracedFrame;
        const { mode } = this;
        const isShown = mode !== "draw" && model && silhouette && traced;
        this.sketch.include(isShown ? this.boxOfOutline() : undefined);
        this.outline.show(
            isShown && mode === "outline"
                ? this.shownOutline(model, silhouette, traced)
                : undefined,
        );
        const axis = axisOf(model ?? {});
        this.axis.show(isShown && mode === "bend" ? { axis, silhouette, traced } : undefined);
    }

    private shownOutline(
        model: SpeciesStage["model"],
        silhouette: Silhouette,
        traced: AxisFrame,
    ): ShownOutline {
        const frame = placed(model, traced)?.frame ?? traced;
        const neighbours = [-1, 1].flatMap((step) => {
            const near = this.stages[this.shownStage + step]?.model;
            const there = near && placed(near, traced);
            if (!near?.silhouette || !there) return [];
            return [{ silhouette: near.silhouette, frame: there.frame, older: step > 0 }];
        });
        const { photograph, trace } = this;
        const isPhotographed = photograph?.drawable && this.shownStage === trace?.stage;
        const measured = this.traced?.species.stages[this.shownStage]?.model.silhouette;
        const sides = isPhotographed ? [trace.outline.left, trace.outline.right] : [];
        return {
            silhouette,
            frame,
            neighbours,
            measured: [
                ...sides.map((side) => side.map((place) => frame.fromPhoto(place))),
                ...(isPhotographed && measured ? [polylineOf(measured)] : []),
            ],
        };
    }

    /** Shows the drawing that the history is at, and traces it. */
    private restored(): void {
        const { gesture, views, heightMm, form, images } = this.history.value;
        this.sketch.gesture = gesture;
        if (this.photograph?.drawable) this.capPhotos.show(views);
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
            const { past, future } = this.history.steps;
            const drawing = this.history.value;
            const steps = [...past, drawing, ...future];
            this.sources.prune(steps);
            if (this.photograph?.isForgotten) this.saveShape();
            else if (this.photograph)
                void saveDraft({ drawing, past, future, files: this.sources.files(steps) });
        }, saveDelayMs);
    }

    /** Saves what is left of a forgotten photograph as the file of a species. */
    private saveShape(): void {
        const number = this.shownSource;
        if (!this.trace || number === undefined) return;
        const file = new Blob([JSON.stringify(this.trace.species)], { type: "application/json" });
        const drawing = { ...startOfDrawing, source: number };
        void saveDraft({ drawing, past: [], future: [], files: new Map([[number, file]]) });
    }

    private missing(): "axis" | "cap" | undefined {
        const cutOut = this.photograph?.stored.alpha ?? false;
        return missingLine(this.history.value.gesture, cutOut);
    }

    private use(tool: Tool): void {
        this.mode = "draw";
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
            const drawing = this.mode === "draw";
            const pressed = tool ? drawing && tool === this.sketch.tool : name === this.mode;
            button.setAttribute("aria-pressed", String(pressed));
            const { shape, details } = this.history.value;
            const done = tool
                ? strokesOf(gesture, tool).length > 0
                : name === "outline"
                  ? !!shape
                  : Object.keys(details ?? {}).some((pointer) => pointer.endsWith("/axis"));
            button.classList.toggle("done", done);
            const has = !!this.stages[this.shownStage]?.model.silhouette;
            if (!tool) (button as HTMLButtonElement).disabled = !has;
        }
        this.showOrder();
        byId("points").hidden = this.mode !== "draw";
        if (this.photograph) this.table.show(gesture, this.sketch.tool, this.photograph.stored);
    }

    private showOrder(): void {
        const { tool, pending } = this.sketch;
        const { gesture } = this.history.value;
        const drawn = strokesOf(gesture, tool).length > 0;
        byId("edit-tools").hidden = this.mode === "draw";
        if (this.mode !== "draw") {
            const model = this.stages[this.shownStage]?.model ?? {};
            const points = axisOf(model).length;
            const bends = this.mode === "bend";
            const sentences = {
                none: "Branches have no outline: see More",
                outline: "Drag points or the curve",
                bend: points > 0 ? "Drag a point to bend the stem" : "The stem is straight",
            };
            byId("sentence").textContent = sentences[model.silhouette ? this.mode : "none"];
            for (const id of ["stroke-tools", "clear", "trace-now"]) byId(id).hidden = true;
            for (const id of ["add-point", "remove-point"])
                byId(id).hidden = !model.silhouette || (bends && points === 0);
            byId("whole-curve").hidden = bends || !model.silhouette;
            byId("bend-axis").hidden = !bends || points > 0;
            byId("fewer-points").hidden = !bends || points <= fewPoints;
            byId("straighten").hidden = !bends || points === 0;
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
            const trace = await photograph.trace(this.history.value, tracing.signal, (number) =>
                this.sources.photograph(number),
            );
            if (tracing.signal.aborted) return;
            this.tracing = undefined;
            this.showTrace(trace);
            // What an edit has done is announced where it is done.
            const { shape, details } = this.history.value;
            const isEdited = Object.keys(details ?? {}).some((pointer) => pointer !== titlePointer);
            if (!shape && !isEdited) announce(this.summary(trace));
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
        const trace = traced && withEdits(traced, this.history.value);
        if (traced !== this.traced) this.shownStage = traced?.stage ?? 0;
        this.traced = traced;
        this.trace = trace;
        this.stale = false;
        this.sketch.showTrace(trace);
        this.library.show(trace?.species);
        this.findings.show(trace, this.history.value, this.shownStage);
        if (!trace && this.mode !== "draw" && this.photograph?.drawable)
            this.use(this.missing() ?? "keep");
        this.showOutline();
        this.showTools();
        byId("panel-hint").hidden = !!trace;
        const height = trace && sizeOf(trace.species.stages[trace.stage]?.model ?? {})?.height;
        byId<HTMLInputElement>("height").placeholder =
            height === undefined ? "" : String(Math.round(height * 1000));
        if (trace) return this.showStage(this.shownStage);
        if (byId("stage-hint").hidden)
            this.formerModel ??= `The model of ${this.fresh ? "what was open" : "the lines"} before`;
        this.live?.cancel();
        this.overPhoto.clear();
        this.strip.show(undefined, 0, undefined);
    }

    /** Shows the model of one stage of the species. */
    private showStage(index: number): void {
        const stage = this.trace?.species.stages[index];
        if (!stage) return;
        this.state = "busy";
        this.shownStage = index;
        const photographed = this.photograph?.drawable ? this.trace?.stage : undefined;
        this.strip.show(this.trace?.species, index, photographed);
        this.findings.show(this.trace, this.history.value, index);
        this.showForms();
        void this.check();
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
        if (place === "above" || place === "below") return this.capPhotos.say(place, detail);
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
        this.capPhotos.clearErrors();
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
        line.textContent = line.hidden ? "" : text;
        if (this.photograph) this.say("photo", text);
        announce(text);
    }

    /** What is shown belongs to an earlier drawing, because this one cannot be traced. */
    private set stale(stale: boolean) {
        document.body.classList.toggle("stale", stale);
    }

    /** What is said of a model on the stage that does not belong to what is drawn now; undefined if it does. */
    private get formerModel(): string | undefined {
        return byId("former-note").hidden ? undefined : (byId("former-note").textContent ?? "");
    }

    private set formerModel(text: string | undefined) {
        byId("former-note").hidden = text === undefined;
        byId("former-note").textContent = text ?? "";
        byId("stage").classList.toggle("former", text !== undefined);
    }

    /** What the page is at, for its style and for tests. */
    private set state(state: "empty" | "busy" | "ready" | "failed") {
        document.documentElement.dataset["designer"] = state;
    }
}
