// The morph editor: two to five species, a point or a slider between them, and for two of them the
// graph of correspondence between their outlines. It changes `settings.morph`; page.ts requests the
// model.
import { crossing, matched, mostArcs, rounded, widestGap, type Arc, type CurveName } from "./arcs";
import { byId, make } from "./dom";
import type { Species } from "./gallery";
import { Graph, type Correspondence } from "./graph";
import { History } from "./history";
import { getJson, type ProblemItem } from "./http";
import { fewestMembers, mostMembers, reweighted, thousandths, type Share } from "./mix";
import { letterOf, WeightPad } from "./pad";
import type { Settings } from "./settings";
import { words } from "./schema";
import { announce, notify } from "./status_line";

export interface MorphEditorEvents {
    /** The morph is being dragged: a draft is needed. */
    moving: () => void;
    /** The morph was released; `name` is what was changed. */
    moved: (name: string) => void;
    /** Another set of species was chosen. */
    chosen: () => void;
    /** One species is left, which is no morph any more. */
    left: (id: string) => void;
}

/** Time without a key press after which the final model is requested, milliseconds. */
const keyDelayMs = 350;

export class MorphEditor {
    private readonly pad: WeightPad;
    private readonly graph: Graph;
    private readonly slider = make("input", {
        type: "range",
        id: "morph-t",
        name: "t",
        min: 0,
        max: 1,
        step: 0.01,
        "aria-label": "From A to B",
    });
    private readonly history = new History<readonly Arc[]>([]);
    private selected: number | undefined;
    private refused = new Map<number, string>();
    private timer: ReturnType<typeof setTimeout> | undefined;
    private known: { address: string; correspondence: Correspondence } | undefined;
    private pending: { address: string; stop: AbortController } | undefined;
    /** The species that joined by itself, so that there is a morph: the next choice takes its place. */
    private placeholder: string | undefined;
    private readonly curve = make("select", {
        id: "arc-curve",
        "aria-label": "Sub-curve of a new arc",
    });
    private readonly buttons: Record<
        "add" | "remove" | "undo" | "redo" | "reset",
        HTMLButtonElement
    >;

    constructor(
        private readonly settings: Settings,
        private readonly species: readonly Species[],
        private readonly events: MorphEditorEvents,
    ) {
        this.pad = new WeightPad({
            moving: (weights) => this.setWeights(weights, false),
            moved: (weights) => this.setWeights(weights, true),
        });
        this.slider.addEventListener("input", () => {
            const t = Number(this.slider.value);
            this.setWeights([1 - t, t], false);
        });
        this.slider.addEventListener("change", () => this.release("t"));
        byId("weights").append(
            this.pad.element,
            make(
                "div",
                { class: "between" },
                make("b", { "aria-hidden": true }, "A"),
                this.slider,
                make("b", { "aria-hidden": true }, "B"),
            ),
        );
        this.graph = new Graph({
            change: (arcs, settled) => this.changeArcs(arcs, settled),
            select: (index) => {
                this.selected = index;
                this.showGraph();
            },
        });
        const button = (
            label: string,
            title: string,
            act: () => void,
            name?: string,
        ): HTMLButtonElement => {
            const made = make("button", { type: "button", title, "aria-label": name }, label);
            made.addEventListener("click", act);
            return made;
        };
        this.buttons = {
            add: button("Add arc", "Or double-click an outline", () => this.addArc()),
            remove: button("Remove", "Takes the picked arc away (Delete)", () => this.removeArc()),
            undo: button("↶", "Undo: Ctrl+Z", () => this.applyArcs(this.history.undo()), "Undo"),
            redo: button(
                "↷",
                "Redo: Ctrl+Shift+Z",
                () => this.applyArcs(this.history.redo()),
                "Redo",
            ),
            reset: button("Reset", "Takes all own arcs away", () => this.commit([])),
        };
        // On a narrow page the graph follows the weights, so that the mushroom stays visible.
        const narrow = matchMedia("(max-width: 900px)");
        const place = (): void => {
            if (narrow.matches) byId("editor").after(byId("graph"));
            else document.querySelector("main")?.append(byId("graph"));
        };
        narrow.addEventListener("change", place);
        place();
        byId("graph-drawing").append(this.graph.element);
        byId("graph-tools").append(this.curve, ...Object.values(this.buttons));
        byId("graph").addEventListener("keydown", (event) => this.onGraphKey(event));
    }

