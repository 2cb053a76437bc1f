// The page: puts gallery, stage, controls and service together.
import "./app.css";
import { centimetres, scaleBar, viewNames, type ViewName } from "./camera";
import { Controls } from "./controls";
import { byId, grouped, kilobytes, make } from "./dom";
import { factLine, Gallery, type Species } from "./gallery";
import { Grower, type Grown } from "./grower";
import { getJson, RequestFailed, send, type Progress } from "./http";
import { countsOf } from "./model";
import { groupsOf, words, type Schema, type Value } from "./schema";
import { mixPattern, Settings, type Fault } from "./settings";
import { Stage } from "./stage";
import { makeThumbnails } from "./thumbnails";

const shot = new URLSearchParams(location.search).get("shot") === "1";
const calm = shot || matchMedia("(prefers-reduced-motion: reduce)").matches;

interface TestHandle {
    /** The shown model equals the controls, and a frame of it was drawn. */
    ready(): Promise<void>;
    view(name: ViewName): void;
    /** Of the last frame, and what the graphics card holds; `frames` drawn so far. */
    readonly renderer: { frames: number; calls: number; triangles: number; geometries: number; textures: number };
    readonly counts: { triangles: number; vertices: number; drawCalls: number; textures: number };
    /** Metres. */
    readonly size: { above: number; width: number; height: number; depth: number };
}

declare global {
    interface Window {
        sporeprint: TestHandle;
    }
}

const status = byId("status");
const say = (text: string): void => {
    status.textContent = text;
};

function showProblem(error: RequestFailed | undefined, controls?: Controls, retry?: () => void): void {
    const box = byId("problem");
    box.hidden = !error;
    box.replaceChildren();
    if (!error) return;
    box.append(make("strong", {}, error.title));
    const left = error.items.filter((item) => !controls?.fail(item.parameter, item.detail));
    if (error.detail) box.append(make("p", {}, error.detail));
    if (left.length > 0) {
        box.append(make("ul", {}, ...left.map((item) =>
            make("li", {}, make("b", {}, item.parameter), ` ${item.detail}`))));
    }
    if (retry) {
        const again = make("button", { type: "button" }, "Try again");
        again.addEventListener("click", retry);
        box.append(again);
    }
    box.scrollIntoView({ block: "nearest" });
}

class Page {
    private readonly settings: Settings;
    private readonly gallery: Gallery;
    private readonly controls: Controls;
    private readonly grower: Grower;
    private readonly lods = new Map<number, HTMLButtonElement>();
    private grown: Grown | undefined;
    private faults: Fault[] = [];
    private written: { name: string; at: number } | undefined;
    private writing: ReturnType<typeof setTimeout> | undefined;
    private readonly thumbnails = new AbortController();

    constructor(
        private readonly stage: Stage,
        schema: Schema,
        species: readonly Species[],
    ) {
        const groups = groupsOf(schema);
        const fields = groups.flatMap((group) => group.fields);
        this.settings = new Settings(fields, species[0]?.id ?? "");
        this.gallery = new Gallery(byId("gallery"), species, (id) => this.choose(id));
        this.controls = new Controls(byId("form"), groups, this.settings, {
            moving: () => {
                this.controls.show();
                this.grower.draft();
            },
            moved: (field) => this.changed(field.name),
        });
        this.grower = new Grower(this.settings, {
            progress: (progress) => this.showProgress(progress),
            show: (grown, refit, current) => this.show(grown, refit, current),
            effective: (resource) => this.controls.show(resource.effective),
            failed: (error) => this.failed(error),
        });
        stage.onFrame = () => this.showScale();
        this.makeTools();
        this.makeActions();
        this.makeDrop();
        byId("form").addEventListener("submit", (event) => event.preventDefault());
        addEventListener("popstate", () => this.readAddress());
        this.readAddress();
        if (!shot) void this.takeThumbnails();
    }

