// Many individuals of few prototypes, drawn in one call for each material, each at the level of
// detail that its size on the screen needs.
import {
    BatchedMesh,
    Box3,
    Group,
    InstancedMesh,
    Matrix4,
    Mesh,
    Sphere,
    Vector3,
    type BufferGeometry,
    type Material,
    type Object3D,
    type PerspectiveCamera,
} from "three";
import type { GLTF } from "three/addons/loaders/GLTFLoader.js";

/** A mesh of a level of detail, with its transform in the individual. */
interface Part {
    geometry: BufferGeometry;
    material: Material;
    matrix: Matrix4;
}

/** One level of detail of a prototype. */
export interface PrototypeLevel {
    parts: Part[];
    triangles: number;
    /** Height of the bounding box over that of the screen down to which this level is drawn. */
    coverage: number;
}

/** Something that a field shows any number of times. */
export interface Prototype {
    name: string;
    /** About its own origin, metres. */
    bounds: Box3;
    levels: PrototypeLevel[];
}

/** An individual of a field. */
export interface Placement {
    /** Index into the prototypes. */
    prototype: number;
    /** A rotation, a translation and an even scale. */
    matrix: Matrix4;
}

interface LevelExtras {
    lod: number;
    screen_coverage: number;
    /** Index of its node, in files of sets. */
    node?: number;
    /** Name of its node, where levels lie between the whole ones. */
    name?: string;
}

interface BoundsExtras {
    min: [number, number, number];
    max: [number, number, number];
}

interface IndividualExtras {
    name: string;
    bounds_m: BoundsExtras;
    levels: LevelExtras[];
}

/** What a file states in `asset.extras`, as far as it is used here. */
interface FileExtras {
    bounds_m: BoundsExtras;
    levels?: LevelExtras[];
    individuals?: IndividualExtras[];
}

function boxOf({ min, max }: BoundsExtras): Box3 {
    return new Box3(new Vector3(...min), new Vector3(...max));
}

/** Returns the meshes below a node, with transforms relative to the individual.
 *
 *  @param place removes the place of the node in its file: of a set, that on its grid */
function partsOf(node: Object3D, place: Matrix4): Part[] {
    const parts: Part[] = [];
    node.updateMatrixWorld(true);
    node.traverse((child) => {
        if (!(child instanceof Mesh) || child.userData["collision"] !== undefined) return;
        if (child instanceof InstancedMesh)
            throw new Error("a Field cannot draw instances of a file; ask without instancing=gpu");
        const { geometry, material } = child as Mesh<BufferGeometry, Material>;
        parts.push({ geometry, material, matrix: place.clone().multiply(child.matrixWorld) });
    });
    return parts;
}

/** Returns the prototypes of a file: the individuals of a set, or the one of a product with all of
 *  its levels of detail (`lods=msft` or `lods=nodes`).
 *
 *  @throws Error for a file that states no levels of detail */
export async function prototypesOf(gltf: GLTF): Promise<Prototype[]> {
    const { extras } = gltf.asset as { extras?: FileExtras };
    const json = gltf.parser.json as { nodes: { name?: string }[] };
    const individuals =
        extras?.individuals ??
        (extras?.levels
            ? [{ name: "", bounds_m: extras.bounds_m, levels: extras.levels }]
            : undefined);
    if (!individuals) throw new Error("the file states no levels of detail; ask for lods=msft");
    return Promise.all(
        individuals.map(async ({ name, bounds_m, levels }) => ({
            name,
            bounds: boxOf(bounds_m),
            levels: await Promise.all(
                levels.map(async ({ lod, screen_coverage, node, name: own }) => {
                    const isOf = (name: string | undefined): boolean =>
                        own === undefined ? !!name?.endsWith(`_LOD${lod}`) : name === own;
                    const index = node ?? json.nodes.findIndex(({ name }) => isOf(name));
                    if (index < 0) throw new Error(`the file has no node of level ${lod}`);
                    const object = (await gltf.parser.getDependency("node", index)) as Object3D;
                    const place = new Matrix4().makeTranslation(
                        object.position.clone().negate(),
                    );
                    const parts = partsOf(object, place);
                    const triangles = parts.reduce(
                        (sum, { geometry }) => sum + (geometry.index?.count ?? 0) / 3,
                        0,
                    );
                    return { parts, triangles, coverage: screen_coverage };
                }),
            ),
        })),
    );
}

/** The batch of a material, with an id for each of its geometries. */
interface Batch {
    mesh: BatchedMesh;
    geometries: Map<BufferGeometry, number>;
}

/** One individual, with the instances of each of its levels. */
interface Member {
    levels: { batch: BatchedMesh; instance: number }[][];
    prototype: Prototype;
    centre: Vector3;
    size: number;
    /** Index of the level that is shown; -1 for none. */
    shown: number;
}

/** What update() chose. */
export interface FieldCounts {
    individuals: number;
    triangles: number;
    /** Individuals by level of detail. */
    levels: number[];
}

