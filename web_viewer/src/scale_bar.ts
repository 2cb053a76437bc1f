// The scale bar on the stage: a line of a round length.
import { centimetres, scaleBar } from "./camera";
import { byId } from "./dom";
import type { Stage } from "./stage";

const leastPixels = 50;

/** Shows the scale of the drawn frame; `noun` is what stands on the stage. */
export function showScaleBar(stage: Stage, noun: string): void {
    const { metres, pixels } = scaleBar(stage.pixelsPerMetre, leastPixels);
    byId("scale-bar").style.width = `${pixels.toFixed(1)}px`;
    const text = metres < 1 ? centimetres(metres) : `${metres} m`;
    const label = byId("scale-text");
    if (label.textContent !== text) label.textContent = text;
    const { ruling } = stage;
    const lines = ruling ? ` Lines on the ground every ${centimetres(ruling)}.` : "";
    label.title = `At the depth of the ${noun}.${lines}`;
}
