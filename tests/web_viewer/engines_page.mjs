// A page that opens files in Babylon.js, three.js and glTF-Transform and tells what they read.
import { ArcRotateCamera } from "@babylonjs/core/Cameras/arcRotateCamera.js";
import { FreeCamera } from "@babylonjs/core/Cameras/freeCamera.js";
import { Engine } from "@babylonjs/core/Engines/engine.js";
import "@babylonjs/core/Loading/loadingScreen.js";
import { AppendSceneAsync } from "@babylonjs/core/Loading/sceneLoader.js";
import { MeshoptCompression } from "@babylonjs/core/Meshes/Compression/meshoptCompression.js";
import { Vector3 as BabylonVector3 } from "@babylonjs/core/Maths/math.vector.js";
import { Scene } from "@babylonjs/core/scene.js";
import "@babylonjs/loaders/glTF/index.js";
import { WebIO, getBounds } from "@gltf-transform/core";
import { ALL_EXTENSIONS } from "@gltf-transform/extensions";
import { ImplicitTilingPlugin } from "3d-tiles-renderer/core/plugins";
import { TilesRenderer as BabylonTiles } from "3d-tiles-renderer/babylonjs";
import { TilesRenderer as ThreeTiles } from "3d-tiles-renderer/three";
import { Box3, Mesh, PerspectiveCamera, TextureLoader } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";

// Babylon.js would load its decoder from a server of its own.
MeshoptCompression._Default = {
    decodeGltfBufferAsync: (source, count, stride, mode, filter) =>
        MeshoptDecoder.decodeGltfBufferAsync(count, stride, source, mode, filter),
};

const engine = new Engine(document.querySelector("canvas"));

/** Returns what a page that appends the file to a scene has. */
async function babylon(url, gltf = {}) {
    const scene = new Scene(engine);
    scene.useRightHandedSystem = true;
    new ArcRotateCamera("camera", 1, 1, 1, undefined, scene);
    try {
        await AppendSceneAsync(url, scene, { pluginExtension: ".glb", pluginOptions: { gltf } });
        await scene.whenReadyAsync();
        const shown = scene.meshes.filter((mesh) => mesh.getTotalVertices() > 0);
        const box = scene.getWorldExtends((mesh) => shown.includes(mesh));
        const drawn = (mesh) =>
            (mesh.getTotalIndices() / 3) * Math.max(mesh.thinInstanceCount ?? 0, 1);
        return {
            min: box.min.asArray(),
            max: box.max.asArray(),
            triangles: shown.reduce((sum, mesh) => sum + drawn(mesh), 0),
            drawn: shown.reduce((sum, mesh) => sum + Math.max(mesh.thinInstanceCount ?? 0, 1), 0),
            materials: new Set(shown.map(({ material }) => material?.name)).size,
            pictured: shown.filter(({ material }) => material?.albedoTexture?.isReady()).length,
            maps: shown.every(
                ({ material }) =>
                    material.albedoTexture?.isReady() &&
                    material.bumpTexture?.isReady() &&
                    material.metallicTexture?.isReady(),
            ),
            side: shown[0]?.material.albedoTexture?.getSize().width,
            clips: scene.animationGroups.map(({ name }) => name),
            weights: scene.animationGroups.flatMap((clip) =>
                [clip.from, clip.to].map((frame) => {
                    clip.start();
                    clip.goToFrame(frame);
                    const targets = shown[0].morphTargetManager;
                    return [...Array(targets.numTargets).keys()].map(
                        (i) => targets.getTarget(i).influence,
                    );
                }),
            ),
        };
    } finally {
        scene.dispose();
    }
}

/** Does the same with a file that refers to others above its folder: Babylon.js refuses ".." without this option. */
const babylonLinked = (url) => babylon(url, { preprocessUrlAsync: (address) => Promise.resolve(address) });

const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);

/** Returns what a page that adds the file to a scene of three.js has. */
async function three(url) {
    const { scene } = await loader.loadAsync(url);
    const meshes = [];
    scene.traverse((node) => node instanceof Mesh && meshes.push(node));
    const box = new Box3().setFromObject(scene);
    const count = (mesh) => mesh.count ?? 1;
    return {
        min: box.min.toArray(),
        max: box.max.toArray(),
        triangles: meshes.reduce((sum, mesh) => sum + (mesh.geometry.index.count / 3) * count(mesh), 0),
        drawn: meshes.reduce((sum, mesh) => sum + count(mesh), 0),
        pictured: meshes.filter(({ material }) => material.map?.image.width > 0).length,
    };
}

