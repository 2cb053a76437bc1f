// What the browser stores of the library: the token of who is signed in, and the draft that is worked on.
const tokenKey = "sporeprint-token";
const linkKey = "sporeprint-library-draft";

/** A draft in the library that the draft of this browser belongs to. */
export interface StoredLink {
    id: string;
    name: string;
    etag: string;
}

/** Returns what the address of the page has as a token, which may be none, and takes it out: the address is in the
 *  history of the browser. */
export function takeTokenOfAddress(): string | undefined {
    const given = /^#token=(.*)$/.exec(location.hash)?.[1];
    if (given !== undefined) history.replaceState(null, "", location.pathname + location.search);
    return given;
}

/** Returns the token of this visit, or else the one that stays. */
export function storedToken(): { token: string; stays: boolean } | undefined {
    const ofVisit = sessionStorage.getItem(tokenKey), staying = localStorage.getItem(tokenKey);
    const token = ofVisit ?? staying;
    return token === null ? undefined : { token, stays: token === staying };
}

/** Stores a token until the window is closed, or for all visits. */
export function storeToken(token: string, stays: boolean): void {
    (stays ? localStorage : sessionStorage).setItem(tokenKey, token);
}

export function forgetToken(): void {
    sessionStorage.removeItem(tokenKey);
    localStorage.removeItem(tokenKey);
}

export function storedLink(): StoredLink | undefined {
    const stored = localStorage.getItem(linkKey);
    return stored ? (JSON.parse(stored) as StoredLink) : undefined;
}

/** Stores which draft is worked on; undefined for none. */
export function storeLink(link: StoredLink | undefined): void {
    if (link) {
        const { id, name, etag } = link;
        localStorage.setItem(linkKey, JSON.stringify({ id, name, etag }));
    } else localStorage.removeItem(linkKey);
}
