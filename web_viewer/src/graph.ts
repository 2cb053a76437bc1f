// The graph of correspondence between two outlines, as in Figure 6 of the mushroom paper: arcs of
// the service and of the designer; accepted ones are green, refused ones red and crossed out. Ends
// are moved with the pointer or the arrow keys.
import { crosses, crossing, curveNames, matched, rounded, type Arc, type CurveName } from "./arcs";
import { draw } from "./dom";

export type Outline = Partial<Record<CurveName, [number, number][]>>;

export interface Correspondence {
    a: string;
    b: string;
    age?: number;
    outlines: { a: Outline; b: Outline };
    arcs: Arc[];
    certificate?: { simple?: boolean; method?: string };
}

export interface GraphEvents {
    /** An end is being dragged; `settled` once it was released. */
    change: (arcs: Arc[], settled: boolean) => void;
    select: (index: number | undefined) => void;
}

type Side = "a" | "b";

interface Polyline {
    points: { x: number; y: number }[];
    /** Fraction of the length at each point. */
    shares: number[];
}

/** Names of the ends of the sub-curves. */
const ends: Record<CurveName, [string, string]> = {
    stem: ["base", "top"],
    hymenium: ["stem", "margin"],
    cap: ["margin", "apex"],
};

function polyline(points: { x: number; y: number }[]): Polyline {
    const lengths = [0];
    for (let index = 1; index < points.length; ++index) {
        const [from, to] = [points[index - 1]!, points[index]!];
        lengths.push(lengths[index - 1]! + Math.hypot(to.x - from.x, to.y - from.y));
    }
    const whole = lengths.at(-1) || 1;
    return { points, shares: lengths.map((length) => length / whole) };
}

function placeAt({ points, shares }: Polyline, share: number): { x: number; y: number } {
    const next = Math.max(
        shares.findIndex((one) => one >= share),
        1,
    );
    const [from, to] = [
        points[next - 1] ?? { x: 0, y: 0 },
        points[next] ?? points[0] ?? { x: 0, y: 0 },
    ];
    const span = (shares[next] ?? 0) - (shares[next - 1] ?? 0);
    const t = span > 0 ? (share - shares[next - 1]!) / span : 0;
    return { x: from.x + t * (to.x - from.x), y: from.y + t * (to.y - from.y) };
}

/** Returns the point of a polyline that is nearest to (x, y), as a fraction of its length, and its
 *  distance. */
function nearestOn(
    { points, shares }: Polyline,
    x: number,
    y: number,
): { share: number; distance: number } {
    let best = { share: 0, distance: Infinity };
    for (let index = 1; index < points.length; ++index) {
        const [from, to] = [points[index - 1]!, points[index]!];
        const [dx, dy] = [to.x - from.x, to.y - from.y];
        const length = dx * dx + dy * dy;
        const t =
            length > 0
                ? Math.min(Math.max(((x - from.x) * dx + (y - from.y) * dy) / length, 0), 1)
                : 0;
        const distance = Math.hypot(from.x + t * dx - x, from.y + t * dy - y);
        if (distance < best.distance) {
            best = {
                share: shares[index - 1]! + t * (shares[index]! - shares[index - 1]!),
                distance,
            };
        }
    }
    return best;
}

export class Graph {
    readonly element = draw("svg", {
        class: "drawing",
        role: "group",
        "aria-label": "Outlines and the arcs between them",
    });
    private correspondence: Correspondence | undefined;
    private names: [string, string] = ["A", "B"];
    private arcs: Arc[] = [];
    private refused = new Set<number>();
    private selected: number | undefined;
    private dragged: { pointer: number; index: number; side: Side } | undefined;
    private curves: Record<Side, Map<CurveName, Polyline>> = { a: new Map(), b: new Map() };
    private readonly ground = draw("g", { class: "ground" });
    private readonly given = draw("g", { class: "given" });
    private readonly own = draw("g", { class: "own" });

