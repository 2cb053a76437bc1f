// Nine children in one canvas: each is drawn in the part of it that lies under its button. Drags turn all of them.
import {
    Box3,
    CanvasTexture,
    Mesh,
    MeshBasicMaterial,
    PerspectiveCamera,
    PlaneGeometry,
    Sphere,
    Vector3,
    type Object3D,
} from "three";
import { centimetres, fittingDistance, standing, type Margin, type ViewName } from "../camera";
import { draw, make } from "../dom";
import { litScene } from "../lit_scene";
import { boundsOf, disposeModel, hangsOnWall, texturesOf } from "../model";
import { childCount } from "./pedigree";

export interface GridEvents {
    chosen: (index: number) => void;
    save: (index: number) => void;
    /** A child is looked at: it may be chosen next. */
    considered: (index: number) => void;
}

export const columns = 3;

/** A drag that is shorter is a click, pixels. */
const clickReach = 6;
const degreesPerPixel = 0.5;
const lowest = -60;
const highest = 88;
/** Round models leave the corners of their box empty; captions are below. */
const margin = { x: -0.12, y: 0.06 };
const portraitMargin = { x: -0.3, y: -0.12 };
const portraitSide = 128;
/** More pixels per point show no more. */
const mostRatio = 2;

/** Drafts and final models have materials of their own. */
export type Stage = "draft" | "final";

interface Shown {
    model: Object3D;
    bounds: Box3;
    stage: Stage;
}

interface Cell {
    item: HTMLElement;
    button: HTMLButtonElement;
    caption: HTMLElement;
    message: HTMLElement;
    label: string;
    /** The picture is not that of what is shown. */
    isStale: boolean;
    shown?: Shown;
    /** The last ones before it. They stay until others take their place, since the compiled programs of their
     *  materials would be lost with them. */
    retired: Partial<Record<Stage, Object3D>>;
}

/** Makes the context of a canvas whose picture stays, so that one child can be drawn alone. */
function keepPicture(canvas: HTMLCanvasElement): void {
    canvas.getContext("webgl2", {
        alpha: true,
        depth: true,
        stencil: false,
        antialias: true,
        premultipliedAlpha: true,
        preserveDrawingBuffer: true,
    });
}

function showLabel({ button, item, label, shown }: Cell): void {
    const texts = [label];
    if (shown && !item.classList.contains("pending")) {
        const size = shown.bounds.getSize(new Vector3());
        texts.push(`${centimetres(Math.max(0, shown.bounds.max.y), 1)} high`);
        texts.push(`${centimetres(Math.max(size.x, size.z), 1)} wide`);
    }
    button.setAttribute("aria-label", texts.join(", "));
}

function retire(cell: Cell): void {
    const { shown } = cell;
    if (!shown) return;
    const before = cell.retired[shown.stage];
    if (before) disposeModel(before);
    cell.retired[shown.stage] = shown.model;
    delete cell.shown;
}

/** Returns a soft round shade, dark in the middle. */
function shadeTexture(): CanvasTexture {
    const side = 64;
    const canvas = make("canvas", { width: side, height: side });
    const context = canvas.getContext("2d")!;
    const half = side / 2;
    const shade = context.createRadialGradient(half, half, 0, half, half, half);
    shade.addColorStop(0, "rgb(43 29 18 / .5)");
    shade.addColorStop(0.45, "rgb(43 29 18 / .26)");
    shade.addColorStop(1, "rgb(43 29 18 / 0)");
    context.fillStyle = shade;
    context.fillRect(0, 0, side, side);
    return new CanvasTexture(canvas);
}

export class ChildGrid {
    private readonly canvas = make("canvas", { "aria-hidden": true });
    private readonly lit;
    private readonly camera = new PerspectiveCamera(24, 1, 0.001, 100);
    private readonly shade = new Mesh(
        new PlaneGeometry(2, 2).rotateX(-Math.PI / 2),
        new MeshBasicMaterial({ map: shadeTexture(), transparent: true, depthWrite: false, toneMapped: false }),
    );
    private readonly cells: Cell[] = [];
    private readonly direction = standing["three-quarter"].clone();
    private frame = 0;
    private common = false;

