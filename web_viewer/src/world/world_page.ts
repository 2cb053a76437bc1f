// The page of worlds: passes events between the settings, the stage, the time, the map, the reasons and the address.
import { Vector3 } from "three";
import { Controls } from "../controls";
import { byId, make } from "../dom";
import { copy, saveFile } from "../file_actions";
import { asRequestFailed, getJson, getModel, RequestFailed, send, type ProblemItem } from "../http";
import { ProblemBox } from "../problem_box";
import { showProgress, type LoadProgress } from "../progress_box";
import { groupsOf, valueAt, type Schema } from "../schema";
import { announce, notify } from "../status_line";
import { FlyControls, clickReach } from "./fly_controls";
import { eyeHeight, type Terrain } from "./fly_motion";
import { FlyView, tilesetAddress } from "./fly_view";
import { fetchHeights, type HeightField } from "./height_field";
import { MapView } from "./map_view";
import { nearestBody, plotAddress, PlotView, viewerAddress, type FruitBodyFacts } from "./plot_view";
import { richestPlace, type Placement } from "./richest_place";
import { SeasonGraph, type SeasonSpecies, type Weather } from "./season_graph";
import { dateOf } from "./season_curves";
import { idsOf, SpeciesPicker, type NamedSpecies } from "./species_picker";
import {
    layerLabels,
    layers,
    lastDay,
    placeInside,
    readWorldQuery,
    seasonBox,
    short,
    within,
    worldQuery,
    worldViews,
    type Layer,
    type WorldState,
    type WorldView,
} from "./view_address";
import { TerrainPanel } from "./terrain_panel";
import { WhyPanel } from "./why_panel";
import { WorldSettings } from "./world_settings";
import { WorldStage } from "./world_stage";

/** Changes of one kind within this time are one step of the browser's history. */
const sameStepMs = 1500;
/** The address follows the camera once it has rested for this time. */
const restMs = 450;
/** The shortest time between two days that are played. */
const playMs = 550;
const speciesParameter = "fungi.species";
const terrainParameter = "terrain.id";
/** What has no meaning beside a terrain of one's own. */
const grownTerrain = ["terrain.relief", "terrain.feature", "terrain.roughness", "terrain.erosion"];
/** Fruit bodies that are listed by name at most. */
const mostListed = 60;

const viewLabels: Readonly<Record<WorldView, string>> = { plot: "Plot", walk: "Walk", fly: "Fly" };

/** What the service says of a world. */
interface WorldFacts {
    preset: string;
    effective: unknown;
    fungi: { id: string; possible: boolean; why_not?: string }[];
    years: [number, number];
    maps: Record<string, string>;
    links: Record<string, string>;
}

interface SeasonFacts {
    species: SeasonSpecies[];
}

interface Listed {
    id: string;
    name: string;
}

export class WorldPage {
    state: WorldState = readWorldQuery("").state;
    private readonly stage: WorldStage;
    private readonly plot: PlotView;
    private readonly fly: FlyView;
    private readonly controls: FlyControls;
    private readonly map: MapView;
    private readonly graph: SeasonGraph;
    private readonly why: WhyPanel;
    private readonly terrains: TerrainPanel;
    private readonly problems = new ProblemBox((item) => this.showBeside(item));
    private readonly day = byId<HTMLInputElement>("day");
    private readonly year = byId<HTMLInputElement>("year");
    private readonly names = new Map<string, string>();
    private presets: Listed[] = [];
    private settings: WorldSettings | undefined;
    private parameters: Controls | undefined;
    private picker: SpeciesPicker | undefined;
    private facts: WorldFacts | undefined;
    private heights: HeightField | undefined;
    /** The text of the world that all parts show, and of the one that is being described. */
    private described = "";
    private describing: AbortController | undefined;
    private isNewWorld = true;
    private weatherOf = "";
    private seasonOf = "";
    private seasonLoading: AbortController | undefined;
    private heightsOf = "";
    /** The middle of the plot that is on the stage. */
    private plotPlace = { x: 0, y: 0 };
    private plotOf = "";
    private lookWanted: readonly number[] | undefined;
    /** Somebody has moved the camera, so that the address says where it is. */
    private isTurned = false;
    private pending = 0;
    private hasFailed = false;
    private resting: ReturnType<typeof setTimeout> | undefined;
    private lastWrite: { change: string; at: number } | undefined;
    private playing: ReturnType<typeof setTimeout> | undefined;
    private hoverRequested = false;
    private pressed: { x: number; y: number } | undefined;

