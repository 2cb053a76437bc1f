// What the page shows beside the model's settings: the open panel, the debug views, and how the
// model is photographed. The page's URL holds it, as everything else; no request of the service
// contains it.
import { lookNames, type LookName } from "./camera";
import { fNumbers, type FNumber } from "./depth_of_field";
import { lightNames, type LightName } from "./lights";

/** Weights of wind that can be shown as colours. */
export const windChannels = ["all", "bend", "flutter", "phase", "branch"] as const;
export type WindChannelView = (typeof windChannels)[number];

export const panels = ["shape", "export"] as const;
export type PanelName = (typeof panels)[number];

export interface ViewState {
    panel: PanelName;
    /** Whether solids for collision are drawn. */
    solids: boolean;
    /** Weights of wind that are shown; undefined for none. */
    weights: WindChannelView | undefined;
    /** The level of detail that is shown as large as it is drawn last; undefined for none. */
    level: number | undefined;
    /** Vertical field of view of the engine's camera, degrees. */
    fov: number;
    /** Height of the screen for which levels are judged, pixels. */
    screen: number;
    light: LightName;
    /** The named view that the camera has; undefined once it was turned by hand. */
    look: LookName | undefined;
    /** Stop of the lens; undefined without depth of field. */
    aperture: FNumber | undefined;
}

export const screenHeights = [720, 1080, 1440, 2160] as const;
export const fovRange = { min: 10, max: 150 } as const;

/** Names of the state in the page's query. */
export const viewNames = [
    "panel",
    "solids",
    "weights",
    "level",
    "fov",
    "screen",
    "light",
    "view",
    "aperture",
] as const;

export const initialView: ViewState = {
    panel: "shape",
    solids: true,
    weights: undefined,
    level: undefined,
    fov: 60,
    screen: 1080,
    light: "daylight",
    look: undefined,
    aperture: undefined,
};

function oneOf<T>(known: readonly T[], value: unknown): T | undefined {
    return known.find((one) => one === value);
}

/** Reads the state from the page's query; what it cannot use is as without it. */
export function readView(query: URLSearchParams): ViewState {
    const number = (name: string): number | undefined => {
        const text = query.get(name);
        return text !== null && /^\d+(\.\d+)?$/.test(text) ? Number(text) : undefined;
    };
    const fov = number("fov");
    return {
        panel: oneOf(panels, query.get("panel")) ?? initialView.panel,
        solids: query.get("solids") !== "hidden",
        weights: oneOf(windChannels, query.get("weights")),
        level: number("level"),
        fov:
            fov !== undefined && fov >= fovRange.min && fov <= fovRange.max ? fov : initialView.fov,
        screen: oneOf<number>(screenHeights, number("screen")) ?? initialView.screen,
        light: oneOf(lightNames, query.get("light")) ?? initialView.light,
        look: oneOf(lookNames, query.get("view")),
        aperture: oneOf<number>(fNumbers, number("aperture")) as FNumber | undefined,
    };
}

/** Returns the part of the page's query that holds the state: "&panel=export"; "" for the initial
 *  one. */
export function viewQuery(view: ViewState): string {
    const parts: string[] = [];
    if (view.panel !== initialView.panel) parts.push(`panel=${view.panel}`);
    if (!view.solids) parts.push("solids=hidden");
    if (view.weights) parts.push(`weights=${view.weights}`);
    if (view.level !== undefined) parts.push(`level=${view.level}`);
    if (view.fov !== initialView.fov) parts.push(`fov=${view.fov}`);
    if (view.screen !== initialView.screen) parts.push(`screen=${view.screen}`);
    if (view.light !== initialView.light) parts.push(`light=${view.light}`);
    if (view.look) parts.push(`view=${view.look}`);
    if (view.aperture !== undefined) parts.push(`aperture=${view.aperture}`);
    return parts.map((part) => `&${part}`).join("");
}

/** The state of the views, shared by all that show or change a part of it. */
export class ViewStore {
    private state: ViewState = initialView;
    private readonly listeners: ((view: ViewState) => void)[] = [];

    /** `changed` is called when the user has changed something, but not for what was read. */
    constructor(private readonly changed: (view: ViewState) => void) {}

    get current(): ViewState {
        return this.state;
    }

    /** Calls `listener` whenever the state is another one. */
    listen(listener: (view: ViewState) => void): void {
        this.listeners.push(listener);
    }

    change(changes: Partial<ViewState>): void {
        this.read({ ...this.state, ...changes });
        this.changed(this.state);
    }

    /** Shows the state of the page's URL. */
    read(view: ViewState): void {
        this.state = view;
        for (const listener of this.listeners) listener(view);
    }
}
