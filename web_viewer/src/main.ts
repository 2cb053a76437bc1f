// The page: puts gallery, stage, controls and service together.
import "./app.css";
import { Bench } from "./bench";
import { centimetres, length, scaleBar, type ViewName } from "./camera";
import { Controls } from "./controls";
import { byId, grouped, kilobytes, make } from "./dom";
import { factLine, Gallery, type Species } from "./gallery";
import { Grower, type Grown } from "./grower";
import { Growth } from "./growth";
import { getJson, RequestFailed, send, type ProblemItem, type Progress } from "./http";
import { fewestMembers, mostMembers, readShares, sharesText } from "./mix";
import { MatrixTable } from "./matrix";
import { countsOf, paintOf } from "./model";
import { Paint } from "./paint";
import { groupsOf, valueAt, words, type Schema, type Value } from "./schema";
import { grownAt, mushrooms, productOf, type Product } from "./products";
import { mixPattern, Settings, type Fault } from "./settings";
import { Sheet, sheetButtons, type SheetKind } from "./sheet";
import { Stage } from "./stage";
import { makeThumbnails } from "./thumbnails";

const shot = new URLSearchParams(location.search).get("shot") === "1";
const calm = shot || matchMedia("(prefers-reduced-motion: reduce)").matches;

/** How long a hand must rest on the age of a clip before the model of that age is asked for. */
const restMs = 900;

