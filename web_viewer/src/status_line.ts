// One sentence about what has just happened: in the status line, which screen readers announce, and where it is seen
// nowhere else on the page in a notice.
import { byId, make } from "./dom";

/** How long a notice can be read, milliseconds. */
const noticeMs = 6000;

let notice: HTMLElement | undefined;
let timer: ReturnType<typeof setTimeout> | undefined;

/** Replaces the text of the status line: what happened is seen elsewhere on the page. */
export function announce(text: string): void {
    byId("status").textContent = text;
}

/** Announces what is seen nowhere else, and shows it for some seconds. */
export function notify(text: string): void {
    announce(text);
    clearTimeout(timer);
    notice?.remove();
    // What screen readers have read already is not read again.
    const shown = make("p", { id: "notice", class: "notice", "aria-hidden": true }, text);
    notice = shown;
    document.body.append(shown);
    timer = setTimeout(() => shown.remove(), noticeMs);
}
