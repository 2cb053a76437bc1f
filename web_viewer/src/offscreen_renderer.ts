// An offscreen renderer that draws models one after the other: thumbnails and sheets.
import {
    Box3,
    PerspectiveCamera,
    Sphere,
    Vector3,
    type Object3D,
    type Scene,
    type WebGLRenderer,
} from "three";
import { fittingDistance, standing, type Directions, type Margin, type ViewName } from "./camera";
import { ContactShadow } from "./contact_shadow";
import { Ground } from "./ground";
import { litScene, type SceneLight } from "./lit_scene";
import { boundsOf, hangsOnWall } from "./model";

export interface RenderOptions {
    view: ViewName;
    /** Camera directions by name of a view; those of an upright model by default. */
    directions?: Directions;
    /** What has to be in the picture, metres; the model's own bounds by default. */
    frame?: Box3;
    margin: Margin;
    /** With a ground that hides what is below it and receives a contact shadow. */
    onGround?: boolean;
}

export class OffscreenRenderer {
    readonly canvas = document.createElement("canvas");
    private readonly renderer: WebGLRenderer;
    private readonly scene: Scene;
    private readonly light: SceneLight;
    private readonly camera: PerspectiveCamera;
    private readonly ground = new Ground();
    private readonly contact = new ContactShadow();

    /** Pictures have `width` times `height` pixels. */
    constructor(width: number, height = width) {
        const { renderer, scene, light } = litScene(this.canvas, true);
        this.renderer = renderer;
        this.scene = scene;
        this.light = light;
        renderer.setSize(width, height, false);
        light.sun.shadow.mapSize.set(512, 512);
        this.camera = new PerspectiveCamera(24, width / height, 0.001, 100);
        this.ground.makeInvisible();
        this.scene.add(this.ground, this.contact);
    }

    /** Draws a model on the transparent canvas. Copy the picture before the next task: browsers may
     *  clear it. */
    render(
        model: Object3D,
        { view, directions = standing, frame, margin, onGround = false }: RenderOptions,
    ): HTMLCanvasElement {
        const bounds = boundsOf(model);
        const framed = frame ?? bounds;
        const ball = bounds.getBoundingSphere(new Sphere());
        const centre = framed.getCenter(new Vector3());
        const direction = directions[view];
        const distance = fittingDistance(framed, direction, this.camera, margin);
        this.camera.position.copy(direction).multiplyScalar(distance).add(centre);
        this.camera.near = distance / 50;
        this.camera.far = distance * 10;
        this.camera.lookAt(centre);
        this.camera.updateProjectionMatrix();
        this.light.aim(ball);
        this.scene.add(model);
        const stands = onGround && !hangsOnWall(model, bounds);
        this.ground.visible = this.contact.visible = stands;
        if (stands) {
            this.ground.fit(ball.radius, 1);
            const { min, max } = bounds;
            const half =
                Math.max(Math.abs(min.x), Math.abs(max.x), Math.abs(min.z), Math.abs(max.z)) * 1.6;
            this.contact.position.y = ball.radius * 0.0015;
            this.contact.update(this.renderer, this.scene, model, half, max.y - min.y);
        }
        this.renderer.render(this.scene, this.camera);
        this.scene.remove(model);
        return this.canvas;
    }

    dispose(): void {
        this.light.dispose();
        this.renderer.dispose();
        this.renderer.forceContextLoss();
    }
}