    constructor() {
        const nameOf = (id: string): string => this.names.get(id) ?? id;
        const failed = (failure: RequestFailed): void => this.fail(failure);
        const reducedMotion = matchMedia("(prefers-reduced-motion: reduce)").matches;
        const canvas = byId<HTMLCanvasElement>("canvas");
        this.stage = new WorldStage(byId("stage"), canvas, reducedMotion);
        this.plot = new PlotView(this.stage, {
            progress: (progress) => this.showProgress(progress),
            shown: (layer) => this.onLayer(layer),
            facts: ({ fruit_bodies: bodies }) => this.listBodies(bodies),
            settled: () => this.updateState(),
            failed,
        });
        this.fly = new FlyView(this.stage, { shown: () => this.updateState(), settled: () => this.onTiles(), failed });
        this.controls = new FlyControls(canvas, () => this.terrain, {
            moved: () => {
                this.placeCamera();
                this.stage.draw();
            },
            turned: () => (this.isTurned = true),
        });
        this.map = new MapView({
            chosen: (x, y) => this.moveTo(x, y),
            changed: (map, species) => this.change({ map, species: map === "spores" ? species : "" }, "map"),
            failed,
        });
        this.graph = new SeasonGraph(nameOf, (day) => this.change({ day }, "day"));
        this.why = new WhyPanel(nameOf, failed);
        this.terrains = new TerrainPanel({ chosen: (terrain) => this.standOn(terrain), failed });
        this.stage.onStep = (seconds) => {
            if (!this.stage.isWide) return false;
            const isMoving = this.controls.step(seconds);
            return this.fly.update() || isMoving;
        };
        this.stage.onMoved = () => this.onCamera();
        this.stage.onTurned = () => (this.isTurned = true);
        this.stage.groundOfPlot = (x, z) => this.groundOfPlot(x, z);
        this.connect();
        document.documentElement.dataset["light"] = "overcast";
        this.updateState();
    }

    /** Shows what the address names. */
    async begin(): Promise<void> {
        ++this.pending;
        try {
            const [{ links }, { worlds }, schema, { species }] = await Promise.all([
                getJson<{ links: Record<string, string> }>("v1"),
                getJson<{ worlds: Listed[] }>("v1/worlds"),
                getJson<Schema>("v1/worlds/schema"),
                getJson<{ species: { id: string; common_name: string }[] }>("v1/species"),
            ]);
            for (const { id, common_name: name } of species) this.names.set(id, name || id);
            this.presets = worlds;
            if (links["terrains"]) this.terrains.offer();
            byId("preset").replaceChildren(...worlds.map(({ id, name }) => make("option", { value: id }, name)));
            this.makeControls(schema, species.map(({ id }) => ({ id, name: this.names.get(id) ?? id })));
            this.readAddress();
        } catch (error) {
            this.fail(asRequestFailed(error, "The page cannot begin"));
        } finally {
            --this.pending;
            this.updateState();
        }
    }

    get shown(): Record<Layer, string> {
        const of = this.stage.isWide ? this.fly : this.plot;
        return Object.fromEntries(layers.map((layer) => [layer, of.shownAddress(layer)])) as Record<Layer, string>;
    }

    get bodies(): readonly FruitBodyFacts[] {
        return this.plot.bodies;
    }

    get rendering(): { calls: number; triangles: number; frames: number } {
        const { calls, triangles } = this.stage.renderer.info.render;
        return { calls, triangles, frames: this.stage.frames };
    }

    /** Returns where a place above the ground is in the window, pixels. */
    pixelOf(x: number, y: number, above: number): { x: number; y: number } {
        const { canvas, camera, isWide } = this.stage;
        const [right, south] = [x - this.plotPlace.x, this.plotPlace.y - y];
        const ground = this.plot.model("ground");
        const at = isWide
            ? new Vector3(x, (this.heights?.at(x, y) ?? 0) + above, -y)
            : new Vector3(right, (ground ? this.stage.heightOf(ground, right, south) : 0) + above, south);
        camera.updateMatrixWorld();
        const { left, top, width, height } = canvas.getBoundingClientRect();
        at.project(camera);
        return { x: left + ((at.x + 1) / 2) * width, y: top + ((1 - at.y) / 2) * height };
    }

    private get terrain(): Terrain {
        return { extent: this.settings?.extent ?? 1024, at: (x, y) => this.heights?.at(x, y) ?? 0 };
    }

    /** The server has the world as tiles. */
    private get hasTiles(): boolean {
        return this.facts?.links["tileset"] !== undefined;
    }

    private get world(): string {
        return this.settings?.text ?? "";
    }

    private get time(): string {
        return `y${this.state.year}d${this.state.day}`;
    }

