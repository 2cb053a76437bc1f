// How somebody moves over the ground of a world who flies or walks: where, and in which direction they look. Pure.
import { within } from "./view_address";

/** Height of the eyes of somebody who walks, metres. */
export const eyeHeight = 1.6;
/** The lowest and the highest that one flies above the ground, metres. */
export const heightRange = [0.4, 400] as const;
const pitchRange = 89;

export interface Pose {
    /** Metres to the east and to the north of the centre of the world. */
    x: number;
    y: number;
    /** Above the ground, metres. */
    height: number;
    /** Clockwise from north, and above the horizon, degrees. */
    heading: number;
    pitch: number;
}

/** What is pressed: shares from -1 to 1. */
export interface Push {
    ahead: number;
    right: number;
    up: number;
    fast: boolean;
}

export interface Terrain {
    /** Length of the sides of the world, metres. */
    extent: number;
    at: (x: number, y: number) => number;
}

/** Returns how fast one moves at a height, m/s: low above the ground as fast as somebody who runs. */
export function speedAt(height: number, walks: boolean, fast: boolean): number {
    const own = walks ? 1.8 : within(1.2 * height, 3, 120);
    return own * (fast ? 4 : 1);
}

/** Returns the pose after some metres ahead, to the right and up, inside the world and above its ground. One who walks
 *  stays on the ground; one who flies moves along the direction of the view. */
export function moved(pose: Pose, ahead: number, right: number, up: number, walks: boolean, terrain: Terrain): Pose {
    const [turn, tilt] = [(pose.heading * Math.PI) / 180, (walks ? 0 : pose.pitch * Math.PI) / 180];
    const level = ahead * Math.cos(tilt);
    const half = terrain.extent / 2 - 0.5;
    const x = within(pose.x + level * Math.sin(turn) + right * Math.cos(turn), -half, half);
    const y = within(pose.y + level * Math.cos(turn) - right * Math.sin(turn), -half, half);
    if (walks) return { ...pose, x, y, height: eyeHeight };
    const height = pose.height + terrain.at(pose.x, pose.y) - terrain.at(x, y) + ahead * Math.sin(tilt) + up;
    return { ...pose, x, y, height: within(height, ...heightRange) };
}

/** Returns the pose after some seconds of pushing. */
export function pushed(pose: Pose, push: Push, seconds: number, walks: boolean, terrain: Terrain): Pose {
    const length = Math.max(Math.hypot(push.ahead, push.right, push.up), 1);
    const way = (speedAt(pose.height, walks, push.fast) * seconds) / length;
    return moved(pose, push.ahead * way, push.right * way, push.up * way, walks, terrain);
}

/** Returns the pose that looks some degrees farther to the right and up. */
export function turned(pose: Pose, right: number, up: number): Pose {
    const heading = (((pose.heading + right) % 360) + 360) % 360;
    return { ...pose, heading, pitch: within(pose.pitch + up, -pitchRange, pitchRange) };
}

/** Returns the direction of the view in the coordinates of the scene: x to the east, y up, z to the south. */
export function directionOf({ heading, pitch }: Pose): [number, number, number] {
    const [turn, tilt] = [(heading * Math.PI) / 180, (pitch * Math.PI) / 180];
    return [Math.sin(turn) * Math.cos(tilt), Math.sin(tilt), -Math.cos(turn) * Math.cos(tilt)];
}

const pushes: Readonly<Record<string, Partial<Push>>> = {
    w: { ahead: 1 },
    arrowup: { ahead: 1 },
    s: { ahead: -1 },
    arrowdown: { ahead: -1 },
    a: { right: -1 },
    d: { right: 1 },
    e: { up: 1 },
    pageup: { up: 1 },
    q: { up: -1 },
    pagedown: { up: -1 },
};

/** Degrees per second that a key turns the view to the right. */
const turns: Readonly<Record<string, number>> = { arrowleft: -70, arrowright: 70 };

/** Returns true for a key that moves or turns. */
export function isMoving(key: string): boolean {
    return key in pushes || key in turns;
}

/** Returns what pressed keys, in lower case, do together. */
export function pushOf(keys: Iterable<string>, fast: boolean): { push: Push; turn: number } {
    const push: Push = { ahead: 0, right: 0, up: 0, fast };
    let turn = 0;
    for (const key of keys) {
        const own = pushes[key];
        push.ahead += own?.ahead ?? 0;
        push.right += own?.right ?? 0;
        push.up += own?.up ?? 0;
        turn += turns[key] ?? 0;
    }
    return { push, turn };
}
