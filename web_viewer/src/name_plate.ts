// The name plate on the stage: names, facts and size of what is shown.
import { centimetres, length } from "./camera";
import { byId } from "./dom";
import { factLine, type Species } from "./gallery";
import { readShares } from "./mix";
import type { Product } from "./products";
import { words } from "./schema";
import type { Size } from "./stage";

/** Individuals of a colony. */
export interface ColonyCount {
    /** That there was space for. */
    made: number;
    requested: number;
}

export class NamePlate {
    constructor(
        private readonly product: Product,
        private readonly find: (id: string) => Species | undefined,
    ) {}

    /** Shows the names of a species or of all members of a mix, also as the page's title. */
    showNames(mix: string): void {
        const shares = readShares(mix) ?? [];
        const members = shares.map(({ id }) => ({ id, known: this.find(id) }));
        const common = members.map(({ id, known }) => known?.common_name ?? words(id));
        const latin = members.map(({ id, known }) => known?.scientific_name ?? words(id));
        const single = members.length === 1 ? members[0]?.known : undefined;
        const many = common.length > 2;
        const title = many ? `Morph of ${common.length} species` : common.join(" × ");
        const percentages = shares.map(
            ({ weight }, index) => `${Number((weight * 100).toFixed(1))} % ${common[index]}`,
        );
        byId("common-name").textContent = title;
        byId("scientific-name").textContent = many ? "" : latin.join(" × ");
        byId("facts").textContent = single ? factLine(single) : percentages.join(" · ");
        document.title = `${title} · Sporeprint`;
    }

    /** Shows the size of the model and, of a colony, how many individuals were made. */
    showSize({ above, width, depth }: Size, count: ColonyCount | undefined): void {
        const size = this.product.liesOnGround
            ? `${centimetres(depth, 1)} long, ${centimetres(width, 1)} wide`
            : `${length(above)} tall, ${length(Math.max(width, depth))} across`;
        const made = count ? ` · ${count.made} of ${count.requested} made` : "";
        byId("dimensions").textContent = size + made;
    }
}
