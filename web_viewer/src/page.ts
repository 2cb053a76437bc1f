// The page of one product: passes events between the parts, each of which knows the settings but
// none of the other parts.
import { AddressBar } from "./address_bar";
import { isCloseUp, type LookName } from "./camera";
import { closeUpNames, missingOfForms } from "./close_ups";
import { Controls } from "./controls";
import { byId, grouped, kilobytes } from "./dom";
import { MorphEditor } from "./editor";
import { ExportPanel } from "./export_panel";
import { FileActions, saveFile } from "./file_actions";
import { acceptFiles, inspectFile } from "./file_drop";
import { Gallery, type Species } from "./gallery";
import { GalleryLibrary, namedSpecies } from "./gallery_library";
import { connectSearch } from "./gallery_search";
import { ModelLoader, type LoadedModel, type ModelReport } from "./model_loader";
import { GrowthPlayer, restMs } from "./growth_player";
import { asRequestFailed, type ProblemItem, type RequestFailed } from "./http";
import { setRequestOf } from "./manifest";
import { MatrixTable } from "./matrix";
import { readShares } from "./mix";
import type { ModeLinks } from "./mode_links";
import { countsOf, linkedImagesOf, modelVariants, modelWind, type Counts } from "./model";
import { NamePlate, type ColonyCount } from "./name_plate";
import { DraftTextures } from "./draft_textures";
import { PanelTabs } from "./panel_tabs";
import { PhotoTools } from "./photo_tools";
import { ProblemBox } from "./problem_box";
import { mushrooms, type Product } from "./products";
import { showProgress } from "./progress_box";
import { showScaleBar } from "./scale_bar";
import { groupsOf, valueAt, type Group, type Schema } from "./schema";
import { Settings } from "./settings";
import { Sheet, sheetButtons } from "./sheet";
import type { Stage } from "./stage";
import { announce } from "./status_line";
import { Toolbar } from "./toolbar";
import { panels, readView, ViewStore, type PanelName, type ViewState } from "./view_state";

/** Time in which quick changes become one request, milliseconds. */
const changeDelayMs = 60;

/** How much larger than the canvas a saved picture is. */
const pictureScale = 2;

/** Returns a group with the profile first, which sets the defaults of other options. */
function profileFirst(group: Group): Group {
    const [profile, others] = [true, false].map((is) =>
        group.fields.filter(({ name }) => (name === "profile") === is),
    );
    return { ...group, fields: [...(profile ?? []), ...(others ?? [])] };
}

export interface PageParts {
    stage: Stage;
    links: ModeLinks;
    product: Product;
    schema: Schema;
    /** The species or presets of the gallery, which grows with what is found in the library. */
    species: Species[];
    /** What the service says of species of the library that the address names. */
    refused: ReadonlyMap<string, string>;
}

export interface PageOptions {
    /** Nothing moves by itself. */
    reducedMotion: boolean;
    /** The gallery has no pictures. */
    withoutPictures: boolean;
}

export class Page {
    /** Individuals of the shown colony, once the service has reported them. */
    colonyCount: ColonyCount | undefined;

    private readonly stage: Stage;
    private readonly links: ModeLinks;
    private readonly product: Product;
    private readonly settings: Settings;
    private readonly address: AddressBar;
    private readonly gallery: Gallery;
    private readonly controls: Controls;
    private readonly views: ViewStore;
    private readonly tabs: PanelTabs<PanelName>;
    private readonly exports: ExportPanel;
    private readonly editor: MorphEditor;
    private readonly matrix: MatrixTable | undefined;
    private readonly sheet: Sheet;
    private readonly loader: ModelLoader;
    private readonly textures = new DraftTextures();
    private readonly player: GrowthPlayer;
    private readonly toolbar: Toolbar;
    private readonly plate: NamePlate;
    private readonly actions: FileActions;
    private readonly problems = new ProblemBox((item) => this.showBeside(item));
    private loaded: LoadedModel | undefined;
    /** The named view that the camera has; undefined once it was turned by hand. */
    private looked: LookName | undefined = "three-quarter";