/** Individuals in a scene: one draw call for each material. Call update() before each frame. */
export class Field extends Group {
    /** A level is left only when its size on the screen is wrong by this share, so that individuals
     *  at the limit do not flicker. */
    hysteresis = 0.15;

    private readonly members: Member[] = [];

    /** @param prototypes of one or several files; their materials and geometries stay theirs */
    constructor(prototypes: readonly Prototype[], placements: readonly Placement[]) {
        super();
        const batches = batchesOf(prototypes, placements);
        for (const { mesh } of new Set(batches.values())) this.add(mesh);
        for (const { prototype: index, matrix } of placements) {
            const prototype = prototypes[index];
            if (!prototype) throw new Error(`there is no prototype ${index}`);
            const ball = prototype.bounds.getBoundingSphere(new Sphere()).applyMatrix4(matrix);
            const { x, y, z } = prototype.bounds.getSize(new Vector3());
            this.members.push({
                prototype,
                centre: ball.center,
                size: Math.max(x, y, z) * matrix.getMaxScaleOnAxis(),
                shown: -1,
                levels: prototype.levels.map(({ parts }) =>
                    parts.map((part) => {
                        const batch = batches.get(part.material);
                        const geometry = batch?.geometries.get(part.geometry);
                        if (!batch || geometry === undefined)
                            throw new Error("a part has no batch");
                        const instance = batch.mesh.addInstance(geometry);
                        batch.mesh.setMatrixAt(instance, matrix.clone().multiply(part.matrix));
                        batch.mesh.setVisibleAt(instance, false);
                        return { batch: batch.mesh, instance };
                    }),
                ),
            });
        }
    }

    /** Chooses the level of every individual for a camera; what is outside its view is skipped when
     *  it is drawn. Individuals smaller than their last level is made for are not drawn. */
    update(camera: PerspectiveCamera): FieldCounts {
        const eye = camera.getWorldPosition(new Vector3());
        this.worldToLocal(eye);
        const perHeight = 1 / (2 * Math.tan((camera.fov * Math.PI) / 360));
        const counts: FieldCounts = { individuals: 0, triangles: 0, levels: [] };
        for (const member of this.members) {
            const coverage = (member.size * perHeight) / eye.distanceTo(member.centre);
            this.show(member, levelFor(member, coverage, this.hysteresis));
            if (member.shown < 0) continue;
            counts.individuals += 1;
            counts.triangles += member.prototype.levels[member.shown]?.triangles ?? 0;
            counts.levels[member.shown] = (counts.levels[member.shown] ?? 0) + 1;
        }
        return counts;
    }

    /** Frees the memory of the batches; the prototypes stay. */
    override dispose(): void {
        for (const child of this.children) if (child instanceof BatchedMesh) child.dispose();
    }

    private show(member: Member, level: number): void {
        if (level === member.shown) return;
        for (const { batch, instance } of member.levels[member.shown] ?? [])
            batch.setVisibleAt(instance, false);
        for (const { batch, instance } of member.levels[level] ?? [])
            batch.setVisibleAt(instance, true);
        member.shown = level;
    }
}

/** Returns the index of the level for a size on the screen; -1 if it is too small for all. */
function levelFor({ prototype, shown }: Member, coverage: number, hysteresis: number): number {
    const first = (size: number): number =>
        prototype.levels.findIndex((level) => size >= level.coverage);
    const wanted = first(coverage);
    if (wanted === shown) return shown;
    // The shown level stays while a slightly different size would still choose it.
    const [larger, smaller] = [first(coverage * (1 + hysteresis)), first(coverage / (1 + hysteresis))];
    return shown === larger || shown === smaller ? shown : wanted;
}

/** Returns an empty batch with capacity for all instances for each material, and its geometries. */
function batchesOf(
    prototypes: readonly Prototype[],
    placements: readonly Placement[],
): Map<Material, Batch> {
    interface Capacity {
        instances: number;
        geometries: Set<BufferGeometry>;
    }
    const capacities = new Map<Material, Capacity>();
    for (const { prototype } of placements)
        for (const { parts } of prototypes[prototype]?.levels ?? [])
            for (const { material, geometry } of parts) {
                const capacity = capacities.get(material) ?? { instances: 0, geometries: new Set() };
                capacities.set(material, capacity);
                capacity.instances += 1;
                capacity.geometries.add(geometry);
            }
    const batches = new Map<Material, Batch>();
    for (const [material, { instances, geometries }] of capacities) {
        let vertices = 0;
        let indices = 0;
        for (const geometry of geometries) {
            vertices += geometry.getAttribute("position").count;
            indices += geometry.index?.count ?? 0;
        }
        const mesh = new BatchedMesh(instances, vertices, indices, material);
        mesh.name = material.name;
        mesh.castShadow = mesh.receiveShadow = true;
        const ids = new Map<BufferGeometry, number>();
        for (const geometry of geometries) ids.set(geometry, mesh.addGeometry(geometry));
        batches.set(material, { mesh, geometries: ids });
    }
    return batches;
}
