// Textures of drafts: a draft is shown at once with the textures of the model before it, and with
// its own linked images when they have arrived. All drafts share one set of textures, so that a new
// shape uploads geometry only.
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

/** Returns the role of an image by its file name: "base_color" for
 *  "amanita_muscaria/base_color.jpg?…". */
function roleOf(uri: string): string {
    return /([^/?]+)\.\w+(?:\?|$)/.exec(uri)?.[1] ?? uri;
}

/** Returns the key of a role in a material: "base_color" for the first, "base_color 1" for the
 *  second. */
function ofMaterial(role: string, material: number): string {
    return material > 0 ? `${role} ${material}` : role;
}

/** Returns the index of the material that uses a texture. */
function materialOf(json: LinkedJson, texture: number): number {
    const found = (json.materials ?? []).findIndex(
        ({ normalTexture, occlusionTexture, pbrMetallicRoughness }) =>
            [normalTexture, occlusionTexture, pbrMetallicRoughness?.baseColorTexture].some(
                (one) => one?.index === texture,
            ),
    );
    return Math.max(found, 0);
}

export class DraftTextures {
    private readonly textures = new Map<string, Texture>();
    private addresses = new Map<string, string>();
    private shownKey = "";
    private busy = false;

    /** Called when the textures have new images. */
    onChange: () => void = () => undefined;

    /** Returns a loader plugin that gives a model the shared textures, and collects the addresses
     *  of its own images, relative to `from`, by role. */
    plugin(addresses: Map<string, string>, from: string): (parser: GLTFParser) => GLTFLoaderPlugin {
        return (parser) => {
            const json = parser.json as LinkedJson;
            return {
                name: "sporeprint_shared_textures",
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

    /** Fetches the linked images of the draft on the stage: one set at a time, and only the newest
     *  of the waiting sets. */
    fetchImages(addresses: Map<string, string>): void {
        this.addresses = addresses;
        if (!this.busy) void this.fetch();
    }

    /** Copies the images of a final model on the stage: later drafts start with them. */
    adoptFrom(model: Object3D): void {
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
                from.userData["imageShared"] = true;
                this.put(ofMaterial(role, number), from.image as ImageBitmap, from);
            }
        }
        this.addresses = new Map();
        this.shownKey = "";
    }

    private texture(role: string, sampler: Sampler = {}): Texture {
        const known = this.textures.get(role);
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
        this.textures.set(role, made);
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
        // The storage on the graphics card has a fixed size.
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
                const requested = this.addresses;
                const key = [...requested.values()].join(" ");
                if (requested.size === 0 || key === this.shownKey) return;
                const images = await Promise.all(
                    [...requested].map(async ([role, address]) => {
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
                // A final model may have arrived in the meantime, with images of its own.
                if (this.addresses.size === 0) {
                    for (const { image } of images) image.close();
                    return;
                }
                for (const { role, image } of images) this.put(role, image);
                this.shownKey = key;
                this.onChange();
            }
        } catch {
            // The draft keeps the textures it has; the final model has its own.
        } finally {
            this.busy = false;
        }
    }
}

/** Returns a placeholder for an image that did not arrive: neutral colour, flat normal, rough. */
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
