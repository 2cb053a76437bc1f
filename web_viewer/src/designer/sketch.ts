// The photograph, and the lines that are drawn on it by mouse, pen, finger or keyboard.
import { byId, draw } from "../dom";
import {
    arrowSteps,
    distance,
    inside,
    simplified,
    strokesOf,
    tools,
    withPoint,
    withStroke,
    type Extent,
    type Gesture,
    type Point,
    type Stroke,
    type Tool,
} from "./gesture";
import type { Trace } from "./service";

export interface SketchEvents {
    /** A stroke is complete, or a point of one was moved. */
    drawn: (gesture: Gesture) => void;
    /** Points of a stroke that is not complete were placed or taken back. */
    pending: (count: number) => void;
    /** Two fingers zoom: what one of them began is given up. */
    pinching: () => void;
    said: (text: string) => void;
}

/** The part of the picture in the window, pixels of the picture. */
export interface View {
    x: number;
    y: number;
    width: number;
    height: number;
}

/** How far one can come nearer. */
const mostZoom = 16;
const zoomStep = 1.4;

/** Returns a view that is nearer by a factor, with a place of the picture where it was; never more
 *  than the bounds. */
export function zoomed(view: View, bounds: View, factor: number, [x, y]: Point): View {
    const least = bounds.width / mostZoom;
    const width = Math.min(Math.max(view.width / factor, least), bounds.width);
    const scale = width / view.width;
    const height = (width * bounds.height) / bounds.width;
    return limited(
        { x: x - (x - view.x) * scale, y: y - (y - view.y) * scale, width, height },
        bounds,
    );
}

/** Returns a view that is inside of the bounds. */
function limited(view: View, bounds: View): View {
    const within = (value: number, low: number, free: number): number =>
        Math.min(Math.max(value, low), low + Math.max(free, 0));
    return {
        ...view,
        x: within(view.x, bounds.x, bounds.width - view.width),
        y: within(view.y, bounds.y, bounds.height - view.height),
    };
}

/** Returns the view that has a box in it with a margin, in the shape of the bounds. */
export function viewOf(box: View, bounds: View): View {
    const margin = 1.3;
    const width = Math.min(
        Math.max(
            box.width * margin,
            (box.height * margin * bounds.width) / bounds.height,
            bounds.width / mostZoom,
        ),
        bounds.width,
    );
    const height = (width * bounds.height) / bounds.width;
    const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
    return limited({ x: middle.x - width / 2, y: middle.y - height / 2, width, height }, bounds);
}

/** Returns the bounds of a picture and of a box, which has a margin where it is outside. */
export function boundsWith({ width, height }: Extent, box: View | undefined): View {
    if (!box) return { x: 0, y: 0, width, height };
    const margin = 0.04 * Math.max(width, height);
    const before = (value: number): number => (value < 0 ? value - margin : 0);
    const after = (value: number, most: number): number => (value > most ? value + margin : most);
    const [x, y] = [before(box.x), before(box.y)];
    return {
        x,
        y,
        width: after(box.x + box.width, width) - x,
        height: after(box.y + box.height, height) - y,
    };
}

/** Movement of the pointer that makes a line of a click, pixels of the screen. */
const dragPixels = 6;

/** Distance at which a click is meant for a point, pixels of the screen: half of a target of 44. */
const grabPixels = 22;

/** How far a simplified line may be from the drawn one, of the longer side of the picture. */
const tolerance = 0.004;

/** Tools whose points can be moved on the picture. */
const withHandles: readonly Tool[] = ["axis", "cap", "frame"];

interface Press {
    from: { x: number; y: number };
    dragged: boolean;
    path: Point[];
    /** The point of the tool's stroke that is moved. */
    handle: number | undefined;
}

function pathOf(points: Stroke, closed = false): string {
    const line = points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join("L");
    return line && `M${line}${closed ? "Z" : ""}`;
}

function corners([a, b]: Stroke): Stroke {
    if (!a || !b) return [];
    return [a, [b[0], a[1]], b, [a[0], b[1]]];
}

/** Returns a stroke as it is drawn, without its points. */
export function strokeGroup(tool: Tool, line: Stroke, isActive: boolean): SVGGElement {
    const d = tool === "frame" ? pathOf(corners(line), true) : pathOf(line);
    return draw(
        "g",
        { class: `stroke ${tool}${isActive ? " active" : ""}` },
        draw("path", { class: "casing", d }),
        draw("path", { class: "line", d }),
    );
}

