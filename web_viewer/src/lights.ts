// The lights that a model can be seen in, one table. Each is made of an environment that is drawn
// once into a cube map (surroundings.ts), a sun with a shadow, and light from the ground.
import { Group, Scene } from "three";
import { RoomEnvironment } from "three/addons/environments/RoomEnvironment.js";
import {
    backlitClearing,
    duskAtForestEdge,
    overcastForest,
    photographicStudio,
} from "./surroundings";

export const lightNames = ["daylight", "overcast", "studio", "backlight", "dusk"] as const;
export type LightName = (typeof lightNames)[number];

/** What is behind the model: a sheet in the colours of the page's style, or the environment. */
export type Background = "sheet" | { blurriness: number; intensity: number };

export interface Light {
    label: string;
    title: string;
    /** Makes the scene that becomes the environment; +Z is towards the camera of the first view. */
    surroundings: () => Scene;
    environmentIntensity: number;
    sun: {
        colour: number;
        intensity: number;
        /** Degrees from the camera of the first view to the right, and above the horizon. */
        azimuth: number;
        elevation: number;
        /** Blur of the shadow's edge, texels of the shadow map. */
        blur: number;
    };
    /** Light from below, which the ground reflects. */
    bounce: { colour: number; intensity: number };
    exposure: number;
    background: Background;
    /** Opacity of the sun's shadow on the ground, and of the shadow where the model touches it. */
    shadow: number;
    contact: number;
    /** Colour of soil, linear; undefined for a sheet with ruled lines or for a plain one. */
    soil?: readonly [number, number, number];
    /** The ground has ruled lines. */
    ruled: boolean;
}

/** Azimuth of the camera of the first view of an upright model, degrees. */
export const homeAzimuth = 32;

export const lights: Readonly<Record<LightName, Light>> = {
    daylight: {
        label: "Daylight",
        title: "Daylight from the upper left on ruled paper, as in the plates of field guides",
        surroundings: () => new RoomEnvironment(),
        environmentIntensity: 0.5,
        sun: { colour: 0xfff2dd, intensity: 2.1, azimuth: -71.8, elevation: 56.5, blur: 5 },
        bounce: { colour: 0xf1e4cb, intensity: 1.5 },
        exposure: 1,
        background: "sheet",
        shadow: 0.26,
        contact: 0.62,
        ruled: true,
    },
    overcast: {
        label: "Overcast forest",
        title: "Soft light through the canopy under a grey sky",
        surroundings: overcastForest,
        environmentIntensity: 1,
        sun: { colour: 0xfffaf4, intensity: 0.8, azimuth: -35, elevation: 70, blur: 14 },
        bounce: { colour: 0x8a7c66, intensity: 0.4 },
        exposure: 1.08,
        background: { blurriness: 0.22, intensity: 0.9 },
        shadow: 0.22,
        contact: 0.75,
        soil: [0.145, 0.13, 0.103],
        ruled: false,
    },
    studio: {
        label: "Studio",
        title: "Two softboxes and a reflector before light grey paper",
        surroundings: photographicStudio,
        environmentIntensity: 1,
        sun: { colour: 0xffffff, intensity: 1, azimuth: -48, elevation: 48, blur: 9 },
        bounce: { colour: 0xffffff, intensity: 0.6 },
        exposure: 1,
        background: "sheet",
        shadow: 0.2,
        contact: 0.5,
        ruled: false,
    },
    backlight: {
        label: "Backlight",
        title: "Low warm sun behind the model, its front in shade",
        surroundings: backlitClearing,
        environmentIntensity: 1,
        sun: { colour: 0xffd7a0, intensity: 5, azimuth: 150, elevation: 27, blur: 4 },
        bounce: { colour: 0x9a7a48, intensity: 0.7 },
        exposure: 1,
        background: { blurriness: 0.3, intensity: 0.95 },
        shadow: 0.5,
        contact: 0.7,
        soil: [0.135, 0.117, 0.085],
        ruled: false,
    },
    dusk: {
        label: "Dusk",
        title: "Blue light after sunset, a last glow from the left",
        surroundings: duskAtForestEdge,
        environmentIntensity: 1,
        sun: { colour: 0xffb48a, intensity: 0.55, azimuth: -78, elevation: 16, blur: 10 },
        bounce: { colour: 0x3c4050, intensity: 0.35 },
        exposure: 1,
        background: { blurriness: 0.3, intensity: 0.9 },
        shadow: 0.2,
        contact: 0.7,
        soil: [0.062, 0.067, 0.078],
        ruled: false,
    },
};

/** Returns the scene of a light's environment, turned so that its +Z is at an azimuth, degrees from
 *  +Z to +X. The environment of daylight is not turned. */
export function surroundingsOf(name: LightName, azimuth: number): Scene {
    const scene = lights[name].surroundings();
    if (name === "daylight") return scene;
    const turned = new Scene();
    const group = new Group();
    group.rotation.y = (azimuth * Math.PI) / 180;
    group.add(...scene.children);
    turned.add(group);
    return turned;
}
