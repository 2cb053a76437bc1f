// The page that breeds: passes events between the parents, the nine children, their family tree and the address.
import { viewLabels, viewNames } from "../camera";
import { Controls, type ControlledValues } from "../controls";
import { described, speciesSchema, type DocumentSchema } from "../designer/schemas";
import { byId, make } from "../dom";
import { asRequestFailed, getJson, RequestFailed } from "../http";
import { hasLibrary } from "../library_list";
import { disposeModel, parseModel } from "../model";
import { ProblemBox } from "../problem_box";
import { groupsOf, type Field, type Schema, type Value } from "../schema";
import { announce, notify } from "../status_line";
import { ChildGrid } from "./child_grid";
import { FamilyTree, pictureElement } from "./family_tree";
import { LockList, locksOf } from "./locks";
import { draftOptions, fetchFile, fetchSpecies, finalOptions, type ChildFile } from "./offspring";
import { ParentChooser } from "./parent_chooser";
import {
    childCount,
    firstGenes,
    isAddressable,
    keyOfCouple,
    nextSeeds,
    Pedigree,
    seedsFrom,
    type Birth,
    type Couple,
    type Genes,
    type Species,
} from "./pedigree";
import { coupleQuery, readCouple } from "./pedigree_address";
import { SaveDialog } from "./save_dialog";
import { TreeStore } from "./tree_store";

const firstParents = ["boletus_edulis", "amanita_muscaria"] as const;
const currentKey = "sporeprint-breeding-couple";
const mateKey = "sporeprint-breeding-mate";

/** With whom a chosen child is crossed. */
type Mate = "self" | "a" | "b";

/** Children that have arrived are shown after this time, although others are on their way, milliseconds. */
const partlyShownMs = 400;
/** Time after which drafts become final models, milliseconds. */
const refineDelayMs = 250;

/** How long the last nine took, milliseconds. */
export interface Timings {
    /** From the click until all files had arrived. */
    service: number;
    /** The work of the service for all nine, on all its threads. */
    work: number;
    /** Reading the files and drawing them, after the last had arrived. */
    page: number;
    whole: number;
}

export interface ShownChild {
    birth: Birth;
    /** The file that was drawn first. */
    bytes?: ArrayBuffer;
}

/** Share and mutation, as controls have them. */
class GeneValues implements ControlledValues {
    readonly values = new Map<string, Value>();
    /** One species is bred with itself, so that there is nothing to share. */
    isAlone = false;

    constructor(private readonly fields: readonly Field[]) {}

    field(name: string): Field | undefined {
        return this.fields.find((field) => field.name === name);
    }

    set(name: string, value: Value | undefined): void {
        if (value === undefined || value === this.field(name)?.fallback) this.values.delete(name);
        else this.values.set(name, value);
    }

    number(name: string): number {
        return Number(this.values.get(name) ?? this.field(name)?.fallback ?? 0);
    }

    applies({ name }: Field): boolean {
        return name !== "share" || !this.isAlone;
    }
}

export class Breeder {
    readonly pedigree = new Pedigree();
    children: ShownChild[] = [];
    timings: Timings | undefined;
    private readonly store = new TreeStore();
    private readonly library = hasLibrary().catch(() => false);
    private readonly chooser = new ParentChooser(this.library);
    private readonly saving = new SaveDialog(this.pedigree, this.library);
    private readonly problems = new ProblemBox();
    private readonly grid: ChildGrid;
    private readonly tree: FamilyTree;
    private readonly locks: LockList;
    private readonly mate = byId<HTMLSelectElement>("mate");
    private readonly seed = byId<HTMLInputElement>("seed");
    private readonly texts = new Map<string, Promise<string>>();
    private genes: { values: GeneValues; controls: Controls } | undefined;
    private schema: DocumentSchema | undefined;
    private lockFamily: string | undefined;
    private current: Couple | undefined;
    /** Ends what is done for the couple that is shown: loading, then refining. */
    private showing: AbortController | undefined;
    private isLoading = false;
    /** Index of the child that the pointer or the focus is on. */
    private considered = -1;
    /** The settings were changed while children of older ones are on their way. */
    private stale = false;
    private began = 0;
    /** Of the child that was chosen last, until its picture is drawn. */
    private portrait: { key: string; draw: (() => string) | undefined } | undefined;

