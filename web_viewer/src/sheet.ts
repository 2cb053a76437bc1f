// Sheets: many mushrooms in one picture. A variety sheet shows the morphs between control shapes
// (Figure 7 of the mushroom paper), a growth sheet one mushroom at several ages. They are rendered
// by the page and saved as PNG or as one GLB.
import { Box3, Group, Scene, Vector3 } from "three";
import { GLTFExporter } from "three/addons/exporters/GLTFExporter.js";
import { centimetres, type ViewName } from "./camera";
import { byId, kilobytes, make } from "./dom";
import type { Species } from "./gallery";
import { getModel, RequestFailed } from "./http";
import { canonicalMix, readShares, thousandths, type Share } from "./mix";
import { boundsOf, disposeModel, parseModel } from "./model";
import { letterOf } from "./pad";
import { words } from "./schema";
import type { Settings } from "./settings";
import { announce } from "./status_line";
import { OffscreenRenderer } from "./offscreen_renderer";
import { controlShape, varietyLayout } from "./weights";

export type SheetKind = "variety" | "growth";

interface PlannedCell {
    column: number;
    row: number;
    address: string;
    /** Canonical mix, with its age if ages differ; the name of the mesh. */
    name: string;
    caption: string;
    /** Name of the species if it is not a mix. */
    control: string | undefined;
}

interface DrawnCell extends PlannedCell {
    bytes: ArrayBuffer;
    /** Address of the bytes. */
    from: string;
    box: Box3;
}

export interface SheetEvents {
    /** The sheet was opened or closed. */
    changed: (kind: SheetKind | undefined) => void;
    save: (blob: Blob, name: string) => void;
}

const cells: Record<SheetKind, { width: number; height: number }> = {
    variety: { width: 260, height: 270 },
    growth: { width: 176, height: 276 },
};
const captionHeight = 38;
/** Round models leave the corners of their box empty; the space above is for the arrow of a control
 *  shape. */
const margins = { variety: { x: -0.12, y: 0.2 }, growth: { x: -0.2, y: 0.08 } };
const edge = 30;
const head = 92;
const growthAges = [0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1];
/** Number of simultaneous requests: the next model is made while one is drawn. */
const atOnce = 2;

const ink = {
    text: "#2b211a",
    soft: "#6b5b4d",
    line: "#d8ccb6",
    paper: "#f5efe2",
    arrow: "#e3a511",
};
const serif =
    '"Iowan Old Style", "Palatino Linotype", Palatino, "URW Palladio L", P052, "Book Antiqua", ' +
    "Georgia, serif";
const sans = 'system-ui, -apple-system, "Segoe UI", "Noto Sans", "DejaVu Sans", sans-serif';

export class Sheet {
    private readonly dialog = byId<HTMLDialogElement>("sheet");
    private readonly canvas = byId<HTMLCanvasElement>("sheet-canvas");
    private readonly scale = byId<HTMLInputElement>("sheet-scale");
    private kind: SheetKind | undefined;
    private stop: AbortController | undefined;
    private drawn: DrawnCell[] = [];
    private plans: PlannedCell[] = [];
    private renderer: OffscreenRenderer | undefined;
    private cell = cells.variety;
    private grid = { columns: 1, rows: 1 };
    private title = "";
    private legend = "";
    private drawing: Promise<void> = Promise.resolve();

    constructor(
        private readonly settings: Settings,
        private readonly species: readonly Species[],
        private readonly events: SheetEvents,
    ) {
        byId("sheet-close").addEventListener("click", () => this.dialog.close());
        byId("sheet-cancel").addEventListener("click", () => this.cancel());
        byId("sheet-png").addEventListener("click", () => void this.savePicture());
        byId("sheet-glb").addEventListener("click", () => void this.saveModel());
        this.scale.addEventListener("change", () => void this.redraw());
        this.dialog.addEventListener("close", () => this.closed());
    }

