// The gallery's pictures: small models rendered one after the other, offscreen. They are stored in
// Cache Storage under the model's ETag, so that a second visit renders nothing.
import type { Directions } from "./camera";
import type { Species } from "./gallery";
import { getModel, send, type FetchedModel } from "./http";
import { disposeModel, parseModel } from "./model";
import { mushrooms } from "./products";
import type { Settings } from "./settings";
import { OffscreenRenderer } from "./offscreen_renderer";

const cacheName = "sporeprint-thumbnails-1";
const pixels = 192;

/** Opens Cache Storage, which exists on https and on localhost only; without it pictures are
 *  rendered at each visit. */
async function openCache(): Promise<Cache | undefined> {
    if (!("caches" in window)) return undefined;
    try {
        return await caches.open(cacheName);
    } catch {
        return undefined;
    }
}

/** Returns what identifies the version of a model: its ETag, or else its canonical URL with `v`. */
function versionOf(response: Response): string | undefined {
    return response.headers.get("etag") ?? response.headers.get("content-location") ?? undefined;
}

function keyOf(id: string, version: string): string {
    return `thumbnails/${id}?version=${encodeURIComponent(version)}`;
}

async function storePicture(
    cache: Cache,
    id: string,
    version: string,
    picture: Blob,
): Promise<void> {
    const { pathname } = new URL(keyOf(id, version), location.href);
    for (const old of await cache.keys()) {
        if (new URL(old.url).pathname === pathname) await cache.delete(old);
    }
    await cache.put(
        keyOf(id, version),
        new Response(picture, { headers: { "Content-Type": picture.type } }),
    );
}

async function drawPicture(
    renderer: OffscreenRenderer,
    { bytes, response }: FetchedModel,
    directions: Directions,
): Promise<Blob> {
    const model = await parseModel(bytes, response.url);
    const canvas = renderer.render(model, {
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

/** Returns the small models of the gallery's pictures. */
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
    // A product made of species shows a single mushroom of each.
    const path = settings.product.ofSpecies ? mushrooms.path : settings.product.path;
    return species.map(({ id }) => ({
        id,
        address: `${path}/${id}.glb${query ? `?${query}` : ""}`,
    }));
}

/** Renders the picture of each model, or takes it from the cache; `done` receives an address for an
 *  <img>. */
export async function makeThumbnails(
    models: readonly { id: string; address: string }[],
    directions: Directions,
    done: (id: string, picture: string) => void,
    signal: AbortSignal,
): Promise<void> {
    const cache = await openCache();
    let renderer: OffscreenRenderer | undefined;
    try {
        for (const { id, address } of models) {
            if (signal.aborted) return;
            try {
                const head =
                    cache &&
                    (await send(address, { method: "HEAD", signal }).catch(() => undefined));
                const known = head && versionOf(head);
                const stored = known ? await cache?.match(keyOf(id, known)) : undefined;
                if (stored) {
                    done(id, URL.createObjectURL(await stored.blob()));
                    continue;
                }
                const fetched = await getModel({ address }, signal);
                renderer ??= new OffscreenRenderer(pixels);
                const picture = await drawPicture(renderer, fetched, directions);
                done(id, URL.createObjectURL(picture));
                const version = versionOf(fetched.response);
                if (cache && version) await storePicture(cache, id, version, picture);
            } catch {
                // A picture that cannot be made leaves its place empty; the species can still be
                // opened.
            }
        }
    } finally {
        renderer?.dispose();
    }
}
