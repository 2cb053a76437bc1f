// The colours of a species' document: which there are, by its schema, and how they change.
import { modelPointer, type Details, type Json } from "./details";
import type { DocumentSchema } from "./schemas";
import { words } from "../schema";

/** A colour of a part: a member of the model, as "surface/stem/top". */
export interface Paint {
    member: string;
    label: string;
    description: string;
    fallback: string;
}

export interface PaintedPart {
    /** Member of the model, as "surface/cap". */
    member: string;
    label: string;
    description: string;
    /** A row of colours from one end to the other, if the part has one. */
    ramp: (Paint & { most: number; stops: readonly string[] }) | undefined;
    colours: Paint[];
    /** A photograph's image can cover the colours. */
    hasImage: boolean;
}

/** A ramp has at least so many colours, so that it is one. */
export const fewestStops = 2;

const partNames: Readonly<Record<string, string>> = { hymenium: "Lower face" };

function isColour(schema: DocumentSchema | undefined): boolean {
    return schema?.format === "color";
}

/** Returns the parts of a model that have colours, by the schema of the model. */
export function paintedParts(model: DocumentSchema): PaintedPart[] {
    const surface = model.properties?.["surface"]?.properties ?? {};
    const parts = Object.entries(surface).map(([name, part]) =>
        partOf(`surface/${name}`, partNames[name] ?? words(name), part),
    );
    const material = model.properties?.["material"];
    if (material) parts.push(partOf("material", "Light", material));
    return parts.filter(({ ramp, colours }) => ramp || colours.length > 0);
}

function partOf(member: string, label: string, schema: DocumentSchema): PaintedPart {
    const part: PaintedPart = {
        member,
        label,
        description: schema.description ?? "",
        ramp: undefined,
        colours: [],
        hasImage: schema.properties?.["image"] !== undefined,
    };
    for (const [name, sub] of Object.entries(schema.properties ?? {})) {
        const fallback = sub["x-default"];
        const paint = {
            member: `${member}/${name}`,
            label: words(name),
            description: sub.description ?? "",
            fallback: typeof fallback === "string" ? fallback : "#000000",
        };
        if (isColour(sub)) part.colours.push(paint);
        if (!sub.items || !isColour(sub.items)) continue;
        const stops = Array.isArray(fallback) ? fallback.map(String) : [];
        part.ramp = { ...paint, most: sub.maxItems ?? stops.length, stops };
    }
    return part;
}

type Channels = readonly [number, number, number];

function channelsOf(colour: string): Channels {
    const value = Number.parseInt(colour.slice(1), 16);
    return [value >> 16, (value >> 8) & 255, value & 255];
}

/** Returns channels from 0 to 255 as "#RRGGBB". */
export function colourOf(channels: readonly number[]): string {
    const text = channels
        .slice(0, 3)
        .map((value) =>
            Math.min(Math.max(Math.round(value), 0), 255)
                .toString(16)
                .padStart(2, "0"),
        )
        .join("");
    return `#${text.toUpperCase()}`;
}

/** Returns a text as "#RRGGBB", undefined if it is no colour. */
export function readColour(text: string): string | undefined {
    const digits = /^\s*#?([0-9a-f]{6})\s*$/i.exec(text)?.[1];
    return digits && `#${digits.toUpperCase()}`;
}

/** Returns the mean colour of pixels with four channels each, without those that are transparent;
 *  undefined if all are. */
export function meanColour(pixels: ArrayLike<number>): string | undefined {
    const sum = [0, 0, 0];
    let count = 0;
    for (let i = 0; i + 3 < pixels.length; i += 4) {
        if ((pixels[i + 3] ?? 0) < 128) continue;
        ++count;
        for (let k = 0; k < 3; ++k) sum[k]! += pixels[i + k] ?? 0;
    }
    return count > 0 ? colourOf(sum.map((value) => value / count)) : undefined;
}

/** Returns a ramp with a colour more, between a stop and the next one; at the end it is the last
 *  one again. */
export function withStop(ramp: readonly string[], at: number): string[] {
    const [a, b] = [ramp[at] ?? "#000000", ramp[at + 1] ?? ramp[at] ?? "#000000"];
    const [from, to] = [channelsOf(a), channelsOf(b)];
    const middle = colourOf(from.map((value, k) => (value + (to[k] ?? 0)) / 2));
    return [...ramp.slice(0, at + 1), middle, ...ramp.slice(at + 1)];
}

export function withoutStop(ramp: readonly string[], at: number): string[] {
    return ramp.length > fewestStops ? ramp.filter((_, index) => index !== at) : [...ramp];
}

function memberOf(model: unknown, member: string): unknown {
    return member
        .split("/")
        .reduce<unknown>(
            (node, name) => (node as Record<string, unknown> | undefined)?.[name],
            model,
        );
}

/** Returns the colours of a ramp of a model. */
export function rampOf(model: unknown, { ramp }: PaintedPart): string[] {
    const own = ramp && memberOf(model, ramp.member);
    return Array.isArray(own) && own.length > 0 ? own.map(String) : [...(ramp?.stops ?? [])];
}

/** Returns a colour of a model. */
export function paintOf(model: unknown, { member, fallback }: Paint): string {
    const own = memberOf(model, member);
    return typeof own === "string" ? own : fallback;
}

/** Returns true if a photograph's image covers a part of a model. */
export function hasImage(model: unknown, { member }: PaintedPart): boolean {
    return typeof memberOf(model, `${member}/image`) === "string";
}

/** Returns what changes if a member gets a value in some stages. An image that covers the part goes,
 *  so that the colour is seen. */
export function painted(
    models: readonly unknown[],
    part: PaintedPart,
    member: string,
    valueOf: (model: unknown, stage: number) => Json | undefined,
): Details {
    const changes: Record<string, Json | undefined> = {};
    models.forEach((model, stage) => {
        const value = valueOf(model, stage);
        if (value === undefined) return;
        changes[modelPointer(stage, member)] = value;
        if (hasImage(model, part)) changes[modelPointer(stage, `${part.member}/image`)] = undefined;
    });
    return changes;
}
