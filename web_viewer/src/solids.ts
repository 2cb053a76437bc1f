// Solids for collision as edges: those that a file has as meshes, and those that the service
// describes for files that state them by OMI extensions, which three.js does not read.
import {
    BufferGeometry,
    CapsuleGeometry,
    EdgesGeometry,
    Group,
    LineBasicMaterial,
    LineSegments,
    Vector3,
    type Mesh,
    type Object3D,
} from "three";
import { ConvexGeometry } from "three/addons/geometries/ConvexGeometry.js";

/** The colour of the edges, which differs from those of mushrooms. */
const solidColour = 0x1f7a8c;

/** `collision` of the service's JSON about a model. */
export interface CollisionReport {
    shapes: {
        part: string;
        capsule?: { radius_m: number; height_m: number };
        convex?: { points_m: [number, number, number][] };
    }[];
    colliders: {
        shape: number;
        translation_m?: [number, number, number];
        rotation?: [number, number, number, number];
        scale?: number | [number, number, number];
    }[];
}

function edgesOf(geometry: BufferGeometry, part: unknown): LineSegments {
    const edges = new LineSegments(
        new EdgesGeometry(geometry, 12),
        // They are mostly inside the model, and shown through it.
        new LineBasicMaterial({
            color: solidColour,
            depthTest: false,
            transparent: true,
            opacity: 0.75,
        }),
    );
    edges.renderOrder = 1;
    edges.userData = { collision: part };
    return edges;
}

/** Returns the solids among the nodes of a model. */
export function solidsOf(model: Object3D): Object3D[] {
    const solids: Object3D[] = [];
    model.traverse((node) => {
        if (node.userData["collision"] !== undefined) solids.push(node);
    });
    return solids;
}

/** Replaces a mesh that stands for a solid by its edges: engines do not draw it, and here it would
 *  hide the model. */
export function outline(mesh: Mesh): void {
    const edges = edgesOf(mesh.geometry, mesh.userData["collision"]);
    edges.name = mesh.name;
    edges.position.copy(mesh.position);
    edges.quaternion.copy(mesh.quaternion);
    edges.scale.copy(mesh.scale);
    mesh.parent?.add(edges);
    mesh.removeFromParent();
}

/** Returns the solids that the service describes, as edges at their places. */
export function describedSolids({ shapes, colliders }: CollisionReport): Group {
    const geometries = shapes.map(({ capsule, convex }) => {
        if (convex) return new ConvexGeometry(convex.points_m.map((at) => new Vector3(...at)));
        if (!capsule) return new BufferGeometry();
        // The height of a capsule is that with its round ends.
        const { radius_m: radius, height_m: height } = capsule;
        return new CapsuleGeometry(radius, Math.max(height - 2 * radius, 0), 4, 12);
    });
    const group = new Group();
    for (const { shape, translation_m: at, rotation, scale } of colliders) {
        const geometry = geometries[shape];
        if (!geometry) continue;
        const edges = edgesOf(geometry, shapes[shape]?.part);
        if (at) edges.position.set(...at);
        if (rotation) edges.quaternion.set(...rotation);
        if (typeof scale === "number") edges.scale.setScalar(scale);
        else if (scale) edges.scale.set(...scale);
        group.add(edges);
    }
    for (const geometry of geometries) geometry.dispose();
    return group;
}
