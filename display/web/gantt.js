// The last frames as a Gantt chart: a row for each machine, in it a line for each frame in flight, all on the
// client's clock. Waits are hatched red; the chain that the newest picture waited for is outlined.

import {Chart, hatch, nice_step} from './chart.js';
import {css_colour, server_colour} from './colours.js';
import {median, ms} from './format.js';
import {critical_text, is_wait, limit_of, phase_colour, server_number} from './phases.js';

const kFramesKept = 160;
const kRedrawMs = 60;  // while frames come
const kLines = 3;  // in a row; more frames in flight share lines
const kGutter = 62;
const kAxis = 18;
const kOfWindow = 0.24;  // at most this part of the window's height
const kRow = 17;
const kSmallestRow = 4;
const kFramesInView = 4;
const kShortestView = 2;  // ms
const kLongestView = 20000;

export class Gantt {
    #chart;
    #tip;
    #frames = [];
    #line_ends = new Map();  // machine to the times at which its lines are free
    #span = null;            // ms in view; null: follows the frames
    #end = null;             // right edge on the client's clock; null: follows the newest frame
    #auto_span = 100;
    #drawn = [];             // {left, top, right, bottom, span, machine, frame} of everything on the canvas
    #on_change;
    #machines = 6;
    #timer = null;

    constructor(canvas, tip, on_change) {
        this.#tip = tip;
        this.#on_change = on_change;
        this.#chart = new Chart(canvas, (...to) => this.#paint(...to));
        this.#listen(canvas);
    }

    get paused() { return this.#end !== null; }
    get frames() { return this.#frames; }

    add(frame) {
        const lines = this.#lines_of(frame);  // later frames need these, even if this one is not kept
        if (this.paused && this.#frames.length >= 2 * kFramesKept) return;
        this.#frames.push({...frame, lines, ...extent(frame.machines)});
        if (this.#frames.length > kFramesKept && !this.paused)
            this.#frames.splice(0, this.#frames.length - kFramesKept);
        if (!this.paused) this.#timer ??= setTimeout(() => {
            this.#timer = null;
            this.#fit();
        }, kRedrawMs);
    }

    forget() {
        this.#frames = [];
        this.#line_ends.clear();
        this.#end = null;
        this.#chart.redraw();
    }

    // The number of machines decides the height, not the number that took part in the last frames: the
    // picture gets the rest of the window, and must not move.
    set machines(count) {
        this.#machines = count;
        this.#fit();
    }

    pause(on) {
        this.#end = on ? this.#newest_end() : null;
        // Drops frames that came during the pause and are too old now.
        if (!on) this.#frames.splice(0, Math.max(0, this.#frames.length - kFramesKept));
        this.#fit();
        this.#on_change();
    }

    // `factor` < 1 shows less time. `about` is the part of the width that stays in place.
    zoom(factor, about = 1) {
        const before = this.#view();
        this.#span = Math.min(Math.max((before.end - before.begin) * factor, kShortestView), kLongestView);
        if (about < 1 || this.paused) {
            const fixed = before.begin + about * (before.end - before.begin);
            this.#end = fixed + (1 - about) * this.#span;
        }
        this.#fit();
        this.#on_change();
    }

    reset() {
        this.#span = null;
        this.pause(false);
    }

    redraw() { this.#fit(); }

    #move(ms_to_the_right) {
        this.#end = this.#view().end + ms_to_the_right;
        this.#fit();
        this.#on_change();
    }

    #newest_end() { return Math.max(0, ...this.#frames.slice(-8).map(({end}) => end)); }

    #view() {
        const span = this.#span ?? this.#auto_span;
        const end = this.#end ?? this.#newest_end() + 0.02 * span;
        return {begin: end - span, end};
    }

    // Puts a frame on the first of each machine's lines that is free when it begins there.
    #lines_of(frame) {
        return new Map(frame.machines.filter(({spans}) => spans.length > 0).map(({name, spans}) => {
            const begin = Math.min(...spans.map((span) => span.begin));
            const end = Math.max(...spans.map((span) => span.end));
            const ends = this.#line_ends.get(name) ?? [];
            this.#line_ends.set(name, ends);
            let line = ends.findIndex((free) => free <= begin + 0.01);
            if (line < 0) line = ends.length < kLines ? ends.length : ends.indexOf(Math.min(...ends));
            ends[line] = end;
            return [name, line];
        }));
    }

