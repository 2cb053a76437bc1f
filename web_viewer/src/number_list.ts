// Numbers about the shown model: what its file costs, and how the server served it.
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
    const costs: [string, string, string?][] = [
        ["File", kilobytes(bytes.byteLength)],
        ["Triangles", grouped(counts.triangles)],
        ["Vertices", grouped(counts.vertices)],
        ["Draw calls", String(counts.drawCalls)],
        ["Images", String(counts.textures)],
        ["Texture memory", megabytes(counts.imageBytes), "As RGBA with mipmaps"],
    ];
    const service: [string, string | undefined][] = [
        ["Status", `${response.status}${origin}`],
        ["Cache", header("cache-status")],
        ["Server ms", timingsOf(header("server-timing") ?? "").join(" · ") || undefined],
    ];
    const tiles = costs.map(([name, value, title]) =>
        make("div", { title }, make("dt", {}, name), make("dd", {}, value)),
    );
    byId("costs").replaceChildren(...tiles);
    byId("costs").classList.toggle("draft", loaded.draft);
    const entries = service.flatMap(([name, value]) =>
        value === undefined ? [] : [make("dt", {}, name), make("dd", {}, value)],
    );
    byId("number-list").replaceChildren(...entries);
}
