// What moves the camera that flies: keys, a dragged pointer, the wheel, one finger that turns and two that move.
import { eyeHeight, isMoving, moved, pushed, pushOf, speedAt, turned, type Pose, type Terrain } from "./fly_motion";

/** Degrees per pixel of a dragged pointer. */
const degreesPerPixel = 0.16;
/** A key that is pressed moves at once as far as in this time. */
const tapSeconds = 0.1;
/** A pointer that moved less than this has clicked, pixels. */
export const clickReach = 5;

export interface FlyEvents {
    /** The pose has changed, or keys that are held will change it: a frame is needed. */
    moved: () => void;
    /** Somebody has changed it, not the page. */
    turned: () => void;
}

export class FlyControls {
    pose: Pose = { x: 0, y: 0, height: 3, heading: 0, pitch: -12 };
    walks = false;
    enabled = false;
    private readonly keys = new Set<string>();
    private fast = false;
    private readonly pointers = new Map<number, { x: number; y: number }>();

    constructor(
        canvas: HTMLCanvasElement,
        private readonly terrain: () => Terrain,
        private readonly events: FlyEvents,
    ) {
        canvas.addEventListener("keydown", (event) => this.onKey(event));
        addEventListener("keyup", (event) => {
            this.keys.delete(event.key.toLowerCase());
            this.fast = event.shiftKey;
        });
        addEventListener("blur", () => this.keys.clear());
        canvas.addEventListener("blur", () => this.keys.clear());
        canvas.addEventListener("pointerdown", (event) => {
            if (!this.enabled) return;
            canvas.focus({ preventScroll: true });
            canvas.setPointerCapture(event.pointerId);
            this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        });
        canvas.addEventListener("pointermove", (event) => this.onDrag(event));
        for (const end of ["pointerup", "pointercancel"] as const)
            canvas.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
        canvas.addEventListener("wheel", (event) => this.onWheel(event), { passive: false });
    }

    /** The view is being dragged. */
    get isDragged(): boolean {
        return this.pointers.size > 0;
    }

    /** Moves on by what is held; returns true while something is. */
    step(seconds: number): boolean {
        if (!this.enabled || this.keys.size === 0) return false;
        const { push, turn } = pushOf(this.keys, this.fast);
        this.setByHand(turned(pushed(this.pose, push, seconds, this.walks, this.terrain()), turn * seconds, 0));
        return true;
    }

    /** Puts the pose where it may be: one who walks has eyes at their height. */
    set(pose: Pose): void {
        this.pose = moved(this.walks ? { ...pose, height: eyeHeight } : pose, 0, 0, 0, this.walks, this.terrain());
        this.events.moved();
    }

    /** Moves ahead while a button is held: fingers have no keys. */
    hold(isHeld: boolean): void {
        if (!isHeld) this.keys.delete("w");
        else if (this.enabled) {
            this.keys.add("w");
            this.step(tapSeconds);
        }
    }

    private setByHand(pose: Pose): void {
        this.events.turned();
        this.set(pose);
    }

    private onKey(event: KeyboardEvent): void {
        const key = event.key.toLowerCase();
        if (!this.enabled || event.ctrlKey || event.metaKey || event.altKey || !isMoving(key)) return;
        event.preventDefault();
        this.keys.add(key);
        this.fast = event.shiftKey;
        // A key that is pressed only for a moment is a step, also where frames take longer than that.
        if (event.repeat) this.events.moved();
        else this.step(tapSeconds);
    }

    private onDrag(event: PointerEvent): void {
        const before = this.pointers.get(event.pointerId);
        if (!this.enabled || !before) return;
        const [dx, dy] = [event.clientX - before.x, event.clientY - before.y];
        const others = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
        this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        const other = others[0];
        if (!other) return this.setByHand(turned(this.pose, -dx * degreesPerPixel, dy * degreesPerPixel));
        const spread = Math.hypot(event.clientX - other.x, event.clientY - other.y) - Math.hypot(before.x - other.x, before.y - other.y);
        const metres = speedAt(this.pose.height, this.walks, false) / 60;
        this.setByHand(moved(this.pose, spread * metres, (-dx * metres) / 2, (dy * metres) / 2, this.walks, this.terrain()));
    }

    private onWheel(event: WheelEvent): void {
        if (!this.enabled) return;
        event.preventDefault();
        const metres = -Math.sign(event.deltaY) * 0.35 * speedAt(this.pose.height, this.walks, event.shiftKey);
        this.setByHand(moved(this.pose, metres, 0, 0, this.walks, this.terrain()));
    }
}