    /** Adds a species or removes it; says why if neither is possible. */
    toggle(id: string): void {
        const shares = this.settings.morph?.shares ?? [];
        const others = shares.filter((share) => share.id !== id);
        if (others.length < shares.length) {
            this.placeholder = undefined;
            const [last] = others;
            if (others.length < fewestMembers && last) return this.events.left(last.id);
            return this.choose(others);
        }
        if (shares[0] && !this.isOfOneFamily(id, shares[0].id)) {
            const added = `${this.nameOf(id)} is ${this.familyOf(id)}`;
            const present = `${this.nameOf(shares[0].id)} ${this.familyOf(shares[0].id)}`;
            return notify(`A morph needs one family: ${added}, ${present}`);
        }
        const replaced = this.placeholder;
        this.placeholder = undefined;
        if (shares.some((share) => share.id === replaced))
            return this.choose(
                shares.map((share) => (share.id === replaced ? { ...share, id } : share)),
            );
        if (shares.length >= mostMembers)
            return notify(`A morph has at most ${mostMembers} species: take one off first`);
        this.choose([...shares, { id, weight: 0 }]);
    }

    /** Opens the editor with these shares; if they are fewer than two, the next species of the
     *  gallery joins until another one is chosen. */
    enter(shares: readonly Share[]): void {
        const chosen = shares.slice(0, mostMembers);
        const start = this.species.findIndex(({ id }) => id === chosen[0]?.id);
        for (let step = 1; chosen.length < fewestMembers && step <= this.species.length; ++step) {
            const next = this.species[(start + step + this.species.length) % this.species.length];
            const sameFamily =
                next && (!chosen[0] || this.isOfOneFamily(next.id, chosen[0].id));
            if (sameFamily && !chosen.some(({ id }) => id === next.id))
                chosen.push({ id: next.id, weight: 0 });
        }
        if (chosen.length < fewestMembers)
            return notify("This server has too few species for a morph");
        const alone = chosen.length === fewestMembers && shares.length < fewestMembers;
        this.choose(alone ? chosen.map(({ id }) => ({ id, weight: 0.5 })) : chosen);
        if (!alone) return;
        this.placeholder = chosen[1]!.id;
        notify(
            `${this.nameOf(this.placeholder)} is the other half for now: ` +
                "choose another species in the list, which takes its place",
        );
    }

    /** Updates everything to the settings. */
    show(): void {
        const morph = this.settings.morph;
        byId("editor").hidden = !morph;
        byId("graph").hidden = !this.hasGraph();
        this.history.begin(morph?.arcs ?? []);
        this.selected = undefined;
        this.refused.clear();
        this.showWeights();
        this.readGraph();
    }

    /** Updates the weights only: while they are dragged. */
    showWeights(): void {
        const morph = this.settings.morph;
        if (!morph) return;
        const { shares } = morph;
        const names = shares.map(({ id }) => this.nameOf(id));
        const two = shares.length === 2;
        this.pad.element.style.display = two ? "none" : "";
        this.slider.parentElement!.hidden = !two;
        if (two) {
            const t = shares[1]!.weight;
            this.slider.value = String(t);
            this.slider.style.setProperty("--to", `${t * 100}%`);
            this.slider.setAttribute(
                "aria-valuetext",
                names
                    .map((name, index) => `${name} ${Math.round(shares[index]!.weight * 100)} %`)
                    .join(", "),
            );
        } else {
            this.pad.show(
                names,
                shares.map(({ weight }) => weight),
            );
        }
        this.showMembers(names, shares);
    }

