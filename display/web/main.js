// The viewer's state, and who is told when it changes. docs/viewer.md says which messages come and go.

import {Bars} from './bars.js';
import * as cameras from './camera.js';
import {Connection} from './connection.js';
import {Controls} from './controls.js';
import {Curve, Sparkline} from './curve.js';
import {compact, plural} from './format.js';
import {critical_summary, Gantt} from './gantt.js';
import {attach_gestures, steer_by_key} from './gestures.js';
import {copy, save} from './keep.js';
import {read_frame, read_plan, read_speedup} from './notes.js';
import {kLayers} from './overlays.js';
import {show_frames, show_legends, show_links, show_speedups} from './panels.js';
import {advice} from './phases.js';
import {Stage} from './stage.js';
import {Tip} from './tip.js';
import {Wishes} from './wishes.js';

const kResizeRestMs = 150;   // before it asks for a new size
const kPanelMs = 160;        // between two updates of numbers and bars, so that people can read them
const kStateWaitMs = 300;    // for a `state` note before the page starts from what it knows
const kHintMs = 2500;
const kRateWindowMs = 1500;
const kLeastNamed = 0.02;    // share of the critical path

const at = (id) => document.getElementById(id);

const now = {
    connected: false,
    audience: null,  // the newest note of each kind
    session: null,
    state: null,
    state_fresh: false,  // it came over this connection
    objects: null,
    speedup: null,
    frames: [null, null],
    compared: null,  // the newest `frame` note with other algorithms
    leading: false,  // this page's wishes count, since it has adopted the state
    trace_wanted: false,
};

const tip = new Tip(at('tip'));
const wishes = new Wishes((wish) => leads() && connection.send(wish));
const stage = new Stage(tip, {
    shown: ({frame, stream, format}) => connection.send({type: 'shown', frame, stream, format}),
    drawn: picture_drawn,
    resized: () => {
        clearTimeout(now.resize_timer);
        now.resize_timer = setTimeout(wish_size, kResizeRestMs);
    },
});
const gantt = new Gantt(at('gantt'), tip, show_gantt_state);
const bars = new Bars(at('bars'), tip);
const curve = new Curve(at('curve'), tip);
const lag_curve = new Sparkline(at('lag-curve'));
const controls = new Controls((field, value) => {
    if (field === 'size') return wish_size();
    // After a path steering goes on from the path's camera.
    if (field === 'path' && value === null) wishes.look(current_camera());
    wishes.set({[field]: value});
    if (field === 'algorithm' && value === wishes.want.against) wishes.set({against: null});
    refresh();
});
const connection = new Connection(
    `${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/live${location.search}`, {
        open: () => {
            now.connected = true;
            refresh();
        },
        lost: () => {
            now.connected = false;
            now.leading = now.state_fresh = now.trace_wanted = false;
            now.audience = null;
            refresh();
        },
        note: (note) => {
            // A bad note must not stop those after it.
            try {
                kNotes[note.type]?.(note);
            } catch (error) {
                console.warn(`a ${note.type} note cannot be used: ${error}`);
            }
        },
        picture: (header, bytes) =>
            stage.stream(header.stream).receive({...header, plan: read_plan(header.plan)}, bytes),
    });

// --- Steering ---

function leads() {
    const {audience, session} = now;
    return Boolean(audience && audience.you === audience.lead && audience.session && session?.live);
}

// The camera of the picture: this page's wish, or the last frame's while a path plays.
function current_camera() {
    const drawn = stage.stream(0).plan?.camera;
    if (wishes.want.path && cameras.is_camera(drawn)) return cameras.from_numbers(drawn);
    return wishes.camera;
}

// Adopts the state, so that nothing jumps, and asks for pictures of this window's size.
function take_over() {
    clearTimeout(now.take_over_timer);
    if (now.leading || !leads()) return;
    const {state, session} = now;
    const drawn = stage.stream(0).plan?.camera;
    const numbers = [state?.path ? drawn : state?.camera, drawn, state?.camera, session.home]
        .find(cameras.is_camera);
    if (!numbers) return;
    now.leading = true;
    wishes.adopt(state, cameras.from_numbers(numbers));
    wishes.set(size());
}

function take_over_soon() {
    if (now.state_fresh) return take_over();
    clearTimeout(now.take_over_timer);
    now.take_over_timer = setTimeout(() => {
        take_over();
        refresh();
    }, kStateWaitMs);
}

function size() {
    const fixed = /^(\d+)x(\d+)$/.exec(controls.size);
    const [width, height] = fixed
        ? [Number(fixed[1]), Number(fixed[2])]
        : stage.fitting(controls.size === 'half' ? 0.5 : 1);
    return {width, height};
}

