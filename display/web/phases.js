// The phases of a frame in order, and how charts show them.

export const kMeanings = new Map([
    ['partition', 'the client divides screen and model'],
    ['cull', 'a server finds what of its group can be seen'],
    ['render', 'it draws'],
    ['pixel read', 'it reads back what others get'],
    ['swap', 'it codes and sends its swaths'],
    ['pixel write', 'it merges the swaths of others into its tile'],
    ['final read', 'it gathers its finished tile'],
    ['send', 'it sends the tile'],
    ['assemble', 'the display puts tiles together'],
    ['encode', 'the display makes the PNG or JPEG'],
    ['wait', 'for others, or for an earlier frame'],
]);
export const kPhases = [...kMeanings.keys()];

// What holds a frame up when most of its critical path is this phase, and what helps.
const kDrawing = ['drawing', 'more servers on cores of their own, or a smaller picture'];
const kPixels = ['exchanging pixels', 'a smaller picture, or fewer servers'];
const kDisplay = ['the display', 'a smaller picture'];
const kLimits = {
    'partition': ['the client', 'fewer objects'],
    'cull': kDrawing, 'render': kDrawing, 'wait': kDrawing,  // a wait on the path is for an earlier frame
    'pixel read': kPixels, 'swap': kPixels, 'pixel write': kPixels, 'final read': kPixels,
    'send': ['the network', 'a smaller picture, or a faster network'],
    'assemble': kDisplay, 'encode': kDisplay,
};

function largest_limit(critical) {
    const sums = new Map();
    for (const {phase, begin, end} of critical) {
        const limit = kLimits[phase];
        if (limit) sums.set(limit, (sums.get(limit) ?? 0) + end - begin);
    }
    return [...sums].reduce((most, sum) => sum[1] > most[1] ? sum : most, [null, 0])[0];
}

// What most of a critical path is spent on ("drawing"), and a sentence on what would make it shorter; '' where
// that is not known.
export const limit_of = (critical) => largest_limit(critical)?.[0] ?? '';
export function advice(critical) {
    const limit = largest_limit(critical);
    return limit ? `The limit is ${limit[0]}: ${limit[1]} would help` : '';
}

export const is_wait = (phase) => phase === 'wait';

// The custom property in style.css that has the phase's colour.
export const phase_colour = (phase) => `--${kPhases.includes(phase) ? phase.replaceAll(' ', '-') : 'other'}`;

// Sums up `field` of spans by phase: their milliseconds, or another value.
export function by_phase(spans, field = ({begin, end}) => end - begin) {
    const sums = new Map();
    for (const span of spans) sums.set(span.phase, (sums.get(span.phase) ?? 0) + field(span));
    return sums;
}

// The number in a server's name ("server 3"), or null.
export function server_number(machine) {
    const match = /^server (\d+)$/.exec(machine);
    return match ? Number(match[1]) : null;
}

// The chain of spans that a picture waited for, in words, with each part's share: "server 2 render 41 % →
// swap → display assemble". A machine is named where the chain comes to it. Parts smaller than `least` of the
// whole are left out.
export function critical_text(critical, least = 0) {
    const total = critical.reduce((sum, span) => sum + span.end - span.begin, 0);
    const parts = [];
    for (const {machine, phase, begin, end} of critical) {
        const last = parts.at(-1);
        if (last?.machine === machine && last.phase === phase) last.ms += end - begin;
        else parts.push({machine, phase, ms: end - begin});
    }
    return parts.filter(({ms}) => ms >= least * total).map(({machine, phase, ms}, place, all) => {
        const who = all[place - 1]?.machine === machine ? '' : `${machine} `;
        const share = total > 0 ? ms / total : 0;
        return `${who}${phase}${share >= 0.05 ? ` ${Math.round(100 * share)} %` : ''}`;
    }).join(' → ');
}
