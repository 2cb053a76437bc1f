// Wind for three.js: moves the vertices of files that were requested with `wind=`, and shows the
// weights by which it does so.
import {
    Mesh,
    MeshDepthMaterial,
    RGBADepthPacking,
    Vector2,
    type IUniform,
    type Material,
    type Object3D,
} from "three";

/** What a file states about wind, in `asset.extras.wind`. */
export interface WindExtras {
    /** Names of vertex attributes with a component, as in the file: "TEXCOORD_1.x". */
    channels: { bend: string; flutter: string; phase: string; branch: string };
    /** Displacement for a weight of 1 in a breeze of 3 m/s, metres. */
    sway_m: number;
    flutter_m: number;
}

/** Returns what a file states about wind, undefined if it has none.
 *
 *  @param asset `asset` of the result of GLTFLoader */
export function windOf(asset: unknown): WindExtras | undefined {
    const { extras } = (asset ?? {}) as { extras?: { wind?: WindExtras } };
    return extras?.wind;
}

/** Names of vertex attributes in three.js, and their types. */
const attributes: Record<string, [name: string, type: string]> = {
    TEXCOORD_1: ["uv1", "vec2"],
    TEXCOORD_2: ["uv2", "vec2"],
    _WIND: ["_wind", "vec4"],
    COLOR_0: ["color", "vec4"],
};

/** Returns the GLSL that declares the attributes of the channels and reads their values. */
function weightsOf({ channels }: WindExtras): { declarations: string; values: string } {
    const declared = new Map<string, string>();
    const read = (channel: string): string => {
        const [semantic = "", component = ""] = channel.split(".");
        const attribute = attributes[semantic];
        if (!attribute || !/^[xyzw]$/.test(component))
            throw new Error(`the channel ${channel} of wind is not known`);
        const [name, type] = attribute;
        declared.set(name, `attribute ${type} ${name};`);
        return `${name}.${component}`;
    };
    const { bend, flutter, phase, branch } = channels;
    const values = `vec4(${[bend, flutter, phase, branch].map(read).join(", ")})`;
    return { declarations: [...declared.values()].join("\n"), values };
}

/** Gusts travel with the wind and are this long, metres; a weight of 1 moves by the stated
 *  displacement in a breeze of this speed, m/s. */
const gustLength = 8;
const breeze = 3;

/** What materials compiled before wind was added to them. */
const ownShaders = new WeakMap<Material, { compile: Material["onBeforeCompile"]; key: string }>();

const functions = /* glsl */ `
uniform float windTime;
uniform vec2 windVelocity;
uniform float windSway;
uniform float windFlutter;
uniform float windRate;
varying vec4 vWind;

// Returns the displacement of a vertex in the world, metres. It is a function of its place and its
// weights, so that vertices of several meshes at one place stay together.
vec3 windOffset(vec3 place, vec3 weights) {
    float speed = length(windVelocity);
    if (speed == 0.0) return vec3(0.0);
    vec2 along = windVelocity / speed;
    vec2 across = vec2(-along.y, along.x);
    // The force grows with the square of the speed, until stems lie down.
    float load = min(speed * speed / ${(breeze * breeze).toFixed(1)}, 3.0);
    float gust = windTime * speed / ${gustLength.toFixed(1)} - dot(place.xz, along) / ${gustLength.toFixed(1)};
    float swing = 6.2831853 * (windTime * windRate + weights.z);
    vec2 lean = along * (0.7 + 0.3 * sin(6.2831853 * gust) + 0.2 * sin(swing))
        + across * 0.15 * sin(0.73 * swing + 1.0);
    vec3 offset = weights.x * windSway * load * vec3(lean.x, 0.0, lean.y);
    float tremble = sin(6.2831853 * (4.0 * windTime + weights.z) + dot(place, vec3(41.0, 29.0, 37.0)));
    return offset + weights.y * windFlutter * min(load, 1.5) * tremble
        * vec3(0.4 * across.x, 1.0, 0.4 * across.y);
}
`;

const project = (values: string): string => /* glsl */ `
vec4 windPlace = vec4(transformed, 1.0);
#ifdef USE_BATCHING
    windPlace = batchingMatrix * windPlace;
#endif
#ifdef USE_INSTANCING
    windPlace = instanceMatrix * windPlace;
#endif
windPlace = modelMatrix * windPlace;
vWind = ${values};
windPlace.xyz += windOffset(windPlace.xyz, vWind.xyz);
vec4 mvPosition = viewMatrix * windPlace;
gl_Position = projectionMatrix * mvPosition;
`;