    async settled(): Promise<void> {
        this.flushAddress();
        await this.grower.settled();
    }

    get counts(): ReturnType<typeof countsOf> {
        return this.grown ? countsOf(this.grown.model) : { triangles: 0, vertices: 0, drawCalls: 0, textures: 0 };
    }

    private choose(mix: string): void {
        if (mix === this.settings.mix) return;
        this.settings.choose(mix);
        this.writeAddress("species");
        this.begin(true);
    }

    private changed(name: string): void {
        this.writeAddress(name);
        this.controls.show();
        this.markLod();
        this.showFaults([]);
        this.grower.final(false, 60);
    }

    /** Shows new settings from scratch: another species, another address, a dropped file. */
    private begin(refit: boolean): void {
        this.controls.clearFaults();
        this.showFaults([]);
        this.gallery.mark(this.settings.mix);
        this.controls.show(undefined);
        this.markLod();
        this.showNames();
        this.grower.final(refit);
    }

    /** Writes the settings into the page's address: one step back per drag or run of key presses.
     *  Browsers refuse many writes in a short time, so quick ones are gathered. */
    private writeAddress(name: string): void {
        const now = performance.now();
        const same = this.written?.name === name && now - this.written.at < 1500;
        if (same && now - (this.written?.at ?? 0) < 250) {
            clearTimeout(this.writing);
            this.writing = setTimeout(() => this.flushAddress(), 250);
            return;
        }
        this.flushAddress();
        this.store(same);
        this.written = { name, at: now };
    }

    private flushAddress(): void {
        if (this.writing === undefined) return;
        clearTimeout(this.writing);
        this.writing = undefined;
        this.store(true);
    }

    private store(replace: boolean): void {
        const address = this.settings.pageQuery(new URLSearchParams(location.search));
        if (address !== location.search) history[replace ? "replaceState" : "pushState"](null, "", address);
    }

    private readAddress(): void {
        clearTimeout(this.writing);
        this.writing = undefined;
        const query = new URLSearchParams(location.search);
        const asked = query.get("species");
        const mix = asked && this.canShow(asked) ? asked : (this.gallery.species[0]?.id ?? "");
        const refit = mix !== this.settings.mix || !this.grown;
        this.settings.mix = mix;
        const faults = this.settings.read(query);
        this.written = undefined;
        this.begin(refit);
        if (asked && asked !== mix) faults.push({ parameter: "species", detail: `'${asked}' is no species here` });
        this.showFaults(faults);
    }

    /** Whether all members of a mix are species of this server. */
    private canShow(mix: string): boolean {
        return mixPattern.test(mix) && mix.split(",").every((member) => this.gallery.find(member.split(":")[0] ?? ""));
    }

    /** What an address or a file asked for and cannot have; it stays until something is changed. */
    private showFaults(faults: Fault[]): void {
        this.faults = faults;
        if (faults.length === 0) return showProblem(undefined);
        const title = faults.length === 1 ? "One setting of the address was left out" : `${faults.length} settings of the address were left out`;
        showProblem(new RequestFailed(title, "", 0, faults), this.controls);
    }

    private async show(grown: Grown, refit: boolean, current: () => boolean): Promise<boolean> {
        if (!(await this.stage.show(grown.model, refit, current))) return false;
        this.grown = grown;
        if (!grown.draft) this.controls.clearFaults();
        this.showFaults(this.faults);
        this.showNumbers(grown);
        this.showDimensions();
        for (const id of ["download", "copy-url", "copy-curl"]) {
            byId<HTMLButtonElement>(id).disabled = grown.draft;
        }
        if (!grown.draft) {
            const { triangles } = countsOf(grown.model);
            say(`${byId("common-name").textContent}: ${grouped(triangles)} triangles, ${kilobytes(grown.answer.bytes.byteLength)}`);
        }
        return true;
    }