export class Sketch {
    private readonly content: SVGGElement;
    private readonly image = draw("image");
    private readonly traced = draw("g", { class: "traced" });
    private readonly strokes = draw("g", { class: "strokes" });
    private readonly unfinished = draw("g", { class: "unfinished" });
    private readonly crosshair = draw("g", { class: "crosshair" });
    private extent: Extent = { width: 1, height: 1 };
    private gesture_: Gesture | undefined;
    private tool_: Tool = "axis";
    private points: Point[] = [];
    private press: Press | undefined;
    private cursor: Point = [0, 0];
    private idle_ = false;
    private bounds: View = { x: 0, y: 0, width: 1, height: 1 };
    private view = this.bounds;
    private readonly fingers = new Map<number, { x: number; y: number }>();
    private picking: ((place: Point | undefined) => void) | undefined;

    constructor(
        private readonly events: SketchEvents,
        private readonly element = byId<HTMLElement & SVGSVGElement>("sketch"),
        private readonly place = byId<HTMLOutputElement>("place"),
    ) {
        this.content = draw("g", { id: `${element.id}-content` });
        const { content } = this;
        element.append(content);
        content.append(this.image, this.traced, this.strokes, this.unfinished, this.crosshair);
        this.crosshair.append(draw("path", { class: "casing" }), draw("path", { class: "line" }));
        this.listenToFingers();
        element.addEventListener("pointerdown", (event) => this.down(event));
        element.addEventListener("pointermove", (event) => this.move(event));
        element.addEventListener("pointerup", (event) => this.up(event));
        element.addEventListener("pointercancel", () => this.letGo());
        element.addEventListener("keydown", (event) => this.key(event));
        element.addEventListener("focus", () => {
            if (element.matches(":focus-visible")) element.classList.add("keys");
            this.showCursor();
        });
        element.addEventListener("blur", () => element.classList.remove("keys"));
        new ResizeObserver(() => this.scale()).observe(element);
    }

    /** Shows a picture without anything drawn on it. */
    open(address: string, extent: Extent): void {
        this.extent = extent;
        const { width, height } = extent;
        this.pick(undefined);
        this.bounds = boundsWith(extent, undefined);
        this.zoomWhole();
        this.image.setAttribute("href", address);
        this.image.setAttribute("width", String(width));
        this.image.setAttribute("height", String(height));
        this.element.parentElement?.style.setProperty("--shape", `${width} / ${height}`);
        this.cursor = inside([width / 2, height * 0.9], extent);
        this.points = [];
        this.showTrace(undefined);
        this.scale();
    }

    set gesture(gesture: Gesture) {
        this.gesture_ = gesture;
        this.redraw();
    }

    get tool(): Tool {
        return this.tool_;
    }

    /** The tool that the next stroke is drawn with; an unfinished one is dropped. */
    set tool(tool: Tool) {
        this.tool_ = tool;
        this.element.dataset["tool"] = tool;
        this.setPoints([]);
        this.redraw();
    }

    /** While it is idle nothing is drawn: the outline is edited. */
    set idle(idle: boolean) {
        this.idle_ = idle;
        this.element.classList.toggle("editing", idle);
        if (idle) this.setPoints([]);
    }

    /** Lays something over the photograph that has events of its own. */
    overlay(element: SVGElement): void {
        this.crosshair.before(element);
    }

    /** Returns where an event is, in pixels of the photograph and parts of them. */
    exactly({ clientX, clientY }: { clientX: number; clientY: number }): Point {
        const matrix = this.element.getScreenCTM();
        if (!matrix) return [0, 0];
        const { x, y } = new DOMPoint(clientX, clientY).matrixTransform(matrix.inverse());
        return [x, y];
    }

    /** Comes nearer or goes away; about the middle, or about a place of the picture. */
    zoom(factor: number, about?: Point): void {
        const { x, y, width, height } = this.view;
        const middle: Point = [x + width / 2, y + height / 2];
        this.view = zoomed(this.view, this.bounds, factor, about ?? middle);
        this.applyView();
    }

