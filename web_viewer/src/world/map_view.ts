// The map beside the view: one of those that the world has, with the place and the direction of the view on it.
import { byId, draw, make } from "../dom";
import { asRequestFailed, getJson, send, type RequestFailed } from "../http";
import { words } from "../schema";
import { numbersOfBytes } from "./height_field";
import { paint, placeOnMap, rampStyle, rangeOf, shareOfMap } from "./map_colours";
import type { WorldState } from "./view_address";

/** Numbers along each side of the map, of which one or more are a pixel. */
const mapSize = 257;

/** What the service says of a map. */
interface MapFacts {
    description: string;
    unit: string;
    from: number;
    to: number;
    width: number;
    height: number;
    links: { png: string };
}

/** Where the view is. */
export interface Viewpoint {
    x: number;
    y: number;
    /** Clockwise from north, degrees. */
    heading: number;
}

export interface MapEvents {
    /** A place was chosen on the map. */
    chosen: (x: number, y: number) => void;
    /** Another map was chosen, or another species of the map of spores. */
    changed: (map: string, species: string) => void;
    failed: (failure: RequestFailed) => void;
}

/** Returns a number of a map with its unit. */
function readable(value: number, unit: string): string {
    const sign = { deg: "°", "": "" }[unit] ?? ` ${unit}`;
    return `${Number(value.toPrecision(unit === "" ? 2 : 3))}${sign}`;
}

export class MapView {
    private readonly canvas = byId<HTMLCanvasElement>("map-canvas");
    private readonly frame = byId("map-frame");
    private readonly choice = byId<HTMLSelectElement>("map-choice");
    private readonly speciesChoice = byId<HTMLSelectElement>("map-species");
    private readonly cone = draw("path", { class: "cone", d: "M0,0L-26,-46A53,53 0 0 1 26,-46Z" });
    private readonly plot = draw("rect", { class: "plot" });
    private readonly viewer = draw("g", { class: "viewer" }, this.cone, draw("circle", { r: 5 }));
    private readonly cursor = draw("circle", { class: "cursor", r: 5 });
    private readonly mark = draw("path", { class: "mark", d: "M-6,-6L6,6M6,-6L-6,6" });
    private readonly overlay = byId<HTMLElement>("map-overlay") as unknown as SVGSVGElement;
    /** Links to the descriptions of all maps, by name. */
    private links: Readonly<Record<string, string>> = {};
    private shown = "";
    private loading: AbortController | undefined;
    private numbers: Uint16Array | undefined;
    private facts: MapFacts | undefined;
    private extent = 1024;

    constructor(private readonly events: MapEvents) {
        this.overlay.append(this.plot, this.viewer, this.mark, this.cursor);
        this.cursor.style.display = this.mark.style.display = "none";
        this.choice.addEventListener("change", () => events.changed(this.choice.value, this.speciesChoice.value));
        this.speciesChoice.addEventListener("change", () => events.changed(this.choice.value, this.speciesChoice.value));
        this.frame.addEventListener("click", (event) => {
            const { x, y } = this.placeAt(event);
            events.chosen(x, y);
        });
        this.frame.addEventListener("pointermove", (event) => {
            const { x, y } = this.placeAt(event);
            this.showCursor(x, y);
        });
        this.frame.addEventListener("pointerleave", () => this.hideCursor());
        this.frame.addEventListener("keydown", (event) => this.onKey(event));
    }

    /** The place that arrows move, which is that of the view. */
    private at: Viewpoint = { x: 0, y: 0, heading: 0 };

    /** Offers the maps of a world. Returns the one that is shown if there is none of the wanted name. */
    offer(links: Readonly<Record<string, string>>, species: readonly { id: string; name: string }[]): void {
        this.links = links;
        this.choice.replaceChildren(...Object.keys(links).map((name) => make("option", { value: name }, words(name))));
        this.speciesChoice.replaceChildren(...species.map(({ id, name }) => make("option", { value: id }, name)));
    }

    has(map: string): boolean {
        return map in this.links;
    }

    /** Shows the map of a state; one that is shown already is not fetched again. */
    async show(world: string, extent: number, state: WorldState): Promise<void> {
        this.extent = extent;
        const name = this.has(state.map) ? state.map : (Object.keys(this.links)[0] ?? "");
        const link = this.links[name];
        if (link === undefined) return;
        this.choice.value = name;
        const ofSpecies = name === "spores";
        this.speciesChoice.hidden = !ofSpecies;
        if (state.species) this.speciesChoice.value = state.species;
        const time = /\/y\d+d\d+\/maps\//.test(link)
            ? `y${state.year}d${state.day}`
            : /\/y0\/maps\//.test(link)
              ? "y0"
              : `y${state.year}`;
        const species = ofSpecies && this.speciesChoice.value ? `&species=${this.speciesChoice.value}` : "";
        const query = `?size=${mapSize}${species}`;
        const address = `v1/worlds/${world}/${time}/maps/${name}`;
        if (address + query === this.shown) return;
        this.shown = address + query;
        await this.load(name, address, query);
    }

