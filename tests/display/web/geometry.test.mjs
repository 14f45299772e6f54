import assert from 'node:assert/strict';
import test from 'node:test';

import * as geometry from '../../../display/web/geometry.js';

// Looks along -z from the origin: 90 degrees, near 1, far 10, square.
const near = 1;
const far = 10;
const clip = [
    1, 0, 0, 0,
    0, 1, 0, 0,
    0, 0, -(far + near) / (far - near), -1,
    0, 0, -2 * far * near / (far - near), 0,
];
const at = (x, y, z) => geometry.to_clip(clip, x, y, z);
const close = (a, b) => assert.ok(a.every((value, i) => Math.abs(value - b[i]) < 1e-6), `${a} is not ${b}`);

test('a line inside is where its ends are seen, y going up', () => {
    close(geometry.visible_segment(at(0, 0, -2), at(1, 1, -2), 200, 100), [100, 50, 150, 75]);
});

test('a line that comes from behind the eye is cut at the near plane and not mirrored', () => {
    const segment = geometry.visible_segment(at(0.5, 0, -5), at(0.5, 0, 5), 200, 200);
    close(segment, [110, 100, 150, 100]);
});

test('a line that passes through the eye plane far to the side is cut at the border of the picture', () => {
    const segment = geometry.visible_segment(at(0, 0, -2), at(100, 0, 1), 200, 200);
    assert.ok(segment[2] <= 200 + 1e-6 && segment[2] > 199);
});

test('a line behind the eye or beside the picture is not seen', () => {
    assert.equal(geometry.visible_segment(at(0, 0, 2), at(1, 1, 5), 200, 200), null);
    assert.equal(geometry.visible_segment(at(30, 0, -2), at(40, 0, -2), 200, 200), null);
    assert.equal(geometry.visible_segment(at(0, 0, -20), at(0, 1, -30), 200, 200), null);
});

const every_fifth = (edges, first) => edges.filter((_, place) => place % 5 === first);

test('a box in view has twelve edges and the depth of its centre', () => {
    const {edges, depth} = geometry.wireframe([9, 9, 9, 9, 9, 9, -1, -1, -5, 1, 1, -3], 1, clip, 100, 100);
    assert.deepEqual(every_fifth(edges, 4), [...Array(12).keys()]);
    assert.ok(Math.abs(depth - 4) < 1e-9);
    // From the far lower left corner to the right.
    close(edges.slice(0, 4), [40, 40, 60, 40]);
});

test('a box that sticks out has the same edges as far as they are seen', () => {
    const whole = geometry.wireframe([0, 0, -5, 1, 1, -3], 0, clip, 100, 100).edges;
    const {edges} = geometry.wireframe([0, 0, -50, 1, 1, -3], 0, clip, 100, 100);
    const near_side = (list) => list.slice(5 * every_fifth(list, 4).indexOf(9)).slice(0, 5);
    assert.ok(edges.length < whole.length);
    close(near_side(edges), near_side(whole));
});

test('a box around the eye is cut, and one behind it is not there', () => {
    const {edges} = geometry.wireframe([-1, -1, -5, 1, 1, 5], 0, clip, 100, 100);
    assert.ok(edges.length > 0 && edges.length < 12 * 5);
    for (const value of edges) assert.ok(value >= -1e-6 && value <= 100 + 1e-6);
    assert.equal(geometry.wireframe([-1, -1, 2, 1, 1, 5], 0, clip, 100, 100), null);
});

test('a hull leaves out what is inside', () => {
    const around = geometry.hull([[0, 0], [2, 2], [4, 0], [4, 4], [0, 4], [2, 1], [2, 0]]);
    assert.deepEqual(around, [[0, 0], [4, 0], [4, 4], [0, 4]]);
});

test('group ids add up', () => {
    assert.deepEqual(geometry.group_ids([3, 1, 5]), [3, 4, 9]);
    assert.deepEqual(geometry.group_ids([]), []);
});

test('boxes are between their ends', () => {
    const boxes = [0, 0, 0, 1, 1, 1, 5, 5, 5, 6, 6, 6];
    const end_boxes = [10, 0, 0, 11, 1, 1, 5, 5, 5, 6, 6, 6];
    assert.deepEqual(geometry.boxes_at(boxes, end_boxes, 0.5), [5, 0, 0, 6, 1, 1, 5, 5, 5, 6, 6, 6]);
    assert.equal(geometry.boxes_at(boxes, end_boxes, 0), boxes);
    assert.equal(geometry.boxes_at(boxes, null, 0.5), boxes);
    assert.equal(geometry.boxes_at(boxes, end_boxes, undefined), boxes);
});

test('areas add up over rectangles', () => {
    assert.equal(geometry.area([0, 0, 10, 5, 10, 0, 12, 1]), 52);
    assert.equal(geometry.area([]), 0);
});

test('borders are inside the tile and only where somebody else is beyond', () => {
    // The left half of a screen of 20 by 10.
    assert.deepEqual(geometry.borders([0, 0, 10, 10], 20, 10, 2), [[8, 0, 10, 10]]);
    // One tile is the whole screen.
    assert.deepEqual(geometry.borders([0, 0, 20, 10], 20, 10, 2), []);
});

test('rectangles of one server have no border between them', () => {
    const parts = geometry.borders([0, 0, 10, 10, 10, 4, 20, 10], 20, 10, 1);
    // Only along the corner that the second rectangle leaves out.
    assert.deepEqual(parts, [[9, 0, 10, 4], [10, 4, 20, 5]]);
});

test('a border is never thicker than its tile', () => {
    assert.deepEqual(geometry.borders([5, 0, 6, 10], 20, 10, 4), [[5, 0, 6, 10], [5, 0, 6, 10]]);
});

test('a pixel belongs to the server whose tile has it', () => {
    const tiles = [[0, 0, 10, 10], [10, 0, 20, 10]];
    assert.equal(geometry.owner_at(tiles, 9.9, 5), 0);
    assert.equal(geometry.owner_at(tiles, 10, 5), 1);
    assert.equal(geometry.owner_at(tiles, 25, 5), -1);
});