    zoomIn(): void {
        this.zoom(zoomStep);
    }

    zoomOut(): void {
        this.zoom(1 / zoomStep);
    }

    /** Shows the whole picture. */
    zoomWhole(): void {
        this.view = this.bounds;
        this.applyView();
    }

    /** Lets a box be shown also where it is outside of the picture. */
    include(box: View | undefined): void {
        const isWhole = this.view.width >= this.bounds.width;
        this.bounds = boundsWith(this.extent, box);
        this.view = isWhole ? this.bounds : zoomed(this.view, this.bounds, 1, [0, 0]);
        this.applyView();
    }

    /** Comes near to a box if it would be small, and shows the whole picture otherwise. */
    zoomTo(box: View): void {
        const near = viewOf(box, this.bounds);
        this.view = near.width < 0.5 * this.bounds.width ? near : this.bounds;
        this.applyView();
    }

    /** Moves the window so that a place is in it. */
    reveal([x, y]: Point): void {
        const { view } = this;
        const inView =
            x > view.x && x < view.x + view.width && y > view.y && y < view.y + view.height;
        if (inView) return;
        const moved = { ...view, x: x - view.width / 2, y: y - view.height / 2 };
        this.view = limited(moved, this.bounds);
        this.applyView();
    }

    private applyView(): void {
        const { x, y, width, height } = this.view;
        this.element.setAttribute("viewBox", `${x} ${y} ${width} ${height}`);
        this.scale();
    }

    /** Lets the next click, or Enter at the crosshair, choose a place of the picture; `done` gets
     *  undefined if it is given up. */
    pick(done: ((place: Point | undefined) => void) | undefined): void {
        const { picking } = this;
        this.picking = undefined;
        picking?.(undefined);
        this.picking = done;
        this.element.classList.toggle("picking", !!done);
        if (done) this.element.focus();
    }

    private picked(place: Point): void {
        const done = this.picking;
        this.picking = undefined;
        this.element.classList.remove("picking");
        done?.(place);
    }

    /** Two fingers zoom and move the picture; the wheel does with Ctrl, as touch pads send it. */
    private listenToFingers(): void {
        const { element, fingers } = this;
        element.addEventListener(
            "pointerdown",
            (event) => {
                if (this.picking && event.isPrimary && event.button === 0) {
                    event.stopPropagation();
                    event.preventDefault();
                    return this.picked(this.toPicture(event));
                }
                if (event.pointerType !== "touch") return;
                if (event.isPrimary) fingers.clear();
                fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
                if (fingers.size !== 2) return;
                this.letGo();
                this.events.pinching();
            },
            true,
        );
        element.addEventListener(
            "pointermove",
            (event) => {
                if (!fingers.has(event.pointerId)) return;
                const before = [...fingers.values()];
                fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
                if (fingers.size < 2) return;
                event.stopPropagation();
                this.pinch(before, [...fingers.values()]);
            },
            true,
        );
        const gone = (event: PointerEvent): void => {
            fingers.delete(event.pointerId);
        };
        for (const name of ["pointerup", "pointercancel"] as const)
            element.addEventListener(name, gone, true);
        element.addEventListener(
            "wheel",
            (event) => {
                if (!event.ctrlKey) return;
                event.preventDefault();
                this.zoom(2 ** (-event.deltaY / 120), this.exactly(event));
            },
            { passive: false },
        );
    }

    private pinch(
        [a, b]: readonly { x: number; y: number }[],
        [c, d]: readonly { x: number; y: number }[],
    ): void {
        if (!a || !b || !c || !d) return;
        const apart = Math.hypot(a.x - b.x, a.y - b.y);
        const factor = apart > 0 ? Math.hypot(c.x - d.x, c.y - d.y) / apart : 1;
        const middle = this.exactly({ clientX: (a.x + b.x) / 2, clientY: (a.y + b.y) / 2 });
        const to = this.exactly({ clientX: (c.x + d.x) / 2, clientY: (c.y + d.y) / 2 });
        const [dx, dy] = [to[0] - middle[0], to[1] - middle[1]];
        const shifted = { ...this.view, x: this.view.x - dx, y: this.view.y - dy };
        this.view = zoomed(shifted, this.bounds, factor, middle);
        this.applyView();
    }

    get pending(): number {
        return this.points.length;
    }

