// Close-ups by name: where on a model they look, found on its triangles, and how much they show.
import {
    InstancedMesh,
    Matrix4,
    Mesh,
    Raycaster,
    Vector3,
    type Box3,
    type Object3D,
} from "three";
import { meshesOf, shownPart, stemsOf, woodOf } from "./model";

export const closeUpNames = ["margin", "underside", "base"] as const;
export type CloseUpName = (typeof closeUpNames)[number];

/** How a product is seen in one close-up. */
export interface CloseUpRule {
    /** Shorter side of what the picture shows, metres; of a small model less, see frameOf(). */
    frame: number;
    /** Direction from the model to the camera, of length 1, unless the model hides the place. */
    direction: Vector3;
}

/** Close-ups of a product; a text says why there is none. */
export type CloseUpRules = Readonly<Record<CloseUpName, CloseUpRule | string>> & {
    /** The product consists of many individuals, of which the foremost one is looked at. */
    readonly many?: boolean;
};

export interface CloseUp extends CloseUpRule {
    target: Vector3;
}

/** Part of the longest side of a model that its close-ups show at most. */
const mostOfModel = 0.7;
/** Where the underside is looked at, between the middle and the margin. */
const betweenMiddleAndMargin = 0.6;
/** Height of the base in its close-up: the ground is in the lower third. */
const baseHeight = 0.3;
/** A model grows sideways if its middle is farther beside its origin than this part of the frame, and
 *  than this part of its height, so that it does not only lean; its base is looked at from an angle
 *  to the side that it grows to, radians. */
const sidewaysFrom = 0.25;
const leaningUpTo = 0.5;
const sidewaysTurn = 0.7;

const forwards = new Vector3(0, 0, 1);

/** Forms of mushrooms with a cap: it has a margin, and an underside that can be seen. */
const capped = [
    "agaric",
    "bolete",
    "chanterelle",
    "tooth",
    "trumpet",
    "bracket",
    "shelving_agaric",
    "crust",
];
/** Forms with a margin only. */
const rimmed = ["cup", "nest"];

/** Returns why a mushroom of these forms has no such close-up, undefined if it has one. Of a mix
 *  one form with it is enough, and so is one that is not known. */
export function missingOfForms(
    name: CloseUpName,
    forms: readonly (string | undefined)[],
): string | undefined {
    if (name === "base") return undefined;
    const having = name === "margin" ? [...capped, ...rimmed] : capped;
    if (forms.some((form) => form === undefined || having.includes(form))) return undefined;
    const form = (forms[0] ?? "").replaceAll("_", " ");
    const article = /^[aeiou]/.test(form) ? "An" : "A";
    return `${article} ${form} has no ${name === "margin" ? "margin" : "underside to look at"}`;
}

/** Returns how much of a model a close-up shows: a model that is hardly larger than the close-up
 *  is not seen whole. */
export function frameOf(frame: number, size: Vector3): number {
    return Math.min(frame, mostOfModel * Math.max(size.x, size.y, size.z));
}

/** One mesh as it stands in the scene. */
interface Individual {
    mesh: Mesh;
    /** Of an InstancedMesh, which of its instances. */
    instance: number | undefined;
    matrix: Matrix4;
}

function individualsOf(model: Object3D): Individual[] {
    const part = shownPart(model);
    const others = [stemsOf(model), woodOf(model)];
    const individuals: Individual[] = [];
    part.updateMatrixWorld(true);
    for (const mesh of meshesOf(part)) {
        let above: Object3D | null = mesh;
        while (above && !others.includes(above)) above = above.parent;
        if (above) continue;
        if (!(mesh instanceof InstancedMesh)) {
            individuals.push({ mesh, instance: undefined, matrix: mesh.matrixWorld });
            continue;
        }
        for (let instance = 0; instance < mesh.count; ++instance) {
            const matrix = new Matrix4();
            mesh.getMatrixAt(instance, matrix);
            individuals.push({ mesh, instance, matrix: matrix.premultiply(mesh.matrixWorld) });
        }
    }
    return individuals;
}

function middleOf({ mesh, matrix }: Individual): Vector3 {
    if (!mesh.geometry.boundingBox) mesh.geometry.computeBoundingBox();
    const middle = new Vector3();
    mesh.geometry.boundingBox?.getCenter(middle);
    return middle.applyMatrix4(matrix);
}

