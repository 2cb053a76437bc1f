// What can be a parent: species of the service, published ones of its library, and the draft of the designer.
import { getJson } from "../http";
import { loadDraft } from "../designer/draft";
import { missingLine, type Drawing } from "../designer/gesture";
import { Photograph, withEdits, type Source } from "../designer/service";
import { SpeciesFile } from "../designer/species_file";
import { hashOf, type FamilyName, type Species } from "./pedigree";

export interface Candidate {
    species: Species;
    /** Second line in the list: the scientific name, or who made it. */
    about: string;
    form: string;
}

interface Listed {
    id: string;
    common_name?: string;
    scientific_name?: string;
    form?: string;
    family?: string;
}

interface Published {
    id: string;
    title: string;
    name: string;
    form: string;
    newest: number;
}

/** Returns the family of a whole species: "swept" or "branched". */
export function familyOf(text: string): FamilyName | undefined {
    const { stages } = JSON.parse(text) as { stages?: { model?: { form?: string } }[] };
    return stages?.[0]?.model?.form ?? "swept";
}

/** Returns the species of a document that the service does not have. */
export function ownSpecies(text: string): Species {
    const { id, facts } = JSON.parse(text) as { id?: string; facts?: { common_name?: string } };
    const family = familyOf(text);
    return {
        key: `own-${hashOf(text)}`,
        name: facts?.common_name || id || "A species of yours",
        text,
        ...(family ? { family } : {}),
    };
}

export async function builtIn(): Promise<Candidate[]> {
    const { species } = await getJson<{ species: Listed[] }>("v1/species");
    return species.map(({ id, common_name: common, scientific_name: scientific, form = "", family }) => ({
        species: { key: id, name: common ?? id, ...(family ? { family } : {}) },
        about: scientific ?? "",
        form,
    }));
}

/** Returns published species of the library whose name or title has a text, and whether there are more.
 *
 *  families  of each growth form, as the built-in species have them */
export async function ofLibrary(
    text: string,
    families: ReadonlyMap<string, FamilyName>,
    signal: AbortSignal,
): Promise<{ found: Candidate[]; more: boolean }> {
    const search = text ? `&q=${encodeURIComponent(text.slice(0, 64))}` : "";
    const { species, next } = await getJson<{ species: Published[]; next: string | null }>(
        `v1/library?limit=100${search}`,
        signal,
    );
    const found = species
        .filter(({ newest }) => newest > 0)
        .map(({ id, title, name, form, newest }) => {
            const family = families.get(form);
            return {
                // The version is named, so that the same children come of it tomorrow.
                species: { key: `${id}@${newest}`, name: title || name, ...(family ? { family } : {}) },
                about: `${id}, version ${newest}`,
                form,
            };
        });
    return { found, more: next !== null };
}

async function sourceOf(file: Blob, signal: AbortSignal): Promise<Source> {
    const isSpecies = file.type === "application/json" || (file instanceof File && /\.json$/i.test(file.name));
    return isSpecies ? SpeciesFile.read(file) : Photograph.upload(file, signal, () => undefined);
}

/** Returns true if the designer has a draft in this browser. */
export async function hasDraft(): Promise<boolean> {
    return (await loadDraft()) !== undefined;
}

/** Returns the species of the designer's draft, with all that was edited.
 *
 *  throws  Error if there is none, or if lines are missing on its photograph */
export async function designersDraft(signal: AbortSignal): Promise<Species> {
    const draft = await loadDraft();
    const file = draft?.files.get(draft.drawing.source ?? -1);
    if (!draft || !file) throw new Error("The designer has no draft in this browser");
    const source = await sourceOf(file, signal);
    const ofCap: Photograph[] = [];
    const photographOf = async (number: number): Promise<Photograph> => {
        const photograph = await Photograph.upload(
            draft.files.get(number) ?? new Blob(),
            signal,
            () => undefined,
        );
        ofCap.push(photograph);
        return photograph;
    };
    try {
        const drawing: Drawing = draft.drawing;
        if (missingLine(drawing.gesture, source.stored.alpha) === "axis")
            throw new Error("The designer's draft has no line from foot to top yet");
        const { species } = withEdits(await source.trace(drawing, signal, photographOf), drawing);
        return ownSpecies(JSON.stringify(species));
    } finally {
        for (const each of [source, ...ofCap]) each.forget();
    }
}