    constructor(
        private readonly host: HTMLElement,
        private readonly events: GridEvents,
    ) {
        keepPicture(this.canvas);
        this.lit = litScene(this.canvas, true);
        const { renderer, scene, light } = this.lit;
        renderer.setPixelRatio(Math.min(devicePixelRatio, mostRatio));
        renderer.autoClear = false;
        light.sun.shadow.mapSize.set(512, 512);
        scene.add(this.shade);
        const list = make("ol", { class: "cells", "aria-label": "Nine children" });
        host.append(this.canvas, list);
        for (let index = 0; index < childCount; ++index) {
            const cell = this.cell(index);
            this.cells.push(cell);
            list.append(cell.item);
        }
        this.connect(list);
        new ResizeObserver(() => this.resize()).observe(host);
    }

    /** Dims all children, since others are on their way. */
    expect(): void {
        for (const { item, button, message } of this.cells) {
            item.classList.add("pending");
            message.hidden = true;
            button.disabled = false;
        }
    }

    /** Names the children; their sizes follow in the label. */
    name(names: readonly { caption: string; label: string }[]): void {
        this.cells.forEach((cell, index) => {
            const { caption = "", label = "" } = names[index] ?? {};
            cell.caption.textContent = caption;
            cell.label = label;
            showLabel(cell);
        });
    }

    /** Puts a model in place of the one at an index, and draws it unless others follow at once. */
    put(index: number, model: Object3D, stage: Stage, drawn = true): void {
        const cell = this.cells[index];
        if (!cell) return disposeModel(model);
        retire(cell);
        // These are small pictures of small images, and renderers in software take long for more.
        for (const texture of texturesOf(model)) texture.anisotropy = 1;
        const bounds = boundsOf(model);
        cell.shown = { model, bounds, stage };
        cell.isStale = true;
        cell.item.classList.remove("pending");
        showLabel(cell);
        if (drawn) this.drawChanged();
    }

    /** Draws the children that are new, or all of them if one scale is shared. */
    drawChanged(): void {
        if (this.common) return this.drawNow();
        for (const cell of this.cells) if (cell.isStale) this.drawCell(cell);
    }

    /** Says in a cell why its child cannot be shown. */
    fail(index: number, text: string): void {
        const cell = this.cells[index];
        if (!cell) return;
        retire(cell);
        cell.item.classList.remove("pending");
        cell.message.hidden = false;
        cell.message.textContent = text;
        cell.button.disabled = true;
        cell.isStale = true;
    }

    set sameScale(same: boolean) {
        this.common = same;
        this.drawSoon();
    }

    look(view: ViewName): void {
        this.direction.copy(standing[view]);
        this.drawSoon();
    }

    focus(index: number): void {
        this.rove(index);
        this.cells[index]?.button.focus();
    }

    /** Returns a function that draws a small picture of a child that is shown now, as a data URL; it can be called
     *  until the finals of the next children are shown. */
    portraitOfChild(index: number): (() => string) | undefined {
        const shown = this.cells[index]?.shown;
        return shown && (() => this.portraitOf(shown.model, shown.bounds));
    }

    /** Returns a small picture of a model, as a data URL. */
    portraitOf(model: Object3D, bounds = boundsOf(model)): string {
        const side = portraitSide / this.lit.renderer.getPixelRatio();
        const bottom = this.canvas.clientHeight - side;
        this.lit.renderer.setScissorTest(true);
        this.drawModel(model, bounds, bounds, { left: 0, bottom, width: side, height: side }, standing["three-quarter"], portraitMargin);
        const small = make("canvas", { width: portraitSide, height: portraitSide });
        small.getContext("2d")?.drawImage(this.canvas, 0, 0, portraitSide, portraitSide, 0, 0, portraitSide, portraitSide);
        // The first child was there.
        const [first] = this.cells;
        if (first) this.drawCell(first);
        return small.toDataURL("image/webp", 0.9);
    }

