// One sentence about what has just happened: in the status line, which screen readers announce, and where it is seen
// nowhere else on the page in a notice.
import { byId, make } from "./dom";

/** How long a notice can be read, milliseconds. */
const noticeMs = 6000;

// What screen readers have read already is not read again.
const notice = make("p", { id: "notice", class: "notice", "aria-hidden": true });
let timer: ReturnType<typeof setTimeout> | undefined;

/** Replaces the text of the status line: what happened is seen elsewhere on the page. */
export function announce(text: string): void {
    byId("status").textContent = text;
}

/** Announces what is seen nowhere else, and shows it for some seconds. */
export function notify(text: string): void {
    announce(text);
    notice.textContent = text;
    document.body.append(notice);
    clearTimeout(timer);
    timer = setTimeout(() => notice.remove(), noticeMs);
}
