// The control points of an outline on the photograph, and the curve between them: each can be dragged,
// and never through another part of the outline.
import { draw } from "../dom";
import type { Point } from "./gesture";
import {
    controlsOf,
    curveNames,
    dragged,
    isRemovable,
    nearestOn,
    polylineOf,
    snapped,
    startOfCurve,
    weightsOfCurve,
    weightsOfPiece,
    weightsOfPoint,
    type AxisFrame,
    type Control,
    type Curve,
    type OutlinePoint,
    type Silhouette,
} from "./outline";
import { millimetres } from "./service";

export interface OutlineEditorEvents {
    /** The outline changes while a point is dragged. */
    moving: (silhouette: Silhouette) => void;
    /** A point was let go at another place: one step of undo. */
    moved: (silhouette: Silhouette) => void;
    /** A point is wanted at a share of the piece behind this one. */
    insert: (at: number, share: number) => void;
    remove: (at: number) => void;
    /** Whole curves are moved, or single points again. */
    whole: (whole: boolean) => void;
    /** What a finger covers, to be shown larger; undefined once it is let go. */
    covered: (place: Point | undefined) => void;
    /** A point has the focus that may be outside of the window. */
    focused: (place: Point) => void;
    said: (text: string) => void;
}

export interface ShownOutline {
    silhouette: Silhouette;
    frame: AxisFrame;
    /** Outlines of the neighbouring ages, younger and older. */
    neighbours: readonly { silhouette: Silhouette; frame: AxisFrame; older: boolean }[];
    /** What points snap to: outlines as measured, in the half-plane of the axis. */
    measured: readonly (readonly OutlinePoint[])[];
}

/** Steps of the arrow keys, of the height. */
const step = 0.005;
const longStep = 0.05;
const shortStep = 0.001;

/** Distance at which a dragged point snaps, pixels of the screen. */
const snapPixels = 8;

/** How far above the finger a dragged point is, pixels of the screen. */
export const abovePixels = 40;

/** A pointer that is so near to a point means it and not the curve, pixels of the screen. */
const knobPixels = 13;

/** Movement that makes a drag of a touch, pixels of the screen. */
const dragPixels = 6;

/** A finger that rests so long on the curve adds a point, milliseconds. */
const longPressMs = 500;

function labelOf({ curve, index, of, r, y }: Control): string {
    const place = `${millimetres(r)} from the axis, ${millimetres(y)} high`;
    return `${curveNames[curve]}, point ${index + 1} of ${of}, ${place}`;
}

function sentenceOf([one, other]: [Curve, Curve | "axis"]): string {
    if (other === "axis") return `The ${curveNames[one]} would cross the axis further on.`;
    if (one === other) return `The ${curveNames[one]} would cross itself further on.`;
    return `The ${curveNames[one]} would cross the ${curveNames[other]} further on.`;
}

interface Drag {
    /** The point that is dragged, or the one before the piece of the curve. */
    at: number;
    /** Share of that piece; undefined for the point itself. */
    share: number | undefined;
    touch: boolean;
    from: { x: number; y: number };
    /** The pointer has moved far enough. */
    begun: boolean;
}

export class OutlineEditor {
    readonly element = draw("g", { class: "controls" });
    private readonly behind = draw("g", { class: "behind" });
    private readonly curve = draw("g", { class: "curve" });
    private readonly ghost = draw("circle", { class: "ghost" });
    private readonly handles = draw("g", { role: "group", "aria-label": "Points of the outline" });
    private shown: ShownOutline | undefined;
    private height = 0;
    private current = 1;
    private drag: Drag | undefined;
    private whole = false;
    private spaceHeld = false;
    private pressing: ReturnType<typeof setTimeout> | undefined;
    private start: Silhouette | undefined;
    /** What was last said about a crossing, so that it is said once. */
    private said = "";

    /** `toPicture` returns where a place of the window is on the photograph. */
    constructor(
        private readonly toPicture: (place: { clientX: number; clientY: number }) => Point,
        private readonly events: OutlineEditorEvents,
    ) {
        this.element.append(this.behind, this.curve, this.ghost, this.handles);
        this.element.addEventListener("pointerdown", (event) => this.down(event));
        this.element.addEventListener("pointermove", (event) => this.move(event));
        this.element.addEventListener("pointerup", () => this.letGo());
        this.element.addEventListener("pointercancel", () => this.putBack());
        this.element.addEventListener("dblclick", (event) => {
            // The pointer was captured: the event does not tell what is below it.
            const below = document.elementFromPoint(event.clientX, event.clientY);
            if (below?.classList.contains("grab")) this.insertAt(event);
        });
        this.element.addEventListener("keydown", (event) => this.key(event));
        this.element.addEventListener("keyup", (event) => {
            if (event.key === " ") this.spaceHeld = false;
            else if (event.key.startsWith("Arrow")) this.letGo();
        });
        this.element.addEventListener("focusout", () => this.letGo());
        this.element.addEventListener("focusin", (event) => {
            const index = Number((event.target as SVGElement).dataset["index"]);
            if (index === this.current) return;
            this.current = index;
            this.redraw();
        });
    }