    private makeControls(schema: Schema, species: readonly NamedSpecies[]): void {
        const groups = groupsOf(schema, "world");
        const settings = new WorldSettings(groups.flatMap(({ fields }) => fields), this.presets[0]?.id ?? "");
        this.settings = settings;
        this.parameters = new Controls(() => byId("parameters"), groups, settings, {
            moving: () => undefined,
            moved: (field) => this.refresh(field.name),
            errorShown: () => undefined,
        });
        byId("parameters").querySelectorAll("details").forEach((details, index) => (details.open = index === 0));
        const row = byId("parameters").querySelector<HTMLElement>(`[data-name="${speciesParameter}"]`);
        if (!row) return;
        this.picker = new SpeciesPicker(row, species, (ids) => {
            settings.set(speciesParameter, ids);
            this.refresh(speciesParameter);
        });
    }

    /** Reads the address into the settings, and shows it. */
    private readAddress(): void {
        const { settings } = this;
        if (!settings) return;
        const { world, state, rejected } = readWorldQuery(location.search);
        const text = world ?? this.presets[0]?.id ?? "";
        rejected.push(...settings.read(text, this.presets.map(({ id }) => id)));
        this.state = state;
        this.lookWanted = state.look;
        this.lastWrite = undefined;
        this.useView(false);
        this.problems.showRejected(rejected);
        this.refresh("address", false);
    }

    /** Lets the world stand on a terrain, or on hills that are grown. */
    private standOn(terrain: string | undefined): void {
        const { settings } = this;
        if (!settings) return;
        settings.set(terrainParameter, terrain);
        if (terrain !== undefined) for (const name of grownTerrain) settings.set(name, undefined);
        this.refresh(terrainParameter);
    }

    private connect(): void {
        byId("preset").addEventListener("change", () => {
            this.settings?.choose(byId<HTMLSelectElement>("preset").value);
            this.refresh("preset");
        });
        for (const [input, name] of [[this.day, "day"], [this.year, "year"]] as const) {
            input.addEventListener("input", () => this.change({ [name]: Number(input.value) }, name, true));
            input.addEventListener("change", () => this.change({ [name]: Number(input.value) }, name));
        }
        this.connectNumber("day-number", (day) => this.change({ day }, "day"));
        this.connectNumber("year-number", (year) => this.change({ year }, "year"));
        this.connectNumber("place-x", (x) => this.moveTo(x, this.state.y));
        this.connectNumber("place-y", (y) => this.moveTo(this.state.x, y));
        const size = byId<HTMLInputElement>("size");
        size.addEventListener("input", () => (byId("size-text").textContent = `${size.value} m`));
        size.addEventListener("change", () => this.change({ size: Number(size.value), look: undefined }, "size"));
        for (const view of worldViews) {
            const button = make("button", { type: "button", "data-view": view }, viewLabels[view]);
            button.addEventListener("click", () => this.chooseView(view));
            byId("views").append(button);
        }
        for (const layer of layers) {
            const box = make("input", { type: "checkbox", "data-layer": layer, checked: true });
            box.addEventListener("change", () => this.toggle(layer, box.checked));
            byId("layers").append(make("label", { class: "check" }, box, ` ${layerLabels[layer]}`));
        }
        byId("play").addEventListener("click", () => this.play(this.playing === undefined));
        const ahead = byId("ahead");
        ahead.addEventListener("pointerdown", (event) => {
            ahead.setPointerCapture(event.pointerId);
            this.controls.hold(true);
        });
        // The stage keeps the focus, whose loss would end what is held.
        ahead.addEventListener("mousedown", (event) => event.preventDefault());
        for (const end of ["pointerup", "pointercancel"] as const) ahead.addEventListener(end, () => this.controls.hold(false));
        byId("home").addEventListener("click", () => this.lookHome());
        byId("find").addEventListener("click", () => void this.findFungi());
        byId("why-here").addEventListener("click", () => this.askWhy(this.placeInView()));
        byId("copy-page").addEventListener("click", () => {
            this.rest();
            void copy(location.href, "URL of this page");
        });
        byId("copy-resource").addEventListener("click", () => void this.copyResource());
        byId("download").addEventListener("click", () => void this.download());
        addEventListener("popstate", () => this.readAddress());
        const { canvas } = this.stage;
        canvas.addEventListener("pointerdown", (event) => (this.pressed = { x: event.clientX, y: event.clientY }));
        canvas.addEventListener("pointerup", (event) => {
            const { pressed } = this;
            this.pressed = undefined;
            if (!pressed || Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > clickReach) return;
            void this.pick(event.clientX, event.clientY);
        });
        canvas.addEventListener("pointermove", (event) => {
            if (event.buttons === 0) this.hover(event.clientX, event.clientY);
        });
        canvas.addEventListener("pointerleave", () => this.map.hideCursor());
    }

