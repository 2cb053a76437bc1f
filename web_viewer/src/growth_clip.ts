// The growth clip of the model on the stage: plays it from button to decay, or poses it at one age.
import { AnimationMixer, LoopOnce, type AnimationAction, type Object3D } from "three";

export interface GrowthClipEvents {
    /** The model has another shape: draw it. */
    posed: (age: number) => void;
    /** The clip was played to its end. */
    ended: () => void;
}

/** Name of the clip in files made with `animation=growth`; its time is proportional to age. */
const clipName = "growth";

export class GrowthClip {
    private mixer: AnimationMixer | undefined;
    private action: AnimationAction | undefined;
    private seconds = 0;
    private age_: number | undefined;
    private frameRequest = 0;

    constructor(private readonly events: GrowthClipEvents) {}

    /** Returns true if the model on the stage has a clip. */
    get ready(): boolean {
        return this.action !== undefined;
    }

    /** Returns true while the clip is playing. */
    get playing(): boolean {
        return this.frameRequest !== 0;
    }

    /** Returns the age that is shown, undefined while no age was posed. */
    get age(): number | undefined {
        return this.age_;
    }

    /** Uses the clip of a model, if it has one, in place of the last one. */
    take(model: Object3D): void {
        this.release();
        const clip = model.animations.find(({ name }) => name === clipName);
        if (!clip) return;
        this.mixer = new AnimationMixer(model);
        this.seconds = clip.duration;
        this.action = this.mixer.clipAction(clip);
        this.action.setLoop(LoopOnce, 1);
        this.action.clampWhenFinished = true;
    }

    /** Stops using the model; it stays as it is. */
    release(): void {
        this.pause();
        this.mixer?.stopAllAction();
        this.mixer = undefined;
        this.action = undefined;
        this.age_ = undefined;
    }

    /** Shows one age; returns false if there is no clip. */
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

    /** Plays from an age to the end, in the clip's own time. */
    play(from: number): void {
        this.pause();
        if (!this.pose(from)) return;
        let last = performance.now();
        const step = (now: number): void => {
            // Timestamps of frames may be slightly earlier than the call that requested them.
            const passed = Math.max(now - last, 0) / 1000;
            last = now;
            const age = Math.min((this.age_ ?? 0) + passed / this.seconds, 1);
            this.pose(age);
            if (age < 1) {
                this.frameRequest = requestAnimationFrame(step);
                return;
            }
            this.frameRequest = 0;
            this.events.ended();
        };
        this.frameRequest = requestAnimationFrame(step);
    }

    /** Stops at the present age. */
    pause(): void {
        cancelAnimationFrame(this.frameRequest);
        this.frameRequest = 0;
    }
}
