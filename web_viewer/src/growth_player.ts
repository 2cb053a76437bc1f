// The play button beside the age: plays the growth of the shown model, and lets the age slider pose
// it while its animation clip is loaded.
import { byId, make } from "./dom";
import { GrowthClip } from "./growth_clip";
import type { Settings } from "./settings";
import { announce } from "./status_line";
import type { Object3D } from "three";

/** Time without a change of age after which the model of that age is requested, milliseconds. */
export const restMs = 900;

export interface GrowthPlayerEvents {
    /** The shown model has another shape: draw it. */
    posed: () => void;
    /** Play was pressed and the shown model has no clip: load one. */
    clipNeeded: () => void;
    /** Playing was stopped: the age of the settings is now the shown one. */
    stopped: () => void;
    /** The clip was played to its end. */
    ended: () => void;
}

export class GrowthPlayer {
    private readonly clip: GrowthClip;
    private readonly button = make("button", { type: "button", id: "play", class: "play" });

    /** Puts the button beside the age, if the settings have one and this server makes clips. */
    constructor(
        private readonly settings: Settings,
        private readonly reducedMotion: boolean,
        private readonly events: GrowthPlayerEvents,
    ) {
        this.clip = new GrowthClip({
            posed: (age) => {
                events.posed();
                this.showAge(age);
            },
            ended: () => {
                this.showState();
                events.ended();
            },
        });
        const row = byId("form").querySelector('.control[data-name="age"]');
        if (!row || !settings.hasGrowthClips) return;
        row.classList.add("playable");
        row.querySelector(".entry")?.append(this.button);
        this.button.addEventListener("click", () => {
            if (this.clip.playing) this.stop();
            else if (this.clip.ready) this.play();
            else events.clipNeeded();
            this.showState();
        });
        this.showState();
    }

    /** Returns true if the shown model has a clip. */
    get ready(): boolean {
        return this.clip.ready;
    }

    /** The age that the clip shows, undefined if it shows none, and whether it is playing. */
    get state(): { age: number | undefined; playing: boolean } {
        return { age: this.clip.age, playing: this.clip.playing };
    }

    /** Uses the clip of a model that was just shown, if it has one. */
    take(model: Object3D): void {
        this.clip.take(model);
        this.showState();
    }

    /** Stops using the clip; the model stays as it is. */
    release(): void {
        this.clip.release();
        this.showState();
    }

    /** Plays the clip from the start. With reduced motion it moves the focus to the age instead. */
    play(): void {
        if (this.reducedMotion) {
            announce("Growth is loaded: move the age to see it");
            document.querySelector<HTMLElement>('[name="age"]')?.focus();
            return;
        }
        this.clip.play(0);
        this.showState();
        announce("Growing");
    }

    /** Poses the clip at the age of the settings; returns false if there is no clip. */
    pose(): boolean {
        this.clip.pause();
        this.showState();
        const age = this.settings.values.get("age") ?? this.settings.field("age")?.fallback;
        return typeof age === "number" && this.clip.pose(age);
    }

    /** Stops playing and makes the shown age the age of the settings. */
    private stop(): void {
        this.clip.pause();
        const step = this.settings.field("age")?.step ?? 0.01;
        const age = Math.round((this.clip.age ?? 0) / step) * step;
        this.settings.set("age", Number(age.toFixed(4)));
        this.events.stopped();
        announce(`Stopped at age ${age.toFixed(2)}`);
    }

    private showState(): void {
        const { playing } = this.clip;
        const label = playing ? "Stay at this age" : "Play growth";
        this.button.textContent = playing ? "❚❚" : "▶";
        this.button.title = label;
        this.button.setAttribute("aria-label", label);
    }

    /** Moves the slider to an age; the settings stay. */
    private showAge(age: number): void {
        const entries = byId("form").querySelectorAll<HTMLInputElement>('input[name="age"]');
        for (const entry of entries) {
            if (entry !== document.activeElement || entry.type === "range") {
                entry.value = String(Number(age.toFixed(3)));
            }
            entry.style.setProperty("--to", `${100 * age}%`);
        }
    }
}