    constructor(private readonly events: GraphEvents) {
        this.element.append(this.ground, this.given, this.own);
        this.element.addEventListener("pointerdown", (event) => this.startDrag(event));
        this.element.addEventListener("pointermove", (event) => this.drag(event));
        for (const type of ["pointerup", "pointercancel"] as const) {
            this.element.addEventListener(type, (event) => {
                if (this.dragged?.pointer !== event.pointerId) return;
                this.dragged = undefined;
                this.events.change(this.arcs, true);
            });
        }
        this.element.addEventListener("dblclick", (event) => this.onDoubleClick(event));
        new ResizeObserver(() => this.layOut()).observe(this.element);
    }

    get size(): { width: number; height: number } {
        return { width: this.element.clientWidth || 600, height: this.element.clientHeight || 260 };
    }

    show(known: Correspondence | undefined, names: [string, string]): void {
        // Elements stay the same, so that a second click makes a double click.
        if (known === this.correspondence && names.join() === this.names.join()) return;
        this.correspondence = known;
        this.names = names;
        this.layOut();
    }

    /** Shows the designer's arcs, which of them are refused, and which one is selected. */
    showArcs(
        arcs: readonly Arc[],
        refused: ReadonlySet<number>,
        selected: number | undefined,
    ): void {
        this.arcs = arcs.map((arc) => ({ ...arc }));
        this.refused = new Set(refused);
        this.selected = selected;
        this.drawArcs();
    }

    /** Returns the sub-curves that both outlines have. */
    get shared(): CurveName[] {
        return curveNames.filter((curve) => this.curves.a.has(curve) && this.curves.b.has(curve));
    }

    focusEnd(index: number, side: Side = "a"): void {
        this.own
            .querySelector<SVGElement>(`[data-index="${index}"] [data-side="${side}"]`)
            ?.focus();
    }

    private layOut(): void {
        const { width, height } = this.size;
        this.element.setAttribute("viewBox", `0 0 ${width} ${height}`);
        this.curves = { a: new Map(), b: new Map() };
        const parts: SVGElement[] = [];
        const outlines = this.correspondence?.outlines;
        if (outlines) {
            const centre = { a: width * 0.25, b: width * 0.75 };
            for (const side of ["a", "b"] as const) {
                const all = Object.values(outlines[side]).flat();
                const [low, high] = [
                    Math.min(...all.map(([, y]) => y)),
                    Math.max(...all.map(([, y]) => y)),
                ];
                const wide = Math.max(...all.map(([r]) => r), 1e-9);
                const scale = Math.min((height - 58) / (high - low || 1), (width * 0.225) / wide);
                const base = height - 30 - (height - 58 - (high - low) * scale) / 2;
                const facing = side === "a" ? 1 : -1;
                const place =
                    (mirror: number) =>
                    ([r, y]: [number, number]): { x: number; y: number } => ({
                        x: centre[side] + facing * mirror * r * scale,
                        y: base - (y - low) * scale,
                    });
                const whole = [
                    ...curveNames.flatMap((curve) => (outlines[side][curve] ?? []).map(place(1))),
                    ...curveNames
                        .flatMap((curve) => (outlines[side][curve] ?? []).map(place(-1)))
                        .reverse(),
                ];
                parts.push(draw("path", { class: "body", d: pathOf(whole) + "Z" }));
                parts.push(
                    draw("line", {
                        class: "axis",
                        x1: centre[side],
                        x2: centre[side],
                        y1: base + 6,
                        y2: base - (high - low) * scale - 6,
                    }),
                );
                for (const curve of curveNames) {
                    const points = (outlines[side][curve] ?? []).map(place(1));
                    if (points.length < 2) continue;
                    this.curves[side].set(curve, polyline(points));
                    parts.push(draw("path", { class: `curve ${curve}`, d: pathOf(points) }));
                    for (const end of [points[0]!, points.at(-1)!])
                        parts.push(
                            draw("circle", { class: "landmark", cx: end.x, cy: end.y, r: 2.6 }),
                        );
                }
                parts.push(
                    draw(
                        "text",
                        { class: "name", x: centre[side], y: height - 8 },
                        `${side.toUpperCase()}  ${this.names[side === "a" ? 0 : 1]}`,
                    ),
                );
            }
        }
        this.ground.replaceChildren(...parts);
        this.drawArcs();
    }

