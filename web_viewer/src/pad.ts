// The weight polygon: a point between three to five species, moved with the pointer or the arrow
// keys.
import { draw } from "./dom";
import { insidePolygon, pointOf, polygon, weightsAt, type Point } from "./weights";

export interface WeightPadEvents {
    /** The point is being dragged. */
    moving: (weights: number[]) => void;
    /** The point was released. */
    moved: (weights: number[]) => void;
}

const reach = 100;
/** Distance within which the point snaps to a corner, as a fraction of the radius. */
const snap = 0.045;
const keySteps: Record<string, Point> = {
    ArrowLeft: { x: -1, y: 0 },
    ArrowRight: { x: 1, y: 0 },
    ArrowUp: { x: 0, y: -1 },
    ArrowDown: { x: 0, y: 1 },
};

export class WeightPad {
    readonly element = draw("svg", {
        class: "pad",
        viewBox: "-134 -128 268 256",
        role: "group",
        "aria-label": "Weights of the species",
    });
    private corners: Point[] = [];
    private point: Point = { x: 0, y: 0 };
    private readonly shape = draw("polygon", { class: "field" });
    private readonly rays = draw("g", { class: "rays" });
    private readonly labels = draw("g", { class: "corners" });
    private readonly handle = draw(
        "g",
        { class: "handle", tabindex: 0, role: "slider", id: "weight-point" },
        draw("circle", { class: "hit", r: 22 }),
        draw("circle", { class: "ring", r: 11 }),
        draw("circle", { class: "dot", r: 4 }),
    );
    private pointer: number | undefined;

    constructor(private readonly events: WeightPadEvents) {
        this.element.append(this.shape, this.rays, this.labels, this.handle);
        this.handle.setAttribute("aria-roledescription", "point between species");
        this.handle.setAttribute("aria-valuemin", "0");
        this.handle.setAttribute("aria-valuemax", "100");
        this.element.addEventListener("pointerdown", (event) => this.startDrag(event));
        this.element.addEventListener("pointermove", (event) => {
            if (event.pointerId === this.pointer) this.move(this.placeOf(event), false);
        });
        for (const type of ["pointerup", "pointercancel"] as const) {
            this.element.addEventListener(type, (event) => {
                if (event.pointerId !== this.pointer) return;
                this.pointer = undefined;
                this.element.classList.remove("held");
                this.events.moved(this.weights);
            });
        }
        this.handle.addEventListener("keydown", (event) => this.onKey(event));
    }

    /** Shows named corners and weights. The point stays where it is if it has these weights
     *  already. */
    show(names: readonly string[], weights: readonly number[]): void {
        if (names.length !== this.corners.length) this.corners = polygon(names.length);
        this.shape.setAttribute(
            "points",
            this.corners.map(({ x, y }) => `${x * reach},${y * reach}`).join(" "),
        );
        const far = weightsAt(this.point, this.corners).some(
            (weight, index) => Math.abs(weight - (weights[index] ?? 0)) > 0.0011,
        );
        if (far) this.point = pointOf(weights, this.corners);
        this.labels.replaceChildren(
            ...this.corners.map(({ x, y }, index) => {
                const corner = draw(
                    "g",
                    { class: "corner", "data-corner": index },
                    draw("title", {}, names[index] ?? ""),
                );
                corner.append(
                    draw("circle", { cx: x * reach, cy: y * reach, r: 14 }),
                    draw("text", { x: x * reach, y: y * reach, dy: ".35em" }, letterOf(index)),
                );
                return corner;
            }),
        );
        this.place(names, weights);
    }

    private place(names: readonly string[], weights: readonly number[]): void {
        const { x, y } = this.point;
        this.handle.setAttribute("transform", `translate(${x * reach} ${y * reach})`);
        this.rays.replaceChildren(
            ...this.corners.map((corner, index) =>
                draw("line", {
                    x1: corner.x * reach,
                    y1: corner.y * reach,
                    x2: x * reach,
                    y2: y * reach,
                    "stroke-width": (1 + 7 * (weights[index] ?? 0)).toFixed(2),
                    "data-corner": index,
                }),
            ),
        );
        const parts = weights.map((weight, index) => ({
            name: names[index] ?? "",
            percent: Math.round(weight * 100),
        }));
        const spoken = parts
            .filter(({ percent }) => percent > 0)
            .map(({ name, percent }) => `${name} ${percent} %`)
            .join(", ");
        this.handle.setAttribute(
            "aria-label",
            "Point between the species; arrow keys move it, digits go to a corner, " +
                "Home to the middle",
        );
        this.handle.setAttribute(
            "aria-valuenow",
            String(Math.max(...parts.map(({ percent }) => percent))),
        );
        this.handle.setAttribute("aria-valuetext", spoken);
    }

    private get weights(): number[] {
        return weightsAt(this.point, this.corners);
    }

    private placeOf(event: PointerEvent): Point {
        const matrix = this.element.getScreenCTM();
        if (!matrix) return this.point;
        const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(
            matrix.inverse(),
        );
        return { x: x / reach, y: y / reach };
    }

    private startDrag(event: PointerEvent): void {
        if (event.button !== 0 || this.pointer !== undefined) return;
        const corner = (event.target as Element).closest<SVGElement>(".corner")?.dataset["corner"];
        const place = this.placeOf(event);
        const onField = Math.hypot(place.x, place.y) <= 1.15;
        if (!onField) return;
        event.preventDefault();
        this.pointer = event.pointerId;
        this.element.classList.add("held");
        this.element.setPointerCapture(event.pointerId);
        this.handle.focus({ preventScroll: true });
        this.move(corner === undefined ? place : this.corners[Number(corner)]!, false);
    }

    private move(to: Point, letGo: boolean): void {
        this.point = insidePolygon(to, this.corners, snap);
        (letGo ? this.events.moved : this.events.moving)(this.weights);
    }

    private onKey(event: KeyboardEvent): void {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const step = keySteps[event.key];
        const corner = /^[1-9]$/.test(event.key) ? this.corners[Number(event.key) - 1] : undefined;
        let to: Point | undefined = corner;
        if (event.key === "Home") to = { x: 0, y: 0 };
        if (step) {
            const size = event.shiftKey ? 0.2 : 0.04;
            to = { x: this.point.x + step.x * size, y: this.point.y + step.y * size };
        }
        if (!to) return;
        event.preventDefault();
        // A step away from a corner must not snap back to it.
        this.point = insidePolygon(to, this.corners, step ? 0.019 : 0);
        this.events.moved(this.weights);
    }
}

/** Returns the letter of an index: A, B, C… */
export function letterOf(index: number): string {
    return String.fromCharCode(65 + index);
}
