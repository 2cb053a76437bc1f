// Parsed GLBs: reading, measuring, counting and disposing.
import {
    Box3,
    InstancedMesh,
    LineSegments,
    Mesh,
    MeshStandardMaterial,
    Texture,
    type BufferGeometry,
    type Material,
    type Object3D,
} from "three";
import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { MaterialVariants } from "../clients/three/variants";
import { windOf, type WindExtras } from "../clients/three/wind";
import type { DraftTextures } from "./draft_textures";
import { levelNodesOf } from "./levels";
import { outline } from "./solids";
import { translucency } from "./translucency";

export interface Counts {
    triangles: number;
    vertices: number;
    drawCalls: number;
    textures: number;
    /** Bytes of all images with their mipmaps, as RGBA, on the graphics card. */
    imageBytes: number;
}

export function meshesOf(model: Object3D): Mesh[] {
    const meshes: Mesh[] = [];
    model.traverse((node) => {
        if (node instanceof Mesh) meshes.push(node);
    });
    return meshes;
}

function materialsOf(mesh: Mesh): Material[] {
    return Array.isArray(mesh.material) ? mesh.material : [mesh.material];
}

export function texturesOf(model: Object3D): Set<Texture> {
    const textures = new Set(model.userData["thinness"] as Set<Texture> | undefined);
    const materials = new Set(modelVariants(model)?.materials);
    for (const mesh of meshesOf(model)) {
        for (const material of materialsOf(mesh)) materials.add(material);
    }
    for (const material of materials) {
        for (const value of Object.values(material)) {
            if (value instanceof Texture) textures.add(value);
        }
    }
    return textures;
}

/** Removes the tangents of a mesh with morph targets. Morph targets change normals but not the
 *  tangents of the file; three derives tangents from positions and texture coordinates instead. */
function useDerivativeTangents(mesh: Mesh): void {
    if (!mesh.geometry.getAttribute("tangent")) return;
    mesh.geometry.deleteAttribute("tangent");
    for (const material of materialsOf(mesh)) {
        // The loader does the same for files without tangents.
        if (material instanceof MeshStandardMaterial) material.normalScale.y *= -1;
    }
}

/** Replaces the meshes of solids for collision by their edges. */
function outlineSolids(scene: Object3D): void {
    for (const mesh of meshesOf(scene)) if (mesh.userData["collision"] !== undefined) outline(mesh);
}

/** Returns the addresses of the linked images that a draft does not have yet, by role. */
export function linkedImagesOf(model: Object3D): Map<string, string> {
    return (
        (model.userData["linkedImages"] as Map<string, string> | undefined) ??
        new Map<string, string>()
    );
}

/** Returns what the file of a model states about wind. */
export function modelWind(model: Object3D): WindExtras | undefined {
    return model.userData["wind"] as WindExtras | undefined;
}

/** Returns the variants of the materials of a model; none of a model that was not parsed. */
export function modelVariants(model: Object3D): MaterialVariants | undefined {
    return model.userData["variants"] as MaterialVariants | undefined;
}

/** Returns the nodes of the levels of detail of a model, finest first; none of a model with one
 *  level. */
export function modelLevels(model: Object3D): Object3D[] {
    return (model.userData["levels"] as Object3D[] | undefined) ?? [];
}

/** Returns the part of a model that is shown: its visible level of detail, or all of it. */
export function shownPart(model: Object3D): Object3D {
    return modelLevels(model).find(({ visible }) => visible) ?? model;
}

/** Parses a GLB. Links to images are relative to the address `from`; they are fetched now, or later
 *  if shared textures are given. */