    private line(
        arc: Arc,
    ): { from: { x: number; y: number }; to: { x: number; y: number } } | undefined {
        const [a, b] = [this.curves.a.get(arc.curve), this.curves.b.get(arc.curve)];
        return a && b ? { from: placeAt(a, arc.a), to: placeAt(b, arc.b) } : undefined;
    }

    private drawArcs(): void {
        const given = (this.correspondence?.arcs ?? []).filter(
            (arc) => !this.arcs.some((own) => crosses(own, arc)),
        );
        this.given.replaceChildren(
            ...given.flatMap((arc) => {
                const line = this.line(arc);
                return line ? [draw("path", { class: `arc ${arc.curve}`, d: lineOf(line) })] : [];
            }),
        );
        const crossed = this.crossedArcs();
        // Handles stay the same elements, so that focus and pointer capture stay, too.
        while (this.own.children.length > this.arcs.length) this.own.lastElementChild?.remove();
        while (this.own.children.length < this.arcs.length)
            this.own.append(this.makeArc(this.own.children.length));
        this.arcs.forEach((arc, index) => {
            const group = this.own.children[index] as SVGGElement;
            const line = this.line(arc);
            group.style.display = line ? "" : "none";
            if (!line) return;
            const refused = this.refused.has(index) || crossed[index] === true;
            const state = refused ? "refused" : "accepted";
            const selected = this.selected === index ? " selected" : "";
            group.setAttribute("class", `arc ${state}${selected}`);
            group.querySelector(".hit")?.setAttribute("d", lineOf(line));
            group.querySelector(".line")?.setAttribute("d", lineOf(line));
            const middle = { x: (line.from.x + line.to.x) / 2, y: (line.from.y + line.to.y) / 2 };
            group
                .querySelector(".mark")
                ?.setAttribute("transform", `translate(${middle.x} ${middle.y})`);
            for (const side of ["a", "b"] as const) {
                const handle = group.querySelector<SVGElement>(`[data-side="${side}"]`)!;
                const at = side === "a" ? line.from : line.to;
                handle.setAttribute("transform", `translate(${at.x} ${at.y})`);
                const [from, to] = ends[arc.curve];
                const percent = Math.round(arc[side] * 1000) / 10;
                handle.setAttribute(
                    "aria-label",
                    `Arc ${index + 1}, ${arc.curve}, end on ${this.names[side === "a" ? 0 : 1]}`,
                );
                handle.setAttribute("aria-valuenow", String(arc[side]));
                handle.setAttribute(
                    "aria-valuetext",
                    `${percent} % of the way from ${from} to ${to}${refused ? "; refused" : ""}`,
                );
                if (refused) handle.setAttribute("aria-invalid", "true");
                else handle.removeAttribute("aria-invalid");
            }
        });
    }

    /** Returns which arcs will be refused, before the service reports it: of two that cross, the
     *  selected one, or else the later one. */
    private crossedArcs(): boolean[] {
        if (this.refused.size > 0) return [];
        const crossed = crossing(this.arcs);
        if (this.selected !== undefined && crossed[this.selected])
            return crossed.map((_, index) => index === this.selected);
        return this.arcs.map((arc, index) =>
            this.arcs.slice(0, index).some((other) => crosses(arc, other)),
        );
    }

    private makeArc(index: number): SVGGElement {
        const handle = (side: Side): SVGGElement => {
            const group = draw(
                "g",
                {
                    class: "end",
                    "data-side": side,
                    tabindex: 0,
                    role: "slider",
                    "aria-valuemin": 0,
                    "aria-valuemax": 1,
                },
                draw("circle", { class: "hit", r: 16 }),
                draw("circle", { class: "knob", r: 6.5 }),
            );
            group.addEventListener("keydown", (event) => this.onKey(event, index, side));
            group.addEventListener("focus", () => this.events.select(index));
            return group;
        };
        return draw(
            "g",
            { "data-index": index },
            draw("path", { class: "hit" }),
            draw("path", { class: "line" }),
            draw(
                "g",
                { class: "mark" },
                draw("circle", { r: 8 }),
                draw("path", { d: "M-3.5-3.5L3.5 3.5M3.5-3.5L-3.5 3.5" }),
            ),
            handle("a"),
            handle("b"),
        );
    }

