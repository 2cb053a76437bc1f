// One species of the user in the list of the library's panel: its picture and state, and what can be done with it.
import { make } from "../dom";
import type { LibrarySpecies } from "../library_list";
import { announce } from "../status_line";
import type { Share, StoredSpecies } from "./library";
import { stateOf } from "./species_chooser";

export interface EntryActions {
    open: (species: LibrarySpecies) => void;
    unlist: (species: LibrarySpecies) => void;
    purge: (species: LibrarySpecies) => void;
    save: (species: LibrarySpecies) => void;
    shares: (species: LibrarySpecies) => Promise<Share[]>;
    /** Makes a key that is good for so many seconds; undefined if it was refused. */
    share: (species: LibrarySpecies, seconds: number) => Promise<Share | undefined>;
    revoke: (species: LibrarySpecies, share: Share) => Promise<void>;
}

const day = 86_400;

/** How long a link is good: words, and seconds. */
const durations: readonly [string, number][] = [
    ["a day", day],
    ["30 days", 30 * day],
    ["a year", 365 * day],
];

/** Returns the address of the designer that opens a draft with a key. The fragment is in no log. */
export function sharedAddress(id: string, key: string, page: string): string {
    return new URL(`editor#open=${id}&share=${key}`, page).href;
}

/** Returns the species and the key of such an address; undefined for another fragment. */
export function sharedIn(fragment: string): { id: string; key: string | undefined } | undefined {
    const found = /^#open=(~[a-z0-9_.]+(?:@\d+)?)(?:&share=(sps_[\w-]+))?$/.exec(fragment);
    return found?.[1] ? { id: found[1], key: found[2] } : undefined;
}

/** Returns the question before a species is deleted for ever. */
export function purgeQuestion({ id, newest }: Pick<LibrarySpecies, "id" | "newest">): string {
    const published = newest === 1 ? "its published version" : `its ${newest} published versions`;
    const gone =
        newest > 0
            ? `The draft and ${published} are deleted. Whoever uses ${id} in a page or a game gets an error from then on.`
            : "The draft is deleted.";
    return `Delete ${id} for ever? ${gone} Its name is never given again. This cannot be undone.`;
}

/** Copies a text; if the browser refuses, it is said. */
export async function copyText(text: string, what: string, button: HTMLElement): Promise<void> {
    const label = button.textContent;
    try {
        await navigator.clipboard.writeText(text);
        announce(`${what} is copied.`);
        button.textContent = "Copied";
        setTimeout(() => (button.textContent = label), 2000);
    } catch {
        announce(`${what} is ${text}`);
    }
}

/** Returns the address of the GLB of a published version, as a link and with a button that copies it. */
export function publishedAddress({ links }: StoredSpecies): HTMLElement[] {
    // Without its slash the address is relative, so that it is valid under any prefix.
    const path = (links.model ?? "").replace(/^.*?\/(v1\/)/, "$1");
    const address = new URL(path, document.baseURI).href;
    const copy = make("button", { type: "button" }, "Copy address");
    copy.addEventListener("click", () => void copyText(address, "The address", copy));
    return [make("a", { href: path, class: "address" }, address), copy];
}

function actionButton(label: string, act: () => void, title = "", name = ""): HTMLButtonElement {
    const attributes = { type: "button", title: title || undefined, "data-action": name || undefined };
    const button = make("button", attributes, label);
    button.addEventListener("click", act);
    return button;
}

/** Makes the item of a species; who may read only gets no actions that write. */
export function libraryEntry(
    species: LibrarySpecies,
    picture: HTMLElement,
    mayWrite: boolean,
    actions: EntryActions,
): HTMLLIElement {
    const { id, name, title, newest, state } = species;
    const words = make("span", {}, make("b", {}, title || name), make("i", {}, `${id} · ${stateOf(species)}`));
    const open = make("button", { type: "button", "data-library": id, title: "Go on with its draft" }, picture, words);
    open.addEventListener("click", () => actions.open(species));
    const links = make("div", { class: "links", hidden: true });
    const row = make("div", { class: "row" });
    row.append(
        actionButton("Share the draft…", () => void toggleLinks(species, links, mayWrite, actions), "", "share"),
        actionButton("Save file", () => actions.save(species), "All its versions as JSON, for Import", "export"),
    );
    const hint = make("p", { class: "hint" });
    if (mayWrite && newest > 0 && state === "active") {
        row.append(actionButton("Unlist", () => actions.unlist(species), "", "unlist"));
        hint.textContent = "Unlisted it is in no list; its published addresses go on. Publish it again to list it.";
    } else if (state === "unlisted")
        hint.textContent = "It is in no list, and its published addresses go on. Publish it again to list it.";
    if (newest > 0) row.append(make("a", { href: `./?species=${id}@${newest}` }, "In the viewer"));
    if (mayWrite) row.append(actionButton("Delete…", () => actions.purge(species), "", "purge"));
    const more = make(
        "details",
        { class: "entry-actions" },
        make("summary", { "aria-label": `Actions of ${id}` }, "Actions"),
        row,
        hint,
        links,
    );
    return make("li", {}, open, more);
}

async function toggleLinks(
    species: LibrarySpecies,
    host: HTMLElement,
    mayWrite: boolean,
    actions: EntryActions,
): Promise<void> {
    host.hidden = !host.hidden;
    if (!host.hidden) await showLinks(species, host, mayWrite, actions, undefined);
}

/** Lists the links to a draft; a new one has its secret, which the service shows once. */
async function showLinks(
    species: LibrarySpecies,
    host: HTMLElement,
    mayWrite: boolean,
    actions: EntryActions,
    made: Share | undefined,
): Promise<void> {
    const again = (share?: Share): Promise<void> => showLinks(species, host, mayWrite, actions, share);
    const until = ({ expires_s: end }: Share): string => new Date(end * 1000).toLocaleDateString();
    const good = (await actions.shares(species)).filter(
        ({ revoked, expires_s: end }) => !revoked && end * 1000 > Date.now(),
    );
    const items = good.map((share) => {
        const revoke = actionButton("Revoke", () => void actions.revoke(species, share).then(() => again()), "", "revoke");
        revoke.hidden = !mayWrite;
        return make("li", {}, make("span", {}, `Link ${share.id}, until ${until(share)}`), revoke);
    });
    const duration = make(
        "select",
        { "aria-label": "How long the link is good" },
        ...durations.map(([label, seconds]) => make("option", { value: seconds, selected: seconds === 30 * day }, label)),
    );
    const create = actionButton(
        "Make a link for",
        () => void actions.share(species, Number(duration.value)).then((share) => again(share)),
        "",
        "make-link",
    );
    host.replaceChildren(
        make("p", { class: "hint" }, "With a link anybody sees the draft as it is then, and can change nothing."),
        make("ul", {}, ...items),
    );
    if (mayWrite) host.append(make("div", { class: "row" }, create, duration));
    if (!made?.share) return;
    const address = sharedAddress(species.id, made.share, document.baseURI);
    const field = make("input", { type: "text", class: "share-link", readonly: true, value: address, "aria-label": "The link" });
    const copy = actionButton("Copy", () => void copyText(address, "The link", copy), "", "copy-link");
    host.append(make("div", { class: "row" }, field, copy), make("p", { class: "hint" }, "It is shown this once."));
    field.focus();
    field.select();
}