    private failed(error: RequestFailed): void {
        showProblem(error, this.controls, () => {
            showProblem(undefined);
            this.grower.final();
        });
        say(error.message);
    }

    private showNames(): void {
        const members = this.settings.mix.split(",").map((member) => member.split(":")[0] ?? "");
        const known = members.map((id) => this.gallery.find(id));
        const common = known.map((one, index) => one?.common_name ?? words(members[index] ?? ""));
        const latin = known.map((one, index) => one?.scientific_name ?? words(members[index] ?? ""));
        byId("common-name").textContent = common.join(" × ");
        byId("scientific-name").textContent = latin.join(" × ");
        byId("facts").textContent = known.length === 1 && known[0] ? factLine(known[0]) : "";
        document.title = `${common.join(" × ")} · Sporeprint`;
    }

    private showDimensions(): void {
        const { above, width, depth } = this.stage.size;
        
        byId("dimensions").textContent =
            `${centimetres(above, 1)} tall, ${centimetres(Math.max(width, depth), 1)} across`;
    }

    private showScale(): void {
        const { metres, pixels } = scaleBar(this.stage.pixelsPerMetre, 50);
        byId("scale-bar").style.width = `${pixels.toFixed(1)}px`;
        const text = centimetres(metres);
        const label = byId("scale-text");
        if (label.textContent !== text) label.textContent = text;
        label.title = `At the depth of the mushroom. Lines on the ground every ${centimetres(this.stage.ruling)}.`;
    }

    private showProgress(progress: Progress | { stage: "unpacking" } | { stage: "idle" }): void {
        const box = byId("progress");
        const bar = byId<HTMLProgressElement>("progress-bar");
        const text = byId("progress-text");
        box.hidden = progress.stage === "idle";
        box.classList.toggle("waiting", progress.stage === "waiting");
        byId("stage").setAttribute("aria-busy", String(progress.stage !== "idle"));
        bar.removeAttribute("value");
        if (progress.stage === "growing") text.textContent = "growing…";
        if (progress.stage === "unpacking") text.textContent = "unpacking…";
        if (progress.stage === "downloading") {
            const received = grouped(progress.received / 1000);
            if (progress.total) {
                bar.max = progress.total;
                bar.value = progress.received;
                text.textContent = `downloading ${received} of ${grouped(progress.total / 1000)} kB`;
            } else {
                text.textContent = `downloading, ${received} kB so far`;
            }
        }
        if (progress.stage === "waiting") {
            const seconds = Number(progress.seconds.toFixed(1));
            text.textContent = `the server is busy; again in ${seconds} s (${progress.attempt} of ${progress.attempts - 1})`;
            say(text.textContent);
        }
    }

    private showNumbers(grown: Grown): void {
        const { response, bytes, source } = grown.answer;
        const origin = { server: "", browser: ", from this browser’s cache", confirmed: ", unchanged since (304)" }[source];
        const counts = countsOf(grown.model);
        const header = (name: string): string | undefined => response.headers.get(name) ?? undefined;
        const timings = (header("server-timing") ?? "").split(",").flatMap((part) => {
            const [name, ...rest] = part.trim().split(";");
            const duration = rest.map((item) => /^\s*dur=([\d.]+)/.exec(item)?.[1]).find(Boolean);
            return name && duration ? [`${name} ${Number(duration).toFixed(1)}`] : [];
        });
        const rows: [string, string | undefined][] = [
            ["File", kilobytes(bytes.byteLength)],
            ["Triangles", grouped(counts.triangles)],
            ["Vertices", grouped(counts.vertices)],
            ["Draw calls", String(counts.drawCalls)],
            ["Images", String(counts.textures)],
            ["Status", `${response.status}${origin}`],
            ["Cache", header("cache-status")],
            ["Server ms", timings.join(" · ") || undefined],
        ];
        byId("number-list").replaceChildren(...rows.flatMap(([name, value]) =>
            value === undefined ? [] : [make("dt", {}, name), make("dd", {}, value)]));
        byId("numbers").classList.toggle("draft", grown.draft);
    }