    get open(): SheetKind | undefined {
        return this.kind;
    }

    /** Opens the dialog and draws the sheet. */
    show(kind: SheetKind): void {
        if (this.kind === kind) return;
        this.stop?.abort();
        this.kind = kind;
        this.scale.checked = kind === "growth";
        if (!this.dialog.open) this.dialog.showModal();
        this.events.changed(kind);
        this.drawing = this.draw(kind);
    }

    close(): void {
        if (this.dialog.open) this.dialog.close();
    }

    /** Resolves when all cells are drawn, or drawing was cancelled. */
    async settled(): Promise<void> {
        let work;
        do {
            work = this.drawing;
            await work;
        } while (work !== this.drawing);
    }

    private closed(): void {
        this.stop?.abort();
        this.stop = undefined;
        this.kind = undefined;
        this.drawn = [];
        this.renderer?.dispose();
        this.renderer = undefined;
        this.events.changed(undefined);
    }

    private cancel(): void {
        this.stop?.abort();
        this.progress(undefined, `Stopped after ${this.drawn.length} of ${this.plans.length}`);
    }

    private nameOf(id: string): string {
        return this.species.find((one) => one.id === id)?.common_name ?? words(id);
    }

    private plan(kind: SheetKind): { columns: number; rows: number; plans: PlannedCell[] } {
        const lod = this.settings.field("lod");
        const level = Math.max(
            Number(this.settings.values.get("lod") ?? 0),
            Math.min(1, lod?.max ?? 0),
        );
        const address = (mix: string, age?: number): string => {
            const values = new Map<string, number | string>([
                ["lod", level],
                ["textures", "embedded"],
            ]);
            if (this.settings.field("animation")) values.set("animation", "none");
            if (age !== undefined) values.set("age", age);
            const query = this.settings.query(values);
            return `v1/mushrooms/${mix}.glb${query ? `?${query}` : ""}`;
        };
        if (kind === "growth") {
            const shares = readShares(this.settings.mix) ?? [];
            this.title = this.mixTitle(shares);
            this.legend = "Growth from button to decay";
            const plans = growthAges.map((age, column) => ({
                column,
                row: 0,
                address: address(this.settings.mix, age),
                name: `${this.settings.mix} age ${age}`,
                caption: `age ${age}`,
                control: undefined,
            }));
            return { columns: growthAges.length, rows: 1, plans };
        }
        const members = this.settings.morph?.shares ?? readShares(this.settings.mix) ?? [];
        const layout = varietyLayout(members.length);
        const ages = layout.cells.some(({ age }) => age !== undefined);
        this.title = members
            .map(({ id }, index) => `${letterOf(index)} ${this.nameOf(id)}`)
            .join("   ");
        const order = ages ? ", young above and old below" : "";
        const count = layout.cells.length;
        this.legend = `${count} morphs between ${members.length} control shapes${order}`;
        const plans = layout.cells.map(({ column, row, weights, age }) => {
            const parts = thousandths(weights);
            const mix = canonicalMix(
                members.map(({ id }, index) => ({ id, weight: parts[index] ?? 0 })),
            );
            const alone = controlShape(weights);
            const shares = parts.flatMap((part, index) =>
                part ? [`${Math.round(part / 10)} ${letterOf(index)}`] : [],
            );
            const years = age === undefined ? "" : ` · age ${age}`;
            return {
                column,
                row,
                address: address(mix, age),
                name: age === undefined ? mix : `${mix} age ${age}`,
                caption:
                    (alone >= 0
                        ? `${letterOf(alone)} ${this.nameOf(members[alone]!.id)}`
                        : shares.join(" + ")) + years,
                control:
                    alone >= 0 && (age === undefined || age === 0.5)
                        ? members[alone]!.id
                        : undefined,
            };
        });
        return { columns: layout.columns, rows: layout.rows, plans };
    }

