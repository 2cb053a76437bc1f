// The levels of detail inside one file: three.js shows all levels of `lods=nodes` at once and the
// first of `lods=msft`; the page shows one of them.
import type { Object3D } from "three";
import type { GLTF } from "three/addons/loaders/GLTFLoader.js";

interface NodeJson {
    name?: string;
    children?: number[];
    extensions?: { MSFT_lod?: { ids: number[] } };
}

/** Returns the indices of the nodes of the levels of a file, finest first; fewer than two for a
 *  file of one level. */
function levelIndices(nodes: readonly NodeJson[]): number[] {
    const first = nodes.findIndex(({ extensions }) => extensions?.MSFT_lod);
    if (first >= 0) return [first, ...(nodes[first]?.extensions?.MSFT_lod?.ids ?? [])];
    const below = new Set<number>();
    const collect = (index: number): void => {
        for (const child of nodes[index]?.children ?? []) {
            below.add(child);
            collect(child);
        }
    };
    const named = nodes.flatMap(({ name }, index) =>
        /_LOD\d+$/.test(name ?? "") && !name?.startsWith("UCX_") ? [index] : [],
    );
    for (const index of named) collect(index);
    return named.filter((index) => !below.has(index));
}

/** Returns the nodes of the levels of a file, finest first, all of them in its scene; none if the
 *  file has one level. All but the first are hidden. */
export async function levelNodesOf(file: GLTF): Promise<Object3D[]> {
    const { extras } = file.asset as { extras?: { levels?: unknown[] } };
    const indices = levelIndices((file.parser.json as { nodes?: NodeJson[] }).nodes ?? []);
    if (indices.length < 2 || indices.length !== extras?.levels?.length) return [];
    const levels = await Promise.all(
        indices.map((index) => file.parser.getDependency("node", index) as Promise<Object3D>),
    );
    for (const level of levels) {
        if (!level.parent) levels[0]?.parent?.add(level);
        level.visible = level === levels[0];
    }
    return levels;
}
