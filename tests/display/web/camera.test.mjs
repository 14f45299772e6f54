import assert from 'node:assert/strict';
import test from 'node:test';

import * as cameras from '../../../display/web/camera.js';
import {dot, length, normalize, subtract} from '../../../display/web/vector.js';

const home = cameras.from_numbers([0, 1, 5, 0, 0, 0, 0, 1, 0, 34]);
const within = cameras.limits([-1, -1, -1, 1, 1, 1]);
const middle = {x: 0, y: 0};

const close = (a, b, tolerance = 1e-9) =>
    assert.ok(a.every((value, i) => Math.abs(value - b[i]) <= tolerance), `${a} is not ${b}`);

// The position at which the camera sees a point, in half picture heights from the centre.
function seen(camera, point) {
    const into = normalize(subtract(camera.target, camera.eye));
    const right = normalize([
        into[1] * camera.up[2] - into[2] * camera.up[1],
        into[2] * camera.up[0] - into[0] * camera.up[2],
        into[0] * camera.up[1] - into[1] * camera.up[0],
    ]);
    const up = [
        right[1] * into[2] - right[2] * into[1],
        right[2] * into[0] - right[0] * into[2],
        right[0] * into[1] - right[1] * into[0],
    ];
    const off = subtract(point, camera.eye);
    const scale = dot(off, into) * Math.tan(camera.fov * Math.PI / 360);
    return [dot(off, right) / scale, dot(off, up) / scale];
}

test('orbiting keeps target, distance and up', () => {
    const around = cameras.orbit(home, 1.3, -0.4);
    assert.deepEqual(around.target, home.target);
    assert.deepEqual(around.up, home.up);
    assert.ok(Math.abs(cameras.distance(around) - cameras.distance(home)) < 1e-12);
});

test('dragging to the right turns what is in front to the right', () => {
    const [before] = seen(home, [0, 0, 1]);
    const [after] = seen(cameras.orbit(home, 0.1, 0), [0, 0, 1]);
    assert.ok(after > before + 0.01);
});

test('dragging down turns what is in front down', () => {
    const [, before] = seen(home, [0, 0, 1]);
    const [, after] = seen(cameras.orbit(home, 0, 0.1), [0, 0, 1]);
    assert.ok(after < before - 0.01);
});

test('orbiting there and back again ends where it began', () => {
    close(cameras.orbit(cameras.orbit(home, 0.7, 0.3), -0.7, -0.3).eye, home.eye);
});

test('orbiting never passes a pole, however far it goes', () => {
    for (const upwards of [10, -10]) {
        const camera = cameras.orbit(home, 0, upwards);
        const sine = dot(normalize(camera.eye), home.up);
        assert.ok(Math.abs(sine) > 0.999 && Math.abs(sine) < 0.99999);
        // It stays on its side.
        assert.ok(camera.eye[2] > 0);
    }
});

test('a camera from elsewhere that looks from above the turntable may come down but not go on', () => {
    const high = {...home, eye: [0, 5, 0.01]};
    close(cameras.orbit(high, 0, 1).eye, high.eye, 1e-6);
    assert.ok(cameras.orbit(high, 0, -1).eye[2] > 1);
});

test('any direction can be up', () => {
    const camera = {...home, up: [1, 2, -1]};
    const around = cameras.orbit(camera, 2 * Math.PI, 0);
    close(around.eye, camera.eye);
});

test('panning moves what is at the distance of the target with the pointer', () => {
    close(seen(cameras.pan(home, 0.25, -0.5, within), home.target), [0.25, -0.5]);
});

test('centring brings the point under the pointer to the middle', () => {
    const at = {x: 0.4, y: 0.3};
    const camera = cameras.centre(home, at, within);
    close(seen(home, camera.target), [at.x, at.y]);
    assert.ok(Math.abs(cameras.distance(camera) - cameras.distance(home)) < 1e-12);
});

test('zooming keeps what is under the pointer there', () => {
    const at = {x: 0.6, y: -0.2};
    const point = cameras.centre(home, at, within).target;
    const camera = cameras.dolly(home, 0.5, at, within);
    close(seen(camera, point), [at.x, at.y]);
    assert.ok(Math.abs(cameras.distance(camera) - 0.5 * cameras.distance(home)) < 1e-12);
});

test('zooming stops before the eye meets the target and before the model is lost', () => {
    let near = home;
    let far = home;
    for (let i = 0; i < 200; ++i) {
        near = cameras.dolly(near, 0.5, middle, within);
        far = cameras.dolly(far, 2, middle, within);
    }
    assert.ok(Math.abs(cameras.distance(near) - within.closest) < 1e-9);
    assert.ok(Math.abs(cameras.distance(far) - within.farthest) < 1e-6);
    const [ex, ey, ez, tx, ty, tz] = cameras.to_numbers(near);
    assert.ok(length([ex - tx, ey - ty, ez - tz]) > 0.5 * within.closest);
});

test('eye and target stay apart in single precision far from the origin', () => {
    const far_away = cameras.limits([1000, 1000, 1000, 1001, 1001, 1001]);
    let camera = cameras.from_numbers([1000.5, 1000.5, 1005, 1000.5, 1000.5, 1000.5, 0, 1, 0, 34]);
    for (let i = 0; i < 100; ++i) camera = cameras.dolly(camera, 0.5, middle, far_away);
    const numbers = cameras.to_numbers(camera);
    assert.ok(length(subtract(numbers.slice(0, 3), numbers.slice(3, 6))) > 0.5);
});

test('a model of one point still gives limits', () => {
    const {closest, farthest} = cameras.limits([0, 0, 0, 0, 0, 0]);
    assert.ok(closest > 0 && farthest > closest);
});

test('the target cannot be lost out of sight', () => {
    let camera = home;
    for (let i = 0; i < 500; ++i) camera = cameras.pan(camera, 1, 0, within);
    assert.ok(Math.abs(length(subtract(camera.target, within.centre)) - within.stray) < 1e-9);
    assert.ok(Math.abs(cameras.distance(camera) - cameras.distance(home)) < 1e-6);
});

test('numbers are single precision', () => {
    const numbers = cameras.to_numbers({...home, eye: [0.1, 0.2, 0.3]});
    assert.deepEqual(numbers, numbers.map(Math.fround));
    assert.equal(numbers[0], Math.fround(0.1));
});

test('text is the shortest that reads back as the same camera', () => {
    const numbers = [0.1, -1e-7, 1e18, 1 / 3, 0, 16777216, 3.4e-38, 1, 0, 34.377468].map(Math.fround);
    const text = cameras.camera_text(numbers);
    assert.ok(text.startsWith('0.1 -1e-7 1000000000000000000 0.33333334 0 16777216 '));
    assert.ok(text.endsWith('\n'));
    assert.deepEqual(text.trim().split(' ').map(Number).map(Math.fround), numbers);
});

test('every single-precision number survives its text', () => {
    const bits = new DataView(new ArrayBuffer(4));
    for (let i = 1, state = 12345; i < 20000; ++i) {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        bits.setUint32(0, state);
        const value = bits.getFloat32(0);
        if (Number.isFinite(value)) assert.equal(Math.fround(Number(cameras.float_text(value))), value);
    }
});

test('what is not ten finite numbers is no camera', () => {
    assert.ok(cameras.is_camera(cameras.to_numbers(home)));
    const ten = (value) => Array(10).fill(value);
    for (const wrong of [null, undefined, [], [1, 2], ten('1'), ten(NaN), Array(11).fill(1)])
        assert.ok(!cameras.is_camera(wrong));
});