    private mixTitle(shares: readonly Share[]): string {
        if (shares.length === 1 && shares[0]) return this.nameOf(shares[0].id);
        return shares
            .map(({ id, weight }) => `${Math.round(weight * 100)} % ${this.nameOf(id)}`)
            .join(" + ");
    }

    private async draw(kind: SheetKind): Promise<void> {
        const stop = new AbortController();
        this.stop = stop;
        this.drawn = [];
        const { columns, rows, plans } = this.plan(kind);
        this.plans = plans;
        byId("sheet-title").textContent = kind === "growth" ? "Growth" : "Variety";
        this.cell = cells[kind];
        this.grid = { columns, rows };
        this.begin();
        this.buttons(false);
        const waiting = [...plans];
        const one = async (): Promise<void> => {
            for (let next = waiting.shift(); next; next = waiting.shift()) {
                const { bytes, response } = await getModel({ address: next.address }, stop.signal);
                const model = await parseModel(bytes, response.url);
                stop.signal.throwIfAborted();
                const made = { ...next, bytes, from: response.url, box: boundsOf(model) };
                this.drawn.push(made);
                this.drawCell(made, model, undefined);
                disposeModel(model);
                this.progress(
                    this.drawn.length / plans.length,
                    `${this.drawn.length} of ${plans.length}`,
                );
            }
        };
        this.progress(0, `0 of ${plans.length}`);
        try {
            await Promise.all(Array.from({ length: atOnce }, one));
            if (this.scale.checked) await this.redrawAll(stop.signal);
            this.finished();
        } catch (error) {
            if (stop.signal.aborted) return;
            stop.abort();
            const detail = error instanceof RequestFailed ? error.items[0]?.detail : undefined;
            const message = error instanceof RequestFailed ? error.message : "";
            const reason = (detail ?? message) || "a model could not be shown";
            const count = `${this.drawn.length} of ${plans.length}`;
            this.progress(undefined, `Stopped after ${count}: ${reason}`);
        }
    }

    private finished(): void {
        const bytes = this.drawn.reduce((sum, { bytes: part }) => sum + part.byteLength, 0);
        this.progress(undefined, `${this.drawn.length} mushrooms, ${kilobytes(bytes)}`);
        announce(`Sheet of ${this.drawn.length} mushrooms is drawn`);
        this.buttons(true);
    }

    private async redraw(): Promise<void> {
        const stop = this.stop;
        if (!stop || stop.signal.aborted || this.drawn.length !== this.plans.length) return;
        this.buttons(false);
        this.drawing = this.redrawAll(stop.signal).then(
            () => this.finished(),
            () => undefined,
        );
        await this.drawing;
    }

    /** Draws all cells again, all at one scale or each at its own. */
    private async redrawAll(signal: AbortSignal): Promise<void> {
        let frame: Box3 | undefined;
        if (this.scale.checked) {
            frame = new Box3();
            for (const { box } of this.drawn) frame.union(box);
            if (this.kind === "growth") this.trim(frame);
        }
        let done = 0;
        for (const made of this.drawn) {
            const model = await parseModel(made.bytes, made.from);
            signal.throwIfAborted();
            this.drawCell(made, model, frame);
            disposeModel(model);
            this.progress(++done / this.drawn.length, `drawing ${done} of ${this.drawn.length}`);
        }
    }

    /** A row of low models needs less height than one of tall models. */
    private trim(frame: Box3): void {
        const size = frame.getSize(new Vector3());
        const { width, height } = cells.growth;
        // Seen over a corner the box is 1.38 times as wide as a side; the ground takes a third of
        // that.
        const needed = (width * 1.2 * (0.33 + size.y / Math.max(size.x, size.z) / 1.38)) / 0.92;
        this.cell = { width, height: Math.round(Math.min(Math.max(needed, width * 0.6), height)) };
        if (this.cell.height < height) this.begin();
    }

