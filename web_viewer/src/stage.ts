// The stage: one model in daylight on a sheet of paper, drawn only when something has changed.
import {
    Box3,
    DirectionalLight,
    HemisphereLight,
    NeutralToneMapping,
    PCFShadowMap,
    PerspectiveCamera,
    PMREMGenerator,
    Scene,
    Sphere,
    Spherical,
    Vector3,
    WebGLRenderer,
    type Object3D,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { RoomEnvironment } from "three/addons/environments/RoomEnvironment.js";
import { distanceOf } from "./level_ranges";
import { fittingDistance, pixelsPerMetre, type Directions, type ViewName } from "./camera";
import { ContactShadow } from "./contact_shadow";
import { Ground } from "./ground";
import { Wind } from "../clients/three/wind";
import {
    boundsOf,
    disposeModel,
    modelLevels,
    modelVariants,
    modelWind,
    setWireframe,
    stemsOf,
    texturesOf,
} from "./model";
import { niceStep } from "./schema";
import { solidsOf } from "./solids";
import type { WindChannelView } from "./view_state";

/** Speed of the wind in which models sway, m/s. */
const breezeSpeed = 3;

/** Light from the upper left, as in the plates of field guides. */
const sunDirection = new Vector3(-0.55, 1.3, 0.66).normalize();

export interface Size {
    /** Height above the ground, metres; the whole height if all of it is below. */
    above: number;
    width: number;
    height: number;
    depth: number;
}

export interface StageStyle {
    /** Nothing moves by itself. */
    reducedMotion: boolean;
    /** The model may fill the picture, because nothing else is shown. */
    withoutMargins: boolean;
    /** Camera directions by name of a view. */
    directions: Directions;
    /** The model is lifted so that nothing of it is below the ground. */
    liesOnGround: boolean;
}

/** Returns a renderer and a lit scene, the same for the stage and for thumbnails. */
export function litScene(
    canvas: HTMLCanvasElement,
    antialias: boolean,
): {
    renderer: WebGLRenderer;
    scene: Scene;
    sun: DirectionalLight;
} {
    const renderer = new WebGLRenderer({ canvas, antialias, alpha: true });
    renderer.toneMapping = NeutralToneMapping;
    renderer.toneMappingExposure = 1;
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = PCFShadowMap;
    const scene = new Scene();
    const environment = new RoomEnvironment();
    const generator = new PMREMGenerator(renderer);
    scene.environment = generator.fromScene(environment, 0.04).texture;
    scene.environmentIntensity = 0.5;
    generator.dispose();
    environment.dispose();
    const sun = new DirectionalLight(0xfff2dd, 2.1);
    sun.castShadow = true;
    sun.shadow.mapSize.set(1024, 1024);
    sun.shadow.radius = 5;
    // Light reflected by the paper makes gills and pores visible from below.
    const bounce = new HemisphereLight(0x000000, 0xf1e4cb, 1.5);
    scene.add(sun, sun.target, bounce);
    return { renderer, scene, sun };
}

/** Fits the sun's shadow camera to a model of this size. */
export function aimSun(sun: DirectionalLight, ball: Sphere): void {
    const reach = ball.radius * 1.7;
    sun.target.position.copy(ball.center);
    sun.position
        .copy(sunDirection)
        .multiplyScalar(ball.radius * 4)
        .add(ball.center);
    const camera = sun.shadow.camera;
    Object.assign(camera, { left: -reach, right: reach, top: reach, bottom: -reach });
    camera.near = ball.radius;
    camera.far = ball.radius * 8;
    camera.updateProjectionMatrix();
    sun.shadow.normalBias = ball.radius * 0.006;
    sun.shadow.bias = -0.0006;
    sun.target.updateMatrixWorld();
}

export class Stage {
    readonly renderer: WebGLRenderer;
    readonly camera = new PerspectiveCamera(26, 1, 0.001, 10);
    /** Called after each drawn frame. */
    onFrame: () => void = () => undefined;

    private readonly scene: Scene;
    private readonly sun: DirectionalLight;
    private readonly controls: OrbitControls;
    private readonly ground = new Ground();
    private readonly contact = new ContactShadow();
    private model: Object3D | undefined;
    private bounds = new Box3();
    /** What has to be in the picture: the bounds, or those of roots and stems. */
    private framed = new Box3();
    private rootsOnly = false;
    private frameRequested = false;
    private movement = 0;
    private wireframe_ = false;
    private readonly wind = new Wind();
    private swaying_ = false;
    private solidsShown_ = true;
    private level = 0;
    /** Size on the screen at which the model is held, pixels; undefined to fill the picture. */
    private heldPixels: number | undefined;
    private waiters: (() => void)[] = [];

    constructor(
        private readonly host: HTMLElement,
        canvas: HTMLCanvasElement,
        private readonly style: StageStyle,
    ) {
        const { renderer, scene, sun } = litScene(canvas, true);
        this.renderer = renderer;
        this.scene = scene;
        this.sun = sun;
        this.scene.add(this.ground, this.contact);
        this.ground.visible = false;
        this.contact.visible = false;
        this.controls = new OrbitControls(this.camera, canvas);
        this.wind.velocity.set(0, 0);
        this.controls.enableDamping = !style.reducedMotion;
        this.controls.dampingFactor = 0.12;
        this.controls.zoomToCursor = true;
        this.controls.addEventListener("change", () => this.draw());
        this.controls.addEventListener("start", () => (this.movement += 1));
        canvas.addEventListener("keydown", (event) => this.onKey(event));
        canvas.addEventListener("webglcontextrestored", () => this.draw());
        new ResizeObserver(() => this.resize()).observe(host);
        this.resize();
    }

    /** Returns the size of the shown model, metres. */
    get size(): Size {
        const size = this.bounds.getSize(new Vector3());
        const above =
            this.bounds.max.y > 0 ? this.bounds.max.y - Math.max(this.bounds.min.y, 0) : size.y;
        return { above, width: size.x, height: size.y, depth: size.z };
    }

    get pixelsPerMetre(): number {
        return pixelsPerMetre(this.camera, this.controls.target, this.host.clientHeight);
    }

    /** Returns the metres between two lines on the ground. */
    get ruling(): number {
        const size = this.bounds.getSize(new Vector3());
        return niceStep(Math.max(size.x, size.y, size.z) / 5) || 0.01;
    }

    setColours(ink: string, shadow: string): void {
        this.ground.colours(ink, shadow);
        this.draw();
    }

    set ruled(shown: boolean) {
        this.ground.ruledLines = shown;
        this.draw();
    }

    set wireframe(shown: boolean) {
        this.wireframe_ = shown;
        if (this.model) setWireframe(this.model, shown);
        this.draw();
    }

    /** Lets models with weights of wind move in a breeze. */
    set swaying(on: boolean) {
        this.swaying_ = on;
        this.wind.velocity.set(on ? breezeSpeed : 0, 0);
        this.draw();
    }

    /** Shows weights of wind as colours; undefined for none. */
    set weightsShown(channel: WindChannelView | undefined) {
        this.wind.weightsShown = channel ?? false;
        this.draw();
    }

    /** Shows the solids for collision, if the model has any. */
    set solidsShown(shown: boolean) {
        this.solidsShown_ = shown;
        this.applySolids();
        this.draw();
    }

    /** Adds solids to the shown model, which owns them from now on. */
    addSolids(solids: Object3D): void {
        this.model?.add(solids);
        this.applySolids();
        this.draw();
    }

    /** Shows a level of detail of a file that has several, by its index, and holds the longest side
     *  of the model at a size on the screen, pixels; with undefined the model fills the picture. */
    showLevel(index: number, pixels: number | undefined): void {
        this.level = index;
        const changed = this.heldPixels !== pixels;
        this.heldPixels = pixels;
        this.applyLevel();
        if (this.model && changed) {
            this.limitZoom();
            this.fit();
        }
        this.draw();
    }

    /** Shows a variant of the material of the model; the requested one if it has none of this name. */
    async showVariant(name: string): Promise<void> {
        const model = this.model;
        if (!model) return;
        await modelVariants(model)?.show(name);
        const wind = modelWind(model);
        if (wind) this.wind.attach(model, wind);
        setWireframe(model, this.wireframe_);
        for (const texture of texturesOf(model)) texture.anisotropy = 8;
        this.draw();
    }

    /** Replaces the shown model, once the graphics card has the new one; returns false, and
     *  disposes of it, if it is no longer current. */
    async show(model: Object3D, refit: boolean, current: () => boolean): Promise<boolean> {
        setWireframe(model, this.wireframe_);
        const wind = modelWind(model);
        if (wind) this.wind.attach(model, wind);
        for (const texture of texturesOf(model)) this.renderer.initTexture(texture);
        if (this.renderer.getContext().getExtension("KHR_parallel_shader_compile")) {
            await this.renderer.compileAsync(model, this.camera, this.scene);
        }
        if (!current()) {
            disposeModel(model);
            return false;
        }
        const old = this.model;
        this.model = model;
        if (this.style.liesOnGround) model.position.y = -boundsOf(model).min.y;
        this.bounds = boundsOf(model);
        this.applyLevel();
        this.applySolids();
        this.scene.add(model);
        if (old) {
            this.scene.remove(old);
            disposeModel(old);
        }
        this.fitGround();
        if (refit || !old || this.outOfPicture()) this.fit(old ? undefined : "three-quarter", !old);
        this.draw();
        return true;
    }

    /** Updates the shadow on the ground: the model has another shape. */
    updateShadow(): void {
        this.castContact();
        this.draw();
    }

    /** Looks from a named side. */
    view(name: ViewName, atOnce = true): void {
        if (this.rootsOnly !== (name === "roots")) {
            this.rootsOnly = !this.rootsOnly;
            this.applyRootsOnly();
            this.castContact();
        }
        this.fit(name, atOnce);
    }

    /** Moves the camera so that the whole model is in the picture. */
    fit(name?: ViewName, atOnce = false): void {
        if (this.bounds.isEmpty()) return;
        const direction = name
            ? this.style.directions[name].clone()
            : this.camera.position.clone().sub(this.controls.target).normalize();
        if (direction.lengthSq() === 0) direction.copy(this.style.directions["three-quarter"]);
        const centre = this.framed.getCenter(new Vector3());
        if (this.heldPixels !== undefined) {
            const side = this.bounds.getSize(new Vector3());
            const coverage = this.heldPixels / (this.host.clientHeight || 1);
            const distance = distanceOf(
                Math.max(side.x, side.y, side.z),
                coverage,
                this.camera.fov,
            );
            const position = direction.multiplyScalar(distance).add(centre);
            return this.moveTo(centre, position, atOnce || this.style.reducedMotion);
        }
        const margin = this.style.withoutMargins
            ? { x: 0.06, y: 0.06 }
            : this.host.clientWidth < 520
              ? { x: 0.12, y: 0.3 }
              : { x: 0.14, y: 0.26 };
        const distance = fittingDistance(this.framed, direction, this.camera, margin);
        this.moveTo(
            centre,
            direction.multiplyScalar(distance).add(centre),
            atOnce || this.style.reducedMotion,
        );
    }

    /** Shows one of the levels of detail of the model, if it has several. */
    private applyLevel(): void {
        const levels = this.model ? modelLevels(this.model) : [];
        const shown = Math.min(this.level, levels.length - 1);
        levels.forEach((node, index) => (node.visible = index === shown));
        this.applyRootsOnly();
    }

    private applySolids(): void {
        if (!this.model) return;
        for (const solid of solidsOf(this.model)) solid.visible = this.solidsShown_;
    }

    /** Hides the individuals of a colony above their roots and stems, or shows them again. */
    private applyRootsOnly(): void {
        const stems = this.model && stemsOf(this.model);
        this.framed = this.rootsOnly && stems ? boundsOf(stems) : this.bounds;
        for (const node of stems?.parent?.children ?? [])
            if (node.userData["collision"] === undefined)
                node.visible = !this.rootsOnly || node === stems;
    }

    private limitZoom(): void {
        const { radius } = this.bounds.getBoundingSphere(new Sphere());
        this.controls.minDistance = radius * 0.4;
        this.controls.maxDistance = this.heldPixels === undefined ? radius * 24 : Infinity;
    }

    /** Requests a frame; several requests at once make one frame. */
    draw(): void {
        if (this.frameRequested) return;
        this.frameRequested = true;
        requestAnimationFrame(() => this.frame());
    }

    /** Resolves after the next drawn frame. */
    drawn(): Promise<void> {
        return new Promise((resolve) => {
            this.waiters.push(resolve);
            this.draw();
        });
    }

    private frame(): void {
        this.frameRequested = false;
        this.controls.update();
        this.wind.update(performance.now() / 1000);
        this.renderer.render(this.scene, this.camera);
        this.onFrame();
        const done = this.waiters;
        this.waiters = [];
        for (const resolve of done) resolve();
        if (this.swaying_ && this.model && modelWind(this.model)) this.draw();
    }

    private resize(): void {
        const { clientWidth: width, clientHeight: height } = this.host;
        if (width === 0 || height === 0) return;
        this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
        this.renderer.setSize(width, height, false);
        this.camera.aspect = width / height;
        this.camera.updateProjectionMatrix();
        if (this.model && this.outOfPicture()) this.fit(undefined, true);
        // Drawn at once: a resized canvas is empty until the next frame.
        if (this.model) this.frame();
    }

    private fitGround(): void {
        const ball = this.bounds.getBoundingSphere(new Sphere());
        aimSun(this.sun, ball);
        this.ground.visible = true;
        this.ground.fit(ball.radius, this.ruling);
        this.contact.visible = true;
        this.contact.position.y = ball.radius * 0.0015;
        this.castContact();
        this.limitZoom();
    }

    private castContact(): void {
        if (!this.model) return;
        const { min, max } = this.bounds;
        const half =
            Math.max(Math.abs(min.x), Math.abs(max.x), Math.abs(min.z), Math.abs(max.z)) * 1.6;
        this.contact.update(this.renderer, this.scene, this.model, half, max.y - min.y);
    }

    private outOfPicture(): boolean {
        if (this.heldPixels !== undefined) return true;
        const ball = this.framed.getBoundingSphere(new Sphere());
        const seen = ball.radius / (this.camera.position.distanceTo(ball.center) || 1);
        const half = Math.tan((this.camera.fov * Math.PI) / 360) * Math.min(1, this.camera.aspect);
        const off = this.controls.target.distanceTo(ball.center) / ball.radius;
        return seen > half * 1.05 || seen < half * 0.3 || off > 1.5;
    }

    private moveTo(target: Vector3, position: Vector3, atOnce: boolean): void {
        const movement = ++this.movement;
        const clip = (): void => {
            const distance = this.camera.position.distanceTo(this.controls.target);
            this.camera.near = distance / 60;
            this.camera.far = distance * 30;
            this.camera.updateProjectionMatrix();
        };
        if (atOnce) {
            this.controls.enableDamping = false;
            this.controls.target.copy(target);
            this.camera.position.copy(position);
            clip();
            this.controls.update();
            this.controls.enableDamping = !this.style.reducedMotion;
            this.draw();
            return;
        }
        const fromTarget = this.controls.target.clone();
        const from = new Spherical().setFromVector3(this.camera.position.clone().sub(fromTarget));
        const to = new Spherical().setFromVector3(position.clone().sub(target));
        let turn = to.theta - from.theta;
        turn -= Math.round(turn / (2 * Math.PI)) * 2 * Math.PI;
        const start = performance.now();
        const step = (now: number): void => {
            if (movement !== this.movement) return;
            const t = Math.min(Math.max((now - start) / 380, 0), 1);
            const s = t * t * (3 - 2 * t);
            const at = new Spherical(
                from.radius * (to.radius / from.radius) ** s,
                from.phi + (to.phi - from.phi) * s,
                from.theta + turn * s,
            );
            this.controls.target.lerpVectors(fromTarget, target, s);
            this.camera.position.setFromSpherical(at).add(this.controls.target);
            clip();
            this.draw();
            if (t < 1) requestAnimationFrame(step);
        };
        requestAnimationFrame(step);
    }

    private onKey(event: KeyboardEvent): void {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const turn = new Spherical().setFromVector3(
            this.camera.position.clone().sub(this.controls.target),
        );
        const step = Math.PI / 24;
        if (event.key === "ArrowLeft") turn.theta -= step;
        else if (event.key === "ArrowRight") turn.theta += step;
        else if (event.key === "ArrowUp") turn.phi -= step;
        else if (event.key === "ArrowDown") turn.phi += step;
        else if (event.key === "+" || event.key === "=") turn.radius *= 0.9;
        else if (event.key === "-") turn.radius /= 0.9;
        else if (event.key === "Home") {
            event.preventDefault();
            return this.fit("three-quarter");
        } else return;
        event.preventDefault();
        this.movement += 1;
        turn.phi = Math.min(Math.max(turn.phi, 0.01), Math.PI - 0.01);
        turn.radius = Math.min(
            Math.max(turn.radius, this.controls.minDistance),
            this.controls.maxDistance,
        );
        this.camera.position.setFromSpherical(turn).add(this.controls.target);
        this.draw();
    }
}
