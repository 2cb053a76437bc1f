// What the page shows of a world: place, time, view, layers and map, to and from the page's URL. Pure.
import type { ProblemItem } from "../http";

export const layers = ["ground", "trees", "floor", "fungi"] as const;
export type Layer = (typeof layers)[number];

export const layerLabels: Readonly<Record<Layer, string>> = {
    ground: "Ground",
    trees: "Trees",
    floor: "Dead wood, leaves, ferns, grass",
    fungi: "Fungi",
};

export const worldViews = ["plot", "walk", "fly"] as const;
export type WorldView = (typeof worldViews)[number];

export const lastDay = 365;

export interface WorldState {
    view: WorldView;
    /** Metres to the east and to the north of the centre of the world. */
    x: number;
    y: number;
    year: number;
    day: number;
    /** Length of the sides of the plot, metres. */
    size: number;
    hidden: ReadonlySet<Layer>;
    map: string;
    /** Whose spores the map shows; "" for the first. */
    species: string;
    /** Where the camera is, in numbers of its view; undefined for its first place. */
    look: readonly number[] | undefined;
    /** The place that the panel of reasons is about. */
    why: readonly [number, number] | undefined;
}

export const firstState: WorldState = {
    view: "plot",
    x: 114,
    y: 27,
    year: 80,
    day: 285,
    size: 10,
    hidden: new Set(),
    map: "height",
    species: "",
    look: undefined,
    why: undefined,
};

export const plotSizes = [10, 32] as const;

/** Rounds metres or degrees so that an address stays short. */
export function short(value: number, digits = 2): number {
    return Number(value.toFixed(digits)) + 0;
}

/** Returns a number as near to the wanted one as is allowed. */
export function within(value: number, least: number, most: number): number {
    return Math.min(Math.max(value, least), most);
}

/** Returns the place of a view that is inside a world. A plot is inside with all its sides. */
export function placeInside(x: number, y: number, extent: number, size: number): { x: number; y: number } {
    const most = (extent - size) / 2;
    return { x: short(within(x, -most, most)), y: short(within(y, -most, most)) };
}

function numbersOf(text: string, count?: number): number[] | undefined {
    const all = text.split(",").map((part) => (part.trim() === "" ? Number.NaN : Number(part)));
    return all.every(Number.isFinite) && (count === undefined || all.length === count) ? all : undefined;
}

/** Returns the page's query. The text of the world is that of a path. */
export function worldQuery(world: string, state: WorldState): string {
    const first = firstState;
    const parts = [`world=${world.replaceAll("+", "%2B")}`, `x=${state.x}`, `y=${state.y}`];
    parts.push(`year=${state.year}`, `day=${state.day}`);
    if (state.view !== first.view) parts.push(`view=${state.view}`);
    if (state.size !== first.size) parts.push(`size=${state.size}`);
    if (state.hidden.size > 0) parts.push(`hide=${layers.filter((layer) => state.hidden.has(layer)).join(",")}`);
    if (state.map !== first.map) parts.push(`map=${encodeURIComponent(state.map)}`);
    if (state.species !== first.species) parts.push(`species=${encodeURIComponent(state.species)}`);
    if (state.why) parts.push(`why=${state.why.join(",")}`);
    if (state.look) parts.push(`look=${state.look.map((value) => short(value)).join(",")}`);
    return `?${parts.join("&")}`;
}

/** Reads the page's query: the text of the world, without escapes, what is shown of it, and what could not be used. */
export function readWorldQuery(search: string): {
    world: string | undefined;
    state: WorldState;
    rejected: ProblemItem[];
} {
    const query = new URLSearchParams(search);
    const state: WorldState = { ...firstState };
    const rejected: ProblemItem[] = [];
    const reject = (parameter: string, detail: string): void => {
        rejected.push({ parameter, detail: `'${query.get(parameter)}' ${detail}` });
    };
    const number = (name: "x" | "y" | "year" | "day" | "size", least: number, most: number, whole: boolean): void => {
        const text = query.get(name);
        if (text === null) return;
        const value = numbersOf(text, 1)?.[0];
        if (value === undefined || value < least || value > most || (whole && !Number.isInteger(value)))
            return reject(name, `is no ${whole ? "whole " : ""}number from ${least} to ${most}`);
        state[name] = value;
    };
    number("x", -2048, 2048, false);
    number("y", -2048, 2048, false);
    number("year", 0, 200, true);
    number("day", 1, lastDay, true);
    number("size", ...plotSizes, false);
    const view = query.get("view");
    const known = worldViews.find((one) => one === view);
    if (known) state.view = known;
    else if (view !== null) reject("view", `is none of ${worldViews.join(", ")}`);
    const hide = query.get("hide")?.split(",").filter(Boolean) ?? [];
    state.hidden = new Set(layers.filter((layer) => hide.includes(layer)));
    if (state.hidden.size < new Set(hide).size) reject("hide", `names none of ${layers.join(", ")}`);
    state.map = query.get("map") ?? state.map;
    state.species = query.get("species") ?? state.species;
    const look = query.get("look");
    if (look !== null) state.look = numbersOf(look);
    if (look !== null && !state.look) reject("look", "is no list of numbers");
    const why = query.get("why");
    const place = why === null ? undefined : numbersOf(why, 2);
    if (place) state.why = [place[0] ?? 0, place[1] ?? 0];
    else if (why !== null) reject("why", "is no place");
    return { world: query.get("world") ?? undefined, state, rejected };
}

/** Returns the square of 64 m round a place that a season is counted in: the one of the grid of squares from the
 *  centre of the world, so that a small step needs no other. */
export function seasonBox(x: number, y: number, extent: number): [number, number, number, number] {
    const side = 64;
    const first = (value: number): number => within(Math.floor(value / side) * side, -extent / 2, extent / 2 - side);
    const [west, south] = [first(x), first(y)];
    return [west, south, west + side, south + side];
}
