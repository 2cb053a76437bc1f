// The box on the stage that shows how far the request of a model is.
import { byId, grouped } from "./dom";
import type { Progress } from "./http";
import { announce } from "./status_line";

export type LoadProgress = Progress | { stage: "unpacking" } | { stage: "idle" };

/** Shows the progress of the current request; "idle" hides the box. */
export function showProgress(progress: LoadProgress): void {
    const box = byId("progress");
    const bar = byId<HTMLProgressElement>("progress-bar");
    const text = byId("progress-text");
    box.hidden = progress.stage === "idle";
    box.classList.toggle("waiting", progress.stage === "waiting");
    byId("stage").setAttribute("aria-busy", String(progress.stage !== "idle"));
    bar.removeAttribute("value");
    switch (progress.stage) {
        case "growing":
            text.textContent = "growing…";
            break;
        case "unpacking":
            text.textContent = "unpacking…";
            break;
        case "downloading": {
            const received = grouped(progress.received / 1000);
            if (!progress.total) {
                text.textContent = `downloading, ${received} kB so far`;
                break;
            }
            bar.max = progress.total;
            bar.value = progress.received;
            text.textContent = `downloading ${received} of ${grouped(progress.total / 1000)} kB`;
            break;
        }
        case "waiting": {
            const seconds = Number(progress.seconds.toFixed(1));
            const attempt = `${progress.attempt} of ${progress.attempts - 1}`;
            text.textContent = `the server is busy; again in ${seconds} s (${attempt})`;
            announce(text.textContent);
            break;
        }
        case "idle":
            break;
    }
}