    /** Shows an outline, or nothing. */
    show(shown: ShownOutline | undefined): void {
        const had = this.element.contains(document.activeElement);
        const apex = shown && controlsOf(shown.silhouette).at(-1)?.y;
        this.start = undefined;
        this.drag = undefined;
        this.events.covered(undefined);
        if (!shown || !apex) {
            this.shown = undefined;
            for (const group of [this.handles, this.curve, this.behind]) group.replaceChildren();
            return;
        }
        this.shown = { ...shown };
        this.height = apex;
        this.current = Math.min(this.current, controlsOf(shown.silhouette).length - 1);
        this.showBehind();
        this.redraw();
        if (had) this.focus();
    }

    focus(): void {
        this.handles.querySelector<SVGElement>('[tabindex="0"]')?.focus();
    }

    /** Arrows and drags move whole curves, or single points again. */
    set wholeCurves(whole: boolean) {
        this.whole = whole;
    }

    /** Adds a point behind the current one. */
    insert(): void {
        const { shown } = this;
        if (!shown) return;
        if (this.current < controlsOf(shown.silhouette).length - 1)
            this.events.insert(this.current, 0.5);
        else this.events.said("No curve goes on behind the apex.");
    }

    /** Removes the current point. */
    remove(): void {
        const { shown } = this;
        if (!shown) return;
        if (isRemovable(shown.silhouette, this.current)) this.events.remove(this.current);
        else this.events.said("This point belongs to two curves or to the axis; it stays.");
    }

    /** Ends a drag without a change: a second finger zooms. */
    giveUp(): void {
        this.putBack();
    }

    private pathOf(line: readonly OutlinePoint[], frame: AxisFrame): string {
        const on = (which: -1 | 1): string =>
            line
                .map((place) => frame.toPhoto(place, which).map((value) => value.toFixed(1)))
                .map(([x, y]) => `${x} ${y}`)
                .join("L");
        return `M${on(-1)}M${on(1)}`;
    }

    private showBehind(): void {
        const { shown } = this;
        if (!shown) return;
        this.behind.replaceChildren(
            ...shown.neighbours.flatMap(({ silhouette, frame, older }) => {
                const d = this.pathOf(polylineOf(silhouette), frame);
                return [
                    draw("path", { class: "casing", d }),
                    draw("path", { class: `neighbour ${older ? "older" : "younger"}`, d }),
                ];
            }),
            ...shown.measured.map((line) =>
                draw("path", { class: "measured", d: this.pathOf(line, shown.frame) }),
            ),
        );
    }

