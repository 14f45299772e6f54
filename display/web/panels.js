// Shows frames, links and speed-ups in the panel: as charts, tables and words.

import {costs, in_order, total} from './bars.js';
import {css_colour, server_colour} from './colours.js';
import {kSeries, speedups} from './curve.js';
import {compact, decimal, ms, plural, times, whole} from './format.js';
import {area} from './geometry.js';
import {groups_of} from './overlays.js';
import {kMeanings, kPhases, phase_colour, server_number} from './phases.js';
import {fill_rows, fill_table} from './tables.js';

const at = (id) => document.getElementById(id);

function set_text(id, text) {
    const element = at(id);
    if (element.textContent !== text) element.textContent = text;
}

export function show_legends() {
    at('phases').replaceChildren(...kPhases.map((phase) => {
        const item = legend(phase, phase_colour(phase));
        item.title = kMeanings.get(phase);
        return item;
    }));
    fill_rows(at('help-phases').tBodies[0], [...kMeanings]);
    at('curve-key').replaceChildren(
        ...kSeries.map(({name, colour, line}) => legend(name, colour, line.length ? 'line dashed' : 'line')),
        legend('ideal', '--muted', 'line dotted'));
}

function legend(text, colour, kind = '') {
    const item = document.createElement('li');
    const mark = document.createElement('i');
    mark.className = kind;
    mark.style[kind ? 'borderColor' : 'background'] = `var(${colour})`;
    item.append(mark, text);
    return item;
}

// Takes the newest `frame` note of each stream that is shown, and in `compared` the newest with other
// algorithms.
export function show_frames(frames, compared) {
    const first = frames[0];
    const algorithms = frames.map(({algorithm}) => algorithm).join(' and ');
    set_text('frame-note', first ? `${first.frame} · ${algorithms}` : '');
    set_text('prediction-state', !first ? '' : first.prediction
        ? `: ${frames.map((frame) => frame.prediction ? ms(frame.prediction.frame) : '–').join(' and ')}`
        : ': not known yet');
    if (!first) {
        at('frame-table').tHead?.remove();
        at('frame-table').tBodies[0]?.remove();
    }
    const columns = frames.flatMap((frame) => costs(frame).map((cost) => ({
        ...cost, title: frames.length > 1 ? `${'AB'[frame.stream]} ${short(cost.name)}` : short(cost.name),
    })));
    const phases = in_order(new Map(columns.flatMap(({measured, predicted}) =>
        [...measured, ...(predicted ?? [])]))).map(([phase]) => phase);
    const known = columns.some(({predicted}) => predicted);
    const counted = [...new Set(columns.flatMap(({counters}) => Object.keys(counters)))];
    const value = (map, phase) => map?.get(phase) > 0 ? decimal(map.get(phase)) : '';
    if (first)
        fill_table(at('frame-table'), ['ms', ...columns.map(({title}) => title)], [
            ...phases.flatMap((phase) => [
                [phase, ...columns.map(({measured}) => value(measured, phase))],
                ...(known ? [[
                    `${phase}, predicted`, ...columns.map(({predicted}) => value(predicted, phase)),
                ]] : []),
            ]),
            ['all', ...columns.map(({measured}) => decimal(total(measured)))],
            ...(known ? [['all, predicted', ...columns.map(({predicted}) =>
                predicted ? decimal(total(predicted)) : '')]] : []),
            ['all, CPU', ...columns.map(({cpu}) => total(cpu) > 0 ? decimal(total(cpu)) : '')],
            ...counted.map((counter) => [counter.replaceAll('_', ' '), ...columns.map(({counters}) =>
                counters[counter] === undefined ? '' : whole(counters[counter]))]),
        ]);
    const spent = columns.map(({name, measured}) => `${name} ${ms(total(measured))}`);
    at('bars').setAttribute('aria-label', first
        ? `What each machine spent: ${spent.join(', ')}`
        : 'What each machine spent on each phase; no frames yet');
    show_others(compared);
}

const short = (name) => server_number(name) ?? name;

