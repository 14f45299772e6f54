import assert from 'node:assert/strict';
import test from 'node:test';

import {from_numbers} from '../../../display/web/camera.js';
import {Wishes} from '../../../display/web/wishes.js';

const camera = from_numbers([0, 0, 5, 0, 0, 0, 0, 1, 0, 45]);

// Makes wishes, which go out while `line.up`, and a function that plays an animation frame.
function setup() {
    const line = {up: true};
    const callbacks = [];
    globalThis.requestAnimationFrame = (callback) => callbacks.push(callback);
    const wishes = new Wishes(() => line.up);
    wishes.adopt({algorithm: 'hybrid'}, camera);
    return {line, wishes, animate: () => callbacks.splice(0).forEach((callback) => callback())};
}

test('a wish carries the time of the oldest input since the one before', () => {
    const {wishes, animate} = setup();
    wishes.look(camera, 10);
    wishes.look(camera, 20);
    animate();
    wishes.look(camera, 30);
    animate();
    assert.equal(wishes.sent.algorithm, 'hybrid');
    assert.equal(wishes.take_input(1), 10);
    assert.equal(wishes.take_input(1), null);
    assert.equal(wishes.take_input(2), 30);
});

test('the input of a wish that did not go out is forgotten', () => {
    const {line, wishes, animate} = setup();
    line.up = false;
    wishes.look(camera, 10);
    animate();
    assert.equal(wishes.sent, null);
    line.up = true;
    wishes.set({paused: true});
    animate();
    assert.equal(wishes.sent.id, 1);
    assert.equal(wishes.take_input(1), null);
});

test('who takes over starts without an input', () => {
    const {wishes, animate} = setup();
    wishes.look(camera, 10);
    wishes.adopt(null, camera);
    animate();
    assert.equal(wishes.take_input(1), null);
});