interface TestHandle {
    /** The shown model equals the controls, and a frame of it was drawn. */
    ready(): Promise<void>;
    view(name: ViewName): void;
    /** Of the last frame, and what the graphics card holds; `frames` drawn so far. */
    readonly renderer: { frames: number; calls: number; triangles: number; geometries: number; textures: number };
    readonly counts: { triangles: number; vertices: number; drawCalls: number; textures: number };
    /** The age that a clip shows now, and whether it runs. */
    readonly growth: { age: number | undefined; playing: boolean };
    /** Individuals of a colony: how many there was room for, and how many were asked for. */
    readonly made: { made: number; asked: number } | undefined;
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

/** Something that can show a problem at its own place; false when it has no such place. */
type Place = (item: ProblemItem) => boolean;

function showProblem(error: RequestFailed | undefined, place: Place = () => false, retry?: () => void): void {
    const box = byId("problem");
    box.hidden = !error;
    box.replaceChildren();
    if (!error) return;
    box.append(make("strong", {}, error.title));
    const left = error.items.filter((item) => !place(item));
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
    private readonly paint = new Paint();
    private readonly bench: Bench;
    private readonly sheet: Sheet;
    private readonly matrix: MatrixTable | undefined;
    private readonly place: Place = (item) =>
        // Of a body the service names the members by pointers.
        this.matrix?.fail(item.parameter, item.detail) ||
        this.controls.fail(item.parameter.replace(/^\//, "").replaceAll("/", "."), item.detail) || this.bench.fail(item);
    private readonly growth: Growth;
    private readonly playButton = make("button", { type: "button", id: "play", class: "play" });
    private readonly lods = new Map<number, HTMLButtonElement>();
    private grown: Grown | undefined;
    /** Individuals of a colony that were made and asked for, once the service said so. */
    made: { made: number; asked: number } | undefined;
    private faults: Fault[] = [];
    private written: { name: string; at: number } | undefined;
    private writing: ReturnType<typeof setTimeout> | undefined;
    private readonly thumbnails = new AbortController();

    constructor(
        private readonly stage: Stage,
        private readonly product: Product,
        schema: Schema,
        species: readonly Species[],
    ) {
        const groups = groupsOf(schema, product.whole);
        const fields = groups.flatMap((group) => group.fields);
        this.settings = new Settings(fields, species[0]?.id ?? "", product);
        this.gallery = new Gallery(byId("gallery"), species, (id) => this.choose(id));
        this.controls = new Controls(byId("form"), groups, this.settings, {
            moving: ({ name }) => {
                this.controls.show();
                if (name !== "age" || !this.scrub()) this.grower.draft();
            },
            moved: ({ name }) => this.changed(name),
        });
        this.bench = new Bench(this.settings, species, {
            moving: () => {
                this.showNames();
                this.grower.draft(0);
            },
            moved: (name) => this.changed(name),
            chosen: () => {
                // Each species that joins or leaves is a step of its own.
                this.writeAddress(`morph ${this.settings.morph?.shares.map(({ id }) => id).join() ?? ""}`);
                this.begin(true);
            },
            say,
        });
        this.sheet = new Sheet(this.settings, species, {
            changed: (kind) => this.sheetChanged(kind),
            say,
            save: (blob, name) => this.save(blob, name),
        });
        this.paint.onChange = () => stage.draw();
        this.grower = new Grower(this.settings, this.paint, {
            progress: (progress) => this.showProgress(progress),
            show: (grown, refit, current) => this.show(grown, refit, current),
            effective: (resource) => {
                this.controls.show(resource.effective);
                this.matrix?.serve(resource.matrix);
                this.made = resource.made === undefined
                    ? undefined
                    : { made: resource.made, asked: Number(valueAt(resource.effective, "count") ?? resource.made) };
                this.showDimensions();
            },
            failed: (error) => this.failed(error),
        });
        this.matrix = product.ramifies ? new MatrixTable(this.settings, { changed: () => this.changed("rows") }) : undefined;
        this.growth = new Growth({
            posed: (age) => {
                this.stage.posed();
                this.showAge(age);
            },
            ended: () => this.endGrowth(),
        });
        stage.onFrame = () => this.showScale();
        this.makeTools();
        this.makeFind();
        this.makePlay();
        this.makeActions();
        this.makeModes();
        this.makeDrop();
        byId("form").addEventListener("submit", (event) => event.preventDefault());
        addEventListener("popstate", () => this.readAddress());
        this.readAddress();
        if (!shot) void this.takeThumbnails();
    }

    async settled(): Promise<void> {
        this.flushAddress();
        await this.bench.settled();
        await this.grower.settled();
        await this.sheet.settled();
    }

    get growing(): TestHandle["growth"] {
        return { age: this.growth.age, playing: this.growth.playing };
    }

    get counts(): ReturnType<typeof countsOf> {
        return this.grown ? countsOf(this.grown.model) : { triangles: 0, vertices: 0, drawCalls: 0, textures: 0 };
    }

    private choose(mix: string): void {
        if (this.settings.morph) return this.bench.toggle(mix);
        if (mix === this.settings.mix) return;
        this.settings.choose(mix);
        this.writeAddress("species");
        this.begin(true);
    }

    /** Looks from a named side. */
    view(name: ViewName, atOnce = true): void {
        this.stage.view(name, atOnce);
        byId("views").querySelector('[data-view="roots"]')?.setAttribute("aria-pressed", String(name === "roots"));
    }

    /** From one species to the bench and back; what was mixed goes along. */
    private makeModes(): void {
        if (!this.product.lives) return;
        byId("mode-species").addEventListener("click", (event) => {
            if (!plainClick(event)) return;
            event.preventDefault();
            const { morph } = this.settings;
            if (!morph) return;
            const strongest = [...morph.shares].sort((one, other) => other.weight - one.weight)[0];
            this.settings.setMorph(undefined);
            this.settings.choose(strongest?.id ?? this.settings.mix);
            this.writeAddress("mode");
            this.begin(true);
        });
        byId("mode-morph").addEventListener("click", (event) => {
            if (!plainClick(event)) return;
            event.preventDefault();
            if (!this.settings.morph) this.bench.enter(readShares(this.settings.mix) ?? []);
        });
        byId("sheets").append(sheetButtons((kind) => this.sheet.show(kind)));
    }

    private showMode(): void {
        const { morph } = this.settings;
        document.documentElement.classList.toggle("morphing", morph !== undefined);
        if (this.product.ofSpecies) this.linkMix();
        if (!this.product.lives) return;
        for (const [id, on] of [["mode-species", !morph], ["mode-morph", Boolean(morph)]] as const) {
            if (on) byId(id).setAttribute("aria-current", "page");
            else byId(id).removeAttribute("aria-current");
        }
        const first = morph?.shares.find(({ weight }) => weight > 0)?.id ?? this.settings.mix.split(/[:,]/)[0];
        const other = this.gallery.species.find(({ id }) => id !== first)?.id;
        byId("mode-species").setAttribute("href", `?species=${first}`);
        byId("mode-morph").setAttribute("href", morph ? location.search : `?morph=${first}:0.5,${other}:0.5`);
        byId("variety").hidden = !morph;
        // On the bench sheets are what one comes for; beside a lone species they are one thing more to take along.
        (morph ? byId("bench") : byId("form")).after(byId("sheets"));
        this.gallery.letter(morph?.shares.map(({ id }) => id) ?? []);
    }

    /** What stands here goes along to the colony of it and back. */
    private linkMix(): void {
        const { mix } = this.settings;
        byId("mode-colony").setAttribute("href", `?colony=${mix}`);
        if (this.product.lives) return;
        const shares = readShares(mix) ?? [];
        byId("mode-species").setAttribute("href", `?species=${mix}`);
        if (shares.length >= fewestMembers && shares.length <= mostMembers) byId("mode-morph").setAttribute("href", `?morph=${sharesText(shares)}`);
        byId("mode-morph").hidden = shares.length < fewestMembers || shares.length > mostMembers;
    }

    private sheetChanged(kind: SheetKind | undefined): void {
        const query = new URLSearchParams(location.search);
        if ((query.get("sheet") ?? undefined) === kind) return;
        this.flushAddress();
        const address = this.settings.pageQuery(query) + (kind ? `&sheet=${kind}` : "");
        history[kind ? "pushState" : "replaceState"](null, "", address);
    }

    private save(blob: Blob, name: string): void {
        const address = URL.createObjectURL(blob);
        make("a", { href: address, download: name }).click();
        setTimeout(() => URL.revokeObjectURL(address), 10_000);
        say(`${name} saved`);
    }

    private changed(name: string): void {
        // Who names a matrix, or asks for a higher order, leaves the rows of one's own.
        if (name === "matrix" || name === "blend" || name === "toward" || name === "order") this.settings.rows = undefined;
        this.writeAddress(name);
        if (name === "age") this.bench.readGraph();
        this.controls.show();
        this.markLod();
        this.showFaults([]);
        // Who moves through a clip sees it at once; the model of that age follows when the hand rests.
        if (name === "age" && this.scrub()) return this.grower.final(false, restMs);
        this.leaveGrowth();
        this.grower.final(false, 60);
    }

    /** Poses the clip on the stage, if there is one, at the age of the settings. */
    private scrub(): boolean {
        this.growth.pause();
        this.markPlay();
        const age = this.settings.values.get("age") ?? this.settings.field("age")?.fallback;
        return typeof age === "number" && this.growth.pose(age);
    }

    private leaveGrowth(): void {
        this.growth.leave();
        this.markPlay();
    }

    /** The button beside the age: grows what is on the stage. */
    private makePlay(): void {
        const row = byId("form").querySelector('.control[data-name="age"]');
        if (!row || !this.settings.grows) return;
        row.classList.add("playable");
        row.querySelector(".entry")?.append(this.playButton);
        this.playButton.addEventListener("click", () => {
            if (this.growth.playing) this.pauseGrowth();
            else if (this.growth.ready) this.startGrowth();
            else this.grower.clip();
            this.markPlay();
        });
        this.markPlay();
    }

    private markPlay(): void {
        const { playing } = this.growth;
        const label = playing ? "Stay at this age" : "Play growth";
        this.playButton.textContent = playing ? "❚❚" : "▶";
        this.playButton.title = label;
        this.playButton.setAttribute("aria-label", label);
    }

    private startGrowth(): void {
        if (calm) {
            say("Growth is loaded: move the age to see it");
            document.querySelector<HTMLElement>('[name="age"]')?.focus();
            return;
        }
        this.growth.play(0);
        this.markPlay();
        say("Growing");
    }

    /** What is seen becomes what is asked for. */
    private pauseGrowth(): void {
        this.growth.pause();
        const step = this.settings.field("age")?.step ?? 0.01;
        const age = Math.round((this.growth.age ?? 0) / step) * step;
        this.settings.set("age", Number(age.toFixed(4)));
        this.changed("age");
        say(`Stopped at age ${age.toFixed(2)}`);
    }

    /** Grown to the end: back to the mushroom that was asked for. */
    private endGrowth(): void {
        this.markPlay();
        this.grower.final(false, restMs);
    }

    /** The slider follows the clip; the settings stay. */
    private showAge(age: number): void {
        for (const entry of byId("form").querySelectorAll<HTMLInputElement>('input[name="age"]')) {
            if (entry !== document.activeElement || entry.type === "range") entry.value = String(Number(age.toFixed(3)));
            entry.style.setProperty("--to", `${100 * age}%`);
        }
    }

    /** Shows new settings from scratch: another species, another address, a dropped file. */
    private begin(refit: boolean): void {
        this.controls.clearFaults();
        this.leaveGrowth();
        this.showFaults([]);
        this.gallery.mark(this.settings.morph?.shares.map(({ id }) => id).join(",") ?? this.settings.mix);
        this.showMode();
        this.bench.show();
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
        // Another product's address is another page.
        if (productOf(query) !== this.product) return location.reload();
        const asked = query.get(this.product.kind);
        const before = this.settings.mix;
        const faults = this.settings.readMorph(query, (id) => this.gallery.find(id) !== undefined);
        const mix = this.settings.morph ? this.settings.mix : asked && this.canShow(asked) ? asked : (this.gallery.species[0]?.id ?? "");
        const refit = mix !== before || !this.grown;
        this.settings.mix = mix;
        faults.push(...this.settings.read(query), ...this.settings.readMatrix(query));
        this.written = undefined;
        this.begin(refit);
        if (asked && asked !== mix) faults.push({ parameter: this.product.kind, detail: `'${asked}' is no ${this.product.ofSpecies ? "species" : this.product.kind} here` });
        this.showFaults(faults);
        const sheet = query.get("sheet");
        if (sheet === "growth" || (sheet === "variety" && this.settings.morph)) this.sheet.show(sheet);
        else this.sheet.close();
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
        showProblem(new RequestFailed(title, "", 0, faults), this.place);
    }

    private async show(grown: Grown, refit: boolean, current: () => boolean): Promise<boolean> {
        if (!(await this.stage.show(grown.model, refit, current))) return false;
        this.grown = grown;
        if (grown.draft) this.paint.dress(paintOf(grown.model));
        else this.paint.adopt(grown.model);
        this.bench.accept();
        if (this.growth.ready) this.controls.show();
        this.growth.take(grown.model);
        this.markPlay();
        if (!grown.draft) {
            this.controls.clearFaults();
            this.matrix?.clearFaults();
        }
        this.showFaults(this.faults);
        this.showNumbers(grown);
        if (grown.draft) this.made = undefined;
        this.showDimensions();
        for (const id of ["download", "copy-url", "copy-curl"]) {
            byId<HTMLButtonElement>(id).disabled = grown.draft;
        }
        if (grown.wanted.body !== undefined) {
            // Own arcs are told in a request's body: no URL says them.
            byId<HTMLButtonElement>("copy-url").disabled = !grown.answer.response.headers.has("content-location");
        }
        if (!grown.draft) {
            const { triangles } = countsOf(grown.model);
            say(`${byId("common-name").textContent}: ${grouped(triangles)} triangles, ${kilobytes(grown.answer.bytes.byteLength)}`);
        }
        if (grown.clip) this.startGrowth();
        return true;
    }

    private failed(error: RequestFailed): void {
        // What is against arcs stands beside the arcs.
        if (error.items.length > 0 && error.items.every((item) => this.bench.fail(item))) return say(error.items[0]?.detail ?? error.message);
        showProblem(error, this.place, () => {
            showProblem(undefined);
            this.grower.final();
        });
        say(error.message);
    }

    private showNames(): void {
        const shares = readShares(this.settings.mix) ?? [];
        const members = shares.map(({ id }) => ({ id, known: this.gallery.find(id) }));
        const common = members.map(({ id, known }) => known?.common_name ?? words(id));
        const latin = members.map(({ id, known }) => known?.scientific_name ?? words(id));
        const lone = members.length === 1 ? members[0]?.known : undefined;
        const title = common.length > 2 ? `Morph of ${common.length} species` : common.join(" × ");
        byId("common-name").textContent = title;
        byId("scientific-name").textContent = common.length > 2 ? "" : latin.join(" × ");
        byId("facts").textContent = lone
            ? factLine(lone)
            : shares.map(({ weight }, index) => `${Number((weight * 100).toFixed(1))} % ${common[index]}`).join(" · ");
        document.title = `${title} · Sporeprint`;
    }

    private showDimensions(): void {
        const { above, width, depth } = this.stage.size;
        byId("dimensions").textContent = this.product.lies
            ? `${centimetres(depth, 1)} long, ${centimetres(width, 1)} wide`
            : `${length(above)} tall, ${length(Math.max(width, depth))} across`;
        if (this.made) byId("dimensions").append(` · ${this.made.made} of ${this.made.asked} made`);
    }

    private showScale(): void {
        const { metres, pixels } = scaleBar(this.stage.pixelsPerMetre, 50);
        byId("scale-bar").style.width = `${pixels.toFixed(1)}px`;
        const text = metres < 1 ? centimetres(metres) : `${metres} m`;
        const label = byId("scale-text");
        if (label.textContent !== text) label.textContent = text;
        label.title = `At the depth of the ${this.product.noun}. Lines on the ground every ${centimetres(this.stage.ruling)}.`;
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
            "three-quarter": "¾", front: "Front", side: "Side", top: "Top", below: "Below", roots: "Roots",
        };
        for (const name of this.product.views) {
            const title = name === "roots" ? "Roots and stems from above, without what stands on them" : `Look from: ${name}`;
            const button = make("button", { type: "button", title, "data-view": name }, labels[name]);
            button.addEventListener("click", () => this.view(name, false));
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
        const { answer, wanted } = this.grown!;
        return new URL(answer.response.headers.get("content-location") ?? wanted.address, location.href).href;
    }

    private curl(): string {
        const { answer, wanted } = this.grown!;
        const posted = wanted.body !== undefined && !answer.response.headers.has("content-location");
        const data = posted ? ` -H 'Content-Type: application/json' -d '${wanted.body}'` : "";
        return `curl -o '${this.fileName()}'${data} '${this.canonical()}'`;
    }

    private fileName(): string {
        const disposition = this.grown?.answer.response.headers.get("content-disposition") ?? "";
        return /filename="([\w.-]+)"/.exec(disposition)?.[1] ?? `${this.product.noun}.glb`;
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
            this.save(new Blob([this.grown.answer.bytes], { type: "model/gltf-binary" }), this.fileName());
        });
        byId("copy-url").addEventListener("click", () => void copy(this.canonical(), "URL"));
        byId("copy-curl").addEventListener("click", () =>
            void copy(this.curl(), "curl command"));
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
            const response = await send("v1/inspect", {
                method: "POST",
                headers: { "Content-Type": "model/gltf-binary" },
                body: file,
            });
            const { canonical } = (await response.json()) as { canonical?: string };
            const address = new URL(canonical ?? "", location.href);
            const grown = grownAt(decodeURIComponent(address.pathname));
            if (grown && grown.product !== this.product && mixPattern.test(grown.id)) {
                const query = address.search.replace("?", "&");
                this.thumbnails.abort();
                return location.assign(`?${grown.product.kind}=${grown.id}${query}`);
            }
            const mix = grown?.id;
            if (!mix || !mixPattern.test(mix)) {
                throw new RequestFailed(`${file.name} is not a ${this.product.noun} of this page`, canonical ? `It was made by ${canonical}` : "It names no recipe.", 0);
            }
            const refit = mix !== this.settings.mix;
            this.settings.setMorph(undefined);
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
            showProblem(failed, this.place);
            say(failed.message);
        }
    }

