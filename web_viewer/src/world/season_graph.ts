// The graph of a year: how many fruit bodies of each species stand on each day, above the rain and the temperature.
import { byId, draw, make } from "../dom";
import {
    bars,
    dateOf,
    dayAtX,
    greatest,
    line,
    monthStarts,
    rootLines,
    roundAbove,
    xOfDay,
    type Strip,
} from "./season_curves";

export interface Weather {
    rain_mm: number[];
    temperature_c: number[];
    soil_water_mm: number[];
}

export interface SeasonSpecies {
    id: string;
    emerged: number;
    standing: number[];
}

/** Twelve colours that stay apart beside each other, one for each species that a world can have. */
export const seasonColours = [
    "#a63d2f", "#d98b2b", "#6d5a9c", "#3f7f6e", "#c9a227", "#7a3b22",
    "#4d7fa8", "#b5668a", "#8a9a3b", "#51453b", "#d9714e", "#2f5d3a",
] as const;

const height = { bodies: 92, gap: 8, weather: 46, months: 17 };

export class SeasonGraph {
    private readonly host = byId("season");
    private readonly svg = draw("svg", { class: "curves", "aria-hidden": true });
    private readonly legend = byId("season-legend");
    private readonly text = byId("season-text");
    private weather: Weather | undefined;
    private species: readonly SeasonSpecies[] = [];
    private day = 1;
    private hovered: number | undefined;
    private readonly now = draw("path", { class: "now" });
    private readonly hover = draw("path", { class: "hover" });

    /** `nameOf` returns the name of a species; `chosen` is called with a day that was clicked. */
    constructor(
        private readonly nameOf: (id: string) => string,
        chosen: (day: number) => void,
    ) {
        this.host.append(this.svg);
        this.host.addEventListener("click", (event) => chosen(this.dayOf(event)));
        this.host.addEventListener("pointermove", (event) => {
            this.hovered = this.dayOf(event);
            this.showDay();
        });
        this.host.addEventListener("pointerleave", () => {
            this.hovered = undefined;
            this.showDay();
        });
        new ResizeObserver(() => this.redraw()).observe(this.host);
    }

    setWeather(weather: Weather): void {
        this.weather = weather;
        this.redraw();
    }

    /** Shows the fruit bodies of a year; none while they are counted. */
    setSpecies(species: readonly SeasonSpecies[]): void {
        this.species = species;
        this.redraw();
    }

    setDay(day: number): void {
        this.day = day;
        this.showDay();
    }

    colourOf(id: string): string {
        const index = this.species.findIndex((one) => one.id === id);
        return seasonColours[index % seasonColours.length] ?? "";
    }

    private get strip(): Strip {
        return { left: 30, right: Math.max(this.host.clientWidth - 30, 60), top: 4, bottom: height.bodies };
    }

    private get weatherStrip(): Strip {
        const top = height.bodies + height.gap;
        return { ...this.strip, top, bottom: top + height.weather };
    }

    private dayOf(event: MouseEvent): number {
        return dayAtX(event.clientX - this.host.getBoundingClientRect().left, this.strip);
    }

