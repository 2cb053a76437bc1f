// Pictures of models from the front, drawn without perspective by a renderer of their own: small ones
// of all stages, and one that lies over the photograph.
import { Box3, OrthographicCamera, Sphere, Vector3, type Object3D } from "three";
import { getModel } from "../http";
import { litScene } from "../lit_scene";
import { boundsOf, disposeModel, parseModel } from "../model";
import { asGrown, type ModelShape } from "./axis_line";

/** What is in a picture, metres. */
export interface Window {
    left: number;
    right: number;
    bottom: number;
    top: number;
}

/** Returns the square around bounds, with a margin. */
export function squareAround({ min, max }: Box3): Window {
    const half = 0.54 * Math.max(max.x - min.x, max.y - min.y, 1e-4);
    const [x, y] = [(min.x + max.x) / 2, (min.y + max.y) / 2];
    return { left: x - half, right: x + half, bottom: y - half, top: y + half };
}

export class Portraits {
    readonly canvas = document.createElement("canvas");
    private readonly lit = litScene(this.canvas, true, 0);
    private readonly camera = new OrthographicCamera();

    constructor() {
        this.lit.light.sun.shadow.mapSize.set(512, 512);
    }

    /** Grows a model and draws it on another canvas, whole. */
    async small(model: ModelShape, onto: HTMLCanvasElement, signal: AbortSignal): Promise<void> {
        const { bytes, response } = await getModel(
            {
                address: "v1/mushrooms.glb",
                body: `{"model":${JSON.stringify(asGrown(model))},"lod":2,"texture_size":128}`,
            },
            signal,
        );
        const grown = await parseModel(bytes, response.url);
        if (!signal.aborted) this.draw(grown, squareAround(boundsOf(grown)), onto);
        disposeModel(grown);
    }

    /** Draws the model of a file on another canvas. */
    async file(bytes: ArrayBuffer, seen: Window, onto: HTMLCanvasElement): Promise<void> {
        const grown = await parseModel(bytes.slice(0), location.href);
        this.draw(grown, seen, onto);
        disposeModel(grown);
    }

    private draw(model: Object3D, seen: Window, onto: HTMLCanvasElement): void {
        const { renderer, scene, light } = this.lit;
        const { camera } = this;
        const { width, height } = onto;
        renderer.setSize(width, height, false);
        Object.assign(camera, seen);
        const ball = boundsOf(model).getBoundingSphere(new Sphere());
        camera.position.set(0, 0, ball.center.z + ball.radius * 3);
        camera.near = ball.radius;
        camera.far = ball.radius * 6;
        camera.lookAt(new Vector3(0, 0, 0));
        camera.updateProjectionMatrix();
        light.aim(ball);
        scene.add(model);
        renderer.render(scene, camera);
        scene.remove(model);
        const context = onto.getContext("2d");
        context?.clearRect(0, 0, width, height);
        context?.drawImage(this.canvas, 0, 0);
    }
}
