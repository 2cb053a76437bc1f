// The points of a model's axis on the photograph: they bend the stem, and never so far that it folds.
import { draw } from "../dom";
import { bent, mostAxisPoints, placed, stemOf, type AxisPoint, type PlacedAxis } from "./axis_line";
import type { Point } from "./gesture";
import { polylineOf, type AxisFrame, type Silhouette } from "./outline";
import { abovePixels } from "./outline_editor";
import { millimetres } from "./service";

export interface AxisEditorEvents {
    moving: (axis: AxisPoint[]) => void;
    /** A point was let go at another place: one step of undo. */
    moved: (axis: AxisPoint[]) => void;
    insert: (at: number) => void;
    remove: (at: number) => void;
    covered: (place: Point | undefined) => void;
    focused: (place: Point) => void;
    said: (text: string) => void;
}

export interface ShownAxis {
    axis: AxisPoint[];
    silhouette: Silhouette;
    /** Where the traced axis is on the photograph. */
    traced: AxisFrame;
}

/** Steps of the arrow keys, of the height of the stem. */
const step = 0.005;
const longStep = 0.05;
const shortStep = 0.001;

/** Movement that makes a drag of a touch, pixels of the screen. */
const dragPixels = 6;

export class AxisEditor {
    readonly element = draw("g", { class: "controls axis-controls" });
    private readonly outline = draw("g", { class: "curve" });
    private readonly handles = draw("g", { role: "group", "aria-label": "Points of the axis" });
    private shown: ShownAxis | undefined;
    private place: PlacedAxis | undefined;
    private current = 1;
    private start: AxisPoint[] | undefined;
    private drag: { touch: boolean; begun: boolean; from: { x: number; y: number } } | undefined;
    private said = false;

    /** `toPicture` returns where a place of the window is on the photograph. */
    constructor(
        private readonly toPicture: (place: { clientX: number; clientY: number }) => Point,
        private readonly events: AxisEditorEvents,
    ) {
        this.element.append(this.outline, this.handles);
        this.element.addEventListener("pointerdown", (event) => this.down(event));
        this.element.addEventListener("pointermove", (event) => this.move(event));
        this.element.addEventListener("pointerup", () => this.letGo());
        this.element.addEventListener("pointercancel", () => this.giveUp());
        this.element.addEventListener("keydown", (event) => this.key(event));
        this.element.addEventListener("keyup", (event) => {
            if (event.key.startsWith("Arrow")) this.letGo();
        });
        this.element.addEventListener("focusout", () => this.letGo());
        this.element.addEventListener("focusin", (event) => {
            this.current = Number((event.target as SVGElement).dataset["index"]);
            this.redraw();
        });
    }

    /** Shows an axis, or nothing. */
    show(shown: ShownAxis | undefined): void {
        const had = this.element.contains(document.activeElement);
        this.start = undefined;
        this.drag = undefined;
        this.shown = shown && { ...shown };
        if (!shown) {
            this.handles.replaceChildren();
            this.outline.replaceChildren();
            return;
        }
        this.current = Math.min(Math.max(this.current, 1), Math.max(shown.axis.length - 1, 0));
        this.redraw();
        if (had) this.focus();
    }

    focus(): void {
        this.handles.querySelector<SVGElement>('[tabindex="0"]')?.focus();
    }

    insert(): void {
        const { shown } = this;
        if (!shown) return;
        if (shown.axis.length >= mostAxisPoints)
            this.events.said(`An axis has ${mostAxisPoints} points at most.`);
        else if (this.current + 1 < shown.axis.length) this.events.insert(this.current);
        else this.events.said("The axis ends here; choose a point before its top.");
    }

    remove(): void {
        const { shown } = this;
        if (!shown) return;
        if (this.current > 0 && this.current < shown.axis.length - 1)
            this.events.remove(this.current);
        else this.events.said("Both ends of the axis stay.");
    }

    /** Ends a drag without a change. */
    giveUp(): void {
        const { start, shown } = this;
        this.start = undefined;
        this.endDrag();
        if (!start || !shown || start === shown.axis) return;
        shown.axis = start;
        this.redraw();
        this.events.moving(start);
    }

    private labelOf({ x, y }: AxisPoint, index: number): string {
        const { shown } = this;
        if (!shown) return "";
        const { base, top } = stemOf(shown.silhouette);
        const aside = millimetres(Math.abs(x) * (top - base));
        const where =
            Math.abs(x) < 5e-4 ? "in the middle" : `${aside} to the ${x > 0 ? "right" : "left"}`;
        return `axis, point ${index + 1} of ${shown.axis.length}, ${where}, ${millimetres(base + y * (top - base))} high`;
    }

