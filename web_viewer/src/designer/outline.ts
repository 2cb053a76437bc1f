// The outline of a mushroom: control points of three curves in the half-plane of the axis, the
// spline through them as the service evaluates it, and where it is on the photograph.
import { distance, type Point } from "./gesture";

/** A control point: distance from the axis and height, metres. */
export interface OutlinePoint {
    r: number;
    y: number;
}

export interface Silhouette {
    stem: OutlinePoint[];
    hymenium: OutlinePoint[];
    cap: OutlinePoint[];
    junction?: string;
    margin?: string;
}

export const curves = ["stem", "hymenium", "cap"] as const;
export type Curve = (typeof curves)[number];

/** A control point by its place; one that two curves share is that of the first. */
export interface Control extends OutlinePoint {
    curve: Curve;
    index: number;
    /** Number of control points of the curve. */
    of: number;
}

/** Names of the curves in sentences. */
export const curveNames: Readonly<Record<Curve, string>> = {
    stem: "stem",
    hymenium: "lower face",
    cap: "cap",
};

/** The least distance of two points of a curve, metres; the service wants a nanometre. */
const closest = 2e-9;

const bisections = 10;

/** A curve has at most so many points, as the service allows. */
export const mostOfCurve = 32;
const mostControls = 3 * mostOfCurve;

/** A new point is at least this share of a piece away from the points of the piece. */
const leastShare = 0.1;

/** Part of the way to a crossing that is not used, so that the shape can still be made. */
const reserve = 0.01;

/** Returns all control points from the foot to the apex, shared ones once. */
export function controlsOf(silhouette: Silhouette): Control[] {
    const controls: Control[] = [];
    for (const curve of curves) {
        const points = silhouette[curve];
        points.forEach(({ r, y }, index) => {
            if (index > 0 || controls.length === 0)
                controls.push({ r, y, curve, index, of: points.length });
        });
    }
    return controls;
}

/** Returns an outline whose points are these, in the order of controlsOf(). */
function rebuilt(silhouette: Silhouette, controls: readonly Control[]): Silhouette {
    const result: Silhouette = { ...silhouette, stem: [], hymenium: [], cap: [] };
    let last: OutlinePoint | undefined;
    for (const curve of curves) {
        if (silhouette[curve].length === 0) continue;
        if (last) result[curve].push(last);
        for (const { curve: own, r, y } of controls) {
            if (own !== curve) continue;
            last = { r, y };
            result[curve].push(last);
        }
    }
    return result;
}

/** Returns the outline with a point elsewhere; foot and apex stay on the axis. */
export function withControl(silhouette: Silhouette, at: number, to: OutlinePoint): Silhouette {
    const controls = controlsOf(silhouette);
    const old = controls[at];
    if (!old) return silhouette;
    const onAxis = at === 0 || at === controls.length - 1;
    controls[at] = { ...old, r: onAxis ? 0 : Math.max(to.r, 0), y: to.y };
    return rebuilt(silhouette, controls);
}

type Vector = readonly [number, number];

function minus(a: Vector, b: Vector): Vector {
    return [a[0] - b[0], a[1] - b[1]];
}

/** The velocity of a centripetal Catmull-Rom spline at the middle one of three points, as
 *  core/math/spline.h has it. */
function velocity(before: Vector, here: Vector, after: Vector): Vector {
    const a = Math.sqrt(distance(here, before));
    const b = Math.sqrt(distance(after, here));
    const on = minus(after, here);
    if (a < 1e-9 || b < 1e-9) return b < 1e-9 ? [0, 0] : [on[0] / b, on[1] / b];
    const back = minus(here, before);
    const over = minus(after, before);
    const part = (i: 0 | 1): number => back[i] / a - over[i] / (a + b) + on[i] / b;
    return [part(0), part(1)];
}

export interface Sample extends OutlinePoint {
    curve: Curve;
    /** Control point that the piece of the curve begins at, in the order of controlsOf(). */
    span: number;
}

/** A cubic between two control points in Hermite form. */
interface Segment {
    curve: Curve;
    span: number;
    from: Vector;
    to: Vector;
    leaving: Vector;
    arriving: Vector;
}

