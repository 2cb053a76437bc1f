// The dialog that starts from a species of the service or of its library, with its whole document.
import { byId, make } from "../dom";
import { asRequestFailed, getJson, send } from "../http";
import { hasLibrary, publishedPage, type LibraryPage, type LibrarySpecies } from "../library_list";
import { announce } from "../status_line";

interface Listed {
    id: string;
    common_name?: string;
    scientific_name?: string;
    form?: string;
}

/** What the holder of a token has in the library. */
export interface OwnSpecies {
    /** False without a token. */
    readonly isSignedIn: boolean;
    page(wanted: { q: string; after: string }): Promise<LibraryPage>;
    /** Opens a draft, to go on with it. */
    open(species: LibrarySpecies): Promise<void>;
    /** Draws a species that has no picture of its own. */
    portrait(species: LibrarySpecies): HTMLElement;
}

/** Time without a key press after which the library is searched, milliseconds. */
const searchDelayMs = 300;

/** Returns true for a species that has every word of a search in its names or its form. */
export function isFound(species: Listed, search: string): boolean {
    const { id, common_name: common = "", scientific_name: scientific = "", form = "" } = species;
    const text = `${id} ${common} ${scientific} ${form}`.toLowerCase();
    return search
        .toLowerCase()
        .split(/\s+/)
        .every((word) => text.includes(word));
}

/** Returns what is said of a species of the library under its name. */
export function stateOf({ newest, state }: Pick<LibrarySpecies, "newest" | "state">): string {
    const version = newest > 0 ? `@${newest}` : "draft";
    return state === "unlisted" ? `${version}, unlisted` : version;
}

export class SpeciesChooser {
    private readonly dialog = byId<HTMLDialogElement>("species-dialog");
    private readonly search = byId<HTMLInputElement>("species-search");
    private readonly list = byId("species-list");
    private readonly ofLibrary = byId("published-list");
    private readonly mine = byId<HTMLInputElement>("published-mine");
    private readonly more = byId<HTMLButtonElement>("published-more");
    private readonly error = byId("species-error");
    private species: readonly Listed[] = [];
    private buttons: HTMLElement[] = [];
    private timer: ReturnType<typeof setTimeout> | undefined;
    /** The newest search of the library; others are out of date. */
    private listing = 0;
    /** Where the next page of the library begins. */
    private next: string | null = null;

    /** `chosen` gets the document of a species as a file. */
    constructor(
        private readonly own: OwnSpecies,
        private readonly chosen: (file: File) => void,
    ) {
        for (const id of ["start-species", "another-species"])
            byId(id).addEventListener("click", () => void this.open());
        byId("species-close").addEventListener("click", () => this.dialog.close());
        this.search.addEventListener("input", () => {
            this.filter();
            clearTimeout(this.timer);
            this.timer = setTimeout(() => void this.listLibrary(""), searchDelayMs);
        });
        this.mine.addEventListener("change", () => void this.listLibrary(""));
        this.more.addEventListener("click", () => void this.listLibrary(this.next ?? ""));
    }

    private async open(): Promise<void> {
        this.dialog.showModal();
        this.search.focus();
        this.say("");
        void this.listLibrary("");
        if (this.species.length > 0) return;
        try {
            const { species } = await getJson<{ species: Listed[] }>("v1/species");
            this.species = species;
            this.buttons = species.map((one) => make("li", {}, this.button(one)));
            this.list.replaceChildren(...this.buttons);
            this.filter();
        } catch (error) {
            this.say(asRequestFailed(error, "The species cannot be listed").message);
        }
    }

    private say(text: string): void {
        this.error.hidden = text === "";
        this.error.textContent = text;
    }

    private filter(): void {
        const found = this.species.map((one) => isFound(one, this.search.value));
        this.buttons.forEach((item, index) => (item.hidden = !found[index]));
        const count = found.filter(Boolean).length;
        byId("species-count").textContent = `${count} of ${this.species.length}`;
    }

    /** Lists what the library has, from its beginning or from behind a name; nothing without a library. */
    private async listLibrary(after: string): Promise<void> {
        const listing = ++this.listing;
        const { isSignedIn } = this.own;
        this.mine.checked &&= isSignedIn;
        this.mine.parentElement!.hidden = !isSignedIn;
        this.more.disabled = true;
        try {
            if (!(await hasLibrary())) return;
            const wanted = { q: this.search.value.trim(), after };
            const isMine = this.mine.checked;
            const page = await (isMine ? this.own.page(wanted) : publishedPage(wanted));
            if (listing !== this.listing) return;
            const items = page.species.map((one) =>
                make("li", {}, isMine ? this.ownButton(one) : this.publishedButton(one)),
            );
            if (after === "") this.ofLibrary.replaceChildren(...items);
            else {
                this.ofLibrary.append(...items);
                items[0]?.querySelector("button")?.focus();
                announce(`${items.length} more species of the library.`);
            }
            this.next = page.next;
            byId("published-part").hidden = false;
            const isEmpty = this.ofLibrary.childElementCount === 0;
            byId("published-none").hidden = !isEmpty;
            byId("published-none").textContent = this.search.value
                ? "The library has none with this name."
                : "The library has none yet.";
            this.more.hidden = page.next === null;
        } catch (error) {
            if (listing === this.listing)
                this.say(asRequestFailed(error, "The library cannot be listed").message);
        } finally {
            this.more.disabled = false;
        }
    }

    private button({ id, common_name: common, scientific_name: scientific }: Listed): HTMLElement {
        const button = this.entry(id, pictureOf(id), common ?? id, scientific ?? "");
        button.addEventListener("click", () => void this.choose(`v1/species/${id}`, id));
        return button;
    }

    private publishedButton({ id, name, title, newest }: LibrarySpecies): HTMLElement {
        const published = `${id}@${newest}`;
        const button = this.entry(published, pictureOf(published), title || name, published);
        button.addEventListener("click", () => void this.choose(`v1/library/${published}`, name));
        return button;
    }

    private ownButton(one: LibrarySpecies): HTMLElement {
        const { id, name, title } = one;
        const button = this.entry(id, this.own.portrait(one), title || name, `${id} · ${stateOf(one)}`);
        button.addEventListener("click", () => {
            this.dialog.close();
            void this.own.open(one);
        });
        return button;
    }

    private entry(id: string, picture: HTMLElement, name: string, under: string): HTMLElement {
        return make(
            "button",
            { type: "button", "data-species": id },
            picture,
            make("span", {}, make("b", {}, name), make("i", {}, under)),
        );
    }

    private async choose(address: string, name: string): Promise<void> {
        this.say("");
        try {
            const text = await (await send(address)).text();
            this.dialog.close();
            this.chosen(new File([text], `${name}.json`, { type: "application/json" }));
        } catch (error) {
            this.say(asRequestFailed(error, "The species cannot be opened").message);
        }
    }
}

/** Returns the service's picture of a species. */
export function pictureOf(id: string): HTMLElement {
    return make("img", {
        src: `v1/mushrooms/${id}.png?width=128&height=128&view=front`,
        alt: "",
        width: 64,
        height: 64,
        loading: "lazy",
    });
}
