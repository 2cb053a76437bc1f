// What was opened in this visit, so that undo comes back to it: each step of the history names its source by number.
import type { Drawing } from "./gesture";
import type { Link } from "./library_panel";
import type { Source } from "./service";

export interface Opened {
    /** Undefined once it was forgotten. */
    file: Blob | undefined;
    /** Undefined until it is opened again after a reload. */
    source?: Source | undefined;
    /** Address of its picture. */
    address?: string | undefined;
    /** Its draft in the library, while something else is worked on. */
    link?: Link | undefined;
}

export class Sources {
    private readonly opened = new Map<number, Opened>();
    private last = 0;

    add(opened: Opened): number {
        this.opened.set(++this.last, opened);
        return this.last;
    }

    /** Takes over what an earlier visit has numbered. */
    restore(files: ReadonlyMap<number, Blob>): void {
        for (const [number, file] of files) {
            this.opened.set(number, { file });
            this.last = Math.max(this.last, number);
        }
    }

    at(number: number | undefined): Opened | undefined {
        return number === undefined ? undefined : this.opened.get(number);
    }

    /** Drops what no step names any more. */
    prune(steps: readonly Drawing[]): void {
        const named = new Set(steps.map(({ source }) => source));
        for (const [number, { address }] of this.opened) {
            if (named.has(number)) continue;
            if (address) URL.revokeObjectURL(address);
            this.opened.delete(number);
        }
    }

    /** Returns the files that steps name, by number. */
    files(steps: readonly Drawing[]): Map<number, Blob> {
        const files = new Map<number, Blob>();
        for (const { source } of steps) {
            const file = this.at(source)?.file;
            if (source !== undefined && file) files.set(source, file);
        }
        return files;
    }
}
