// The list of numbers about the shown model: size, counts, and how the server served it.
import { byId, grouped, kilobytes, make } from "./dom";
import type { LoadedModel } from "./model_loader";
import { countsOf } from "./model";

/** Returns the durations of a Server-Timing header: ["grow 12.3", ...], milliseconds. */
function timingsOf(header: string): string[] {
    return header.split(",").flatMap((part) => {
        const [name, ...rest] = part.trim().split(";");
        const duration = rest.map((item) => /^\s*dur=([\d.]+)/.exec(item)?.[1]).find(Boolean);
        return name && duration ? [`${name} ${Number(duration).toFixed(1)}`] : [];
    });
}

function megabytes(bytes: number): string {
    return `${(bytes / 1e6).toFixed(1)} MB`;
}

/** One level of detail, as the server describes it. */
export interface LevelReport {
    lod: number;
    triangles: number;
    /** Height of the bounding box over that of the screen down to which it is drawn. */
    screen_coverage: number;
}

/** Shows which share of the screen each level of detail is made for. */
export function showLevels(levels: readonly LevelReport[]): void {
    const list = byId("number-list");
    list.querySelector("#level-name")?.remove();
    list.querySelector("#level-list")?.remove();
    if (levels.length === 0) return;
    const texts = levels.map(
        ({ lod, triangles, screen_coverage: coverage }) =>
            `L${lod} ${grouped(triangles)} down to ${(100 * coverage).toPrecision(2)} %`,
    );
    list.append(
        make("dt", { id: "level-name", title: "Triangles, and height on the screen" }, "Levels"),
        make("dd", { id: "level-list" }, texts.join(" · ")),
    );
}

/** Shows the numbers of a model. */
export function showNumbers(loaded: LoadedModel): void {
    const { response, bytes, source } = loaded.fetched;
    const counts = countsOf(loaded.model);
    const header = (name: string): string | undefined => response.headers.get(name) ?? undefined;
    const origin = {
        server: "",
        browser: ", from this browser’s cache",
        confirmed: ", unchanged since (304)",
    }[source];
    const rows: [string, string | undefined][] = [
        ["File", kilobytes(bytes.byteLength)],
        ["Triangles", grouped(counts.triangles)],
        ["Vertices", grouped(counts.vertices)],
        ["Draw calls", String(counts.drawCalls)],
        ["Images", `${counts.textures}, ${megabytes(counts.imageBytes)} on the graphics card`],
        ["Status", `${response.status}${origin}`],
        ["Cache", header("cache-status")],
        ["Server ms", timingsOf(header("server-timing") ?? "").join(" · ") || undefined],
    ];
    const entries = rows.flatMap(([name, value]) =>
        value === undefined ? [] : [make("dt", {}, name), make("dd", {}, value)],
    );
    byId("number-list").replaceChildren(...entries);
    byId("numbers").classList.toggle("draft", loaded.draft);
}
