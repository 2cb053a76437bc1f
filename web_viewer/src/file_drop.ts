// Local files, dropped on the page or chosen with the button, and the settings
// that the service finds in them.
import { byId } from "./dom";
import { RequestFailed, send } from "./http";
import { modelAt, type Product } from "./products";
import { mixPattern } from "./settings";

/** Calls `open` for each file that is dropped on the page or chosen with the button "Open". */
export function acceptFiles(open: (file: File) => void): void {
    acceptChosen(open);
    acceptDropped(open);
}

function acceptChosen(open: (file: File) => void): void {
    const input = byId<HTMLInputElement>("file");
    byId("open").addEventListener("click", () => input.click());
    input.addEventListener("change", () => {
        const chosen = input.files?.[0];
        input.value = "";
        if (chosen) open(chosen);
    });
}

/** Calls `open` for each file that is dropped on the page, with what it was dropped on. */
export function acceptDropped(open: (file: File, on: EventTarget | null) => void): void {
    const overlay = byId("drop");
    const carriesFile = (event: DragEvent): boolean =>
        event.dataTransfer?.types.includes("Files") ?? false;
    addEventListener("dragover", (event) => {
        if (!carriesFile(event)) return;
        event.preventDefault();
        overlay.hidden = false;
    });
    addEventListener("dragleave", (event) => {
        if (!event.relatedTarget) overlay.hidden = true;
    });
    addEventListener("drop", (event) => {
        overlay.hidden = true;
        const dropped = event.dataTransfer?.files[0];
        if (!dropped) return;
        event.preventDefault();
        open(dropped, event.target);
    });
}

/** The settings from which a file was made. */
export interface FileSettings {
    product: Product;
    /** Species, mix or preset. */
    id: string;
    /** Query of its URL: "?age=0.4", or nothing. */
    query: string;
}

/** Returns the settings of a GLB, from the service.
 *
 *  throws  RequestFailed if the service made no such file, or a product that this page cannot show;
 *          `noun` is what the page shows */
export async function inspectFile(file: File, noun: string): Promise<FileSettings> {
    const response = await send("v1/inspect", {
        method: "POST",
        headers: { "Content-Type": "model/gltf-binary" },
        body: file,
    });
    const { canonical } = (await response.json()) as { canonical?: string };
    const address = new URL(canonical ?? "", location.href);
    const found = modelAt(decodeURIComponent(address.pathname));
    if (found && mixPattern.test(found.id)) return { ...found, query: address.search };
    const detail = canonical ? `It was made by ${canonical}` : "It names no settings.";
    throw new RequestFailed(`${file.name} is not a ${noun} of this page`, detail, 0);
}
