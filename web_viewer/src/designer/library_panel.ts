// The panel of the library: a token, the user's species, saving and publishing.
import { byId, make } from "../dom";
import { asRequestFailed, RequestFailed } from "../http";
import { saveFile } from "../file_actions";
import { announce } from "../status_line";
import { hasLibrary, type LibraryPage, type LibrarySpecies } from "../library_list";
import {
    Library,
    nameLike,
    namePattern,
    tokenIn,
    type Quota,
    type StoredSpecies,
} from "./library";
import { libraryEntry, publishedAddress, purgeQuestion, type EntryActions } from "./library_entry";
import {
    forgetToken,
    storedToken,
    storeLink,
    storeToken,
    takeTokenOfAddress,
    type StoredLink,
} from "./library_session";
import type { Portraits } from "./portraits";
import type { Species } from "./service";
import type { OwnSpecies } from "./species_chooser";
import { Thumbnails } from "./thumbnails";

/** Time after the last change until a species of the library is saved, milliseconds. */
const saveDelayMs = 2000;

/** The draft in the library that is worked on. */
export interface Link extends StoredLink {
    /** As it was saved last. */
    text: string;
}

export class LibraryPanel implements OwnSpecies {
    private library: Library | undefined;
    private quota: Quota | undefined;
    private link: Link | undefined;
    private species: Species | undefined;
    private saving: ReturnType<typeof setTimeout> | undefined;
    /** Writes follow each other, so that each knows the entity tag of the one before. */
    private writing: Promise<void> = Promise.resolve();

    private readonly token = make("input", {
        type: "password",
        id: "token",
        autocomplete: "off",
        spellcheck: "false",
        "aria-describedby": "token-hint library-error",
    });
    private readonly stay = make("input", { type: "checkbox", id: "token-stay" });
    private readonly use = make("button", { type: "submit" }, "Use it");
    private readonly name = make("input", {
        type: "text",
        id: "library-name",
        pattern: namePattern,
        maxlength: 24,
        autocomplete: "off",
        spellcheck: "false",
        "aria-describedby": "name-hint library-error",
    });
    private readonly note = make("input", { type: "text", id: "library-note", maxlength: 200 });
    private readonly save = make("button", { type: "button", id: "library-save" }, "Save draft");
    private readonly publish = make(
        "button",
        { type: "button", id: "library-publish", class: "main" },
        "Publish",
    );
    private readonly error = make("p", {
        id: "library-error",
        class: "validation-error",
        role: "alert",
        hidden: true,
    });
    private readonly state = make("p", { id: "library-state", class: "hint", role: "status" });
    private readonly conflict = make("div", { class: "row", id: "library-conflict", hidden: true });
    private readonly published = make("p", { id: "library-published", hidden: true });
    private readonly list = make("ul", { id: "library-list", class: "species-list" });
    private readonly title = make("input", {
        type: "text",
        id: "library-title",
        maxlength: 64,
        autocomplete: "off",
    });
    private readonly file = make("input", {
        type: "file",
        id: "library-file",
        accept: "application/json,.json",
        hidden: true,
    });
    private readonly load = make(
        "button",
        { type: "button", id: "library-import", title: "A file that Save file has made, with all its versions" },
        "Import…",
    );
    private readonly owner = make("p", { class: "hint", id: "library-owner" });
    private readonly thumbnails: Thumbnails;
    private readonly entrance: HTMLFormElement;
    private readonly desk: HTMLElement;

