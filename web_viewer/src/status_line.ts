// The status line, which screen readers announce: one sentence about what has just happened.
import { byId } from "./dom";

/** Replaces the text of the status line. */
export function announce(text: string): void {
    byId("status").textContent = text;
}
