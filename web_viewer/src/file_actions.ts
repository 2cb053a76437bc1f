// The buttons for the shown model: download, and copies of its URL, curl command, code, manifest
// and the request of a set.
import { byId, make } from "./dom";
import { asRequestFailed, getJson } from "./http";
import type { LoadedModel } from "./model_loader";
import { snippetFor } from "./snippets";
import { notify } from "./status_line";

/** Time after which the memory of a saved file is freed: the download has begun by then. */
const revokeMs = 10_000;

/** Saves bytes as a download. */
export function saveFile(blob: Blob, name: string): void {
    const address = URL.createObjectURL(blob);
    make("a", { href: address, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(address), revokeMs);
    notify(`${name} saved`);
}

/** Copies a text; without the permission to do so it shows the text for copying by hand. */
export async function copy(text: string, label: string): Promise<void> {
    try {
        await navigator.clipboard.writeText(text);
        notify(`${label} copied`);
    } catch {
        prompt(label, text);
    }
}

/** Returns the absolute canonical URL of a model. */
function canonicalUrl({ fetched, request }: LoadedModel): string {
    const { headers } = fetched.response;
    return new URL(headers.get("content-location") ?? request.address, location.href).href;
}

export class FileActions {
    private shown: LoadedModel | undefined;

    /** `noun` names files that the server gave no name; `setRequest` returns the body that requests
     *  a set like the model, undefined if there is none. */
    constructor(
        private readonly noun: string,
        private readonly setRequest: () => string | undefined,
    ) {
        byId("download").addEventListener("click", () => {
            if (!this.shown) return;
            const blob = new Blob([this.shown.fetched.bytes], { type: "model/gltf-binary" });
            saveFile(blob, this.fileName(this.shown));
        });
        byId("copy-url").addEventListener("click", () => {
            if (this.shown) void copy(canonicalUrl(this.shown), "URL");
        });
        byId("copy-curl").addEventListener("click", () => {
            if (this.shown) void copy(this.curlCommand(this.shown), "curl command");
        });
        byId("copy-code").addEventListener("click", () => {
            if (!this.shown) return;
            const url = canonicalUrl(this.shown);
            const profile = new URL(url).searchParams.get("profile") ?? "";
            void copy(snippetFor(profile, url), "Code");
        });
        byId("copy-manifest").addEventListener("click", () => {
            if (this.shown) void this.copyManifest(canonicalUrl(this.shown));
        });
        byId("copy-set").addEventListener("click", () => {
            const body = this.setRequest();
            if (body !== undefined) void copy(body, "Set request");
        });
    }

    /** The name of the shown model: that of its file without an ending. */
    get modelName(): string {
        return this.shown ? this.fileName(this.shown).replace(/\.glb$/, "") : this.noun;
    }

    /** Lets the buttons act on this model; drafts cannot be taken away. */
    show(loaded: LoadedModel): void {
        this.shown = loaded;
        const { fetched, draft, request } = loaded;
        for (const id of ["download", "copy-url", "copy-curl", "copy-code", "copy-manifest"]) {
            byId<HTMLButtonElement>(id).disabled = draft;
        }
        byId<HTMLButtonElement>("copy-set").disabled = draft || this.setRequest() === undefined;
        if (request.body !== undefined) {
            // Arcs and rows are sent in a body: a URL exists only if the server names one.
            for (const id of ["copy-url", "copy-code", "copy-manifest"]) {
                byId<HTMLButtonElement>(id).disabled =
                    !fetched.response.headers.has("content-location");
            }
        }
    }

    private async copyManifest(url: string): Promise<void> {
        try {
            const address = url.replace(/\.glb(?=\?|$)/, ".json");
            await copy(JSON.stringify(await getJson(address), undefined, 2), "Manifest");
        } catch (error) {
            notify(asRequestFailed(error, "The manifest could not be read").message);
        }
    }

    private curlCommand(loaded: LoadedModel): string {
        const { fetched, request } = loaded;
        const posted =
            request.body !== undefined && !fetched.response.headers.has("content-location");
        const data = posted ? ` -H 'Content-Type: application/json' -d '${request.body}'` : "";
        return `curl -o '${this.fileName(loaded)}'${data} '${canonicalUrl(loaded)}'`;
    }

    private fileName({ fetched }: LoadedModel): string {
        const disposition = fetched.response.headers.get("content-disposition") ?? "";
        return /filename="([\w.-]+)"/.exec(disposition)?.[1] ?? `${this.noun}.glb`;
    }
}
