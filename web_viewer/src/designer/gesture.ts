// What a person draws on a photograph: lines in its pixels, as the service reads them. All values
// are immutable, so that undo restores whole gestures.

import type { Details } from "./details";
import type { Silhouette } from "./outline";

/** A place in pixels of the stored photograph, from its upper left corner. */
export type Point = readonly [number, number];
export type Stroke = readonly Point[];

export const tools = ["axis", "cap", "keep", "drop", "frame"] as const;
export type Tool = (typeof tools)[number];

/** Where the arrow keys lead in pixels of a photograph, whose y goes down. */
export const arrowSteps: Readonly<Record<string, Point>> = {
    ArrowLeft: [-1, 0],
    ArrowRight: [1, 0],
    ArrowUp: [0, -1],
    ArrowDown: [0, 1],
};

export interface Gesture {
    /** From the foot to the top. */
    axis: Stroke;
    cap: Stroke;
    keep: readonly Stroke[];
    drop: readonly Stroke[];
    /** Two opposite corners, or nothing. */
    frame: Stroke;
}

/** The cap is photographed from these sides besides that of the whole mushroom. */
export const capSides = ["above", "below"] as const;
export type CapSide = (typeof capSides)[number];

/** What is drawn on a photograph of the cap: `axis` is a line across it, `cap` a second one. */
export interface CapSketch {
    gesture: Gesture;
    /** The highest point of the cap, from below where the stem is fixed; undefined for the middle. */
    centre?: Point | undefined;
    /** Where the stem ends on a photograph from below. */
    stemEnd?: Point | undefined;
}

export interface CapView extends CapSketch {
    /** Number of its photograph. */
    source: number;
}

export type CapViews = Readonly<Partial<Record<CapSide, CapView>>>;

/** Everything that a trace depends on; one step of undo. */
export interface Drawing {
    /** Number of the photograph or species that was opened; undefined before the first and after it was forgotten. */
    source?: number | undefined;
    gesture: Gesture;
    /** Photographs of the cap. */
    views?: CapViews | undefined;
    /** A species, or "auto" for the one that is most alike. */
    template: string;
    /** What is looked for, or "auto" for what fits. */
    form: string;
    /** Cap and stem are painted with images from the photograph. */
    images: boolean;
    /** Undefined for the height of the template. */
    heightMm: number | undefined;
    /** The outlines of all stages once a point was moved; undefined as traced. */
    shape?: readonly Silhouette[] | undefined;
    /** Other changes of the species' document. */
    details?: Details | undefined;
}

export interface Extent {
    width: number;
    height: number;
}

export const mostPoints = 64;
export const mostStrokes = 16;

export const nothingDrawn: Gesture = { axis: [], cap: [], keep: [], drop: [], frame: [] };
export const startOfDrawing: Drawing = {
    gesture: nothingDrawn,
    template: "auto",
    form: "auto",
    images: true,
    heightMm: undefined,
};

/** Returns the nearest whole pixel inside a picture. */
export function inside([x, y]: Point, { width, height }: Extent): Point {
    const within = (value: number, most: number): number =>
        Math.min(Math.max(Math.round(value), 0), most - 1);
    return [within(x, width), within(y, height)];
}

export function distance([ax, ay]: Point, [bx, by]: Point): number {
    return Math.hypot(ax - bx, ay - by);
}

function distanceToSegment(point: Point, from: Point, to: Point): number {
    const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    const square = dx * dx + dy * dy;
    const along = (point[0] - from[0]) * dx + (point[1] - from[1]) * dy;
    const share = square > 0 ? Math.min(Math.max(along / square, 0), 1) : 0;
    return distance(point, [from[0] + share * dx, from[1] + share * dy]);
}

/** Returns the points of a stroke that are needed to stay within a distance of it [Douglas and
 *  Peucker 1973]. */
function thinned(stroke: Stroke, tolerance: number): Stroke {
    const [from, to] = [stroke[0], stroke.at(-1)];
    if (!from || !to || stroke.length <= 2) return stroke;
    let farthest = 0;
    let most = tolerance;
    stroke.slice(1, -1).forEach((point, index) => {
        const off = distanceToSegment(point, from, to);
        if (off > most) [farthest, most] = [index + 1, off];
    });
    if (farthest === 0) return [from, to];
    const before = thinned(stroke.slice(0, farthest + 1), tolerance);
    return [...before.slice(0, -1), ...thinned(stroke.slice(farthest), tolerance)];
}

/** Returns a stroke with the fewest points within a tolerance in pixels, and never more of them
 *  than the service reads. */
export function simplified(stroke: Stroke, tolerance: number): Stroke {
    let allowed = tolerance;
    let fewer = thinned(stroke, allowed);
    while (fewer.length > mostPoints) fewer = thinned(stroke, (allowed *= 1.5));
    return fewer;
}

/** Returns the strokes that one tool has drawn. */
export function strokesOf(gesture: Gesture, tool: Tool): readonly Stroke[] {
    if (tool === "keep" || tool === "drop") return gesture[tool];
    return gesture[tool].length > 0 ? [gesture[tool]] : [];
}

/** Returns a gesture in which one tool has drawn these strokes. */
export function withStrokes(gesture: Gesture, tool: Tool, strokes: readonly Stroke[]): Gesture {
    const drawn = strokes.filter((stroke) => stroke.length > 0);
    if (tool === "keep" || tool === "drop") return { ...gesture, [tool]: drawn };
    return { ...gesture, [tool]: drawn[0] ?? [] };
}