    /** `opened` is called with a species of the library and returns whether it is shown, `titled` is called with a
     *  new title. */
    constructor(
        private readonly opened: (file: File) => Promise<boolean>,
        titled: (title: string) => void,
        portraits: () => Portraits,
        busy: () => boolean,
    ) {
        this.thumbnails = new Thumbnails(portraits, busy, async (id) => {
            if (!this.library) throw new Error("Nobody is signed in.");
            return (await this.library.draft(id)).text;
        });
        this.entrance = make(
            "form",
            { id: "library-entrance" },
            make("label", { for: "token" }, "Token"),
            this.token,
            make(
                "p",
                { id: "token-hint", class: "hint" },
                "It begins with spk_. The operator of the service gives it out; a server of your own prints it at its first start.",
            ),
            make("label", { class: "check" }, this.stay, " Stay signed in on this computer"),
            make("div", { class: "row" }, this.use),
        );
        const leave = make("button", { type: "button", id: "library-leave" }, "Sign out");
        this.desk = make(
            "div",
            { id: "library-desk", hidden: true },
            make("div", { class: "bar-row" }, this.owner, leave),
            make("label", { for: "library-title" }, "Title"),
            this.title,
            make("label", { for: "library-name" }, "Name"),
            this.name,
            make(
                "p",
                { id: "name-hint", class: "hint" },
                "1 to 24 characters a to z, 0 to 9 and _, the first a letter. Another name makes a copy.",
            ),
            make("label", { for: "library-note" }, "What is new"),
            this.note,
            make("div", { class: "row" }, this.save, this.publish),
            this.state,
            this.conflict,
            this.published,
            make("div", { class: "bar-row" }, make("h2", {}, "Your species"), this.load, this.file),
            this.list,
        );
        byId("library").append(this.entrance, this.desk, this.error);
        this.entrance.addEventListener("submit", (event) => {
            event.preventDefault();
            void this.enter(this.token.value.trim(), this.stay.checked);
        });
        leave.addEventListener("click", () => this.leave());
        this.save.addEventListener("click", () => void this.write(() => this.saved()));
        this.publish.addEventListener("click", () => void this.write(() => this.publishNow()));
        this.title.addEventListener("change", () => {
            const title = this.title.value.trim();
            if (title) titled(title);
            else this.showTitle();
        });
        this.load.addEventListener("click", () => this.file.click());
        this.file.addEventListener("change", () => {
            const chosen = this.file.files?.[0];
            this.file.value = "";
            if (chosen) void this.import(chosen);
        });
        this.name.addEventListener("input", () => {
            this.published.hidden = this.name.value !== this.link?.name;
            this.showState();
        });
        this.name.addEventListener("change", () => {
            const name = nameLike(this.name.value);
            if (name === this.name.value) return;
            announce(`The name is ${name}: '${this.name.value}' is not allowed.`);
            this.name.value = name;
        });
    }

    /** Shows the panel if the service has a library, and signs in with a token of the address or of the last visit. */
    async begin(): Promise<void> {
        const given = takeTokenOfAddress();
        try {
            if (!(await hasLibrary())) return;
        } catch {
            return; // A service that cannot be reached is reported where it is needed.
        }
        byId("tab-library").hidden = false;
        const known = given ? { token: given, stays: false } : storedToken();
        if (known) await this.enter(known.token, known.stays);
    }

    /** Shows what is worked on; a species of the library is saved a while after its last change. */
    show(species: Species | undefined): void {
        this.species = species;
        clearTimeout(this.saving);
        if (species && !this.link && !this.name.value)
            this.name.value = nameLike(species.facts?.common_name ?? species.id);
        if (document.activeElement !== this.title) this.showTitle();
        this.showState();
        const { link } = this;
        if (!species || !link || this.textOf(link.name) === link.text || !this.conflict.hidden) return;
        this.saving = setTimeout(() => void this.write(() => this.saved()), saveDelayMs);
    }

    private showTitle(): void {
        this.title.value = this.species?.facts?.common_name ?? "";
    }

    /** The draft that is worked on, to come back to it. */
    get linked(): Link | undefined {
        return this.link;
    }

    /** Goes on with a draft in the library, after what it belongs to was opened again. */
    resume(link: StoredLink & { text?: string }): void {
        this.follow({ text: "", ...link });
        this.name.value = link.name;
        this.say(`${link.id} · draft`);
        void this.showList();
    }

    private follow(link: Link | undefined): void {
        this.link = link;
        storeLink(link);
    }

    /** Tells that something else is worked on, which is not in the library yet. */
    forget(): void {
        this.follow(undefined);
        this.name.value = "";
        this.conflict.hidden = this.published.hidden = true;
        this.say("");
    }

    private async enter(token: string, stay: boolean): Promise<void> {
        this.showError(undefined);
        const found = tokenIn(token);
        if (!found)
            return this.showError(
                new RequestFailed(
                    "This is no token",
                    "a token is spk_, 8 letters or digits, _ and 43 characters; the whole address that the server has printed will do too",
                    0,
                ),
            );
        token = found;
        const library = new Library(token);
        try {
            this.quota = await library.quota();
            this.library = library;
            storeToken(token, stay);
            this.token.value = "";
            this.entrance.hidden = true;
            this.desk.hidden = false;
            this.showState();
            await this.showList();
            announce(`Signed in as ${this.quota.owner}.`);
        } catch (error) {
            this.leave();
            this.showError(asRequestFailed(error, "The token cannot be used"));
        }
    }

    private leave(): void {
        forgetToken();
        clearTimeout(this.saving);
        this.library = this.quota = this.link = undefined;
        this.entrance.hidden = false;
        this.desk.hidden = true;
    }