    private async load(name: string, address: string, query: string): Promise<void> {
        this.loading?.abort();
        const loading = new AbortController();
        this.loading = loading;
        this.frame.setAttribute("aria-busy", "true");
        try {
            const facts = await getJson<MapFacts>(`${address}.json${query}`, loading.signal);
            const isColoured = !facts.unit.includes("colour") && name !== "terrarium";
            const response = await send(`${address}.${isColoured ? "r16" : "png"}${query}`, { signal: loading.signal });
            if (isColoured) this.paintNumbers(name, facts, numbersOfBytes(await response.arrayBuffer()));
            else await this.paintImage(facts, await response.blob());
            if (loading.signal.aborted) return;
            this.facts = facts;
            byId("map-about").textContent = facts.description;
            const png = byId<HTMLAnchorElement>("map-png");
            png.href = facts.links.png;
            this.frame.dataset["map"] = address + query;
            this.showValue();
        } catch (error) {
            if (loading.signal.aborted) return;
            this.shown = "";
            this.events.failed(asRequestFailed(error, "The map cannot be shown"));
        }
        this.frame.setAttribute("aria-busy", "false");
    }

    private paintNumbers(name: string, facts: MapFacts, numbers: Uint16Array): void {
        const { width, height, from, to, unit } = facts;
        const range = rangeOf(numbers);
        const image = new ImageData(width, height);
        paint(numbers, range, name, image.data);
        this.canvas.width = width;
        this.canvas.height = height;
        this.canvas.getContext("2d")?.putImageData(image, 0, 0);
        this.numbers = numbers;
        const value = (number: number): string => readable(from + ((to - from) * number) / 65535, unit);
        const legend = byId("map-legend");
        legend.hidden = false;
        byId("map-ramp").style.background = rampStyle(name);
        byId("map-least").textContent = value(range[0]);
        byId("map-most").textContent = value(range[1]);
    }

    private async paintImage({ width, height }: MapFacts, blob: Blob): Promise<void> {
        const image = await createImageBitmap(blob);
        this.canvas.width = width;
        this.canvas.height = height;
        this.canvas.getContext("2d")?.drawImage(image, 0, 0);
        image.close();
        this.numbers = undefined;
        byId("map-legend").hidden = true;
    }

    /** Shows where the view is and where it looks. `size` of the plot, metres; 0 if none is shown. */
    showViewpoint(at: Viewpoint, extent: number, size: number): void {
        this.extent = extent;
        this.at = at;
        const { right, down } = this.inOverlay(at.x, at.y);
        this.viewer.setAttribute("transform", `translate(${right.toFixed(1)},${down.toFixed(1)}) rotate(${at.heading.toFixed(0)})`);
        const side = Math.max((size / extent) * 400, 7);
        this.plot.style.display = size > 0 ? "" : "none";
        for (const [name, value] of Object.entries({ x: right - side / 2, y: down - side / 2, width: side, height: side }))
            this.plot.setAttribute(name, value.toFixed(1));
    }

    showCursor(x: number, y: number): void {
        const { right, down } = this.inOverlay(x, y);
        this.cursor.style.display = "";
        this.cursor.setAttribute("cx", right.toFixed(1));
        this.cursor.setAttribute("cy", down.toFixed(1));
        this.showValue(x, y);
    }

    hideCursor(): void {
        this.cursor.style.display = "none";
        this.showValue();
    }

    /** Marks the place of the panel of reasons. */
    showMark(place: readonly [number, number] | undefined): void {
        this.mark.style.display = place ? "" : "none";
        if (!place) return;
        const { right, down } = this.inOverlay(...place);
        this.mark.setAttribute("transform", `translate(${right.toFixed(1)},${down.toFixed(1)})`);
    }

    /** Writes the number of the map at a place; that of the view without one. */
    private showValue(x = this.at.x, y = this.at.y): void {
        const text = `x ${x.toFixed(1)} m, y ${y.toFixed(1)} m`;
        const { numbers, facts } = this;
        let value = "";
        if (numbers && facts) {
            const { right, down } = shareOfMap(x, y, this.extent);
            const column = Math.round(right * (facts.width - 1));
            const row = Math.round(down * (facts.height - 1));
            const number = numbers[row * facts.width + column];
            if (number !== undefined)
                value = `: ${readable(facts.from + ((facts.to - facts.from) * number) / 65535, facts.unit)}`;
        }
        byId("map-value").textContent = text + value;
    }

    private inOverlay(x: number, y: number): { right: number; down: number } {
        const { right, down } = shareOfMap(x, y, this.extent);
        return { right: right * 400, down: down * 400 };
    }

    private placeAt(event: MouseEvent): { x: number; y: number } {
        const { left, top, width, height } = this.frame.getBoundingClientRect();
        return placeOnMap((event.clientX - left) / width, (event.clientY - top) / height, this.extent);
    }

    /** Arrows move the view by a hundredth of the map, with Shift by a tenth. */
    private onKey(event: KeyboardEvent): void {
        const step = (event.shiftKey ? 0.1 : 0.01) * this.extent;
        const steps: Record<string, [number, number]> = {
            ArrowLeft: [-step, 0],
            ArrowRight: [step, 0],
            ArrowUp: [0, step],
            ArrowDown: [0, -step],
        };
        const by = steps[event.key];
        if (!by || event.ctrlKey || event.altKey || event.metaKey) return;
        event.preventDefault();
        this.events.chosen(this.at.x + by[0], this.at.y + by[1]);
    }
}