function wish_size() {
    const {width, height} = size();
    const {want} = wishes;
    if (now.leading && (want.width !== width || want.height !== height)) wishes.set({width, height});
}

const steering = {
    orbit: (across, upwards, time) => steer((camera) => cameras.orbit(camera, across, upwards), time),
    pan: (x, y, time) => steer((camera, within) => cameras.pan(camera, x, y, within), time),
    dolly: (factor, place, time) =>
        steer((camera, within) => cameras.dolly(camera, factor, place, within), time),
    centre: (place, time) => steer((camera, within) => cameras.centre(camera, place, within), time),
};

function steer(change, time) {
    if (!now.leading) return hint(why_not_steered());
    const camera = current_camera();
    if (wishes.want.path) wishes.set({path: null});
    wishes.look(change(camera, cameras.limits(now.session.bounds)), time);
    if (wishes.want.paused) hint('Paused: Step draws one frame of this view');
    if (at('path').value !== '') refresh();
}

function reset() {
    if (!now.leading) return hint(why_not_steered());
    if (!cameras.is_camera(now.session.home)) return;
    wishes.set({path: null});
    wishes.look(cameras.from_numbers(now.session.home), performance.now());
    refresh();
}

function why_not_steered() {
    const {connected, audience, session} = now;
    if (!connected || !audience) return now.was_connected ? 'There is no connection' : 'Connecting';
    if (!audience.session) return 'There is no client yet';
    if (!session) return 'Connecting';
    if (!session.live) return `Cannot be steered: ${session.why ?? 'this run follows a camera path'}`;
    if (audience.lead !== audience.you) return `Viewer ${audience.lead} steers. “Steer” takes over.`;
    return '';
}

// --- Notes ---

const kNotes = {
    audience: (note) => {
        const before = now.audience;
        now.audience = note;
        if (before?.session && !note.session) forget_session();
        if (!leads()) now.leading = now.trace_wanted = false;
        else if (!now.leading) take_over_soon();
        refresh();
    },
    session: (note) => {
        // The same run goes on with other servers or after a lost connection. Another one begins anew.
        if (now.session && !same_run(now.session, note)) forget_session();
        now.session = note;
        stage.background = note.background;
        const servers = note.servers?.length ?? 1;
        if (wishes.want.servers > servers) wishes.want.servers = null;
        gantt.machines = servers + 2;
        curve.servers = servers;
        if (leads() && !now.leading) take_over_soon();
        refresh();
    },
    state: (note) => {
        now.state = note;
        now.state_fresh = true;
        if (leads() && !now.leading) take_over();
        if (note.by === now.audience?.you)
            for (const [field, reason] of Object.entries(note.refused ?? {})) {
                // The person may have chosen anew since.
                if (wishes.since(field) > note.wish) continue;
                if (!['camera', 'width', 'height'].includes(field)) wishes.want[field] = note[field];
                controls.refuse(field, reason);
            }
        refresh();
    },
    objects: (note) => stage.objects = now.objects = note,
    frame: (text) => {
        const note = read_frame(text);
        if (!note) return;
        now.frames[note.stream] = note;
        if (note.others) now.compared = note;
        gantt.add(note);
        stage.frame(note);
        update_panels_soon();
    },
    speedup: (note) => {
        now.speedup = read_speedup(note);
        curve.show(now.speedup);
        show_speedups(now.speedup);
        refresh();
    },
    trace: ({trace}) => {
        if (!now.trace_wanted) return;
        now.trace_wanted = false;
        save('swath-timeline.json', [JSON.stringify(trace)], 'application/json');
        refresh();
    },
};

function same_run(a, b) {
    return JSON.stringify({...a, servers: null}) === JSON.stringify({...b, servers: null});
}

function forget_session() {
    Object.assign(now, {
        session: null, state: null, state_fresh: false, objects: null,
        speedup: null, frames: [null, null], compared: null,
        leading: false, trace_wanted: false,
    });
    wishes.forget();
    controls.forget();
    stage.forget();
    gantt.forget();
    curve.show(null);
    show_speedups(null);
    update_panels();
}

const rate = {times: [], frame: null};

function picture_drawn(number, {drawn: {header}}) {
    const time = performance.now();
    const {plan} = header;
    if (plan && plan.by === now.audience?.you) {
        const input = wishes.take_input(plan.wish);
        if (input !== null) {
            at('lag').textContent = Math.round(time - input);
            lag_curve.add(time - input);
        }
    }
    if (number === 0) {
        if (header.frame !== rate.frame) rate.times.push(time);
        rate.frame = header.frame;
        show_quality(header.format);
    }
    update_panels_soon();
}

function show_quality(format) {
    const badge = at('quality');
    badge.textContent = {png: 'lossless', jpeg: 'moving'}[format];
    badge.dataset.state = format;
}