    constructor() {
        this.grid = new ChildGrid(byId("grid"), {
            chosen: (index) => void this.choose(index),
            save: (index) => void this.save(index),
            considered: (index) => {
                this.considered = index;
                this.fetchAhead();
            },
        });
        this.tree = new FamilyTree(
            byId("tree"),
            this.pedigree,
            (couple) => void this.show(couple, "push"),
            (couple) => void this.removeBranch(couple),
        );
        this.locks = new LockList(byId("locks"), (lock) => this.change({ lock }));
        for (const view of viewNames) {
            const button = make("button", { type: "button", "data-view": view }, viewLabels[view]);
            button.addEventListener("click", () => this.grid.look(view));
            byId("views").append(button);
        }
        this.connect();
        byId<HTMLDetailsElement>("lock-group").open = matchMedia("(min-width: 1121px)").matches;
        this.state = "busy";
    }

    /** Shows what the address names, or else the last couple of this browser. */
    async begin(): Promise<void> {
        const stored = await this.store.load();
        for (const one of stored.species) this.pedigree.add(one);
        for (const { a, b, genes, made } of stored.couples) this.pedigree.addCouple(a, b, genes, made);
        void this.makeControls();
        void this.learnNames();
        const last = this.pedigree.couple(localStorage.getItem(currentKey) ?? "");
        await this.show(this.coupleOfAddress() ?? last ?? this.founders(), "replace");
    }

    /** Reads the address anew, after a step in the browser's history. */
    async readAddress(): Promise<void> {
        const couple = this.coupleOfAddress();
        if (couple) await this.show(couple, "none");
        else if (this.notice) this.showFailure(this.notice);
    }

    private founders(): Couple {
        return this.pedigree.addCouple(...firstParents, firstGenes);
    }

    private coupleOfAddress(): Couple | undefined {
        try {
            const read = readCouple(location.search);
            if (!read) return undefined;
            for (const birth of read.births) this.pedigree.addChild(birth);
            return this.pedigree.addCouple(read.a, read.b, read.genes);
        } catch (error) {
            const detail = error instanceof Error ? error.message : "";
            this.notice = new RequestFailed("The address cannot be used", `${detail}.`, 0);
            return undefined;
        }
    }

    /** Shown with the next children, and until others are. */
    private notice: RequestFailed | undefined;

    private async learnNames(): Promise<void> {
        try {
            for (const { species } of await this.chooser.species()) this.pedigree.add(species);
            const { species } = this.pedigree.all;
            const unnamed = species.filter(({ key, name }) => key.startsWith("~") && !name);
            await Promise.all(unnamed.map(({ key }) => this.learnName(key)));
        } catch (error) {
            this.problems.show(asRequestFailed(error, "The species cannot be listed"));
        }
        this.showWords();
    }

    /** Learns the name and the family of a species of the library. */
    private async learnName(key: string): Promise<void> {
        const { facts, stages } = await getJson<{
            facts?: { common_name?: string };
            stages: { model: { form: string } }[];
        }>(`v1/library/${key}`);
        const family = stages[0]?.model.form;
        this.pedigree.add({ key, name: facts?.common_name || key, ...(family ? { family } : {}) });
    }

    private async makeControls(): Promise<void> {
        try {
            const [description, species] = await Promise.all([described(), speciesSchema()]);
            this.schema = species;
            const body = description.components.requestBodies["breeding_order"];
            const all = body?.content["application/json"]?.schema.properties ?? {};
            const properties = Object.fromEntries(
                ["mutation", "share"].flatMap((name) => (all[name] ? [[name, all[name] as Schema]] : [])),
            );
            const groups = groupsOf({ type: "object", properties }, "genes");
            const values = new GeneValues(groups.flatMap(({ fields }) => fields));
            const take = (moved: boolean): void =>
                this.change({ share: values.number("share"), mutation: values.number("mutation") }, !moved);
            const controls = new Controls(() => byId("genes"), groups, values, {
                moving: () => take(false),
                moved: () => take(true),
                errorShown: () => undefined,
            });
            this.genes = { values, controls };
            this.showGenes();
        } catch (error) {
            this.problems.show(asRequestFailed(error, "The controls cannot be made"));
        }
    }