// Ratios are to the algorithm of their note, which may not be the one in use.
function show_others(note) {
    const others = note?.others ?? [];
    const table = at('predictions');
    fill_table(table, ['Algorithm', 'Frame', 'Compared', 'Overlap', 'Swaps'], others.map((other) => [
        other.algorithm,
        ms(other.frame),
        other.algorithm === note.algorithm ? 'in use' : `${other.ratio.toFixed(1)}× as long`,
        other.overlap.toFixed(2),
        compact(other.swap_pixels),
    ]));
    const body = table.tBodies[0];
    [...body.rows].forEach((row, place) =>
        row.classList.toggle('current', others[place].algorithm === note.algorithm));
    if (!others.length) {
        fill_table(table, ['Algorithm'], [['Not known yet: it takes a few frames']]);
    }
}

// Shows what servers exchange: {plan, frame} of each stream that is shown.
export function show_links(streams) {
    const rows = [];
    let sent = 0;
    let swapped = 0;
    for (const {plan, frame, title} of streams) {
        const groups = groups_of(plan);
        plan.tiles.forEach((tile, server) => {
            const counters = frame?.machines.find(({name}) => name === `server ${server}`)?.counters ?? {};
            const of = (end) => (plan.links ?? []).filter((link) => link[end] === server)
                .reduce((sum, link) => sum + area(link.rectangles), 0);
            sent += of('from');
            swapped += counters.swap_pixels ?? 0;
            rows.push({server, cells: [
                `${title}${server}`,
                compact(area(tile)),
                groups ? whole(groups[server]?.length ?? 0) : '–',
                counters.triangles === undefined ? '–' : compact(counters.triangles),
                compact(of('from')),
                compact(of('to')),
            ]});
        });
    }
    set_text('links-note', streams.length ? `${compact(sent)} pixels in swaths, ${compact(swapped)} swapped` : '');
    fill_table(at('links'),
        ['Server', 'Tile', 'Objects', 'Triangles', 'Sends', 'Receives'],
        rows.map(({cells}) => cells));
    colour_rows(at('links'), rows.map(({server}) => server));
    if (!at('link-matrix').closest('details').open) return;
    const plan = streams[0]?.plan;
    const count = plan?.tiles.length ?? 0;
    const pixels = new Map((plan?.links ?? []).map(({from, to, rectangles}) =>
        [from * count + to, compact(area(rectangles))]));
    const servers = [...Array(count).keys()];
    fill_table(at('link-matrix'), ['from, to', ...servers.map(String)], servers.map((from) => [
        String(from), ...servers.map((to) => pixels.get(from * count + to) ?? ''),
    ]));
    colour_rows(at('link-matrix'), servers);
}

function colour_rows(table, servers) {
    [...table.tBodies[0].rows].forEach((row, place) => {
        const colour = css_colour(server_colour(servers[place]));
        row.cells[0].classList.add('swatch');
        row.cells[0].style.setProperty('--server', colour);
    });
}

export function show_speedups(note) {
    const points = note?.points ?? [];
    const most = points.at(-1);
    const lines = kSeries.map(({name, field}) => ({name, list: speedups(points, field)}));
    const best = lines[0].list.at(-1);
    set_text('curve-note', note?.running ? `measuring ${note.algorithm}` : note
        ? `${note.algorithm}${best ? `, ${times(best.speedup)} with ${best.servers}` : ''}` : 'not measured');
    fill_table(at('curve-table'), ['Servers', ...kSeries.map(({name}) => name)], points.map((point) => [
        String(point.servers),
        ...kSeries.map(({field}, place) => {
            const known = lines[place].list.find(({servers}) => servers === point.servers);
            return known ? `${times(known.speedup)} (${ms(point[field])})` : '–';
        }),
    ]));
    at('curve').setAttribute('aria-label', most
        ? `Speed-up with ${plural(most.servers, 'server')}: ${lines.map(({name, list}) =>
            `${name} ${list.length ? times(list.at(-1).speedup) : 'not known'}`).join(', ')}`
        : 'Speed-up over the number of servers; not measured yet');
}
