// The forest on a phone: 300 individuals of 12 species on a walk, from two files, drawn in one call
// for each material. The test of the clients runs it and reads window.forest.
//
//   ?server=http://127.0.0.1:8080&species=amanita_muscaria,boletus_edulis,...
import {
    Color,
    DirectionalLight,
    HemisphereLight,
    Matrix4,
    Mesh,
    PerspectiveCamera,
    PlaneGeometry,
    MeshBasicMaterial,
    Quaternion,
    Scene,
    Texture,
    Vector3,
    WebGLRenderer,
    type Material,
} from "three";
import {
    Field,
    Sporeprint,
    Wind,
    prototypesOf,
    windOf,
    type Placement,
    type Prototype,
} from "../index";

/** What the walk showed; largest values of all frames. */
export interface ForestReport {
    individuals: number;
    species: number;
    draws: number;
    triangles: number;
    /** Levels of detail that were shown of mushrooms, over all frames. */
    levels: number[];
    switches: number;
    imageBytes: number;
    colliders: number;
    /** Share of pixels that the wind changed in a second. */
    moved: number;
}

declare global {
    interface Window {
        forest?: ForestReport;
        forestError?: string;
    }
}

const individuals = 290;
const trees = 10;
const frames = 60;
const half = 6; // metres from the middle of the scene to its border

/** A small generator of random numbers, so that every run shows the same forest. */
function randomNumbers(seed: number): () => number {
    let state = seed;
    return () => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return state / 2 ** 32;
    };
}

function scattered(
    prototypes: Prototype[],
    count: number,
    reach: number,
    random: () => number,
): Placement[] {
    const up = new Vector3(0, 1, 0);
    return Array.from({ length: count }, (_, i) => ({
        prototype: i % prototypes.length,
        matrix: new Matrix4().compose(
            new Vector3((2 * random() - 1) * reach, 0, (2 * random() - 1) * reach),
            new Quaternion().setFromAxisAngle(up, 2 * Math.PI * random()),
            new Vector3().setScalar(0.8 + 0.4 * random()),
        ),
    }));
}

/** Returns the bytes of all images on the graphics card, with their mipmaps. */
function imageBytes(scene: Scene): number {
    const textures = new Set<Texture>();
    scene.traverse((node) => {
        if (!(node instanceof Mesh)) return;
        for (const value of Object.values(node.material as Material))
            if (value instanceof Texture) textures.add(value);
    });
    let bytes = 0;
    for (const { image } of textures) {
        const { width, height } = image as { width: number; height: number };
        bytes += (width * height * 4 * 4) / 3;
    }
    return bytes;
}

async function walk(server: string, species: string[]): Promise<ForestReport> {
    const sporeprint = new Sporeprint(server);
    const options = {
        profile: "web",
        lods: "msft",
        wind: "attribute",
        collision: "nodes",
    } as const;
    const [mushrooms, tree] = await Promise.all([
        sporeprint.loadSet({
            species,
            seeds: 2,
            levels: [1, 2, 3],
            share: "species",
            texture_size: 1024,
            ...options,
        }),
        sporeprint.load(`trees/birch.glb?lod=3&${new URLSearchParams(options).toString()}`),
    ]);
    const scene = new Scene();
    scene.background = new Color(0xb9ccd6);
    const sun = new DirectionalLight(0xfff2dd, 3);
    sun.position.set(-1, 2, 1.5);
    scene.add(new HemisphereLight(0xddeeff, 0x8a7a60, 3), sun);
    const ground = new Mesh(
        new PlaneGeometry(60, 60).rotateX(-Math.PI / 2),
        new MeshBasicMaterial({ color: 0x5d5a44 }),
    );
    scene.add(ground);
    const random = randomNumbers(7);
    const wind = new Wind();
    const fields: Field[] = [];
    let colliders = 0;
    for (const [file, count, reach] of [
        [mushrooms, individuals, half],
        [tree, trees, 2 * half],
    ] as const) {
        const prototypes = await prototypesOf(file);
        const field = new Field(prototypes, scattered(prototypes, count, reach, random));
        const extras = windOf(file.asset);
        if (!extras) throw new Error("a file has no wind");
        wind.attach(field, extras);
        scene.add(field);
        fields.push(field);
        const json = file.parser.json as { nodes: { name: string }[] };
        colliders += json.nodes.filter(({ name }) => name.startsWith("UCX_")).length;
    }
    const canvas = document.querySelector("canvas");
    if (!canvas) throw new Error("the page has no canvas");
    const renderer = new WebGLRenderer({ canvas, preserveDrawingBuffer: true });
    renderer.setSize(640, 360, false);
    const camera = new PerspectiveCamera(60, 640 / 360, 0.02, 60);
    const report: ForestReport = {
        individuals: individuals + trees,
        species: species.length,
        draws: 0,
        triangles: 0,
        levels: [],
        switches: 0,
        imageBytes: imageBytes(scene),
        colliders,
        moved: 0,
    };
    let before: string | undefined;
    for (let frame = 0; frame < frames; ++frame) {
        const t = frame / (frames - 1);
        camera.position.set(half * Math.cos(3 * t), 0.35 + 0.4 * t, half * (1 - 2 * t));
        camera.lookAt(0, 0.1, 0);
        camera.updateMatrixWorld();
        wind.update(t * 6);
        const [counts] = fields.map((field) => field.update(camera));
        const shown = JSON.stringify(counts?.levels);
        if (before !== undefined && shown !== before) report.switches += 1;
        before = shown;
        counts?.levels.forEach((count, level) => {
            report.levels[level] = Math.max(report.levels[level] ?? 0, count);
        });
        renderer.render(scene, camera);
        report.draws = Math.max(report.draws, renderer.info.render.calls);
        report.triangles = Math.max(report.triangles, renderer.info.render.triangles);
    }
    report.moved = moved(renderer, () => {
        wind.update(7);
        renderer.render(scene, camera);
    });
    return report;
}

/** Returns the share of pixels that drawing changes. */
function moved(renderer: WebGLRenderer, draw: () => void): number {
    const gl = renderer.getContext();
    const { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
    const read = (): Uint8Array => {
        const pixels = new Uint8Array(4 * width * height);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        return pixels;
    };
    const before = read();
    draw();
    const after = read();
    let different = 0;
    for (let i = 0; i < before.length; i += 4)
        if (before[i] !== after[i] || before[i + 1] !== after[i + 1]) different += 1;
    return different / (width * height);
}

const query = new URLSearchParams(location.search);
walk(query.get("server") ?? "", (query.get("species") ?? "").split(",")).then(
    (report) => (window.forest = report),
    (error: unknown) => (window.forestError = String(error)),
);

