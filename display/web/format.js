// Numbers for people.

const kWhole = new Intl.NumberFormat('en', {maximumFractionDigits: 0});

export const whole = (value) => kWhole.format(value);

// About three figures: 0.04, 1.23, 12.3, 123.
export function decimal(value) {
    if (!Number.isFinite(value)) return '–';
    const size = Math.abs(value);
    return size >= 100 ? kWhole.format(value) : value.toFixed(size >= 10 ? 1 : 2);
}

export const ms = (value) => Number.isFinite(value) ? `${decimal(value)} ms` : '–';
export const times = (value) => `${decimal(value)}\u00d7`;
export const percent = (part) => `${Math.round(100 * part)} %`;

export function compact(value) {
    if (!Number.isFinite(value)) return '–';
    if (value >= 9.995e5) return `${(value / 1e6).toPrecision(3)} M`;
    if (value >= 9995) return `${(value / 1e3).toPrecision(3)} k`;
    return kWhole.format(value);
}

export const plural = (count, one, many = one + 's') => `${kWhole.format(count)} ${count === 1 ? one : many}`;

export function median(values) {
    if (values.length === 0) return NaN;
    const sorted = [...values].sort((a, b) => a - b);
    const middle = sorted.length >> 1;
    return sorted.length % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}
