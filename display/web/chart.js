// The base of all charts: a canvas that is crisp at any pixel ratio, redrawn when its size, its data or the
// colour scheme changes, at most once per animation frame and only while it can be seen.

export class Chart {
    #canvas;
    #paint;
    #scheduled = false;
    #visible = true;

    // `paint(context, width, height, theme)` draws in CSS pixels; `theme(name)` is the value of a custom
    // property.
    constructor(canvas, paint) {
        this.#canvas = canvas;
        this.#paint = paint;
        new ResizeObserver(() => this.redraw()).observe(canvas);
        new IntersectionObserver(([entry]) => {
            this.#visible = entry.isIntersecting;
            this.redraw();
        }).observe(canvas);
        matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.redraw());
        const watch_ratio = () => matchMedia(`(resolution: ${devicePixelRatio}dppx)`)
            .addEventListener('change', () => { this.redraw(); watch_ratio(); }, {once: true});
        watch_ratio();
    }

    get canvas() { return this.#canvas; }

    redraw() {
        if (this.#scheduled || !this.#visible) return;
        this.#scheduled = true;
        requestAnimationFrame(() => {
            this.#scheduled = false;
            this.#draw();
        });
    }

    #draw() {
        const {clientWidth: width, clientHeight: height} = this.#canvas;
        if (width === 0 || height === 0) return;
        const ratio = devicePixelRatio;
        const pixels = [Math.round(width * ratio), Math.round(height * ratio)];
        if (this.#canvas.width !== pixels[0]) this.#canvas.width = pixels[0];
        if (this.#canvas.height !== pixels[1]) this.#canvas.height = pixels[1];
        const context = this.#canvas.getContext('2d');
        context.setTransform(ratio, 0, 0, ratio, 0, 0);
        context.clearRect(0, 0, width, height);
        const style = getComputedStyle(this.#canvas);
        context.font = '11px system-ui, sans-serif';
        const known = new Map();
        this.#paint(context, width, height, (name) => {
            if (!known.has(name)) known.set(name, style.getPropertyValue(name).trim());
            return known.get(name);
        });
    }
}

// A step of 1, 2 or 5 times a power of ten, so that about `count` steps make `span`.
export function nice_step(span, count) {
    const rough = Math.max(span, 1e-9) / Math.max(count, 1);
    const power = 10 ** Math.floor(Math.log10(rough));
    return power * ([1, 2, 5].find((factor) => factor * power >= rough) ?? 10);
}

// A pattern of diagonal lines, for waits.
export function hatch(context, colour) {
    const ratio = context.getTransform().a;
    const size = Math.round(6 * ratio);
    const tile = new OffscreenCanvas(size, size);
    const pen = tile.getContext('2d');
    pen.strokeStyle = colour;
    pen.lineWidth = 1.1 * ratio;
    for (const shift of [-size, 0, size]) {
        pen.moveTo(shift - 1, size + 1);
        pen.lineTo(shift + size + 1, -1);
    }
    pen.stroke();
    const pattern = context.createPattern(tile, 'repeat');
    pattern.setTransform(new DOMMatrix().scale(1 / ratio));
    return pattern;
}