    /** What can be done with each of the user's species. */
    private readonly actions: EntryActions = {
        open: (species) => void this.open(species),
        unlist: ({ id }) =>
            void this.act(`${id} cannot be taken out of lists`, async (library) => {
                await library.unlist(id);
                announce(`${id} is in no list now; its published addresses go on.`);
                await this.showList();
            }),
        purge: (species) => void this.purge(species),
        save: ({ id, name }) =>
            void this.act(`${id} cannot be saved`, async (library) =>
                saveFile(await library.exported(id), `${name}.library.json`),
            ),
        shares: async ({ id }) =>
            (await this.act("The links cannot be listed", (library) => library.shares(id))) ?? [],
        share: ({ id }, seconds) =>
            this.act("The link cannot be made", (library) => library.share(id, seconds)),
        revoke: async ({ id }, share) => {
            await this.act("The link cannot be revoked", (library) => library.revoke(id, share.id));
            announce("The link is revoked.");
        },
    };

    private get mayWrite(): boolean {
        return !!this.quota && this.quota.scope !== "read";
    }

    /** Does what changes nothing that is worked on, after all writes before it; shows why it failed. */
    private act<T>(failure: string, act: (library: Library) => Promise<T>): Promise<T | undefined> {
        const done = this.writing.then(async () => {
            this.showError(undefined);
            if (!this.library) return undefined;
            try {
                return await act(this.library);
            } catch (error) {
                const failed = asRequestFailed(error, failure);
                this.showError(failed);
                announce(failed.message);
                return undefined;
            }
        });
        this.writing = done.then(() => undefined);
        return done;
    }

    private async purge(species: LibrarySpecies): Promise<void> {
        const { id } = species;
        if (!confirm(purgeQuestion(species))) return;
        clearTimeout(this.saving);
        await this.act(`${id} cannot be deleted`, async (library) => {
            await library.purge(id);
            // What is worked on stays, but its name is taken for ever.
            if (this.link?.id === id) {
                this.follow(undefined);
                this.name.value = `${this.name.value.slice(0, 22)}_2`;
                this.published.hidden = this.conflict.hidden = true;
                this.say(`${id} is deleted; what is here is not saved.`);
            }
            announce(`${id} is deleted.`);
            await this.showList();
        });
    }

    private async import(file: File): Promise<void> {
        await this.act(`${file.name} cannot be imported`, async (library) => {
            const { id, newest } = await library.import(file);
            const versions = newest === 1 ? "one version" : `${newest} versions`;
            announce(`${id} is imported${newest > 0 ? ` with ${versions}` : ", a draft"}.`);
            await this.showList();
            this.list.querySelector<HTMLElement>(`[data-library="${id}"]`)?.focus();
        });
    }

    /** Does one write after those before it, and shows how it ended. */
    private write(act: () => Promise<void>): Promise<void> {
        clearTimeout(this.saving);
        this.writing = this.writing.then(async () => {
            this.showError(undefined);
            this.conflict.hidden = true;
            const focused = document.activeElement;
            this.save.disabled = this.publish.disabled = true;
            try {
                await act();
            } catch (error) {
                const failed = asRequestFailed(error, "It cannot be saved");
                if (failed.status === 412) this.showSavedElsewhere(act);
                else if (failed.status !== 409 || !this.showTaken(act)) this.showError(failed);
            } finally {
                this.showState();
                // A disabled button loses the focus.
                if (document.activeElement === document.body && focused instanceof HTMLElement)
                    focused.focus();
            }
        });
        return this.writing;
    }

    private textOf(name: string): string {
        return JSON.stringify({ ...this.species, id: name });
    }

    /** Saves what is worked on, unless it is saved already. */
    private async saved(): Promise<void> {
        const { library, quota, species } = this;
        if (!library || !quota || !species) return;
        const name = this.name.value.trim();
        if (!new RegExp(`^${namePattern}$`).test(name)) {
            this.name.focus();
            throw new Error(
                `'${name}' cannot be a name; allowed are 1 to 24 characters a to z, 0 to 9 and _, the first a letter`,
            );
        }
        const text = this.textOf(name);
        const link = this.link?.name === name ? this.link : undefined;
        if (link?.text === text) return;
        this.say("Saving …");
        const stored = await library.save({ ...species, id: name }, quota.owner, link?.etag);
        this.follow({ id: stored.id, name, etag: stored.draft ?? "", text });
        this.say(`${stored.id} · draft, saved ${new Date().toLocaleTimeString()}`);
        if (!link) await this.showList();
    }

    private async publishNow(): Promise<void> {
        await this.saved();
        const { library, link } = this;
        if (!library || !link) return;
        this.say("Publishing …");
        const stored = await library.publish(link.id, link.etag, this.note.value.trim());
        this.note.value = "";
        this.showPublished(stored);
        this.say(`${stored.id} · version ${stored.newest} is published`);
        announce(`Version ${stored.newest} is published.`);
        await this.showList();
    }

    private showPublished(stored: StoredSpecies): void {
        const [link, copy] = publishedAddress(stored);
        this.published.replaceChildren(`${stored.id}@${stored.newest}: `, link!, " ", copy!);
        this.published.hidden = false;
    }