    private connectNumber(id: string, take: (value: number) => void): void {
        const input = byId<HTMLInputElement>(id);
        input.addEventListener("change", () => {
            if (input.value !== "" && input.validity.valid) return take(Number(input.value));
            announce(`${input.labels?.[0]?.textContent ?? "It"}: ${input.validationMessage}`);
            this.showSettings();
        });
    }

    /** Changes what is shown of the world.
     *
     *  change     its name: changes of one kind in a short time are one step of the history
     *  isDragged  more changes follow: only what is quick is shown */
    private change(part: Partial<WorldState>, change: string, isDragged = false): void {
        this.state = { ...this.state, ...part };
        this.refresh(change, true, isDragged);
    }

    /** Brings every part of the page to the settings and the state. Parts that show them already do nothing. */
    private refresh(change: string, writes = true, isDragged = false): void {
        const { settings } = this;
        if (!settings) return;
        const { extent } = settings;
        const isPlot = this.state.view === "plot";
        this.state = { ...this.state, ...placeInside(this.state.x, this.state.y, extent, isPlot ? this.state.size : 1) };
        if (writes && !isDragged) this.write(change);
        if (writes && change !== "address") this.problems.hide();
        this.hasFailed = false;
        this.showSettings();
        this.graph.setDay(this.state.day);
        if (settings.text === this.described) this.showParts(isDragged);
        else void this.describe(settings.text);
        this.updateState();
    }

    /** Reads what the service says of a world that is new to the page, and shows it. */
    private async describe(world: string): Promise<void> {
        this.describing?.abort();
        const describing = new AbortController();
        this.describing = describing;
        ++this.pending;
        this.parameters?.clearErrors();
        try {
            const facts = await getJson<WorldFacts>(`v1/worlds/${world}.json`, describing.signal);
            this.facts = facts;
            this.described = world;
            this.isNewWorld = true;
            this.heights = undefined;
            const species = facts.fungi.map(({ id }) => ({ id, name: this.names.get(id) ?? id }));
            this.map.offer(facts.maps, species);
            if (!this.hasTiles && this.state.view !== "plot") {
                this.state = { ...this.state, view: "plot", look: undefined };
                this.useView(false);
            }
            [this.year.min, this.year.max] = [String(facts.years[0]), String(facts.years[1])];
            this.showSettings();
            this.showParts(false);
        } catch (error) {
            if (!describing.signal.aborted) this.fail(asRequestFailed(error, "There is no such world"));
        } finally {
            --this.pending;
            this.updateState();
        }
    }

    private showParts(isDragged: boolean): void {
        const { state, world } = this;
        void this.showWeather();
        if (state.view === "plot") {
            const key = [world, state.x, state.y, state.size].join(" ");
            if (key !== this.plotOf) this.stage.fitPlot(state.size);
            else if (this.lookWanted && this.stage.lookFrom(this.lookWanted)) this.lookWanted = undefined;
            this.plot.show(world, state, isDragged);
        } else {
            this.fly.show(world, state, isDragged);
            if (!this.fly.isSettled) this.showProgress({ stage: "growing" });
        }
        if (isDragged) return;
        void this.showHeights();
        void this.showSeason();
        if (this.settings) void this.track(this.map.show(world, this.settings.extent, state));
        this.map.showMark(state.why);
        this.showViewpoint();
        if (state.why) void this.track(this.why.show(world, this.time, state.why));
        else this.why.clear();
    }

    /** Counts what the page waits for. */
    private async track<T>(promise: Promise<T>): Promise<T> {
        ++this.pending;
        this.updateState();
        try {
            return await promise;
        } finally {
            --this.pending;
            this.updateState();
        }
    }

    private async showWeather(): Promise<void> {
        const address = `v1/worlds/${this.world}/weather.json?year=${this.state.year}`;
        if (address === this.weatherOf) return;
        this.weatherOf = address;
        try {
            const { days } = await this.track(getJson<{ days: Weather }>(address));
            if (address === this.weatherOf) this.graph.setWeather(days);
        } catch (error) {
            this.weatherOf = "";
            this.fail(asRequestFailed(error, "There is no weather"));
        }
    }

