// The browser's own database, for what survives a reload.

/** Opens a database, or makes its stores first.
 *
 *  throws  Error where there is none, as in some private windows */
export function openDatabase(name: string, create: (base: IDBDatabase) => void): Promise<IDBDatabase> {
    return new Promise((resolve, reject) => {
        const opening = indexedDB.open(name, 1);
        opening.onupgradeneeded = () => create(opening.result);
        opening.onsuccess = () => resolve(opening.result);
        opening.onerror = () => reject(opening.error ?? new Error("no database"));
    });
}
