// The table of a tree's ramification matrix: shows the one in force; the first change makes it the
// designer's own.
import { byId, make } from "./dom";
import { grownBy, mostOrder, withShare, type Rows } from "./rows";
import type { Settings } from "./settings";

export interface MatrixEvents {
    /** A share was changed, or an order was added or removed. */
    changed: () => void;
}

export class MatrixTable {
    private readonly host = byId("matrix");
    private readonly table = make("table");
    private readonly message = make("p", {
        class: "validation-error",
        role: "alert",
        hidden: true,
    });
    private readonly more = make("button", { type: "button" }, "One order more");
    private readonly less = make("button", { type: "button" }, "One order less");
    private readonly back = make("button", { type: "button" }, "Back to the preset’s own");
    private served: Rows = [];

    constructor(
        private readonly settings: Settings,
        private readonly events: MatrixEvents,
    ) {
        this.host.hidden = false;
        this.host.append(
            make(
                "details",
                { class: "group", open: true },
                make("summary", {}, make("span", { id: "matrix-title" }, "Ramification matrix")),
                make(
                    "p",
                    { class: "about" },
                    "Row k: of the nodes of order k, how many bear a side branch of order 1, " +
                        "2 …, and at last how many fork. Each row sums to one.",
                ),
                make("div", { class: "matrix-paper" }, this.table),
                this.message,
                make("div", { class: "matrix-tools" }, this.more, this.less, this.back),
            ),
        );
        this.more.addEventListener("click", () => this.setRows(grownBy(this.rows)));
        this.less.addEventListener("click", () => this.setRows(this.rows.slice(0, -1)));
        this.back.addEventListener("click", () => this.setRows(undefined));
    }

    /** Shows the matrix of the shown tree, as the service reports it. */
    showServed(rows: Rows | undefined): void {
        if (rows) this.served = rows;
        this.show();
    }

    /** Shows a message under the table; returns false if it is about something else. */
    showError(parameter: string, detail: string): boolean {
        const place = /^\/?rows(?:[/.](\d+))?(?:[/.](\d+))?$/.exec(parameter);
        if (!place) return false;
        this.message.hidden = false;
        this.message.textContent =
            place[1] === undefined ? detail : `Order ${Number(place[1]) + 2}: ${detail}`;
        this.host.querySelector(`tr[data-row="${place[1]}"]`)?.classList.add("failed");
        return true;
    }

    clearErrors(): void {
        this.message.hidden = true;
        for (const row of this.host.querySelectorAll("tr.failed")) row.classList.remove("failed");
    }

    show(): void {
        this.clearErrors();
        const { rows } = this;
        this.back.hidden = !this.settings.rows;
        this.more.disabled = rows.length + 1 >= mostOrder;
        this.less.disabled = rows.length <= 1;
        this.host.classList.toggle("set", this.settings.rows !== undefined);
        const focused = document.activeElement?.getAttribute("data-cell");
        const head = make(
            "tr",
            {},
            make("th", { scope: "col" }, "k"),
            ...Array.from({ length: rows.length + 1 }, (_, index) =>
                make("th", { scope: "col" }, String(index + 1)),
            ),
        );
        this.table.replaceChildren(
            head,
            ...rows.map((row, index) =>
                make(
                    "tr",
                    { "data-row": index },
                    make("th", { scope: "row" }, String(index + 2)),
                    ...row.map((share, at) =>
                        make(
                            "td",
                            { class: at + 1 === row.length ? "forks" : undefined },
                            this.cell(index, at, share),
                        ),
                    ),
                ),
            ),
        );
        if (focused) this.table.querySelector<HTMLElement>(`[data-cell="${focused}"]`)?.focus();
    }

    private get rows(): Rows {
        return this.settings.rows ?? this.served;
    }

    private cell(row: number, at: number, share: number): HTMLElement {
        const forks = at === row + 1;
        const entry = make("input", {
            type: "number",
            min: 0,
            max: 1,
            step: 0.01,
            value: String(Number(share.toFixed(4))),
            "data-cell": `${row}-${at}`,
            "aria-label": forks
                ? `Order ${row + 2}: share of forks`
                : `Order ${row + 2}: share with a side branch of order ${at + 1}`,
        });
        entry.addEventListener("change", () => {
            const value = Number(entry.value);
            if (entry.value === "" || !Number.isFinite(value)) return this.show();
            this.setRows(
                this.rows.map((old, index) => (index === row ? withShare(old, at, value) : old)),
            );
        });
        return entry;
    }

    private setRows(rows: Rows | undefined): void {
        this.settings.rows = rows;
        if (rows)
            for (const name of ["matrix", "blend", "order"]) this.settings.set(name, undefined);
        this.show();
        this.events.changed();
    }
}
