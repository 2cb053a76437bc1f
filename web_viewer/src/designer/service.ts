// The service's part of the designer: photographs that it forgets after a while, and traces.
import { asRequestFailed, RequestFailed, send } from "../http";
import { asGrown, axisOf } from "./axis_line";
import { withDetails } from "./details";
import type { Silhouette } from "./outline";
import { capSides, orderOf, type CapSide, type Drawing, type Extent, type PhotoNames, type Point } from "./gesture";

export interface StoredPhoto extends Extent {
    photo: string;
    /** The picture is cut out already. */
    alpha: boolean;
}

export interface Nearest {
    id: string;
    name: string;
    age: number;
    shape_pct: number;
    colour: number;
}

export interface Stage {
    age: number;
    name: string;
    model: {
        silhouette?: Silhouette;
        axis?: unknown;
        deformation?: { bend_deg?: number; lean_deg?: number; irregularity?: number };
    };
}

export interface Species {
    id: string;
    facts?: { common_name?: string; scientific_name?: string };
    stages: Stage[];
}

export interface Trace {
    outline: { left: Point[]; right: Point[]; axis: Point[] };
    marks: { junctions: Point[]; margins: Point[] };
    /** What is measured on a photograph. */
    angles?: { lean_deg: number; bend_deg: number };
    asymmetry_pct?: number;
    error_pct?: number;
    ring: { height_m: number; width_m: number } | null;
    nearest: Nearest[];
    /** The species that lends all else; undefined for the file of a species. */
    template?: string;
    form?: string;
    method: string;
    /** Undefined until the service has tested the outline. */
    certificate?: { simple: boolean; method: string };
    warnings: { code: string; detail: string }[];
    /** Index of the traced stage of the species. */
    stage: number;
    species: Species;
}

/** Returns a photograph of the cap by its number. */
export type PhotographOf = (number: number) => Promise<Photograph>;

/** What is worked on: a photograph, or the file of a species. */
export interface Source {
    /** Undefined once it was forgotten. */
    readonly file: Blob | undefined;
    readonly stored: Extent & { alpha: boolean };
    /** Lines can be drawn on it. */
    readonly drawable: boolean;
    /** Its picture is gone, and what was made of it is here. */
    readonly isForgotten: boolean;
    /** Returns the picture that all pixels are counted in. */
    picture(signal: AbortSignal): Promise<Blob>;
    trace(drawing: Drawing, signal: AbortSignal, photographOf: PhotographOf): Promise<Trace>;
    /** Forgets what the service has of it. */
    forget(): void;
}

/** Traces that are at hand when undo comes back to them. */
const mostCached = 32;

/** One photograph: the file, what the service stored of it, and the traces made of it. */
export class Photograph implements Source {
    private traces = new Map<string, Trace>();
    private bytes = 0;

    private constructor(
        public file: Blob | undefined,
        private readonly report: (text: string) => void,
        public stored: StoredPhoto,
    ) {}

    /** Sends a file to the service; `report` is called with what happens later to its copy. */
    static async upload(
        file: Blob,
        signal: AbortSignal,
        report: (text: string) => void,
    ): Promise<Photograph> {
        try {
            return new Photograph(file, report, await store(file, signal));
        } catch (error) {
            if (!(error instanceof RequestFailed) || error.status !== 415) throw error;
            const choose = "choose a JPEG, PNG or WebP file, or the JSON of a species";
            throw new RequestFailed("This is no photograph", choose, 415);
        }
    }

    get drawable(): boolean {
        return !this.isForgotten;
    }

    get isForgotten(): boolean {
        return this.file === undefined;
    }

    /** Returns true if this is a forgotten photograph and the other one has its size in bytes and pixels. */
    isAgain(other: Photograph): boolean {
        const { width, height } = this.stored;
        const isAlike = other.stored.width === width && other.stored.height === height;
        return this.isForgotten && isAlike && other.file?.size === this.bytes;
    }

    /** Takes over the traces of the same photograph, before it was forgotten. */
    adopt({ traces }: Photograph): void {
        this.traces = traces;
    }

    /** Returns the stored copy, upright and at the size that all pixels are counted in; paper once it is forgotten. */
    async picture(signal: AbortSignal): Promise<Blob> {
        if (this.isForgotten) {
            const { width, height } = this.stored;
            const text = `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}"><path fill="#f7f1e3" d="M0 0H${width}V${height}H0Z"/></svg>`;
            return new Blob([text], { type: "image/svg+xml" });
        }
        const response = await whileStored({ side: this }, signal, () =>
            send(`v1/photos/${this.stored.photo}.jpg`, { signal }),
        );
        return response.blob();
    }

    async trace(drawing: Drawing, signal: AbortSignal, photographOf: PhotographOf): Promise<Trace> {
        const numbers = capSides.map((side) => [side, String(drawing.views?.[side]?.source)]);
        const key = JSON.stringify(orderOf(drawing, { side: "", ...Object.fromEntries(numbers) }));
        const known = this.traces.get(key);
        if (known) return known;
        if (this.isForgotten)
            throw new RequestFailed("The photograph is forgotten", "load it again to trace it anew", 0);
        const photographs = { side: this, ...(await photographsOfCap(drawing, photographOf)) };
        const response = await whileStored(photographs, signal, () =>
            send("v1/traces", {
                method: "POST",
                headers: { "Content-Type": "application/json" },
                body: JSON.stringify(orderOf(drawing, namesOf(photographs))),
                signal,
            }),
        );
        const trace = (await response.json()) as Trace;
        this.traces.set(key, trace);
        const oldest = this.traces.keys().next();
        if (this.traces.size > mostCached && !oldest.done) this.traces.delete(oldest.value);
        return trace;
    }