    private connect(): void {
        const stored = localStorage.getItem(mateKey);
        if (stored === "a" || stored === "b") this.mate.value = stored;
        this.mate.addEventListener("change", () => localStorage.setItem(mateKey, this.mate.value));
        byId("again").addEventListener("click", () => {
            const { current } = this;
            if (current) this.change({ seed: nextSeeds(current.genes.seed) }, false, "push");
        });
        this.seed.addEventListener("change", () => {
            const seed = Number(this.seed.value);
            if (this.seed.value !== "" && this.seed.validity.valid) return this.change({ seed });
            announce("A seed is a whole number from 0 to 4294967295.");
            this.showGenes();
        });
        byId("same-scale").addEventListener("change", () => {
            this.grid.sameScale = byId<HTMLInputElement>("same-scale").checked;
        });
        byId("change-a").addEventListener("click", () => this.chooseParent("a"));
        byId("change-b").addEventListener("click", () => this.chooseParent("b"));
        byId("swap").addEventListener("click", () => {
            if (this.current) this.pair(this.current.b, this.current.a);
        });
        byId("alone").addEventListener("click", () => {
            if (this.current) this.pair(this.current.a, this.current.a);
        });
        byId("remove-branch").addEventListener("click", () => {
            if (this.current) void this.removeBranch(this.current);
        });
        byId("clear-tree").addEventListener("click", () => void this.clear());
        byId("save-current").addEventListener("click", () => {
            const { current } = this;
            const birth = current && this.pedigree.get(this.pedigree.childOf(current)).birth;
            if (birth) void this.saveBirth(birth);
        });
        addEventListener("popstate", () => void this.readAddress());
    }

    private chooseParent(slot: "a" | "b"): void {
        const { current, pedigree } = this;
        if (!current) return;
        const first = pedigree.get(current.a);
        const family = slot === "b" ? first.family : undefined;
        const title = slot === "a" ? "The first parent" : `A mate for ${pedigree.name(current.a)}`;
        const wish = { title, with: family ? { family, name: pedigree.name(current.a) } : undefined };
        void this.chooser.open(wish, (species) => {
            pedigree.add(species);
            void this.store.save([pedigree.get(species.key)], []);
            if (slot === "b") return this.pair(current.a, species.key);
            const other = pedigree.get(current.b).family;
            const crosses = !other || !species.family || other === species.family;
            if (!crosses) announce(`${pedigree.name(current.b)} cannot be crossed with it: it is bred alone.`);
            this.pair(species.key, crosses ? current.b : species.key);
        });
    }

    /** Shows children of other parents; as they were looked at last, if they were. */
    private pair(a: string, b: string): void {
        const { pedigree, current } = this;
        const known = pedigree.couple(keyOfCouple(a, b));
        const genes = current?.genes ?? firstGenes;
        const isOther = pedigree.get(a).family !== pedigree.get(current?.a ?? a).family;
        // Parts of one family are none of another.
        const lock = isOther ? [] : genes.lock;
        void this.show(known ?? pedigree.addCouple(a, b, { ...genes, lock, seed: firstGenes.seed }), "push");
    }

    /** Changes the genes of the couple that is shown. While a control is dragged, the newest value follows the one that
     *  is on its way. */
    private change(genes: Partial<Genes>, isDragged = false, step: "push" | "replace" = "replace"): void {
        const { current, pedigree } = this;
        if (!current) return;
        this.current = pedigree.addCouple(current.a, current.b, { ...current.genes, ...genes });
        if (isDragged && this.isLoading) {
            this.stale = true;
            return;
        }
        // The address follows once the control is released: browsers refuse many writes in a short time.
        void this.show(this.current, isDragged ? "none" : step);
    }

    /** Makes a child a parent of the next nine. */
    private async choose(index: number): Promise<void> {
        const { current, pedigree } = this;
        const birth = this.children[index]?.birth;
        if (!birth || !current) return;
        const child = pedigree.addChild(birth).key;
        const mates: Record<Mate, string> = { self: child, a: birth.a, b: birth.b };
        const mate = mates[this.mate.value as Mate];
        const known = pedigree.couple(keyOfCouple(child, mate));
        const next = known ?? pedigree.addCouple(child, mate, { ...birth.genes, seed: firstGenes.seed });
        this.portrait = { key: child, draw: this.grid.portraitOfChild(index) };
        await this.show(next, "push");
    }

    /** Draws the small picture of the child that was chosen, once the next nine are drawn. */
    private drawPortrait(): void {
        const { portrait, pedigree } = this;
        this.portrait = undefined;
        const picture = portrait?.draw?.();
        if (!portrait || !picture) return;
        pedigree.add({ key: portrait.key, picture });
        this.showWords();
    }

