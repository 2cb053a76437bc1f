// The part of the gallery that is in the library of the service: page after page, and what a search
// finds beyond the pages that are listed.
import { byId, make } from "./dom";
import type { Gallery, Species } from "./gallery";
import { hasLibrary, libraryIdsOf, listedOf, publishedPage, publishedSpecies } from "./library_list";
import { announce } from "./status_line";

/** Time without a key press after which the library is searched, milliseconds. */
const searchDelayMs = 300;

/** Returns the species of the library that a text names, and what the service says of others. The text has the
 *  newest version where it names none. */
export async function namedSpecies(
    text: string,
): Promise<{ text: string; species: Species[]; refused: Map<string, string> }> {
    const refused = new Map<string, string>();
    const species: Species[] = [];
    let whole = text;
    await Promise.all(
        libraryIdsOf(text).map(async (id) => {
            try {
                const found = await publishedSpecies(id);
                species.push(found);
                if (found.id !== id)
                    whole = whole.replace(new RegExp(`${id.replace(".", "\\.")}(?=[:,]|$)`, "g"), found.id);
            } catch (error) {
                refused.set(id, error instanceof Error ? error.message : "");
            }
        }),
    );
    return { text: whole, species, refused };
}

export class GalleryLibrary {
    /** Where the next page begins; null if all are listed. */
    private next: string | null = null;
    private timer: ReturnType<typeof setTimeout> | undefined;
    private searching: AbortController | undefined;
    private readonly more = make("button", { type: "button", id: "more-species" }, "More of the library");
    private readonly item = make("li", { class: "more", hidden: true }, this.more);

    /** `pictured` is called with the species that were added. */
    constructor(
        private readonly gallery: Gallery,
        private readonly pictured: (ids: readonly string[]) => Promise<void>,
    ) {
        this.more.addEventListener("click", () => void this.nextPage(true));
        const input = byId<HTMLInputElement>("find");
        input.addEventListener("input", () => {
            clearTimeout(this.timer);
            this.timer = setTimeout(() => void this.search(input.value), searchDelayMs);
        });
    }

    /** Lists the first page, if the service has a library. */
    async begin(): Promise<void> {
        try {
            if (!(await hasLibrary())) return;
            byId("gallery").append(this.item);
            this.next = "";
            await this.nextPage(false);
        } catch {
            // What is built in can still be chosen.
        }
    }

    private async add(species: readonly Species[]): Promise<void> {
        const added = this.gallery.add(species);
        byId("gallery").append(this.item);
        await this.pictured(added);
    }

    private async nextPage(wanted: boolean): Promise<void> {
        if (this.next === null) return;
        this.more.disabled = true;
        try {
            const { species, next } = await publishedPage({ after: this.next });
            this.next = next;
            const listed = listedOf(species);
            if (wanted) announce(`${listed.length} more species of the library.`);
            await this.add(listed);
        } catch (error) {
            if (wanted) announce(error instanceof Error ? error.message : "The library cannot be read");
        } finally {
            this.more.disabled = false;
            this.item.hidden = this.next === null;
        }
    }

    /** Lists what a search finds in the pages that are not listed yet: the service looks for one text, the gallery
     *  for all words. */
    private async search(words: string): Promise<void> {
        this.searching?.abort();
        const longest = words.split(/\s+/).reduce((a, b) => (b.length > a.length ? b : a), "");
        if (this.next === null || longest.length < 2) return;
        const searching = new AbortController();
        this.searching = searching;
        try {
            const { species } = await publishedPage({ q: longest }, searching.signal);
            if (!searching.signal.aborted) await this.add(listedOf(species));
        } catch {
            // The species that are listed are searched all the same.
        }
    }
}
