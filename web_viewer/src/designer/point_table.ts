// The points of a tool's lines as numbers: the same values as on the photograph.
import { byId, make } from "../dom";
import {
    inside,
    mostPoints,
    strokesOf,
    withPoint,
    withStrokes,
    type Extent,
    type Gesture,
    type Point,
    type Stroke,
    type Tool,
} from "./gesture";

export class PointTable {
    /** `name` begins the ids of its fields. */
    constructor(
        private readonly changed: (gesture: Gesture) => void,
        private readonly host = byId("points"),
        private readonly name = "point",
    ) {}

    show(gesture: Gesture, tool: Tool, extent: Extent): void {
        const focused = document.activeElement?.id;
        const strokes = strokesOf(gesture, tool);
        this.host.replaceChildren(
            ...strokes.map((stroke, index) => this.table(gesture, tool, extent, stroke, index)),
            ...(strokes.length === 0
                ? [make("p", { class: "hint" }, "Nothing is drawn yet.")]
                : []),
            ...this.adders(gesture, tool, extent, strokes),
        );
        if (focused && this.host.querySelector(`#${CSS.escape(focused)}`)) byId(focused).focus();
    }

    private table(
        gesture: Gesture,
        tool: Tool,
        extent: Extent,
        stroke: Stroke,
        line: number,
    ): HTMLElement {
        const caption = make("caption", {}, `Line ${line + 1}, pixels from the upper left corner`);
        const remove = make("button", { type: "button" }, "Remove the line");
        remove.addEventListener("click", () => {
            const others = strokesOf(gesture, tool).filter((_, index) => index !== line);
            this.changed(withStrokes(gesture, tool, others));
        });
        const rows = stroke.map((point, index) => {
            const cells = [0, 1].map((axis) => {
                const most = (axis === 0 ? extent.width : extent.height) - 1;
                const input = make("input", {
                    type: "number",
                    id: `${this.name}-${line}-${index}-${axis}`,
                    min: 0,
                    max: most,
                    step: 1,
                    value: point[axis as 0 | 1],
                    "aria-label": `${axis === 0 ? "x" : "y"} of point ${index + 1}, 0 to ${most}`,
                });
                input.addEventListener("change", () => {
                    const value = input.valueAsNumber;
                    if (!Number.isFinite(value)) {
                        input.value = String(point[axis as 0 | 1]);
                        return;
                    }
                    const place: Point = axis === 0 ? [value, point[1]] : [point[0], value];
                    this.changed(withPoint(gesture, tool, [line, index], inside(place, extent)));
                });
                return make("td", {}, input);
            });
            const off = make(
                "button",
                { type: "button", class: "off", "aria-label": `Remove point ${index + 1}` },
                "×",
            );
            off.disabled = stroke.length <= 2;
            off.addEventListener("click", () => {
                const fewer = strokesOf(gesture, tool).map((each, at) =>
                    at === line ? each.filter((_, place) => place !== index) : each,
                );
                this.changed(withStrokes(gesture, tool, fewer));
            });
            return make(
                "tr",
                {},
                make("th", { scope: "row" }, String(index + 1)),
                ...cells,
                make("td", {}, off),
            );
        });
        const head = make(
            "tr",
            {},
            ...["Point", "x", "y"].map((name) => make("th", { scope: "col" }, name)),
        );
        return make(
            "div",
            { class: "line-table" },
            make("table", {}, caption, make("thead", {}, head), make("tbody", {}, ...rows)),
            remove,
        );
    }

    /** Buttons that add a point to the last line, or a new line of two points. */
    private adders(
        gesture: Gesture,
        tool: Tool,
        extent: Extent,
        strokes: readonly Stroke[],
    ): HTMLElement[] {
        const buttons: HTMLElement[] = [];
        const add = (label: string, act: () => readonly Stroke[]): void => {
            const button = make("button", { type: "button" }, label);
            button.addEventListener("click", () => this.changed(withStrokes(gesture, tool, act())));
            buttons.push(button);
        };
        const last = strokes.at(-1);
        const end = last?.at(-1);
        if (last && end && tool !== "frame" && last.length < mostPoints)
            add("Add a point", () => [
                ...strokes.slice(0, -1),
                [...last, inside([end[0] + 10, end[1] + 10], extent)],
            ]);
        const { width, height } = extent;
        const at = (x: number, y: number): Point => inside([x * width, y * height], extent);
        const starts: Record<Tool, Stroke> = {
            axis: [at(0.5, 0.9), at(0.5, 0.1)],
            cap: [at(0.2, 0.3), at(0.8, 0.3)],
            keep: [at(0.45, 0.5), at(0.55, 0.5)],
            drop: [at(0.05, 0.9), at(0.15, 0.9)],
            frame: [at(0.05, 0.05), at(0.95, 0.95)],
        };
        if (!last || tool === "keep" || tool === "drop")
            add(tool === "frame" ? "Add the frame" : "Add a line", () => [
                ...strokes,
                starts[tool],
            ]);
        return [make("div", { class: "row" }, ...buttons)];
    }
}