    private placeOf(event: MouseEvent): { x: number; y: number } {
        const box = this.element.getBoundingClientRect();
        return { x: event.clientX - box.left, y: event.clientY - box.top };
    }

    private startDrag(event: PointerEvent): void {
        if (event.button !== 0 || this.dragged) return;
        const target = event.target as Element;
        const group = target.closest<SVGElement>("[data-index]");
        if (!group) return this.events.select(undefined);
        const index = Number(group.dataset["index"]);
        const side = target.closest<SVGElement>("[data-side]")?.dataset["side"] as Side | undefined;
        this.events.select(index);
        if (!side) return this.focusEnd(index);
        event.preventDefault();
        this.focusEnd(index, side);
        this.dragged = { pointer: event.pointerId, index, side };
        this.element.setPointerCapture(event.pointerId);
    }

    private drag(event: PointerEvent): void {
        if (this.dragged?.pointer !== event.pointerId) return;
        const { index, side } = this.dragged;
        const arc = this.arcs[index];
        const curve = arc && this.curves[side].get(arc.curve);
        if (!arc || !curve) return;
        const { x, y } = this.placeOf(event);
        const share = rounded(nearestOn(curve, x, y).share);
        if (share === arc[side]) return;
        arc[side] = share;
        this.refused.delete(index);
        this.drawArcs();
        this.events.change(this.arcs, false);
    }

    /** Adds an arc where an outline was double-clicked; its other end follows from the present
     *  arcs. */
    private onDoubleClick(event: MouseEvent): void {
        const { x, y } = this.placeOf(event);
        let best: { arc: Arc; distance: number } | undefined;
        for (const side of ["a", "b"] as const) {
            for (const curve of this.shared) {
                const line = this.curves[side].get(curve);
                if (!line) continue;
                const { share, distance } = nearestOn(line, x, y);
                if (distance > 18 || (best && best.distance <= distance)) continue;
                const arc: Arc = { curve, a: 0, b: 0 };
                arc[side] = rounded(share);
                arc[side === "a" ? "b" : "a"] = rounded(matched(this.guides, curve, share, side));
                best = { arc, distance };
            }
        }
        if (!best) return;
        this.events.change([...this.arcs, best.arc], true);
        this.events.select(this.arcs.length - 1);
        this.focusEnd(this.arcs.length - 1);
    }

    /** Returns the arcs in force: the designer's, and those of the service that do not cross
     *  them. */
    get guides(): Arc[] {
        const given = this.correspondence?.arcs ?? [];
        return [
            ...this.arcs,
            ...given.filter((arc) => !this.arcs.some((own) => crosses(own, arc))),
        ];
    }

    private onKey(event: KeyboardEvent, index: number, side: Side): void {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const arc = this.arcs[index];
        if (!arc) return;
        const direction = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1 }[event.key];
        if (direction === undefined) return;
        event.preventDefault();
        arc[side] = rounded(arc[side] + direction * (event.shiftKey ? 0.1 : 0.01));
        this.refused.delete(index);
        this.drawArcs();
        this.events.change(this.arcs, true);
    }
}

function pathOf(points: readonly { x: number; y: number }[]): string {
    return points
        .map(({ x, y }, index) => `${index ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`)
        .join("");
}

/** Returns the path of a straight line, as the paper draws its arcs. */
function lineOf({
    from,
    to,
}: {
    from: { x: number; y: number };
    to: { x: number; y: number };
}): string {
    return `M${from.x.toFixed(1)} ${from.y.toFixed(1)}L${to.x.toFixed(1)} ${to.y.toFixed(1)}`;
}