    /** Fetches the document of the child that may be chosen next. */
    private fetchAhead(): void {
        const birth = this.children[this.considered]?.birth;
        if (birth && this.isReady) this.textOf(birth).catch(() => undefined);
    }

    /** Returns the document of a child, fetched once. */
    private textOf(birth: Birth): Promise<string> {
        const { key, text } = this.pedigree.addChild(birth);
        if (text !== undefined) return Promise.resolve(text);
        const known = this.texts.get(key) ?? fetchSpecies(this.pedigree, birth);
        this.texts.set(key, known);
        known.catch(() => this.texts.delete(key));
        return known;
    }

    /** Fetches the documents of a species and of its ancestors, as far as requests for its children need them. */
    private async fetchLine(key: string): Promise<void> {
        const { birth, text } = this.pedigree.get(key);
        if (text !== undefined || isAddressable(key)) return;
        if (!birth)
            throw new RequestFailed(
                "A parent is not in this browser",
                "The address names a species that was never published, and only the browser where it was made has it. Choose another parent.",
                0,
            );
        await this.fetchLine(birth.a);
        await this.fetchLine(birth.b);
        this.pedigree.add({ key, text: await this.textOf(birth) });
    }

    /** Shows the nine children of a couple.
     *
     *  step  what becomes of the browser's history */
    private async show(couple: Couple, step: "push" | "replace" | "none"): Promise<void> {
        this.showing?.abort();
        const showing = new AbortController();
        const { signal } = showing;
        this.showing = showing;
        this.isLoading = true;
        this.stale = false;
        this.began = performance.now();
        this.current = couple;
        this.state = "busy";
        this.problems.hide();
        try {
            const fetched = Promise.all([this.fetchLine(couple.a), this.fetchLine(couple.b)]);
            const { genes, a, b } = couple;
            const births = seedsFrom(genes.seed).map((seed) => ({ a, b, genes: { ...genes, seed } }));
            this.children = births.map((birth) => ({ birth }));
            this.grid.expect();
            this.writeAddress(step);
            this.showWords();
            await fetched;
            signal.throwIfAborted();
            await this.load(births, signal);
        } catch (error) {
            if (signal.aborted) return;
            this.isLoading = false;
            this.state = "failed";
            this.showFailure(asRequestFailed(error, "The children cannot be bred"));
            return;
        }
        if (signal.aborted) return;
        this.drawPortrait();
        this.storeLine(couple);
        if (this.stale && this.current) return this.show(this.current, "none");
        await this.refine(signal);
    }

    private async load(births: readonly Birth[], signal: AbortSignal): Promise<void> {
        const failures: RequestFailed[] = [];
        const partly = setTimeout(() => this.grid.drawChanged(), partlyShownMs);
        let [arrived, work] = [0, 0];
        const one = async (birth: Birth, index: number): Promise<void> => {
            try {
                const file = await fetchFile(this.pedigree, birth, draftOptions, signal);
                arrived = performance.now();
                work += file.workMs;
                const child = this.children[index];
                if (child) child.bytes = file.bytes;
                await this.put(index, file, "draft", signal);
            } catch (error) {
                if (signal.aborted) throw error;
                const failed = asRequestFailed(error, "It cannot be grown");
                failures.push(failed);
                this.grid.fail(index, failed.items[0]?.detail ?? failed.detail);
            }
        };
        try {
            await Promise.all(births.map(one));
        } finally {
            clearTimeout(partly);
        }
        signal.throwIfAborted();
        this.grid.drawChanged();
        if (failures.length === childCount && failures[0]) throw failures[0];
        const end = performance.now();
        this.timings = {
            service: arrived - this.began,
            work,
            page: end - arrived,
            whole: end - this.began,
        };
        performance.measure("breed: service", { start: this.began, end: arrived });
        performance.measure("breed: page", { start: arrived, end });
        this.isLoading = false;
        this.state = "ready";
        this.fetchAhead();
        const { current, pedigree, notice } = this;
        if (current) announce(`Nine children of ${pedigree.coupleName(current)}.`);
        if (notice) this.problems.show(notice);
        this.notice = undefined;
    }

    private async put(index: number, file: ChildFile, stage: "draft" | "final", signal: AbortSignal): Promise<void> {
        const model = await parseModel(file.bytes.slice(0), file.from);
        if (signal.aborted) disposeModel(model);
        else this.grid.put(index, model, stage, stage === "final");
    }