/** Returns the size of an image and, of a grid of its pixels, row by row, the greens, from 0 to 255. */
async function map(url, side) {
    const { image } = await new TextureLoader().loadAsync(url);
    const { width, height } = image;
    const context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, width, height);
    const at = (i, length) => Math.floor(((i + 0.5) * length) / side);
    const pixels = Array.from({ length: side * side }, (_, i) => data[4 * (at(Math.floor(i / side), height) * width + at(i % side, width)) + 1]);
    return { width, height, pixels };
}

/** Lets a renderer of tiles load all that is in view; returns what has come, by layer. */
async function streamed(tiles, update) {
    const found = { failed: [], loaded: {} };
    tiles.registerPlugin(new ImplicitTilingPlugin());
    // Only what is near is shown in full, so that the test does not take long.
    tiles.errorTarget = 160;
    tiles.addEventListener("load-model", ({ url }) => {
        const layer = new URL(url).pathname.split("/").at(-4);
        found.loaded[layer] = (found.loaded[layer] ?? 0) + 1;
    });
    tiles.addEventListener("load-error", ({ url, error }) => found.failed.push(`${url}: ${error.message}`));
    for (let quiet = 0; quiet < 5; ) {
        await new Promise((resolve) => setTimeout(resolve, 20));
        update();
        const { queued, downloading, parsing } = tiles.stats;
        quiet = tiles.root && queued + downloading + parsing === 0 ? quiet + 1 : 0;
        if (!tiles.root && found.failed.length > 0) break;
    }
    found.visible = tiles.visibleTiles.size;
    tiles.dispose();
    return found;
}

/** Streams a tileset in three.js from a place to the east, up and to the south of the centre of the world. */
function streamedInThree([url, place]) {
    const tiles = new ThreeTiles(url);
    tiles.manager.addHandler(/\.glb$/, new GLTFLoader(tiles.manager));
    // Tiles have z up.
    tiles.group.rotation.x = -Math.PI / 2;
    const camera = new PerspectiveCamera(60, 4 / 3, 0.1, 2000);
    camera.position.set(...place);
    return streamed(tiles, () => {
        tiles.group.updateMatrixWorld(true);
        camera.updateMatrixWorld();
        tiles.setCamera(camera);
        tiles.setResolution(camera, 400, 300);
        tiles.update();
    });
}

/** Streams a tileset in Babylon.js from such a place. */
async function streamedInBabylon([url, place]) {
    const scene = new Scene(engine);
    scene.useRightHandedSystem = true;
    const camera = new FreeCamera("camera", new BabylonVector3(...place), scene);
    camera.setTarget(new BabylonVector3(place[0], place[1], place[2] - 1));
    const tiles = new BabylonTiles(url, scene);
    tiles.group.rotation.x = -Math.PI / 2;
    try {
        return await streamed(tiles, () => {
            camera.computeWorldMatrix();
            scene.updateTransformMatrix();
            tiles.group.computeWorldMatrix(true);
            tiles.update();
        });
    } finally {
        scene.dispose();
    }
}

const io = new WebIO()
    .registerExtensions(ALL_EXTENSIONS)
    .registerDependencies({ "meshopt.decoder": MeshoptDecoder });

/** Returns how often a node shows its mesh. */
function instancesOf(node) {
    return node.getExtension("EXT_mesh_gpu_instancing")?.getAttribute("TRANSLATION").getCount() ?? 1;
}

/** Returns what a tool that reads and writes the file has. */
async function transform(url) {
    const document = await io.read(url);
    const file = document.getRoot();
    const meshes = file.listNodes().filter((node) => node.getMesh());
    return {
        ...getBounds(file.getDefaultScene()),
        extensions: file.listExtensionsUsed().map(({ extensionName }) => extensionName),
        nodes: meshes.map((node) => node.getName()),
        triangles: meshes.map((node) =>
            node
                .getMesh()
                .listPrimitives()
                .reduce((sum, primitive) => sum + primitive.getIndices().getCount() / 3, 0),
        ),
        stated: file.getAsset().extras.triangles,
        drawn: meshes.reduce((sum, node) => sum + node.getMesh().listPrimitives().length * instancesOf(node), 0),
        pictured: meshes.flatMap((node) => node.getMesh().listPrimitives()).filter((primitive) => primitive.getMaterial().getBaseColorTexture()).length,
        ids: meshes.flatMap((node) => node.getExtras().ids ?? node.getExtras().id ?? []),
        materials: file.listMaterials().length,
        images: file.listTextures().map((texture) => [texture.getMimeType(), ...(texture.getSize() ?? [])]),
        clips: file.listAnimations().map((animation) => animation.getName()),
    };
}

await MeshoptDecoder.ready;
window.engines = { babylon, babylonLinked, three, transform, map, streamedInThree, streamedInBabylon };
