// Turns mouse, touch and keys on a picture into steps of the camera. Knows no camera and no wish.

const kTurnPerHeight = Math.PI;  // radians of a drag over the whole height
const kTurnPerKey = Math.PI / 36;
const kPanPerKey = 0.1;  // of half the height
const kZoomPerKey = 0.87;
const kZoomPerWheelPixel = 0.0015;
const kZoomPerPinchPixel = 0.01;  // a trackpad's pinch comes as a wheel with Ctrl
const kPixelsPerLine = 20;

// Steps, each with the event's time: on.orbit(across, upwards, time) in radians, on.pan(x, y, time) and
// on.dolly(factor, at, time), on.centre(at, time) with positions as in camera.js. `area` takes the events,
// `canvas` has the picture. on.hover(x, y) gets the mouse's position on the page, on.hover(null) says that it
// left.
export function attach_gestures(area, canvas, on) {
    const pointers = new Map();  // id to {x, y, panning}

    const half_height = () => Math.max(canvas.getBoundingClientRect().height / 2, 1);
    const place = (x, y) => {
        const box = canvas.getBoundingClientRect();
        const half = Math.max(box.height / 2, 1);
        return {x: (x - box.left - box.width / 2) / half, y: (box.top + box.height / 2 - y) / half};
    };

    area.addEventListener('pointerdown', (event) => {
        if (event.pointerType === 'mouse' && event.button > 2) return;
        area.setPointerCapture(event.pointerId);
        pointers.set(event.pointerId, {
            x: event.clientX, y: event.clientY, panning: event.button !== 0 || event.shiftKey,
        });
        area.classList.add('dragging');
        on.hover(null);
    });

    area.addEventListener('pointermove', (event) => {
        const pointer = pointers.get(event.pointerId);
        if (!pointer) {
            if (event.pointerType === 'mouse') on.hover(event.clientX, event.clientY);
            return;
        }
        const dx = event.clientX - pointer.x;
        const dy = event.clientY - pointer.y;
        if (dx === 0 && dy === 0) return;
        const half = half_height();
        if (pointers.size === 1) {
            if (pointer.panning || event.shiftKey) on.pan(dx / half, -dy / half, event.timeStamp);
            else on.orbit(dx / half / 2 * kTurnPerHeight, dy / half / 2 * kTurnPerHeight, event.timeStamp);
        } else if (pointers.size === 2) {
            const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
            const before = Math.hypot(pointer.x - other.x, pointer.y - other.y);
            const after = Math.hypot(event.clientX - other.x, event.clientY - other.y);
            on.pan(dx / half / 2, -dy / half / 2, event.timeStamp);
            if (before > 1 && after > 1) {
                const middle = place((event.clientX + other.x) / 2, (event.clientY + other.y) / 2);
                on.dolly(before / after, middle, event.timeStamp);
            }
        }
        pointer.x = event.clientX;
        pointer.y = event.clientY;
    });

    for (const kind of ['pointerup', 'pointercancel', 'lostpointercapture'])
        area.addEventListener(kind, (event) => {
            pointers.delete(event.pointerId);
            if (pointers.size === 0) area.classList.remove('dragging');
        });
    area.addEventListener('pointerleave', () => on.hover(null));
    area.addEventListener('contextmenu', (event) => event.preventDefault());
    area.addEventListener('dblclick', (event) =>
        on.centre(place(event.clientX, event.clientY), event.timeStamp));
    area.addEventListener('wheel', (event) => {
        event.preventDefault();
        const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : kPixelsPerLine);
        const rate = event.ctrlKey ? kZoomPerPinchPixel : kZoomPerWheelPixel;
        on.dolly(Math.exp(Math.min(Math.max(pixels * rate, -1), 1)), place(event.clientX, event.clientY),
                 event.timeStamp);
    }, {passive: false});
}

// Steers by a key; returns false if the key is for something else.
export function steer_by_key(event, on) {
    const time = event.timeStamp;
    const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    const arrow = arrows[event.key];
    if (arrow && event.shiftKey) on.pan(arrow[0] * kPanPerKey, arrow[1] * kPanPerKey, time);
    // The model turns in the arrow's direction, as it does under the mouse.
    else if (arrow) on.orbit(arrow[0] * kTurnPerKey, -arrow[1] * kTurnPerKey, time);
    else if (event.key === '+' || event.key === '=') on.dolly(kZoomPerKey, {x: 0, y: 0}, time);
    else if (event.key === '-' || event.key === '_') on.dolly(1 / kZoomPerKey, {x: 0, y: 0}, time);
    else return false;
    return true;
}