    #fit() {
        const recent = this.#frames.slice(-16);
        const newest = recent.at(-1);
        if (newest && !this.paused) {
            const pace = median(recent.map(({interval}) => interval).filter(Number.isFinite));
            const wanted = Math.max(kFramesInView * (pace || 0), 1.2 * (newest.end - newest.begin), 1);
            // The scale goes in steps, so that it stands still while frames vary.
            if (wanted > this.#auto_span || wanted < 0.4 * this.#auto_span)
                this.#auto_span = nice_step(wanted, 1);
        }
        const rows = Math.max(this.#machines, 3);
        const highest = Math.max(kOfWindow * innerHeight, 120) - kAxis;
        const row = Math.min(Math.max(Math.floor(highest / rows), kSmallestRow), kRow);
        this.#chart.canvas.style.height = `${kAxis + rows * row + 2}px`;
        this.#chart.redraw();
    }

    // Machines of the newest frames, client first, display last.
    #rows() {
        const names = new Set(this.#frames.slice(-4).flatMap(({machines}) => machines.map(({name}) => name)));
        const place = (name) => name === 'client' ? -1 : server_number(name) ?? Infinity;
        return [...names].sort((a, b) => place(a) - place(b));
    }

    #paint(context, width, height, theme) {
        const view = this.#view();
        const rows = this.#rows();
        const row = rows.length ? (height - kAxis - 2) / rows.length : 0;
        const scale = (width - kGutter) / (view.end - view.begin);
        const x = (time) => kGutter + (time - view.begin) * scale;
        this.#drawn = [];
        if (rows.length === 0) return nothing_yet(context, width, height, theme);
        const shown = this.#frames.filter(({begin, end}) => end >= view.begin && begin <= view.end);
        const origin = this.#frames.at(-1).begin;
        this.#paint_axis(context, width, height, theme, view, x, origin);

        context.save();
        context.beginPath();
        context.rect(kGutter, kAxis, width - kGutter, height - kAxis);
        context.clip();
        const waits = hatch(context, theme('--wait'));
        const lines = new Map(rows.map((name) =>
            [name, Math.max(1, ...shown.map((frame) => (frame.lines.get(name) ?? 0) + 1))]));
        const tops = new Map(rows.map((name, place) => [name, kAxis + place * row]));
        for (const frame of shown)
            for (const {name, spans} of frame.machines) {
                if (!tops.has(name)) continue;
                const pitch = (row - (row > 8 ? 3 : 1)) / lines.get(name);
                const top = tops.get(name) + (row > 8 ? 1.5 : 0.5) + pitch * (frame.lines.get(name) ?? 0);
                const bottom = top + pitch - (pitch > 4 ? 0.75 : 0);
                for (const span of spans) {
                    const left = x(span.begin);
                    const right = x(span.end);
                    if (right < kGutter || left > width) continue;
                    const drawn = {
                        left, right: Math.max(right, left + 0.6), top, bottom, span, machine: name, frame,
                    };
                    this.#drawn.push(drawn);
                    if (is_wait(span.phase)) {
                        paint_wait(context, drawn, theme, waits);
                        continue;
                    }
                    context.fillStyle = theme(phase_colour(span.phase));
                    fill(context, drawn);
                }
            }
        this.#paint_critical(context, theme, shown);
        context.restore();
        this.#paint_names(context, theme, rows, row, width);
    }

