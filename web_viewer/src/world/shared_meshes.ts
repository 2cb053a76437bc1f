// Meshes that many tiles have in common: a plugin of the loader, by which each is read once and has one geometry and
// one set of images on the graphics card, however many tiles show it.
import {
    InstancedMesh,
    LinearFilter,
    LinearMipmapLinearFilter,
    Mesh,
    RepeatWrapping,
    Texture,
    TextureLoader,
    type BufferGeometry,
    type Group,
    type Object3D,
} from "three";
import type { GLTFLoaderPlugin, GLTFParser } from "three/addons/loaders/GLTFLoader.js";

interface FileJson {
    accessors?: { bufferView?: number }[];
    bufferViews?: { buffer: number }[];
    buffers?: { uri?: string }[];
    images?: { uri?: string }[];
    materials?: unknown[];
    meshes?: { primitives: { attributes: Record<string, number>; indices?: number; material?: number }[] }[];
    textures?: { source?: number; extensions?: Record<string, { source?: number } | undefined> }[];
}

/** Meshes and images by what they are made of. */
export class SharedMeshes {
    private readonly meshes = new Map<string, Promise<Mesh | Group>>();
    private readonly images = new Map<string, Promise<Texture>>();
    private readonly shared = new WeakSet<BufferGeometry | Texture>();
    private readonly loader = new TextureLoader();

    /** Number of different meshes so far. */
    get count(): number {
        return this.meshes.size;
    }

    /** The plugin for a loader. */
    readonly plugin = (parser: GLTFParser): GLTFLoaderPlugin =>
        ({
            name: "SPOREPRINT_shared_meshes",
            loadMesh: (index: number) => this.mesh(parser, index),
            loadTexture: (index: number) => this.texture(parser, index),
        }) as GLTFLoaderPlugin;

    /** Returns how much memory a tile takes on the graphics card, without what it shares with others, bytes. */
    ownBytes(tile: Object3D): number {
        const seen = new Set<BufferGeometry | Texture>();
        let bytes = 0;
        const isNew = (part: BufferGeometry | Texture): boolean => {
            const found = !this.shared.has(part) && !seen.has(part);
            seen.add(part);
            return found;
        };
        tile.traverse((node) => {
            if (!(node instanceof Mesh)) return;
            const { geometry, material } = node as Mesh;
            if (node instanceof InstancedMesh) bytes += node.instanceMatrix.array.byteLength;
            if (isNew(geometry))
                for (const { array } of [...Object.values(geometry.attributes), geometry.index ?? []].flat()) bytes += array.byteLength;
            for (const one of [material].flat())
                for (const value of Object.values(one) as unknown[]) {
                    if (!(value instanceof Texture) || !isNew(value)) continue;
                    const { width, height } = value.image as { width: number; height: number };
                    // Mipmaps are another third.
                    bytes += (width * height * 16) / 3;
                }
        });
        return bytes;
    }

    clear(): void {
        this.meshes.clear();
        this.images.clear();
    }

    private mesh(parser: GLTFParser, index: number): Promise<Mesh | Group> | null {
        const key = keyOfMesh(parser.json as FileJson, index, pathOf(parser));
        if (key === undefined) return null;
        const known = this.meshes.get(key);
        const made = known ?? (parser.loadMesh(index) as Promise<Mesh | Group>);
        if (!known) {
            this.meshes.set(key, made);
            made.catch(() => this.meshes.delete(key));
        }
        return made.then((mesh) => {
            if (!known) mesh.traverse((node) => node instanceof Mesh && this.shared.add((node as Mesh).geometry));
            // A node has only one parent; geometry and materials stay the same.
            return mesh.clone();
        });
    }

    private texture(parser: GLTFParser, index: number): Promise<Texture> | null {
        const address = addressOfImage(parser.json as FileJson, index, pathOf(parser));
        if (address === undefined) return null;
        const known = this.images.get(address);
        if (known) return known;
        const made = this.loader.loadAsync(address).then((texture) => {
            this.shared.add(texture);
            texture.flipY = false;
            texture.wrapS = texture.wrapT = RepeatWrapping;
            texture.magFilter = LinearFilter;
            texture.minFilter = LinearMipmapLinearFilter;
            texture.anisotropy = 8;
            return texture;
        });
        this.images.set(address, made);
        made.catch(() => this.images.delete(address));
        return made;
    }
}

function pathOf(parser: GLTFParser): string {
    return new URL(parser.options.path, location.href).href;
}

/** Returns the address of the linked image of a texture, undefined if it is in the file. */
function addressOfImage(json: FileJson, index: number, path: string): string | undefined {
    const { source, extensions } = json.textures?.[index] ?? {};
    const uri = json.images?.[extensions?.["EXT_texture_webp"]?.source ?? source ?? -1]?.uri;
    return uri === undefined || uri.startsWith("data:") ? undefined : new URL(uri, path).href;
}

/** Returns a text that is equal for equal meshes of all files, undefined for a mesh with data of this file alone. */
function keyOfMesh(json: FileJson, index: number, path: string): string | undefined {
    const primitives = json.meshes?.[index]?.primitives ?? [];
    const parts: unknown[] = [];
    for (const { material, ...primitive } of primitives) {
        const accessors = [...Object.entries(primitive.attributes), ["indices", primitive.indices]] as const;
        for (const [name, number] of accessors) {
            if (number === undefined) continue;
            const accessor = json.accessors?.[number as number];
            const view = json.bufferViews?.[accessor?.bufferView ?? -1];
            const uri = json.buffers?.[view?.buffer ?? -1]?.uri;
            if (uri === undefined || uri.startsWith("data:")) return undefined;
            parts.push(name, accessor, view, new URL(uri, path).href);
        }
        const own = material === undefined ? undefined : json.materials?.[material];
        const images: string[] = [];
        for (const texture of texturesIn(own)) {
            const address = addressOfImage(json, texture, path);
            if (address === undefined) return undefined;
            images.push(address);
        }
        parts.push(own, images);
    }
    return primitives.length > 0 ? JSON.stringify(parts) : undefined;
}

/** Returns the indices of all textures that a material names. */
function texturesIn(value: unknown, name = ""): number[] {
    if (typeof value !== "object" || value === null) return [];
    const own = /texture$/i.test(name) ? [(value as { index?: number }).index] : [];
    const below = Object.entries(value).flatMap(([key, sub]) => texturesIn(sub, key));
    return [...own.filter((index) => index !== undefined), ...below];
}