    private async showSeason(): Promise<void> {
        const { state, settings, world } = this;
        if (!settings) return;
        const box = seasonBox(state.x, state.y, settings.extent);
        const address = `v1/worlds/${world}/season.json?year=${state.year}&bbox=${box.join(",")}`;
        if (address === this.seasonOf) return;
        this.seasonOf = address;
        this.seasonLoading?.abort();
        const loading = new AbortController();
        this.seasonLoading = loading;
        byId("season").setAttribute("aria-busy", "true");
        try {
            const { species } = await this.track(getJson<SeasonFacts>(address, loading.signal));
            if (!loading.signal.aborted) this.graph.setSpecies(species);
        } catch (error) {
            if (loading.signal.aborted) return;
            this.seasonOf = "";
            this.fail(asRequestFailed(error, "The year cannot be counted"));
        }
        byId("season").setAttribute("aria-busy", "false");
    }

    private async showHeights(): Promise<void> {
        const { settings, world } = this;
        if (!settings || world === this.heightsOf) return;
        this.heightsOf = world;
        try {
            const heights = await this.track(fetchHeights(world, settings.extent, new AbortController().signal));
            if (world !== this.heightsOf) return;
            this.heights = heights;
            this.controls.set(this.controls.pose);
        } catch (error) {
            this.heightsOf = "";
            this.fail(asRequestFailed(error, "The heights of the ground cannot be read"));
        }
    }

    /** Shows the values of the settings in their inputs. */
    private showSettings(): void {
        const { state, settings, facts } = this;
        if (!settings) return;
        byId<HTMLSelectElement>("preset").value = settings.preset;
        void this.terrains.show(String(settings.values.get(terrainParameter) ?? ""));
        const input = (id: string, value: number): void => {
            byId<HTMLInputElement>(id).value = String(value);
        };
        const half = settings.extent / 2;
        for (const id of ["place-x", "place-y"]) {
            byId<HTMLInputElement>(id).min = String(-half);
            byId<HTMLInputElement>(id).max = String(half);
        }
        input("place-x", state.x);
        input("place-y", state.y);
        input("size", state.size);
        byId("size-text").textContent = `${state.size} m`;
        for (const [name, value, least, most] of [["day", state.day, 1, lastDay], ["year", state.year, 0, 200]] as const) {
            input(name, value);
            input(`${name}-number`, value);
            byId(name).style.setProperty("--to", `${(100 * (value - least)) / (most - least)}%`);
        }
        this.day.setAttribute("aria-valuetext", `${dateOf(state.day)}, day ${state.day}`);
        byId("date").textContent = dateOf(state.day);
        for (const button of byId("views").querySelectorAll("button"))
            button.setAttribute("aria-pressed", String(button.dataset["view"] === state.view));
        byId("views").hidden = !this.hasTiles;
        for (const box of byId("layers").querySelectorAll("input"))
            box.checked = !state.hidden.has(box.dataset["layer"] as Layer);
        const isPlot = state.view === "plot";
        byId("size-row").hidden = !isPlot;
        byId("download").hidden = !isPlot;
        byId("copy-resource").textContent = isPlot ? "Copy URL of the plot" : "Copy URL of the tiles";
        byId("found").hidden = !isPlot;
        byId("ahead").hidden = isPlot;
        byId("keys").textContent = {
            plot: "Drag turns, the wheel comes nearer. A click says why.",
            walk: "W A S D or arrows walk, a drag looks round. A click says why.",
            fly: "W A S D or arrows fly, E and Q rise and sink, Shift is faster. A click says why.",
        }[state.view];
        const name = this.presets.find(({ id }) => id === settings.preset)?.name ?? settings.preset;
        byId("world-name").textContent = name;
        byId("world-time").textContent = `${dateOf(state.day)}, year ${state.year}`;
        document.title = `${name}, ${dateOf(state.day)} of year ${state.year} · Worlds · Sporeprint`;
        this.plot.hidden = state.hidden;
        this.fly.hidden = state.hidden;
        const effective = facts?.effective ?? {};
        this.parameters?.show(effective);
        const list = settings.values.get(speciesParameter) ?? valueAt(effective, speciesParameter) ?? "";
        const whyNot = new Map((facts?.fungi ?? []).flatMap(({ id, why_not: why }) => (why ? [[id, why] as const] : [])));
        this.picker?.show(idsOf(String(list)), whyNot);
    }

    private onLayer(layer: Layer): void {
        this.isNewWorld = false;
        if (layer === "ground") {
            const { x, y, size } = this.state;
            this.plotPlace = { x, y };
            const key = [this.world, x, y, size].join(" ");
            if (key !== this.plotOf) {
                this.plotOf = key;
                if (!this.lookWanted || !this.stage.lookFrom(this.lookWanted)) this.stage.lookHome(true);
                this.lookWanted = undefined;
            }
        }
        this.updateState();
    }