    private redraw(): void {
        const { shown } = this;
        if (!shown) return;
        const { axis, silhouette, traced } = shown;
        this.place = placed({ silhouette, axis }, traced);
        const { place } = this;
        if (!place) return;
        const text = (points: readonly Point[]): string =>
            points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join("L");
        const line = polylineOf(silhouette);
        const side = (on: -1 | 1): string =>
            text(line.map((each) => place.frame.toPhoto(each, on)));
        const d = `M${side(-1)}M${side(1)}`;
        const { base, top } = stemOf(silhouette);
        const middle = Array.from({ length: 25 }, (_, k) =>
            place.frame.toPhoto({ r: 0, y: base + (k / 24) * (top - base) }, 1),
        );
        this.outline.replaceChildren(
            draw("path", { class: "casing", d }),
            draw("path", { class: "edited", d }),
            draw("path", { class: "casing", d: `M${text(middle)}` }),
            draw("path", { class: "bend", d: `M${text(middle)}` }),
        );
        if (this.handles.childElementCount !== axis.length)
            this.handles.replaceChildren(...axis.map((_, index) => this.handle(index)));
        [...this.handles.children].forEach((element, index) => {
            const point = axis[index];
            if (!point) return;
            const [x, y] = place.toPhoto(point);
            element.setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)})`);
            element.setAttribute("aria-label", this.labelOf(point, index));
            element.setAttribute("tabindex", index === this.current ? "0" : "-1");
        });
    }

    private handle(index: number): SVGGElement {
        const handle = draw("g", {
            class: `handle${index === 0 ? " fixed" : ""}`,
            "data-index": index,
            role: "button",
            "aria-roledescription": "point",
        });
        handle.append(draw("circle", { class: "hit" }), draw("circle", { class: "knob" }));
        return handle;
    }

    /** Returns the point that is nearest to a place; the targets of points overlap. */
    private nearest([x, y]: Point): number {
        const off = (this.shown?.axis ?? []).map((point) => {
            const [px, py] = this.place?.toPhoto(point) ?? [0, 0];
            return Math.hypot(px - x, py - y);
        });
        return off.indexOf(Math.min(...off));
    }

    private down(event: PointerEvent): void {
        const handle = (event.target as Element).closest<SVGElement>(".handle");
        if (!handle || event.button !== 0 || !event.isPrimary || !this.shown) return;
        event.stopPropagation();
        event.preventDefault();
        this.element.setPointerCapture(event.pointerId);
        this.current = this.nearest(this.toPicture(event));
        this.redraw();
        this.focus();
        this.start = this.shown.axis;
        const touch = event.pointerType === "touch";
        this.drag = { touch, begun: false, from: { x: event.clientX, y: event.clientY } };
    }

    private move(event: PointerEvent): void {
        const { drag, place } = this;
        if (!drag || !place || !event.isPrimary) return;
        event.stopPropagation();
        const far = Math.hypot(event.clientX - drag.from.x, event.clientY - drag.from.y);
        if (!drag.begun && drag.touch && far < dragPixels) return;
        drag.begun = true;
        const raised = drag.touch ? abovePixels : 0;
        const pointer = this.toPicture({ clientX: event.clientX, clientY: event.clientY - raised });
        this.goTo(place.fromPhoto(pointer));
        if (drag.touch) this.events.covered(pointer);
    }

    private goTo(to: { x: number; y: number }): void {
        const { shown } = this;
        if (!shown) return;
        if (this.current === 0) {
            if (!this.said) this.events.said("The root of the stem stays where it is.");
            this.said = true;
            return;
        }
        const { axis, stopped } = bent(shown.axis, this.current, to, shown.silhouette);
        shown.axis = axis;
        if (stopped && !this.said) this.events.said("The stem would fold further on.");
        this.said = stopped;
        this.redraw();
        this.events.moving(axis);
    }

    private endDrag(): void {
        this.drag = undefined;
        this.said = false;
        this.events.covered(undefined);
    }

    private letGo(): void {
        const { start, shown, said } = this;
        this.start = undefined;
        this.endDrag();
        if (!start || !shown || start === shown.axis) return;
        const point = shown.axis[this.current];
        if (point && !said) this.events.said(this.labelOf(point, this.current));
        this.events.moved(shown.axis);
    }

    private key(event: KeyboardEvent): void {
        const { shown } = this;
        if (!shown || event.ctrlKey || event.metaKey) return;
        const point = shown.axis[this.current];
        if (!point) return;
        const directions: Readonly<Record<string, Point>> = {
            ArrowLeft: [-1, 0],
            ArrowRight: [1, 0],
            ArrowUp: [0, 1],
            ArrowDown: [0, -1],
        };
        const walk: Readonly<Record<string, number>> = {
            PageUp: this.current + 1,
            PageDown: this.current - 1,
            Home: 0,
            End: shown.axis.length - 1,
        };
        const direction = directions[event.key];
        const next = walk[event.key];
        if (direction) {
            this.start ??= shown.axis;
            const far = event.shiftKey ? longStep : event.altKey ? shortStep : step;
            this.goTo({ x: point.x + far * direction[0], y: point.y + far * direction[1] });
        } else if (next !== undefined) {
            this.current = Math.min(Math.max(next, 0), shown.axis.length - 1);
            this.redraw();
            this.focus();
            const at = shown.axis[this.current];
            if (at && this.place) this.events.focused(this.place.toPhoto(at));
        } else if (event.key === "Insert") {
            this.insert();
        } else if (event.key === "Delete") {
            this.remove();
        } else if (event.key === "Escape" && this.start) {
            this.giveUp();
        } else {
            return;
        }
        event.preventDefault();
        event.stopPropagation();
    }
}
