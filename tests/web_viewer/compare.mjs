// Draws models alike and compares their pictures, in a page.
import {
    AmbientLight,
    Box3,
    DirectionalLight,
    PerspectiveCamera,
    Scene,
    Sphere,
    WebGLRenderer,
} from "three";

/** Side of the pictures and samples of a pixel in each direction. Crowns are nearly all edges: with
 *  one sample, what is compared is where it falls among them, not what is seen. */
const side = 320;
const samples = 2;

/** Returns a renderer that draws on the canvas of the page. */
export function pictureRenderer() {
    const canvas = document.querySelector("canvas");
    const renderer = new WebGLRenderer({ canvas, alpha: true, preserveDrawingBuffer: true });
    renderer.setSize(side * samples, side * samples, false);
    return renderer;
}

/** Returns a scene of a model under the lamps of all comparisons. */
export function litScene(model) {
    const scene = new Scene();
    const sun = new DirectionalLight(0xffffff, 2);
    sun.position.set(-1, 2, 1.5);
    scene.add(model, sun, new AmbientLight(0xffffff, 1));
    return scene;
}

/** Returns the means of samples x samples pixels of what a renderer has drawn on its square canvas:
 *  red, green, blue (multiplied by coverage) and coverage, 0 to 255, of a picture of side x side. */
export function averagedPixels(renderer, side, samples) {
    const gl = renderer.getContext();
    const wide = side * samples;
    const fine = new Uint8Array(4 * wide * wide);
    gl.readPixels(0, 0, wide, wide, gl.RGBA, gl.UNSIGNED_BYTE, fine);
    const pixels = new Float64Array(4 * side * side);
    for (let y = 0; y < wide; ++y)
        for (let x = 0; x < wide; ++x)
            for (let k = 0; k < 4; ++k)
                pixels[4 * (Math.floor(y / samples) * side + Math.floor(x / samples)) + k] +=
                    fine[4 * (y * wide + x) + k] / samples ** 2;
    return pixels;
}

/** Returns the pixels of a model, seen from the front, as RGBA, and its draw calls.
 *
 *  bounds    of the model
 *  distance  of the camera, in radii of the bounds; 4 fills the picture
 *  update    called with the camera before the model is drawn */
export function picture(
    renderer,
    model,
    { bounds = new Box3().setFromObject(model, true), distance = 4, update = () => {} } = {},
) {
    const scene = litScene(model);
    const ball = bounds.getBoundingSphere(new Sphere());
    const camera = new PerspectiveCamera(30, 1, ball.radius / 10, ball.radius * 5 * distance);
    camera.position.copy(ball.center);
    camera.position.z += ball.radius * distance;
    camera.position.y += ball.radius * 0.5;
    camera.lookAt(ball.center);
    camera.updateMatrixWorld();
    update(camera);
    renderer.render(scene, camera);
    const pixels = averagedPixels(renderer, side, samples);
    return { pixels, draws: renderer.info.render.calls };
}

/** Returns CIE L*a*b* (D65) of an sRGB colour. */
function lab(pixels, at) {
    const linear = [0, 1, 2].map((k) => {
        const c = pixels[at + k] / 255;
        return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
    });
    const [r, g, b] = linear;
    const xyz = [
        (0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505,
        0.2126 * r + 0.7152 * g + 0.0722 * b,
        (0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089,
    ].map((v) => (v > 0.008856 ? Math.cbrt(v) : 7.787 * v + 16 / 116));
    return [116 * xyz[1] - 16, 500 * (xyz[0] - xyz[1]), 200 * (xyz[1] - xyz[2])];
}

/** Returns the mean colour difference (CIE 1976 ΔE) of the pixels that either picture covers, their
 *  share of the picture, the share of them that differs visibly, and the draw calls of both. */
export function differenceOf(one, two) {
    const [first, second] = [one.pixels, two.pixels];
    let sum = 0;
    let covered = 0;
    let visible = 0;
    for (let at = 0; at < first.length; at += 4) {
        if (first[at + 3] === 0 && second[at + 3] === 0) continue;
        const [a, b] = [lab(first, at), lab(second, at)];
        const delta = Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
        sum += delta;
        ++covered;
        if (delta > 5) ++visible;
    }
    return {
        mean: sum / covered,
        covered: covered / (side * side),
        visible: visible / covered,
        draws: [one.draws, two.draws],
    };
}
