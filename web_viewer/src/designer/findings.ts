// What the service has found on the photograph: numbers, warnings and the species that it is like.
import { byId, make } from "../dom";
import { isFolded } from "./axis_line";
import { hasGeometry } from "./details";
import type { Drawing } from "./gesture";
import { millimetres, sizeOf, type Nearest, type Trace } from "./service";

/** Percent with a digit after the point. */
function percent(value: number): string {
    return `${value.toFixed(1)} %`;
}

function degrees(value: number): string {
    return `${Math.abs(value).toFixed(0)}°`;
}

function leaning(value: number): string {
    if (Math.abs(value) < 0.5) return "upright";
    return `${degrees(value)} to the ${value > 0 ? "right" : "left"}`;
}

const methods: Readonly<Record<string, string>> = {
    fitted: "outline and axis as measured",
    opened: "from the file of a species",
    refined: "what grows has the contour of the photograph",
    simplified: "with a plain stem, because the outline would cross itself",
    straightened: "bends less than on the photograph, because the stem would fold",
};

/** Returns the rows of the list of numbers: name, value and what it means. An edited outline has no
 *  error to the photograph. The size is that of the shown stage. */
export function rowsOf(
    trace: Trace,
    edited = false,
    shown = trace.stage,
): [string, string, string][] {
    const { angles, asymmetry_pct: asymmetry, certificate, error_pct: error, ring } = trace;
    const size = sizeOf(trace.species.stages[shown]?.model ?? {});
    const rows: [string, string, string][] = [];
    const add = (name: string, value: string, meaning: string): void => {
        rows.push([name, value, meaning]);
    };
    if (size) {
        add("Height", millimetres(size.height), "from the ground to the top");
        add("Cap", `${millimetres(size.cap)} across`, "greatest diameter");
    }
    if (trace.form) add("Form", trace.form, "how it was traced");
    if (ring) {
        const meaning = `stands ${millimetres(ring.width_m)} out from the stem`;
        add("Ring", `${millimetres(ring.height_m)} high`, meaning);
    }
    if (error !== undefined && !edited)
        add("Error", percent(error), "greatest distance to the photograph, of the height");
    if (asymmetry !== undefined)
        add("Asymmetry", percent(asymmetry), "half the distance between left and right");
    if (angles) {
        const meaning = "of the line from the foot to the top of the stem";
        add("Lean", leaning(angles.lean_deg), meaning);
        add("Bend", degrees(angles.bend_deg), "between foot and cap");
    }
    const method = methods[trace.method] ?? trace.method;
    const start = trace.method === "opened" ? "opened" : "traced";
    add("Method", edited ? `${start}, then edited` : method, "how the shape came about");
    if (certificate) {
        const proof = certificate.simple ? "✓ never crosses itself" : "not proven";
        add("Proof", proof, `by ${certificate.method}`);
    }
    return rows;
}

export interface FindingsEvents {
    template: (id: string) => void;
}

export class Findings {
    constructor(private readonly events: FindingsEvents) {
        byId("template-auto").addEventListener("click", () => events.template("auto"));
    }

    /** Shows a trace, or nothing; the size is that of a stage. */
    show(trace: Trace | undefined, { template, shape, details }: Drawing, stage: number): void {
        for (const id of ["findings", "actions"]) byId(id).hidden = !trace;
        if (!trace) return;
        byId("found-numbers").replaceChildren(
            ...rowsOf(trace, !!shape || hasGeometry(details), stage).flatMap(
                ([name, value, meaning]) => [
                    make("dt", {}, name),
                    make("dd", { title: meaning }, value),
                ],
            ),
        );
        const folded = isFolded(trace.species.stages[stage]?.model ?? {})
            ? [{ code: "folded", detail: "On its axis the stem of this age would fold: it is grown straighter." }]
            : [];
        const warnings = [...trace.warnings, ...folded].map(({ code, detail }) =>
            make("li", { "data-code": code }, detail),
        );
        byId("warnings").replaceChildren(...warnings);
        byId("warnings").hidden = warnings.length === 0;
        byId("likeness").hidden = trace.nearest.length === 0;
        const auto = template === "auto";
        byId("template-auto").setAttribute("aria-pressed", String(auto));
        const used = trace.template ?? template;
        byId("nearest").replaceChildren(
            ...trace.nearest.map((nearest) => this.button(nearest, nearest.id === used, auto)),
        );
        const lender = trace.nearest.find(({ id }) => id === used)?.name ?? used;
        byId("nearest-used").textContent = auto
            ? `All else comes from our ${lender}, the most alike of its form.`
            : `All else comes from our ${lender}.`;
    }

    private button(nearest: Nearest, used: boolean, auto: boolean): HTMLLIElement {
        const { id, name, age, shape_pct: shape, colour } = nearest;
        const picture = make("img", {
            src: `v1/mushrooms/${id}.png?width=128&height=128&view=front&age=${age}`,
            alt: "",
            width: 56,
            height: 56,
            loading: "lazy",
        });
        const button = make(
            "button",
            { type: "button", "data-species": id, "aria-pressed": String(used && !auto) },
            picture,
            make(
                "span",
                {},
                make("b", {}, `looks like our ${name}`),
                make("small", {}, `shape ${percent(shape)} off, colour ΔE ${colour.toFixed(0)}`),
            ),
        );
        if (used) button.classList.add("used");
        button.addEventListener("click", () => this.events.template(id));
        return make("li", {}, button);
    }
}