    /** Shows what the service has measured, over the photograph. */
    showTrace(trace: Trace | undefined): void {
        if (!trace || trace.outline.left.length === 0) return this.traced.replaceChildren();
        const { outline, marks } = trace;
        const border = pathOf([...outline.left, ...[...outline.right].reverse()], true);
        const { width, height } = this.extent;
        const around = `M0 0H${width}V${height}H0Z`;
        const diamonds = [
            ["where stem and lower face meet", marks.junctions],
            ["margin", marks.margins],
        ] as const;
        this.traced.replaceChildren(
            draw("path", { class: "shade", d: around + border, "fill-rule": "evenodd" }),
            draw("path", { class: "casing", d: border }),
            draw("path", { class: "outline", d: border }),
            draw("path", { class: "middle", d: pathOf(outline.axis) }),
            ...diamonds.flatMap(([name, places]) =>
                places.map(([x, y]) => {
                    const mark = draw("g", { class: "mark", transform: `translate(${x} ${y})` });
                    mark.append(draw("title", {}, name), draw("path", { d: "M0-6 6 0 0 6-6 0Z" }));
                    return mark;
                }),
            ),
        );
        this.scale();
    }

    /** Ends the stroke that is being placed point by point. */
    finish(): void {
        if (this.points.length < 2) return this.events.said("A line needs two points at least.");
        this.complete(this.points);
    }

    /** Takes back the last placed point; returns false if there is none. */
    takeBack(): boolean {
        if (this.points.length === 0) return false;
        this.setPoints(this.points.slice(0, -1));
        this.events.said(`Point taken back; ${this.points.length} left.`);
        return true;
    }

    private complete(stroke: Stroke): void {
        const { gesture_: gesture, tool_: tool } = this;
        if (!gesture) return;
        const { width, height } = this.extent;
        const fewest =
            tool === "frame" ? stroke : simplified(stroke, tolerance * Math.max(width, height));
        this.points = [];
        this.events.pending(0);
        this.events.drawn(withStroke(gesture, tool, fewest));
    }

    private setPoints(points: Point[]): void {
        this.points = points;
        this.redraw();
        this.events.pending(points.length);
    }

    /** Places a point; a second one at the same place ends the stroke. */
    private add(point: Point, samePixels: number): void {
        const last = this.points.at(-1);
        if (last && distance(last, point) <= samePixels) return this.finish();
        this.setPoints([...this.points, point]);
        const count = this.points.length;
        if (this.tool_ === "frame" && count === 2) return this.complete(this.points);
        this.events.said(`Point ${count} at ${point[0]}, ${point[1]}.`);
    }

    /** Pixels of the picture per pixel of the screen. */
    get ratio(): number {
        return 1 / (this.element.getScreenCTM()?.a || 1);
    }

    private toPicture(event: PointerEvent): Point {
        return inside(this.exactly(event), this.extent);
    }

    private down(event: PointerEvent): void {
        if (event.button !== 0 || !event.isPrimary || !this.gesture_ || this.idle_) return;
        this.element.classList.remove("keys");
        this.element.setPointerCapture(event.pointerId);
        const point = this.toPicture(event);
        this.cursor = point;
        this.press = {
            from: { x: event.clientX, y: event.clientY },
            dragged: false,
            path: [point],
            handle: this.points.length === 0 ? this.handleAt(point) : undefined,
        };
    }

    private handleAt(point: Point): number | undefined {
        if (!this.gesture_ || !withHandles.includes(this.tool_)) return undefined;
        const stroke = strokesOf(this.gesture_, this.tool_)[0] ?? [];
        let nearest: number | undefined;
        let least = grabPixels * this.ratio;
        stroke.forEach((place, index) => {
            const away = distance(place, point);
            if (away <= least) [nearest, least] = [index, away];
        });
        return nearest;
    }

    private move(event: PointerEvent): void {
        const { press } = this;
        if (!press || !event.isPrimary) return;
        const { from } = press;
        press.dragged ||= Math.hypot(event.clientX - from.x, event.clientY - from.y) > dragPixels;
        if (!press.dragged) return;
        for (const each of event.getCoalescedEvents?.() ?? [event]) {
            press.path.push(this.toPicture(each));
        }
        this.cursor = press.path.at(-1) ?? this.cursor;
        this.redraw();
    }

