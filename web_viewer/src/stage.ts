// The stage: one model in one of the lights on the ground, drawn only when something has changed.
import { Box3, Sphere, Vector3, type Object3D, type Scene, type WebGLRenderer } from "three";
import { distanceOf } from "./level_ranges";
import { Backdrop } from "./backdrop";
import {
    fittingDistance,
    framingDistance,
    isCloseUp,
    pixelsPerMetre,
    type Directions,
    type LookName,
    type ViewName,
} from "./camera";
import { CameraRig } from "./camera_rig";
import { closeUpOf, type CloseUp, type CloseUpName, type CloseUpRules } from "./close_ups";
import { ContactShadow } from "./contact_shadow";
import { DepthOfField } from "./depth_of_field";
import { Ground } from "./ground";
import type { LightName } from "./lights";
import { litScene, type SceneLight } from "./lit_scene";
import { Wind } from "../clients/three/wind";
import {
    boundsOf,
    disposeModel,
    hangsOnWall,
    modelLevels,
    modelVariants,
    modelWind,
    setWireframe,
    stemsOf,
    texturesOf,
} from "./model";
import { niceStep } from "./schema";
import { snapshot, type DrawTile } from "./snapshot";
import { solidsOf } from "./solids";
import type { WindChannelView } from "./view_state";

/** Speed of the wind in which models sway, m/s. */
const breezeSpeed = 3;

/** The nearest that the camera comes to any model, metres. */
const nearest = 0.01;

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
    closeUps: CloseUpRules;
    /** The model is lifted so that nothing of it is below the ground. */
    liesOnGround: boolean;
}

/** Colours of the stage in the page's style. */
export interface StageColours {
    ink: string;
    shadow: string;
    /** Of the sheet behind the model, from its middle outwards. */
    sheet: readonly [string, string, string];
}

/** What the picture shows at the depth of the target of the camera, metres. */
export interface Frame {
    width: number;
    height: number;
    target: [number, number, number];
}

export class Stage {
    readonly renderer: WebGLRenderer;
    /** Called after each drawn frame. */
    onFrame: () => void = () => undefined;
    /** Called when the user moves the camera by hand. */
    onTurned: () => void = () => undefined;
    /** Called when the user chooses a view by a key: its number from 0 on. */
    onKey: (view: number | "home") => void = () => undefined;

