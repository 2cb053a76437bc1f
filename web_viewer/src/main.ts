// Entry point: fetches the schema and the list of the product that the URL names, and puts the page
// together.
import "./app.css";
import "./export.css";
import { byId } from "./dom";
import { asRequestFailed, getJson } from "./http";
import { namedSpecies } from "./gallery_library";
import { ModeLinks } from "./mode_links";
import { Page } from "./page";
import { ProblemBox } from "./problem_box";
import { mushrooms, productOf, type Product } from "./products";
import { words, type Schema } from "./schema";
import { Stage } from "./stage";
import { announce } from "./status_line";
import { installTestHandle } from "./test_handle";

/** Replaces the words of index.html that speak of mushrooms and their species. */
function nameProduct(product: Product): void {
    const canvas = byId("canvas");
    const label = canvas.getAttribute("aria-label") ?? "";
    canvas.setAttribute("aria-label", label.replace("mushroom", product.noun));
    if (product === mushrooms) return;
    byId("sheets").hidden = true;
    if (product.ofSpecies) return;
    byId<HTMLInputElement>("find").placeholder = "Name…";
    byId("gallery").parentElement?.setAttribute("aria-label", words(product.queryName));
    byId("find").setAttribute("aria-label", `Find a ${product.noun}`);
}

/** Finds the species of the library that the page's query names, and completes the query with their versions. */
async function named(product: Product, query: URLSearchParams): ReturnType<typeof namedSpecies> {
    const name = product.canMorph && query.has("morph") ? "morph" : product.queryName;
    const found = await namedSpecies(product.ofSpecies ? (query.get(name) ?? "") : "");
    if (found.species.length > 0 && found.text !== query.get(name)) {
        query.set(name, found.text);
        const readable = query.toString().replace(/%(7E|40|3A|2C)/g, decodeURIComponent);
        history.replaceState(null, "", `?${readable}`);
    }
    return found;
}

async function open(): Promise<void> {
    const query = new URLSearchParams(location.search);
    const shot = query.get("shot") === "1";
    const reducedMotion = shot || matchMedia("(prefers-reduced-motion: reduce)").matches;
    document.documentElement.classList.toggle("shot", shot);
    const product = productOf(query);
    nameProduct(product);
    const links = new ModeLinks(product);
    const [schema, species, ofLibrary] = await Promise.all([
        getJson<Schema>(`${product.path}/schema`),
        product.list(),
        named(product, query),
    ]);
    species.push(...ofLibrary.species);
    const { closeUps, directions, liesOnGround: lies } = product;
    const stage = new Stage(byId("stage"), byId<HTMLCanvasElement>("canvas"), {
        reducedMotion: reducedMotion,
        withoutMargins: shot,
        directions,
        closeUps,
        liesOnGround: lies,
    });
    const page = new Page(
        { stage, links, product, schema, species, refused: ofLibrary.refused },
        { reducedMotion, withoutPictures: shot },
    );
    installTestHandle(page, stage);
}

open().catch((error: unknown) => {
    const failed = asRequestFailed(error, "This page cannot start");
    new ProblemBox().show(failed, () => location.reload());
    announce(failed.message);
});
