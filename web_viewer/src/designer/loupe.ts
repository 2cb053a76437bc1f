// A magnifier for what a finger covers: the picture around the dragged point, three times as large.
import { byId } from "../dom";
import type { Point } from "./gesture";

const magnification = 3;

export class Loupe {
    private readonly element = byId("loupe");
    private readonly view = byId("loupe-view");

    /** `scale` returns pixels of the picture per pixel of the screen. */
    constructor(private readonly scale: () => number) {}

    /** Shows the surroundings of a place of the picture, or nothing. */
    show(place: Point | undefined): void {
        this.element.hidden = !place;
        if (!place) return this.view.replaceChildren();
        const across = (this.element.clientWidth * this.scale()) / magnification;
        const [x, y] = place;
        this.view.setAttribute(
            "viewBox",
            `${x - across / 2} ${y - across / 2} ${across} ${across}`,
        );
        this.view.style.setProperty("--pixel", `${this.scale() / magnification}px`);
        // Copies of a use element would not have the styles of the picture.
        const copy = byId("sketch-content").cloneNode(true) as SVGElement;
        for (const each of [copy, ...copy.querySelectorAll("[role], [tabindex]")])
            for (const name of ["id", "role", "tabindex", "aria-label"]) each.removeAttribute(name);
        this.view.replaceChildren(copy);
        this.view.classList.toggle("paper", byId("sketch").classList.contains("paper"));
        // It must not be where the finger is.
        const sketch = byId<HTMLElement & SVGSVGElement>("sketch");
        const matrix = sketch.getScreenCTM();
        if (!matrix) return;
        const at = new DOMPoint(x, y).matrixTransform(matrix);
        const box = sketch.getBoundingClientRect();
        const nearCorner = at.x - box.left < box.width / 2 && at.y - box.top < box.height / 2;
        this.element.classList.toggle("right", nearCorner);
    }
}