    private redraw(): void {
        const { strip, weatherStrip, weather, species } = this;
        const total = weatherStrip.bottom + height.months;
        const width = this.host.clientWidth;
        for (const [name, value] of Object.entries({ width, height: total, viewBox: `0 0 ${width} ${total}` }))
            this.svg.setAttribute(name, String(value));
        const label = (x: number, y: number, text: string, anchor: string, kind = ""): SVGTextElement =>
            draw("text", { x, y, "text-anchor": anchor, class: kind || undefined }, text);
        const parts: SVGElement[] = [];
        for (const { name, day } of monthStarts()) {
            const x = strip.left + ((day - 1) / 365) * (strip.right - strip.left);
            parts.push(draw("path", { class: "month", d: `M${x.toFixed(1)},${strip.top}V${weatherStrip.bottom}` }));
            const wide = width > 560;
            parts.push(label(x + (strip.right - strip.left) / 24, total - 4, wide ? name : name.slice(0, 1), "middle"));
        }
        const series = species.map(({ standing }) => standing);
        const most = roundAbove(greatest(series));
        const lines = rootLines(series, most, strip).flatMap((d, index) => (d ? [{ d, ...species[index]! }] : []));
        // Rare species are in front of frequent ones.
        lines.sort((a, b) => Math.max(...b.standing) - Math.max(...a.standing));
        for (const { d, id } of lines) {
            const colour = this.colourOf(id);
            const area = `${d}V${strip.bottom}H${xOfDay(1, strip)}z`;
            parts.push(draw("path", { class: "area", d: area, fill: colour }));
            parts.push(draw("path", { class: "bodies", d, stroke: colour, "data-species": id }));
        }
        if (species.length > 0) {
            const half = (strip.top + strip.bottom) / 2;
            parts.push(draw("path", { class: "zero", d: `M${strip.left},${half}H${strip.right}` }));
            parts.push(label(strip.left - 4, strip.top + 8, String(most), "end"));
            if (most >= 4) parts.push(label(strip.left - 4, half + 4, String(most / 4), "end"));
        }
        parts.push(draw("path", { class: "base", d: `M${strip.left},${strip.bottom}H${strip.right}M${strip.left},${weatherStrip.bottom}H${strip.right}` }));
        if (weather) {
            const rain = roundAbove(Math.max(...weather.rain_mm));
            const [low, high] = [Math.min(...weather.temperature_c, 0), Math.max(...weather.temperature_c, 1)];
            const zero = weatherStrip.bottom - ((0 - low) / (high - low)) * height.weather;
            parts.push(draw("path", { class: "rain", d: bars(weather.rain_mm, rain, weatherStrip) }));
            parts.push(draw("path", { class: "zero warm", d: `M${strip.left},${zero.toFixed(1)}H${strip.right}` }));
            parts.push(draw("path", { class: "temperature", d: line(weather.temperature_c, low, high, weatherStrip) }));
            parts.push(label(strip.left - 4, weatherStrip.top + 8, `${rain}`, "end", "wet"));
            parts.push(label(strip.left - 4, weatherStrip.bottom, "mm", "end", "wet"));
            parts.push(label(strip.right + 4, weatherStrip.top + 8, `${Math.round(high)}°`, "start", "warm"));
            parts.push(label(strip.right + 4, weatherStrip.bottom, `${Math.round(low)}°`, "start", "warm"));
        }
        this.svg.replaceChildren(...parts, this.hover, this.now);
        this.showDay();
    }

    /** Shows the line of the day, or of the one under the pointer, with its numbers. */
    private showDay(): void {
        const { strip, weatherStrip, weather, species, hovered } = this;
        const vertical = (day: number): string => `M${xOfDay(day, strip).toFixed(1)},0V${weatherStrip.bottom}`;
        this.now.setAttribute("d", vertical(this.day));
        this.hover.style.display = hovered === undefined ? "none" : "";
        if (hovered !== undefined) this.hover.setAttribute("d", vertical(hovered));
        const day = hovered ?? this.day;
        const sum = species.reduce((all, { standing }) => all + (standing[day - 1] ?? 0), 0);
        const facts = [dateOf(day)];
        if (weather) {
            facts.push(`${(weather.temperature_c[day - 1] ?? 0).toFixed(1)} °C`);
            facts.push(`rain ${(weather.rain_mm[day - 1] ?? 0).toFixed(1)} mm`);
        }
        if (species.length > 0) facts.push(`${sum} fruit ${sum === 1 ? "body" : "bodies"} on 64 × 64 m`);
        this.text.textContent = facts.join(" · ");
        const rows = species
            .filter(({ standing }) => standing.some((count) => count > 0))
            .map(({ id, standing }) => ({ id, count: standing[day - 1] ?? 0 }));
        this.legend.replaceChildren(
            ...rows.map(({ id, count }) =>
                make(
                    "li",
                    { "data-species": id, class: count > 0 ? undefined : "none" },
                    make("span", { class: "swatch" }),
                    this.nameOf(id),
                    make("b", {}, String(count)),
                ),
            ),
        );
        for (const item of this.legend.children)
            (item.firstElementChild as HTMLElement).style.background = this.colourOf((item as HTMLElement).dataset["species"] ?? "");
        this.host.setAttribute("aria-label", `The year: ${this.text.textContent}`);
    }
}