    /** The search field above the gallery: every word narrows the list, Escape gives it back whole. */
    private makeFind(): void {
        const find = byId<HTMLInputElement>("find");
        const show = (): void => {
            const shown = this.gallery.show(find.value);
            const all = this.gallery.species.length;
            byId("found").textContent = find.value.trim() ? `${shown} of ${all}` : "";
        };
        find.addEventListener("input", show);
        find.addEventListener("keydown", (event) => {
            if (event.key !== "Escape" || find.value === "") return;
            event.preventDefault();
            find.value = "";
            show();
        });
    }

    /** Pictures for the gallery, once the person has what they came for. */
    private async takeThumbnails(): Promise<void> {
        await this.settled().catch(() => undefined);
        const query = ["lod", "texture_size"].flatMap((name) => {
            const field = this.settings.field(name);
            const least = name === "lod" ? Math.min(2, field?.max ?? 0) : field?.options.find((side) => Number(side) >= 256);
            return field && least !== undefined ? [`${name}=${least}`] : [];
        }).join("&");
        // Where the list is of species, it shows one of each.
        const path = this.product.ofSpecies ? mushrooms.path : this.product.path;
        const models = this.gallery.species.map(({ id }) => ({ id, address: `${path}/${id}.glb${query ? `?${query}` : ""}` }));
        await makeThumbnails(models, this.product.portraits, (id, picture) => this.gallery.picture(id, picture), this.thumbnails.signal);
        document.documentElement.dataset["gallery"] = "complete";
    }
}

