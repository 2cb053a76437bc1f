// Variants of materials (KHR_materials_variants) for three.js: `variants=weather`.
import { Mesh, type Material, type Object3D } from "three";
import type { GLTF } from "three/addons/loaders/GLTFLoader.js";

const extension = "KHR_materials_variants";

interface Mapping {
    material: number;
    variants: number[];
}

/** The variants of the materials of a file. */
export class MaterialVariants {
    /** Their names, in the order of the file; empty for a file without variants. */
    readonly names: string[];

    private readonly original = new Map<Mesh, Material | Material[]>();
    private readonly loaded = new Set<Material>();
    private turn = 0;

    constructor(
        private readonly gltf: GLTF,
        private readonly root: Object3D = gltf.scene,
    ) {
        const json = gltf.parser.json as {
            extensions?: Record<string, { variants: { name: string }[] } | undefined>;
        };
        this.names = json.extensions?.[extension]?.variants.map(({ name }) => name) ?? [];
    }

    /** Shows a variant; the materials that the file was requested with if there is no such name. */
    async show(name: string): Promise<void> {
        const index = this.names.indexOf(name);
        const meshes: Mesh[] = [];
        this.root.traverse((node) => {
            if (node instanceof Mesh) meshes.push(node);
        });
        const turn = ++this.turn;
        await Promise.all(meshes.map((mesh) => this.assign(mesh, index, turn)));
    }

    /** Materials that were loaded for variants, which whoever disposes of the model frees too. */
    get materials(): ReadonlySet<Material> {
        return this.loaded;
    }

    /** @param turn of the call of show(): only the last one assigns materials */
    private async assign(mesh: Mesh, index: number, turn: number): Promise<void> {
        const extensions = mesh.userData["gltfExtensions"] as
            Record<string, { mappings: Mapping[] } | undefined> | undefined;
        const mapping = extensions?.[extension]?.mappings.find(({ variants }) =>
            variants.includes(index),
        );
        const original = this.original.get(mesh) ?? mesh.material;
        this.original.set(mesh, original);
        if (!mapping) {
            mesh.material = original;
            return;
        }
        const { parser } = this.gltf;
        const material = (await parser.getDependency("material", mapping.material)) as Material;
        if (turn !== this.turn) return;
        mesh.material = material;
        parser.assignFinalMaterial(mesh);
        this.loaded.add(mesh.material);
    }
}
