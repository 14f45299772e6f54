// Cameras as values. A camera is {eye, target, up, fov}: points and a direction in model space as arrays of
// three, and the vertical angle in degrees. Every function here returns a new one.
//
// Steering is a turntable: the eye goes around the target about `up`, which stays, and stops short of the
// poles, so that nothing can flip. Positions in the picture are {x, y} from its centre, in half picture
// heights, y up.

import {add, cross, dot, length, normalize, scale, subtract} from './vector.js';

const kHighest = 89 * Math.PI / 180;  // elevation over the turntable
const kClosestOfDiagonal = 2e-3;      // the near plane lies at 1e-3 at least
const kClosestOfReach = 1e-3;         // single precision must tell eye and target well apart
const kFarthestOfDiagonal = 60;
const kStrayOfDiagonal = 4;           // how far the target may leave the model's centre

export function from_numbers(numbers) {
    return {
        eye: numbers.slice(0, 3),
        target: numbers.slice(3, 6),
        up: numbers.slice(6, 9),
        fov: numbers[9],
    };
}

// Rounds to single precision, in which the programs compute: a camera file with these numbers is this camera.
export function to_numbers(camera) {
    return [...camera.eye, ...camera.target, ...camera.up, camera.fov].map(Math.fround);
}

export function is_camera(numbers) {
    return Array.isArray(numbers) && numbers.length === 10 && numbers.every(Number.isFinite);
}

// The shortest decimal that reads back as the same single-precision number.
export function float_text(value) {
    const wanted = Math.fround(value);
    for (let digits = 6; digits < 9; ++digits) {
        const shorter = Number(wanted.toPrecision(digits));
        if (Math.fround(shorter) === wanted) return String(shorter);
    }
    return String(Number(wanted.toPrecision(9)));
}

// Writes one line of a camera file.
export function camera_text(numbers) {
    return numbers.map(float_text).join(' ') + '\n';
}

// The limits for a camera of this model: how close, how far, and how far off. `bounds` is min and max, six
// numbers.
export function limits(bounds) {
    const low = bounds.slice(0, 3);
    const high = bounds.slice(3, 6);
    const reach = Math.max(...bounds.map(Math.abs));
    const diagonal = Math.max(length(subtract(high, low)), 1e-4 * reach, 1e-12);
    return {
        centre: scale(add(low, high), 0.5),
        closest: Math.max(kClosestOfDiagonal * diagonal, kClosestOfReach * reach),
        farthest: kFarthestOfDiagonal * diagonal,
        stray: kStrayOfDiagonal * diagonal,
    };
}

export function distance(camera) {
    return length(subtract(camera.eye, camera.target));
}

function half_height(camera) {
    return Math.tan(camera.fov * Math.PI / 360);
}

// Unit vectors of the picture: to the right, up and into it.
function axes(camera) {
    const into = normalize(subtract(camera.target, camera.eye));
    let right = cross(into, camera.up);
    if (length(right) < 1e-9) right = cross(into, Math.abs(into[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0]);
    right = normalize(right);
    return {right, up: cross(right, into), into};
}

// Moves the eye around the target, by radians: `across` to its left, so that the model turns to the right,
// and `upwards`.
export function orbit(camera, across, upwards) {
    const pole = normalize(camera.up);
    const towards = subtract(camera.eye, camera.target);
    const radius = length(towards);
    const sine = Math.min(Math.max(dot(towards, pole) / radius, -1), 1);
    const before = Math.asin(sine);
    // A camera from elsewhere may look from higher than `kHighest`; it may only come down.
    const highest = Math.max(kHighest, Math.abs(before));
    const elevation = Math.min(Math.max(before + upwards, -highest), highest);
    const {right} = axes(camera);
    const out = cross(right, pole);  // from the axis to the eye, level
    const level = subtract(scale(out, Math.cos(across)), scale(right, Math.sin(across)));
    const around = add(scale(level, Math.cos(elevation)), scale(pole, Math.sin(elevation)));
    return {...camera, eye: add(camera.target, scale(around, radius))};
}

// Moves the camera so that points at the target's distance move by `x`, `y` in the picture.
export function pan(camera, x, y, within) {
    const {right, up} = axes(camera);
    const unit = distance(camera) * half_height(camera);
    return shifted(camera, add(scale(right, -x * unit), scale(up, -y * unit)), within);
}

// Makes the point that is seen at `at`, as far away as the target, the new target.
export function centre(camera, at, within) {
    return pan(camera, -at.x, -at.y, within);
}

// Multiplies the distance by `factor`, within the limits. The point that is seen at `at`, as far away as the
// target, stays there.
export function dolly(camera, factor, at, within) {
    const before = distance(camera);
    const after = Math.min(Math.max(before * factor, within.closest), within.farthest);
    const {right, up} = axes(camera);
    const unit = before * half_height(camera);
    const seen = add(camera.target, add(scale(right, at.x * unit), scale(up, at.y * unit)));
    const about = (point) => add(seen, scale(subtract(point, seen), after / before));
    return strayed({...camera, eye: about(camera.eye), target: about(camera.target)}, within);
}

function shifted(camera, by, within) {
    return strayed({...camera, eye: add(camera.eye, by), target: add(camera.target, by)}, within);
}

// Keeps the target near the model, so that people do not lose it.
function strayed(camera, within) {
    const off = subtract(camera.target, within.centre);
    const far = length(off);
    if (far <= within.stray) return camera;
    const back = scale(off, within.stray / far - 1);
    return {...camera, eye: add(camera.eye, back), target: add(camera.target, back)};
}