    /** Offers what can be done if the user has another species of this name; returns false if there is none, since
     *  it was withdrawn. */
    private showTaken(act: () => Promise<void>): boolean {
        const name = this.name.value.trim();
        const id = `~${this.quota?.owner ?? ""}.${name}`;
        if (!this.list.querySelector(`[data-library="${id}"]`)) return false;
        this.follow({ id, name, etag: "", text: "" });
        this.showConflict(act, {
            reason: `You have a species ${id} already.`,
            mine: "Make this its next version",
            theirs: "Open that one, and leave this one",
        });
        return true;
    }

    /** Offers what can be done if the draft in the library is another one. */
    private showSavedElsewhere(act: () => Promise<void>): void {
        this.showConflict(act, {
            reason: `${this.link?.id ?? "The draft"} was saved elsewhere since it was opened here.`,
            mine: "Save this one over it",
            theirs: "Open what was saved there",
        });
    }

    /** Offers three ways out of a conflict; what was wanted is then done. */
    private showConflict(
        act: () => Promise<void>,
        { reason, mine, theirs }: { reason: string; mine: string; theirs: string },
    ): void {
        const { library, link } = this;
        if (!library || !link) return;
        const choice = (label: string, way: string, chosen: () => Promise<void>): HTMLButtonElement => {
            const button = make("button", { type: "button", "data-way": way }, label);
            button.addEventListener("click", () => void this.write(chosen));
            return button;
        };
        const other = `${this.name.value.trim().slice(0, 21)}_2`;
        this.say("");
        this.conflict.replaceChildren(
            make("p", { class: "validation-error" }, reason),
            choice(mine, "mine", async () => {
                link.etag = (await library.draft(link.id)).etag;
                link.text = "";
                await act();
            }),
            choice(theirs, "theirs", () => this.openDraft(link.id, link.name)),
            choice(`Save this one as ${other}`, "other", async () => {
                this.follow(undefined);
                this.name.value = other;
                await act();
            }),
        );
        this.conflict.hidden = false;
        announce(reason);
        this.conflict.querySelector("button")?.focus();
    }

    get isSignedIn(): boolean {
        return !!this.library;
    }

    page(wanted: { q: string; after: string }): Promise<LibraryPage> {
        return this.library?.ownPage(wanted) ?? Promise.resolve({ species: [], next: null });
    }

    portrait(species: LibrarySpecies): HTMLElement {
        return this.thumbnails.of(species);
    }

    /** Goes on with the draft of a species. */
    open({ id, name }: LibrarySpecies): Promise<void> {
        return this.write(() => this.openDraft(id, name));
    }

    private async openDraft(id: string, name: string): Promise<void> {
        const { library } = this;
        if (!library) return;
        const { text, etag } = await library.draft(id);
        const file = new File([text], `${name}.json`, { type: "application/json" });
        // What is worked on must not be saved in its place.
        if (!(await this.opened(file))) return this.say(`${id} cannot be opened.`);
        const species = JSON.parse(text) as Species;
        this.follow({ id, name, etag, text: JSON.stringify({ ...species, id: name }) });
        this.name.value = name;
        this.say(`${id} · draft`);
        await this.showList();
    }

    private async showList(): Promise<void> {
        const { library } = this;
        if (!library) return;
        const [all, quota] = await Promise.all([library.mine(), library.quota()]);
        this.quota = quota;
        this.showOwner();
        const own = all.find(({ id }) => id === this.link?.id);
        if (own && own.newest > 0) this.showPublished(own);
        this.list.replaceChildren(
            ...all.map((species) =>
                libraryEntry(species, this.portrait(species), this.mayWrite, this.actions),
            ),
        );
        if (all.length === 0) this.list.replaceChildren(make("li", { class: "hint" }, "None yet."));
    }

    private showOwner(): void {
        const { quota } = this;
        if (!quota) return;
        const rights = quota.scope === "read" ? ", may read only" : "";
        this.owner.textContent = `${quota.owner}${rights}: ${quota.species} of ${quota.max_species} species`;
    }

    private showState(): void {
        this.save.disabled = this.publish.disabled = !this.species || !this.mayWrite;
        this.title.disabled = !this.species;
        this.load.disabled = !this.mayWrite;
        const nothing = "Open or trace a mushroom, then it can be saved here.";
        if (!this.species) this.say(nothing);
        else if (this.state.textContent === nothing) this.say("");
    }

    private say(text: string): void {
        this.state.textContent = text;
    }

    private showError(failed: RequestFailed | undefined): void {
        const items = failed?.items.map(({ parameter, detail }) => `${parameter}: ${detail}`) ?? [];
        this.error.hidden = !failed;
        this.error.textContent = failed ? [failed.message, ...items.slice(0, 5)].join("; ") : "";
        if (failed) this.say("");
    }
}
