// The draft that survives a reload: the file of the photograph and what was drawn on it, in the
// browser's own database. Without one, as in some private windows, there is no draft.
import type { Drawing } from "./gesture";

export interface Draft {
    file: Blob;
    drawing: Drawing;
    /** Drawings before and after it, the nearest last. */
    past?: readonly Drawing[];
    future?: readonly Drawing[];
}

const store = "drafts";
const key = "current";

function database(): Promise<IDBDatabase> {
    return new Promise((resolve, reject) => {
        const opening = indexedDB.open("sporeprint-designer", 1);
        opening.onupgradeneeded = () => opening.result.createObjectStore(store);
        opening.onsuccess = () => resolve(opening.result);
        opening.onerror = () => reject(opening.error ?? new Error("no database"));
    });
}

async function act<T>(
    mode: IDBTransactionMode,
    request: (objects: IDBObjectStore) => IDBRequest<T>,
): Promise<T | undefined> {
    try {
        const open = await database();
        return await new Promise<T>((resolve, reject) => {
            const transaction = open.transaction(store, mode);
            const made = request(transaction.objectStore(store));
            transaction.oncomplete = () => resolve(made.result);
            transaction.onabort = () => reject(transaction.error ?? new Error("aborted"));
        }).finally(() => open.close());
    } catch {
        return undefined;
    }
}

export async function loadDraft(): Promise<Draft | undefined> {
    return act("readonly", (objects) => objects.get(key) as IDBRequest<Draft | undefined>);
}

export async function saveDraft(draft: Draft): Promise<void> {
    await act("readwrite", (objects) => objects.put(draft, key));
}

export async function forgetDraft(): Promise<void> {
    await act("readwrite", (objects) => objects.delete(key));
}