    private progress(part: number | undefined, text: string): void {
        const bar = byId<HTMLProgressElement>("sheet-progress");
        bar.hidden = part === undefined;
        if (part !== undefined) bar.value = part;
        byId("sheet-cancel").hidden = part === undefined;
        byId("sheet-state").textContent = text;
        this.dialog.setAttribute("aria-busy", String(part !== undefined));
    }

    private buttons(ready: boolean): void {
        for (const id of ["sheet-png", "sheet-glb", "sheet-scale"])
            byId<HTMLButtonElement | HTMLInputElement>(id).disabled = !ready;
    }

    // The picture

    private begin(): void {
        const { columns, rows } = this.grid;
        // Cells of another shape need another camera.
        this.renderer?.dispose();
        this.renderer = undefined;
        const { canvas, cell } = this;
        canvas.width = 2 * edge + columns * cell.width;
        canvas.height = head + edge + rows * (cell.height + captionHeight);
        canvas.setAttribute("aria-label", `${this.title}: ${this.legend}`);
        const context = this.context;
        context.fillStyle = ink.paper;
        context.fillRect(0, 0, canvas.width, canvas.height);
        context.textBaseline = "alphabetic";
        context.textAlign = "left";
        context.fillStyle = ink.text;
        let size = 30;
        do context.font = `600 ${size}px ${serif}`;
        while (context.measureText(this.title).width > canvas.width - 2 * edge && --size > 13);
        context.fillText(this.title, edge, 46);
        context.fillStyle = ink.soft;
        context.font = `italic 17px ${serif}`;
        context.fillText(this.legend, edge, 73);
        context.textAlign = "right";
        if (canvas.width > 1000) context.fillText("Sporeprint", canvas.width - edge, 73);
    }

    private get context(): CanvasRenderingContext2D {
        return this.canvas.getContext("2d")!;
    }

    private drawCell(
        plan: PlannedCell,
        model: Parameters<OffscreenRenderer["render"]>[0],
        frame: Box3 | undefined,
    ): void {
        const { context, cell } = this;
        const x = edge + plan.column * cell.width;
        const y = head + plan.row * (cell.height + captionHeight);
        context.fillStyle = ink.paper;
        context.fillRect(x, y, cell.width, cell.height + captionHeight);
        if (this.kind === "variety") this.light(x, y);
        const margin = margins[this.kind ?? "variety"];
        // Twice the pixels, halved by the canvas, give smooth edges.
        this.renderer ??= new OffscreenRenderer(cell.width * 2, cell.height * 2);
        const view: ViewName = "three-quarter";
        const picture = this.renderer.render(
            model,
            frame ? { view, frame, margin, onGround: true } : { view, margin, onGround: true },
        );
        context.imageSmoothingQuality = "high";
        context.drawImage(picture, x, y, cell.width, cell.height);
        if (plan.control) this.arrow(x + cell.width * 0.5, y);
        context.textAlign = "center";
        context.fillStyle = plan.control ? ink.text : ink.soft;
        context.font = plan.control ? `600 15px ${serif}` : `13px ${sans}`;
        context.fillText(plan.caption, x + cell.width / 2, y + cell.height + 16, cell.width - 10);
        const box = boundsOf(model);
        context.font = `11px ${sans}`;
        context.fillStyle = ink.soft;
        const above = box.max.y - Math.max(box.min.y, 0);
        context.fillText(centimetres(above, 1), x + cell.width / 2, y + cell.height + 31);
    }

    /** Draws the spot of light behind one mushroom of a grid. */
    private light(x: number, y: number): void {
        const { context, cell } = this;
        const light = context.createRadialGradient(
            x + cell.width * 0.47,
            y + cell.height * 0.45,
            10,
            x + cell.width / 2,
            y + cell.height / 2,
            cell.width * 0.62,
        );
        light.addColorStop(0, "#fdf9f0");
        light.addColorStop(0.6, "#f3ebdb");
        light.addColorStop(1, ink.paper);
        context.fillStyle = light;
        context.fillRect(x, y, cell.width, cell.height);
    }

