// The stage of a world: a scene in outdoor light and two cameras, one round a plot and one that flies; drawn only when
// something has changed.
import {
    Color,
    FogExp2,
    Group,
    PerspectiveCamera,
    Raycaster,
    Sphere,
    Vector2,
    Vector3,
    type Intersection,
    type Object3D,
    type Scene,
    type Texture,
    type WebGLRenderer,
} from "three";
import { CameraRig } from "../camera_rig";
import { litScene, type SceneLight } from "../lit_scene";
import { short } from "./view_address";

/** Sky and haze of wide views, in the colours of the page's style. */
const skyColour = 0xcdd5d2;
const haze = 0.0042;

/** Share of the side of a plot that its first camera stands south of its middle, and the height of eyes there, m. */
const firstStand = { south: 0.47, height: 1.65 };

export class WorldStage {
    readonly renderer: WebGLRenderer;
    readonly scene: Scene;
    /** What the plot consists of; its origin is on the ground in the middle of the plot. */
    readonly plot = new Group();
    /** What the tiles consist of; its origin is the centre of the world. */
    readonly tiles = new Group();
    readonly flyingCamera = new PerspectiveCamera(62, 1, 0.1, 3000);
    /** Called after each drawn frame. */
    onFrame: () => void = () => undefined;
    /** Called when the camera has moved. */
    onMoved: () => void = () => undefined;
    /** Called when somebody moves the camera of the plot, not the page. */
    onTurned: () => void = () => undefined;
    /** Called before each frame with the seconds since the last one; returns true if another has to follow. */
    onStep: (seconds: number) => boolean = () => false;
    /** Height of the ground below a place of the plot, from the middle of the plot. */
    groundOfPlot: (x: number, z: number) => number = () => 0;
    frames = 0;

    private readonly light: SceneLight;
    private readonly rig: CameraRig;
    private readonly raycaster = new Raycaster();
    private readonly forest: Color | Texture | null;
    private readonly sky = new Color(skyColour);
    private wide = false;
    private requested = false;
    private last = 0;
    private size = 10;

    constructor(
        private readonly host: HTMLElement,
        readonly canvas: HTMLCanvasElement,
        reducedMotion: boolean,
    ) {
        const { renderer, scene, light } = litScene(canvas, true, 0);
        this.renderer = renderer;
        this.scene = scene;
        this.light = light;
        light.use("overcast");
        light.sun.intensity = 1.5;
        scene.environmentIntensity = 0.85;
        renderer.toneMappingExposure = 1.25;
        this.forest = scene.background as Color | Texture | null;
        scene.add(this.plot, this.tiles);
        this.tiles.visible = false;
        this.rig = new CameraRig(canvas, reducedMotion, {
            moved: () => {
                this.draw();
                this.onMoved();
            },
            turned: () => this.onTurned(),
            chosen: (view) => view === "home" && this.lookHome(false),
        });
        this.rig.camera.fov = 55;
        this.rig.reach = 200;
        canvas.addEventListener("webglcontextrestored", () => this.draw());
        new ResizeObserver(() => this.resize()).observe(host);
        this.resize();
    }

    get camera(): PerspectiveCamera {
        return this.wide ? this.flyingCamera : this.rig.camera;
    }

    /** Shows the tiles instead of the plot. */
    set isWide(wide: boolean) {
        this.wide = wide;
        this.rig.enabled = !wide;
        this.plot.visible = !wide;
        this.tiles.visible = wide;
        this.scene.fog = wide ? new FogExp2(skyColour, haze) : null;
        this.scene.background = wide ? this.sky : this.forest;
        this.light.sun.castShadow = !wide;
        this.resize();
    }

    get isWide(): boolean {
        return this.wide;
    }

    /** Fits the light and the limits of the camera to a plot. */
    fitPlot(size: number): void {
        this.size = size;
        this.light.aim(new Sphere(new Vector3(0, 0.3, 0), size * 0.75));
        this.rig.limit(0.15, size * 4);
        this.draw();
    }

    /** Looks at the plot from its southern edge, as somebody who stands there. */
    lookHome(atOnce: boolean): void {
        const { size } = this;
        // A narrow picture shows the same width from farther away.
        const back = Math.max(1, 0.8 / this.rig.camera.aspect);
        const place = new Vector3(0, firstStand.height * back, firstStand.south * size * back);
        this.rig.moveTo(new Vector3(0, 0.3, -0.05 * size), place, atOnce);
    }

    /** Where the camera of the plot is and what it looks at, from the middle of the plot. */
    get plotLook(): number[] {
        return [...this.rig.camera.position.toArray(), ...this.rig.target.toArray()].map((value) => short(value));
    }

    /** Looks from a place at a target; returns false for numbers that are no such look. */
    lookFrom(look: readonly number[]): boolean {
        if (look.length !== 6) return false;
        const [place, target] = [new Vector3().fromArray([...look]), new Vector3().fromArray([...look], 3)];
        if (place.distanceTo(target) < 0.05 || place.length() > 400) return false;
        this.rig.moveTo(target, place, true);
        return true;
    }

    /** Direction in which the camera looks, clockwise from north, degrees. */
    get heading(): number {
        const direction = this.camera.getWorldDirection(new Vector3());
        return ((Math.atan2(direction.x, -direction.z) * 180) / Math.PI + 360) % 360;
    }

    /** Returns the ray through a place of the window. */
    rayAt(clientX: number, clientY: number): Raycaster {
        const { left, top, width, height } = this.canvas.getBoundingClientRect();
        const at = new Vector2(((clientX - left) / width) * 2 - 1, 1 - ((clientY - top) / height) * 2);
        this.camera.updateMatrixWorld();
        this.raycaster.setFromCamera(at, this.camera);
        return this.raycaster;
    }

    /** Returns the nearest of some objects below a place of the window. */
    hitAt(clientX: number, clientY: number, objects: readonly Object3D[]): Intersection | undefined {
        return this.rayAt(clientX, clientY).intersectObjects([...objects], true)[0];
    }

    /** Returns the height of an object at a place, 0 beside it. */
    heightOf(object: Object3D, x: number, z: number): number {
        this.raycaster.set(new Vector3(x, 500, z), new Vector3(0, -1, 0));
        return this.raycaster.intersectObject(object, true)[0]?.point.y ?? 0;
    }

    /** Requests a frame because something has changed; several requests at once make one frame. */
    draw(): void {
        if (this.requested) return;
        this.requested = true;
        requestAnimationFrame((now) => this.frame(now));
    }

    private frame(now: number): void {
        this.requested = false;
        const seconds = Math.min((now - this.last) / 1000, 0.1);
        this.last = now;
        if (!this.wide) this.updateRig();
        const goesOn = this.onStep(seconds);
        this.renderer.render(this.scene, this.camera);
        this.frames += 1;
        this.onFrame();
        if (goesOn) this.draw();
    }

    private updateRig(): void {
        this.rig.update();
        const { position } = this.rig.camera;
        const inside = Math.max(Math.abs(position.x), Math.abs(position.z)) < this.size / 2;
        const lowest = (inside ? this.groundOfPlot(position.x, position.z) : -0.3) + 0.06;
        if (position.y < lowest) position.y = lowest;
    }

    private resize(): void {
        const { clientWidth: width, clientHeight: height } = this.host;
        if (width === 0 || height === 0) return;
        this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
        this.renderer.setSize(width, height, false);
        for (const camera of [this.rig.camera, this.flyingCamera]) {
            camera.aspect = width / height;
            camera.updateProjectionMatrix();
        }
        this.draw();
    }
}
