// The navigation at the top: one link per product, one to the morph editor, and one each to the pages
// of the designer, of breeding and of worlds.
import { byId, make } from "./dom";
import { fewestMembers, mostMembers, readShares, sharesText } from "./mix";
import { mushrooms, products, type Product } from "./products";
import type { Settings } from "./settings";

export interface ModeLinkEvents {
    /** The single species was chosen, without loading another page. */
    species: () => void;
    /** The morph editor was chosen, without loading another page. */
    morph: () => void;
}

/** Returns true for a click that opens the link in this window. */
function isPlainClick(event: MouseEvent): boolean {
    return !(event.ctrlKey || event.metaKey || event.shiftKey || event.altKey);
}

export class ModeLinks {
    private readonly links = new Map<string, HTMLAnchorElement>();
    private readonly morphLink = make("a", { id: "mode-morph", href: "?" }, "Morph");

    constructor(private readonly product: Product) {
        for (const { queryName: kind, label, canMorph } of products) {
            const href = kind === mushrooms.queryName ? "?" : `?${kind}`;
            const link = make("a", { id: `mode-${kind}`, href }, label);
            this.links.set(kind, link);
            byId("modes").append(link);
            if (canMorph) byId("modes").append(this.morphLink);
        }
        byId("modes").append(make("a", { id: "mode-designer", href: "editor" }, "From a photo"));
        byId("modes").append(make("a", { id: "mode-breed", href: "breed" }, "Breed"));
        byId("modes").append(make("a", { id: "mode-world", href: "world" }, "Worlds"));
        this.morphLink.hidden = !product.canMorph;
        this.mark(this.link(product));
    }

    /** Switches between species and morph within this page. */
    connect(events: ModeLinkEvents): void {
        if (!this.product.canMorph) return;
        const modes = [
            [this.link(mushrooms), events.species],
            [this.morphLink, events.morph],
        ] as const;
        for (const [link, open] of modes) {
            link.addEventListener("click", (event) => {
                if (!isPlainClick(event)) return;
                event.preventDefault();
                open();
            });
        }
    }

    /** Marks the current mode and lets the links carry the mix to the other modes. `ids` are the
     *  species of the gallery. */
    show({ mix, morph }: Settings, ids: readonly string[]): void {
        if (!this.product.ofSpecies) return;
        for (const { ofSpecies, canMorph, queryName: kind } of products) {
            if (ofSpecies && !canMorph)
                this.links.get(kind)?.setAttribute("href", `?${kind}=${mix}`);
        }
        if (!this.product.canMorph) return this.linkBack(mix);
        this.mark(morph ? this.morphLink : this.link(mushrooms));
        const first = morph?.shares.find(({ weight }) => weight > 0)?.id ?? mix.split(/[:,]/)[0];
        const other = ids.find((id) => id !== first);
        this.link(mushrooms).href = `?${mushrooms.queryName}=${first}`;
        this.morphLink.href = morph ? location.search : `?morph=${first}:0.5,${other}:0.5`;
    }

    /** Links a colony's mix to its species and, if it is one, to its morph. */
    private linkBack(mix: string): void {
        const shares = readShares(mix) ?? [];
        const isMorph = shares.length >= fewestMembers && shares.length <= mostMembers;
        this.link(mushrooms).href = `?${mushrooms.queryName}=${mix}`;
        if (isMorph) this.morphLink.href = `?morph=${sharesText(shares)}`;
        this.morphLink.hidden = !isMorph;
    }

    private link({ queryName: kind }: Product): HTMLAnchorElement {
        return this.links.get(kind)!;
    }

    private mark(current: HTMLAnchorElement): void {
        for (const link of [...this.links.values(), this.morphLink]) {
            if (link === current) link.setAttribute("aria-current", "page");
            else link.removeAttribute("aria-current");
        }
    }
}
