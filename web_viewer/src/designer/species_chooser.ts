// The dialog that starts from a species of the service, with its whole document.
import { byId, make } from "../dom";
import { asRequestFailed, getJson, send } from "../http";

interface Listed {
    id: string;
    common_name?: string;
    scientific_name?: string;
    form?: string;
}

/** Returns true for a species that has every word of a search in its names or its form. */
export function isFound(species: Listed, search: string): boolean {
    const { id, common_name: common = "", scientific_name: scientific = "", form = "" } = species;
    const text = `${id} ${common} ${scientific} ${form}`.toLowerCase();
    return search
        .toLowerCase()
        .split(/\s+/)
        .every((word) => text.includes(word));
}

export class SpeciesChooser {
    private readonly dialog = byId<HTMLDialogElement>("species-dialog");
    private readonly search = byId<HTMLInputElement>("species-search");
    private readonly list = byId("species-list");
    private readonly error = byId("species-error");
    private species: readonly Listed[] = [];
    private buttons: HTMLElement[] = [];

    /** `chosen` gets the document of a species as a file. */
    constructor(private readonly chosen: (file: File) => void) {
        for (const id of ["start-species", "another-species"])
            byId(id).addEventListener("click", () => void this.open());
        byId("species-close").addEventListener("click", () => this.dialog.close());
        this.search.addEventListener("input", () => this.filter());
    }

    private async open(): Promise<void> {
        this.dialog.showModal();
        this.search.focus();
        if (this.species.length > 0) return;
        this.say("");
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

    private button({ id, common_name: common, scientific_name: scientific }: Listed): HTMLElement {
        const picture = make("img", {
            src: `v1/mushrooms/${id}.png?width=128&height=128&view=front`,
            alt: "",
            width: 64,
            height: 64,
            loading: "lazy",
        });
        const button = make(
            "button",
            { type: "button", "data-species": id },
            picture,
            make("span", {}, make("b", {}, common ?? id), make("i", {}, scientific ?? "")),
        );
        button.addEventListener("click", () => void this.choose(id));
        return button;
    }

    private async choose(id: string): Promise<void> {
        this.say("");
        try {
            const text = await (await send(`v1/species/${id}`)).text();
            this.dialog.close();
            this.chosen(new File([text], `${id}.json`, { type: "application/json" }));
        } catch (error) {
            this.say(asRequestFailed(error, "The species cannot be opened").message);
        }
    }
}
