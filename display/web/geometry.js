// Boxes and rectangles for overlays. Points in the picture are in pixels, y going up; a rectangle is [x0, y0,
// x1, y1], the last two exclusive. `clip` is the plan's: 16 numbers, by columns.

const kCorners = [0, 1, 2, 3, 4, 5, 6, 7];
// A bit for each axis is set if the corner lies at the box's max.
const kEdges = kCorners.flatMap((corner) =>
    [1, 2, 4].filter((axis) => !(corner & axis)).map((axis) => [corner, corner | axis]));

export function to_clip(clip, x, y, z) {
    return [
        clip[0] * x + clip[4] * y + clip[8] * z + clip[12],
        clip[1] * x + clip[5] * y + clip[9] * z + clip[13],
        clip[2] * x + clip[6] * y + clip[10] * z + clip[14],
        clip[3] * x + clip[7] * y + clip[11] * z + clip[15],
    ];
}

// The part of a line between two points in clip space that is inside the frustum, in pixels: [x0, y0, x1,
// y1], or null. It is cut before the division, so that nothing behind the eye comes out in front of it.
export function visible_segment(a, b, width, height) {
    let first = 0;
    let last = 1;
    for (let axis = 0; axis < 3; ++axis)
        for (const sign of [-1, 1]) {
            const from = a[3] + sign * a[axis];
            const to = b[3] + sign * b[axis];
            if (from < 0 && to < 0) return null;
            if (from < 0) first = Math.max(first, from / (from - to));
            if (to < 0) last = Math.min(last, from / (from - to));
        }
    if (!(first <= last)) return null;
    const segment = [];
    for (const part of [first, last]) {
        const w = a[3] + part * (b[3] - a[3]);
        if (!(w > 0)) return null;
        segment.push(((a[0] + part * (b[0] - a[0])) / w * 0.5 + 0.5) * width,
                     ((a[1] + part * (b[1] - a[1])) / w * 0.5 + 0.5) * height);
    }
    return segment;
}

// The boxes at a pose of 0 to 1, from flat lists of (min, max) at pose 0 and at pose 1. Without the second
// nothing moves.
export function boxes_at(boxes, end_boxes, pose) {
    if (!end_boxes || !(pose > 0)) return boxes;
    return boxes.map((from, i) => from + pose * (end_boxes[i] - from));
}

// Box number `id` of a flat list of (min, max), as {edges, depth}, or null if nothing of it is seen. edges
// has five numbers for each visible edge: its segment, and its number among the twelve. depth is the
// centre's.
export function wireframe(boxes, id, clip, width, height) {
    const at = 6 * id;
    let inside = true;
    let depth = 0;
    const corners = kCorners.map((corner) => {
        const point = to_clip(clip, boxes[at + (corner & 1 ? 3 : 0)], boxes[at + (corner & 2 ? 4 : 1)],
                              boxes[at + (corner & 4 ? 5 : 2)]);
        const [x, y, z, w] = point;
        inside &&= w > 0 && Math.abs(x) <= w && Math.abs(y) <= w && Math.abs(z) <= w;
        depth += w / 8;
        return point;
    });
    const edges = [];
    if (inside) {
        const pixels = corners.map(([x, y, , w]) =>
            [(x / w * 0.5 + 0.5) * width, (y / w * 0.5 + 0.5) * height]);
        kEdges.forEach(([from, to], place) =>
            edges.push(pixels[from][0], pixels[from][1], pixels[to][0], pixels[to][1], place));
    } else {
        kEdges.forEach(([from, to], place) => {
            const segment = visible_segment(corners[from], corners[to], width, height);
            if (segment) edges.push(...segment, place);
        });
    }
    return edges.length > 0 ? {edges, depth} : null;
}

// The convex hull of points [x, y], in order around it.
export function hull(points) {
    const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
    const turns_left = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0;
    const chain = (from) => {
        const line = [];
        for (const point of from) {
            while (line.length > 1 && !turns_left(line.at(-2), line.at(-1), point)) line.pop();
            line.push(point);
        }
        line.pop();
        return line;
    };
    return [...chain(sorted), ...chain(sorted.reverse())];
}

// Splits a flat list of rectangles.
export function rectangles(flat) {
    const list = [];
    for (let i = 0; i + 3 < flat.length; i += 4) list.push(flat.slice(i, i + 4));
    return list;
}

export function area(flat) {
    return rectangles(flat).reduce((sum, [x0, y0, x1, y1]) => sum + (x1 - x0) * (y1 - y0), 0);
}

// Decodes the object ids of a plan's group: the first, then the difference of each to the one before.
export function group_ids(deltas) {
    let id = 0;
    return deltas.map((delta) => id += delta);
}

// The parts of a region's outline with foreign pixels beyond them: [x0, y0, x1, y1] each, of the given
// thickness, inside the region. The screen's edges have nothing beyond them.
export function borders(flat, width, height, thickness) {
    const all = rectangles(flat);
    const parts = [];
    for (const [x0, y0, x1, y1] of all) {
        const tx = Math.min(thickness, x1 - x0);
        const ty = Math.min(thickness, y1 - y0);
        const beside = (touches) => all.filter(touches);
        if (x0 > 0)
            for (const [from, to] of without(y0, y1, beside((r) => r[2] === x0).map((r) => [r[1], r[3]])))
                parts.push([x0, from, x0 + tx, to]);
        if (x1 < width)
            for (const [from, to] of without(y0, y1, beside((r) => r[0] === x1).map((r) => [r[1], r[3]])))
                parts.push([x1 - tx, from, x1, to]);
        if (y0 > 0)
            for (const [from, to] of without(x0, x1, beside((r) => r[3] === y0).map((r) => [r[0], r[2]])))
                parts.push([from, y0, to, y0 + ty]);
        if (y1 < height)
            for (const [from, to] of without(x0, x1, beside((r) => r[1] === y1).map((r) => [r[0], r[2]])))
                parts.push([from, y1 - ty, to, y1]);
    }
    return parts;
}

// The parts of [from, to) that no interval covers.
function without(from, to, covered) {
    const left = [];
    for (const [begin, end] of covered.sort((a, b) => a[0] - b[0])) {
        if (begin > from && from < to) left.push([from, Math.min(begin, to)]);
        from = Math.max(from, end);
    }
    if (from < to) left.push([from, to]);
    return left;
}

// The number of the server whose tile has the pixel; -1 if none.
export function owner_at(tiles, x, y) {
    return tiles.findIndex((flat) =>
        rectangles(flat).some(([x0, y0, x1, y1]) => x >= x0 && x < x1 && y >= y0 && y < y1));
}