    private makeTools(): void {
        const labels: Record<ViewName, string> = {
            "three-quarter": "¾", front: "Front", side: "Side", top: "Top", below: "Below",
        };
        for (const name of viewNames) {
            const button = make("button", { type: "button", title: `Look from: ${name}` }, labels[name]);
            button.addEventListener("click", () => this.stage.view(name, false));
            byId("views").append(button);
        }
        const lod = this.settings.field("lod");
        if (lod?.min !== undefined && lod.max !== undefined && lod.max - lod.min < 8) {
            for (let level = lod.min; level <= lod.max; ++level) {
                const button = make("button", { type: "button", "aria-pressed": "false", title: `Level of detail ${level}` }, `L${level}`);
                button.addEventListener("click", () => {
                    this.settings.set("lod", level);
                    this.changed("lod");
                });
                this.lods.set(level, button);
                byId("lods").append(button);
            }
        } else {
            byId("lods").hidden = true;
        }
        const toggle = (id: string, act: (on: boolean) => void): void => {
            const button = byId<HTMLButtonElement>(id);
            button.addEventListener("click", () => {
                const on = button.getAttribute("aria-pressed") !== "true";
                button.setAttribute("aria-pressed", String(on));
                act(on);
            });
        };
        toggle("wireframe", (on) => (this.stage.wireframe = on));
        toggle("night", (on) => paintStage(this.stage, on));
    }

    private markLod(): void {
        const lod: Value | undefined = this.settings.values.get("lod") ?? this.settings.field("lod")?.fallback;
        for (const [level, button] of this.lods) button.setAttribute("aria-pressed", String(level === lod));
    }

    /** Canonical URL of what is shown, absolute. */
    private canonical(): string {
        const { answer, address } = this.grown!;
        return new URL(answer.response.headers.get("content-location") ?? address, location.href).href;
    }

    private fileName(): string {
        const disposition = this.grown?.answer.response.headers.get("content-disposition") ?? "";
        return /filename="([\w.-]+)"/.exec(disposition)?.[1] ?? "mushroom.glb";
    }

    private makeActions(): void {
        const copy = async (text: string, what: string): Promise<void> => {
            try {
                await navigator.clipboard.writeText(text);
                say(`${what} copied`);
            } catch {
                // Without the right to the clipboard the text is shown for the person to take.
                prompt(what, text);
            }
        };
        byId("download").addEventListener("click", () => {
            if (!this.grown) return;
            const blob = new Blob([this.grown.answer.bytes], { type: "model/gltf-binary" });
            const address = URL.createObjectURL(blob);
            make("a", { href: address, download: this.fileName() }).click();
            setTimeout(() => URL.revokeObjectURL(address), 10_000);
            say(`${this.fileName()} saved`);
        });
        byId("copy-url").addEventListener("click", () => void copy(this.canonical(), "URL"));
        byId("copy-curl").addEventListener("click", () =>
            void copy(`curl -o '${this.fileName()}' '${this.canonical()}'`, "curl command"));
        const file = byId<HTMLInputElement>("file");
        byId("open").addEventListener("click", () => file.click());
        file.addEventListener("change", () => {
            const chosen = file.files?.[0];
            file.value = "";
            if (chosen) void this.inspect(chosen);
        });
    }

    private makeDrop(): void {
        const curtain = byId("drop");
        const carriesFile = (event: DragEvent): boolean => event.dataTransfer?.types.includes("Files") ?? false;
        addEventListener("dragover", (event) => {
            if (!carriesFile(event)) return;
            event.preventDefault();
            curtain.hidden = false;
        });
        addEventListener("dragleave", (event) => {
            if (!event.relatedTarget) curtain.hidden = true;
        });
        addEventListener("drop", (event) => {
            curtain.hidden = true;
            const dropped = event.dataTransfer?.files[0];
            if (!dropped) return;
            event.preventDefault();
            void this.inspect(dropped);
        });
    }

