// The dialog that saves a child: as a file, as the designer's draft, in the library of the service.
import { byId, make } from "../dom";
import { forgetDraft, loadDraft, saveDraft } from "../designer/draft";
import { startOfDrawing } from "../designer/gesture";
import { Library, nameLike, namePattern, tokenIn, type StoredSpecies } from "../designer/library";
import { publishedAddress } from "../designer/library_entry";
import { storedToken, storeLink, storeToken } from "../designer/library_session";
import { saveFile } from "../file_actions";
import { asRequestFailed, send } from "../http";
import { announce } from "../status_line";
import { fetchFile, savedOptions } from "./offspring";
import { isAddressable, type Birth, type Pedigree } from "./pedigree";

export interface Saved {
    birth: Birth;
    /** The whole document. */
    text: string;
    picture: string | undefined;
}

/** Returns the address of a published species, and links to the pages that go on with it. */
function whereTo(stored: StoredSpecies): HTMLElement[] {
    const id = `${stored.id}@${stored.newest}`;
    const open = make("a", { href: `./?species=${id}` }, "Open it in the viewer");
    const edit = make("a", { href: `editor#open=${id}` }, "Open it in the designer");
    return [...publishedAddress(stored), open, edit];
}

export class SaveDialog {
    private readonly dialog = byId<HTMLDialogElement>("save-dialog");
    private readonly error = byId("save-error");
    private readonly name = byId<HTMLInputElement>("save-name");
    private readonly token = byId<HTMLInputElement>("save-token");
    private readonly publish = byId<HTMLInputElement>("save-publish");
    private readonly stored = byId("save-stored");
    private saved: Saved | undefined;

    constructor(
        private readonly pedigree: Pedigree,
        hasLibrary: Promise<boolean>,
    ) {
        byId("save-close").addEventListener("click", () => this.dialog.close());
        this.act("save-json", async ({ text }) => saveFile(this.file(text), `${this.idOf(text)}.json`));
        this.act("save-glb", async ({ birth, text }) => {
            const signal = new AbortController().signal;
            const { bytes } = await fetchFile(this.pedigree, birth, savedOptions, signal);
            saveFile(new Blob([bytes], { type: "model/gltf-binary" }), `${this.idOf(text)}.glb`);
        });
        this.act("save-designer", ({ text }) => this.toDesigner(text));
        byId("save-library").addEventListener("submit", (event) => {
            event.preventDefault();
            void this.try(() => this.toLibrary());
        });
        this.name.pattern = namePattern;
        void hasLibrary.then((has) => (byId("save-library").hidden = !has));
    }

    open(saved: Saved): void {
        this.saved = saved;
        const { birth, text, picture } = saved;
        const { genes } = birth;
        const facts = (JSON.parse(text) as { facts?: { common_name?: string } }).facts;
        byId("save-title").textContent = `Save ${this.pedigree.name(this.keyOf(saved))}`;
        const lock = genes.lock.length > 0 ? `, locked: ${genes.lock.join(", ")}` : "";
        byId("save-about").textContent =
            `${this.pedigree.coupleName(birth)}; seed ${genes.seed}, share ${genes.share}, mutation ${genes.mutation}${lock}.`;
        const image = byId<HTMLImageElement>("save-picture");
        image.hidden = !picture;
        if (picture) image.src = picture;
        this.name.value = nameLike(`${facts?.common_name ?? "child"} ${genes.seed}`.replaceAll("×", "x"));
        byId("save-token-row").hidden = storedToken() !== undefined;
        this.stored.hidden = true;
        this.say("");
        this.dialog.showModal();
        byId("save-json").focus();
    }

    private keyOf({ birth }: Saved): string {
        return this.pedigree.addChild(birth).key;
    }

    private idOf(text: string): string {
        return (JSON.parse(text) as { id: string }).id;
    }

    private file(text: string): Blob {
        return new Blob([text], { type: "application/json" });
    }

    private act(id: string, act: (saved: Saved) => Promise<void>): void {
        const button = byId<HTMLButtonElement>(id);
        button.addEventListener("click", () => void this.try(() => (this.saved ? act(this.saved) : Promise.resolve())));
    }

    private async try(act: () => Promise<void>): Promise<void> {
        this.say("");
        try {
            await act();
        } catch (error) {
            const failed = asRequestFailed(error, "It cannot be saved");
            this.say([failed.message, ...failed.items.map(({ detail }) => detail)].join("; "));
        }
    }

    private say(text: string): void {
        this.error.hidden = text === "";
        this.error.textContent = text;
    }

    private async toDesigner(text: string): Promise<void> {
        const question = "The designer has a draft in this browser already. Shall this species take its place?";
        if ((await loadDraft()) && !confirm(question)) return;
        await forgetDraft();
        // The draft before may have been one of the library; this one is not.
        storeLink(undefined);
        const file = new File([text], `${this.idOf(text)}.json`, { type: "application/json" });
        const drawing = { ...startOfDrawing, source: 1 };
        await saveDraft({ drawing, past: [], future: [], files: new Map([[1, file]]) });
        location.href = "editor";
    }

    private async toLibrary(): Promise<void> {
        const { saved } = this;
        if (!saved) return;
        const known = storedToken()?.token;
        const token = known ?? tokenIn(this.token.value);
        if (!token) throw new Error("A token begins with spk_; the operator of the service gives it out");
        const { owner } = await new Library(token).quota();
        if (!known) storeToken(token, false);
        const name = nameLike(this.name.value);
        this.name.value = name;
        const species = { ...(JSON.parse(saved.text) as object), id: name };
        const { a, b } = saved.birth;
        const parents = new URLSearchParams();
        // The library knows only parents that it can name.
        const [first, second] = [a, b].filter(isAddressable);
        if (first) parents.set("parent", first);
        if (second && second !== first) parents.set("parent2", second);
        const query = parents.size > 0 ? `?${parents}` : "";
        const response = await send(`v1/library${query}`, {
            method: "POST",
            headers: { Authorization: `Bearer ${token}`, "Content-Type": "application/json" },
            body: JSON.stringify(species),
        });
        let stored = (await response.json()) as StoredSpecies;
        if (this.publish.checked)
            stored = await new Library(token).publish(stored.id, stored.draft ?? "", "");
        const state = stored.newest > 0 ? `${stored.id}@${stored.newest} is published` : `${stored.id} is a draft`;
        this.stored.hidden = false;
        this.stored.replaceChildren(`${state}, of ${owner}.`, ...(stored.newest > 0 ? whereTo(stored) : []));
        byId("save-token-row").hidden = true;
        announce(`Saved: ${state}.`);
    }
}
