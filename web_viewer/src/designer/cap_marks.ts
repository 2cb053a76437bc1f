// Handles on a photograph of the cap: its middle, and where the stem ends.
import { draw } from "../dom";
import { arrowSteps, distance, inside, type CapSketch, type Extent, type Point } from "./gesture";
import { abovePixels } from "./outline_editor";

export const marks = ["centre", "stemEnd"] as const;
export type Mark = (typeof marks)[number];

export interface CapMarksEvents {
    /** A handle was let go at another place, or removed. */
    moved: (mark: Mark, place: Point | undefined) => void;
    said: (text: string) => void;
}

/** Movement that makes a drag of a touch, pixels of the screen. */
const dragPixels = 6;

export class CapMarks {
    readonly element = draw("g", { class: "cap-marks" });
    private readonly line = draw("path", { class: "hidden-stem" });
    private readonly handles = Object.fromEntries(
        marks.map((mark) => [mark, this.handle(mark)]),
    ) as Record<Mark, SVGGElement>;
    private extent: Extent = { width: 1, height: 1 };
    private places: Partial<Record<Mark, Point>> = {};
    private names: Readonly<Record<Mark, string>> = { centre: "", stemEnd: "" };
    /** What is being moved, and where it was. */
    private start: { mark: Mark; place: Point } | undefined;
    private drag: { touch: boolean; begun: boolean; from: Point } | undefined;

    /** `toPicture` returns where a place of the window is on the photograph. */
    constructor(
        private readonly toPicture: (place: { clientX: number; clientY: number }) => Point,
        private readonly events: CapMarksEvents,
    ) {
        const { element } = this;
        element.append(this.line);
        element.addEventListener("pointermove", (event) => this.move(event));
        element.addEventListener("pointerup", () => this.letGo());
        element.addEventListener("pointercancel", () => this.giveUp());
        element.addEventListener("keyup", (event) => {
            if (event.key.startsWith("Arrow")) this.letGo();
        });
        element.addEventListener("focusout", () => this.letGo());
    }

    open(extent: Extent, names: Readonly<Record<Mark, string>>): void {
        this.extent = extent;
        this.names = names;
    }

    show({ centre, stemEnd }: CapSketch): void {
        this.start = this.drag = undefined;
        this.places = { ...(centre ? { centre } : {}), ...(stemEnd ? { stemEnd } : {}) };
        this.redraw();
    }

    focus(mark: Mark): void {
        this.handles[mark].focus();
    }

    /** Ends a drag without a change. */
    giveUp(): void {
        const { start } = this;
        this.start = this.drag = undefined;
        if (start) this.places[start.mark] = start.place;
        this.redraw();
    }

    private handle(mark: Mark): SVGGElement {
        const handle = draw(
            "g",
            {
                class: `handle ${mark}`,
                tabindex: 0,
                role: "button",
                "aria-roledescription": "point",
            },
            draw("circle", { class: "hit" }),
            draw("circle", { class: "knob" }),
        );
        handle.addEventListener("pointerdown", (event) => this.down(mark, event));
        handle.addEventListener("keydown", (event) => this.key(mark, event));
        return handle;
    }

    private redraw(): void {
        for (const mark of marks) {
            const handle = this.handles[mark];
            const place = this.places[mark];
            if (!place) {
                handle.remove();
                continue;
            }
            if (!handle.isConnected) this.element.append(handle);
            handle.setAttribute("transform", `translate(${place[0]} ${place[1]})`);
            handle.setAttribute("aria-label", this.labelOf(mark, place));
        }
        const { centre, stemEnd } = this.places;
        const d = centre && stemEnd ? `M${centre.join(" ")}L${stemEnd.join(" ")}` : "";
        this.line.setAttribute("d", d);
    }

    private labelOf(mark: Mark, [x, y]: Point): string {
        return `${this.names[mark]}, at ${x}, ${y}`;
    }

    private down(mark: Mark, event: PointerEvent): void {
        const place = this.places[mark];
        if (event.button !== 0 || !event.isPrimary || !place) return;
        event.stopPropagation();
        event.preventDefault();
        this.element.setPointerCapture(event.pointerId);
        this.focus(mark);
        this.start = { mark, place };
        const touch = event.pointerType === "touch";
        this.drag = { touch, begun: false, from: [event.clientX, event.clientY] };
    }

    private move(event: PointerEvent): void {
        const { drag, start } = this;
        if (!drag || !start || !event.isPrimary) return;
        event.stopPropagation();
        const { clientX, clientY } = event;
        const far = distance([clientX, clientY], drag.from);
        if (!drag.begun && drag.touch && far < dragPixels) return;
        drag.begun = true;
        const raised = drag.touch ? abovePixels : 0;
        this.goTo(start.mark, this.toPicture({ clientX, clientY: clientY - raised }));
    }

    private goTo(mark: Mark, place: Point): void {
        this.places[mark] = inside(place, this.extent);
        this.redraw();
    }

    private letGo(): void {
        const { start } = this;
        this.start = this.drag = undefined;
        const place = start && this.places[start.mark];
        if (!start || !place || distance(place, start.place) === 0) return;
        this.events.said(`${this.labelOf(start.mark, place)}.`);
        this.events.moved(start.mark, place);
    }

    private key(mark: Mark, event: KeyboardEvent): void {
        const place = this.places[mark];
        if (!place || event.ctrlKey || event.metaKey || event.altKey) return;
        const step = arrowSteps[event.key];
        if (step) {
            this.start ??= { mark, place };
            const far = event.shiftKey ? 10 : 1;
            this.goTo(mark, [place[0] + far * step[0], place[1] + far * step[1]]);
        } else if (event.key === "Delete" || event.key === "Backspace") {
            this.start = undefined;
            this.events.moved(mark, undefined);
        } else if (event.key === "Escape" && this.start) {
            this.giveUp();
        } else {
            return;
        }
        event.preventDefault();
        event.stopPropagation();
    }
}