function segmentsOf(silhouette: Silhouette): Segment[] {
    const controls = controlsOf(silhouette);
    const places = controls.map(({ r, y }): Vector => [r, y]);
    const last = places.length - 1;
    const isCorner = ({ curve, index, of }: Control): boolean =>
        index === of - 1 &&
        ((curve === "stem" && silhouette.junction === "corner") ||
            (curve === "hymenium" && silhouette.margin === "corner"));
    const at = (i: number): Vector => places[i] ?? [0, 0];
    const mirrored = ([r, y]: Vector): Vector => [-r, y];
    const velocityAt = (i: number, leaving: boolean): Vector => {
        // At the axis the neighbour is the mirror image: the surface is smooth across its pole.
        if (i === 0) return velocity(mirrored(at(1)), at(0), at(1));
        if (i === last) return velocity(at(last - 1), at(last), mirrored(at(last - 1)));
        const control = controls[i];
        if (!control || !isCorner(control)) return velocity(at(i - 1), at(i), at(i + 1));
        const chord = leaving ? minus(at(i + 1), at(i)) : minus(at(i), at(i - 1));
        const step = Math.sqrt(Math.hypot(...chord));
        return step < 1e-9 ? [0, 0] : [chord[0] / step, chord[1] / step];
    };
    return places.slice(1).map((to, span) => {
        const step = Math.sqrt(distance(at(span), to));
        const scaled = ([r, y]: Vector): Vector => [r * step, y * step];
        return {
            curve: controls[span + 1]?.curve ?? "cap",
            span,
            from: at(span),
            to,
            leaving: scaled(velocityAt(span, true)),
            arriving: scaled(velocityAt(span + 1, false)),
        };
    });
}

function placeOn({ curve, span, from, to, leaving, arriving }: Segment, t: number): Sample {
    const value = (axis: 0 | 1): number => {
        const c = 3 * (to[axis] - from[axis]) - 2 * leaving[axis] - arriving[axis];
        const d = 2 * (from[axis] - to[axis]) + leaving[axis] + arriving[axis];
        return from[axis] + t * (leaving[axis] + t * (c + t * d));
    };
    return { r: value(0), y: value(1), curve, span };
}

/** Returns the spline through the control points as a polyline from the foot to the apex. */
export function polylineOf(silhouette: Silhouette, pieces = 8): Sample[] {
    return segmentsOf(silhouette).flatMap((segment, index) =>
        Array.from({ length: pieces + (index === 0 ? 1 : 0) }, (_, piece) =>
            placeOn(segment, (piece + (index === 0 ? 0 : 1)) / pieces),
        ),
    );
}

/** Returns the smallest distance from the axis inside a segment, infinity if it has no turning
 *  point there. */
function leastTurningR({ from: [from], to: [to], leaving: [m0], arriving: [m1] }: Segment): number {
    const [a, b, c] = [m0, 3 * (to - from) - 2 * m0 - m1, 3 * (2 * (from - to) + m0 + m1)];
    const discriminant = b * b - a * c;
    if (!(discriminant > 0)) return Infinity;
    const q = -(b + (b < 0 ? -1 : 1) * Math.sqrt(discriminant));
    const at = (t: number): number =>
        from + t * (m0 + t * (3 * (to - from) - 2 * m0 - m1 + t * (2 * (from - to) + m0 + m1)));
    const turning = [q / c, a / q].filter((t) => t > 0 && t < 1);
    return Math.min(Infinity, ...turning.map(at));
}

/** Where the service places the points that it tests, as core/silhouette/outline.cpp does: by the
 *  length of a curve and by its bends. */
const knotsBetweenControls = 24;
const turnPerLength = 7;
const mostPerLength = 9;
const testedPerControl = 8;

