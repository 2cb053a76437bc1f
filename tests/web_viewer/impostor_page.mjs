// Draws a product as a mesh, as the cards of its impostor and by the shader of the client kit, and
// sets window.impostor to how far both are from the mesh. Bundled and run by clients.test.mjs.
//
//   ?server=...&product=mushrooms/x&side=40[&options=seed=3]
import { Box3, Color, PerspectiveCamera, Sphere, Vector3, WebGLRenderer } from "three";
import { Impostor, Sporeprint } from "../../web_viewer/clients/three/index.ts";
import { averagedPixels, litScene } from "./compare.mjs";

/** Azimuths and elevations of the camera, degrees: on frames, between them and low. */
const views = [
    [0, 0],
    [20, 12],
    [57, 25],
    [101, 40],
    [160, 8],
    [215, 30],
    [290, 60],
    [33, 82],
];

const query = new URLSearchParams(location.search);
const side = Number(query.get("side") ?? 40);
/** Samples of a pixel in each direction. */
const samples = 4;

/** Returns a camera that sees a ball, as large as the picture allows. */
function cameraOf(ball, [azimuth, elevation]) {
    // On a screen 1,080 pixels high, something of 40 pixels is seen at about two degrees.
    const angle = 3;
    const camera = new PerspectiveCamera(angle, 1, ball.radius, ball.radius * 100);
    const [a, e] = [azimuth, elevation].map((degrees) => (degrees * Math.PI) / 180);
    const distance = (1.04 * ball.radius) / Math.sin((0.5 * angle * Math.PI) / 180);
    const toward = new Vector3(Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e));
    camera.position.copy(ball.center).addScaledVector(toward, distance);
    camera.lookAt(ball.center);
    return camera;
}

/** Returns how many pixels a picture covers, and the mean colour of what it covers, 0 to 255. */
function meanOf(pixels) {
    let covered = 0;
    const colour = [0, 0, 0];
    for (let at = 0; at < pixels.length; at += 4) {
        covered += pixels[at + 3] / 255;
        for (let k = 0; k < 3; ++k) colour[k] += pixels[at + k];
    }
    return { covered, colour: colour.map((sum) => sum / covered) };
}

/** Returns the area that only one of two pictures covers, in areas of the first, and by how much
 *  the mean colour of what the second covers differs from that of the first, 0 to 255. Single pixels
 *  are not compared: few of a thin crown are covered as a whole. */
function compared(first, second) {
    let other = 0;
    for (let at = 3; at < first.length; at += 4) other += Math.abs(first[at] - second[at]) / 255;
    const [mean, otherMean] = [meanOf(first), meanOf(second)];
    return {
        outline: other / mean.covered,
        bias: mean.colour.map((one, k) => otherMean.colour[k] - one),
        covered: mean.covered / (side * side),
    };
}

async function run() {
    const sporeprint = new Sporeprint(query.get("server"));
    const [kind, name] = query.get("product").split("/");
    const options = query.get("options") ? `&${query.get("options")}` : "";
    const load = (lod) =>
        sporeprint.load(`${kind}/${name}.glb?lod=${lod}&image_format=webp${options}`);
    const [near, far] = [await load(query.get("lod") ?? 2), await load(4)];
    const canvas = document.querySelector("canvas");
    const renderer = new WebGLRenderer({
        canvas,
        alpha: true,
        antialias: false,
        preserveDrawingBuffer: true,
    });
    renderer.setSize(side * samples, side * samples, false);
    const ball = new Box3().setFromObject(near.scene, true).getBoundingSphere(new Sphere());
    const shaded = Impostor.of(far.scene);
    const scenes = [near.scene, far.scene, shaded.mesh()].map(litScene);
    const sheet = document.createElement("canvas");
    const shown = Math.max(side, 200);
    sheet.width = shown * views.length;
    sheet.height = shown * scenes.length;
    const context = sheet.getContext("2d");
    context.imageSmoothingEnabled = false;
    context.fillStyle = new Color(0x9aa88c).getStyle();
    context.fillRect(0, 0, sheet.width, sheet.height);
    const found = views.map((view, column) => {
        const camera = cameraOf(ball, view);
        const pixels = scenes.map((scene, row) => {
            renderer.render(scene, camera);
            const read = averagedPixels(renderer, side, samples);
            context.drawImage(canvas, column * shown, row * shown, shown, shown);
            return read;
        });
        return {
            view,
            cards: compared(pixels[0], pixels[1]),
            shader: compared(pixels[0], pixels[2]),
        };
    });
    return { views: found, picture: sheet.toDataURL("image/png") };
}

run().then(
    (result) => (window.impostor = result),
    (error) => (window.impostor = { error: String(error.stack ?? error) }),
);