/** Returns a gesture with one stroke more; the lines of the mushroom and the frame are replaced. */
export function withStroke(gesture: Gesture, tool: Tool, stroke: Stroke): Gesture {
    const stays = tool === "keep" || tool === "drop" ? gesture[tool] : [];
    return withStrokes(gesture, tool, [...stays, stroke]);
}

/** Returns a gesture in which one point is elsewhere. */
export function withPoint(
    gesture: Gesture,
    tool: Tool,
    [stroke, point]: readonly [number, number],
    place: Point,
): Gesture {
    const strokes = strokesOf(gesture, tool).map((line, index) =>
        index === stroke ? line.map((old, at) => (at === point ? place : old)) : line,
    );
    return withStrokes(gesture, tool, strokes);
}

export function strokeCount(gesture: Gesture): number {
    const lines: readonly Tool[] = ["axis", "cap", "keep", "drop"];
    return lines.reduce((sum, tool) => sum + strokesOf(gesture, tool).length, 0);
}

/** Returns a rectangle as x, y, width and height. */
export function rectangle(corners: Stroke): [number, number, number, number] | undefined {
    const [a, b] = corners;
    if (!a || !b) return undefined;
    const [left, top] = [Math.min(a[0], b[0]), Math.min(a[1], b[1])];
    return [left, top, Math.abs(a[0] - b[0]), Math.abs(a[1] - b[1])];
}

/** Returns the line that has to be drawn before the service can trace, undefined if none is
 *  missing. A picture that is cut out needs none. */
export function missingLine(gesture: Gesture, cutOut: boolean): "axis" | "cap" | undefined {
    if (cutOut && strokeCount(gesture) === 0) return undefined;
    if (gesture.axis.length < 2) return cutOut ? undefined : "axis";
    return gesture.cap.length < 2 && !cutOut ? "cap" : undefined;
}

/** Returns true if a photograph of the cap has what the service needs: a line across the cap, or a picture
 *  that is cut out. */
export function isComplete({ gesture }: CapSketch, cutOut: boolean): boolean {
    return gesture.axis.length >= 2 || (cutOut && strokeCount(gesture) === 0);
}

/** Returns the numbers of all photographs or species that a drawing names. */
export function sourcesOf({ source, views }: Drawing): number[] {
    const ofCap = capSides.flatMap((side) => views?.[side]?.source ?? []);
    return source === undefined ? ofCap : [source, ...ofCap];
}

/** Names that the service gave to photographs. */
export type PhotoNames = Readonly<{ side: string } & Partial<Record<CapSide, string>>>;

interface ViewOrder {
    photo: string;
    gesture?: Record<string, unknown>;
    centre?: Point;
    stem_end?: Point;
}

/** The body of a trace. */
export interface TraceOrder {
    views: { side: ViewOrder } & Partial<Record<CapSide, ViewOrder>>;
    template: string;
    form: string;
    images: boolean;
    height_m?: number;
}

function viewOrder(photo: string, { gesture, centre, stemEnd }: CapSketch): ViewOrder {
    const { axis, cap, keep, drop } = gesture;
    const frame = rectangle(gesture.frame) ?? [];
    const drawn = Object.entries({ axis, cap, keep, drop, frame }).filter(
        ([, lines]) => lines.length > 0,
    );
    return {
        photo,
        ...(drawn.length > 0 ? { gesture: Object.fromEntries(drawn) } : {}),
        ...(centre ? { centre } : {}),
        ...(stemEnd ? { stem_end: stemEnd } : {}),
    };
}

/** Returns a drawing as the service reads it: what was not drawn is left out, and so is a photograph without a name. */
export function orderOf(
    { gesture, views, template, form, images, heightMm }: Drawing,
    photos: PhotoNames,
): TraceOrder {
    const ofCap = capSides.flatMap((side) => {
        const [photo, view] = [photos[side], views?.[side]];
        return photo !== undefined && view ? [[side, viewOrder(photo, view)] as const] : [];
    });
    return {
        views: { side: viewOrder(photos.side, { gesture }), ...Object.fromEntries(ofCap) },
        template,
        form,
        images,
        ...(heightMm === undefined ? {} : { height_m: heightMm / 1000 }),
    };
}

export type PlaceOnPage = Tool | CapSide | "photo" | "height" | "template" | "form" | "outline";

/** Returns what on the page a JSON pointer of the service is about, undefined if it is nothing that
 *  can be seen there. */
export function placeOf(pointer: string): PlaceOnPage | undefined {
    const tool = /^\/views\/side\/gesture\/([a-z]+)/.exec(pointer)?.[1];
    const found = tools.find((name) => name === tool);
    if (found) return found;
    const ofCap = /^\/views\/([a-z]+)/.exec(pointer)?.[1];
    const side = capSides.find((name) => name === ofCap);
    if (side) return side;
    if (pointer.startsWith("/views")) return "photo";
    if (pointer.startsWith("/height_m")) return "height";
    if (pointer.startsWith("/form")) return "form";
    if (pointer.startsWith("/template")) return "template";
    return /^(\/model)?\/silhouette/.test(pointer) ? "outline" : undefined;
}