    private onTiles(): void {
        this.isNewWorld = false;
        this.showProgress({ stage: "idle" });
        this.updateState();
    }

    private showProgress(progress: LoadProgress): void {
        showProgress(progress);
        if (progress.stage === "growing" && this.isNewWorld) byId("progress-text").textContent = "making the world…";
        else if (progress.stage === "growing" && this.stage.isWide) byId("progress-text").textContent = "loading tiles…";
    }

    /** Lists the fruit bodies of the plot, each with a link to its model. */
    private listBodies(bodies: readonly FruitBodyFacts[]): void {
        const { length } = bodies;
        byId("found-count").textContent =
            length === 0 ? "No fruit bodies on this plot" : `${length} fruit ${length === 1 ? "body" : "bodies"} on this plot`;
        const sorted = [...bodies].sort((a, b) => a.species.localeCompare(b.species) || b.age - a.age);
        byId("found-list").replaceChildren(
            ...sorted.slice(0, mostListed).map((body) => {
                const name = this.names.get(body.species) ?? body.species;
                const age = ` age ${short(body.age)}`;
                return make("li", {}, make("a", { href: viewerAddress(body.model) ?? body.model }, name), age);
            }),
            ...(length > mostListed ? [make("li", {}, `and ${length - mostListed} more`)] : []),
        );
    }

    private chooseView(view: WorldView): void {
        const before = this.state.view;
        if (view === before) return;
        const heading = this.stage.heading;
        this.rest();
        const { pose } = this.controls;
        this.state = { ...this.state, view, look: undefined };
        this.lookWanted = undefined;
        if (view !== "plot")
            this.controls.pose = {
                x: this.state.x,
                y: this.state.y,
                height: view === "walk" ? eyeHeight : before === "walk" ? 4 : Math.max(pose.height, 4),
                heading: before === "plot" ? heading : pose.heading,
                pitch: view === "walk" ? -8 : -14,
            };
        this.useView(true);
        this.refresh("view");
    }

    /** Brings the stage to the view of the state. */
    private useView(hasPose: boolean): void {
        const { view, look, x, y } = this.state;
        const isWide = view !== "plot";
        const { controls } = this;
        controls.walks = view === "walk";
        controls.enabled = isWide;
        if (isWide && !hasPose) {
            const [heading = 0, pitch = -12, height = 4] = look ?? [];
            controls.pose = { x, y, heading, pitch: within(pitch, -89, 89), height };
        }
        if (isWide) this.plot.stop();
        else this.fly.clear();
        this.stage.isWide = isWide;
        if (isWide) {
            this.showProgress({ stage: "growing" });
            controls.set(controls.pose);
        }
    }

    private lookHome(): void {
        if (!this.stage.isWide) return this.stage.lookHome(false);
        this.controls.set({ ...this.controls.pose, height: 4, pitch: -12, heading: 0 });
    }

    private toggle(layer: Layer, isOn: boolean): void {
        const hidden = new Set(this.state.hidden);
        if (isOn) hidden.delete(layer);
        else hidden.add(layer);
        this.change({ hidden }, `layer ${layer}`);
    }

    /** Moves the view to a place. */
    private moveTo(x: number, y: number): void {
        if (!this.settings) return;
        const { view, size } = this.state;
        const place = placeInside(x, y, this.settings.extent, view === "plot" ? size : 1);
        if (view !== "plot") this.controls.set({ ...this.controls.pose, ...place });
        this.change({ ...place, look: view === "plot" ? undefined : this.lookOfView() }, "place");
    }

    /** Moves the view to where most species stand on that day near it. */
    private async findFungi(): Promise<void> {
        const { settings, state, world } = this;
        if (!settings) return;
        const box = seasonBox(state.x, state.y, settings.extent);
        const address = `v1/worlds/${world}/${this.time}/placements.json?bbox=${box.join(",")}&kinds=fungus`;
        try {
            const { placements } = await this.track(getJson<{ placements: Placement[] }>(address));
            const place = richestPlace(placements, box, Math.min(state.size, 32));
            if (!place) return notify("Nothing fruits within 64 m on this day");
            this.moveTo(place.x, place.y);
        } catch (error) {
            this.fail(asRequestFailed(error, "No fungi can be found"));
        }
    }

    /** Puts the flying camera where its pose is. */
    private placeCamera(): void {
        const { x, y, height, heading, pitch } = this.controls.pose;
        const { flyingCamera } = this.stage;
        flyingCamera.position.set(x, this.terrain.at(x, y) + height, -y);
        flyingCamera.rotation.set((pitch * Math.PI) / 180, (-heading * Math.PI) / 180, 0, "YXZ");
        if (this.stage.isWide) this.onCamera();
    }