    /** Reads the outlines again if the age or another setting has changed them. */
    readGraph(): void {
        const address = this.graphAddress();
        if (!address) {
            this.pending?.stop.abort();
            this.pending = undefined;
            return;
        }
        if (this.known?.address === address || this.pending?.address === address)
            return this.showGraph();
        this.pending?.stop.abort();
        const request = { address, stop: new AbortController() };
        this.pending = request;
        if (this.known && !this.known.address.startsWith(address.split("?")[0] ?? ""))
            this.known = undefined;
        this.showGraph();
        byId("graph").setAttribute("aria-busy", "true");
        getJson<Correspondence>(address, request.stop.signal)
            .then(
                (correspondence) => {
                    if (this.pending !== request) return;
                    this.known = { address, correspondence: this.oriented(correspondence) };
                    this.showProblem("");
                },
                (error: unknown) => {
                    if (this.pending !== request) return;
                    this.known = undefined;
                    this.showProblem(
                        error instanceof Error ? error.message : "The outlines could not be read",
                    );
                },
            )
            .finally(() => {
                if (this.pending !== request) return;
                this.pending = undefined;
                byId("graph").removeAttribute("aria-busy");
                this.showGraph();
            });
    }

    /** Resolves when the graph shows the settings. */
    async settled(): Promise<void> {
        while (this.pending || this.timer !== undefined)
            await new Promise((resolve) => setTimeout(resolve, 20));
    }

    /** Shows why an arc is refused, in the service's words; returns false if the problem is about
     *  something else. */
    showError({ parameter, detail }: ProblemItem): boolean {
        const index = /^\/?arcs[/.](\d+)/.exec(parameter)?.[1];
        if (index === undefined || !this.settings.morph?.arcs[Number(index)]) return false;
        this.refused.set(Number(index), detail);
        this.showGraph();
        return true;
    }

    /** The model of these settings was made: no arc is refused. */
    clearRefusals(): void {
        if (this.refused.size === 0) return;
        this.refused.clear();
        this.showGraph();
    }

    /** The family of a species; of the library lists have the form only, which those that are built in have too. */
    private familyOf(id: string): string | undefined {
        const one = this.species.find((each) => each.id === id);
        if (one?.family) return one.family;
        return this.species.find(({ family, form }) => family && form === one?.form)?.family;
    }

    /** Returns false if two species cannot be mixed; of an unknown form the service decides. */
    private isOfOneFamily(one: string, other: string): boolean {
        const [a, b] = [this.familyOf(one), this.familyOf(other)];
        return a === undefined || b === undefined || a === b;
    }

    private nameOf(id: string): string {
        return this.species.find((one) => one.id === id)?.common_name ?? words(id);
    }

    private choose(shares: readonly Share[]): void {
        const sum = shares.reduce((all, { weight }) => all + weight, 0);
        const even = shares.map(({ id }) => ({ id, weight: 1 / shares.length }));
        const joined = shares.some(({ weight }) => weight === 0) && sum > 0;
        this.settings.setMorph({
            shares:
                joined || sum <= 0
                    ? even
                    : shares.map(({ id, weight }) => ({ id, weight: weight / sum })),
            arcs: [],
        });
        this.events.chosen();
    }

    private setWeights(weights: readonly number[], released: boolean): void {
        const morph = this.settings.morph;
        if (!morph) return;
        this.placeholder = undefined;
        const parts = thousandths(weights);
        this.settings.setMorph({
            ...morph,
            shares: morph.shares.map(({ id }, index) => ({
                id,
                weight: (parts[index] ?? 0) / 1000,
            })),
        });
        this.showWeights();
        this.events.moving();
        if (released) this.release("weights");
    }

    private release(name: string): void {
        clearTimeout(this.timer);
        this.timer = setTimeout(
            () => {
                this.timer = undefined;
                this.events.moved(name);
            },
            this.slider.matches(":active") || name === "pointer" ? 0 : keyDelayMs,
        );
    }

