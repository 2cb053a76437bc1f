// Paint of drafts: a shape that is being dragged is shown at once in the paint of the one before, and its own linked
// images are put on when they arrive. One set of textures is worn by all drafts, so that a new shape uploads nothing.
import {
    LinearFilter,
    LinearMipmapLinearFilter,
    MeshStandardMaterial,
    Texture,
    type MagnificationTextureFilter,
    type MinificationTextureFilter,
    type Object3D,
    type Wrapping,
} from "three";
import type { GLTFLoaderPlugin, GLTFParser } from "three/addons/loaders/GLTFLoader.js";
import { meshesOf } from "./model";

interface Sampler {
    magFilter?: number;
    minFilter?: number;
    wrapS?: number;
    wrapT?: number;
}

interface LinkedMaterial {
    normalTexture?: { index: number };
    occlusionTexture?: { index: number };
    pbrMetallicRoughness?: { baseColorTexture?: { index: number } };
}

interface LinkedJson {
    materials?: LinkedMaterial[];
    textures?: { source?: number; sampler?: number }[];
    images?: { uri?: string }[];
    samplers?: Sampler[];
}

const wrappings: Record<number, Wrapping> = { 33071: 1001, 33648: 1002, 10497: 1000 };

/** "base_color" of "../surfaces/mushrooms/amanita_muscaria/base_color.jpg?…". */
function roleOf(uri: string): string {
    return /([^/?]+)\.\w+(?:\?|$)/.exec(uri)?.[1] ?? uri;
}

/** "base_color" of the first material, "base_color 1" of the one after it. */
function ofMaterial(role: string, material: number): string {
    return material > 0 ? `${role} ${material}` : role;
}

/** The material that a texture belongs to. */
function materialOf(json: LinkedJson, texture: number): number {
    const found = (json.materials ?? []).findIndex(
        ({ normalTexture, occlusionTexture, pbrMetallicRoughness }) =>
            [normalTexture, occlusionTexture, pbrMetallicRoughness?.baseColorTexture].some(
                (one) => one?.index === texture,
            ),
    );
    return Math.max(found, 0);
}

export class Paint {
    private readonly worn = new Map<string, Texture>();
    private wanted = new Map<string, string>();
    private shown = "";
    private busy = false;

    /** Called when paint was put on. */
    onChange: () => void = () => undefined;

    /** Lends the worn textures to a model that is being read from an address, and notes what it is to be painted with. */
    plugin(addresses: Map<string, string>, from: string): (parser: GLTFParser) => GLTFLoaderPlugin {
        return (parser) => {
            const json = parser.json as LinkedJson;
            return {
                name: "sporeprint_late_paint",
                loadTexture: (index) => {
                    const definition = json.textures?.[index];
                    const uri = json.images?.[definition?.source ?? -1]?.uri;
                    if (!uri || uri.startsWith("data:")) return null;
                    const role = ofMaterial(roleOf(uri), materialOf(json, index));
                    addresses.set(role, new URL(uri, from).href);
                    return Promise.resolve(
                        this.texture(role, json.samplers?.[definition?.sampler ?? -1] ?? {}),
                    );
                },
            };
        };
    }

    /** A draft stands on the stage: fetches its images, the newest wish first and never two sets at a time. */
    dress(addresses: Map<string, string>): void {
        this.wanted = addresses;
        if (!this.busy) void this.fetch();
    }

    /** A finished model stands on the stage: drafts after it start in its paint. */
    adopt(model: Object3D): void {
        const materials = [...new Set(meshesOf(model).map(({ material }) => material))];
        for (const [number, material] of materials.entries()) {
            if (!(material instanceof MeshStandardMaterial)) continue;
            const { map, normalMap, roughnessMap } = material;
            for (const [role, from] of [
                ["base_color", map],
                ["normal", normalMap],
                ["orm", roughnessMap],
            ] as const) {
                if (!from || from.userData["shared"]) continue;
                from.userData["shared"] = true;
                from.userData["lent"] = true;
                this.put(ofMaterial(role, number), from.image as ImageBitmap, from);
            }
        }
        this.wanted = new Map();
        this.shown = "";
    }

    private texture(role: string, sampler: Sampler = {}): Texture {
        const known = this.worn.get(role);
        if (known) return known;
        const made = new Texture(blank(role));
        made.flipY = false;
        made.anisotropy = 8;
        made.magFilter = (
            sampler.magFilter === 9728 ? 1003 : LinearFilter
        ) as MagnificationTextureFilter;
        made.minFilter = LinearMipmapLinearFilter as MinificationTextureFilter;
        made.wrapS = wrappings[sampler.wrapS ?? 10497] ?? made.wrapS;
        made.wrapT = wrappings[sampler.wrapT ?? 10497] ?? made.wrapT;
        made.userData["shared"] = true;
        made.needsUpdate = true;
        this.worn.set(role, made);
        return made;
    }

    private put(role: string, image: ImageBitmap | HTMLCanvasElement, like?: Texture): void {
        const texture = this.texture(role);
        if (like) {
            texture.colorSpace = like.colorSpace;
            texture.wrapS = like.wrapS;
            texture.wrapT = like.wrapT;
        }
        const old = texture.image as unknown;
        // The card's storage has a fixed size.
        texture.dispose();
        texture.image = image;
        texture.needsUpdate = true;
        if (typeof ImageBitmap !== "undefined" && old instanceof ImageBitmap && old !== image)
            old.close();
    }

    private async fetch(): Promise<void> {
        this.busy = true;
        try {
            for (;;) {
                const wanted = this.wanted;
                const key = [...wanted.values()].join(" ");
                if (wanted.size === 0 || key === this.shown) return;
                const images = await Promise.all(
                    [...wanted].map(async ([role, address]) => {
                        const response = await fetch(address);
                        if (!response.ok) throw new Error(`${response.status}`);
                        const options = {
                            premultiplyAlpha: "none",
                            colorSpaceConversion: "none",
                        } as const;
                        return {
                            role,
                            image: await createImageBitmap(await response.blob(), options),
                        };
                    }),
                );
                // A finished model may have come meanwhile, with paint of its own.
                if (this.wanted.size === 0) {
                    for (const { image } of images) image.close();
                    return;
                }
                for (const { role, image } of images) this.put(role, image);
                this.shown = key;
                this.onChange();
            }
        } catch {
            // The draft keeps the paint it has; the finished model brings its own.
        } finally {
            this.busy = false;
        }
    }
}

/** What stands in for an image that never came: white, a flat normal, rough and open. */
function blank(role: string): HTMLCanvasElement {
    const canvas = document.createElement("canvas");
    canvas.width = canvas.height = 4;
    const context = canvas.getContext("2d");
    if (context) {
        context.fillStyle =
            { normal: "#8080ff", orm: "#ffc800" }[role.split(" ")[0] ?? ""] ?? "#e8dcc6";
        context.fillRect(0, 0, 4, 4);
    }
    return canvas;
}
