// The family tree in the browser's own database: species and couples by their keys, so that two windows add to one
// tree. Without a database, as in some private windows, the tree ends with the page.
import { openDatabase } from "../browser_database";
import type { Couple, Species } from "./pedigree";

const stores = { species: "species", couples: "couples" } as const;
type StoreName = keyof typeof stores;

export class TreeStore {
    private readonly open = openDatabase("sporeprint-breeding", (base) => {
        for (const name of Object.values(stores)) base.createObjectStore(name, { keyPath: "key" });
    }).catch(() => undefined);

    async load(): Promise<{ species: Species[]; couples: Couple[] }> {
        const base = await this.open;
        if (!base) return { species: [], couples: [] };
        const all = <T>(name: StoreName): Promise<T[]> =>
            new Promise((resolve) => {
                const request = base.transaction(name).objectStore(name).getAll();
                request.onsuccess = () => resolve(request.result as T[]);
                request.onerror = () => resolve([]);
            });
        const [species, couples] = await Promise.all([all<Species>("species"), all<Couple>("couples")]);
        return { species, couples };
    }

    /** Stores what is new or was changed. */
    async save(species: readonly Species[], couples: readonly Couple[]): Promise<void> {
        await this.write((of) => {
            for (const one of species) of("species").put(one);
            for (const one of couples) of("couples").put(one);
        });
    }

    /** Forgets what has these keys. */
    async remove(species: readonly string[], couples: readonly string[]): Promise<void> {
        await this.write((of) => {
            for (const key of species) of("species").delete(key);
            for (const key of couples) of("couples").delete(key);
        });
    }

    /** Forgets everything. */
    async clear(): Promise<void> {
        await this.write((of) => {
            for (const name of Object.values(stores)) of(name).clear();
        });
    }

    private async write(act: (of: (name: StoreName) => IDBObjectStore) => void): Promise<void> {
        const base = await this.open;
        if (!base) return;
        await new Promise<void>((resolve) => {
            const transaction = base.transaction(Object.values(stores), "readwrite");
            transaction.oncomplete = transaction.onabort = transaction.onerror = () => resolve();
            act((name) => transaction.objectStore(name));
        });
    }
}