    /** Forgets the file, and asks the service to forget its copy; it would do so by itself in half an hour. */
    forget(): void {
        this.bytes = this.file?.size ?? this.bytes;
        this.file = undefined;
        send(`v1/photos/${this.stored.photo}.jpg`, { method: "DELETE", keepalive: true }).catch(
            () => undefined,
        );
    }

    /** Sends the file again after the service has forgotten its copy. */
    async sendAgain(signal: AbortSignal): Promise<void> {
        if (!this.file) return;
        this.stored = await store(this.file, signal);
        this.report("The service had forgotten the photograph; it was sent again.");
    }
}

type Photographs = { side: Photograph } & Partial<Record<CapSide, Photograph>>;

function namesOf({ side, above, below }: Photographs): PhotoNames {
    return {
        side: side.stored.photo,
        ...(above ? { above: above.stored.photo } : {}),
        ...(below ? { below: below.stored.photo } : {}),
    };
}

/** Returns the photographs of the cap that a drawing names.
 *
 *  throws  RequestFailed that names the one which cannot be had */
async function photographsOfCap(
    { views }: Drawing,
    photographOf: PhotographOf,
): Promise<Partial<Record<CapSide, Photograph>>> {
    const found: Partial<Record<CapSide, Photograph>> = {};
    for (const side of capSides) {
        const view = views?.[side];
        if (!view) continue;
        try {
            found[side] = await photographOf(view.source);
        } catch (error) {
            const { title, message, status } = asRequestFailed(error, "The photograph cannot be sent");
            throw new RequestFailed(title, "", status, [
                { parameter: `/views/${side}/photo`, detail: `${message}.` },
            ]);
        }
    }
    return found;
}

/** Returns the photographs that the service has forgotten, by the error that says so. */
function forgottenOf(error: unknown, photographs: Photographs): Photograph[] {
    if (!(error instanceof RequestFailed) || error.status !== 404) return [];
    const { items } = error;
    if (items.some(({ parameter }) => parameter === "/template")) return [];
    const isGone = (side: string): boolean =>
        items.some(({ parameter }) => parameter === `/views/${side}/photo`);
    const ofCap = capSides.filter(isGone).flatMap((side) => photographs[side] ?? []);
    return isGone("side") || ofCap.length === 0 ? [photographs.side, ...ofCap] : ofCap;
}

/** Does what needs stored copies; if the service has forgotten some, their files are sent again. */
async function whileStored<T>(
    photographs: Photographs,
    signal: AbortSignal,
    act: () => Promise<T>,
): Promise<T> {
    const sent = new Set<Photograph>();
    for (;;) {
        try {
            return await act();
        } catch (error) {
            const again = forgottenOf(error, photographs).filter((each) => each.file && !sent.has(each));
            if (again.length === 0) throw error;
            for (const photograph of again) {
                sent.add(photograph);
                await photograph.sendAgain(signal);
            }
        }
    }
}

export interface OutlineCheck {
    simple: boolean;
    method: string;
    problem: { curve: string; index: number; detail: string } | null;
}

/** Returns what the service says about an outline: it has the last word. */
export async function checkOutline(
    model: Stage["model"],
    signal: AbortSignal,
): Promise<OutlineCheck> {
    const { silhouette } = model;
    const axis = axisOf(asGrown(model));
    const response = await send("v1/outlines/check", {
        method: "POST",
        headers: { "Content-Type": "application/json" },
        body: JSON.stringify({ silhouette, axis }),
        signal,
    });
    return (await response.json()) as OutlineCheck;
}

/** Returns a trace whose species has all changes of a drawing. */
export function withEdits(trace: Trace, { shape, details }: Drawing): Trace {
    const shaped = withShape(trace, shape);
    return details ? { ...shaped, species: withDetails(shaped.species, details) } : shaped;
}

/** Returns a trace whose stages have these outlines. */
export function withShape(trace: Trace, shape: readonly Silhouette[] | undefined): Trace {
    if (!shape) return trace;
    const stages = trace.species.stages.map((stage, index) => {
        const silhouette = shape[index];
        return silhouette ? { ...stage, model: { ...stage.model, silhouette } } : stage;
    });
    return { ...trace, species: { ...trace.species, stages } };
}

/** Returns the outlines of all stages of a species; undefined if one of them has none. */
export function shapeOf({ stages }: Species): Silhouette[] | undefined {
    const shape = stages.flatMap(({ model }) => model.silhouette ?? []);
    return shape.length === stages.length ? shape : undefined;
}

async function store(file: Blob, signal: AbortSignal): Promise<StoredPhoto> {
    const response = await send("v1/photos", {
        method: "POST",
        // The service says which types it reads.
        headers: { "Content-Type": file.type || "application/octet-stream" },
        body: file,
        signal,
    });
    return (await response.json()) as StoredPhoto;
}

/** Returns the height above the ground and the diameter of the cap of an outline, metres. */
export function sizeOf({
    silhouette,
}: Stage["model"]): { height: number; cap: number } | undefined {
    if (!silhouette) return undefined;
    const places = [...silhouette.hymenium, ...silhouette.cap];
    const height = places.reduce((most, { y }) => Math.max(most, y), 0);
    const radius = places.reduce((most, { r }) => Math.max(most, r), 0);
    return { height, cap: 2 * radius };
}

/** Returns metres in millimetres, to a tenth below 20 mm. */
export function millimetres(metres: number): string {
    const value = metres * 1000;
    return `${value < 20 ? Number(value.toFixed(1)) : Math.round(value)} mm`;
}