    private showMembers(names: readonly string[], shares: readonly Share[]): void {
        const list = byId("members");
        const ids = shares.map(({ id }) => id).join(",");
        if (list.dataset["ids"] !== ids) {
            list.dataset["ids"] = ids;
            list.replaceChildren(
                ...shares.map(({ id }, index) => this.member(id, index, names[index] ?? "")),
            );
        }
        [...list.children].forEach((row, index) => {
            const entry = row.querySelector("input");
            const percent = String(Math.round((shares[index]?.weight ?? 0) * 1000) / 10);
            if (
                entry &&
                (entry !== document.activeElement || Number(entry.value) !== Number(percent))
            )
                entry.value = percent;
            (row as HTMLElement).style.setProperty("--share", `${percent}%`);
        });
    }

    private member(id: string, index: number, name: string): HTMLElement {
        const entry = make("input", {
            type: "number",
            min: 0,
            max: 100,
            step: "any",
            inputmode: "decimal",
            "aria-label": `Share of ${name}, percent`,
            "data-share": id,
        });
        entry.addEventListener("change", () => {
            const percent = Number(entry.value);
            const shares = this.settings.morph?.shares ?? [];
            if (entry.value === "" || !(percent >= 0 && percent <= 100)) {
                notify(`A share is between 0 and 100 %`);
                return this.showWeights();
            }
            this.setWeights(
                reweighted(shares, index, percent / 100).map(({ weight }) => weight),
                true,
            );
        });
        const alone = make(
            "button",
            {
                type: "button",
                class: "letter",
                title: `Only ${name}`,
                "aria-label": `Only ${name}`,
            },
            letterOf(index),
        );
        alone.addEventListener("click", () =>
            this.setWeights(
                (this.settings.morph?.shares ?? []).map((_, at) => (at === index ? 1 : 0)),
                true,
            ),
        );
        const off = make(
            "button",
            {
                type: "button",
                class: "off",
                title: `Take ${name} off`,
                "aria-label": `Take ${name} off`,
            },
            "×",
        );
        off.addEventListener("click", () => this.toggle(id));
        return make(
            "li",
            { "data-member": index },
            alone,
            make("span", { class: "member" }, name),
            entry,
            make("span", { class: "unit", "aria-hidden": true }, "%"),
            off,
        );
    }

    // The graph

    /** Returns true for two species with outlines; branched ones have none. */
    private hasGraph(): boolean {
        const shares = this.settings.morph?.shares;
        return shares?.length === 2 && shares.every(({ id }) => this.familyOf(id) !== "branched");
    }

    private graphAddress(): string | undefined {
        const shares = this.settings.morph?.shares;
        if (!shares || !this.hasGraph()) return undefined;
        const age = this.settings.values.get("age");
        const query = age === undefined ? "" : `?age=${age}`;
        return `v1/morphs/${shares[0]!.id}/${shares[1]!.id}${query}`;
    }

    /** Returns a correspondence with its first member as A, whatever the order of the response. */
    private oriented(correspondence: Correspondence): Correspondence {
        if (correspondence.a === this.settings.morph?.shares[0]?.id) return correspondence;
        return {
            ...correspondence,
            a: correspondence.b,
            b: correspondence.a,
            outlines: { a: correspondence.outlines.b, b: correspondence.outlines.a },
            arcs: correspondence.arcs.map(({ curve, a, b }) => ({ curve, a: b, b: a })),
        };
    }

    private showProblem(problem: string): void {
        const box = byId("graph-problem");
        box.textContent = problem;
        box.hidden = problem === "";
    }

    private showGraph(): void {
        const morph = this.settings.morph;
        if (morph?.shares.length !== 2) return;
        const names: [string, string] = [
            this.nameOf(morph.shares[0]!.id),
            this.nameOf(morph.shares[1]!.id),
        ];
        this.graph.show(this.known?.correspondence, names);
        this.graph.showArcs(morph.arcs, new Set(this.refused.keys()), this.selected);
        const shared = this.graph.shared;
        if ([...this.curve.options].map(({ value }) => value).join() !== shared.join()) {
            this.curve.replaceChildren(
                ...shared.map((curve) => make("option", { value: curve }, words(curve))),
            );
            if (shared.includes("cap")) this.curve.value = "cap";
        }
        const { add, remove, undo, redo, reset } = this.buttons;
        add.disabled = shared.length === 0 || morph.arcs.length >= mostArcs;
        remove.disabled = this.selected === undefined || !morph.arcs[this.selected];
        undo.disabled = !this.history.undoable;
        redo.disabled = !this.history.redoable;
        reset.disabled = morph.arcs.length === 0;
        if (this.known || this.refused.size > 0) this.showProblem(this.refusal());
        byId("graph-state").textContent = this.stateText(morph.arcs);
    }

