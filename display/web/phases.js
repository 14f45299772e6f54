// The phases of a frame in order, and how charts show them.

export const kPhases = [
    'partition', 'cull', 'render', 'pixel read', 'swap', 'pixel write', 'final read', 'send', 'assemble',
    'encode', 'wait',
];

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
