// Environments as scenes of glowing surfaces: skies, trunks and softboxes. A cube map of a scene
// lights the model and is, blurred, its background. Nothing is loaded.
import {
    BackSide,
    BoxGeometry,
    Color,
    DoubleSide,
    Float32BufferAttribute,
    Mesh,
    MeshBasicMaterial,
    PlaneGeometry,
    Scene,
    SphereGeometry,
    type BufferGeometry,
    type Object3D,
    type Side,
} from "three";

/** Radiance, linear red, green and blue; 1 is white paper in full light. */
type Radiance = readonly [number, number, number];

function glowing(geometry: BufferGeometry, [r, g, b]: Radiance, side: Side = DoubleSide): Mesh {
    const colour = new Color().setRGB(r, g, b);
    return new Mesh(geometry, new MeshBasicMaterial({ color: colour, side, toneMapped: false }));
}

function mixed(from: Radiance, to: Radiance, share: number): Radiance {
    const part = (index: 0 | 1 | 2): number => from[index] + (to[index] - from[index]) * share;
    return [part(0), part(1), part(2)];
}

function smooth(from: number, to: number, value: number): number {
    const t = Math.min(Math.max((value - from) / (to - from), 0), 1);
    return t * t * (3 - 2 * t);
}

/** A sphere around everything whose radiance depends on the height above the horizon. */
function dome(zenith: Radiance, horizon: Radiance, ground: Radiance): Mesh {
    const geometry = new SphereGeometry(50, 48, 64);
    const position = geometry.getAttribute("position");
    const colours: number[] = [];
    for (let index = 0; index < position.count; ++index) {
        const height = position.getY(index) / 50;
        const above = mixed(horizon, zenith, smooth(0.02, 0.75, height));
        colours.push(...mixed(ground, above, smooth(-0.1, 0.05, height)));
    }
    geometry.setAttribute("color", new Float32BufferAttribute(colours, 3));
    const material = new MeshBasicMaterial({ vertexColors: true, side: BackSide });
    material.toneMapped = false;
    return new Mesh(geometry, material);
}

/** Places something by azimuth (from +Z to +X) and elevation, degrees, and lets it face the
 *  centre. */
function place(thing: Object3D, azimuth: number, elevation: number, distance: number): Object3D {
    const a = (azimuth * Math.PI) / 180;
    const e = (elevation * Math.PI) / 180;
    thing.position
        .set(Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e))
        .multiplyScalar(distance);
    thing.lookAt(0, 0, 0);
    return thing;
}

/** A flat light of a width and a height, degrees as seen from the centre. */
function card(
    radiance: Radiance,
    azimuth: number,
    elevation: number,
    width: number,
    height: number,
): Object3D {
    const distance = 20;
    const metres = (degrees: number): number => 2 * distance * Math.tan((degrees * Math.PI) / 360);
    const geometry = new PlaneGeometry(metres(width), metres(height));
    return place(glowing(geometry, radiance), azimuth, elevation, distance);
}

/** Returns a number in [0, 1) for each index, spread evenly by the golden ratio. */
function spread(index: number, offset = 0): number {
    return (index * 0.6180339887498949 + offset) % 1;
}

/** Trunks all around, the nearer ones darker. */
function trunks(count: number, near: Radiance, far: Radiance): Object3D[] {
    return Array.from({ length: count }, (_, index) => {
        const azimuth = 360 * spread(index, 0.11);
        const distance = 6 + 22 * spread(index * 3, 0.4);
        const width = 0.35 + 0.5 * spread(index * 5, 0.7);
        const trunk = glowing(
            new BoxGeometry(width, 30, width),
            mixed(near, far, (distance - 6) / 22),
        );
        place(trunk, azimuth, 0, distance);
        trunk.rotation.z += (spread(index * 7) - 0.5) * 0.12;
        trunk.position.y = 13.6;
        return trunk;
    });
}

/** Masses of leaves above the horizon, between two elevations. */
function canopy(count: number, colour: Radiance, from: number, to: number): Object3D[] {
    return Array.from({ length: count }, (_, index) => {
        const size = 1.6 + 2.6 * spread(index * 3, 0.2);
        const shade = 0.6 + 0.8 * spread(index * 5, 0.35);
        const [r, g, b] = colour;
        const leaves = glowing(new SphereGeometry(size, 10, 8), [r * shade, g * shade, b * shade]);
        const elevation = from + (to - from) * spread(index * 7, 0.5);
        return place(leaves, 360 * spread(index, 0.31), elevation, 16);
    });
}

function sceneOf(...parts: Object3D[]): Scene {
    const scene = new Scene();
    scene.add(...parts);
    return scene;
}

/** A grey sky seen through gaps of the canopy, mist between the trunks. */
export function overcastForest(): Scene {
    return sceneOf(
        dome([2.6, 2.58, 2.6], [0.52, 0.53, 0.47], [0.17, 0.155, 0.125]),
        ...trunks(26, [0.06, 0.055, 0.045], [0.31, 0.32, 0.27]),
        ...canopy(34, [0.22, 0.26, 0.17], 22, 62),
    );
}

/** Softboxes from the upper left and the right, a strip behind, a white table. */
export function photographicStudio(): Scene {
    return sceneOf(
        dome([0.45, 0.45, 0.45], [0.32, 0.32, 0.32], [0.5, 0.5, 0.5]),
        card([3.4, 3.4, 3.4], -48, 42, 44, 44),
        card([1.1, 1.1, 1.1], 62, 24, 40, 56),
        card([2.4, 2.4, 2.4], 168, 36, 70, 16),
    );
}

/** A low sun behind trunks and leaves, shade before them, and a reflector at the camera. */
export function backlitClearing(): Scene {
    return sceneOf(
        dome([0.5, 0.56, 0.62], [0.4, 0.35, 0.24], [0.15, 0.132, 0.1]),
        card([1.5, 1.15, 0.66], 170, 14, 70, 30),
        card([5, 3.8, 2.1], 158, 24, 26, 20),
        card([0.75, 0.72, 0.66], -22, 20, 50, 40),
        ...trunks(22, [0.05, 0.043, 0.032], [0.24, 0.2, 0.13]),
        ...canopy(26, [0.24, 0.25, 0.1], 18, 55),
    );
}

/** The sky after sunset: blue above, a glow on one side, trunks as silhouettes. */
export function duskAtForestEdge(): Scene {
    return sceneOf(
        dome([0.42, 0.5, 0.7], [0.28, 0.3, 0.38], [0.07, 0.075, 0.088]),
        card([1.1, 0.55, 0.3], -84, 7, 80, 14),
        ...trunks(24, [0.04, 0.042, 0.05], [0.14, 0.15, 0.19]),
        ...canopy(18, [0.055, 0.062, 0.068], 14, 40),
    );
}
