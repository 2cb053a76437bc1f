// The photographs of the cap from above and from below: a row for each, with what is drawn on it.
import { byId, draw, make } from "../dom";
import { asRequestFailed } from "../http";
import { announce } from "../status_line";
import { CapDialog } from "./cap_dialog";
import {
    capSides,
    nothingDrawn,
    strokesOf,
    tools,
    type CapSide,
    type CapSketch,
    type CapView,
    type CapViews,
} from "./gesture";
import { Photograph } from "./service";
import { strokeGroup } from "./sketch";
import type { Sources } from "./sources";

interface Row {
    item: HTMLElement;
    use: HTMLElement;
    picture: SVGSVGElement;
    choose: HTMLButtonElement;
    change: HTMLButtonElement;
    remove: HTMLButtonElement;
    error: HTMLElement;
    input: HTMLInputElement;
}

const uses: Readonly<Record<CapSide, string>> = {
    above: "for the skin of the cap",
    below: "for gills, pores or spines",
};

export class CapPhotos {
    private readonly rows: Readonly<Record<CapSide, Row>>;
    private readonly dialog = new CapDialog((side) => this.rows[side].input.click());
    private views: CapViews = {};
    private choosing: AbortController | undefined;

    /** `changed` gets the photographs as they are now, and what has happened to them. */
    constructor(
        private readonly sources: Sources,
        private readonly changed: (views: CapViews | undefined, said: string) => void,
    ) {
        this.rows = { above: this.row("above"), below: this.row("below") };
        byId("cap-rows").append(...capSides.map((side) => this.rows[side].item));
    }

    /** Returns the side that a file is meant for which is dropped on an element, or pasted while it
     *  has the focus; undefined for the photograph from the side. */
    sideAt(element: EventTarget | null): CapSide | undefined {
        if (this.dialog.side) return this.dialog.side;
        return capSides.find((side) => this.rows[side].item.contains(element as Node | null));
    }

    /** Shows the photographs of a drawing. */
    show(views: CapViews | undefined): void {
        this.views = views ?? {};
        for (const side of capSides) {
            const view = this.views[side];
            const { use, choose, change, remove } = this.rows[side];
            use.hidden = choose.hidden = !!view;
            change.hidden = remove.hidden = !view;
            void this.showPicture(side, view);
        }
    }

    /** Another drawing follows: what is on its way is given up. */
    leave(): void {
        this.choosing?.abort();
    }

    /** Shows what the service says about a photograph. */
    say(side: CapSide, text: string): void {
        const { error } = this.rows[side];
        error.hidden = false;
        error.append(make("span", {}, text));
    }

    clearErrors(): void {
        for (const side of capSides) {
            this.rows[side].error.hidden = true;
            this.rows[side].error.replaceChildren();
        }
    }

    /** Sends a photograph and lets lines be drawn on it. */
    async choose(side: CapSide, file: File): Promise<void> {
        this.choosing?.abort();
        const choosing = new AbortController();
        const { signal } = choosing;
        this.choosing = choosing;
        const { item } = this.rows[side];
        this.clearErrors();
        item.classList.add("sending");
        announce("Sending the photograph.");
        try {
            const source = await Photograph.upload(file, signal, announce);
            const address = URL.createObjectURL(await source.picture(signal));
            const before = this.views[side];
            const old = this.sources.at(before?.source)?.source;
            // The same photograph has the lines that were drawn before it was forgotten.
            const isAgain = old instanceof Photograph && old.isAgain(source);
            const start = before && isAgain ? before : { gesture: nothingDrawn };
            const drawn = await this.dialog.open(side, { stored: source.stored, address }, start);
            if (!drawn || signal.aborted) {
                source.forget();
                URL.revokeObjectURL(address);
                return this.focus(side);
            }
            this.use(side, this.sources.add({ file, source, address }), drawn);
        } catch (error) {
            if (signal.aborted) return;
            const failed = asRequestFailed(error, "The photograph cannot be read");
            const text = failed.items.map(({ detail }) => detail).join(" ") || failed.message;
            if (this.dialog.side) this.dialog.say(text);
            else this.say(side, text);
        } finally {
            item.classList.remove("sending");
        }
    }

    /** Lets the lines of a photograph be changed. */
    private async edit(side: CapSide): Promise<void> {
        const view = this.views[side];
        if (!view) return;
        try {
            const { stored } = await this.sources.photograph(view.source);
            const address = await this.sources.address(view.source);
            const drawn = await this.dialog.open(side, { stored, address }, view);
            if (!drawn || drawn === view) return this.focus(side);
            this.use(side, view.source, drawn);
        } catch {
            // It is forgotten: the same file has its lines again.
            this.rows[side].input.click();
        }
    }

    private use(side: CapSide, source: number, { gesture, centre, stemEnd }: CapSketch): void {
        const view = { source, gesture, centre, stemEnd };
        this.changed({ ...this.views, [side]: view }, `The photograph from ${side} is used.`);
        this.focus(side);
    }

    private remove(side: CapSide): void {
        const { [side]: _, ...others } = this.views;
        const isLast = Object.keys(others).length === 0;
        this.changed(isLast ? undefined : others, `The photograph from ${side} is removed.`);
        this.focus(side);
    }

    private focus(side: CapSide): void {
        const { choose, change } = this.rows[side];
        (choose.hidden ? change : choose).focus();
    }

    private row(side: CapSide): Row {
        const name = `From ${side}`;
        const button = (text: string): HTMLButtonElement =>
            make("button", { type: "button", "aria-label": `${text} ${name.toLowerCase()}` }, text);
        const input = make("input", {
            type: "file",
            id: `cap-file-${side}`,
            accept: "image/jpeg,image/png,image/webp",
            hidden: true,
        });
        const [choose, change, remove] = [button("Choose…"), button("Change"), button("Remove")];
        const picture = draw("svg", { class: "cap-picture", "aria-hidden": "true" });
        const error = make("p", { class: "validation-error", role: "alert", hidden: true });
        const use = make("small", {}, uses[side]);
        const item = make(
            "li",
            { "data-view": side },
            picture,
            make("span", { class: "cap-name" }, make("b", {}, name), " ", use),
            make("span", { class: "row" }, choose, change, remove, input),
            error,
        );
        choose.addEventListener("click", () => input.click());
        change.addEventListener("click", () => void this.edit(side));
        remove.addEventListener("click", () => this.remove(side));
        input.addEventListener("change", () => {
            const chosen = input.files?.[0];
            input.value = "";
            if (chosen) void this.choose(side, chosen);
        });
        return { item, use, picture, choose, change, remove, error, input };
    }

    /** Shows a photograph small, with its lines. */
    private async showPicture(side: CapSide, view: CapView | undefined): Promise<void> {
        const { picture } = this.rows[side];
        if (!view) return picture.replaceChildren();
        try {
            const { width, height } = (await this.sources.photograph(view.source)).stored;
            const href = await this.sources.address(view.source);
            if (this.views[side] !== view) return;
            const { gesture, centre, stemEnd } = view;
            picture.setAttribute("viewBox", `0 0 ${width} ${height}`);
            picture.replaceChildren(
                draw("image", { href, width, height }),
                ...tools.flatMap((tool) =>
                    strokesOf(gesture, tool).map((line) => strokeGroup(tool, line, true)),
                ),
                ...[centre, stemEnd].flatMap((place) =>
                    place ? draw("circle", { cx: place[0], cy: place[1], r: Math.max(width, height) / 25 }) : [],
                ),
            );
        } catch {
            // The trace says at this row that the photograph cannot be had.
            if (this.views[side] === view) picture.replaceChildren();
        }
    }
}
