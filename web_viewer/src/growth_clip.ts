// Growth on the stage: plays the clip of a model from button to decay, or poses it at one age.
import { AnimationMixer, LoopOnce, type AnimationAction, type Object3D } from "three";

export interface GrowthClipEvents {
    /** The model has another shape now: draw it. */
    posed: (age: number) => void;
    /** It grew to its end. */
    ended: () => void;
}

/** The clip that `animation=growth` puts into a file; its time runs evenly with age. */
const clipName = "growth";

export class GrowthClip {
    private mixer: AnimationMixer | undefined;
    private action: AnimationAction | undefined;
    private seconds = 0;
    private age_: number | undefined;
    private run = 0;

    constructor(private readonly events: GrowthClipEvents) {}

    /** Whether the model on the stage can grow. */
    get ready(): boolean {
        return this.action !== undefined;
    }

    /** Whether it grows by itself now. */
    get playing(): boolean {
        return this.run !== 0;
    }

    /** The age that is shown; undefined while the model stands as it came. */
    get age(): number | undefined {
        return this.age_;
    }

    /** Takes the clip of a model, if it has one, in place of the last one's. */
    take(model: Object3D): void {
        this.leave();
        const clip = model.animations.find(({ name }) => name === clipName);
        if (!clip) return;
        this.mixer = new AnimationMixer(model);
        this.seconds = clip.duration;
        this.action = this.mixer.clipAction(clip);
        this.action.setLoop(LoopOnce, 1);
        this.action.clampWhenFinished = true;
    }

    /** Lets go of the model as it stands. */
    leave(): void {
        this.pause();
        this.mixer?.stopAllAction();
        this.mixer = undefined;
        this.action = undefined;
        this.age_ = undefined;
    }

    /** Shows one age; false when there is no clip. */
    pose(age: number): boolean {
        if (!this.mixer || !this.action) return false;
        this.action.paused = false;
        this.action.play();
        this.action.time = Math.min(Math.max(age, 0), 1) * this.seconds;
        this.mixer.update(0);
        this.age_ = age;
        this.events.posed(age);
        return true;
    }

    /** Grows from an age to the end, in the clip's own time. */
    play(from: number): void {
        this.pause();
        if (!this.pose(from)) return;
        let last = performance.now();
        const step = (now: number): void => {
            // Timestamps of frames may lie a little before the call that asked for them.
            const passed = Math.max(now - last, 0) / 1000;
            last = now;
            const age = Math.min((this.age_ ?? 0) + passed / this.seconds, 1);
            this.pose(age);
            if (age < 1) {
                this.run = requestAnimationFrame(step);
                return;
            }
            this.run = 0;
            this.events.ended();
        };
        this.run = requestAnimationFrame(step);
    }

    /** Stops where it is. */
    pause(): void {
        cancelAnimationFrame(this.run);
        this.run = 0;
    }
}
