// A page that opens a file before and after the KTX2 tool; bundled and run by ktx2.test.mjs.
import { Mesh, Texture } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { KTX2Loader } from "three/addons/loaders/KTX2Loader.js";
import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";
import { differenceOf, picture, pictureRenderer } from "./compare.mjs";

const renderer = pictureRenderer();
const loader = new GLTFLoader()
    .setMeshoptDecoder(MeshoptDecoder)
    .setKTX2Loader(new KTX2Loader().setTranscoderPath("/basis/").detectSupport(renderer));

/** Returns the images of a model, each once. */
function texturesOf(model) {
    const textures = new Map();
    model.traverse((node) => {
        if (!(node instanceof Mesh)) return;
        for (const value of Object.values(node.material))
            if (value instanceof Texture) textures.set(value.source, value);
    });
    return [...textures.values()];
}

/** Returns the bytes of images with their mipmaps on the graphics card, as RGBA. */
function plainBytes(textures) {
    return textures.reduce((sum, { image }) => sum + (image.width * image.height * 4 * 4) / 3, 0);
}

/** Returns the number of compressed images, and the bytes of their mipmaps as they are uploaded. */
function compressed(textures) {
    const found = textures.filter(({ isCompressedTexture }) => isCompressedTexture);
    const mipmaps = found.flatMap((texture) => texture.mipmaps);
    return {
        count: found.length,
        formats: [...new Set(found.map(({ format }) => format))],
        bytes: mipmaps.reduce((sum, { data }) => sum + data.byteLength, 0),
    };
}

window.compare = async (before, after) => {
    const [first, second] = await Promise.all([before, after].map((url) => loader.loadAsync(url)));
    return {
        ...differenceOf(picture(renderer, first.scene), picture(renderer, second.scene)),
        before: plainBytes(texturesOf(first.scene)),
        after: compressed(texturesOf(second.scene)),
    };
};