/** Returns the points of a curve that the service tests. */
function testedPoints(segments: readonly Segment[]): Sample[] {
    const knots = [{ at: 0, arc: 0, turn: 0 }];
    let last: Vector = segments[0]?.from ?? [0, 0];
    let heading: Vector | undefined;
    segments.forEach((segment, index) => {
        for (let i = 1; i <= knotsBetweenControls; ++i) {
            const share = i / knotsBetweenControls;
            const { r, y } = placeOn(segment, share);
            const step = minus([r, y], last);
            const length = Math.sqrt(step[0] * step[0] + step[1] * step[1]);
            let { arc, turn } = knots[knots.length - 1] ?? { arc: 0, turn: 0 };
            arc += length;
            if (length > 1e-12) {
                const direction: Vector = [step[0] / length, step[1] / length];
                if (heading) turn += distance(direction, heading);
                heading = direction;
            }
            knots.push({ at: index + share, arc, turn });
            last = [r, y];
        }
    });
    const length = Math.max(knots[knots.length - 1]?.arc ?? 0, 1e-12);
    let bends = 0;
    const places = knots.map(({ arc, turn }, k) => {
        const before = knots[k - 1];
        if (before) {
            const most = (mostPerLength * (arc - before.arc)) / length;
            bends += Math.min((turn - before.turn) / turnPerLength, most);
        }
        return arc / length + bends;
    });
    const count = (segments.length + 1) * testedPerControl;
    const total = places[places.length - 1] ?? 0;
    let k = 1;
    return Array.from({ length: count }, (_, i) => {
        const target = (total * i) / (count - 1);
        while (k + 1 < knots.length && (places[k] ?? 0) < target) ++k;
        const [from, to] = [places[k - 1] ?? 0, places[k] ?? 0];
        const t = to > from ? Math.min(Math.max((target - from) / (to - from), 0), 1) : 0;
        const [a, b] = [knots[k - 1]?.at ?? 0, knots[k]?.at ?? 0];
        const at = a + t * (b - a);
        const index = Math.min(Math.max(Math.floor(at), 0), segments.length - 1);
        const segment = segments[index];
        if (!segment) return { r: 0, y: 0, curve: "stem", span: 0 };
        if (i === 0) return placeOn(segment, 0);
        return placeOn(segment, i === count - 1 ? 1 : at - index);
    });
}

function side(a: OutlinePoint, b: OutlinePoint, c: OutlinePoint): number {
    return (b.r - a.r) * (c.y - a.y) - (b.y - a.y) * (c.r - a.r);
}

function cross(a: OutlinePoint, b: OutlinePoint, c: OutlinePoint, d: OutlinePoint): boolean {
    return side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0;
}

/** Returns the two curves that meet where they must not, undefined if the outline is simple; "axis"
 *  where a curve comes to the axis between the foot and the apex. It tests what the service tests,
 *  so that the page accepts what the service accepts. */
export function crossingOf(silhouette: Silhouette): [Curve, Curve | "axis"] | undefined {
    const segments = segmentsOf(silhouette);
    for (const segment of segments) {
        const { curve, span, from, to } = segment;
        if (distance(from, to) < closest) return [curve, curve];
        if ((span > 0 && from[0] <= 0) || leastTurningR(segment) <= 0) return [curve, "axis"];
    }
    const line = curves.flatMap((curve) => {
        const own = segments.filter((segment) => segment.curve === curve);
        if (own.length === 0) return [];
        return testedPoints(own).slice(curve === "stem" ? 0 : 1);
    });
    for (let i = 0; i + 1 < line.length; ++i) {
        const [a, b] = [line[i], line[i + 1]];
        if (!a || !b) continue;
        const [low, high] = [Math.min(a.y, b.y), Math.max(a.y, b.y)];
        for (let j = i + 2; j + 1 < line.length; ++j) {
            const [c, d] = [line[j], line[j + 1]];
            if (!c || !d || (c.y > high && d.y > high) || (c.y < low && d.y < low)) continue;
            if (cross(a, b, c, d)) return [b.curve, d.curve];
        }
    }
    return undefined;
}

export interface Move {
    silhouette: Silhouette;
    /** The curves that would have crossed further on. */
    stopped: [Curve, Curve | "axis"] | undefined;
}

/** Returns the outline with points moved by a shift times their weights; foot and apex stay on the
 *  axis. */
function shifted(silhouette: Silhouette, weights: readonly number[], by: OutlinePoint): Silhouette {
    const controls = controlsOf(silhouette);
    const last = controls.length - 1;
    return rebuilt(
        silhouette,
        controls.map((control, index) => {
            const weight = weights[index] ?? 0;
            if (weight === 0) return control;
            const onAxis = index === 0 || index === last;
            const r = onAxis ? 0 : Math.max(control.r + weight * by.r, 0);
            return { ...control, r, y: control.y + weight * by.y };
        }),
    );
}