    constructor({ stage, links, product, schema, species, refused }: PageParts, options: PageOptions) {
        this.stage = stage;
        this.links = links;
        this.product = product;
        const groups = groupsOf(schema, product.groupName);
        const fields = groups.flatMap((group) => group.fields);
        this.settings = new Settings(fields, species[0]?.id ?? "", product);
        this.address = new AddressBar(this.settings, species, refused);
        this.gallery = new Gallery(byId("gallery"), species, (id) => this.choose(id));
        connectSearch(this.gallery);
        this.plate = new NamePlate(product, (id) => this.gallery.find(id));
        this.views = new ViewStore((view) => this.address.writeView(view));
        this.tabs = new PanelTabs(panels, (panel) => this.views.change({ panel }));
        this.exports = new ExportPanel(this.settings, stage, this.views, {
            lodChosen: () => this.changed("lod"),
        });
        this.actions = new FileActions(product.noun, () =>
            setRequestOf(this.settings, this.exports.lods),
        );
        const hostOf = ({ key }: Group): HTMLElement =>
            byId(key === "file" ? "export-form" : "form");
        this.controls = new Controls(hostOf, groups.map(profileFirst), this.settings, {
            moving: ({ name }) => {
                this.controls.show();
                if (name !== "age" || !this.player.pose()) this.loader.loadDraft();
            },
            moved: ({ name }) => this.changed(name),
            errorShown: (element) => this.openPanelOf(element),
        });
        this.editor = new MorphEditor(this.settings, species, {
            moving: () => {
                this.plate.showNames(this.settings.mix);
                this.loader.loadDraft(0);
            },
            moved: (name) => this.changed(name),
            chosen: () => {
                // Each species that joins or leaves is a history step of its own.
                const members = this.settings.morph?.shares.map(({ id }) => id) ?? [];
                this.address.write(`morph ${members.join()}`);
                this.begin(true);
            },
            left: (id) => this.leaveEditor(id),
        });
        this.matrix = product.hasMatrix
            ? new MatrixTable(this.settings, { changed: () => this.changed("rows") })
            : undefined;
        this.sheet = new Sheet(this.settings, species, {
            changed: (kind) => this.address.writeSheet(kind),
            save: saveFile,
        });
        this.loader = new ModelLoader(this.settings, this.textures, {
            progress: showProgress,
            show: (loaded, refit, current) => this.show(loaded, refit, current),
            effective: (resource) => this.showEffective(resource),
            failed: (error) => this.failed(error),
        });
        this.textures.onChange = () => stage.draw();
        this.player = new GrowthPlayer(this.settings, options.reducedMotion, {
            posed: () => stage.updateShadow(),
            clipNeeded: () => this.loader.loadClip(),
            stopped: () => this.changed("age"),
            ended: () => this.loader.loadFinal(false, restMs),
        });
        this.toolbar = new Toolbar(this.settings, stage, {
            view: (name) => this.view(name, false),
            variant: (name) => void this.stage.showVariant(name),
            lodChosen: () => this.changed("lod"),
        });
        new PhotoTools(stage, this.views, () => this.savePicture());
        this.views.listen((view) => this.showLook(view));
        this.toolbar.markView(this.looked);
        stage.onTurned = () => this.forgetLook();
        stage.onKey = (view) => {
            const name = view === "home" ? "three-quarter" : this.toolbar.looks[view];
            if (name && this.missing(name) === undefined) this.view(name, false);
        };
        stage.onFrame = () => showScaleBar(stage, product.noun);
        links.connect({ species: () => this.leaveEditor(), morph: () => this.enterEditor() });
        if (product.canMorph) byId("sheets").append(sheetButtons((kind) => this.sheet.show(kind)));
        acceptFiles((file) => void this.inspect(file));
        for (const id of ["form", "export-form"])
            byId(id).addEventListener("submit", (event) => event.preventDefault());
        addEventListener("popstate", () => this.readAddress());
        this.readAddress();
        if (!options.withoutPictures) void this.showPictures();
    }

    /** Resolves when everything shown equals the settings; rejects if the model cannot be made. */
    async settled(): Promise<void> {
        this.address.flush();
        await this.editor.settled();
        await this.loader.settled();
        await this.sheet.settled();
    }

    get growth(): { age: number | undefined; playing: boolean } {
        return this.player.state;
    }

    get counts(): Counts {
        if (!this.loaded)
            return { triangles: 0, vertices: 0, drawCalls: 0, textures: 0, imageBytes: 0 };
        return countsOf(this.loaded.model);
    }

    /** Looks from a named side or at a part. */
    view(name: LookName, atOnce = true): void {
        this.stage.look(name, atOnce);
        this.looked = name;
        this.views.change({ look: name === "three-quarter" ? undefined : name });
        this.toolbar.markView(name);
    }

    /** Shows the view of the page's URL; a view that this product does not have is ignored. */
    private showLook({ look }: ViewState): void {
        if (look === undefined || look === this.looked) return;
        if (!this.toolbar.looks.includes(look)) return;
        this.looked = look;
        this.stage.look(look, false);
        this.toolbar.markView(look);
    }

    /** The camera was turned by hand. The view of the roots also hides what is above them, which
     *  stays so. */
    private forgetLook(): void {
        if (this.looked === undefined || this.looked === "roots") return;
        this.looked = undefined;
        this.toolbar.markView(undefined);
        if (this.views.current.look) this.views.change({ look: undefined });
    }

