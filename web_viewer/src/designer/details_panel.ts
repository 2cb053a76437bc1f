// The panels Ornaments and More: a form for all else of a species' document, made from its schema.
import { Controls } from "../controls";
import { byId, make } from "../dom";
import type { Field } from "../schema";
import type { Details, Json } from "./details";
import type { DocumentSchema } from "./schemas";
import type { Species } from "./service";
import { DocumentValues, formOf, isEqualInAllStages, type FormSchema } from "./species_form";

export interface DetailsEvents {
    /** A control is being dragged. */
    moving: (changes: Details) => void;
    /** One step of undo; values that are listed are again as they were traced or opened. */
    changed: (changes: Details, restored: readonly string[]) => void;
}

/** Groups of the model that have a panel of their own. */
const ornaments = /^(ornaments|warts|scales|volva|sac|ring|spines|peridioles|receptacle)$/;

/** Returns what is wrong with the age of a stage: stages stand in ascending order. */
export function ageProblem(
    ages: readonly number[],
    stage: number,
    age: number,
): string | undefined {
    const [younger, older] = [ages[stage - 1], ages[stage + 1]];
    if (younger !== undefined && age <= younger)
        return `is not above ${younger}, the age of the stage before`;
    if (older !== undefined && age >= older)
        return `is not below ${older}, the age of the next stage`;
    return undefined;
}

/** A part of the document with its controls. */
interface Part {
    values: DocumentValues;
    controls: Controls;
    prefix: (stage: number) => string;
    ofStage: boolean;
}

export class DetailsPanel {
    private parts: Part[] = [];
    private own: Species | undefined;
    private ages: readonly number[] = [];
    private details: Details | undefined;
    private stage = 0;

    /** `everyAge` returns true if all stages get a value. */
    constructor(
        private readonly everyAge: () => boolean,
        private readonly events: DetailsEvents,
    ) {}

    /** Makes the forms from the schema of a species' document. */
    use(species: DocumentSchema): void {
        const stage = species.properties?.["stages"]?.items ?? {};
        const { model = {}, ...rest } = stage.properties ?? {};
        this.parts = [
            this.part(
                formOf(model, "model", false),
                (index) => `/stages/${index}/model`,
                (key) => (ornaments.test(key) ? "ornaments" : "more"),
            ),
            this.part(
                formOf({ type: "object", properties: rest }, "stage", true),
                (index) => `/stages/${index}`,
                () => "more",
            ),
            this.part(
                formOf(species, "species", true),
                () => "",
                () => "more",
            ),
        ];
        this.redraw();
    }

    /** Shows the document of a species; `own` is the one without changes. */
    show(
        own: Species | undefined,
        ages: readonly number[],
        details: Details | undefined,
        stage: number,
    ): void {
        this.own = own;
        this.ages = ages;
        this.details = details;
        this.stage = stage;
        this.redraw();
    }

    private redraw(): void {
        const { own, details, stage } = this;
        if (!own) return;
        for (const { values, controls, prefix } of this.parts) {
            values.read(own, details, prefix(stage));
            controls.clearErrors();
            controls.show(values.effective);
        }
    }

    private part(
        schema: FormSchema,
        prefix: (stage: number) => string,
        panelOf: (key: string) => "ornaments" | "more",
    ): Part {
        const values = new DocumentValues(schema);
        // How much of each ornament there is stands before what each is like.
        const groups = [
            ...schema.groups.filter(({ key }) => key === "ornaments"),
            ...schema.groups.filter(({ key }) => key !== "ornaments"),
        ];
        const hosts = { ornaments: byId("ornaments"), more: byId("more") };
        const part: Part = {
            values,
            prefix,
            ofStage: prefix(0) !== prefix(1),
            controls: new Controls(({ key }) => hosts[panelOf(key)], groups, values, {
                moving: (field) => this.take(part, field, false),
                moved: (field) => this.take(part, field, true),
                errorShown: (element) => element.scrollIntoView({ block: "nearest" }),
            }),
        };
        return part;
    }

    /** Returns the stages that a field is changed in. */
    private stagesOf(part: Part, { name }: Field): number[] {
        if (!part.ofStage) return [this.stage];
        const identity = name === "age" || name === "name";
        const all = isEqualInAllStages(name) || (this.everyAge() && !identity);
        return all ? this.ages.map((_, stage) => stage) : [this.stage];
    }

    private take(part: Part, field: Field, letGo: boolean): void {
        const { name } = field;
        let change: { pointer: string; value: Json | undefined };
        try {
            change = part.values.change(name);
        } catch (error) {
            part.controls.showError(name, (error as Error).message);
            return;
        }
        const { value } = change;
        const wrong =
            name === "age" && typeof value === "number"
                ? ageProblem(this.ages, this.stage, value)
                : undefined;
        if (wrong) {
            part.controls.showError(name, wrong);
            return;
        }
        const path = change.pointer.slice(part.prefix(this.stage).length);
        const pointers = this.stagesOf(part, field).map((stage) => part.prefix(stage) + path);
        if (value === undefined) return this.events.changed({}, pointers);
        const changes = Object.fromEntries(pointers.map((pointer) => [pointer, value]));
        if (letGo) this.events.changed(changes, []);
        else this.events.moving(changes);
    }
}

/** Shows that the forms cannot be made, in place of them. */
export function showFormProblem(text: string): void {
    for (const id of ["paint", "ornaments", "more"])
        byId(id).replaceChildren(make("p", { class: "validation-error", role: "alert" }, text));
}
