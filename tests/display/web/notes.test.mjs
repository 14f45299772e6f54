import assert from 'node:assert/strict';
import test from 'node:test';

import {ink_on, server_colour} from '../../../display/web/colours.js';
import {read_frame, read_plan, read_speedup} from '../../../display/web/notes.js';
import {advice, by_phase, critical_text, limit_of, server_number} from '../../../display/web/phases.js';

test('servers have the colours of the simulator\'s pictures', () => {
    assert.deepEqual([0, 1, 2, 15].map(server_colour),
                     [[0, 197, 171], [156, 118, 0], [255, 139, 172], [131, 99, 198]]);
});

test('what is written on a colour can be read', () => {
    assert.equal(ink_on([255, 255, 255]), '#000');
    assert.equal(ink_on([20, 20, 90]), '#fff');
});

test('spans and links come as lists and get names', () => {
    const frame = read_frame({stream: 1, machines: [{name: 'server 0', spans: [['render', 1, 3.5, 2]]}],
                              critical: [['server 0', 'render', 1, 3.5]]});
    assert.deepEqual(frame.machines[0].spans, [{phase: 'render', begin: 1, end: 3.5, cpu: 2}]);
    assert.deepEqual(frame.critical, [{machine: 'server 0', phase: 'render', begin: 1, end: 3.5}]);
    const plan = read_plan({tiles: [[], []], width: 10, height: 10, links: [[0, 1, 1, 2, 3, 4, 5, 6, 7, 8]]});
    assert.deepEqual(plan.links, [{from: 0, to: 1, rectangles: [1, 2, 3, 4, 5, 6, 7, 8]}]);
});

test('what notes lack is empty, and what is of no use is left out', () => {
    assert.deepEqual(read_frame({stream: 0}).machines, []);
    const backwards = {name: 'display', spans: [['wait', 5, 4], ['wait', 'x', 1]]};
    assert.deepEqual(read_frame({stream: 0, machines: [backwards]}).machines[0].spans, []);
    assert.equal(read_frame({stream: 2, machines: []}), null);
    assert.equal(read_plan(null), null);
    assert.equal(read_plan({tiles: [], width: 0, height: 1}), null);
});

test('points of a speed-up are in order', () => {
    const {points} = read_speedup({points: [{servers: 2}, {servers: 1}, {}]});
    assert.deepEqual(points.map(({servers}) => servers), [1, 2]);
});

test('a critical path names a machine where the chain comes to it, and shares that count', () => {
    const critical = [
        {machine: 'client', phase: 'partition', begin: 0, end: 1},
        {machine: 'server 2', phase: 'render', begin: 1, end: 60},
        {machine: 'server 2', phase: 'render', begin: 60, end: 71},
        {machine: 'server 2', phase: 'swap', begin: 71, end: 74},
        {machine: 'display', phase: 'assemble', begin: 74, end: 100},
    ];
    assert.equal(critical_text(critical),
                 'client partition → server 2 render 70 % → swap → display assemble 26 %');
    assert.equal(critical_text(critical, 0.02), 'server 2 render 70 % → swap → display assemble 26 %');
    assert.equal(critical_text([]), '');
});

test('times of one phase add up', () => {
    const sums = by_phase([{phase: 'swap', begin: 0, end: 2}, {phase: 'swap', begin: 5, end: 6}]);
    assert.deepEqual([...sums], [['swap', 3]]);
});

test('only servers have a number', () => {
    assert.equal(server_number('server 12'), 12);
    assert.equal(server_number('display'), null);
    assert.equal(server_number('server x'), null);
});

test('a critical path says what it is mostly spent on, and what would help', () => {
    const span = (phase, begin, end) => ({machine: 'server 0', phase, begin, end});
    const drawing = [span('partition', 0, 1), span('wait', 1, 3), span('render', 3, 5), span('encode', 5, 8)];
    assert.equal(limit_of(drawing), 'drawing');
    assert.match(advice(drawing), /^The limit is drawing: more servers .* would help$/);
    assert.equal(limit_of([span('render', 0, 1), span('assemble', 1, 2), span('encode', 2, 3)]), 'the display');
    assert.equal(limit_of([span('something new', 0, 1)]), '');
    assert.equal(advice([]), '');
});
