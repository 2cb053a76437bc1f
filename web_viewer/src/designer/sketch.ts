// The photograph, and the lines that are drawn on it by mouse, pen, finger or keyboard.
import { byId, draw } from "../dom";
import {
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
    said: (text: string) => void;
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

export class Sketch {
    private readonly element = byId<HTMLElement & SVGSVGElement>("sketch");
    private readonly image = draw("image");
    private readonly traced = draw("g", { class: "traced" });
    private readonly strokes = draw("g", { class: "strokes" });
    private readonly unfinished = draw("g", { class: "unfinished" });
    private readonly crosshair = draw("g", { class: "crosshair" });
    private readonly place = byId<HTMLOutputElement>("place");
    private extent: Extent = { width: 1, height: 1 };
    private gesture_: Gesture | undefined;
    private tool_: Tool = "axis";
    private points: Point[] = [];
    private press: Press | undefined;
    private cursor: Point = [0, 0];
    private idle_ = false;

    constructor(private readonly events: SketchEvents) {
        const { element } = this;
        element.append(this.image, this.traced, this.strokes, this.unfinished, this.crosshair);
        this.crosshair.append(draw("path", { class: "casing" }), draw("path", { class: "line" }));
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
        this.element.setAttribute("viewBox", `0 0 ${width} ${height}`);
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
    exactly({ clientX, clientY }: PointerEvent): Point {
        const matrix = this.element.getScreenCTM();
        if (!matrix) return [0, 0];
        const { x, y } = new DOMPoint(clientX, clientY).matrixTransform(matrix.inverse());
        return [x, y];
    }

    get pending(): number {
        return this.points.length;
    }

    /** Shows what the service has measured, over the photograph. */
    showTrace(trace: Trace | undefined): void {
        if (!trace) return this.traced.replaceChildren();
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
    private get ratio(): number {
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
        const steps: Record<string, Point> = {
            ArrowLeft: [-1, 0],
            ArrowRight: [1, 0],
            ArrowUp: [0, -1],
            ArrowDown: [0, 1],
        };
        const step = steps[event.key];
        if (event.ctrlKey || event.metaKey || event.altKey || this.idle_) return;
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
        const active = tool === this.tool_ ? " active" : "";
        const group = draw("g", { class: `stroke ${tool}${active}` });
        const d = tool === "frame" ? pathOf(corners(line), true) : pathOf(line);
        group.append(draw("path", { class: "casing", d }), draw("path", { class: "line", d }));
        if (!active || line.length > 24) return group;
        for (const [cx, cy] of line) group.append(draw("circle", { cx, cy }));
        return group;
    }
}
