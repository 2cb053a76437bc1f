// The control points of the traced outline on the photograph: each can be moved, and never through
// another part of the outline.
import { draw } from "../dom";
import type { Point } from "./gesture";
import {
    AxisFrame,
    controlsOf,
    curveNames,
    isRemovable,
    moved,
    polylineOf,
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
    /** A point is wanted in the piece behind this one. */
    insert: (at: number) => void;
    remove: (at: number) => void;
    said: (text: string) => void;
}

/** Steps of the arrow keys, of the height. */
const step = 0.005;
const longStep = 0.05;
const shortStep = 0.001;

function labelOf({ curve, index, of, r, y }: Control): string {
    const place = `${millimetres(r)} from the axis, ${millimetres(y)} high`;
    return `${curveNames[curve]}, point ${index + 1} of ${of}, ${place}`;
}

function sentenceOf([one, other]: [Curve, Curve | "axis"]): string {
    if (other === "axis") return `The ${curveNames[one]} would cross the axis further on.`;
    if (one === other) return `The ${curveNames[one]} would cross itself further on.`;
    return `The ${curveNames[one]} would cross the ${curveNames[other]} further on.`;
}

export class OutlineEditor {
    readonly element = draw("g", { class: "controls" });
    private readonly curve = draw("g", { class: "curve" });
    private readonly ghost = draw("circle", { class: "ghost" });
    private readonly handles = draw("g", { role: "group", "aria-label": "Points of the outline" });
    private silhouette: Silhouette | undefined;
    private frame: AxisFrame | undefined;
    private height = 0;
    private current = 1;
    private dragged: number | undefined;
    private start: Silhouette | undefined;
    /** What was last said about a crossing, so that it is said once. */
    private said = "";

    /** `toPicture` returns where an event is on the photograph. */
    constructor(
        private readonly toPicture: (event: PointerEvent) => Point,
        private readonly events: OutlineEditorEvents,
    ) {
        this.element.append(this.curve, this.ghost, this.handles);
        this.element.addEventListener("pointerdown", (event) => this.down(event));
        this.element.addEventListener("pointermove", (event) => this.move(event));
        this.element.addEventListener("pointerup", () => this.letGo());
        this.element.addEventListener("pointercancel", () => this.putBack());
        this.element.addEventListener("keydown", (event) => this.key(event));
        this.element.addEventListener("keyup", (event) => {
            if (event.key.startsWith("Arrow")) this.letGo();
        });
        this.element.addEventListener("focusout", () => this.letGo());
        this.element.addEventListener("focusin", (event) => {
            const index = Number((event.target as SVGElement).dataset["index"]);
            if (index === this.current) return;
            this.current = index;
            this.redraw();
        });
    }

    /** Shows an outline along an axis of the photograph, or nothing. */
    show(silhouette: Silhouette | undefined, axis: readonly Point[]): void {
        const had = this.element.contains(document.activeElement);
        const apex = silhouette && controlsOf(silhouette).at(-1)?.y;
        this.silhouette = silhouette;
        this.start = undefined;
        this.dragged = undefined;
        if (!silhouette || !apex || axis.length < 2) {
            this.handles.replaceChildren();
            this.curve.replaceChildren();
            return;
        }
        this.frame = new AxisFrame(axis, apex);
        this.height = apex;
        this.current = Math.min(this.current, controlsOf(silhouette).length - 1);
        this.redraw();
        if (had) this.focus();
    }

    focus(): void {
        this.handles.querySelector<SVGElement>('[tabindex="0"]')?.focus();
    }

