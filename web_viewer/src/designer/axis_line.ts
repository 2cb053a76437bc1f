// The axis of a model: the spline through its points as the service evaluates it, how far it bends,
// and where it is on the photograph. The page shows x and y; z is towards the viewer.
import type { Point } from "./gesture";
import { AxisFrame, type Silhouette } from "./outline";

/** A point of the axis from the root to the top of the stem, in heights of the stem. */
export interface AxisPoint {
    x: number;
    y: number;
    z: number;
}

export interface ModelShape {
    silhouette?: Silhouette;
    axis?: unknown;
    deformation?: { irregularity?: number };
}

type Vector = readonly [number, number, number];

/** The most points of an axis that the service takes. */
export const mostAxisPoints = 16;

/** The sharpest bend, as curvature times the radius of the stem: at 1 the stem folds. */
const sharpest = 0.8;

/** The service refuses a model that bends about as far as this. */
const folding = 0.9;

/** The sharpest bend of a species, and how much wider an irregular stem is: what bends farther is grown straighter,
 *  as core/individual/resolve.cpp does. */
const sharpestGrown = 0.6;
const widening = 1.3;

const bisections = 10;
const piecesPerSegment = 12;

/** Returns the axis of a model; nothing for one that is straight. */
export function axisOf({ axis }: ModelShape): AxisPoint[] {
    if (!Array.isArray(axis) || axis.length < 2) return [];
    return axis.map((point: Partial<AxisPoint>) => ({
        x: point.x ?? 0,
        y: point.y ?? 0,
        z: point.z ?? 0,
    }));
}