/** Moves points by a shift times their weights, as far as the outline stays simple. */
export function dragged(
    silhouette: Silhouette,
    weights: readonly number[],
    by: OutlinePoint,
): Move {
    const part = (share: number): Silhouette =>
        shifted(silhouette, weights, { r: share * by.r, y: share * by.y });
    const whole = part(1);
    const stopped = crossingOf(whole);
    // What crosses itself already may be moved freely, so that it can be mended.
    if (!stopped || crossingOf(silhouette)) return { silhouette: whole, stopped };
    let best = silhouette;
    let [low, high] = [0, 1];
    for (let step = 0; step < bisections; ++step) {
        const share = (low + high) / 2;
        const tried = part(share);
        if (crossingOf(tried)) high = share;
        else [low, best] = [share, tried];
    }
    const nearly = part(low * (1 - reserve));
    return { silhouette: crossingOf(nearly) ? best : nearly, stopped };
}

/** Returns weights that move one point of an outline alone. */
export function weightsOfPoint(at: number): number[] {
    return Array.from({ length: at + 1 }, (_, index) => (index === at ? 1 : 0));
}

/** Returns weights that move the curve at a share of the piece behind a point: both points of the
 *  piece follow, the nearer one further. */
export function weightsOfPiece(at: number, share: number): number[] {
    return [...Array.from({ length: at }, () => 0), 1 - share, share];
}

/** Returns weights that move a whole curve, with the points that it shares. */
export function weightsOfCurve(silhouette: Silhouette, curve: Curve): number[] {
    const controls = controlsOf(silhouette);
    return controls.map(({ curve: own }, index) =>
        own === curve || (controls[index + 1]?.curve === curve && own !== curve) ? 1 : 0,
    );
}

/** Moves a point as far towards a place as the outline stays simple. */
export function moved(silhouette: Silhouette, at: number, to: OutlinePoint): Move {
    const from = controlsOf(silhouette)[at];
    if (!from) return { silhouette, stopped: undefined };
    const by = { r: to.r - from.r, y: to.y - from.y };
    return dragged(silhouette, weightsOfPoint(at), by);
}

/** Returns the point that another curve begins at, for walking from curve to curve. */
export function startOfCurve(silhouette: Silhouette, at: number, step: 1 | -1): number {
    const controls = controlsOf(silhouette);
    const present = curves.filter((curve) => silhouette[curve].length > 0);
    const own = controls[at]?.curve ?? "stem";
    const place = present.indexOf(own) + step;
    const curve = present[Math.min(Math.max(place, 0), present.length - 1)];
    // The first point of a curve that is its own: the shared one belongs to the curve before.
    const found = controls.findIndex((one) => one.curve === curve);
    return found < 0 ? at : found;
}

export interface OnCurve {
    /** Control point that the piece begins at, and the share of the piece. */
    span: number;
    share: number;
    place: OutlinePoint;
    /** Distance from what was looked for, metres. */
    away: number;
}

/** Returns the nearest place of the outline. */
export function nearestOn(silhouette: Silhouette, { r, y }: OutlinePoint): OnCurve {
    const pieces = 24;
    let best: OnCurve = { span: 0, share: 0, place: { r: 0, y: 0 }, away: Infinity };
    for (const segment of segmentsOf(silhouette))
        for (let i = 0; i <= pieces; ++i) {
            const place = placeOn(segment, i / pieces);
            const away = Math.hypot(place.r - r, place.y - y);
            if (away < best.away)
                best = {
                    span: segment.span,
                    share: i / pieces,
                    place: { r: place.r, y: place.y },
                    away,
                };
        }
    return best;
}

/** Returns the nearest place of polylines and of the ground that is within a distance, undefined if
 *  none is. All lengths are metres. */
export function snapped(
    place: OutlinePoint,
    lines: readonly (readonly OutlinePoint[])[],
    reach: number,
): OutlinePoint | undefined {
    let best = Math.abs(place.y) <= reach ? { r: place.r, y: 0 } : undefined;
    let least = best ? Math.abs(place.y) : reach;
    for (const line of lines)
        line.forEach((to, index) => {
            const from = line[index - 1];
            if (!from) return;
            const [dr, dy] = [to.r - from.r, to.y - from.y];
            const square = dr * dr + dy * dy;
            const along = (place.r - from.r) * dr + (place.y - from.y) * dy;
            const share = square > 0 ? Math.min(Math.max(along / square, 0), 1) : 0;
            const near = { r: from.r + share * dr, y: from.y + share * dy };
            const away = Math.hypot(near.r - place.r, near.y - place.y);
            if (away <= least) [best, least] = [near, away];
        });
    return best;
}

