// What was opened in this visit, so that undo comes back to it: each step of the history names its source by number.
import { RequestFailed } from "../http";
import { announce } from "../status_line";
import { sourcesOf, type Drawing } from "./gesture";
import type { Link } from "./library_panel";
import { Photograph, type Source } from "./service";

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
    /** Photographs on their way to the service. */
    private readonly sending = new Map<number, Promise<Photograph>>();
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

    /** Returns a photograph that was opened; after a reload its file is sent once.
     *
     *  throws  RequestFailed if its file is forgotten, or if it cannot be sent */
    async photograph(number: number): Promise<Photograph> {
        const opened = this.at(number);
        if (opened?.source instanceof Photograph && !opened.source.isForgotten) return opened.source;
        if (!opened?.file)
            throw new RequestFailed("The photograph is forgotten", "choose it again, or remove it", 0);
        const { file } = opened;
        const known = this.sending.get(number);
        const sending = known ?? Photograph.upload(file, new AbortController().signal, announce);
        this.sending.set(number, sending);
        try {
            const photograph = await sending;
            opened.source = photograph;
            return photograph;
        } finally {
            this.sending.delete(number);
        }
    }

    /** Returns the address of the picture of a photograph; fails as photograph() does. */
    async address(number: number): Promise<string> {
        const photograph = await this.photograph(number);
        const known = this.at(number)?.address;
        if (known) return known;
        const address = URL.createObjectURL(await photograph.picture(new AbortController().signal));
        const opened = this.at(number);
        if (opened) opened.address ??= address;
        return opened?.address ?? address;
    }

    /** Forgets photographs, here and at the service; what was made of them stays. */
    forget(numbers: Iterable<number>): void {
        for (const number of numbers) {
            const opened = this.at(number);
            if (!opened || (opened.source && !(opened.source instanceof Photograph))) continue;
            opened.source?.forget();
            if (opened.address) URL.revokeObjectURL(opened.address);
            opened.file = opened.address = undefined;
        }
    }

    /** Drops what no step names any more. */
    prune(steps: readonly Drawing[]): void {
        const named = new Set(steps.flatMap(sourcesOf));
        for (const [number, { address }] of this.opened) {
            if (named.has(number)) continue;
            if (address) URL.revokeObjectURL(address);
            this.opened.delete(number);
        }
    }

    /** Returns the files that steps name, by number. */
    files(steps: readonly Drawing[]): Map<number, Blob> {
        const files = new Map<number, Blob>();
        for (const number of steps.flatMap(sourcesOf)) {
            const file = this.at(number)?.file;
            if (file) files.set(number, file);
        }
        return files;
    }
}
