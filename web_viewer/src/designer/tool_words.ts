// What the tools are called, and what the page tells the person to do with them.
import type { Tool } from "./gesture";

export interface ToolWords {
    label: string;
    sentence: string;
    title: string;
}

export const words: Readonly<Record<Tool, ToolWords>> = {
    axis: {
        label: "Foot to top",
        sentence: "Draw from the foot to the top",
        title: "The line through the middle of the stem up to the top of the cap",
    },
    cap: {
        label: "Across the cap",
        sentence: "Now across the cap",
        title: "The line from margin to margin",
    },
    keep: {
        label: "Keep",
        sentence: "Something is missing? Draw on it",
        title: "A stroke on a part of the mushroom that the outline leaves out",
    },
    drop: {
        label: "Drop",
        sentence: "Too much? Draw on what is no part of it",
        title: "A stroke on something that the outline includes by mistake",
    },
    frame: {
        label: "Frame",
        sentence: "Draw a frame around the mushroom",
        title: "What is outside of the frame is background",
    },
};
