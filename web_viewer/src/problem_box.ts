// The box above the controls: a failed request, or settings of an address that cannot be used.
import { byId, make } from "./dom";
import { RequestFailed, type ProblemItem } from "./http";

/** Shows a problem beside the control it is about; returns false if there is no such control. */
export type ShowBeside = (item: ProblemItem) => boolean;

export class ProblemBox {
    private readonly element = byId("problem");
    private rejected: readonly ProblemItem[] = [];

    /** Items that `showBeside` shows elsewhere are not repeated in the box. */
    constructor(private readonly showBeside: ShowBeside = () => false) {}

    /** Shows a failed request; `retry` adds a button that calls it. */
    show(error: RequestFailed, retry?: () => void): void {
        this.element.hidden = false;
        this.element.replaceChildren(make("strong", {}, error.title));
        const listed = error.items.filter((item) => !this.showBeside(item));
        if (error.detail) this.element.append(make("p", {}, error.detail));
        if (listed.length > 0) {
            const lines = listed.map(({ parameter, detail }) =>
                make("li", {}, make("b", {}, parameter), ` ${detail}`),
            );
            this.element.append(make("ul", {}, ...lines));
        }
        if (retry) {
            const button = make("button", { type: "button" }, "Try again");
            button.addEventListener("click", retry);
            this.element.append(button);
        }
        this.element.scrollIntoView({ block: "nearest" });
    }

    hide(): void {
        this.element.hidden = true;
        this.element.replaceChildren();
    }

    /** Lists settings of an address or a file that cannot be used, or hides the box if there are
     *  none. The list is shown until the next change of a setting. */
    showRejected(items: readonly ProblemItem[]): void {
        this.rejected = items;
        this.showRejectedAgain();
    }

    /** Shows the list of rejected settings again, in place of any other problem. */
    showRejectedAgain(): void {
        const { length } = this.rejected;
        if (length === 0) return this.hide();
        const title =
            length === 1
                ? "One setting of the address was left out"
                : `${length} settings of the address were left out`;
        this.show(new RequestFailed(title, "", 0, [...this.rejected]));
    }
}