    /** Asks the service for the recipe of a file and follows it. */
    private async inspect(file: File): Promise<void> {
        say(`Reading ${file.name}`);
        try {
            const response = await send("/v1/inspect", {
                method: "POST",
                headers: { "Content-Type": "model/gltf-binary" },
                body: file,
            });
            const { canonical } = (await response.json()) as { canonical?: string };
            const address = new URL(canonical ?? "", location.href);
            const mix = /^\/v1\/mushrooms\/([^/]+)\.(?:glb|json)$/.exec(decodeURIComponent(address.pathname))?.[1];
            if (!mix || !mixPattern.test(mix)) {
                throw new RequestFailed(`${file.name} is not a mushroom of this page`, canonical ? `It was made by ${canonical}` : "It names no recipe.", 0);
            }
            const refit = mix !== this.settings.mix;
            this.settings.mix = mix;
            const faults = this.settings.read(address.searchParams);
            this.writeAddress("file");
            this.begin(refit);
            this.showFaults(faults);
            say(`Settings of ${file.name} restored`);
        } catch (error) {
            const failed = error instanceof RequestFailed
                ? error
                : new RequestFailed(`${file.name} could not be read`, error instanceof Error ? error.message : "", 0);
            showProblem(failed, this.controls);
            say(failed.message);
        }
    }

    /** Pictures for the gallery, once the person has what they came for. */
    private async takeThumbnails(): Promise<void> {
        await this.settled().catch(() => undefined);
        const query = ["lod", "texture_size"].flatMap((name) => {
            const field = this.settings.field(name);
            const least = name === "lod" ? Math.min(2, field?.max ?? 0) : field?.options.find((side) => Number(side) >= 256);
            return field && least !== undefined ? [`${name}=${least}`] : [];
        }).join("&");
        const models = this.gallery.species.map(({ id, links }) => {
            const model = links?.model ?? `/v1/mushrooms/${id}.glb`;
            return { id, address: query ? `${model}${model.includes("?") ? "&" : "?"}${query}` : model };
        });
        await makeThumbnails(models, (id, picture) => this.gallery.picture(id, picture), this.thumbnails.signal);
        document.documentElement.dataset["gallery"] = "complete";
    }
}

/** Day: ink on paper. Dusk: the same sheet on the forest floor. */
function paintStage(stage: Stage, dusk: boolean): void {
    document.documentElement.classList.toggle("dusk", dusk);
    const style = getComputedStyle(document.documentElement);
    stage.colours(style.getPropertyValue("--rule").trim(), style.getPropertyValue("--shade").trim());
}

async function open(): Promise<void> {
    document.documentElement.classList.toggle("shot", shot);
    const [schema, list] = await Promise.all([
        getJson<Schema>("/v1/mushrooms/schema"),
        getJson<{ species: Species[] }>("/v1/species"),
    ]);
    const stage = new Stage(byId("stage"), byId<HTMLCanvasElement>("canvas"), { calm, bare: shot });
    paintStage(stage, false);
    const page = new Page(stage, schema, list.species);
    window.sporeprint = {
        ready: async () => {
            await page.settled();
            await stage.drawn();
        },
        view: (name) => stage.view(name),
        get renderer() {
            const { render, memory } = stage.renderer.info;
            return { frames: render.frame, calls: render.calls, triangles: render.triangles, ...memory };
        },
        get counts() {
            return page.counts;
        },
        get size() {
            return stage.size;
        },
    };
}

open().catch((error: unknown) => {
    const failed = error instanceof RequestFailed
        ? error
        : new RequestFailed("This page cannot start", error instanceof Error ? error.message : "", 0);
    showProblem(failed, undefined, () => location.reload());
    say(failed.message);
});
