// Renders two files alike and sets window.difference to the mean colour difference (CIE 1976 ΔE)
// of the pixels that either covers, the share that differs visibly, and the draw calls of both.
// Bundled and run by clients.test.mjs.
//
//   ?server=...&first=mushrooms/x.glb&second=mushrooms/x.glb%3Fcompress=meshopt
//   ?server=...&first={"species":[...]}&second={"species":[...],"atlas":"set"}&distance=8
//
// A body of POST /v1/sets.glb is shown by a Field. The distance of the camera is in radii of what is
// shown; 4 fills the picture.
import { Box3, Matrix4, Vector3 } from "three";
import { Field, Sporeprint, prototypesOf } from "../../web_viewer/clients/three/index.ts";
import { differenceOf, picture, pictureRenderer } from "./compare.mjs";

/** Returns a model; of a set, with its bounds and what is to be called before it is drawn. */
async function shown(sporeprint, what) {
    if (!what.startsWith("{")) return { object: (await sporeprint.load(what)).scene };
    const prototypes = await prototypesOf(await sporeprint.loadSet(JSON.parse(what)));
    const sizes = prototypes.map(({ bounds }) => bounds.getSize(new Vector3()));
    const step = Math.max(...sizes.flatMap(({ x, y, z }) => [x, y, z]));
    const columns = Math.ceil(Math.sqrt(prototypes.length));
    const bounds = new Box3();
    // As large as each other, in rows above each other.
    const placements = prototypes.map(({ bounds: own }, i) => {
        const scale = step / Math.max(...sizes[i].toArray());
        const matrix = new Matrix4()
            .makeTranslation(1.1 * step * (i % columns), 1.1 * step * Math.floor(i / columns), 0)
            .scale(new Vector3().setScalar(scale));
        bounds.union(own.clone().applyMatrix4(matrix));
        return { prototype: i, matrix };
    });
    const object = new Field(prototypes, placements);
    return { object, bounds, update: (camera) => object.update(camera) };
}

async function difference() {
    const query = new URLSearchParams(location.search);
    const renderer = pictureRenderer();
    const sporeprint = new Sporeprint(query.get("server"));
    const distance = Number(query.get("distance") ?? 4);
    const pictures = [];
    for (const name of ["first", "second"]) {
        const { object, ...view } = await shown(sporeprint, query.get(name));
        pictures.push(picture(renderer, object, { ...view, distance }));
    }
    return differenceOf(...pictures);
}

difference().then(
    (result) => (window.difference = result),
    (error) => (window.difference = { error: String(error) }),
);