    private onCamera(): void {
        this.showViewpoint();
        clearTimeout(this.resting);
        this.resting = setTimeout(() => this.rest(), restMs);
    }

    /** Writes to the address where the camera is. */
    private rest(): void {
        if (this.resting === undefined) return;
        clearTimeout(this.resting);
        this.resting = undefined;
        if (!this.settings || !this.isTurned) return;
        this.isTurned = false;
        if (this.stage.isWide) {
            const { x, y } = this.controls.pose;
            this.state = { ...this.state, x: short(x), y: short(y) };
        }
        this.state = { ...this.state, look: this.lookOfView() };
        this.write("camera", true);
        this.showSettings();
        if (this.stage.isWide) void this.showSeason();
    }

    private lookOfView(): readonly number[] {
        if (!this.stage.isWide) return this.stage.plotLook;
        const { heading, pitch, height } = this.controls.pose;
        return [short(heading, 1), short(pitch, 1), short(height)];
    }

    private showViewpoint(): void {
        const { state, stage, settings, controls } = this;
        const at = stage.isWide ? controls.pose : state;
        this.map.showViewpoint({ x: at.x, y: at.y, heading: stage.heading }, settings?.extent ?? 1024, stage.isWide ? 0 : state.size);
    }

    /** Height of the ground at a place of the plot, above that of its middle. */
    private groundOfPlot(x: number, z: number): number {
        const { heights, plotPlace } = this;
        if (!heights) return -1;
        return heights.at(plotPlace.x + x, plotPlace.y - z) - heights.at(plotPlace.x, plotPlace.y);
    }

    /** Returns the place of the ground below a place of the window. */
    private groundAt(clientX: number, clientY: number): { x: number; y: number } | undefined {
        const { stage, heights, plotPlace } = this;
        if (stage.isWide) {
            const hit = heights?.hit(stage.rayAt(clientX, clientY).ray);
            return hit && { x: hit.east, y: hit.north };
        }
        const ground = this.plot.model("ground");
        const hit = ground && stage.hitAt(clientX, clientY, [ground]);
        return hit && { x: plotPlace.x + hit.point.x, y: plotPlace.y - hit.point.z };
    }

    /** Shows on the map the place below the pointer, once per frame. */
    private hover(clientX: number, clientY: number): void {
        if (this.hoverRequested) return;
        this.hoverRequested = true;
        requestAnimationFrame(() => {
            this.hoverRequested = false;
            const place = this.groundAt(clientX, clientY);
            if (place) this.map.showCursor(place.x, place.y);
            else this.map.hideCursor();
        });
    }

    /** Returns the place that the view is about: the middle of the plot, or the ground in the middle of the picture. */
    private placeInView(): { x: number; y: number } {
        if (!this.stage.isWide) return this.plotPlace;
        const { left, top, width, height } = this.stage.canvas.getBoundingClientRect();
        return this.groundAt(left + width / 2, top + height / 2) ?? this.controls.pose;
    }

    /** Shows why species fruit or do not fruit at a place, and the mushroom there. */
    private askWhy({ x, y }: { x: number; y: number }, body?: FruitBodyFacts): void {
        const half = (this.settings?.extent ?? 1024) / 2 - 0.01;
        const inside = (value: number): number => short(within(value, -half, half));
        this.change({ why: [inside(x), inside(y)] }, "why");
        this.why.showBody(body);
        byId("why").scrollIntoView({ block: "nearest" });
    }

    private async pick(clientX: number, clientY: number): Promise<void> {
        const { stage, state, plotPlace } = this;
        const of = stage.isWide ? { group: (layer: Layer) => this.fly.group(layer) } : { group: (layer: Layer) => this.plot.model(layer) };
        const seen = (["fungi", "floor", "ground"] as const).filter((layer) => !state.hidden.has(layer));
        const objects = seen.flatMap((layer) => of.group(layer) ?? []);
        const hit = stage.hitAt(clientX, clientY, objects);
        const ground = this.groundAt(clientX, clientY);
        if (!hit && !ground) return;
        const place = hit
            ? stage.isWide
                ? { x: hit.point.x, y: -hit.point.z }
                : { x: plotPlace.x + hit.point.x, y: plotPlace.y - hit.point.z }
            : ground!;
        let isFungus = false;
        const fungi = of.group("fungi");
        for (let node = hit?.object ?? null; node; node = node.parent) isFungus ||= node === fungi;
        if (!isFungus) return this.askWhy(place);
        try {
            const body = nearestBody(await this.bodiesNear(place), place.x, place.y, 0.8);
            this.askWhy(body ? { x: body.place_m[0], y: body.place_m[1] } : place, body);
        } catch (error) {
            this.fail(asRequestFailed(error, "The mushroom cannot be named"));
        }
    }

