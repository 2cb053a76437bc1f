// The list of the fungi of a world, in place of the text that names them: each can be taken out, and others added.
import { make } from "../dom";

/** As many species as a world can have. */
export const mostSpecies = 12;

export interface NamedSpecies {
    id: string;
    name: string;
}

/** Returns the ids of a list as the service has it. */
export function idsOf(text: string): string[] {
    return text.split("+").filter(Boolean);
}

export class SpeciesPicker {
    private readonly list = make("ul", { class: "chips" });
    private readonly choice = make("select", { "aria-label": "Add a species" });
    private ids: string[] = [];

    /** Takes the place of the text entry in the row of a control. */
    constructor(
        row: HTMLElement,
        private readonly species: readonly NamedSpecies[],
        private readonly changed: (ids: string) => void,
    ) {
        row.classList.add("picked");
        row.querySelector(".entry")?.after(make("div", { class: "picker" }, this.list, this.choice));
        row.querySelector("label")?.removeAttribute("for");
        this.choice.addEventListener("change", () => {
            if (this.choice.value) this.changed([...this.ids, this.choice.value].sort().join("+"));
        });
    }

    /** Shows a list of species, and for those that cannot live in the world why not. */
    show(ids: readonly string[], whyNot: ReadonlyMap<string, string>): void {
        const focused = this.list.contains(document.activeElement);
        this.ids = [...ids];
        const nameOf = (id: string): string => this.species.find((one) => one.id === id)?.name ?? id;
        this.list.replaceChildren(
            ...ids.map((id) => {
                const why = whyNot.get(id);
                const button = make("button", { type: "button", "aria-label": `Take ${nameOf(id)} out` }, "×");
                button.addEventListener("click", () => this.changed(this.ids.filter((one) => one !== id).join("+")));
                return make("li", { class: why ? "absent" : undefined, title: why }, nameOf(id), button);
            }),
        );
        const others = this.species.filter(({ id }) => !ids.includes(id));
        this.choice.replaceChildren(
            make("option", { value: "" }, ids.length < mostSpecies ? "Add a species…" : `${mostSpecies} species at most`),
            ...others.map(({ id, name }) => make("option", { value: id }, name)),
        );
        this.choice.disabled = ids.length >= mostSpecies;
        if (focused) (this.list.querySelector("button") ?? this.choice).focus();
    }
}
