// What flight.mjs runs in a browser: the tiles of the page of worlds (FlyView, with 3d-tiles-renderer), a camera that
// moves by steps, and no picture unless one is asked for, so that nothing here waits for a graphics card.
import { Color, DirectionalLight, FogExp2, Group, HemisphereLight, PerspectiveCamera, Scene, WebGLRenderer } from "three";
import { FlyView } from "../../web_viewer/src/world/fly_view.ts";
import { fetchHeights } from "../../web_viewer/src/world/height_field.ts";
import { firstState, layers } from "../../web_viewer/src/world/view_address.ts";

const size = { width: 1920, height: 1080 };
const camera = new PerspectiveCamera(62, size.width / size.height, 0.1, 3000);
const tiles = new Group();
const failures = [];
/** The window that tiles are chosen for; a renderer of three.js has the same two functions. */
const window_ = { getSize: (to) => to.set(size.width, size.height), getPixelRatio: () => 1 };
const stage = { renderer: window_, flyingCamera: camera, tiles, draw: () => undefined };
const view = new FlyView(stage, {
    shown: () => undefined,
    settled: () => undefined,
    failed: (failure) => failures.push(failure.message),
});

let world = "";
let heights;
let state = firstState;

/** Puts the eyes at a height above the ground of a place, looking to the east and a little down. */
function stand([x, y], above) {
    camera.position.set(x, heights.at(x, y) + above, -y);
    camera.rotation.set(0, -Math.PI / 2, 0, "YXZ");
    camera.rotateX((-8 * Math.PI) / 180);
}

const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** Loads what the camera sees until nothing is on its way; returns the seconds that it took. */
async function settle() {
    const begin = performance.now();
    do {
        view.update();
        await pause(1000 / 60);
    } while (!view.isSettled);
    return (performance.now() - begin) / 1000;
}

window.flight = {
    /** Begins in a world at a place on a day. */
    async begin(text, extent, place, above, year, day) {
        world = text;
        heights = await fetchHeights(world, extent, new AbortController().signal);
        state = { ...firstState, year, day };
        stand(place, above);
    },

    /** Shows a day; returns the seconds until all that is in view has come. */
    async show(day) {
        state = { ...state, day };
        view.show(world, state, false);
        return settle();
    },

    /** Flies to the east in steps of so many seconds; returns how much of the time something was on its way. */
    async fly([x, y], metres, speed, low, high, seconds) {
        const steps = Math.round(metres / speed / seconds);
        const found = { steps, sharp: 0, longest: 0, late: 0, memory: 0 };
        const begin = performance.now();
        let unsharp = 0;
        for (let step = 1; step <= steps; ++step) {
            const share = step / steps;
            stand([x + share * metres, y], low + (high - low) * (0.5 - 0.5 * Math.cos(2 * Math.PI * share)));
            view.update();
            unsharp = view.isSettled ? 0 : unsharp + seconds;
            found.sharp += view.isSettled ? 1 : 0;
            found.longest = Math.max(found.longest, unsharp);
            found.memory = Math.max(found.memory, view.memory.bytes);
            const due = begin + step * seconds * 1000;
            found.late = Math.max(found.late, performance.now() - due);
            await pause(Math.max(0, due - performance.now()));
        }
        found.seconds = (performance.now() - begin) / 1000;
        found.settled = await settle();
        return found;
    },

    report: () => ({ failures, memory: view.memory, visible: Object.fromEntries(layers.map((layer) => [layer, view.visibleTiles(layer)])) }),

    /** Draws what the camera sees; returns a PNG as a data URL. */
    picture() {
        const renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
        renderer.setSize(1280, 720, false);
        const scene = new Scene();
        scene.background = new Color(0xcdd5d2);
        scene.fog = new FogExp2(0xcdd5d2, 0.0042);
        const sun = new DirectionalLight(0xffffff, 2);
        sun.position.set(1, 2, 1);
        scene.add(tiles, sun, new HemisphereLight(0xdfe8f0, 0x6b5f4d, 2));
        renderer.render(scene, camera);
        return { url: renderer.domElement.toDataURL(), ...renderer.info.render };
    },
};
