// The family tree on the page: a row for each couple, lines from parents to children, chosen by pointer or keyboard.
import { draw, make } from "../dom";
import { isAddressable, type Couple, type Pedigree } from "./pedigree";
import { treeRows, type TreeRow } from "./tree_rows";

/** Height of a row and width of a lane, pixels; app styles use the same. */
const rowHeight = 76;
const laneWidth = 34;
const middle = 36;

/** Returns the address of a small picture of a species; undefined if there is none yet. */
export function pictureOf(pedigree: Pedigree, key: string): string | undefined {
    const { picture } = pedigree.get(key);
    if (picture) return picture;
    return isAddressable(key) ? `v1/mushrooms/${key}.png?width=128&height=128&view=three_quarter` : undefined;
}

export function pictureElement(pedigree: Pedigree, key: string, className: string): HTMLElement {
    const address = pictureOf(pedigree, key);
    return address
        ? make("img", { src: address, alt: "", class: className, width: 64, height: 64 })
        : make("span", { class: `${className} none` });
}

export class FamilyTree {
    private rows: TreeRow[] = [];
    private items: HTMLElement[] = [];

    constructor(
        private readonly host: HTMLElement,
        private readonly pedigree: Pedigree,
        private readonly chosen: (couple: Couple) => void,
        private readonly removed: (couple: Couple) => void,
    ) {
        host.addEventListener("keydown", (event) => this.key(event));
    }

    show(current: string | undefined): void {
        const focused = this.items.findIndex((item) => item === document.activeElement);
        const focusedKey = this.rows[focused]?.couple.key;
        this.rows = treeRows(this.pedigree);
        this.items = this.rows.map((row) => this.item(row, row.couple.key === current));
        const lanes = 1 + Math.max(0, ...this.rows.map(({ lane }) => lane));
        this.host.style.setProperty("--lanes", String(lanes));
        this.host.replaceChildren(this.lines(lanes), ...this.items);
        const at = this.rows.findIndex(({ couple }) => couple.key === (focusedKey ?? current));
        this.rove(Math.max(0, at));
        if (focused >= 0) this.items[at]?.focus();
        const shown = this.rows.findIndex(({ couple }) => couple.key === current);
        this.reveal(this.items[shown]);
    }

    /** Scrolls the tree only, never the page. */
    private reveal(item: HTMLElement | undefined): void {
        const frame = this.host.parentElement;
        if (!item || !frame || frame.scrollHeight <= frame.clientHeight) return;
        const top = item.offsetTop;
        const least = top + item.offsetHeight - frame.clientHeight + 12;
        frame.scrollTop = Math.min(Math.max(frame.scrollTop, least), Math.max(0, top - 12));
    }

    private item({ couple, lane, from, level }: TreeRow, isCurrent: boolean): HTMLElement {
        const { pedigree } = this;
        const child = pedigree.childOf(couple);
        const birth = pedigree.get(child).birth;
        const mate = couple.a === child ? couple.b : couple.a;
        const withMate = mate === child ? "" : `with ${pedigree.name(mate)}`;
        const parents = birth ? pedigree.descent(birth) : "founders";
        const genes = birth?.genes;
        const title = birth ? pedigree.name(child) : pedigree.coupleName(couple);
        const pictures = make("span", { class: "pictures" }, pictureElement(pedigree, child, "picture"));
        if (mate !== child) pictures.append(pictureElement(pedigree, mate, "picture mate"));
        const words = make("span", { class: "words" }, make("b", {}, title), make("span", {}, parents));
        if (genes) {
            const text = [`seed ${genes.seed}`, withMate].filter(Boolean).join(" · ");
            words.append(make("span", { class: "genes" }, text));
        }
        const item = make(
            "li",
            {
                class: "row-of-tree",
                role: "treeitem",
                tabindex: -1,
                "data-couple": couple.key,
                "aria-level": level,
                "aria-selected": isCurrent,
                "aria-label": genes
                    ? [title, `seed ${genes.seed}`, parents, withMate].filter(Boolean).join(", ")
                    : `${title}, founders`,
                "aria-current": isCurrent ? "true" : undefined,
            },
            pictures,
            words,
        );
        item.style.setProperty("--lane", String(lane));
        if (from === undefined) item.classList.add("founders");
        item.addEventListener("click", () => this.chosen(couple));
        return item;
    }

    private lines(lanes: number): SVGSVGElement {
        const height = this.rows.length * rowHeight;
        const x = (lane: number): number => middle + lane * laneWidth;
        const y = (row: number): number => row * rowHeight + rowHeight / 2;
        const paths = this.rows.flatMap(({ row, lane, from }) => {
            const parent = from === undefined ? undefined : this.rows[from];
            if (!parent) return [];
            const [x0, y0, x1, y1] = [x(parent.lane), y(parent.row), x(lane), y(row)];
            const bend = Math.min(22, y1 - y0);
            const d =
                x0 === x1
                    ? `M${x0} ${y0}V${y1}`
                    : `M${x0} ${y0}V${y0 + bend}C${x0} ${y0 + bend + 18} ${x1} ${y0 + bend} ${x1} ${y0 + bend + 26}V${y1}`;
            return [draw("path", { d })];
        });
        return draw("svg", { class: "lines", width: middle * 2 + lanes * laneWidth, height, "aria-hidden": true }, ...paths);
    }

    private rove(index: number): void {
        this.items.forEach((item, at) => (item.tabIndex = at === index ? 0 : -1));
    }

    private key(event: KeyboardEvent): void {
        const at = this.items.indexOf(document.activeElement as HTMLElement);
        const row = this.rows[at];
        if (!row) return;
        const child = this.rows.findIndex(({ from }) => from === at);
        const places: Record<string, number> = {
            ArrowUp: at - 1,
            ArrowDown: at + 1,
            ArrowLeft: row.from ?? -1,
            ArrowRight: child,
            Home: 0,
            End: this.items.length - 1,
        };
        if (event.key === "Enter" || event.key === " ") this.chosen(row.couple);
        else if (event.key === "Delete") this.removed(row.couple);
        else if (event.key in places) {
            const item = this.items[places[event.key]!];
            if (!item) return event.preventDefault();
            this.rove(places[event.key]!);
            item.focus();
        } else return;
        event.preventDefault();
    }
}
