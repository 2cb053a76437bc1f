// The search field above the gallery: every word narrows the list, Escape shows all of it again.
import { byId } from "./dom";
import type { Gallery } from "./gallery";

/** Connects the search field to the gallery. */
export function connectSearch(gallery: Gallery): void {
    const input = byId<HTMLInputElement>("find");
    const search = (): void => {
        gallery.filter(input.value);
    };
    gallery.filtered = (shown) => {
        const total = gallery.species.length;
        byId("found").textContent = input.value.trim() ? `${shown} of ${total}` : "";
    };
    input.addEventListener("input", search);
    input.addEventListener("keydown", (event) => {
        if (event.key !== "Escape" || input.value === "") return;
        event.preventDefault();
        input.value = "";
        search();
    });
}