    /** Replaces the drafts by final models, one by one, until something else is wanted. */
    private async refine(signal: AbortSignal): Promise<void> {
        const births = this.children.map(({ birth }) => birth);
        await new Promise((resolve) => setTimeout(resolve, refineDelayMs));
        for (const [index, birth] of births.entries()) {
            if (signal.aborted) return;
            try {
                await this.put(index, await fetchFile(this.pedigree, birth, finalOptions, signal), "final", signal);
            } catch {
                // The draft stays.
            }
            // Between two models the page can do what is wanted.
            await new Promise((resolve) => setTimeout(resolve, 0));
        }
        if (signal.aborted) return;
        document.documentElement.dataset["refined"] = "true";
        await this.drawMissing(signal);
    }

    /** Draws small pictures of species in the tree that have none, such as those of an address. */
    private async drawMissing(signal: AbortSignal): Promise<void> {
        const { pedigree } = this;
        const keys = pedigree.all.couples.flatMap(({ a, b }) => [a, b]);
        for (const key of new Set(keys)) {
            const { birth, picture, text } = pedigree.get(key);
            if (picture || isAddressable(key) || (!birth && text === undefined)) continue;
            try {
                await this.fetchLine(key);
                // Of itself with nothing changed.
                const same = { a: key, b: key, genes: { ...firstGenes, share: 0, mutation: 0 } };
                const { bytes, from } = await fetchFile(pedigree, same, draftOptions, signal);
                const model = await parseModel(bytes, from);
                if (!signal.aborted) pedigree.add({ key, picture: this.grid.portraitOf(model) });
                disposeModel(model);
                if (signal.aborted) return;
                void this.store.save([pedigree.get(key)], []);
                this.showWords();
            } catch {
                if (signal.aborted) return; // It has no picture then.
            }
        }
    }

    /** Stores a couple with all that it comes from. */
    private storeLine(couple: Couple): void {
        const { pedigree } = this;
        localStorage.setItem(currentKey, couple.key);
        const line = pedigree.line([couple.a, couple.b]);
        const keys = new Set([couple.a, couple.b, ...line.flatMap(({ key, birth }) => [key, birth!.a, birth!.b])]);
        const couples = [couple, ...line.map(({ birth }) => pedigree.couple(keyOfCouple(birth!.a, birth!.b))!)];
        void this.store.save([...keys].map((key) => pedigree.get(key)), couples);
    }

    private async removeBranch(couple: Couple): Promise<void> {
        const { pedigree, current } = this;
        const next = pedigree.origin(couple) ?? pedigree.offspring(undefined).find(({ key }) => key !== couple.key);
        if (!current || !next) return notify("It is all that the tree has: Clear begins anew");
        const after = pedigree.offspring(couple).length > 0 ? " and all couples that come of it" : "";
        const question = `Take ${pedigree.coupleName(couple)}${after} off the tree? Species that you have saved stay.`;
        if (!confirm(question)) return;
        const { species, couples } = pedigree.removeBranch(couple);
        if (!couples.includes(couple.key)) notify("Other branches come of this couple, so that it stays");
        for (const key of species) this.texts.delete(key);
        await this.store.remove(species, couples);
        if (pedigree.couple(current.key)) this.showWords();
        else await this.show(next, "push");
    }

    private async clear(): Promise<void> {
        const { pedigree, current } = this;
        if (!current || !confirm("Forget the whole family tree? Species that you have saved stay.")) return;
        let root = current;
        for (let before = pedigree.origin(root); before; before = pedigree.origin(root)) root = before;
        pedigree.clear();
        this.texts.clear();
        await this.store.clear();
        await this.show(pedigree.addCouple(root.a, root.b, root.genes), "push");
    }

    private async save(index: number): Promise<void> {
        const birth = this.children[index]?.birth;
        if (birth) await this.saveBirth(birth, this.grid.portraitOfChild(index)?.());
    }

    private async saveBirth(birth: Birth, portrait?: string): Promise<void> {
        try {
            const picture = portrait ?? this.pedigree.addChild(birth).picture;
            this.saving.open({ birth, text: await this.textOf(birth), picture });
        } catch (error) {
            this.showFailure(asRequestFailed(error, "It cannot be saved"));
        }
    }

