// A species from a file in place of a photograph: the outline of one of its stages on ruled paper.
import { RequestFailed } from "../http";
import type { Extent, Point } from "./gesture";
import { AxisFrame, controlsOf, polylineOf, type Silhouette } from "./outline";
import type { Source, Species, Trace } from "./service";

const side = 1000;
const margin = 60;

/** The age at which most stages are mature. */
const matureAge = 0.6;

/** Height that a coral has if its file states none, metres. */
const branchHeight = 0.08;

/** Metres, as the service takes them. */
function isWithin(value: unknown, least: number, most: number): boolean {
    return typeof value === "number" && value >= least && value <= most;
}

function isOutline(value: unknown): value is Silhouette {
    const parts = value as Partial<Silhouette> | undefined;
    const isCurve = (curve: unknown, fewest: number): boolean =>
        Array.isArray(curve) &&
        curve.length >= fewest &&
        curve.every((point: unknown) => {
            const { r, y } = (point ?? {}) as { r?: unknown; y?: unknown };
            return isWithin(r, 0, 1) && isWithin(y, -0.5, 2);
        });
    const isWhole =
        isCurve(parts?.stem, 2) && isCurve(parts?.hymenium ?? [], 0) && isCurve(parts?.cap, 2);
    return isWhole && !!parts?.cap?.some(({ y }) => y > 0);
}

/** Returns the species of a JSON text.
 *
 *  throws  RequestFailed that says what is wrong with it */
export function readSpecies(text: string): Species {
    const refuse = (detail: string): never => {
        throw new RequestFailed("This is no species that can be edited", detail, 0);
    };
    let species: Partial<Species> | null = null;
    try {
        species = JSON.parse(text) as Partial<Species> | null;
    } catch {
        refuse("The file is not JSON.");
    }
    const stages = species?.stages;
    if (!Array.isArray(stages) || stages.length === 0) return refuse("/stages has no stage.");
    stages.forEach((stage, index) => {
        const model = stage?.model as { form?: unknown; silhouette?: unknown } | undefined;
        // Corals and antlers are branches along axes: the rest of their document can be edited.
        const isBranched = model?.form === "branched" && model.silhouette === undefined;
        if (!isBranched && !isOutline(model?.silhouette))
            refuse(
                `/stages/${index}/model/silhouette has no stem and cap of points in metres; only the branched form has no outline.`,
            );
        if (!Number.isFinite(stage.age)) refuse(`/stages/${index}/age is no number.`);
    });
    for (const { model } of stages)
        // Clubs and puffballs need not state that they have no lower face.
        if (model.silhouette)
            model.silhouette = { ...model.silhouette, hymenium: model.silhouette.hymenium ?? [] };
    return { ...(species as Species), id: species?.id ?? "species" };
}

/** Returns the stage that is mature, as an index. */
export function stageOf({ stages }: Species): number {
    const off = stages.map(({ age }) => Math.abs(age - matureAge));
    return off.indexOf(Math.min(...off));
}

export class SpeciesFile implements Source {
    readonly drawable = false;
    readonly isForgotten = false;
    readonly stored: Extent & { alpha: boolean } = { width: side, height: side, alpha: true };
    private readonly silhouette: Silhouette | undefined;
    private readonly axis: [Point, Point];
    private readonly frame: AxisFrame;
    private opened: Trace | undefined;

    private constructor(
        readonly file: Blob,
        private readonly species: Species,
    ) {
        const model = species.stages[stageOf(species)]?.model as
            (Species["stages"][number]["model"] & { limbs?: { height?: number } }) | undefined;
        this.silhouette = model?.silhouette;
        const tall = model?.limbs?.height ?? branchHeight;
        const line = this.silhouette ? polylineOf(this.silhouette) : [{ r: tall / 3, y: tall }];
        const heights = line.map(({ y }) => y);
        const [low, high] = [Math.min(0, ...heights), Math.max(...heights)];
        const wide = 2 * Math.max(...line.map(({ r }) => r));
        const scale = (side - 2 * margin) / Math.max(high - low, wide);
        const ground = side / 2 + ((high + low) / 2) * scale;
        const apex = this.silhouette?.cap.at(-1)?.y ?? high;
        this.axis = [
            [side / 2, ground],
            [side / 2, ground - apex * scale],
        ];
        this.frame = new AxisFrame(this.axis, apex);
    }

    static async read(file: Blob): Promise<SpeciesFile> {
        return new SpeciesFile(file, readSpecies(await file.text()));
    }

    /** Paper with a line every centimetre, and a stronger one at the ground. */
    picture(): Promise<Blob> {
        const step = this.frame.scale / 100;
        const [x0, y0] = this.frame.toPhoto({ r: 0, y: 0 }, 1);
        const path: string[] = [];
        for (let x = x0 % step; x < side; x += step) path.push(`M${x} 0V${side}`);
        for (let y = y0 % step; y < side; y += step) path.push(`M0 ${y}H${side}`);
        const text =
            `<svg xmlns="http://www.w3.org/2000/svg" width="${side}" height="${side}">` +
            `<path fill="#f7f1e3" d="M0 0H${side}V${side}H0Z"/>` +
            `<path stroke="#d8ccb6" d="${path.join("")}"/>` +
            `<path stroke="#7a3b22" stroke-width="2" d="M0 ${y0}H${side}"/></svg>`;
        return Promise.resolve(new Blob([text], { type: "image/svg+xml" }));
    }

    trace(): Promise<Trace> {
        this.opened ??= this.read();
        return Promise.resolve(this.opened);
    }

    private read(): Trace {
        const { silhouette } = this;
        const line = silhouette ? polylineOf(silhouette) : [];
        const controls = silhouette ? controlsOf(silhouette) : [];
        const last = (curve: string): Point[] => {
            const end = controls.find((one) => one.curve === curve && one.index === one.of - 1);
            return end ? [this.frame.toPhoto(end, -1), this.frame.toPhoto(end, 1)] : [];
        };
        return {
            outline: {
                left: line.map((place) => this.frame.toPhoto(place, -1)),
                right: line.map((place) => this.frame.toPhoto(place, 1)),
                axis: this.axis,
            },
            marks: { junctions: last("stem"), margins: last("hymenium") },
            ring: null,
            nearest: [],
            method: "opened",
            warnings: [],
            stage: stageOf(this.species),
            species: this.species,
        };
    }

    forget(): void {
        // The service has nothing of it.
    }
}
