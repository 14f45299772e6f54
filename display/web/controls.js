// The controls of a run: the choices, the values, and for each choice that cannot be had the reason. It only
// shows what it is given and reports what the person changes.

import {whole} from './format.js';

const kNames = {
    'hybrid': 'Hybrid', 'mahd': 'MAHD (sort-first)', 'kd-split': 'KD-split (sort-first)',
    'sort-last': 'Sort-last',
    'raster': 'Rasteriser', 'osmesa': 'OSMesa', 'egl': 'EGL', 'raycast': 'Ray caster',
    'wide': 'Wide', 'a2ssb': 'A2SSB', 'adsb': 'ADSB', 'none': 'None',
    'orbit': 'Orbit', 'random': 'Random',
};
const kRenderers = ['raster', 'osmesa', 'egl', 'raycast'];
const kSizes = [[640, 480], [1280, 960], [1920, 1080]];
const kSelects = ['algorithm', 'against', 'objects', 'size', 'renderer', 'cull', 'path'];
const kNone = '';  // the value of the option that stands for null

export class Controls {
    #elements = {};
    #reasons = new Map();  // field to the reason why it could not be had
    #on_change;
    size = 'window';

    // on_change(field, value); for 'size' the value is the mode: 'window', 'half' or 'WxH'.
    constructor(on_change) {
        this.#on_change = on_change;
        for (const field of [...kSelects, 'servers']) {
            const element = this.#elements[field] = document.getElementById(field);
            element.addEventListener(field === 'servers' ? 'input' : 'change', () => this.#changed(field));
        }
    }

    // Shows why a field of the wish was refused, until the person chooses anew.
    refuse(field, reason) {
        this.#reasons.set(['width', 'height'].includes(field) ? 'size' : field, String(reason));
    }

    forget() { this.#reasons.clear(); }

    // `values` is the wish or the state that counts; `why` says why nothing can be chosen, or is ''.
    update(session, values, why) {
        const choices = session?.choices ?? {};
        const many = session?.servers?.length ?? 1;
        this.#fill('algorithm', (choices.algorithms ?? []).map((name) => option(name)), values.algorithm);
        this.#fill('against', [
            option(kNone, 'Nothing'),
            ...(choices.algorithms ?? []).map((name) =>
                option(name, undefined, name === values.algorithm ? 'is the first' : '')),
        ], values.against ?? kNone);
        const counts = [...new Set([...(choices.objects ?? []), values.objects].filter(Number.isInteger))];
        this.#fill('objects', counts.sort((a, b) => a - b).map((count) =>
            option(String(count), `about ${whole(count)}`)), String(values.objects ?? ''));
        const renderers = [...new Set([...(choices.renderers ?? []), ...kRenderers])];
        this.#fill('renderer', renderers.map((name) =>
            option(name, name.split(',').map((one) => kNames[one] ?? one).join(', '),  // for servers in turn
                   choices.renderers?.includes(name) ? '' : 'not in this build')),
                   values.renderer);
        this.#fill('cull', (choices.culls ?? []).map((name) => option(name)), values.cull);
        this.#fill('path', [
            option(kNone, 'None: steered'), ...(choices.paths ?? []).map((name) => option(name)),
        ], values.path ?? kNone);
        this.#fill('size', [
            option('window', 'As the window'), option('half', 'Half the window'),
            ...kSizes.map(([width, height]) => {
                const larger = width > choices.max_width || height > choices.max_height;
                return option(`${width}x${height}`, `${width} × ${height}`,
                              larger ? 'larger than the client allows' : '');
            }),
        ], this.size);

        const {servers} = this.#elements;
        servers.max = many;
        if (document.activeElement !== servers || why) servers.value = values.servers ?? many;
        this.#show_servers(many);

        const shown = document.getElementById('controls-why');
        shown.textContent = why;
        shown.hidden = !why;
        for (const field of [...kSelects, 'servers']) {
            const element = this.#elements[field];
            const own = field !== 'servers' ? (element.options.length === 0 ? 'Not known yet' : '') :
                many === 1 ? 'The cluster has one server' : '';
            element.disabled = Boolean(why || own);
            element.title = why || own;
            const reason = this.#reasons.get(field) ?? '';
            const text = reason ? `Could not be had: ${reason}` : '';
            const note = document.getElementById(`${field}-why`);
            if (note.textContent !== text) note.textContent = text;
        }
    }

    #show_servers(many) {
        const text = `${this.#elements.servers.value} of ${many}`;
        document.getElementById('servers-of').textContent = text;
        this.#elements.servers.setAttribute('aria-valuetext', text);
    }

    // Replaces options only if they differ, so that an open list stays open.
    #fill(field, options, value) {
        const element = this.#elements[field];
        const key = JSON.stringify(options);
        if (element.dataset.options !== key) {
            element.dataset.options = key;
            element.replaceChildren(...options.map(({value, label, why}) => {
                const made = new Option(why ? `${label} (${why})` : label, value);
                made.disabled = Boolean(why);
                return made;
            }));
        }
        const wanted = value ?? '';
        if (element.value !== wanted) element.value = wanted;
    }

    #changed(field) {
        const {value} = this.#elements[field];
        this.#reasons.delete(field);
        if (field === 'size') this.size = value;
        if (field === 'servers') this.#show_servers(this.#elements.servers.max);
        // The right end means all servers, including those that will come.
        const all = field === 'servers' && value === this.#elements.servers.max;
        const numeric = field === 'servers' || field === 'objects';
        this.#on_change(field, all || value === kNone ? null : numeric ? Number(value) : value);
    }
}

function option(value, label = kNames[value] ?? value, why = '') {
    return {value, label, why};
}
