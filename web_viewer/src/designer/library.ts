// The library of the service: the user's species, as drafts and as published versions.
import { send } from "../http";
import { pageQuery, type LibraryPage, type LibrarySpecies } from "../library_list";
import type { Species } from "./service";

export interface Quota {
    owner: string;
    scope: "read" | "write" | "admin";
    species: number;
    max_species: number;
    bytes: number;
    max_bytes: number;
}

/** A species after writes. */
export interface StoredSpecies extends LibrarySpecies {
    /** Entity tag of the draft. */
    draft?: string;
}

/** A key with which a draft can be read. */
export interface Share {
    id: string;
    created_s: number;
    expires_s: number;
    revoked: boolean;
    /** The secret, of a new one alone. */
    share?: string;
}

/** A draft as it was read, and its entity tag. */
export interface Draft {
    text: string;
    etag: string;
}

/** Names of species in the library, as the service allows them. */
export const namePattern = "[a-z][a-z0-9_]{0,23}";

/** Returns a name that the library allows and that resembles a text. */
export function nameLike(text: string): string {
    const name = text
        .normalize("NFKD")
        .replace(/\p{M}/gu, "")
        .toLowerCase()
        .replace(/[^a-z0-9]+/g, "_")
        .replace(/^[_0-9]+/, "")
        .slice(0, 24)
        .replace(/_+$/, "");
    return name || "my_mushroom";
}

/** Returns the token in a text, such as the fragment "#token=spk_..." or a whole address, if it has one. */
export function tokenIn(text: string): string | undefined {
    return /(?:^|#token=)(spk_[a-z0-9]{8}_[\w-]{43})$/.exec(text.trim())?.[1];
}

/** What the holder of a token can do. */
export class Library {
    constructor(private readonly token: string) {}

    quota(): Promise<Quota> {
        return this.json<Quota>("v1/library/quota");
    }

    /** Returns all species of the owner, drafts too. */
    async mine(): Promise<LibrarySpecies[]> {
        const all: LibrarySpecies[] = [];
        for (let after: string | null = ""; after !== null; ) {
            const page: LibraryPage = await this.ownPage({ after, limit: 100 });
            all.push(...page.species);
            after = page.next;
        }
        return all;
    }

    /** Returns a page of the owner's species, drafts and unlisted ones too. */
    ownPage(wanted: { q?: string; after?: string; limit?: number }): Promise<LibraryPage> {
        return this.json(`v1/library?mine=true&${pageQuery(wanted)}`);
    }

    async draft(id: string): Promise<Draft> {
        const response = await this.send(`v1/library/${id}`);
        return { text: await response.text(), etag: response.headers.get("etag") ?? "" };
    }

    /** Stores a species under its id: a new one, or in place of the draft with this entity tag.
     *
     *  throws  RequestFailed with status 412 if the draft is another one by now, 409 if a new name
     *          is taken */
    async save(species: Species, owner: string, etag: string | undefined): Promise<StoredSpecies> {
        const body = JSON.stringify(species);
        return etag === undefined
            ? this.json("v1/library", { method: "POST", body })
            : this.json(`v1/library/~${owner}.${species.id}`, { method: "PUT", body }, etag);
    }

    /** Publishes the draft with this entity tag as the next version. */
    publish(id: string, etag: string, note: string): Promise<StoredSpecies> {
        const body = JSON.stringify({ note });
        return this.json(`v1/library/${id}/publish`, { method: "POST", body }, etag);
    }

    /** Takes a species out of lists; its published addresses go on. */
    async unlist(id: string): Promise<void> {
        await this.send(`v1/library/${id}`, { method: "DELETE" }, "*");
    }

    /** Deletes a species with all its versions. */
    async purge(id: string): Promise<void> {
        await this.send(`v1/library/${id}?purge=true`, { method: "DELETE" }, "*");
    }

    async shares(id: string): Promise<Share[]> {
        return (await this.json<{ shares: Share[] }>(`v1/library/${id}/shares`)).shares;
    }

    /** Makes a key that is good for so many seconds. */
    share(id: string, seconds: number): Promise<Share> {
        const body = JSON.stringify({ expires_s: seconds });
        return this.json(`v1/library/${id}/shares`, { method: "POST", body });
    }

    async revoke(id: string, share: string): Promise<void> {
        await this.send(`v1/library/${id}/shares/${share}`, { method: "DELETE" });
    }

    /** Returns a species with all its versions, for import(). */
    async exported(id: string): Promise<Blob> {
        return (await this.send(`v1/library/${id}/export.json`)).blob();
    }

    /** Stores what exported() has returned, here or at another service. */
    import(file: Blob): Promise<{ id: string; newest: number }> {
        return this.json("v1/library/import", { method: "POST", body: file });
    }

    private async json<T>(path: string, init: RequestInit = {}, etag?: string): Promise<T> {
        return (await (await this.send(path, init, etag)).json()) as T;
    }

    private send(path: string, init: RequestInit = {}, etag?: string): Promise<Response> {
        const headers: Record<string, string> = { Authorization: `Bearer ${this.token}` };
        if (init.body) headers["Content-Type"] = "application/json";
        if (etag !== undefined) headers["If-Match"] = etag;
        return send(path, { ...init, headers });
    }
}