    private readonly scene: Scene;
    private readonly light: SceneLight;
    private readonly rig: CameraRig;
    private readonly lens: DepthOfField;
    private fNumber: number | undefined;
    /** Something was changed since the last frame. */
    private changed = true;
    private looked: LookName | undefined;
    private readonly backdrop = new Backdrop();
    private readonly ground = new Ground();
    private readonly contact = new ContactShadow();
    private model: Object3D | undefined;
    private bounds = new Box3();
    /** What has to be in the picture: the bounds, or those of roots and stems. */
    private framed = new Box3();
    private rootsOnly = false;
    private frameRequested = false;
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
        const home = style.directions["three-quarter"];
        const azimuth = (Math.atan2(home.x, home.z) * 180) / Math.PI;
        const { renderer, scene, light } = litScene(canvas, true, azimuth);
        this.renderer = renderer;
        this.scene = scene;
        this.light = light;
        this.lens = new DepthOfField(renderer);
        this.scene.add(this.backdrop, this.ground, this.contact);
        this.ground.visible = false;
        this.contact.visible = false;
        this.rig = new CameraRig(canvas, style.reducedMotion, {
            moved: () => this.draw(),
            turned: () => {
                if (this.looked !== "roots") this.looked = undefined;
                this.onTurned();
            },
            chosen: (view) => this.onKey(view),
        });
        this.wind.velocity.set(0, 0);
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
        return pixelsPerMetre(this.rig.camera, this.rig.target, this.host.clientHeight);
    }

    get frameShown(): Frame {
        const { clientWidth, clientHeight } = this.host;
        const metres = 1 / this.pixelsPerMetre;
        const { x, y, z } = this.rig.target;
        return { width: clientWidth * metres, height: clientHeight * metres, target: [x, y, z] };
    }

    /** Returns the metres between two lines on the ground, undefined if it has none. */
    get ruling(): number | undefined {
        return this.light.current.ruled ? this.spacing : undefined;
    }

    private get spacing(): number {
        const size = this.bounds.getSize(new Vector3());
        return niceStep(Math.max(size.x, size.y, size.z) / 5) || 0.01;
    }

    setColours({ ink, shadow, sheet }: StageColours): void {
        this.ground.colours(ink, shadow);
        this.backdrop.colours(...sheet);
        this.draw();
    }

    /** Shows everything in another light. */
    useLight(name: LightName): void {
        this.light.use(name);
        const { background, contact, ruled, shadow, soil } = this.light.current;
        this.backdrop.visible = background === "sheet";
        this.ground.ruledLines = ruled;
        this.ground.soil = soil;
        this.ground.shadowOpacity = shadow;
        this.contact.opacity = contact;
        if (this.model) this.light.aim(this.bounds.getBoundingSphere(new Sphere()));
        this.draw();
    }

    /** Returns true if this graphics card can show depth of field. */
    get hasDepthOfField(): boolean {
        return this.lens.possible;
    }

    /** Sets the stop of the lens; undefined for a picture that is sharp everywhere. */
    set aperture(fNumber: number | undefined) {
        const possible = this.lens.possible ? fNumber : undefined;
        if (possible === this.fNumber) return;
        this.fNumber = possible;
        if (this.fNumber === undefined) this.lens.dispose();
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
            await this.renderer.compileAsync(model, this.rig.camera, this.scene);
        }
        if (!current()) {
            disposeModel(model);
            return false;
        }
        const old = this.model;
        this.model = model;
        const bounds = boundsOf(model);
        // What hangs on a wall is shown with its wood standing on the ground.
        if (this.style.liesOnGround || hangsOnWall(model, bounds)) model.position.y = -bounds.min.y;
        this.bounds = boundsOf(model);
        this.applyLevel();
        this.applySolids();
        this.scene.add(model);
        if (old) {
            this.scene.remove(old);
            disposeModel(old);
        }
        this.fitGround();
        this.frameModel(refit, !old);
        this.draw();
        return true;
    }

    /** Updates the shadow on the ground: the model has another shape. */
    updateShadow(): void {
        this.castContact();
        this.draw();
    }

    /** Looks from a named side, or at a part of the model; without such a part it is shown whole.
     *  A model that is loaded later is looked at in the same way. */
    look(name: LookName, atOnce = true): void {
        this.looked = name;
        if (this.rootsOnly !== (name === "roots")) {
            this.rootsOnly = !this.rootsOnly;
            this.applyRootsOnly();
            this.castContact();
        }
        if (isCloseUp(name)) {
            if (!this.lookCloser(name, atOnce)) this.fit("three-quarter", atOnce);
        } else {
            this.fit(name, atOnce);
        }
    }

    /** Returns true if the model has the part that a close-up looks at. */
    canLookAt(name: CloseUpName): boolean {
        return this.closeUp(name) !== undefined;
    }

    /** Moves the camera so that the whole model is in the picture. */
    fit(name?: ViewName, atOnce = false): void {
        if (this.bounds.isEmpty()) return;
        const { camera, direction: current } = this.rig;
        const direction = name ? this.style.directions[name].clone() : current;
        if (direction.lengthSq() === 0) direction.copy(this.style.directions["three-quarter"]);
        const centre = this.framed.getCenter(new Vector3());
        let distance: number;
        if (this.heldPixels !== undefined) {
            const side = this.bounds.getSize(new Vector3());
            const coverage = this.heldPixels / (this.host.clientHeight || 1);
            distance = distanceOf(Math.max(side.x, side.y, side.z), coverage, camera.fov);
        } else {
            const margin = this.style.withoutMargins
                ? { x: 0.06, y: 0.06 }
                : this.host.clientWidth < 520
                  ? { x: 0.12, y: 0.36 }
                  : { x: 0.14, y: 0.26 };
            distance = fittingDistance(this.framed, direction, camera, margin);
        }
        this.rig.moveTo(centre, direction.multiplyScalar(distance).add(centre), atOnce);
    }

    /** Returns a PNG of the picture that is `scale` times as large as the canvas; throws an error
     *  that says so if that is too large. */
    async snapshot(scale: number): Promise<Blob> {
        const { camera } = this.rig;
        const drawTile: DrawTile = (tile) => {
            this.backdrop.tile = tile;
            if (this.fNumber === undefined) this.renderer.render(this.scene, camera);
            else this.lens.complete(this.scene, camera, this.fNumber, this.rig.distance);
        };
        return snapshot(this.renderer.domElement, camera, scale, drawTile, () => {
            this.backdrop.tile = [0, 0, 1, 1];
            this.changed = true;
            this.frame();
        });
    }

    /** Moves the camera if a new model or a new size of the stage needs it. */
    private frameModel(refit: boolean, first: boolean): void {
        const { looked } = this;
        // A part is followed when it moves.
        if (looked && isCloseUp(looked) && this.lookCloser(looked, first || !refit)) return;
        if (first) return this.fit(looked && !isCloseUp(looked) ? looked : "three-quarter", true);
        if (refit || this.outOfPicture()) this.fit();
    }

    private closeUp(name: CloseUpName): CloseUp | undefined {
        return this.model && closeUpOf(this.model, name, this.style.closeUps, this.bounds);
    }

    private lookCloser(name: CloseUpName, atOnce: boolean): boolean {
        const closeUp = this.closeUp(name);
        if (!closeUp) return false;
        const { target, direction, frame } = closeUp;
        const distance = framingDistance(frame, this.rig.camera);
        const position = direction.clone().multiplyScalar(distance).add(target);
        this.rig.moveTo(target, position, atOnce);
        return true;
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
        const farthest = this.heldPixels === undefined ? radius * 24 : Infinity;
        this.rig.limit(Math.min(radius * 0.4, nearest), farthest);
        this.rig.reach = radius * 12;
    }

    /** Requests a frame because something has changed; several requests at once make one frame. */
    draw(): void {
        this.changed = true;
        this.requestFrame();
    }

    private requestFrame(): void {
        if (this.frameRequested) return;
        this.frameRequested = true;
        requestAnimationFrame(() => this.frame());
    }

    /** Resolves after the next drawn frame, with depth of field once the picture is complete. */
    drawn(): Promise<void> {
        return new Promise((resolve) => {
            this.waiters.push(resolve);
            this.draw();
        });
    }

    private frame(): void {
        this.frameRequested = false;
        this.rig.update();
        const sways = this.swaying_ && this.model !== undefined && !!modelWind(this.model);
        const complete = this.render();
        this.onFrame();
        if (!complete && !sways) return this.requestFrame();
        const done = this.waiters;
        this.waiters = [];
        for (const resolve of done) resolve();
        if (sways) this.draw();
    }

    /** Draws the picture, or a better one of what has not changed; returns true if it is the final
     *  one. */
    private render(): boolean {
        const { changed, fNumber, lens, rig, scene } = this;
        this.changed = false;
        if (changed) this.wind.update(performance.now() / 1000);
        if (fNumber === undefined) {
            this.renderer.render(scene, rig.camera);
            return true;
        }
        if (changed) lens.restart();
        return lens.advance(scene, rig.camera, fNumber, rig.distance);
    }

    private resize(): void {
        const { clientWidth: width, clientHeight: height } = this.host;
        if (width === 0 || height === 0) return;
        this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
        this.renderer.setSize(width, height, false);
        this.rig.camera.aspect = width / height;
        this.rig.camera.updateProjectionMatrix();
        if (!this.model) return;
        const { looked } = this;
        const closer = looked && isCloseUp(looked) && this.lookCloser(looked, true);
        if (!closer && this.outOfPicture()) this.fit(undefined, true);
        // Drawn at once: a resized canvas is empty until the next frame.
        this.changed = true;
        this.frame();
    }

    private fitGround(): void {
        const ball = this.bounds.getBoundingSphere(new Sphere());
        this.light.aim(ball);
        this.ground.visible = true;
        this.ground.fit(ball.radius, this.spacing);
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
        const { camera, target } = this.rig;
        const seen = ball.radius / (camera.position.distanceTo(ball.center) || 1);
        const half = Math.tan((camera.fov * Math.PI) / 360) * Math.min(1, camera.aspect);
        const off = target.distanceTo(ball.center) / ball.radius;
        return seen > half * 1.05 || seen < half * 0.3 || off > 1.5;
    }
}
