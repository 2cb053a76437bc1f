// The panel of reasons: for each species what keeps it from fruiting at a place on a day, and the mushroom that was
// clicked with its address.
import { byId, make } from "../dom";
import { copy } from "../file_actions";
import { asRequestFailed, getJson, type RequestFailed } from "../http";
import { words } from "../schema";
import { viewerAddress, type FruitBodyFacts } from "./plot_view";
import { short } from "./view_address";

/** What keeps a species from fruiting, as limits.json describes it. */
export interface SpeciesLimits {
    id: string;
    possible: boolean;
    limiting: string;
    share: number;
    why: string;
}

interface PlaceLimits {
    place_m: [number, number, number];
    site: { light: number; wetness_in_autumn: number; wetness_today: number; acidity: number };
    species: SpeciesLimits[];
}

/** Returns species in the order of the panel: those that fruit best first, and after them those that come nearest. */
export function byShare(species: readonly SpeciesLimits[], nameOf: (id: string) => string): SpeciesLimits[] {
    return [...species].sort((a, b) => b.share - a.share || nameOf(a.id).localeCompare(nameOf(b.id)));
}

/** Returns in a word how far a species can fruit. */
export function verdict({ share, possible }: SpeciesLimits): string {
    if (!possible) return "no";
    return share >= 0.995 ? "yes" : share >= 0.4 ? "partly" : "hardly";
}

export class WhyPanel {
    private readonly list = byId("why-list");
    private readonly title = byId("why-place");
    private readonly site = byId("why-site");
    private readonly card = byId("body-card");
    private loading: AbortController | undefined;
    private shown = "";

    constructor(
        private readonly nameOf: (id: string) => string,
        private readonly failed: (failure: RequestFailed) => void,
    ) {}

    /** Shows why species fruit or do not fruit at a place. */
    async show(world: string, time: string, [x, y]: readonly [number, number]): Promise<void> {
        const address = `v1/worlds/${world}/${time}/limits.json?x=${x}&y=${y}`;
        if (address === this.shown) return;
        this.loading?.abort();
        const loading = new AbortController();
        this.loading = loading;
        this.shown = address;
        byId("why").setAttribute("aria-busy", "true");
        try {
            this.write(await getJson<PlaceLimits>(address, loading.signal));
        } catch (error) {
            if (loading.signal.aborted) return;
            this.shown = "";
            this.failed(asRequestFailed(error, "The reasons cannot be found"));
        }
        byId("why").setAttribute("aria-busy", "false");
    }

    clear(): void {
        this.loading?.abort();
        this.shown = "";
        this.showBody(undefined);
        this.list.replaceChildren();
        this.title.textContent = "Click the ground or a mushroom.";
        this.site.textContent = "";
    }

    /** Shows a mushroom that was clicked; undefined for none. */
    showBody(body: FruitBodyFacts | undefined): void {
        this.card.hidden = !body;
        if (!body) return;
        const days = body.days_old < 1 ? "less than a day old" : `${Math.round(body.days_old)} days old`;
        const address = viewerAddress(body.model);
        const link = address ? make("a", { href: address, id: "body-link" }, "Open in the viewer") : undefined;
        const button = make("button", { type: "button" }, "Copy its URL");
        button.addEventListener("click", () => void copy(new URL(body.model, location.href).href, "URL"));
        this.card.replaceChildren(
            make("b", {}, this.nameOf(body.species)),
            make("span", {}, `${days}, age ${short(body.age)}`),
            make("code", { class: "address" }, body.model),
            make("span", { class: "row" }, link, button),
        );
    }

    private write({ place_m: [x, y, height], site, species }: PlaceLimits): void {
        this.title.textContent = `x ${short(x)} m, y ${short(y)} m, ground at ${short(height, 1)} m`;
        const { light, wetness_today: wetness, acidity } = site;
        this.site.textContent = `Light ${short(light)}, wetness today ${short(wetness)}, acidity ${short(acidity)}`;
        this.list.replaceChildren(
            ...byShare(species, this.nameOf).map((one) => {
                const meter = make("meter", { min: 0, max: 1, value: one.share, "aria-hidden": true });
                const tag = one.limiting === "nothing" ? "nothing limits it" : words(one.limiting).toLowerCase();
                return make(
                    "li",
                    { "data-species": one.id, "data-verdict": verdict(one) },
                    make("b", {}, this.nameOf(one.id)),
                    make("span", { class: "tag" }, tag),
                    meter,
                    make("p", {}, one.why),
                );
            }),
        );
    }
}
