// One frame as stacked bars, one for each machine, as in Samanta 2000, figure 8: the time of each phase, and
// in outline over it the prediction. Two streams are two groups of bars on one scale.

import {Chart, nice_step} from './chart.js';
import {css_colour, server_colour} from './colours.js';
import {ms} from './format.js';
import {by_phase, is_wait, kPhases, phase_colour, server_number} from './phases.js';

const kLeft = 34;
const kBottom = 18;
const kTop = 8;
const kTallEnough = 5;  // to get a mark

// Measured and predicted times of a `frame` note's machines: [{name, measured, predicted}]. Both are Maps of
// phase to ms without waits; predicted is null while nobody knows.
export function costs(frame) {
    const predictions = new Map(frame.prediction?.machines?.map(({name, phases}) => [name, phases]) ?? []);
    return frame.machines.map(({name, spans, counters}) => {
        const busy = by_phase(spans.filter(({phase}) => !is_wait(phase)));
        const cpu = by_phase(spans, (span) => span.cpu ?? 0);
        const predicted = predictions.get(name);
        return {
            name,
            counters: counters ?? {},
            measured: busy,
            cpu,
            predicted: predicted
                ? new Map(Object.entries(predicted).filter(([phase, cost]) => !is_wait(phase) && cost > 0))
                : null,
        };
    });
}

export const total = (phases) => [...phases.values()].reduce((sum, cost) => sum + cost, 0);

export class Bars {
    #chart;
    #tip;
    #frames = [];
    #top = 1;    // end of the scale, ms
    #drawn = [];  // {left, right, cost} of each bar

    constructor(canvas, tip) {
        this.#tip = tip;
        this.#chart = new Chart(canvas, (...to) => this.#paint(...to));
        tip.attach(canvas, (event) => this.#hover(event));
    }

    // Takes the newest `frame` note of each stream.
    show(frames) {
        this.#frames = frames.map((frame) => ({frame, costs: costs(frame)}));
        this.#chart.redraw();
    }

    #paint(context, width, height, theme) {
        this.#drawn = [];
        if (this.#frames.length === 0) {
            context.fillStyle = theme('--muted');
            context.textAlign = 'center';
            context.fillText('No frames yet', width / 2, height / 2);
            return;
        }
        const all = this.#frames.flatMap((one) => one.costs);
        const highest = Math.max(1e-3, ...all.flatMap(({measured, predicted}) =>
            [total(measured), predicted ? total(predicted) : 0]));
        // The scale waits before it shrinks, so that bars move and not the axis.
        if (highest > this.#top || highest < 0.45 * this.#top) this.#top = 1.12 * highest;
        const step = nice_step(this.#top, 4);
        const bottom = height - kBottom;
        const y = (cost) => bottom - cost / this.#top * (bottom - kTop);

        context.textBaseline = 'middle';
        context.textAlign = 'right';
        for (let at = 0; at <= this.#top; at += step) {
            context.fillStyle = theme('--grid');
            context.fillRect(kLeft, Math.round(y(at)), width - kLeft, 1);
            context.fillStyle = theme('--muted');
            context.fillText(at === 0 ? 'ms' : Number(at.toPrecision(6)), kLeft - 5, y(at));
        }

        const gap = this.#frames.length > 1 ? 18 : 0;
        const pitch = Math.min((width - kLeft - gap) / all.length, 46);
        let left = kLeft + 2;
        for (const {frame, costs: bars} of this.#frames) {
            bars.forEach((cost, place) =>
                this.#paint_bar(context, theme, cost, left + place * pitch, pitch, y));
            if (gap && frame.stream === 0) {
                context.fillStyle = theme('--line');
                const middle = Math.round(left + bars.length * pitch + gap / 2 - 1);
                context.fillRect(middle, kTop, 1, bottom - kTop);
            }
            left += bars.length * pitch + gap;
        }
    }

    #paint_bar(context, theme, cost, left, pitch, y) {
        const thickness = Math.max(pitch - Math.max(pitch * 0.3, 1), 1);
        const begin = left + (pitch - thickness) / 2;
        this.#drawn.push({left, right: left + pitch, cost});
        let sum = 0;
        for (const [phase, part] of in_order(cost.measured)) {
            const base = y(sum);
            const top = y(sum += part);
            context.fillStyle = theme(phase_colour(phase));
            // A part that is tall enough has a gap of the paper's colour above it.
            context.fillRect(begin, top, thickness, Math.max(base - top - (base - top > 3 ? 1 : 0), 0.5));
        }
        if (cost.predicted) {
            context.strokeStyle = theme('--text');
            context.lineWidth = 1.25;
            const out = Math.min(3, pitch * 0.1);
            const peak = y(total(cost.predicted));
            context.strokeRect(begin - out, peak, thickness + 2 * out, y(0) - peak);
            sum = 0;
            context.beginPath();
            for (const [, part] of in_order(cost.predicted)) {
                const base = y(sum);
                const at = y(sum += part);
                if (base - at < kTallEnough) continue;
                context.moveTo(begin - out, at);
                context.lineTo(begin - out + Math.min(6, thickness / 3), at);
                context.moveTo(begin + thickness + out, at);
                context.lineTo(begin + thickness + out - Math.min(6, thickness / 3), at);
            }
            context.stroke();
        }
        const server = server_number(cost.name);
        const below = y(0) + 3;
        if (server !== null) {
            context.fillStyle = css_colour(server_colour(server));
            context.fillRect(begin, below, thickness, 2.5);
        }
        context.textAlign = 'center';
        context.fillStyle = theme('--muted');
        const label = server ?? {client: 'C', display: 'D'}[cost.name] ?? cost.name;
        if (pitch >= 14 || server === null || server % Math.ceil(16 / pitch) === 0)
            context.fillText(label, begin + thickness / 2, below + 10);
    }

    #hover(event) {
        const hit = this.#drawn.find(({left, right}) => event.offsetX >= left && event.offsetX < right);
        if (!hit) return this.#tip.hide();
        const {name, measured, predicted, cpu} = hit.cost;
        const phases = in_order(new Map([...(predicted ?? []), ...measured])).map(([phase]) => phase);
        this.#tip.show(event.clientX, event.clientY, name, [
            ...phases.map((phase) => [phase, ms(measured.get(phase) ?? 0), extra(phase, cpu, predicted)]),
            ['all', ms(total(measured)), predicted ? `predicted ${ms(total(predicted))}` : ''],
        ]);
    }
}

function extra(phase, cpu, predicted) {
    const parts = [];
    if (cpu.get(phase) > 0) parts.push(`CPU ${ms(cpu.get(phase))}`);
    if (predicted) parts.push(`predicted ${ms(predicted.get(phase) ?? 0)}`);
    return parts.join(', ');
}

export function in_order(phases) {
    const place = (phase) => (kPhases.indexOf(phase) + 100) % 100;  // unknown phases go last
    return [...phases].sort(([a], [b]) => place(a) - place(b));
}
