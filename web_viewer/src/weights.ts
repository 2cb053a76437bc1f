// Weights of a point in a polygon between its corners, and the grids of a variety sheet.

export interface Point {
    x: number;
    y: number;
}

/** Returns the corners of a regular polygon on the unit circle, clockwise on a screen (y down); the
 *  first is at the top or top left. */
export function polygon(corners: number): Point[] {
    const first = corners % 2 ? -Math.PI / 2 : -Math.PI / 2 - Math.PI / corners;
    return Array.from({ length: corners }, (_, index) => {
        const angle = first + (index * 2 * Math.PI) / corners;
        return { x: Math.cos(angle), y: Math.sin(angle) };
    });
}

/** Returns twice the signed area of a triangle. */
function area(a: Point, b: Point, c: Point): number {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/** Returns the Wachspress coordinates of a point in a convex polygon: >= 0, sum 1, smooth, linear
 *  along the edges, exactly 1 at a corner. Computed as products of areas, not quotients, they are
 *  valid on the edges, too. Their weighted mean of the corners is the point: sum w_i v_i = p. */
export function weightsAt(point: Point, corners: readonly Point[]): number[] {
    const n = corners.length;
    const at = (index: number): Point => corners[(index + n) % n]!;
    const sides = corners.map((_, index) => Math.max(area(point, at(index), at(index + 1)), 0));
    const raw = corners.map((_, index) => {
        let product = area(at(index - 1), at(index), at(index + 1));
        for (let side = 0; side < n; ++side) {
            if (side !== index && side !== (index + n - 1) % n) product *= sides[side]!;
        }
        return product;
    });
    const sum = raw.reduce((all, weight) => all + weight, 0);
    return raw.map((weight) => weight / sum);
}

/** Returns the weighted mean of the corners. */
export function pointOf(weights: readonly number[], corners: readonly Point[]): Point {
    return corners.reduce(
        (sum, corner, index) => ({
            x: sum.x + corner.x * (weights[index] ?? 0),
            y: sum.y + corner.y * (weights[index] ?? 0),
        }),
        { x: 0, y: 0 },
    );
}

/** Returns the nearest point in a convex polygon that runs clockwise on the screen, or a corner
 *  within the distance `snap`. */
export function insidePolygon(point: Point, corners: readonly Point[], snap = 0): Point {
    const near = corners.find(
        (corner) => Math.hypot(corner.x - point.x, corner.y - point.y) <= snap,
    );
    if (near) return near;
    const n = corners.length;
    if (corners.every((corner, index) => area(point, corner, corners[(index + 1) % n]!) >= 0))
        return point;
    let best = corners[0]!;
    let least = Infinity;
    corners.forEach((a, index) => {
        const b = corners[(index + 1) % n]!;
        const along = (point.x - a.x) * (b.x - a.x) + (point.y - a.y) * (b.y - a.y);
        const t = Math.min(Math.max(along / ((b.x - a.x) ** 2 + (b.y - a.y) ** 2), 0), 1);
        const foot =
            t === 0 ? a : t === 1 ? b : { x: a.x + t * (b.x - a.x), y: a.y + t * (b.y - a.y) };
        const distance = Math.hypot(foot.x - point.x, foot.y - point.y);
        if (distance < least) {
            least = distance;
            best = foot;
        }
    });
    const corner = corners.find((one) => Math.hypot(one.x - best.x, one.y - best.y) <= snap);
    return corner ?? best;
}

export interface Cell {
    /** Column and row of the cell from the upper left; rows of a triangle are shifted by halves. */
    column: number;
    row: number;
    weights: number[];
    /** Age, 0..1, if the rows are ages. */
    age?: number;
}

export interface Layout {
    columns: number;
    rows: number;
    cells: Cell[];
}

const side = 5;

function square(weights: (x: number, y: number) => number[]): Layout {
    const cells: Cell[] = [];
    for (let row = 0; row < side; ++row) {
        for (let column = 0; column < side; ++column) {
            cells.push({ column, row, weights: weights(column / (side - 1), row / (side - 1)) });
        }
    }
    return { columns: side, rows: side, cells };
}

function bilinear(x: number, y: number): number[] {
    return [(1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y];
}

/** Returns the morphs of a variety sheet, with control shapes at the corners (a fifth in the
 *  middle): for two species 5 steps across and 5 ages down; for three a triangle of 21; for four
 *  25, bilinear; for five 25, linear from the middle outwards. */
export function varietyLayout(members: number): Layout {
    if (members === 2) {
        const layout = square((x) => [1 - x, x]);
        for (const cell of layout.cells) cell.age = cell.row / (side - 1);
        return layout;
    }
    if (members === 3) {
        const steps = 5;
        const cells: Cell[] = [];
        for (let row = 0; row <= steps; ++row) {
            for (let place = 0; place <= row; ++place) {
                cells.push({
                    column: (steps - row) / 2 + place,
                    row,
                    weights: [1 - row / steps, place / steps, (row - place) / steps],
                });
            }
        }
        return { columns: steps + 1, rows: steps + 1, cells };
    }
    if (members === 4) return square(bilinear);
    return square((x, y) => {
        const out = 2 * Math.max(Math.abs(x - 0.5), Math.abs(y - 0.5));
        if (out === 0) return [0, 0, 0, 0, 1];
        const border = bilinear(0.5 + (x - 0.5) / out, 0.5 + (y - 0.5) / out);
        return [...border.map((weight) => weight * out), 1 - out];
    });
}

/** Returns the index of the only member of a cell, or -1. */
export function controlShape(weights: readonly number[]): number {
    return weights.findIndex((weight) => weight > 1 - 1e-9);
}
