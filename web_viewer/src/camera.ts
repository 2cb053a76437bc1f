// Camera positions from which a box is seen whole, and the scale of the picture.
import { Vector3, type Box3, type PerspectiveCamera } from "three";
import { closeUpNames, type CloseUpName, type CloseUpRules } from "./close_ups";

export const viewNames = ["three-quarter", "front", "side", "top", "below"] as const;
/** "roots" is from above, without the caps that hide the roots. */
export type ViewName = (typeof viewNames)[number] | "roots";
/** Everything that the camera can be moved to by name. */
/** What buttons of the views say. */
export const viewLabels: Readonly<Record<Exclude<ViewName, "roots">, string>> = {
    front: "Front",
    "three-quarter": "Three-quarter",
    side: "Side",
    top: "Top",
    below: "Below",
};

export type LookName = ViewName | CloseUpName;
export const lookNames: readonly LookName[] = [...viewNames, "roots", ...closeUpNames];

export function isCloseUp(name: LookName): name is CloseUpName {
    return closeUpNames.some((one) => one === name);
}

/** Returns the unit direction from the model to the camera; azimuth from +Z to +X and elevation,
 *  degrees. */
function towards(azimuth: number, elevation: number): Vector3 {
    const a = (azimuth * Math.PI) / 180;
    const e = (elevation * Math.PI) / 180;
    return new Vector3(Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e));
}

export type Directions = Readonly<Record<ViewName, Vector3>>;

/** Directions for an upright model. */
export const standing: Directions = {
    "three-quarter": towards(32, 17),
    front: towards(0, 4),
    side: towards(90, 4),
    top: towards(0, 89.9),
    roots: towards(0, 89.9),
    below: towards(24, -38),
};

/** Directions for a group: from higher up, so that the front does not hide the back. */
export const spread: Directions = {
    ...standing,
    "three-quarter": towards(32, 27),
    front: towards(0, 12),
    side: towards(90, 12),
};

/** Directions for a model that lies on the ground along +Z: its tip is up in the picture. */
export const lying: Directions = {
    "three-quarter": towards(200, 62),
    front: towards(0, 12),
    side: towards(90, 8),
    top: towards(180, 89.9),
    roots: towards(180, 89.9),
    below: towards(160, -60),
};

/** Close-ups of an upright mushroom. */
export const standingCloseUps: CloseUpRules = {
    margin: { frame: 0.05, direction: towards(32, 10) },
    underside: { frame: 0.06, direction: towards(32, -34) },
    base: { frame: 0.08, direction: towards(32, 9) },
};

/** Close-ups of a group: those of its foremost individual. */
export const spreadCloseUps: CloseUpRules = {
    ...standingCloseUps,
    base: { frame: 0.08, direction: towards(32, 14) },
    many: true,
};

/** Close-ups of a model that lies on the ground along +Z. */
export const lyingCloseUps: CloseUpRules = {
    margin: { frame: 0.05, direction: towards(110, 50) },
    underside: { frame: 0.06, direction: towards(110, -55) },
    base: { frame: 0.08, direction: towards(200, 50) },
};

/** A tree is too large for the close-ups of its crown; its base shows the foot of the trunk. */
export const treeCloseUps: CloseUpRules = {
    margin: "A tree has no margin; its leaves are at Leaves",
    underside: "A tree has no underside: Below shows the crown",
    base: { frame: 0.8, direction: towards(32, 10) },
};

/** Returns the distance at which the shorter side of the picture shows `frame` metres. */
export function framingDistance(frame: number, camera: PerspectiveCamera): number {
    const shorter = Math.min(1, camera.aspect) * Math.tan((camera.fov * Math.PI) / 360);
    return frame / (2 * shorter);
}

/** Margins around the model as fractions of the picture: name plate and buttons are there. */
export interface Margin {
    x: number;
    y: number;
}

/** Returns the distance from the centre of `box` at which all its corners are in the picture. */
export function fittingDistance(
    box: Box3,
    direction: Vector3,
    camera: PerspectiveCamera,
    margin: Margin,
): number {
    const centre = box.getCenter(new Vector3());
    const right = new Vector3().crossVectors(camera.up, direction).normalize();
    const up = new Vector3().crossVectors(direction, right);
    const tall = Math.tan((camera.fov * Math.PI) / 360);
    const wide = tall * camera.aspect;
    let distance = 0;
    for (let corner = 0; corner < 8; ++corner) {
        const point = new Vector3(
            corner & 1 ? box.max.x : box.min.x,
            corner & 2 ? box.max.y : box.min.y,
            corner & 4 ? box.max.z : box.min.z,
        ).sub(centre);
        const depth = point.dot(direction);
        distance = Math.max(
            distance,
            depth + Math.abs(point.dot(right)) / (wide * (1 - margin.x)),
            depth + Math.abs(point.dot(up)) / (tall * (1 - margin.y)),
        );
    }
    return distance;
}

/** Returns the pixels per metre at the depth of the target; `height` of the picture in pixels. */
export function pixelsPerMetre(camera: PerspectiveCamera, target: Vector3, height: number): number {
    const distance = camera.position.distanceTo(target);
    return height / (2 * distance * Math.tan((camera.fov * Math.PI) / 360));
}

/** Returns a bar of a round length, metres, from `least` to about 2.5 times as many pixels. */
export function scaleBar(perMetre: number, least: number): { metres: number; pixels: number } {
    const wanted = least / perMetre;
    const power = 10 ** Math.floor(Math.log10(wanted));
    const digit = [1, 2, 5, 10].find((size) => size * power >= wanted * 0.9999999) ?? 10;
    const metres = Number((digit * power).toPrecision(1));
    return { metres, pixels: metres * perMetre };
}

/** Returns a length in centimetres as text: "5 cm", "0.5 cm"; `digits` after the point if given. */
export function centimetres(metres: number, digits?: number): string {
    const value = metres * 100;
    const text =
        digits === undefined ? String(Number(value.toPrecision(6))) : value.toFixed(digits);
    return `${text} cm`;
}

/** Returns a length as text: "4.2 cm", from one metre on "6.52 m". */
export function length(metres: number): string {
    return metres < 1 ? centimetres(metres, 1) : `${metres.toFixed(2)} m`;
}