    /** Returns the service's message about the selected arc, or about the first refused one; it
     *  counts from 0, the page from 1. */
    private refusal(): string {
        if (this.refused.size === 0) return "";
        const picked =
            this.selected !== undefined && this.refused.has(this.selected)
                ? this.selected
                : [...this.refused.keys()][0]!;
        const detail = (this.refused.get(picked) ?? "").replace(
            /\/arcs\/(\d+)/g,
            (_, index) => `arc ${Number(index) + 1}`,
        );
        return `Arc ${picked + 1} is refused: ${detail}`;
    }

    private stateText(arcs: readonly Arc[]): string {
        const correspondence = this.known?.correspondence;
        if (!correspondence) return this.pending ? "Reading the outlines…" : "";
        const proof = correspondence.certificate?.simple ? ", proven not to fold" : "";
        const own = arcs.length ? `, ${arcs.length} of yours` : "";
        return `${correspondence.arcs.length} arcs found${own}${arcs.length ? "" : proof}`;
    }

    private changeArcs(arcs: readonly Arc[], settled: boolean): void {
        const morph = this.settings.morph;
        if (!morph) return;
        const now = arcs.map((arc) => ({ ...arc }));
        if (settled) return this.commit(now);
        this.settings.setMorph({ ...morph, arcs: now });
        // A crossing arc would be refused: it is requested only when it is released.
        if (!crossing(now).includes(true)) this.events.moving();
    }

    private commit(arcs: readonly Arc[]): void {
        this.history.push(arcs);
        this.applyArcs(arcs);
    }

    private applyArcs(arcs: readonly Arc[]): void {
        const morph = this.settings.morph;
        if (!morph) return;
        this.settings.setMorph({ ...morph, arcs: arcs.map((arc) => ({ ...arc })) });
        this.refused.clear();
        if (this.selected !== undefined && !arcs[this.selected]) this.selected = undefined;
        this.showGraph();
        if (!crossing(arcs).includes(true)) this.events.moving();
        this.release("arcs");
    }

    private addArc(): void {
        const arcs = this.settings.morph?.arcs ?? [];
        const gap = widestGap(arcs, this.curve.value as CurveName);
        const a = rounded(gap.a);
        const guided = rounded(matched(this.graph.guides, gap.curve, a, "a"));
        const free = arcs.every(
            (arc) => arc.curve !== gap.curve || (arc.a - a) * (arc.b - guided) > 0,
        );
        this.selected = arcs.length;
        this.commit([...arcs, { curve: gap.curve, a, b: free ? guided : rounded(gap.b) }]);
        this.graph.focusEnd(arcs.length);
        announce(`Arc ${arcs.length + 1} added on the ${gap.curve}`);
    }

    private removeArc(): void {
        const index = this.selected;
        const arcs = this.settings.morph?.arcs ?? [];
        if (index === undefined || !arcs[index]) return;
        this.selected = undefined;
        this.commit(arcs.filter((_, at) => at !== index));
        announce(`Arc ${index + 1} removed`);
        this.buttons.add.focus();
    }

    private onGraphKey(event: KeyboardEvent): void {
        const key = event.key.toLowerCase();
        if ((event.ctrlKey || event.metaKey) && (key === "z" || key === "y")) {
            const again = key === "y" || event.shiftKey;
            if (again ? !this.history.redoable : !this.history.undoable) return;
            event.preventDefault();
            this.applyArcs(again ? this.history.redo() : this.history.undo());
        } else if (
            (event.key === "Delete" || event.key === "Backspace") &&
            (event.target as Element).closest("[data-side]")
        ) {
            event.preventDefault();
            this.removeArc();
        }
    }
}