    #paint_axis(context, width, height, theme, view, x, origin) {
        const step = nice_step(view.end - view.begin, Math.max((width - kGutter) / 90, 2));
        context.textAlign = 'center';
        context.textBaseline = 'middle';
        context.lineWidth = 1;
        for (let k = Math.ceil((view.begin - origin) / step); origin + k * step <= view.end; ++k) {
            const at = Math.round(x(origin + k * step)) + 0.5;
            context.strokeStyle = theme('--grid');
            context.beginPath();
            context.moveTo(at, kAxis);
            context.lineTo(at, height);
            context.stroke();
            context.fillStyle = theme('--muted');
            const label = decimal_step(k * step, step);
            if (at > kGutter + 16 && at < width - 22) context.fillText(label, at, kAxis / 2);
        }
        context.textAlign = 'left';
        context.fillText('ms', 4, kAxis / 2);
    }

    // Adjacent parts on one machine share an outline: short ones would be all outline.
    #paint_critical(context, theme, shown) {
        const newest = [0, 1].map((stream) => shown.findLast((frame) => frame.stream === stream));
        context.strokeStyle = theme('--text');
        for (const frame of newest) {
            const runs = [];
            for (const part of frame?.critical ?? []) {
                const drawn = this.#drawn.find((one) => one.frame === frame && one.machine === part.machine &&
                    one.span.begin <= part.begin + 0.01 && one.span.end >= part.end - 0.01);
                if (!drawn) continue;
                const {machine, left, right, top, bottom} = drawn;
                const last = runs.at(-1);
                if (last?.machine === machine && left - last.right < 2)
                    last.right = Math.max(right, last.right);
                else
                    runs.push({machine, left, right, top, bottom});
            }
            context.lineWidth = 1.5;
            for (const {left, right, top, bottom} of runs)
                context.strokeRect(left, top, Math.max(right - left, 1), bottom - top);
            context.lineWidth = 1;
            context.beginPath();
            for (let k = 1; k < runs.length; ++k) {
                context.moveTo(runs[k - 1].right, (runs[k - 1].top + runs[k - 1].bottom) / 2);
                context.lineTo(runs[k].left, (runs[k].top + runs[k].bottom) / 2);
            }
            context.stroke();
        }
    }

    #paint_names(context, theme, rows, row, width) {
        const every = Math.ceil(11 / row);
        context.textAlign = 'left';
        context.textBaseline = 'middle';
        rows.forEach((name, place) => {
            const top = kAxis + place * row;
            context.fillStyle = theme('--grid');
            context.fillRect(0, Math.round(top), width, 1);
            const server = server_number(name);
            if (server !== null) {
                context.fillStyle = css_colour(server_colour(server));
                context.fillRect(0, top + Math.min(2, row / 4), 4, row - Math.min(4, row / 2) + 1);
            }
            if (place % every) return;
            context.fillStyle = theme('--text');
            context.fillText(name, 9, top + row * every / 2 - (every > 1 ? row * (every - 1) / 2 : 0) + 0.5);
        });
    }

    #listen(canvas) {
        let dragged_from = null;
        const per_pixel = () => {
            const {begin, end} = this.#view();
            return (end - begin) / Math.max(canvas.clientWidth - kGutter, 1);
        };
        canvas.addEventListener('pointerdown', (event) => {
            if (event.pointerType === 'mouse' && event.button !== 0) return;
            dragged_from = event.clientX;
            canvas.setPointerCapture(event.pointerId);
        });
        canvas.addEventListener('pointermove', (event) => {
            if (dragged_from !== null && Math.abs(event.clientX - dragged_from) > 2) {
                this.#move((dragged_from - event.clientX) * per_pixel());
                dragged_from = event.clientX;
            }
        });
        canvas.addEventListener('pointerup', () => dragged_from = null);
        canvas.addEventListener('pointercancel', () => dragged_from = null);
        this.#tip.attach(canvas, (event) => this.#hover(event));
        canvas.addEventListener('wheel', (event) => {
            event.preventDefault();
            if (Math.abs(event.deltaX) > Math.abs(event.deltaY))
                return this.#move(event.deltaX * per_pixel());
            const about = (event.offsetX - kGutter) / Math.max(canvas.clientWidth - kGutter, 1);
            const factor = Math.exp(Math.min(Math.max(event.deltaY * 0.0015, -1), 1));
            // At the newest end the chart goes on following.
            this.zoom(factor, this.paused || about < 0.9 ? Math.min(Math.max(about, 0), 0.999) : 1);
        }, {passive: false});
        canvas.addEventListener('keydown', (event) => {
            const {begin, end} = this.#view();
            const keys = {
                ArrowLeft: () => this.#move((begin - end) / 8),
                ArrowRight: () => this.#move((end - begin) / 8),
                '+': () => this.zoom(0.7), '=': () => this.zoom(0.7), '-': () => this.zoom(1 / 0.7),
                ' ': () => this.pause(!this.paused), Home: () => this.reset(),
            };
            if (!keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
            keys[event.key]();
            event.preventDefault();
            event.stopPropagation();
        });
    }

    #hover(event) {
        const {offsetX: x, offsetY: y} = event;
        const hit = this.#drawn.findLast(({left, right, top, bottom}) =>
            x >= left - 1 && x <= right + 1 && y >= top && y <= bottom + 1);
        if (!hit) return this.#tip.hide();
        const {span, machine, frame} = hit;
        const stream = frame.stream ? ' (B)' : '';
        this.#tip.show(event.clientX, event.clientY, `${machine} · ${span.phase}`, [
            [`frame`, `${frame.frame}${stream}, ${frame.algorithm}`],
            [`time`, ms(span.end - span.begin)],
            [`CPU`, span.cpu > 0 ? ms(span.cpu) : '–'],
            [`from frame begin`, ms(span.begin - frame.begin)],
        ]);
    }
}

// The critical path of a frame in words, with its time; '' if it is not known.
export function critical_summary(frame, least = 0) {
    if (!frame?.critical?.length) return '';
    const took = frame.critical.at(-1).end - frame.critical[0].begin;
    const limit = limit_of(frame.critical);
    return `${ms(took)}${limit && `, mostly ${limit}`}: ${critical_text(frame.critical, least)}`;
}

function extent(machines) {
    const spans = machines.flatMap(({spans}) => spans);
    return {
        begin: spans.reduce((least, {begin}) => Math.min(least, begin), Infinity),
        end: spans.reduce((most, {end}) => Math.max(most, end), -Infinity),
    };
}

// Waits are thinner than work: with several frames in flight there are many that hold up nobody.
function paint_wait(context, {left, right, top, bottom}, theme, pattern) {
    const high = bottom - top;
    const thin = Math.max(0.5 * high, Math.min(high, 1.5));
    const strip = {left, right, top: top + (high - thin) / 2, bottom: top + (high + thin) / 2};
    context.fillStyle = theme('--wait-soft');
    fill(context, strip);
    context.fillStyle = pattern;
    fill(context, strip);
}

function fill(context, {left, right, top, bottom}) {
    context.fillRect(left, top, right - left, bottom - top);
}

function decimal_step(value, step) {
    return value.toFixed(Math.max(0, -Math.floor(Math.log10(step)))).replace('-', '−');
}

function nothing_yet(context, width, height, theme) {
    context.fillStyle = theme('--muted');
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    context.fillText('No frames yet', width / 2, height / 2);
}