function minus(a: Vector, b: Vector): Vector {
    return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

function sizeOfVector(v: Vector): number {
    return Math.hypot(...v);
}

/** Returns an open centripetal Catmull-Rom spline as a polyline with tangents, as core/math/spline.cpp
 *  has it. */
function sampled(points: readonly AxisPoint[]): { place: Vector; tangent: Vector }[] {
    const places = points.map(({ x, y, z }): Vector => [x, y, z]);
    const at = (i: number): Vector => places[i] ?? [0, 0, 0];
    const stepOf = (a: Vector, b: Vector): number => Math.sqrt(sizeOfVector(minus(b, a)));
    const scaled = (v: Vector, by: number): Vector => [v[0] * by, v[1] * by, v[2] * by];
    const velocity = (i: number): Vector => {
        if (i === 0 || i === places.length - 1) {
            const from = i === 0 ? 0 : places.length - 2;
            const step = stepOf(at(from), at(from + 1));
            return step < 1e-9 ? [0, 0, 0] : scaled(minus(at(from + 1), at(from)), 1 / step);
        }
        const [a, b] = [stepOf(at(i - 1), at(i)), stepOf(at(i), at(i + 1))];
        if (a < 1e-9 || b < 1e-9)
            return b < 1e-9 ? [0, 0, 0] : scaled(minus(at(i + 1), at(i)), 1 / b);
        const [back, over, on] = [
            minus(at(i), at(i - 1)),
            minus(at(i + 1), at(i - 1)),
            minus(at(i + 1), at(i)),
        ];
        const part = (k: 0 | 1 | 2): number => back[k] / a - over[k] / (a + b) + on[k] / b;
        return [part(0), part(1), part(2)];
    };
    const samples: { place: Vector; tangent: Vector }[] = [];
    for (let i = 0; i + 1 < places.length; ++i) {
        const step = stepOf(at(i), at(i + 1));
        const [leaving, arriving] = [scaled(velocity(i), step), scaled(velocity(i + 1), step)];
        for (let piece = i === 0 ? 0 : 1; piece <= piecesPerSegment; ++piece) {
            const t = piece / piecesPerSegment;
            const value = (k: 0 | 1 | 2): [number, number] => {
                const [from, to, m0, m1] = [at(i)[k], at(i + 1)[k], leaving[k], arriving[k]];
                const c = 3 * (to - from) - 2 * m0 - m1;
                const d = 2 * (from - to) + m0 + m1;
                return [from + t * (m0 + t * (c + t * d)), m0 + t * (2 * c + 3 * t * d)];
            };
            const [x, y, z] = [value(0), value(1), value(2)];
            samples.push({ place: [x[0], y[0], z[0]], tangent: [x[1], y[1], z[1]] });
        }
    }
    return samples;
}

function lengthOf(samples: readonly { place: Vector }[]): number {
    return samples.reduce((sum, { place }, index) => {
        const before = samples[index - 1];
        return before ? sum + sizeOfVector(minus(place, before.place)) : sum;
    }, 0);
}

function angleBetween(a: Vector, b: Vector): number {
    const sizes = sizeOfVector(a) * sizeOfVector(b);
    if (sizes < 1e-18) return 0;
    const cosine = (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / sizes;
    return (Math.acos(Math.min(Math.max(cosine, -1), 1)) * 180) / Math.PI;
}

/** Returns how far an axis bends between its ends, and how far the root leans from the vertical,
 *  degrees. */
export function anglesOf(points: readonly AxisPoint[]): { bend_deg: number; lean_deg: number } {
    const samples = sampled(points);
    const [first, last] = [samples[0], samples.at(-1)];
    if (!first || !last) return { bend_deg: 0, lean_deg: 0 };
    return {
        bend_deg: angleBetween(first.tangent, last.tangent),
        lean_deg: angleBetween(first.tangent, [0, 1, 0]),
    };
}

interface StemSize {
    radius: number;
    base: number;
    top: number;
}

/** Returns the widest radius of the stem and the heights of its ends, metres. */
export function stemOf({ stem, cap }: Silhouette): StemSize {
    const base = stem[0]?.y ?? 0;
    return {
        radius: stem.reduce((most, { r }) => Math.max(most, r), 0),
        base,
        top: Math.max(
            stem.at(-1)?.y ?? 0,
            base + 1e-4,
            stem.length === 0 ? (cap.at(-1)?.y ?? 0) : 0,
        ),
    };
}

/** Returns the sharpest bend of an axis as its curvature times the radius of the stem. */
export function foldOf(points: readonly AxisPoint[], silhouette: Silhouette): number {
    const samples = sampled(points);
    const total = lengthOf(samples) || 1;
    const { radius, base, top } = stemOf(silhouette);
    let most = 0;
    samples.forEach(({ place, tangent }, index) => {
        const before = samples[index - 1];
        const step = before && sizeOfVector(minus(place, before.place));
        if (!before || !step) return;
        const turn = (angleBetween(before.tangent, tangent) * Math.PI) / 180;
        most = Math.max(most, (turn / step) * total);
    });
    return (most * radius) / (top - base);
}

/** Returns true if a stem would fold on the axis of its model. */
export function isFolded(model: ModelShape): boolean {
    const { silhouette } = model;
    return !!silhouette && foldOf(axisOf(model), silhouette) > folding;
}

/** Returns a model as a species of the service grows it: an axis on which the stem would fold is straighter. Alone
 *  the service refuses such a model. */
export function asGrown<T extends ModelShape>(model: T): T {
    const { silhouette } = model;
    if (!silhouette || !isFolded(model)) return model;
    const axis = axisOf(model);
    const most = sharpestGrown / (1 + widening * (model.deformation?.irregularity ?? 0));
    const part = (share: number): AxisPoint[] =>
        axis.map(({ x, y, z }) => ({ x: share * x, y, z: share * z }));
    let [low, high] = [0, 1];
    for (let step = 0; step < bisections; ++step) {
        const share = (low + high) / 2;
        if (foldOf(part(share), silhouette) > most) high = share;
        else low = share;
    }
    return { ...model, axis: part(low) };
}

/** Moves a point of an axis as far towards a place as the stem does not fold; the root stays. */
export function bent(
    points: readonly AxisPoint[],
    at: number,
    to: { x: number; y: number },
    silhouette: Silhouette,
): { axis: AxisPoint[]; stopped: boolean } {
    const from = points[at];
    if (!from || at === 0) return { axis: [...points], stopped: false };
    const within = (value: number): number => Math.min(Math.max(value, -2), 2);
    const part = (share: number): AxisPoint[] =>
        points.map((point, index) =>
            index === at
                ? {
                      ...point,
                      x: within(from.x + share * (to.x - from.x)),
                      y: within(from.y + share * (to.y - from.y)),
                  }
                : point,
        );
    const whole = part(1);
    const allowed = Math.max(sharpest, foldOf(points, silhouette) + 1e-9);
    if (foldOf(whole, silhouette) <= allowed) return { axis: whole, stopped: false };
    let [low, high] = [0, 1];
    for (let step = 0; step < bisections; ++step) {
        const share = (low + high) / 2;
        if (foldOf(part(share), silhouette) > allowed) high = share;
        else low = share;
    }
    return { axis: part(low), stopped: true };
}

/** Returns a straight axis of a few points. */
export function uprightAxis(count = 4): AxisPoint[] {
    return Array.from({ length: count }, (_, k) => ({ x: 0, y: k / (count - 1), z: 0 }));
}

/** Returns an axis of the same shape with another number of points at equal distances. */
export function resampled(points: readonly AxisPoint[], count: number): AxisPoint[] {
    const samples = sampled(points);
    const total = lengthOf(samples);
    const first = samples[0];
    if (!first || total === 0) return [...points];
    const found: AxisPoint[] = [];
    let arc = 0;
    let next = 0;
    samples.forEach(({ place }, index) => {
        const before = samples[index - 1]?.place ?? place;
        const step = sizeOfVector(minus(place, before));
        while (next < count && arc + step >= (total * next) / (count - 1) - 1e-12) {
            const share = step > 0 ? ((total * next) / (count - 1) - arc) / step : 0;
            const part = (k: 0 | 1 | 2): number => before[k] + share * (place[k] - before[k]);
            found.push({ x: part(0), y: part(1), z: part(2) });
            ++next;
        }
        arc += step;
    });
    while (found.length < count) {
        const [x, y, z] = samples.at(-1)?.place ?? first.place;
        found.push({ x, y, z });
    }
    return found;
}

/** Returns an axis with a point more, in the middle of the piece behind a point. */
export function withAxisPoint(points: readonly AxisPoint[], at: number): AxisPoint[] {
    const middle = sampled(points)[at * piecesPerSegment + piecesPerSegment / 2];
    if (!middle || at + 1 >= points.length || points.length >= mostAxisPoints) return [...points];
    const [x, y, z] = middle.place;
    return [...points.slice(0, at + 1), { x, y, z }, ...points.slice(at + 1)];
}

/** Returns an axis without an inner point. */
export function withoutAxisPoint(points: readonly AxisPoint[], at: number): AxisPoint[] {
    if (at <= 0 || at >= points.length - 1) return [...points];
    return points.filter((_, index) => index !== at);
}

/** Where the axis of a model is on the photograph. */
export interface PlacedAxis {
    frame: AxisFrame;
    /** Returns the place of a point of the axis, pixels. */
    toPhoto: (point: { x: number; y: number }) => Point;
    fromPhoto: (place: Point) => { x: number; y: number };
}

/** Returns where a model stands on the photograph: its root is where the traced axis has that
 *  height, and its size is that of the photograph. A model without an axis of its own follows the
 *  traced one. */
export function placed(model: ModelShape, traced: AxisFrame): PlacedAxis | undefined {
    const { silhouette } = model;
    if (!silhouette) return undefined;
    const { base, top } = stemOf(silhouette);
    const points = axisOf(model);
    const samples = sampled(points.length > 0 ? points : uprightAxis());
    const arc = lengthOf(samples) || 1;
    const unit = ((top - base) / arc) * traced.scale;
    const [rootX, rootY] = traced.toPhoto({ r: 0, y: base }, 1);
    const [x0, y0] = samples[0]?.place ?? [0, 0, 0];
    const toPhoto = ({ x, y }: { x: number; y: number }): Point => [
        rootX + (x - x0) * unit,
        rootY - (y - y0) * unit,
    ];
    const fromPhoto = ([x, y]: Point): { x: number; y: number } => ({
        x: x0 + (x - rootX) / unit,
        y: y0 - (y - rootY) / unit,
    });
    if (points.length === 0) return { frame: traced, toPhoto, fromPhoto };
    const line = samples.map(({ place: [x, y] }) => toPhoto({ x, y }));
    const pixels = line.reduce((sum, point, index) => {
        const before = line[index - 1];
        return before ? sum + Math.hypot(point[0] - before[0], point[1] - before[1]) : sum;
    }, 0);
    return { frame: new AxisFrame(line, base + pixels / traced.scale, base), toPhoto, fromPhoto };
}