function show_rate() {
    const oldest = performance.now() - kRateWindowMs;
    rate.times = rate.times.filter((time) => time >= oldest);
    const {times} = rate;
    const span = times.at(-1) - times[0];
    const text = times.length > 2 && span > 0 ? ((times.length - 1) * 1000 / span).toFixed(1) : '–';
    if (at('fps').textContent !== text) at('fps').textContent = text;
}
setInterval(show_rate, 250);

// --- What is shown ---

function update_panels_soon() {
    now.panel_timer ??= setTimeout(() => {
        now.panel_timer = null;
        update_panels();
    }, kPanelMs);
}

function update_panels() {
    const streams = stage.split ? [0, 1] : [0];
    const frames = streams.map((stream) => now.frames[stream]).filter(Boolean);
    bars.show(frames);
    show_frames(frames, now.compared);
    show_links(streams.map((stream) => ({
        plan: stage.stream(stream).plan,
        frame: now.frames[stream],
        title: stage.split ? `${'AB'[stream]} ` : '',
    })).filter(({plan}) => plan));
    if (gantt.paused) return;
    const lines = streams.map((stream) => {
        const title = `Critical path${stage.split ? ` ${'AB'[stream]}` : ''}, `;
        const [short, whole] = [kLeastNamed, 0].map((least) => critical_summary(now.frames[stream], least));
        return short && {short: title + short, whole: `${title}${whole}. ${advice(now.frames[stream].critical)}`};
    });
    [...at('critical').children].forEach((element, place) => {
        element.hidden = place >= streams.length;
        element.textContent = lines[place]?.short ?? '';
        element.title = lines[place]?.whole ?? '';
    });
    const title = ['Gantt chart of the last frames', ...lines.map((line) => line?.whole)];
    at('gantt').setAttribute('aria-label', title.filter(Boolean).join('. '));
}

function situation() {
    const {connected, audience, session, state} = now;
    const connecting = {state: 'busy', text: 'Connecting', notice: ['Connecting', '']};
    if (!connected)
        return now.was_connected
            ? {state: 'bad', text: 'Connection lost; trying again',
               notice: ['Connection lost', 'Trying again by itself.']}
            : connecting;
    if (!audience) return connecting;
    if (!audience.session)
        return {state: 'busy', text: 'Waiting for a client',
                notice: ['Waiting for a client', 'Pictures come when one begins a run with this display.']};
    if (!session) return connecting;
    const others = audience.viewers > 1 ? `; ${plural(audience.viewers, 'viewer')}` : '';
    if (!session.live)
        return {state: 'good', text: `${why_not_steered()}${others}`};
    if (state?.busy) return {state: 'busy', text: `${state.busy}${others}`};
    if (!leads()) return {state: 'good', text: `Viewer ${audience.lead} steers, you follow${others}`};
    return {state: 'good', text: `You steer${others}`};
}

function refresh() {
    now.was_connected ||= now.connected;
    const {session, state, audience} = now;
    const steering_here = now.leading;
    const values = steering_here ? wishes.want : state ?? stage.stream(0).plan ?? {};
    const why = why_not_steered() || (steering_here ? '' : 'Not known yet');

    const {state: mood, text, notice} = situation();
    if (at('status').textContent !== text) at('status').textContent = at('status').title = text;
    at('status').dataset.state = mood;
    at('notice').hidden = !notice;
    if (notice) [at('notice').children[0].textContent, at('notice').children[1].textContent] = notice;
    stage.stale = !now.connected && now.was_connected;
    stage.split = Boolean(values.against);

    at('model').textContent = session ? `${session.model} · ${compact(session.triangles)} triangles` : '';
    at('model').title = at('model').textContent;  // in full, if the line is cut
    document.title = session ? `${session.model} · Swath` : 'Swath';
    at('picture-0').setAttribute('aria-label', session ? `Picture of ${session.model}` : 'Picture');

    // A picture that nobody steers has none.
    document.querySelector('.lag').hidden = Boolean(session) && (!leads() || Boolean(values.path));

    const lead = at('lead');
        disable(lead, leads() ? 'You steer' : session?.live && audience ? '' : why_not_steered());

    controls.update(session, values, why);
    press(at('pause'), Boolean(values.paused));
    disable(at('pause'), why);
    disable(at('reset'), why);
    disable(at('step'), why || (values.paused ? '' : 'Only while paused'));
    disable(at('measure'), why || (now.speedup?.running ? 'Measuring' : ''), 'measure-why');
    disable(at('save-timeline'), why || (now.trace_wanted ? 'On its way' : ''), 'timeline-why');
    disable(at('save-frame'), session ? '' : why);
    disable(at('save-camera'), session ? '' : why);
    const command = state?.command ?? '';
    if (at('command').value !== command) at('command').value = command;
    disable(at('copy-command'), command ? '' : 'Not known yet');
}

