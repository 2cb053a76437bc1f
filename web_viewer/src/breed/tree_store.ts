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
        await this.write((put) => {
            for (const one of species) put("species", one);
            for (const one of couples) put("couples", one);
        });
    }

    /** Forgets everything. */
    async clear(): Promise<void> {
        await this.write(undefined);
    }

    private async write(
        act: ((put: (name: StoreName, value: Species | Couple) => void) => void) | undefined,
    ): Promise<void> {
        const base = await this.open;
        if (!base) return;
        await new Promise<void>((resolve) => {
            const transaction = base.transaction(Object.values(stores), "readwrite");
            transaction.oncomplete = transaction.onabort = transaction.onerror = () => resolve();
            if (act) act((name, value) => transaction.objectStore(name).put(value));
            else for (const name of Object.values(stores)) transaction.objectStore(name).clear();
        });
    }
}
