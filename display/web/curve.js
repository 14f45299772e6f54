// Speed-ups by number of servers: measured by frame time and by the CPU time of the busiest server,
// predicted, and ideal. Also the small curve of the lag.

import {Chart, nice_step} from './chart.js';
import {decimal, plural, times} from './format.js';

const kLeft = 30;
const kBottom = 20;
const kTop = 8;
const kRight = 10;

export const kSeries = [
    {name: 'frame time', field: 'interval', colour: '--curve-interval', shape: 'circle', line: []},
    {name: 'busiest CPU', field: 'busiest_cpu', colour: '--curve-cpu', shape: 'square', line: []},
    {name: 'predicted', field: 'predicted', colour: '--curve-predicted', shape: 'diamond', line: [4, 3]},
];

// The quotient by the point with one server, if both are known.
export function speedups(points, field) {
    const one = points.find(({servers}) => servers === 1)?.[field];
    if (!(one > 0)) return [];
    return points.filter((point) => point[field] > 0)
        .map((point) => ({servers: point.servers, speedup: one / point[field]}))
        .sort((a, b) => a.servers - b.servers);
}

export class Curve {
    #chart;
    #tip;
    #note = null;
    #columns = [];
    #servers = 2;

    constructor(canvas, tip) {
        this.#tip = tip;
        this.#chart = new Chart(canvas, (...to) => this.#paint(...to));
        tip.attach(canvas, (event) => this.#hover(event));
    }

    // The number of servers in the run: the axis always reaches that far.
    set servers(count) {
        this.#servers = count;
        this.#chart.redraw();
    }

    show(note) {
        this.#note = note;
        this.#chart.redraw();
    }

    #paint(context, width, height, theme) {
        const points = this.#note?.points ?? [];
        const most = Math.max(2, this.#servers, ...points.map(({servers}) => servers));
        const series = kSeries.map((one) => ({...one, points: speedups(points, one.field)}));
        const highest = Math.max(most, ...series.flatMap((one) => one.points.map(({speedup}) => speedup)));
        const x = (servers) => kLeft + (servers - 1) / (most - 1) * (width - kLeft - kRight);
        const y = (speedup) => height - kBottom - speedup / highest * (height - kBottom - kTop);
        this.#columns = points.map(({servers}) => ({servers, x: x(servers)}));

        context.textBaseline = 'middle';
        context.textAlign = 'right';
        const step = Math.max(nice_step(highest, 4), 1);
        for (let at = 0; at <= highest; at += step) {
            context.fillStyle = theme('--grid');
            context.fillRect(kLeft, Math.round(y(at)), width - kLeft - kRight, 1);
            context.fillStyle = theme('--muted');
            context.fillText(at, kLeft - 6, y(at));
        }
        context.textAlign = 'center';
        const across = Math.max(Math.ceil((most - 1) / 8), 1);
        for (let servers = 1; servers <= most; servers += across)
            context.fillText(servers, x(servers), height - kBottom / 2 + 1);

        context.strokeStyle = theme('--muted');
        context.lineWidth = 1;
        context.setLineDash([2, 3]);
        line(context, [[x(1), y(1)], [x(most), y(most)]]);
        for (const {points: list, colour, shape, line: dash} of series) {
            context.strokeStyle = context.fillStyle = theme(colour);
            context.lineWidth = 1.75;
            context.setLineDash(dash);
            line(context, list.map(({servers, speedup}) => [x(servers), y(speedup)]));
            context.setLineDash([]);
            for (const {servers, speedup} of list)
                mark(context, shape, x(servers), y(speedup), theme('--surface'));
        }
    }

    #hover(event) {
        const off = (column) => Math.abs(column.x - event.offsetX);
        const nearest = this.#columns.reduce((best, column) =>
            !best || off(column) < off(best) ? column : best, null);
        if (!nearest) return this.#tip.hide();
        const here = ({servers}) => servers === nearest.servers;
        this.#tip.show(event.clientX, event.clientY, plural(nearest.servers, 'server'),
            kSeries.map(({name, field}) => {
                const point = this.#note.points.find(here);
                const quotient = speedups(this.#note.points, field).find(here);
                return [name, quotient ? times(quotient.speedup) : '–',
                        point?.[field] > 0 ? `${decimal(point[field])} ms` : ''];
            }));
    }
}

// The last values as a line that fills the canvas, from zero up.
export class Sparkline {
    #chart;
    #values = [];
    #kept;

    constructor(canvas, kept = 60) {
        this.#kept = kept;
        this.#chart = new Chart(canvas, (context, width, height, theme) => {
            if (this.#values.length < 2) return;
            const highest = Math.max(...this.#values, 1);
            const points = this.#values.map((value, place) => [
                width - 1.5 - (this.#values.length - 1 - place) * (width - 3) / (kept - 1),
                height - 2 - value / highest * (height - 4),
            ]);
            context.strokeStyle = theme('--accent');
            context.lineWidth = 1.25;
            context.lineJoin = 'round';
            line(context, points);
            context.fillStyle = theme('--accent');
            context.beginPath();
            context.arc(...points.at(-1), 1.75, 0, 2 * Math.PI);
            context.fill();
        });
    }

    add(value) {
        this.#values.push(value);
        if (this.#values.length > this.#kept) this.#values.shift();
        this.#chart.redraw();
    }
}

function line(context, points) {
    context.beginPath();
    for (const point of points) context.lineTo(...point);
    context.stroke();
}

function mark(context, shape, x, y, inside) {
    const r = 3.5;
    context.beginPath();
    if (shape === 'circle') context.arc(x, y, r, 0, 2 * Math.PI);
    else if (shape === 'square') context.rect(x - r + 0.5, y - r + 0.5, 2 * r - 1, 2 * r - 1);
    else {
        context.moveTo(x, y - r - 0.5);
        context.lineTo(x + r + 0.5, y);
        context.lineTo(x, y + r + 0.5);
        context.lineTo(x - r - 0.5, y);
        context.closePath();
        context.save();
        context.fillStyle = inside;
        context.fill();
        context.restore();
        context.lineWidth = 1.25;
        context.stroke();
        return;
    }
    context.fill();
}