    /** Draws the outline and its points. While a point is moved its element stays, so that it keeps
     *  the focus and the pointer. */
    private redraw(): void {
        const { frame, silhouette } = this;
        if (!frame || !silhouette) return;
        const line = polylineOf(silhouette);
        const on = (which: -1 | 1): string =>
            line
                .map((place) => frame.toPhoto(place, which).map((value) => value.toFixed(1)))
                .map(([x, y]) => `${x} ${y}`)
                .join("L");
        const d = `M${on(-1)}M${on(1)}`;
        this.curve.replaceChildren(
            draw("path", { class: "casing", d }),
            draw("path", { class: "edited", d }),
        );
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

    private down(event: PointerEvent): void {
        const handle = (event.target as Element).closest<SVGElement>(".handle");
        if (!handle || event.button !== 0 || !event.isPrimary) return;
        event.stopPropagation();
        event.preventDefault();
        this.element.setPointerCapture(event.pointerId);
        this.current = Number(handle.dataset["index"]);
        this.redraw();
        // Another point that had the focus is let go.
        this.focus();
        this.dragged = this.current;
        this.start = this.silhouette;
    }

    private move(event: PointerEvent): void {
        if (this.dragged === undefined || !this.frame || !event.isPrimary) return;
        event.stopPropagation();
        this.goTo(this.frame.fromPhoto(this.toPicture(event)), event);
    }

    /** Moves the current point as near to a place as it can be. */
    private goTo(place: OutlinePoint, event: PointerEvent | undefined): void {
        const { silhouette, frame } = this;
        if (!silhouette || !frame) return;
        const { silhouette: next, stopped } = moved(silhouette, this.current, place);
        this.silhouette = next;
        const wanted = event ? this.toPicture(event) : frame.toPhoto(place, 1);
        this.ghost.classList.toggle("shown", !!stopped);
        this.ghost.setAttribute("cx", String(wanted[0]));
        this.ghost.setAttribute("cy", String(wanted[1]));
        const text = stopped ? sentenceOf(stopped) : "";
        if (text && text !== this.said) this.events.said(text);
        this.said = text;
        this.redraw();
        this.events.moving(next);
    }

    private letGo(): void {
        this.dragged = undefined;
        this.ghost.classList.remove("shown");
        const { start, silhouette } = this;
        this.start = undefined;
        if (!start || !silhouette || start === silhouette) return;
        const control = controlsOf(silhouette)[this.current];
        if (control && !this.said) this.events.said(labelOf(control));
        this.events.moved(silhouette);
    }

    private putBack(): void {
        const { start } = this;
        this.start = undefined;
        this.dragged = undefined;
        this.ghost.classList.remove("shown");
        if (!start) return;
        this.silhouette = start;
        this.redraw();
        this.events.moving(start);
    }

    private key(event: KeyboardEvent): void {
        const { silhouette } = this;
        if (!silhouette || event.ctrlKey || event.metaKey) return;
        const controls = controlsOf(silhouette);
        const control = controls[this.current];
        if (!control) return;
        const directions: Readonly<Record<string, Point>> = {
            ArrowLeft: [-1, 0],
            ArrowRight: [1, 0],
            ArrowUp: [0, 1],
            ArrowDown: [0, -1],
        };
        const direction = directions[event.key];
        const walk: Readonly<Record<string, number>> = {
            PageUp: this.current + 1,
            "]": this.current + 1,
            PageDown: this.current - 1,
            "[": this.current - 1,
            Home: 0,
            End: controls.length - 1,
        };
        const next = walk[event.key];
        if (direction) {
            this.start ??= silhouette;
            const share = event.shiftKey ? longStep : event.altKey ? shortStep : step;
            const far = share * this.height;
            const place = { r: control.r + far * direction[0], y: control.y + far * direction[1] };
            this.goTo({ r: Math.max(place.r, 0), y: place.y }, undefined);
        } else if (next !== undefined) {
            this.current = Math.min(Math.max(next, 0), controls.length - 1);
            this.redraw();
            this.focus();
        } else if (event.key === "Insert") {
            if (this.current < controls.length - 1) this.events.insert(this.current);
        } else if (event.key === "Delete") {
            if (isRemovable(silhouette, this.current)) this.events.remove(this.current);
            else this.events.said("This point belongs to two curves or to the axis; it stays.");
        } else if (event.key === "Escape" && this.start) {
            this.putBack();
        } else {
            return;
        }
        event.preventDefault();
        event.stopPropagation();
    }
}
