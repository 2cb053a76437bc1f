// Colours of maps, and what is in pixels and what in metres. Pure.

type Colour = readonly [number, number, number];

const grey: readonly Colour[] = [[40, 34, 28], [246, 240, 226]];

/** Colours from the least to the greatest number, at equal distances. */
const ramps: Readonly<Record<string, readonly Colour[]>> = {
    height: [[74, 92, 62], [122, 134, 84], [190, 172, 118], [214, 196, 164], [246, 240, 228]],
    slope: [[250, 245, 233], [206, 182, 140], [140, 92, 60], [64, 36, 26]],
    aspect: [[88, 104, 140], [196, 178, 120], [178, 92, 60], [110, 128, 84], [88, 104, 140]],
    twi: [[244, 236, 214], [164, 186, 170], [70, 122, 148], [26, 56, 96]],
    wetness: [[236, 216, 172], [170, 178, 138], [80, 132, 150], [26, 60, 104]],
    streams: [[244, 236, 218], [58, 110, 150]],
    sky: [[58, 60, 70], [150, 160, 168], [250, 246, 232]],
    light: [[32, 38, 30], [96, 108, 60], [206, 184, 96], [255, 246, 206]],
    canopy: [[246, 239, 222], [160, 176, 112], [84, 108, 58], [36, 54, 34]],
    spores: [[246, 239, 222], [222, 170, 120], [166, 84, 52], [84, 30, 30]],
};

/** Returns the colours of a map; grey for one that has none of its own. */
export function rampOf(map: string): readonly Colour[] {
    return ramps[map] ?? grey;
}

/** Returns a colour of a ramp, 0 at its beginning and 1 at its end. */
export function colourAt(ramp: readonly Colour[], share: number): Colour {
    const at = Math.min(Math.max(share, 0), 1) * (ramp.length - 1);
    const index = Math.min(Math.floor(at), ramp.length - 2);
    const [a, b] = [ramp[index] ?? [0, 0, 0], ramp[index + 1] ?? [0, 0, 0]];
    const mixed = (channel: 0 | 1 | 2): number => Math.round(a[channel] + (b[channel] - a[channel]) * (at - index));
    return [mixed(0), mixed(1), mixed(2)];
}

/** Returns a ramp as a background of a style sheet. */
export function rampStyle(map: string): string {
    return `linear-gradient(90deg, ${rampOf(map).map(([r, g, b]) => `rgb(${r} ${g} ${b})`).join(", ")})`;
}

/** Returns the least and the greatest number of a map that is coloured: single numbers far away from all others are
 *  left out, and a map of one number has a range as well. */
export function rangeOf(numbers: Uint16Array): [number, number] {
    const sorted = Uint16Array.from(numbers).sort();
    const last = sorted.length - 1;
    const low = sorted[Math.floor(last * 0.002)] ?? 0;
    const high = sorted[Math.ceil(last * 0.998)] ?? 65535;
    return high - low < 64 ? [sorted[0] ?? 0, Math.max(sorted[last] ?? 65535, (sorted[0] ?? 0) + 64)] : [low, high];
}

/** Writes the pixels of a map, red, green, blue and opacity each. */
export function paint(numbers: Uint16Array, [low, high]: readonly [number, number], map: string, out: Uint8ClampedArray): void {
    const ramp = rampOf(map);
    const table = Array.from({ length: 256 }, (_, index) => colourAt(ramp, index / 255));
    numbers.forEach((value, index) => {
        const share = Math.min(Math.max((value - low) / (high - low), 0), 1);
        const [r, g, b] = table[Math.round(share * 255)] ?? [0, 0, 0];
        out.set([r, g, b, 255], 4 * index);
    });
}

/** Returns the place in the world at a share of the width and of the height of its map. */
export function placeOnMap(right: number, down: number, extent: number): { x: number; y: number } {
    return { x: (right - 0.5) * extent, y: (0.5 - down) * extent };
}

/** Returns the share of the width and of the height of its map at a place in the world. */
export function shareOfMap(x: number, y: number, extent: number): { right: number; down: number } {
    return { right: x / extent + 0.5, down: 0.5 - y / extent };
}