/** Returns the individual that is farthest in a direction: nothing hides it from there. */
function foremost(model: Object3D, direction: Vector3): Individual | undefined {
    let best: Individual | undefined;
    let most = -Infinity;
    for (const individual of individualsOf(model)) {
        const at = middleOf(individual).dot(direction);
        if (at <= most) continue;
        most = at;
        best = individual;
    }
    return best;
}

interface Shape {
    /** The vertex that is farthest in a direction. */
    margin: Vector3;
    lowest: number;
    highest: number;
}

function shapeOf({ mesh, matrix }: Individual, direction: Vector3): Shape {
    const point = new Vector3();
    const shape: Shape = { margin: new Vector3(), lowest: Infinity, highest: -Infinity };
    let most = -Infinity;
    const count = mesh.geometry.getAttribute("position")?.count ?? 0;
    for (let index = 0; index < count; ++index) {
        mesh.getVertexPosition(index, point).applyMatrix4(matrix);
        shape.lowest = Math.min(shape.lowest, point.y);
        shape.highest = Math.max(shape.highest, point.y);
        const at = point.dot(direction);
        if (at <= most) continue;
        most = at;
        shape.margin.copy(point);
    }
    return shape;
}

/** Returns the point of a surface that faces downwards above a place; one in the upper part, where
 *  the cap is, rather than one of a ring or a volva. */
function undersideAbove(
    { mesh, instance }: Individual,
    { lowest, highest }: Shape,
    place: Vector3,
): Vector3 | undefined {
    const from = new Vector3(place.x, lowest - (highest - lowest), place.z);
    const hits = new Raycaster(from, new Vector3(0, 1, 0))
        .intersectObject(mesh, false)
        .filter((hit) => hit.instanceId === instance && hit.face)
        .filter(({ face, object }) => {
            const normal = face?.normal.clone().transformDirection(object.matrixWorld);
            return normal !== undefined && (instance !== undefined || normal.y < -0.2);
        });
    const cap = hits.find(({ point }) => point.y > lowest + 0.35 * (highest - lowest));
    return (cap ?? hits[0])?.point;
}

/** Returns the close-up of the base, a little above the place where a model touches what it grows
 *  on: there products have their origin. `individual` is one of many that is looked at. */
function baseOf(
    model: Object3D,
    individual: Individual | undefined,
    direction: Vector3,
    frame: number,
    bounds: Box3,
): CloseUp {
    const target = new Vector3().setFromMatrixPosition(individual?.matrix ?? model.matrixWorld);
    const middle = individual ? middleOf(individual) : bounds.getCenter(new Vector3());
    if (stemsOf(model)) target.y = new Vector3().setFromMatrixPosition(model.matrixWorld).y;
    const away = new Vector3(middle.x - target.x, 0, middle.z - target.z);
    // A lone bracket grows forwards from its wood, whose middle is behind it.
    const isBracket = !individual && woodOf(model) !== undefined;
    if (isBracket) away.copy(forwards);
    const height = bounds.max.y - bounds.min.y;
    if (isBracket || away.length() > Math.max(sidewaysFrom * frame, leaningUpTo * height)) {
        // The cap hides the base of what grows sideways, but not from obliquely below.
        const seen = away.normalize().applyAxisAngle(new Vector3(0, 1, 0), sidewaysTurn);
        return { target, direction: seen.setY(-0.55).normalize(), frame };
    }
    target.y += Math.min(Math.max(middle.y - target.y, 0), baseHeight * frame);
    return { target, direction, frame };
}

/** Returns where a close-up of a model with these bounds looks; undefined if the model has no such
 *  place. */
export function closeUpOf(
    model: Object3D,
    name: CloseUpName,
    rules: CloseUpRules,
    bounds: Box3,
): CloseUp | undefined {
    const rule = rules[name];
    if (typeof rule === "string") return undefined;
    const { direction } = rule;
    const frame = frameOf(rule.frame, bounds.getSize(new Vector3()));
    const towards = new Vector3(direction.x, 0, direction.z).normalize();
    if (name === "base") {
        const individual = rules.many ? foremost(model, towards) : undefined;
        return baseOf(model, individual, direction, frame, bounds);
    }
    const individual = foremost(model, towards);
    if (!individual) return undefined;
    const shape = shapeOf(individual, towards);
    if (name === "margin") return { target: shape.margin, direction, frame };
    const place = middleOf(individual).lerp(shape.margin, betweenMiddleAndMargin);
    const target = undersideAbove(individual, shape, place);
    return target && { target, direction, frame };
}