    private drawNow(): void {
        cancelAnimationFrame(this.frame);
        this.frame = 0;
        const { renderer } = this.lit;
        renderer.setScissorTest(false);
        renderer.clear();
        for (const cell of this.cells) this.drawCell(cell);
    }

    private drawCell(cell: Cell): void {
        const { item, shown } = cell;
        cell.isStale = false;
        const whole = this.host.getBoundingClientRect();
        const { left, bottom, width, height } = item.getBoundingClientRect();
        const place = { left: left - whole.left, bottom: whole.bottom - bottom, width, height };
        const { renderer } = this.lit;
        renderer.setScissorTest(true);
        renderer.setScissor(place.left, place.bottom, width, height);
        if (shown) this.drawModel(shown.model, shown.bounds, this.reach ?? shown.bounds, place, this.direction, margin);
        else renderer.clear();
    }

    /** What all pictures show if they have one scale. */
    private get reach(): Box3 | undefined {
        if (!this.common) return undefined;
        const all = this.cells.flatMap(({ shown }) => shown?.bounds ?? []);
        return all.reduce((reach, bounds) => reach.union(bounds), new Box3());
    }

    private drawSoon(): void {
        this.frame ||= requestAnimationFrame(() => this.drawNow());
    }

    /** Draws a model in a part of the canvas, in pixels from its lower left corner. */
    private drawModel(
        model: Object3D,
        bounds: Box3,
        framed: Box3,
        { left, bottom, width, height }: { left: number; bottom: number; width: number; height: number },
        direction: Vector3,
        around: Margin,
    ): void {
        const { renderer, scene, light } = this.lit;
        const { camera, shade } = this;
        if (width < 1 || height < 1) return;
        renderer.setViewport(left, bottom, width, height);
        renderer.setScissor(left, bottom, width, height);
        camera.aspect = width / height;
        const centre = framed.getCenter(new Vector3());
        const distance = fittingDistance(framed, direction, camera, around);
        camera.position.copy(direction).multiplyScalar(distance).add(centre);
        camera.near = distance / 50;
        camera.far = distance * 10;
        camera.lookAt(centre);
        camera.updateProjectionMatrix();
        const ball = bounds.getBoundingSphere(new Sphere());
        light.aim(ball);
        shade.visible = !hangsOnWall(model, bounds) && direction.y > 0;
        const size = bounds.getSize(new Vector3());
        shade.position.set((bounds.min.x + bounds.max.x) / 2, 0, (bounds.min.z + bounds.max.z) / 2);
        shade.scale.set(size.x * 0.62, 1, size.z * 0.62);
        scene.add(model);
        renderer.clear();
        renderer.render(scene, camera);
        scene.remove(model);
    }

    private resize(): void {
        const { width, height } = this.host.getBoundingClientRect();
        if (width < 1 || height < 1) return;
        this.lit.renderer.setSize(width, height, false);
        this.drawNow();
    }

    private cell(index: number): Cell {
        const button = make("button", {
            type: "button",
            class: "child",
            "data-child": index,
            "aria-describedby": "grid-keys",
            tabindex: index === 0 ? 0 : -1,
        });
        const caption = make("span", { class: "caption", "aria-hidden": true });
        const message = make("p", { class: "message", hidden: true });
        const icon = draw(
            "svg",
            { viewBox: "0 0 20 20", "aria-hidden": true },
            draw("path", { d: "M10 3v9m-4-4 4 4 4-4M4 16h12" }),
        );
        const save = make(
            "button",
            { type: "button", class: "keep-it", "aria-label": `Save child ${index + 1} of 9`, title: "Save this one (S)" },
            icon,
        );
        save.addEventListener("click", () => {
            if (this.isShown(index)) this.events.save(index);
        });
        const item = make("li", { class: "cell" }, button, caption, message, save);
        return { item, button, caption, message, label: "", isStale: false, retired: {} };
    }