    /** Returns why what is shown cannot be looked at in this way, undefined if it can. */
    private missing(name: LookName): string | undefined {
        if (!isCloseUp(name)) return undefined;
        const rule = this.product.closeUps[name];
        if (typeof rule === "string") return rule;
        if (this.product.ofSpecies) {
            const members = readShares(this.settings.mix) ?? [];
            const forms = members.map(({ id }) => this.gallery.find(id)?.form);
            const missing = missingOfForms(name, forms);
            if (missing) return missing;
        }
        if (!this.loaded || this.stage.canLookAt(name)) return undefined;
        return `The ${name} cannot be seen at this age`;
    }

    /** Offers the close-ups that the shown model has; a view that it does not have ends. */
    private offerCloseUps(): void {
        for (const name of closeUpNames) this.toolbar.offerCloseUp(name, this.missing(name));
        const { looked } = this;
        if (looked && this.missing(looked) !== undefined) this.view("three-quarter", false);
    }

    /** Saves the picture twice as large as it is on the stage. */
    private async savePicture(): Promise<void> {
        announce("Drawing the picture");
        // With depth of field it may take a second: the message is shown before.
        await new Promise((resolve) => setTimeout(resolve, 30));
        try {
            const { light, look } = this.views.current;
            const details = [look, light === "daylight" ? undefined : light].filter(Boolean);
            const name = [this.actions.modelName, ...details].join("_");
            saveFile(await this.stage.snapshot(pictureScale), `${name}.png`);
        } catch (error) {
            const failed = asRequestFailed(error, "The picture could not be saved");
            this.problems.show(failed);
            announce(`${failed.title}. ${failed.detail}`);
        }
    }

    /** Chooses a species of the gallery, or a member of the morph. */
    private choose(mix: string): void {
        if (this.settings.morph) return this.editor.toggle(mix);
        if (mix === this.settings.mix) return;
        this.settings.choose(mix);
        this.address.write("species");
        this.begin(true);
    }

    private enterEditor(): void {
        if (!this.settings.morph) this.editor.enter(readShares(this.settings.mix) ?? []);
    }

    /** Shows one member alone, by itself that with the greatest share. */
    private leaveEditor(id?: string): void {
        const { morph } = this.settings;
        if (!morph) return;
        const strongest = [...morph.shares].sort((one, other) => other.weight - one.weight)[0];
        this.settings.setMorph(undefined);
        this.settings.choose(id ?? strongest?.id ?? this.settings.mix);
        this.address.write("mode");
        this.begin(true);
    }

    /** A setting was changed: writes the address and requests the model. */
    private changed(name: string): void {
        // Naming a matrix or requesting another order discards custom rows.
        if (["matrix", "blend", "toward", "order"].includes(name)) this.settings.rows = undefined;
        this.address.write(name);
        if (name === "age") this.editor.readGraph();
        this.controls.show();
        this.toolbar.markLod();
        this.problems.showRejected([]);
        // With a clip the age is shown at once; its model is requested when the age stays the same.
        if (name === "age" && this.player.pose()) return this.loader.loadFinal(false, restMs);
        this.player.release();
        this.loader.loadFinal(false, changeDelayMs);
    }

    private openPanelOf(element: HTMLElement): void {
        const hidden = panels.find((name) => byId(`panel-${name}`).contains(element));
        if (!hidden || !byId(`panel-${hidden}`).hidden) return;
        this.tabs.open(hidden);
        this.views.change({ panel: hidden });
    }

    private readAddress(): void {
        const contents = this.address.read();
        if (!contents) return;
        const { otherMix, rejected, sheet } = contents;
        const view = readView(new URLSearchParams(location.search));
        this.tabs.open(view.panel);
        this.views.read(view);
        this.begin(otherMix || !this.loaded);
        this.problems.showRejected(rejected);
        if (sheet === "growth" || (sheet === "variety" && this.settings.morph)) {
            this.sheet.show(sheet);
        } else {
            this.sheet.close();
        }
    }

    /** Shows new settings from scratch: another species, another address, a dropped file. */
    private begin(refit: boolean): void {
        const { morph, mix } = this.settings;
        this.controls.clearErrors();
        this.player.release();
        this.problems.showRejected([]);
        this.gallery.markShown(morph?.shares.map(({ id }) => id).join(",") ?? mix);
        this.showMode();
        this.editor.show();
        this.controls.show(undefined);
        this.toolbar.markLod();
        this.plate.showNames(mix);
        this.loader.loadFinal(refit);
    }

    private showMode(): void {
        const { morph } = this.settings;
        document.documentElement.classList.toggle("morphing", morph !== undefined);
        this.links.show(
            this.settings,
            this.gallery.species.map(({ id }) => id),
        );
        if (!this.product.canMorph) return;
        byId("variety").hidden = !morph;
        // Sheets are the main purpose of the editor, and secondary for a single species.
        byId(morph ? "editor" : "form").after(byId("sheets"));
        this.gallery.setLetters(morph?.shares.map(({ id }) => id) ?? []);
    }