export async function parseModel(
    bytes: ArrayBuffer,
    from: string,
    sharedTextures?: DraftTextures,
): Promise<Object3D> {
    const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
    const linkedImages = new Map<string, string>();
    const thinness = new Set<Texture>();
    loader.register(translucency(thinness));
    if (sharedTextures) loader.register(sharedTextures.plugin(linkedImages, from));
    const file = await loader.parseAsync(bytes, new URL(".", from).href);
    const { scene } = file;
    scene.animations = file.animations;
    scene.userData["levels"] = await levelNodesOf(file);
    scene.userData["wind"] = windOf(file.asset);
    scene.userData["variants"] = new MaterialVariants(file);
    scene.userData["linkedImages"] = linkedImages;
    scene.userData["thinness"] = thinness;
    outlineSolids(scene);
    for (const mesh of meshesOf(scene)) {
        if (mesh.geometry.morphAttributes.position) useDerivativeTangents(mesh);
        mesh.castShadow = true;
        mesh.receiveShadow = true;
    }
    for (const texture of texturesOf(scene)) texture.anisotropy = 8;
    return scene;
}

/** Returns the bytes of a texture with its mipmaps, as RGBA; 0 while it is being loaded. */
function bytesOf({ image }: Texture): number {
    const { width = 0, height = 0 } = (image ?? {}) as { width?: number; height?: number };
    return (width * height * 4 * 4) / 3;
}

/** Returns the counts of the level of detail that is shown, and of all images. */
export function countsOf(model: Object3D): Counts {
    const textures = texturesOf(model);
    const imageBytes = [...textures].reduce((sum, texture) => sum + bytesOf(texture), 0);
    const counts = { triangles: 0, vertices: 0, drawCalls: 0, textures: textures.size, imageBytes };
    for (const mesh of meshesOf(shownPart(model))) {
        const { geometry } = mesh;
        const times = mesh instanceof InstancedMesh ? mesh.count : 1;
        const vertices = geometry.getAttribute("position")?.count ?? 0;
        counts.vertices += times * vertices;
        counts.triangles += (times * (geometry.index?.count ?? vertices)) / 3;
        counts.drawCalls += 1;
    }
    return counts;
}

/** Returns the node of a colony's roots and stems at the level of detail that is shown, undefined
 *  if it has none. */
export function stemsOf(model: Object3D): Object3D | undefined {
    let stems: Object3D | undefined;
    shownPart(model).traverse((node) => {
        if (node.name.endsWith("_stems")) stems ??= node;
    });
    return stems;
}

/** Returns the node of the wood that brackets grow on at the level of detail that is shown,
 *  undefined if there is none. */
export function woodOf(model: Object3D): Object3D | undefined {
    let wood: Object3D | undefined;
    shownPart(model).traverse((node) => {
        if (node.name.endsWith("_wood")) wood ??= node;
    });
    return wood;
}

/** Returns the bounds of the transformed vertices, metres. */
export function boundsOf(model: Object3D): Box3 {
    model.updateMatrixWorld(true);
    return new Box3().setFromObject(model, true);
}

/** Part of its height that a model which stands on the ground has below it at most. */
const mostBelow = 0.4;

/** Returns true for a model that has wood, or begins far below its origin: brackets, whose origin is
 *  where they grow out of a trunk. */
export function hangsOnWall(model: Object3D, { min, max }: Box3): boolean {
    return woodOf(model) !== undefined || min.y < -mostBelow * (max.y - min.y);
}

export function setWireframe(model: Object3D, shown: boolean): void {
    for (const mesh of meshesOf(model)) {
        for (const material of materialsOf(mesh)) {
            if ("wireframe" in material) material.wireframe = shown;
        }
    }
}

/** Frees the model's memory on the graphics card, and its decoded images. */
export function disposeModel(model: Object3D): void {
    for (const texture of texturesOf(model)) {
        // Shared textures of drafts stay; of a final model's texture only the image stays in use.
        if (texture.userData["shared"] && !texture.userData["imageShared"]) continue;
        const image: unknown = texture.image;
        texture.dispose();
        if (texture.userData["imageShared"]) continue;
        if (typeof ImageBitmap !== "undefined" && image instanceof ImageBitmap) image.close();
    }
    for (const mesh of meshesOf(model)) {
        mesh.geometry.dispose();
        for (const material of materialsOf(mesh)) material.dispose();
    }
    model.traverse((node) => {
        if (!(node instanceof LineSegments)) return;
        const { geometry, material } = node as LineSegments<BufferGeometry, Material>;
        geometry.dispose();
        material.dispose();
    });
}
