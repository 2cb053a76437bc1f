// The dialog in which a parent is chosen. For the second one it lists what can be crossed with the first.
import { byId, make } from "../dom";
import { asRequestFailed } from "../http";
import { isFound } from "../designer/species_chooser";
import type { FamilyName, Species } from "./pedigree";
import { builtIn, designersDraft, hasDraft, ofLibrary, type Candidate } from "./parents";

/** Time without a key after which the library is searched, milliseconds. */
const searchDelayMs = 200;

export interface Wish {
    title: string;
    /** Only species of this family can be chosen, since it is crossed with this one; undefined for any. */
    with: { family: FamilyName; name: string } | undefined;
}

export class ParentChooser {
    private readonly dialog = byId<HTMLDialogElement>("parent-dialog");
    private readonly search = byId<HTMLInputElement>("parent-search");
    private readonly list = byId("parent-list");
    private readonly note = byId("parent-note");
    private readonly error = byId("parent-error");
    private readonly draft = byId<HTMLButtonElement>("parent-draft");
    private candidates: Candidate[] = [];
    private listing: Promise<Candidate[]> | undefined;
    private library: Candidate[] = [];
    private more = false;
    private searching: AbortController | undefined;
    private timer: ReturnType<typeof setTimeout> | undefined;
    private wish: Wish | undefined;
    private chosen: ((species: Species) => void) | undefined;

    /** `hasLibrary` is true if the service has a library. */
    constructor(private readonly hasLibrary: Promise<boolean>) {
        byId("parent-close").addEventListener("click", () => this.dialog.close());
        this.search.addEventListener("input", () => {
            this.show();
            clearTimeout(this.timer);
            this.timer = setTimeout(() => void this.searchLibrary(), searchDelayMs);
        });
        this.draft.addEventListener("click", () => void this.takeDraft());
        this.list.addEventListener("keydown", (event) => this.key(event));
    }

    /** All built-in species; fetched once. */
    species(): Promise<Candidate[]> {
        this.listing ??= builtIn();
        this.listing.catch(() => (this.listing = undefined));
        return this.listing;
    }

    async open(wish: Wish, chosen: (species: Species) => void): Promise<void> {
        this.wish = wish;
        this.chosen = chosen;
        byId("parent-title").textContent = wish.title;
        this.say("");
        this.search.value = "";
        this.library = [];
        this.dialog.showModal();
        this.search.focus();
        this.show();
        this.draft.hidden = !(await hasDraft());
        try {
            this.candidates = await this.species();
            this.show();
            await this.searchLibrary();
        } catch (error) {
            this.say(asRequestFailed(error, "The species cannot be listed").message);
        }
    }

    private async searchLibrary(): Promise<void> {
        if (!(await this.hasLibrary)) return;
        this.searching?.abort();
        const searching = new AbortController();
        this.searching = searching;
        const families = new Map(
            this.candidates.flatMap(({ form, species: { family } }) => (family ? [[form, family] as const] : [])),
        );
        try {
            const { found, more } = await ofLibrary(this.search.value.trim(), families, searching.signal);
            if (searching.signal.aborted) return;
            this.library = found;
            this.more = more;
            this.show();
        } catch (error) {
            if (!searching.signal.aborted) this.say(asRequestFailed(error, "The library cannot be listed").message);
        }
    }

    private say(text: string): void {
        this.error.hidden = text === "";
        this.error.textContent = text;
    }

    private show(): void {
        const { wish } = this;
        const text = this.search.value;
        const all = [...this.library, ...this.candidates];
        const fits = ({ species: { family } }: Candidate): boolean =>
            !wish?.with || !family || family === wish.with.family;
        const found = all.filter((one) => {
            const { key, name } = one.species;
            return isFound({ id: key, common_name: name ?? "", scientific_name: one.about, form: one.form }, text);
        });
        const shown = found.filter(fits);
        this.list.replaceChildren(...shown.map((one) => make("li", {}, this.button(one))));
        const others = all.filter((one) => !fits(one));
        const family = others[0]?.species.family;
        const more = this.more ? " The library has more: search for them by name." : "";
        this.note.textContent =
            `${shown.length} of ${all.length}.` +
            (wish?.with && family
                ? ` ${others.length} ${family} species cannot be crossed with ${wish.with.name}, which is ${wish.with.family}.`
                : "") +
            more;
    }

    private button({ species, about }: Candidate): HTMLElement {
        const picture = make("img", {
            src: `v1/mushrooms/${species.key}.png?width=128&height=128&view=three_quarter`,
            alt: "",
            width: 64,
            height: 64,
            loading: "lazy",
        });
        const button = make(
            "button",
            { type: "button", "data-species": species.key },
            picture,
            make("span", {}, make("b", {}, species.name ?? species.key), make("i", {}, about)),
        );
        button.addEventListener("click", () => this.take(species));
        return button;
    }

    private take(species: Species): void {
        this.dialog.close();
        this.chosen?.(species);
    }

    private async takeDraft(): Promise<void> {
        this.say("");
        this.draft.disabled = true;
        try {
            const species = await designersDraft(new AbortController().signal);
            const { wish } = this;
            if (wish?.with && species.family !== wish.with.family)
                this.say(
                    `The draft is ${species.family} and ${wish.with.name} is ${wish.with.family}; only species of one family can be crossed.`,
                );
            else this.take(species);
        } catch (error) {
            this.say(asRequestFailed(error, "The draft cannot be used").message);
        } finally {
            this.draft.disabled = false;
        }
    }

    /** Arrows walk through the list. */
    private key(event: KeyboardEvent): void {
        const step = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[event.key];
        const buttons = [...this.list.querySelectorAll("button")];
        const at = buttons.indexOf(document.activeElement as HTMLButtonElement);
        if (step === undefined || at < 0) return;
        event.preventDefault();
        buttons[Math.min(buttons.length - 1, Math.max(0, at + step))]?.focus();
    }
}