    private async show(
        loaded: LoadedModel,
        refit: boolean,
        current: () => boolean,
    ): Promise<boolean> {
        if (!(await this.stage.show(loaded.model, refit, current))) return false;
        this.loaded = loaded;
        if (loaded.draft) this.textures.fetchImages(linkedImagesOf(loaded.model));
        else this.textures.adoptFrom(loaded.model);
        this.editor.clearRefusals();
        if (this.player.ready) this.controls.show();
        this.player.take(loaded.model);
        this.toolbar.offerWind(modelWind(loaded.model) !== undefined);
        this.toolbar.offerVariants(modelVariants(loaded.model)?.names ?? []);
        if (!loaded.draft) {
            this.offerCloseUps();
            this.controls.clearErrors();
            this.matrix?.clearErrors();
        }
        this.problems.showRejectedAgain();
        this.exports.show(loaded);
        if (loaded.draft) this.colonyCount = undefined;
        this.plate.showSize(this.stage.size, this.colonyCount);
        this.actions.show(loaded);
        if (!loaded.draft) {
            const name = byId("common-name").textContent;
            const triangles = grouped(countsOf(loaded.model).triangles);
            const size = kilobytes(loaded.fetched.bytes.byteLength);
            announce(`${name}: ${triangles} triangles, ${size}`);
        }
        if (loaded.clip) this.player.play();
        return true;
    }

    /** Shows what the service reports about the shown model. */
    private showEffective(report: ModelReport): void {
        const { effective, matrix, made } = report;
        this.exports.showReport(report);
        this.controls.show(effective);
        this.toolbar.markLod(effective);
        this.matrix?.showServed(matrix);
        this.colonyCount =
            made === undefined
                ? undefined
                : { made, requested: Number(valueAt(effective, "count") ?? made) };
        this.plate.showSize(this.stage.size, this.colonyCount);
    }

    private failed(error: RequestFailed): void {
        // A problem that is only about arcs is shown beside the arcs.
        if (error.items.length > 0 && error.items.every((item) => this.editor.showError(item))) {
            return announce(error.items[0]?.detail ?? error.message);
        }
        this.problems.show(error, () => {
            this.problems.hide();
            this.loader.loadFinal();
        });
        announce(error.message);
    }

    private showBeside(item: ProblemItem): boolean {
        // Of a JSON body the service names the members by JSON pointers.
        const name = item.parameter.replace(/^\//, "").replaceAll("/", ".");
        return (
            this.matrix?.showError(item.parameter, item.detail) ||
            this.controls.showError(name, item.detail) ||
            this.editor.showError(item)
        );
    }

    /** Restores the settings from which a file was made. */
    private async inspect(file: File): Promise<void> {
        announce(`Reading ${file.name}`);
        try {
            const { product, id, query } = await inspectFile(file, this.product.noun);
            if (product === this.product) await this.restore(file, id, query);
            else this.openProduct(product, id, query);
        } catch (error) {
            const failed = asRequestFailed(error, `${file.name} could not be read`);
            this.problems.show(failed);
            announce(failed.message);
        }
    }

    private async restore(file: File, mix: string, query: string): Promise<void> {
        const added = this.gallery.add((await namedSpecies(mix)).species);
        void this.showPicturesOf(added);
        const refit = mix !== this.settings.mix;
        this.settings.setMorph(undefined);
        this.settings.mix = mix;
        const rejected = this.settings.read(new URLSearchParams(query));
        this.address.write("file");
        this.begin(refit);
        this.problems.showRejected(rejected);
        announce(`Settings of ${file.name} restored`);
    }

    private openProduct(product: Product, id: string, query: string): void {
        location.assign(`?${product.queryName}=${id}${query.replace("?", "&")}`);
    }

    /** Shows the gallery's pictures, once the model is shown. */
    private async showPictures(): Promise<void> {
        await this.settled().catch(() => undefined);
        const library = new GalleryLibrary(this.gallery, (ids) => this.showPicturesOf(ids));
        await Promise.all([
            this.showPicturesOf(this.gallery.species.map(({ id }) => id)),
            this.product.ofSpecies && library.begin(),
        ]);
        document.documentElement.dataset["gallery"] = "complete";
    }

    private showPicturesOf(ids: readonly string[]): Promise<void> {
        // A product made of species shows a single mushroom of each.
        const { path, pictureQuery } = this.product.ofSpecies ? mushrooms : this.product;
        return this.gallery.showPictures(ids, (id) => `${path}/${id}.png?${pictureQuery}`);
    }
}