    private up(event: PointerEvent): void {
        const { press, gesture_: gesture } = this;
        if (!press || !event.isPrimary || !gesture) return;
        const end = this.toPicture(event);
        this.press = undefined;
        if (press.handle !== undefined) {
            if (press.dragged)
                this.events.drawn(withPoint(gesture, this.tool_, [0, press.handle], end));
            else this.redraw();
        } else if (!press.dragged) {
            this.add(end, (event.pointerType === "touch" ? grabPixels : dragPixels) * this.ratio);
        } else if (this.tool_ === "frame") {
            this.complete([this.points[0] ?? press.path[0] ?? end, end]);
        } else {
            this.complete([...this.points, ...press.path, end]);
        }
    }

    private letGo(): void {
        this.press = undefined;
        this.redraw();
    }

    private key(event: KeyboardEvent): void {
        const step = arrowSteps[event.key];
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const zooms: Record<string, () => void> = {
            "+": () => this.zoomIn(),
            "=": () => this.zoomIn(),
            "-": () => this.zoomOut(),
            "0": () => this.zoomWhole(),
        };
        const zoom = zooms[event.key];
        if (zoom) {
            event.preventDefault();
            return zoom();
        }
        if (this.idle_ && !this.picking) return;
        if (this.picking && (event.key === "Enter" || event.key === "Escape")) {
            event.preventDefault();
            if (event.key === "Enter") this.picked(this.cursor);
            else this.pick(undefined);
            return;
        }
        if (step) {
            const far = event.shiftKey ? 10 : 1;
            const [x, y] = this.cursor;
            this.cursor = inside([x + far * step[0], y + far * step[1]], this.extent);
        } else if (event.key === "Enter") {
            this.add(this.cursor, 0);
        } else if (event.key === "Escape") {
            if (this.press) this.letGo();
            else if (!this.takeBack()) return;
        } else {
            return;
        }
        event.preventDefault();
        this.element.classList.add("keys");
        this.showCursor();
        this.redraw();
    }

    private showCursor(): void {
        const [x, y] = this.cursor;
        this.crosshair.setAttribute("transform", `translate(${x} ${y})`);
        if (this.element.classList.contains("keys")) this.reveal(this.cursor);
        this.place.textContent = `${x}, ${y}`;
    }

    /** Lets dots and marks have the same size on the screen whatever the size of the picture. */
    private scale(): void {
        this.element.style.setProperty("--pixel", `${this.ratio}px`);
        const reach = 15 * this.ratio;
        const gap = 4 * this.ratio;
        const arms = `M${-reach} 0H${-gap}M${gap} 0H${reach}M0 ${-reach}V${-gap}M0 ${gap}V${reach}`;
        for (const line of this.crosshair.children) line.setAttribute("d", arms);
        for (const mark of this.traced.querySelectorAll(".mark path"))
            mark.setAttribute("transform", `scale(${this.ratio})`);
    }

    private redraw(): void {
        const gesture = this.moved();
        if (!gesture) return;
        this.strokes.replaceChildren(
            ...tools.flatMap((tool) =>
                strokesOf(gesture, tool).map((line) => this.drawn(tool, line)),
            ),
        );
        const { press, points, tool_: tool } = this;
        const path = press?.dragged && press.handle === undefined ? press.path : [];
        const line = tool === "frame" ? [...points, ...path.slice(0, 1), ...path.slice(-1)] : [];
        const shape =
            tool === "frame" ? line.slice(0, 1).concat(line.slice(-1)) : [...points, ...path];
        this.unfinished.replaceChildren(this.drawn(tool, shape));
    }

    /** The gesture with the point that is being moved at its new place. */
    private moved(): Gesture | undefined {
        const { gesture_: gesture, press, tool_: tool, cursor } = this;
        if (!gesture || press?.handle === undefined || !press.dragged) return gesture;
        return withPoint(gesture, tool, [0, press.handle], cursor);
    }

    private drawn(tool: Tool, line: Stroke): SVGGElement {
        const isActive = tool === this.tool_;
        const group = strokeGroup(tool, line, isActive);
        if (!isActive || line.length > 24) return group;
        for (const [cx, cy] of line) group.append(draw("circle", { cx, cy }));
        return group;
    }
}