    private labelOf(birth: Birth): { caption: string; label: string } {
        const { pedigree } = this;
        const generation = 1 + Math.max(pedigree.generation(birth.a), pedigree.generation(birth.b));
        const { seed } = birth.genes;
        return {
            caption: `F${generation}·${seed}`,
            label: `F${generation}, seed ${seed}, ${pedigree.descent(birth)}`,
        };
    }

    private writeAddress(step: "push" | "replace" | "none"): void {
        const { current, pedigree } = this;
        if (!current || step === "none") return;
        const query = coupleQuery(pedigree, current);
        byId("too-long").hidden = query !== undefined;
        const address = query ?? location.pathname;
        if (address === location.search) return;
        history[step === "push" ? "pushState" : "replaceState"](null, "", address);
    }

    /** Shows parents, names of children, tree and sentence anew. */
    private showWords(): void {
        const { current, pedigree } = this;
        if (!current) return;
        this.grid.name(this.children.map(({ birth }) => this.labelOf(birth)));
        const { a, b } = current;
        const isAlone = a === b;
        byId("sentence").textContent = isAlone
            ? `Nine mutations of ${pedigree.name(a)}`
            : `Nine children of ${pedigree.name(a)} and ${pedigree.name(b)}`;
        document.title = `${pedigree.coupleName(current)} · Breed · Sporeprint`;
        for (const [slot, key] of [["a", a], ["b", b]] as const) {
            byId(`name-${slot}`).textContent = slot === "b" && isAlone ? "No mate: A mutates" : pedigree.name(key);
            byId(`about-${slot}`).textContent = slot === "b" && isAlone ? "" : this.aboutOf(pedigree.get(key));
            byId(`picture-${slot}`).replaceChildren(
                ...(slot === "b" && isAlone ? [] : [pictureElement(pedigree, key, "picture")]),
            );
        }
        byId<HTMLButtonElement>("swap").disabled = byId<HTMLButtonElement>("alone").disabled = isAlone;
        const labels: Record<Mate, string> = {
            self: "itself: mutation alone",
            a: `A, ${pedigree.name(a)}`,
            b: `B, ${pedigree.name(b)}`,
        };
        for (const option of this.mate.options) {
            option.textContent = labels[option.value as Mate];
            option.hidden = isAlone && option.value === "b";
        }
        const child = pedigree.childOf(current);
        const save = byId<HTMLButtonElement>("save-current");
        save.hidden = !pedigree.get(child).birth;
        save.textContent = `Save ${pedigree.name(child)}…`;
        this.tree.show(current.key);
        this.showGenes();
        this.showLocks();
    }

    private aboutOf({ birth, key }: Species): string {
        if (birth) return `${this.pedigree.descent(birth)}, seed ${birth.genes.seed}`;
        return key.startsWith("own-") ? "draft of this browser" : key;
    }

    private showGenes(): void {
        const { current, genes } = this;
        if (!current) return;
        if (document.activeElement !== this.seed) this.seed.value = String(current.genes.seed);
        this.locks.show(current.genes.lock);
        const count = current.genes.lock.length;
        byId("lock-count").textContent = count > 0 ? String(count) : "";
        if (!genes) return;
        genes.values.isAlone = current.a === current.b;
        genes.values.set("share", current.genes.share);
        genes.values.set("mutation", current.genes.mutation);
        genes.controls.show({});
    }

    /** Offers the locks of the family that is bred. */
    private showLocks(): void {
        const { current, pedigree, schema } = this;
        if (!current || !schema) return;
        const family = pedigree.get(current.a).family ?? "swept";
        if (family === this.lockFamily) return;
        this.lockFamily = family;
        this.locks.make(locksOf(schema, family));
        this.locks.show(current.genes.lock);
    }

    private showFailure(failed: RequestFailed): void {
        const retry = failed.status === 0 ? undefined : () => this.current && void this.show(this.current, "replace");
        this.problems.show(failed, retry);
        announce([failed.message, ...failed.items.map(({ detail }) => detail)].join(" "));
    }

    private get isReady(): boolean {
        return document.documentElement.dataset["breed"] === "ready";
    }

    /** What the page is at, for its style and for tests. */
    private set state(state: "busy" | "ready" | "failed") {
        document.documentElement.dataset["breed"] = state;
        if (state === "busy") delete document.documentElement.dataset["refined"];
        byId("grid").setAttribute("aria-busy", String(state === "busy"));
    }
}