/** What weightsShown shows, by the number that the shader has for it. */
const views = ["all", "bend", "flutter", "phase", "branch"] as const;

/** Colours of weights: bend and flutter as brightness, phase as a hue, so that it is periodic, and
 *  branch as one of many hues, so that neighbouring numbers differ. */
const colours = /* glsl */ `
vec3 windHue(float turn) {
    return 0.5 + 0.5 * cos(6.2831853 * (turn - vec3(0.0, 0.333, 0.667)));
}
vec3 windColour() {
    if (windShown == 1) return vWind.rgb;
    if (windShown == 2) return vec3(vWind.x);
    if (windShown == 3) return vec3(vWind.y);
    if (windShown == 4) return windHue(vWind.z);
    return windHue(0.618 * floor(255.0 * vWind.w + 0.5));
}
`;

/** The wind of a scene. Attach it to what was loaded, and update it before every frame. */
export class Wind {
    /** Horizontal velocity along +x and +z, m/s. */
    readonly velocity = new Vector2(breeze, 0);

    private readonly time: IUniform<number> = { value: 0 };
    private readonly shown: IUniform<number> = { value: 0 };

    /** Lets the meshes of a file move, and their shadows with them.
     *
     *  @param root the scene of the file, or an object made of its geometries
     *  @param extras windOf() the file
     *  @throws Error for a channel that three.js does not import */
    attach(root: Object3D, extras: WindExtras): void {
        const seen = new Set<Material>();
        root.traverse((node) => {
            if (!(node instanceof Mesh)) return;
            const materials = (
                Array.isArray(node.material) ? node.material : [node.material]
            ) as Material[];
            for (const material of materials) {
                if (seen.has(material)) continue;
                seen.add(material);
                // As colours, weights would tint the picture; other colours are tints of branches.
                if (extras.channels.bend.startsWith("COLOR_0")) material.vertexColors = false;
                this.patch(material, extras, true);
            }
            const shadow = new MeshDepthMaterial({ depthPacking: RGBADepthPacking });
            this.patch(shadow, extras, false);
            node.customDepthMaterial = shadow;
        });
    }

    /** Moves time on.
     *
     *  @param seconds since any fixed moment */
    update(seconds: number): void {
        this.time.value = seconds;
    }

    /** Shows weights as colours: one of them, or with true and "all" bend red, flutter green and
     *  phase blue. */
    set weightsShown(shown: boolean | (typeof views)[number]) {
        const view = shown === true ? "all" : shown;
        this.shown.value = view === false ? 0 : views.indexOf(view) + 1;
    }

    private patch(material: Material, extras: WindExtras, lit: boolean): void {
        const { declarations, values } = weightsOf(extras);
        // A body that hangs by its own displacement swings at this rate, Hz.
        const rate = Math.sqrt(9.81 / Math.max(extras.sway_m, 1e-4)) / (2 * Math.PI);
        // A material may have a shader of its own, and several meshes may share it.
        const own = ownShaders.get(material) ?? {
            compile: material.onBeforeCompile.bind(material),
            key: material.customProgramCacheKey(),
        };
        ownShaders.set(material, own);
        material.customProgramCacheKey = () => `sporeprint wind ${values} ${own.key}`;
        material.onBeforeCompile = (shader, renderer) => {
            own.compile(shader, renderer);
            Object.assign(shader.uniforms, {
                windTime: this.time,
                windVelocity: { value: this.velocity },
                windSway: { value: extras.sway_m },
                windFlutter: { value: extras.flutter_m },
                windRate: { value: Math.min(Math.max(rate, 0.3), 4) },
                windShown: this.shown,
            });
            shader.vertexShader = `${declarations}\n${functions}\n${shader.vertexShader}`.replace(
                "#include <project_vertex>",
                project(values),
            );
            if (!lit) return;
            const declared = `uniform int windShown;\nvarying vec4 vWind;\n${colours}`;
            const shown = "if (windShown > 0) gl_FragColor = vec4(windColour(), 1.0);";
            shader.fragmentShader = `${declared}\n${shader.fragmentShader}`.replace(
                "#include <dithering_fragment>",
                `#include <dithering_fragment>\n${shown}`,
            );
        };
        material.needsUpdate = true;
    }
}
