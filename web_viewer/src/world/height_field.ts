// Heights of the ground of a world on a grid, and where a ray meets it. Pure but for the requests.
import { getJson, send } from "../http";

/** A ray in the coordinates of the scene: x to the east, y up, z to the south. */
export interface Ray {
    origin: { x: number; y: number; z: number };
    direction: { x: number; y: number; z: number };
}

export class HeightField {
    /** `numbers` from north to south, each row from west to east; 0 is `from` and 65535 is `to`. */
    constructor(
        private readonly numbers: Uint16Array,
        private readonly width: number,
        private readonly from: number,
        private readonly to: number,
        /** Length of the sides of the world, metres. */
        readonly extent: number,
    ) {}

    /** Returns the height at a place, metres; beyond the edge that of the edge. */
    at(east: number, north: number): number {
        const { width, extent } = this;
        const last = width - 1;
        const clamp = (value: number): number => Math.min(Math.max(value, 0), last);
        const column = clamp((east / extent + 0.5) * last);
        const row = clamp((0.5 - north / extent) * last);
        const [c, r] = [Math.min(Math.floor(column), last - 1), Math.min(Math.floor(row), last - 1)];
        const [u, v] = [column - c, row - r];
        const value = (i: number, j: number): number => this.numbers[(r + j) * width + c + i] ?? 0;
        const upper = value(0, 0) * (1 - u) + value(1, 0) * u;
        const lower = value(0, 1) * (1 - u) + value(1, 1) * u;
        return this.from + ((upper * (1 - v) + lower * v) / 65535) * (this.to - this.from);
    }

    /** Returns the place where a ray comes down on the ground, undefined if it does not within `reach` metres. */
    hit({ origin, direction }: Ray, reach = 1500): { east: number; north: number; distance: number } | undefined {
        const above = (t: number): number =>
            origin.y + t * direction.y - this.at(origin.x + t * direction.x, -(origin.z + t * direction.z));
        let [before, t] = [0, 0];
        while (t < reach && above(t) > 0) {
            before = t;
            // A step is shorter near the ground; slopes are less than one in two.
            t += Math.max(0.1, above(t) * 0.4);
        }
        if (t >= reach || t === 0) return undefined;
        for (let step = 0; step < 24; ++step) {
            const middle = (before + t) / 2;
            if (above(middle) > 0) before = middle;
            else t = middle;
        }
        const [east, north] = [origin.x + t * direction.x, -(origin.z + t * direction.z)];
        const half = this.extent / 2;
        return Math.abs(east) <= half && Math.abs(north) <= half ? { east, north, distance: t } : undefined;
    }
}

/** Returns 16-bit numbers of a file, low byte first. */
export function numbersOfBytes(bytes: ArrayBuffer): Uint16Array {
    const view = new DataView(bytes);
    return Uint16Array.from({ length: bytes.byteLength / 2 }, (_, index) => view.getUint16(2 * index, true));
}

/** Fetches the heights of a world. */
export async function fetchHeights(world: string, extent: number, signal: AbortSignal): Promise<HeightField> {
    const address = (ending: string): string => `v1/worlds/${world}/y0/maps/height.${ending}?size=513`;
    const response = await send(address("r16"), { signal });
    const numbers = numbersOfBytes(await response.arrayBuffer());
    const { width, from, to } = await getJson<{ width: number; from: number; to: number }>(address("json"), signal);
    return new HeightField(numbers, width, from, to, extent);
}