// Disables the button if there is a reason, and shows it.
function disable(button, why, shown_at = null) {
    button.dataset.title ??= button.title;
    button.disabled = Boolean(why);
    button.title = why || button.dataset.title;
    if (shown_at && at(shown_at).textContent !== why) at(shown_at).textContent = why;
}

function press(button, on) { button.setAttribute('aria-pressed', String(on)); }

function hint(text) {
    if (!text) return;
    at('hint').textContent = text;
    at('hint').hidden = false;
    clearTimeout(now.hint_timer);
    now.hint_timer = setTimeout(() => at('hint').hidden = true, kHintMs);
}

function show_gantt_state() {
    press(at('gantt-pause'), gantt.paused);
}

// --- What a person does ---

function fold(part) {
    const folded = document.querySelector('main').classList.toggle(`no-${part}`);
    at(`fold-${part}`).setAttribute('aria-expanded', String(!folded));
    gantt.redraw();
}

function toggle(layer) { press(at(`show-${layer}`), stage.toggle(layer)); }

function pause() {
    wishes.set({paused: !wishes.want.paused});
    refresh();
}

// The camera of the picture, or, before there is one, the one that is asked for.
const camera_numbers = () => {
    const steered = now.leading && !wishes.want.path ? cameras.to_numbers(wishes.camera) : null;
    return [stage.stream(0).plan?.camera, steered, now.state?.camera, now.session?.home]
        .find(cameras.is_camera) ?? null;
};
const camera_text = () => {
    const numbers = camera_numbers();
    return numbers ? cameras.camera_text(numbers) : '';
};

for (const number of [0, 1])
    attach_gestures(stage.cell(number), stage.stream(number).canvas, {
        ...steering, hover: (x, y) => stage.hover(number, x, y),
    });
for (const layer of kLayers) at(`show-${layer}`).addEventListener('click', () => toggle(layer));
for (const part of ['dock', 'panel']) at(`fold-${part}`).addEventListener('click', () => fold(part));
at('lead').addEventListener('click', () => connection.send({type: 'lead'}));
at('reset').addEventListener('click', reset);
at('pause').addEventListener('click', pause);
at('step').addEventListener('click', () => wishes.count('step'));
at('measure').addEventListener('click', () => wishes.count('measure'));
at('gantt-in').addEventListener('click', () => gantt.zoom(0.7));
at('gantt-out').addEventListener('click', () => gantt.zoom(1 / 0.7));
at('gantt-fit').addEventListener('click', () => gantt.reset());
at('gantt-pause').addEventListener('click', () => gantt.pause(!gantt.paused));
at('save-frame').addEventListener('click', async () => {
    if (stage.stream(0).drawn?.header.format !== 'png') hint('Waits for the lossless picture');
    const drawn = await stage.stream(0).lossless();
    if (drawn) save(`swath-${drawn.header.frame}.png`, [drawn.bytes], 'image/png');
});
at('save-camera').addEventListener('click', () => save('view.camera', [camera_text()], 'text/plain'));
at('save-timeline').addEventListener('click', () => {
    now.trace_wanted = true;
    wishes.count('trace');
    refresh();
});
at('copy-command').addEventListener('click', async () =>
    hint(await copy(at('command')) ? 'Copied' : 'Select the text and copy it'));
at('help').addEventListener('click', () => at('help-dialog').showModal());
for (const details of document.querySelectorAll('.panel details'))
    details.addEventListener('toggle', update_panels);

const kKeys = {
    t: () => toggle('tiles'), g: () => toggle('groups'), b: () => toggle('boxes'), s: () => toggle('swaths'),
    o: () => toggle('overlap'), m: () => fold('dock'), f: () => fold('panel'), r: reset, Home: reset,
    p: () => now.leading ? pause() : hint(why_not_steered()),
    '.': () => at('step').disabled ? hint(at('step').title) : wishes.count('step'),
    '?': () => at('help-dialog').showModal(),
};

document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    if (at('help-dialog').open) return;
    // Some elements have their own meaning of keys.
    if (event.target.closest('select, input, textarea, .scroll')) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const act = event.shiftKey && key !== '?' ? null : kKeys[key];
    if (act) act();
    else if (!steer_by_key(event, steering)) return;
    event.preventDefault();
});

show_legends();
show_speedups(null);
update_panels();
refresh();

// For scripts and tests.
window.swath = {
    get viewer() { return now.audience?.you ?? null; },
    get leads() { return leads(); },
    get wish() { return wishes.sent; },
    get state() { return now.state; },
    get session() { return now.session; },
    plan: (stream = 0) => stage.stream(stream).plan,
    picture: (stream = 0) => stage.stream(stream).picture(),
    cameraText: camera_text,
};