    /** Draws an arrow at a control shape, as in Figure 7. */
    private arrow(x: number, y: number): void {
        const context = this.context;
        context.fillStyle = ink.arrow;
        context.beginPath();
        for (const [dx, dy] of [
            [-4, 0],
            [4, 0],
            [4, 9],
            [10, 9],
            [0, 21],
            [-10, 9],
            [-4, 9],
        ] as const)
            context.lineTo(x + dx, y + dy);
        context.closePath();
        context.fill();
    }

    private fileName(suffix: string): string {
        const what =
            this.kind === "growth"
                ? this.settings.mix
                : (this.settings.morph?.shares ?? []).map(({ id }) => id).join("-");
        const name = what.replace(/[^a-z0-9_-]+/g, "-").slice(0, 80);
        return `${this.kind ?? "sheet"}-${name}.${suffix}`;
    }

    private async savePicture(): Promise<void> {
        const blob = await new Promise<Blob | null>((resolve) =>
            this.canvas.toBlob(resolve, "image/png"),
        );
        if (blob) this.events.save(blob, this.fileName("png"));
    }

    /** Returns one scene with a node per mushroom, named after its canonical mix, arranged as on
     *  the sheet. */
    private async saveModel(): Promise<void> {
        const signal = this.stop?.signal;
        this.buttons(false);
        const scene = new Scene();
        scene.name = this.fileName("glb").replace(/\.glb$/, "");
        const size = new Vector3();
        const widest = Math.max(
            ...this.drawn.map(({ box }) => Math.max(box.getSize(size).x, size.z)),
        );
        const middle = Math.max(...this.plans.map(({ column }) => column)) / 2;
        try {
            for (const made of this.drawn) {
                const model = await parseModel(made.bytes, made.from);
                signal?.throwIfAborted();
                const group = new Group();
                group.name = made.name;
                group.position.set(
                    (made.column - middle) * widest * 1.25,
                    0,
                    made.row * widest * 1.25,
                );
                const meshes = [...model.children];
                for (const mesh of meshes) {
                    mesh.name = made.name;
                    mesh.userData = {};
                    group.add(mesh);
                }
                scene.add(group);
                this.progress(
                    scene.children.length / this.drawn.length,
                    `putting together ${scene.children.length} of ${this.drawn.length}`,
                );
            }
            // A node whose only child carries the mesh is redundant.
            for (const group of [...scene.children]) {
                const only = group.children.length === 1 ? group.children[0] : undefined;
                if (!only) continue;
                only.position.copy(group.position);
                scene.remove(group);
                scene.add(only);
            }
            const bytes = (await new GLTFExporter().parseAsync(scene, {
                binary: true,
                trs: true,
            })) as ArrayBuffer;
            signal?.throwIfAborted();
            this.events.save(
                new Blob([bytes], { type: "model/gltf-binary" }),
                this.fileName("glb"),
            );
            this.progress(
                undefined,
                `${this.drawn.length} mushrooms in one GLB of ${kilobytes(bytes.byteLength)}`,
            );
        } catch (error) {
            if (!signal?.aborted)
                this.progress(
                    undefined,
                    `The GLB could not be made: ${error instanceof Error ? error.message : ""}`,
                );
        } finally {
            for (const model of scene.children) disposeModel(model);
            this.buttons(!signal?.aborted);
        }
    }
}

/** Returns the buttons that open the sheets. */
export function sheetButtons(show: (kind: SheetKind) => void): HTMLElement {
    const variety = make("button", { type: "button", id: "variety" }, "Variety sheet");
    variety.addEventListener("click", () => show("variety"));
    const growth = make("button", { type: "button", id: "growth-sheet" }, "Growth sheet");
    growth.addEventListener("click", () => show("growth"));
    return make("div", { class: "sheets", role: "group", "aria-label": "Sheets" }, variety, growth);
}
