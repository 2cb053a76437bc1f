// Draws products with three.js in three sizes and sets window.specks to the pixels that look like
// light through a crack between triangles or a normal gone astray: brighter or darker than all eight
// neighbours by a quarter of the range, and shown at that place by neither larger picture. The tip of a
// spine is in the larger ones. Bundled and run by clients.test.mjs; the pictures of core are tested
// alike in tests/core/grow/mushroom_properties_test.cpp.
//
//   ?server=...&product=mushrooms/x.glb%3Fseed=3&azimuth=40&elevation=20
import { Box3, Color, PerspectiveCamera, Sphere, WebGLRenderer } from "three";
import { Sporeprint } from "../../web_viewer/clients/three/index.ts";
import { averagedPixels, litScene } from "./compare.mjs";

const query = new URLSearchParams(location.search);
const side = 256;
/** Samples of a pixel in each direction. */
const samples = 2;
const stark = 64;

/** Returns the luminance, 0 to 255, of the pixels of a square picture over grey. */
function luminances(renderer, scene, camera, size) {
    renderer.setSize(size * samples, size * samples, false);
    renderer.render(scene, camera);
    const pixels = averagedPixels(renderer, size, samples);
    const light = Float64Array.from({ length: size * size }, (_, i) => {
        const [red, green, blue] = pixels.subarray(4 * i, 4 * i + 3);
        return 0.299 * red + 0.587 * green + 0.114 * blue;
    });
    return { light, size };
}

/** Returns true if a larger picture shows a luminance at the place of a pixel or beside it. */
function isShown({ light, size }, x, y, wanted) {
    const times = size / side;
    for (let v = times * y - 1; v <= times * (y + 1); ++v)
        for (let u = times * x - 1; u <= times * (x + 1); ++u)
            if (Math.abs(light[v * size + u] - wanted) < stark / 2) return true;
    return false;
}

function specksIn(picture, larger) {
    const found = [];
    for (let y = 1; y + 1 < side; ++y)
        for (let x = 1; x + 1 < side; ++x) {
            const here = picture.light[y * side + x];
            const apart = [];
            for (const v of [y - 1, y, y + 1])
                for (const u of [x - 1, x, x + 1])
                    if (u !== x || v !== y) apart.push(here - picture.light[v * side + u]);
            if (Math.min(...apart) < stark && Math.max(...apart) > -stark) continue;
            if (!larger.some((one) => isShown(one, x, y, here))) found.push([x, y]);
        }
    return found;
}

async function search() {
    const sporeprint = new Sporeprint(query.get("server"));
    const { scene: model } = await sporeprint.load(query.get("product"));
    const canvas = document.querySelector("canvas");
    const renderer = new WebGLRenderer({ canvas, preserveDrawingBuffer: true });
    const scene = litScene(model);
    scene.background = new Color(0x808080);
    const ball = new Box3().setFromObject(model, true).getBoundingSphere(new Sphere());
    const camera = new PerspectiveCamera(30, 1, ball.radius / 10, ball.radius * 20);
    const [azimuth, elevation] = ["azimuth", "elevation"].map(
        (name) => (Number(query.get(name)) * Math.PI) / 180,
    );
    camera.position.setFromSphericalCoords(4 * ball.radius, Math.PI / 2 - elevation, azimuth);
    camera.position.add(ball.center);
    camera.lookAt(ball.center);
    const pictures = [1, 2, 4].map((times) => luminances(renderer, scene, camera, times * side));
    renderer.dispose();
    const covered = pictures[0].light.filter((light) => Math.abs(light - 128) > 4).length;
    return { found: specksIn(pictures[0], pictures.slice(1)), covered: covered / side ** 2 };
}

search().then(
    (result) => (window.specks = result),
    (error) => (window.specks = { error: String(error) }),
);
