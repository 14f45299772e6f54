// Lays out the pictures: their size on the page and in pixels, the overlays, and the tip under the pointer.
// One cell for each stream.

import {compact, plural, times, whole} from './format.js';
import {area, owner_at} from './geometry.js';
import {draw_overlays, groups_of, kMostBoxes, kMostWhileMoving} from './overlays.js';
import {Stream} from './stream.js';

const kSmallest = 16;  // pixels of a picture that it asks for
const kMostRows = 14;  // in a tip

export class Stage {
    #cells;
    #tip;
    #show = new Set();
    #objects = null;
    #frames = [null, null];  // the newest `frame` note of each stream
    #hot = [null, null];

    // Calls on.shown(header), on.drawn(stream number, stream), on.resized().
    constructor(tip, on) {
        this.#tip = tip;
        this.#cells = [0, 1].map((number) => {
            const element = document.getElementById(`cell-${number}`);
            const overlay = document.getElementById(`overlay-${number}`);
            const stream = new Stream(document.getElementById(`picture-${number}`), {
                shown: on.shown,
                drawn: () => {
                    this.#place(this.#cells[number]);
                    this.redraw(number);
                    on.drawn(number, stream);
                },
            });
            const caption = document.getElementById(`caption-${number}`);
            return {element, overlay, stream, caption, box: [0, 0]};
        });
        const observer = new ResizeObserver((entries) => {
            for (const entry of entries) {
                const cell = this.#cells.find(({element}) => element === entry.target);
                cell.box = device_pixels(entry);
                this.#place(cell);
                this.redraw(this.#cells.indexOf(cell));
            }
            on.resized();
        });
        for (const {element} of this.#cells) {
            try {
                observer.observe(element, {box: 'device-pixel-content-box'});
            } catch {
                observer.observe(element);  // browsers that do not know that box
            }
        }
    }

    get show() { return this.#show; }
    get split() { return !this.#cells[1].element.hidden; }
    stream(number) { return this.#cells[number].stream; }
    cell(number) { return this.#cells[number].element; }

    set objects(note) {
        this.#objects = note;
        this.redraw();
    }

    set background(colour) {
        if (/^#[0-9a-f]{6}$/i.test(colour))
            for (const {element} of this.#cells) element.style.setProperty('--picture-ground', colour);
    }

    set stale(on) { for (const {element} of this.#cells) element.classList.toggle('stale', on); }

    // Two pictures side by side, or one.
    set split(on) {
        if (on === this.split) return;
        this.#cells[1].element.hidden = !on;
        if (!on) this.#cells[1].stream.forget();
        this.redraw();
    }

    frame(note) {
        this.#frames[note.stream] = note;
        this.#write_caption(note.stream);
    }

    toggle(layer) {
        if (!this.#show.delete(layer)) this.#show.add(layer);
        this.#hot = [null, null];
        this.redraw();
        return this.#show.has(layer);
    }

    forget() {
        for (const {stream} of this.#cells) stream.forget();
        this.#frames = [null, null];
        this.#objects = null;
        this.redraw();
    }

    // The size of a picture that suits a cell, in pixels, times `part`.
    fitting(part) {
        return this.#cells[0].box.map((pixels) => Math.max(Math.floor(pixels * part), kSmallest));
    }

    redraw(number = null) {
        for (const at of number === null ? [0, 1] : [number]) {
            const {overlay, stream} = this.#cells[at];
            draw_overlays(overlay, stream.plan, this.#objects, this.#show, this.#hot[at],
                          stream.drawn?.header.format === 'png');
            this.#write_caption(at);
        }
    }

    // Shows what lies at this position of the page as a tip and an outline; null hides them.
    hover(number, x, y) {
        const {stream} = this.#cells[number];
        const plan = stream.plan;
        const server = x === null || this.#show.size === 0 || !plan ? -1 : this.#server_at(number, x, y);
        const hot = server < 0 ? null : server;
        if (hot !== this.#hot[number]) {
            this.#hot[number] = hot;
            this.redraw(number);
        }
        if (hot === null) return this.#tip.hide();
        this.#tip.show(x, y, `server ${server}`, server_rows(plan, server, this.#frames[number]));
    }

    #server_at(number, x, y) {
        const {stream} = this.#cells[number];
        const box = stream.canvas.getBoundingClientRect();
        const {width, height, tiles} = stream.plan;
        return owner_at(tiles, (x - box.left) / box.width * width, (box.bottom - y) / box.height * height);
    }

    // Puts the picture into its cell, on whole device pixels, and pixel for pixel if the size allows.
    #place({stream, overlay, box}) {
        const {width, height} = stream.size();
        if (!stream.drawn || box[0] === 0) return;
        const scale = Math.min(box[0] / width, box[1] / height);
        const fits = width <= box[0] && height <= box[1];
        const exact = fits && (scale - 1) * Math.max(width, height) < 2;
        const pixels = exact ? [width, height] : [width, height].map((length) => Math.round(length * scale));
        const corner = pixels.map((length, axis) => Math.floor((box[axis] - length) / 2));
        for (const {style} of [stream.canvas, overlay]) {
            style.width = `${pixels[0] / devicePixelRatio}px`;
            style.height = `${pixels[1] / devicePixelRatio}px`;
            style.transform = `translate(${corner.map((at) => `${at / devicePixelRatio}px`).join(', ')})`;
        }
        if (overlay.width !== pixels[0]) overlay.width = pixels[0];
        if (overlay.height !== pixels[1]) overlay.height = pixels[1];
    }

    // Says why boxes that are wanted are missing; an empty list if they are not.
    #why_no_boxes(plan, format) {
        const {boxes, count, generation} = this.#objects ?? {};
        if (generation !== plan.generation) return ['boxes are on their way'];
        if (!boxes || count > kMostBoxes) return [`${plural(count, 'object')}: too many for boxes`];
        if (count > kMostWhileMoving && format !== 'png') return ['boxes when it rests'];
        const needs_groups = this.#show.has('groups') || this.#show.has('overlap');
        return needs_groups && !plan.groups ? ['too many objects for groups'] : [];
    }

    #write_caption(number) {
        const {stream, caption} = this.#cells[number];
        const plan = stream.plan;
        const note = this.#frames[number];
        const parts = [];
        if (plan && this.split) {
            parts.push(`${'AB'[number]}: ${plan.algorithm}`);
            const busiest = note ? busiest_ms(note) : 0;
            if (busiest > 0) parts.push(`busiest ${whole(busiest)} ms`);
        }
        if (plan && (this.split || this.#show.has('overlap')))
            parts.push(`overlap ${times(plan.overlap ?? 1)}`);
        if (plan && (this.split || this.#show.has('swaths')))
            parts.push(`swaths ${compact(plan.links.reduce((sum, link) => sum + area(link.rectangles), 0))}`);
        if (plan && ['groups', 'boxes', 'overlap'].some((layer) => this.#show.has(layer)))
            parts.push(...this.#why_no_boxes(plan, stream.drawn.header.format));
        const text = parts.join(' · ');
        if (caption.textContent !== text) caption.textContent = text;
        caption.hidden = text === '';
    }
}

// The exact number of device pixels, which only this box knows if the pixel ratio is no whole number; unless
// it contradicts the ratio, as it does while a browser emulates another device.
function device_pixels({contentRect, devicePixelContentBoxSize}) {
    const computed = [contentRect.width, contentRect.height].map((length) => length * devicePixelRatio);
    const exact = devicePixelContentBoxSize?.[0];
    const pixels = exact ? [exact.inlineSize, exact.blockSize] : computed;
    return pixels.map((count, axis) =>
        Math.abs(count - computed[axis]) <= 1 ? count : Math.floor(computed[axis]));
}

// The busy time of the busiest machine.
export function busiest_ms(frame) {
    return Math.max(0, ...frame.machines.map(({spans}) => spans.reduce(
        (sum, {phase, begin, end}) => phase === 'wait' ? sum : sum + end - begin, 0)));
}

function server_rows(plan, server, frame) {
    const {links} = plan;
    const counters = frame?.machines.find(({name}) => name === `server ${server}`)?.counters ?? {};
    const rows = [['tile', `${whole(area(plan.tiles[server]))} pixels`]];
    const objects = groups_of(plan)?.[server]?.length;
    if (counters.triangles !== undefined) rows.push(['draws', plural(counters.triangles, 'triangle')]);
    if (objects !== undefined) rows.push(['group', plural(objects, 'object')]);
    for (const {from, to, rectangles} of links)
        if (from === server) rows.push([`sends to ${to}`, `${whole(area(rectangles))} pixels`]);
    for (const {from, to, rectangles} of links)
        if (to === server) rows.push([`receives from ${from}`, `${whole(area(rectangles))} pixels`]);
    const left_out = rows.length - kMostRows;
    if (left_out > 0) rows.splice(kMostRows, left_out, ['and', plural(left_out, 'link')]);
    if (counters.swap_pixels !== undefined)
        rows.push(['sent, not empty', `${whole(counters.swap_pixels)} pixels`]);
    if (counters.received_pixels !== undefined)
        rows.push(['received, not empty', `${whole(counters.received_pixels)} pixels`]);
    return rows;
}