/** Returns the outline with a point more, on the curve at a share of the piece that begins at a
 *  control point. */
export function withInserted(silhouette: Silhouette, at: number, share = 0.5): Silhouette {
    const controls = controlsOf(silhouette);
    const next = controls[at + 1];
    const segment = segmentsOf(silhouette)[at];
    if (!next || !segment || controls.length >= mostControls) return silhouette;
    const { r, y } = placeOn(segment, Math.min(Math.max(share, leastShare), 1 - leastShare));
    controls.splice(at + 1, 0, { ...next, r, y });
    // Of the curve the new point is an inner one: only the last point of a curve is shared.
    const more = rebuilt(silhouette, controls);
    return more[next.curve].length > mostOfCurve ? silhouette : more;
}

/** Returns true for a point that can be removed: it is neither shared by two curves nor on the
 *  axis. */
export function isRemovable(silhouette: Silhouette, at: number): boolean {
    const control = controlsOf(silhouette)[at];
    return !!control && control.index > 0 && control.index < control.of - 1;
}

export function withRemoved(silhouette: Silhouette, at: number): Silhouette {
    if (!isRemovable(silhouette, at)) return silhouette;
    return rebuilt(
        silhouette,
        controlsOf(silhouette).filter((_, index) => index !== at),
    );
}

/** Where an outline is on the photograph: heights run along the traced axis, which goes straight on
 *  at both ends. */
export class AxisFrame {
    private readonly lengths: number[] = [0];
    /** Pixels of the photograph per metre. */
    readonly scale: number;

    /** `height` of the last point of the axis and `base` of its first, metres; `axis` in pixels, at
     *  least two points. */
    constructor(
        private readonly axis: readonly Point[],
        height: number,
        private readonly base = 0,
    ) {
        let total = 0;
        axis.forEach((point, index) => {
            const before = axis[index - 1];
            if (before) this.lengths.push((total += distance(before, point)));
        });
        this.scale = total / (height - base);
    }

    /** Returns a place of the outline in pixels, on the left (-1) or on the right (1). */
    toPhoto({ r, y }: OutlinePoint, on: -1 | 1): Point {
        const along = (y - this.base) * this.scale;
        let i = 0;
        while (i + 2 < this.axis.length && (this.lengths[i + 1] ?? 0) < along) ++i;
        const [from, [ux, uy]] = this.piece(i);
        const rest = along - (this.lengths[i] ?? 0);
        const out = on * r * this.scale;
        return [from[0] + ux * rest - uy * out, from[1] + uy * rest + ux * out];
    }

    /** Returns the distance from the axis and the height of a place on the photograph. */
    fromPhoto(point: Point): OutlinePoint {
        let best: OutlinePoint = { r: 0, y: 0 };
        let least = Infinity;
        for (let i = 0; i + 1 < this.axis.length; ++i) {
            const [from, [ux, uy]] = this.piece(i);
            const [dx, dy] = minus(point, from);
            const length = (this.lengths[i + 1] ?? 0) - (this.lengths[i] ?? 0);
            const low = i === 0 ? -Infinity : 0;
            const high = i + 2 === this.axis.length ? Infinity : length;
            const along = Math.min(Math.max(dx * ux + dy * uy, low), high);
            const away = Math.hypot(dx - along * ux, dy - along * uy);
            if (away >= least) continue;
            least = away;
            const y = this.base + ((this.lengths[i] ?? 0) + along) / this.scale;
            best = { r: away / this.scale, y };
        }
        return best;
    }

    /** Start and direction of a piece of the axis. */
    private piece(i: number): [Point, Vector] {
        const from = this.axis[i] ?? [0, 0];
        const to = this.axis[i + 1] ?? from;
        const length = distance(from, to) || 1;
        return [from, [(to[0] - from[0]) / length, (to[1] - from[1]) / length]];
    }
}