    /** Draws the outline and its points. While a point is moved its element stays, so that it keeps
     *  the focus and the pointer. */
    private redraw(): void {
        const { shown } = this;
        if (!shown) return;
        const { frame, silhouette } = shown;
        const d = this.pathOf(polylineOf(silhouette), frame);
        if (this.curve.childElementCount === 0)
            this.curve.append(
                draw("path", { class: "casing" }),
                draw("path", { class: "edited" }),
                draw("path", { class: "grab" }),
            );
        for (const path of this.curve.children) path.setAttribute("d", d);
        const controls = controlsOf(silhouette);
        if (this.handles.childElementCount !== 2 * controls.length)
            this.handles.replaceChildren(
                ...controls.flatMap((_, index) => [this.handle(index, -1), this.handle(index, 1)]),
            );
        [...this.handles.children].forEach((element, place) => {
            const index = place >> 1;
            const control = controls[index];
            if (!control) return;
            const [x, y] = frame.toPhoto(control, place % 2 === 0 ? -1 : 1);
            element.setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)})`);
            if (place % 2 === 0) return;
            element.setAttribute("aria-label", labelOf(control));
            element.setAttribute("tabindex", index === this.current ? "0" : "-1");
            element.classList.toggle("shared", control.index === control.of - 1);
        });
    }

    /** Both sides can be dragged; the right one has the keys. */
    private handle(index: number, on: -1 | 1): SVGGElement {
        const handle = draw("g", { class: "handle", "data-index": index, "data-side": on });
        if (on === 1) {
            handle.setAttribute("role", "button");
            handle.setAttribute("aria-roledescription", "point");
        } else {
            handle.setAttribute("aria-hidden", "true");
        }
        handle.append(draw("circle", { class: "hit" }), draw("circle", { class: "knob" }));
        return handle;
    }

    /** Metres per pixel of the screen. */
    private get metres(): number {
        const a = this.toPicture({ clientX: 0, clientY: 0 });
        const b = this.toPicture({ clientX: 1, clientY: 0 });
        return (b[0] - a[0]) / (this.shown?.frame.scale ?? 1);
    }

    /** Returns the point that is nearest to a pointer, and how far away it is on the screen. */
    private nearestHandle(event: PointerEvent): { index: number; away: number } {
        const { shown } = this;
        const [x, y] = this.toPicture(event);
        let best = { index: 0, away: Infinity };
        if (!shown) return best;
        const pixels = this.metres * shown.frame.scale;
        controlsOf(shown.silhouette).forEach((control, index) => {
            for (const on of [-1, 1] as const) {
                const [px, py] = shown.frame.toPhoto(control, on);
                const away = Math.hypot(px - x, py - y) / pixels;
                if (away < best.away) best = { index, away };
            }
        });
        return best;
    }

    private down(event: PointerEvent): void {
        const { shown } = this;
        if (!shown || event.button !== 0 || !event.isPrimary) return;
        const target = event.target as Element;
        const onHandle = target.closest<SVGElement>(".handle");
        if (!onHandle && !target.classList.contains("grab")) return;
        const meant = this.nearestHandle(event);
        // Targets of points are large and overlap: between them the curve is meant.
        const handle = onHandle && meant.away <= knobPixels ? meant.index : undefined;
        event.stopPropagation();
        event.preventDefault();
        this.element.setPointerCapture(event.pointerId);
        const found = nearestOn(shown.silhouette, shown.frame.fromPhoto(this.toPicture(event)));
        const beside = found.away / this.metres <= knobPixels;
        const point = handle ?? (onHandle && !beside ? meant.index : undefined);
        this.current = point ?? found.span + (found.share > 0.5 ? 1 : 0);
        this.redraw();
        // Another point that had the focus is let go.
        this.focus();
        const touch = event.pointerType === "touch";
        this.drag = {
            at: point ?? found.span,
            share: point === undefined ? found.share : undefined,
            touch,
            from: { x: event.clientX, y: event.clientY },
            begun: false,
        };
        this.start = shown.silhouette;
        if (touch && point === undefined)
            this.pressing = setTimeout(() => {
                this.putBack();
                this.events.insert(found.span, found.share);
            }, longPressMs);
    }

    private move(event: PointerEvent): void {
        const { drag, shown } = this;
        if (!drag || !shown || !event.isPrimary) return;
        event.stopPropagation();
        const far = Math.hypot(event.clientX - drag.from.x, event.clientY - drag.from.y);
        const needed = drag.touch ? dragPixels : drag.share === undefined ? 0 : dragPixels / 2;
        if (!drag.begun && far < needed) return;
        drag.begun = true;
        clearTimeout(this.pressing);
        // Under a finger the point stands above it, where it can be seen.
        const raised = drag.touch ? abovePixels : 0;
        const pointer = this.toPicture({
            clientX: event.clientX,
            clientY: event.clientY - raised,
        });
        let place = shown.frame.fromPhoto(pointer);
        const near =
            event.ctrlKey || drag.share !== undefined || this.spaceHeld || this.whole
                ? undefined
                : snapped(place, shown.measured, snapPixels * this.metres);
        for (const element of this.handles.children)
            element.classList.toggle(
                "snapped",
                !!near && Number((element as SVGElement).dataset["index"]) === drag.at,
            );
        place = near ?? place;
        this.goTo(place, pointer);
        if (drag.touch) this.events.covered(pointer);
    }

    /** Where the dragged point, or the place of the curve that is dragged, is now. */
    private get grabbed(): OutlinePoint {
        const { drag, shown, current } = this;
        if (!shown) return { r: 0, y: 0 };
        const controls = controlsOf(shown.silhouette);
        if (drag?.share === undefined) return controls[current] ?? { r: 0, y: 0 };
        const pieces = 16;
        const line = polylineOf(shown.silhouette, pieces);
        return line[drag.at * pieces + Math.round(drag.share * pieces)] ?? { r: 0, y: 0 };
    }

    private get weights(): number[] {
        const { drag, shown, current } = this;
        if (!shown) return [];
        const controls = controlsOf(shown.silhouette);
        if (this.whole || (drag && this.spaceHeld)) {
            const own = controls[drag?.share === undefined ? current : drag.at + 1];
            return own ? weightsOfCurve(shown.silhouette, own.curve) : [];
        }
        if (drag?.share === undefined) return weightsOfPoint(current);
        // By so much more does the curve stay at the pointer.
        const { at, share } = drag;
        const follows = (1 - share) ** 2 + share ** 2;
        return weightsOfPiece(at, share).map((weight) => weight / follows);
    }

    /** Moves what is dragged as near to a place as it can be; `pointer` in pixels. */
    private goTo(place: OutlinePoint, pointer: Point | undefined): void {
        const { shown } = this;
        if (!shown) return;
        const { r, y } = this.grabbed;
        const by = { r: place.r - r, y: place.y - y };
        const { silhouette: next, stopped } = dragged(shown.silhouette, this.weights, by);
        shown.silhouette = next;
        const wanted = pointer ?? shown.frame.toPhoto(place, 1);
        this.ghost.classList.toggle("shown", !!stopped);
        this.ghost.setAttribute("cx", String(wanted[0]));
        this.ghost.setAttribute("cy", String(wanted[1]));
        const text = stopped ? sentenceOf(stopped) : "";
        if (text && text !== this.said) this.events.said(text);
        this.said = text;
        this.redraw();
        this.events.moving(next);
    }

    private endDrag(): void {
        clearTimeout(this.pressing);
        this.drag = undefined;
        this.spaceHeld = false;
        this.ghost.classList.remove("shown");
        for (const element of this.handles.children) element.classList.remove("snapped");
        this.events.covered(undefined);
    }

    private letGo(): void {
        this.endDrag();
        const { start, shown } = this;
        this.start = undefined;
        if (!start || !shown || start === shown.silhouette) return;
        const control = controlsOf(shown.silhouette)[this.current];
        if (control && !this.said) this.events.said(labelOf(control));
        this.events.moved(shown.silhouette);
    }

    private putBack(): void {
        const { start, shown } = this;
        this.start = undefined;
        this.endDrag();
        if (!start || !shown || start === shown.silhouette) return;
        shown.silhouette = start;
        this.redraw();
        this.events.moving(start);
    }

    private insertAt(event: MouseEvent): void {
        const { shown } = this;
        if (!shown) return;
        const place = shown.frame.fromPhoto(this.toPicture(event));
        const { span, share } = nearestOn(shown.silhouette, place);
        this.events.insert(span, share);
    }

    private key(event: KeyboardEvent): void {
        const { shown } = this;
        if (!shown || event.ctrlKey || event.metaKey) return;
        const controls = controlsOf(shown.silhouette);
        const control = controls[this.current];
        if (!control) return;
        const directions: Readonly<Record<string, Point>> = {
            ArrowLeft: [-1, 0],
            ArrowRight: [1, 0],
            ArrowUp: [0, 1],
            ArrowDown: [0, -1],
        };
        const direction = directions[event.key];
        const walk: Readonly<Record<string, () => number>> = {
            PageUp: () => this.current + 1,
            PageDown: () => this.current - 1,
            "]": () => startOfCurve(shown.silhouette, this.current, 1),
            "[": () => startOfCurve(shown.silhouette, this.current, -1),
            Home: () => 0,
            End: () => controls.length - 1,
        };
        const next = walk[event.key]?.();
        if (direction) {
            this.start ??= shown.silhouette;
            const share = event.shiftKey ? longStep : event.altKey ? shortStep : step;
            const far = share * this.height;
            const place = { r: control.r + far * direction[0], y: control.y + far * direction[1] };
            this.goTo(this.whole ? place : { r: Math.max(place.r, 0), y: place.y }, undefined);
        } else if (next !== undefined) {
            this.current = Math.min(Math.max(next, 0), controls.length - 1);
            this.redraw();
            this.focus();
            const at = controls[this.current];
            if (at) this.events.focused(shown.frame.toPhoto(at, 1));
        } else if (event.key === " ") {
            if (this.drag) this.spaceHeld = true;
            else if (!event.repeat) this.events.whole(!this.whole);
        } else if (event.key === "Insert") {
            this.insert();
        } else if (event.key === "Delete") {
            this.remove();
        } else if (event.key === "Escape" && this.start) {
            this.putBack();
        } else {
            return;
        }
        event.preventDefault();
        event.stopPropagation();
    }
}
