// A page that opens files in Babylon.js and in glTF-Transform and tells what they read.
import { ArcRotateCamera } from "@babylonjs/core/Cameras/arcRotateCamera.js";
import { Engine } from "@babylonjs/core/Engines/engine.js";
import "@babylonjs/core/Loading/loadingScreen.js";
import { AppendSceneAsync } from "@babylonjs/core/Loading/sceneLoader.js";
import { MeshoptCompression } from "@babylonjs/core/Meshes/Compression/meshoptCompression.js";
import { Scene } from "@babylonjs/core/scene.js";
import "@babylonjs/loaders/glTF/index.js";
import { WebIO, getBounds } from "@gltf-transform/core";
import { ALL_EXTENSIONS } from "@gltf-transform/extensions";
import { MeshoptDecoder } from "three/examples/jsm/libs/meshopt_decoder.module.js";

// Babylon.js would load its decoder from a server of its own.
MeshoptCompression._Default = {
    decodeGltfBufferAsync: (source, count, stride, mode, filter) =>
        MeshoptDecoder.decodeGltfBufferAsync(count, stride, source, mode, filter),
};

const engine = new Engine(document.querySelector("canvas"));

/** Returns what a page that appends the file to a scene has. */
async function babylon(url) {
    const scene = new Scene(engine);
    scene.useRightHandedSystem = true;
    new ArcRotateCamera("camera", 1, 1, 1, undefined, scene);
    try {
        await AppendSceneAsync(url, scene, { pluginExtension: ".glb" });
        await scene.whenReadyAsync();
        const shown = scene.meshes.filter((mesh) => mesh.getTotalVertices() > 0);
        const box = scene.getWorldExtends((mesh) => shown.includes(mesh));
        const drawn = (mesh) =>
            (mesh.getTotalIndices() / 3) * Math.max(mesh.thinInstanceCount ?? 0, 1);
        return {
            min: box.min.asArray(),
            max: box.max.asArray(),
            triangles: shown.reduce((sum, mesh) => sum + drawn(mesh), 0),
            materials: new Set(shown.map(({ material }) => material?.name)).size,
            maps: shown.every(
                ({ material }) =>
                    material.albedoTexture?.isReady() &&
                    material.bumpTexture?.isReady() &&
                    material.metallicTexture?.isReady(),
            ),
            side: shown[0].material.albedoTexture?.getSize().width,
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

const io = new WebIO()
    .registerExtensions(ALL_EXTENSIONS)
    .registerDependencies({ "meshopt.decoder": MeshoptDecoder });

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
        materials: file.listMaterials().length,
        images: file.listTextures().map((texture) => [texture.getMimeType(), ...texture.getSize()]),
        clips: file.listAnimations().map((animation) => animation.getName()),
    };
}

await MeshoptDecoder.ready;
window.engines = { babylon, transform };
