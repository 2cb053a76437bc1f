// The camera of the stage and what moves it: pointer, keys, and named views.
import { PerspectiveCamera, Spherical, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

export interface CameraEvents {
    /** The camera has moved: a frame is needed. */
    moved: () => void;
    /** The user has turned or moved the camera by hand. */
    turned: () => void;
    /** The user wants the view of this number, from 0 on; "home" is the first one. */
    chosen: (view: number | "home") => void;
}

const movementMs = 380;

export class CameraRig {
    readonly camera = new PerspectiveCamera(26, 1, 0.001, 10);
    /** Distance up to which everything is drawn, at least, metres. */
    reach = 0;

    private readonly controls: OrbitControls;
    private movement = 0;

    constructor(
        canvas: HTMLCanvasElement,
        private readonly reducedMotion: boolean,
        private readonly events: CameraEvents,
    ) {
        this.controls = new OrbitControls(this.camera, canvas);
        this.controls.enableDamping = !reducedMotion;
        this.controls.dampingFactor = 0.12;
        this.controls.zoomToCursor = true;
        this.controls.addEventListener("change", () => events.moved());
        this.controls.addEventListener("start", () => {
            this.movement += 1;
            events.turned();
        });
        canvas.addEventListener("keydown", (event) => this.onKey(event));
    }

    /** The point that the camera looks at and turns around. */
    get target(): Vector3 {
        return this.controls.target;
    }

    get distance(): number {
        return this.camera.position.distanceTo(this.target);
    }

    /** Returns the direction from the target to the camera, of length 0 before the first view. */
    get direction(): Vector3 {
        return this.camera.position.clone().sub(this.target).normalize();
    }

    /** Pointer and keys move the camera; otherwise something else does. */
    set enabled(on: boolean) {
        this.controls.enabled = on;
    }

    /** Limits how near and how far away the camera can be, metres. */
    limit(nearest: number, farthest: number): void {
        this.controls.minDistance = nearest;
        this.controls.maxDistance = farthest;
    }

    /** Continues movements; called before each frame. */
    update(): void {
        this.controls.update();
        const { camera, distance } = this;
        const [near, far] = [distance / 60, Math.max(distance * 30, this.reach)];
        if (camera.near === near && camera.far === far) return;
        camera.near = near;
        camera.far = far;
        camera.updateProjectionMatrix();
    }

    /** Moves to a position that looks at a target, along an arc around it. */
    moveTo(target: Vector3, position: Vector3, atOnce: boolean): void {
        const movement = ++this.movement;
        if (atOnce || this.reducedMotion) {
            this.controls.enableDamping = false;
            this.controls.target.copy(target);
            this.camera.position.copy(position);
            this.update();
            this.controls.enableDamping = !this.reducedMotion;
            this.events.moved();
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
            const t = Math.min(Math.max((now - start) / movementMs, 0), 1);
            const s = t * t * (3 - 2 * t);
            const at = new Spherical(
                from.radius * (to.radius / from.radius) ** s,
                from.phi + (to.phi - from.phi) * s,
                from.theta + turn * s,
            );
            this.controls.target.lerpVectors(fromTarget, target, s);
            this.camera.position.setFromSpherical(at).add(this.controls.target);
            this.events.moved();
            if (t < 1) requestAnimationFrame(step);
        };
        requestAnimationFrame(step);
    }

    private onKey(event: KeyboardEvent): void {
        if (!this.controls.enabled || event.ctrlKey || event.metaKey || event.altKey) return;
        if (event.key === "Home" || /^[1-9]$/.test(event.key)) {
            event.preventDefault();
            return this.events.chosen(event.key === "Home" ? "home" : Number(event.key) - 1);
        }
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
        else return;
        event.preventDefault();
        this.movement += 1;
        turn.phi = Math.min(Math.max(turn.phi, 0.01), Math.PI - 0.01);
        turn.radius = Math.min(
            Math.max(turn.radius, this.controls.minDistance),
            this.controls.maxDistance,
        );
        this.camera.position.setFromSpherical(turn).add(this.controls.target);
        this.events.turned();
        this.events.moved();
    }
}
