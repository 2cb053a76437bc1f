// At which sizes and distances each level of detail is drawn.

/** One level of detail, as the server describes it. */
export interface LevelReport {
    lod: number;
    triangles: number;
    /** Longest side of the bounding box over the height of the screen down to which it is drawn. */
    screen_coverage: number;
}

export interface LevelRange extends LevelReport {
    /** Longest side on the screen down to which it is drawn, pixels. */
    pixels: number;
    /** Distances between which it is drawn, metres. */
    near: number;
    far: number;
}

/** Returns the distance at which something covers a part of the height of the screen, metres.
 *
 *  @param size longest side of its bounding box, metres
 *  @param fov vertical field of view, degrees */
export function distanceOf(size: number, coverage: number, fov: number): number {
    return size / (2 * coverage * Math.tan((fov * Math.PI) / 360));
}

/** Returns the ranges of levels, finest first; each begins where the one before ends. */
export function rangesOf(
    levels: readonly LevelReport[],
    size: number,
    fov: number,
    screen: number,
): LevelRange[] {
    let near = 0;
    return levels.map((level) => {
        const far = distanceOf(size, level.screen_coverage, fov);
        const range = { ...level, pixels: level.screen_coverage * screen, near, far };
        near = far;
        return range;
    });
}

/** Returns a distance or size as text with two digits: "18 cm", "4.2 m", "1.3 km". */
export function metres(length: number): string {
    const [factor, unit] = length < 0.995 ? [100, "cm"] : length < 995 ? [1, "m"] : [1e-3, "km"];
    const scaled = length * factor;
    return `${scaled >= 10 ? Math.round(scaled) : Number(scaled.toPrecision(2))} ${unit}`;
}
