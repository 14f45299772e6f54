// Makes values for the page of the client's notes: short lists get names, missing lists are empty. A useless
// note is null.

const kSpan = ['phase', 'begin', 'end', 'cpu'];
const kCritical = ['machine', 'phase', 'begin', 'end'];
const kPoint = ['servers', 'interval', 'busiest_cpu', 'predicted'];

function named(value, fields) {
    if (!Array.isArray(value)) return value;
    return Object.fromEntries(fields.map((field, place) => [field, value[place]]));
}

const list = (value) => Array.isArray(value) ? value : [];
const is_span = ({begin, end}) => Number.isFinite(begin) && Number.isFinite(end) && end >= begin;

export function read_plan(note) {
    if (!Array.isArray(note?.tiles) || !(note.width > 0) || !(note.height > 0)) return null;
    return {
        ...note,
        links: list(note.links).map((link) =>
            Array.isArray(link) ? {from: link[0], to: link[1], rectangles: link.slice(2)} : link),
    };
}

export function read_frame(note) {
    if (note.stream !== 0 && note.stream !== 1) return null;
    return {
        ...note,
        machines: list(note.machines).map((machine) => ({
            ...machine,
            counters: machine.counters ?? {},
            spans: list(machine.spans).map((span) => named(span, kSpan)).filter(is_span),
        })),
        critical: list(note.critical).map((span) => named(span, kCritical)).filter(is_span),
    };
}

export function read_speedup(note) {
    return {
        ...note,
        points: list(note.points).map((point) => named(point, kPoint)).filter(({servers}) => servers >= 1)
            .sort((a, b) => a.servers - b.servers),
    };
}
