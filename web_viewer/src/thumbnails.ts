// Takes the gallery's pictures: small models, one after the other, on one renderer off the page.
// They are kept in Cache Storage under the model's ETag, so that a second visit draws nothing.
import type { Directions } from "./camera";
import type { Species } from "./gallery";
import { getModel, send, type Answer } from "./http";
import { disposeModel, parseModel } from "./model";
import { mushrooms } from "./products";
import type { Settings } from "./settings";
import { Studio } from "./studio";

const cacheName = "sporeprint-thumbnails-1";
const pixels = 192;

/** Cache Storage is there on https and on this machine only; without it pictures are just drawn again. */
async function openCache(): Promise<Cache | undefined> {
    if (!("caches" in window)) return undefined;
    try {
        return await caches.open(cacheName);
    } catch {
        return undefined;
    }
}

/** What tells one version of a model from another: its ETag, or else its canonical URL with `v`. */
function versionOf(response: Response): string | undefined {
    return response.headers.get("etag") ?? response.headers.get("content-location") ?? undefined;
}

function keyOf(id: string, version: string): string {
    return `thumbnails/${id}?version=${encodeURIComponent(version)}`;
}

async function keep(cache: Cache, id: string, version: string, picture: Blob): Promise<void> {
    const { pathname } = new URL(keyOf(id, version), location.href);
    for (const old of await cache.keys()) {
        if (new URL(old.url).pathname === pathname) await cache.delete(old);
    }
    await cache.put(
        keyOf(id, version),
        new Response(picture, { headers: { "Content-Type": picture.type } }),
    );
}

async function photograph(
    studio: Studio,
    { bytes, response }: Answer,
    directions: Directions,
): Promise<Blob> {
    const model = await parseModel(bytes, response.url);
    const canvas = studio.photograph(model, {
        view: "three-quarter",
        directions,
        margin: { x: 0.08, y: 0.08 },
    });
    const picture = await new Promise<Blob>((resolve, reject) => {
        canvas.toBlob(
            (blob) => (blob ? resolve(blob) : reject(new Error("no picture"))),
            "image/webp",
            0.9,
        );
    });
    disposeModel(model);
    return picture;
}

/** Returns the small models whose pictures the gallery shows. */
export function galleryModels(
    settings: Settings,
    species: readonly Species[],
): { id: string; address: string }[] {
    const lod = settings.field("lod");
    const size = settings.field("texture_size")?.options.find((side) => Number(side) >= 256);
    const query = [
        ...(lod ? [`lod=${Math.min(2, lod.max ?? 0)}`] : []),
        ...(size !== undefined ? [`texture_size=${size}`] : []),
    ].join("&");
    // A product made of species shows one mushroom of each.
    const path = settings.product.ofSpecies ? mushrooms.path : settings.product.path;
    return species.map(({ id }) => ({
        id,
        address: `${path}/${id}.glb${query ? `?${query}` : ""}`,
    }));
}

/** Makes or finds the picture of each model in turn; `done` gets an address for an <img>. */
export async function makeThumbnails(
    models: readonly { id: string; address: string }[],
    directions: Directions,
    done: (id: string, picture: string) => void,
    signal: AbortSignal,
): Promise<void> {
    const cache = await openCache();
    let studio: Studio | undefined;
    try {
        for (const { id, address } of models) {
            if (signal.aborted) return;
            try {
                const head =
                    cache &&
                    (await send(address, { method: "HEAD", signal }).catch(() => undefined));
                const known = head && versionOf(head);
                const kept = known ? await cache?.match(keyOf(id, known)) : undefined;
                if (kept) {
                    done(id, URL.createObjectURL(await kept.blob()));
                    continue;
                }
                const answer = await getModel({ address }, signal);
                studio ??= new Studio(pixels);
                const picture = await photograph(studio, answer, directions);
                done(id, URL.createObjectURL(picture));
                const version = versionOf(answer.response);
                if (cache && version) await keep(cache, id, version, picture);
            } catch {
                // A picture that could not be made leaves its place empty; the species still opens.
            }
        }
    } finally {
        studio?.dispose();
    }
}
