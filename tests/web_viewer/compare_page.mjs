// Renders two files alike and sets window.difference to the mean colour difference (CIE 1976 ΔE)
// of the pixels that either covers. Bundled and run by clients.test.mjs.
//
//   ?server=...&first=mushrooms/x.glb&second=mushrooms/x.glb%3Fcompress=meshopt
import { Sporeprint } from "../../web_viewer/clients/three/index.ts";
import { differenceOf, picture, pictureRenderer } from "./compare.mjs";

async function difference() {
    const query = new URLSearchParams(location.search);
    const renderer = pictureRenderer();
    const sporeprint = new Sporeprint(query.get("server"));
    const { scene: first } = await sporeprint.load(query.get("first"));
    const { scene: second } = await sporeprint.load(query.get("second"));
    return differenceOf(picture(renderer, first), picture(renderer, second));
}

difference().then(
    (result) => (window.difference = result),
    (error) => (window.difference = { error: String(error) }),
);