    private async bodiesNear({ x, y }: { x: number; y: number }): Promise<readonly FruitBodyFacts[]> {
        if (!this.stage.isWide || !this.settings) return this.plot.bodies;
        const around = { ...this.state, ...placeInside(x, y, this.settings.extent, 2), size: 2 };
        const address = plotAddress(this.world, around, ".json");
        return (await getJson<{ fruit_bodies: FruitBodyFacts[] }>(address)).fruit_bodies;
    }

    /** Plays the days of the year, each once its fungi are shown. */
    private play(on: boolean): void {
        this.stopPlaying();
        if (!on) return this.change({}, "day");
        byId("play").setAttribute("aria-pressed", "true");
        byId("play").textContent = "Stop";
        const step = (): void => {
            this.playing = setTimeout(step, playMs);
            const isBehind = this.shown.fungi !== this.wantedFungi;
            if (isBehind) return;
            if (this.state.day >= lastDay) return this.play(false);
            this.change({ day: this.state.day + 1 }, "day", true);
        };
        this.playing = setTimeout(step, 0);
    }

    private stopPlaying(): void {
        clearTimeout(this.playing);
        this.playing = undefined;
        byId("play").setAttribute("aria-pressed", "false");
        byId("play").textContent = "Play";
    }

    private get wantedFungi(): string {
        const { state, world } = this;
        return state.view === "plot"
            ? plotAddress(world, state, ".glb", ["fungi"])
            : tilesetAddress(world, state, "fungi");
    }

    /** Layers of the plot that are on. */
    private get chosenLayers(): Layer[] {
        return layers.filter((layer) => !this.state.hidden.has(layer));
    }

    /** Copies the canonical address of what is on the stage. */
    private async copyResource(): Promise<void> {
        const { state, world } = this;
        const chosen = this.chosenLayers;
        if (chosen.length === 0) return notify("All layers are off");
        const address =
            state.view === "plot"
                ? plotAddress(world, state, ".glb", chosen, "none")
                : `v1/worlds/${world}/web/${this.time}/tileset.json`;
        try {
            const { headers } = await send(address, { method: "HEAD" });
            await copy(new URL(headers.get("content-location") ?? address, location.href).href, "URL");
        } catch (error) {
            this.fail(asRequestFailed(error, "The URL cannot be copied"));
        }
    }

    private async download(): Promise<void> {
        const chosen = this.chosenLayers;
        if (chosen.length === 0) return notify("All layers are off");
        const address = plotAddress(this.world, this.state, ".glb", chosen, "none");
        try {
            const { bytes, response } = await getModel({ address }, new AbortController().signal, (progress) => this.showProgress(progress));
            const name = /filename="([\w.-]+)"/.exec(response.headers.get("content-disposition") ?? "")?.[1];
            saveFile(new Blob([bytes], { type: "model/gltf-binary" }), name ?? "plot.glb");
        } catch (error) {
            this.fail(asRequestFailed(error, "The plot cannot be saved"));
        }
        this.showProgress({ stage: "idle" });
    }

    private write(change: string, replaces = false): void {
        const now = performance.now();
        const isSame = this.lastWrite?.change === change && now - this.lastWrite.at < sameStepMs;
        const address = worldQuery(this.world, this.state);
        if (address === location.search) return;
        history[isSame || replaces ? "replaceState" : "pushState"](null, "", address);
        if (!replaces) this.lastWrite = { change, at: now };
    }

    private showBeside({ parameter, detail }: ProblemItem): boolean {
        return this.parameters?.showError(parameter, detail) ?? false;
    }

    private fail(failure: RequestFailed): void {
        this.hasFailed = true;
        this.showProgress({ stage: "idle" });
        this.stopPlaying();
        const retry = failure.status === 0 || failure.status >= 500 || failure.status === 429 ? () => this.retry() : undefined;
        this.problems.show(failure, retry);
        announce([failure.message, ...failure.items.map(({ detail }) => detail)].join(" "));
        this.updateState();
    }

    private retry(): void {
        this.problems.hide();
        this.refresh("retry", false);
    }

    /** What the page is at, for its style and for tests. */
    private updateState(): void {
        const isSettled = this.stage.isWide ? this.fly.isSettled : this.plot.isSettled;
        const state = this.hasFailed ? "failed" : this.pending === 0 && isSettled && this.described === this.world && this.world ? "ready" : "busy";
        document.documentElement.dataset["world"] = state;
    }
}
