// The draft that survives a reload: the files that were opened and what was drawn on them, in the
// browser's own database. Without one, as in some private windows, there is no draft.
import { openDatabase } from "../browser_database";
import { capSides, type Drawing } from "./gesture";

export interface Draft {
    drawing: Drawing;
    /** Drawings before and after it, the nearest last. */
    past: readonly Drawing[];
    future: readonly Drawing[];
    /** What the drawings name by number. */
    files: ReadonlyMap<number, Blob>;
}

/** As it is stored; each file has an entry of its own, which is written once. */
interface StoredDraft extends Partial<Draft> {
    drawing: Drawing;
    numbers?: readonly number[];
    /** The only one, of drafts of earlier versions of the page. */
    file?: Blob;
}

const store = "drafts";
const key = "current";
const keyOf = (number: number): string => `file ${number}`;

/** Files that this visit has stored. */
let written = new Map<number, Blob>();

async function act<T>(
    mode: IDBTransactionMode,
    request: (objects: IDBObjectStore) => IDBRequest<T>,
): Promise<T | undefined> {
    try {
        const open = await openDatabase("sporeprint-designer", (base) => base.createObjectStore(store));
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

/** Returns a drawing without photographs of the cap whose file is lost. */
function withFound(drawing: Drawing, files: ReadonlyMap<number, Blob>): Drawing {
    const { views } = drawing;
    if (!views) return drawing;
    const found = capSides.flatMap((side) => {
        const view = views[side];
        return view && files.has(view.source) ? [[side, view] as const] : [];
    });
    return { ...drawing, views: found.length > 0 ? Object.fromEntries(found) : undefined };
}

/** Returns the draft without steps whose file is lost. */
export async function loadDraft(): Promise<Draft | undefined> {
    const stored = await act(
        "readonly",
        (objects) => objects.get(key) as IDBRequest<StoredDraft | undefined>,
    );
    if (!stored) return undefined;
    const files = new Map<number, Blob>();
    for (const number of stored.numbers ?? []) {
        const file = await act(
            "readonly",
            (objects) => objects.get(keyOf(number)) as IDBRequest<Blob | undefined>,
        );
        if (file) files.set(number, file);
    }
    written = new Map(files);
    if (stored.file) files.set(1, stored.file);
    const numbered = (drawing: Drawing): Drawing =>
        withFound(stored.file ? { ...drawing, source: 1 } : drawing, files);
    const has = ({ source }: Drawing): boolean => source !== undefined && files.has(source);
    const drawing = numbered(stored.drawing);
    if (!has(drawing)) return undefined;
    const [past, future] = [stored.past, stored.future].map((steps) =>
        (steps ?? []).map(numbered).filter(has),
    );
    return { drawing, past: past ?? [], future: future ?? [], files };
}

export async function saveDraft({ files, ...steps }: Draft): Promise<void> {
    const done = await act("readwrite", (objects) => {
        for (const [number, file] of files)
            if (written.get(number) !== file) objects.put(file, keyOf(number));
        for (const number of written.keys())
            if (!files.has(number)) objects.delete(keyOf(number));
        return objects.put({ ...steps, numbers: [...files.keys()] }, key);
    });
    if (done !== undefined) written = new Map(files);
}

export async function forgetDraft(): Promise<void> {
    written = new Map();
    await act("readwrite", (objects) => objects.clear());
}