/** A click that means this window. */
function plainClick(event: MouseEvent): boolean {
    return !(event.ctrlKey || event.metaKey || event.shiftKey || event.altKey);
}

/** Day: ink on paper. Dusk: the same sheet on the forest floor. */
function paintStage(stage: Stage, dusk: boolean): void {
    document.documentElement.classList.toggle("dusk", dusk);
    const style = getComputedStyle(document.documentElement);
    stage.colours(style.getPropertyValue("--rule").trim(), style.getPropertyValue("--shade").trim());
}

/** What of the page says what grows on it. */
function dressPage(product: Product): void {
    const canvas = byId("canvas");
    canvas.setAttribute("aria-label", (canvas.getAttribute("aria-label") ?? "").replace("mushroom", product.noun));
    for (const mode of ["species", "morph", "leaf", "tree", "colony"]) {
        const current = mode === product.kind;
        if (current) byId(`mode-${mode}`).setAttribute("aria-current", "page");
        else byId(`mode-${mode}`).removeAttribute("aria-current");
    }
    if (product === mushrooms) return;
    // Only mushrooms have something between them, a life to play and a season.
    byId("mode-morph").hidden = byId("sheets").hidden = true;
    if (product.ofSpecies) return;
    byId<HTMLInputElement>("find").placeholder = "Name…";
    byId("gallery").parentElement?.setAttribute("aria-label", words(product.kind));
    byId("find").setAttribute("aria-label", `Find a ${product.noun}`);
}

async function open(): Promise<void> {
    document.documentElement.classList.toggle("shot", shot);
    const product = productOf(new URLSearchParams(location.search));
    dressPage(product);
    const [schema, list] = await Promise.all([getJson<Schema>(`${product.path}/schema`), product.list()]);
    const stage = new Stage(byId("stage"), byId<HTMLCanvasElement>("canvas"), { calm, bare: shot, directions: product.directions, lies: product.lies });
    paintStage(stage, false);
    const page = new Page(stage, product, schema, list);
    window.sporeprint = {
        ready: async () => {
            await page.settled();
            await stage.drawn();
        },
        view: (name) => page.view(name),
        get renderer() {
            const { render, memory } = stage.renderer.info;
            return { frames: render.frame, calls: render.calls, triangles: render.triangles, ...memory };
        },
        get counts() {
            return page.counts;
        },
        get growth() {
            return page.growing;
        },
        get made() {
            return page.made;
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
