// What tests and tools read of the page: `window.breeding`.
import type { Breeder, Timings } from "./breeder";
import type { Genes } from "./pedigree";

export interface BreedingHandle {
    /** The nine children that are shown, with a hash of each file. */
    children: () => { genes: Genes; hash: string }[];
    readonly timings: Timings | undefined;
}

declare global {
    interface Window {
        breeding: BreedingHandle;
    }
}

/** Returns a hash of bytes: 64 bits as hexadecimal digits, by FNV-1a. */
function hashOfBytes(bytes: Uint8Array): string {
    let hash = 0xcbf29ce484222325n;
    for (const byte of bytes) hash = BigInt.asUintN(64, (hash ^ BigInt(byte)) * 0x100000001b3n);
    return hash.toString(16).padStart(16, "0");
}

export function installHandle(breeder: Breeder): void {
    window.breeding = {
        children: () =>
            breeder.children.map(({ birth, bytes }) => ({
                genes: birth.genes,
                hash: bytes ? hashOfBytes(new Uint8Array(bytes)) : "",
            })),
        get timings() {
            return breeder.timings;
        },
    };
}
