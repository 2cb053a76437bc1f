// The gallery: one button per species, with a picture that the service draws.
import { make } from "./dom";
import { centimetres } from "./camera";
import { isOfLibrary } from "./library_list";

export interface Species {
    id: string;
    scientific_name: string;
    common_name: string;
    family?: string;
    form?: string;
    cap_diameter_m?: [number, number] | null;
    height_m?: [number, number];
    substrate?: string;
    season?: number[];
}

const months = ["Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"];

/** Returns months as ranges: "Jul–Oct" for [7, 8, 9, 10], "Apr–Jun, Sep" for [4, 5, 6, 9]; a range
 *  may include the turn of the year. */
export function seasonText(season: readonly number[] = []): string {
    if (season.length === 12) return "all year";
    const starts = season.filter((month) => !season.includes(month === 1 ? 12 : month - 1));
    const runs = starts.map((first) => {
        let last = first;
        while (season.includes((last % 12) + 1)) last = (last % 12) + 1;
        const from = months[first - 1] ?? "";
        return first === last ? from : `${from}–${months[last - 1]}`;
    });
    return runs.join(", ");
}

function span(range: [number, number] | null | undefined): string {
    if (!range) return "";
    const low = Number((range[0] * 100).toPrecision(2));
    return `${low}–${centimetres(Number(range[1].toPrecision(2)))}`;
}

/** Returns one line about a species: "cap 8–20 cm · soil · Jul–Oct". */
export function factLine(species: Species): string {
    const cap = span(species.cap_diameter_m);
    const tall = span(species.height_m);
    return [
        cap ? `cap ${cap}` : tall && `${tall} tall`,
        species.substrate,
        seasonText(species.season),
    ]
        .filter(Boolean)
        .join(" · ");
}

/** Returns true if a species matches every word: a part of its names, form or substrate, or a month
 *  in which it fruits. */
export function matchesSearch(species: Species, words: string): boolean {
    const { common_name: common, scientific_name: scientific, form, substrate } = species;
    const text = [common, scientific, form, substrate]
        .join(" ")
        .toLowerCase();
    const fruiting = (species.season ?? []).map((month) => (months[month - 1] ?? "").toLowerCase());
    return words
        .toLowerCase()
        .split(/\s+/)
        .filter(Boolean)
        .every((word) => text.includes(word) || fruiting.some((month) => word.startsWith(month)));
}

export class Gallery {
    private readonly buttons = new Map<string, HTMLButtonElement>();
    /** Called with how many species match the search. */
    filtered: (shown: number) => void = () => undefined;
    private words = "";
    private shown = "";

    constructor(
        private readonly host: HTMLElement,
        readonly species: Species[],
        private readonly choose: (id: string) => void,
    ) {
        for (const one of species) this.append(one);
        host.addEventListener("keydown", (event) => {
            const all = [...this.buttons.values()].filter(
                (button) => !button.closest("li")?.hidden,
            );
            const at = all.indexOf(document.activeElement as HTMLButtonElement);
            const step = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[event.key];
            if (at < 0 || step === undefined) return;
            event.preventDefault();
            all[(at + step + all.length) % all.length]?.focus();
        });
    }

    /** Adds the species that it does not have, at its end; returns their ids. */
    add(species: readonly Species[]): string[] {
        const added = species.filter(({ id }) => !this.buttons.has(id));
        for (const one of added) {
            // Other parts of the page have the same list.
            this.species.push(one);
            this.append(one);
        }
        this.markShown(this.shown);
        this.filter(this.words);
        return added.map(({ id }) => id);
    }

    private append(one: Species): void {
        const isListed = isOfLibrary(one.id);
        if (isListed && !this.host.querySelector(".heading"))
            this.host.append(make("li", { class: "heading" }, "Library"));
        const picture = make("span", { class: "picture", "aria-hidden": true });
        const button = make(
            "button",
            {
                type: "button",
                "data-species": one.id,
                "aria-pressed": "false",
                title: factLine(one) || undefined,
            },
            picture,
            make(
                "span",
                { class: "names" },
                make("span", { class: "common" }, one.common_name),
                make("i", { lang: isListed ? undefined : "la" }, one.scientific_name),
            ),
        );
        button.addEventListener("click", () => this.choose(one.id));
        this.buttons.set(one.id, button);
        this.host.append(make("li", {}, button));
    }

    /** Shows only the species that match all words; returns how many. */
    filter(words: string): number {
        this.words = words;
        let shown = 0;
        for (const one of this.species) {
            const item = this.buttons.get(one.id)?.closest("li");
            const fits = matchesSearch(one, words);
            if (item) item.hidden = !fits;
            shown += fits ? 1 : 0;
        }
        this.filtered(shown);
        return shown;
    }

    find(id: string): Species | undefined {
        return this.species.find((one) => one.id === id);
    }

    /** Marks what is on the stage: a species, or each member of a mix. */
    markShown(mix: string): void {
        this.shown = mix;
        const members = mix.split(",").map((member) => member.split(":")[0]);
        for (const [id, button] of this.buttons) {
            const chosen = members.includes(id);
            if (chosen && button.getAttribute("aria-pressed") !== "true") {
                this.scrollIntoList(button);
            }
            button.setAttribute("aria-pressed", String(chosen));
        }
    }

    /** Labels the species of a morph with letters, in their order; all others have none. */
    setLetters(ids: readonly string[]): void {
        for (const [id, button] of this.buttons) {
            const at = ids.indexOf(id);
            const picture = button.querySelector<HTMLElement>(".picture");
            if (at < 0) picture?.removeAttribute("data-letter");
            else picture?.setAttribute("data-letter", String.fromCharCode(65 + at));
        }
    }

    /** Shows the pictures of species, at the address that `address` returns for an id. Resolves
     *  when all are loaded; one that cannot be had leaves its place empty. */
    async showPictures(ids: readonly string[], address: (id: string) => string): Promise<void> {
        await Promise.all(
            ids.map(async (id) => {
                const button = this.buttons.get(id);
                const image = make("img", { src: address(id), alt: "", width: 96, height: 96 });
                try {
                    await image.decode();
                    button?.querySelector(".picture")?.replaceChildren(image);
                } catch {
                    // The species can still be opened.
                }
            }),
        );
    }

    /** Scrolls the list only, never the page. */
    private scrollIntoList(button: HTMLButtonElement): void {
        const list = button.closest("ul");
        if (!list) return;
        const item = button.getBoundingClientRect();
        const frame = list.getBoundingClientRect();
        if (item.left < frame.left) list.scrollLeft += item.left - frame.left - 8;
        if (item.right > frame.right) list.scrollLeft += item.right - frame.right + 8;
        if (item.top < frame.top) list.scrollTop += item.top - frame.top - 8;
        if (item.bottom > frame.bottom) list.scrollTop += item.bottom - frame.bottom + 8;
    }
}