    private rove(index: number): void {
        this.cells.forEach(({ button }, at) => (button.tabIndex = at === index ? 0 : -1));
    }

    private indexOf(target: EventTarget | null): number {
        return this.cells.findIndex(({ button }) => button === target);
    }

    private connect(list: HTMLElement): void {
        list.addEventListener("focusin", ({ target }) => {
            const index = this.indexOf(target);
            if (index < 0) return;
            this.rove(index);
            this.events.considered(index);
        });
        list.addEventListener("pointerover", ({ target }) => {
            const index = this.indexOf(target);
            if (index >= 0) this.events.considered(index);
        });
        list.addEventListener("keydown", (event) => {
            const index = this.indexOf(event.target);
            if (index < 0 || event.ctrlKey || event.metaKey || event.altKey) return;
            const [row, column] = [Math.floor(index / columns), index % columns];
            const places: Record<string, number> = {
                ArrowLeft: row * columns + Math.max(0, column - 1),
                ArrowRight: row * columns + Math.min(columns - 1, column + 1),
                ArrowUp: Math.max(0, row - 1) * columns + column,
                ArrowDown: Math.min(childCount / columns - 1, row + 1) * columns + column,
                Home: 0,
                End: childCount - 1,
            };
            const place = places[event.key];
            if (place !== undefined) this.focus(place);
            else if ((event.key === "s" || event.key === "S") && this.isShown(index)) this.events.save(index);
            else return;
            event.preventDefault();
        });
        this.connectDrags(list);
        list.addEventListener("click", ({ target }) => {
            const index = this.indexOf(target);
            if (this.isShown(index)) this.events.chosen(index);
        });
    }

    /** Returns false for a child that is on its way: the one before it is seen still. */
    private isShown(index: number): boolean {
        const cell = this.cells[index];
        return !!cell?.shown && !cell.item.classList.contains("pending");
    }

    /** A drag turns all children; a shorter one remains a click. */
    private connectDrags(list: HTMLElement): void {
        let drag: { id: number; x: number; y: number; azimuth: number; elevation: number; turned: boolean } | undefined;
        const degrees = 180 / Math.PI;
        list.addEventListener("pointerdown", (event) => {
            if (!event.isPrimary || event.button !== 0) return;
            const { x, y, z } = this.direction;
            drag = {
                id: event.pointerId,
                x: event.clientX,
                y: event.clientY,
                azimuth: Math.atan2(x, z) * degrees,
                elevation: Math.asin(Math.min(1, Math.max(-1, y))) * degrees,
                turned: false,
            };
        });
        addEventListener("pointermove", (event) => {
            if (!drag || event.pointerId !== drag.id) return;
            const [dx, dy] = [event.clientX - drag.x, event.clientY - drag.y];
            if (!drag.turned && Math.hypot(dx, dy) < clickReach) return;
            drag.turned = true;
            const azimuth = (drag.azimuth - dx * degreesPerPixel) / degrees;
            // A finger that moves upwards scrolls the page.
            const lift = event.pointerType === "touch" ? 0 : dy * degreesPerPixel;
            const elevation = Math.min(highest, Math.max(lowest, drag.elevation + lift)) / degrees;
            const flat = Math.cos(elevation);
            this.direction.set(Math.sin(azimuth) * flat, Math.sin(elevation), Math.cos(azimuth) * flat);
            this.drawSoon();
        });
        addEventListener("pointerup", (event) => {
            if (!drag || event.pointerId !== drag.id) return;
            const { turned } = drag;
            drag = undefined;
            if (!turned) return;
            const stop = (click: Event): void => click.stopPropagation();
            list.addEventListener("click", stop, { capture: true, once: true });
            setTimeout(() => list.removeEventListener("click", stop, { capture: true }), 0);
        });
        addEventListener("pointercancel", () => (drag = undefined));
    }
}
