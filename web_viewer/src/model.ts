// A parsed GLB on its way to the stage and off it again: reading, measuring, counting, freeing.
import {
    Box3,
    InstancedMesh,
    Mesh,
    MeshStandardMaterial,
    Texture,
    type Material,
    type Object3D,
} from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import type { Paint } from "./paint";

export interface Counts {
    triangles: number;
    vertices: number;
    drawCalls: number;
    textures: number;
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
    const textures = new Set<Texture>();
    for (const mesh of meshesOf(model)) {
        for (const material of materialsOf(mesh)) {
            for (const value of Object.values(material)) {
                if (value instanceof Texture) textures.add(value);
            }
        }
    }
    return textures;
}

/** Morph targets turn normals, but the tangents of the file stay: where a face turns far, both would meet. The
 *  tangents that three derives from positions and texture coordinates turn with the face. */
function useDerivativeTangents(mesh: Mesh): void {
    if (!mesh.geometry.getAttribute("tangent")) return;
    mesh.geometry.deleteAttribute("tangent");
    for (const material of materialsOf(mesh)) {
        // As the loader does for files without tangents.
        if (material instanceof MeshStandardMaterial) material.normalScale.y *= -1;
    }
}

/** Addresses of the linked images that a model lent its paint still waits for, by what they are. */
export function paintOf(model: Object3D): Map<string, string> {
    return (
        (model.userData["paint"] as Map<string, string> | undefined) ?? new Map<string, string>()
    );
}

/** Reads GLB bytes that came from an address, which links to images are resolved against; those are fetched now, or with `paint` lent
 *  now and fetched later. */
export async function parseModel(
    bytes: ArrayBuffer,
    from: string,
    paint?: Paint,
): Promise<Object3D> {
    const loader = new GLTFLoader();
    const late = new Map<string, string>();
    if (paint) loader.register(paint.plugin(late, from));
    const { scene, animations } = await loader.parseAsync(bytes, new URL(".", from).href);
    scene.animations = animations;
    scene.userData["paint"] = late;
    for (const mesh of meshesOf(scene)) {
        if (mesh.geometry.morphAttributes.position) useDerivativeTangents(mesh);
        mesh.castShadow = true;
        mesh.receiveShadow = true;
    }
    for (const texture of texturesOf(scene)) texture.anisotropy = 8;
    return scene;
}

export function countsOf(model: Object3D): Counts {
    const counts = { triangles: 0, vertices: 0, drawCalls: 0, textures: texturesOf(model).size };
    for (const mesh of meshesOf(model)) {
        const { geometry } = mesh;
        const times = mesh instanceof InstancedMesh ? mesh.count : 1;
        const vertices = geometry.getAttribute("position")?.count ?? 0;
        counts.vertices += times * vertices;
        counts.triangles += (times * (geometry.index?.count ?? vertices)) / 3;
        counts.drawCalls += 1;
    }
    return counts;
}

/** What the caps of a colony stand on, roots and stems; undefined where nothing is but individuals. */
export function stemsOf(model: Object3D): Object3D | undefined {
    return model.children.find(({ name }) => name === "stems");
}

/** Bounds of the vertices themselves, metres. */
export function boundsOf(model: Object3D): Box3 {
    model.updateMatrixWorld(true);
    return new Box3().setFromObject(model, true);
}

export function setWireframe(model: Object3D, shown: boolean): void {
    for (const mesh of meshesOf(model)) {
        for (const material of materialsOf(mesh)) {
            if ("wireframe" in material) material.wireframe = shown;
        }
    }
}

/** Frees all that a model holds on the graphics card, and its decoded images. */
export function disposeModel(model: Object3D): void {
    for (const texture of texturesOf(model)) {
        // Paint that drafts share stays; of a finished model's texture only the image goes on living.
        if (texture.userData["shared"] && !texture.userData["lent"]) continue;
        const image: unknown = texture.image;
        texture.dispose();
        if (texture.userData["lent"]) continue;
        if (typeof ImageBitmap !== "undefined" && image instanceof ImageBitmap) image.close();
    }
    for (const mesh of meshesOf(model)) {
        mesh.geometry.dispose();
        for (const material of materialsOf(mesh)) material.dispose();
    }
}
