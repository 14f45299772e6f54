// One stream of pictures, from bytes to the canvas. Pictures are drawn in the order in which they came; one
// that is decoded after a newer one is dropped. Every picture is answered, so that the next may come.

export class Stream {
    #canvas;
    #on;
    #context;
    #received = 0;
    #drawn_place = 0;
    #waiting = null;  // resolves with the next lossless picture
    drawn = null;  // {header, bytes} of the picture on the canvas

    // Calls on.shown(header) for every picture, and on.drawn(stream) when it is on the canvas.
    constructor(canvas, on) {
        this.#canvas = canvas;
        this.#context = canvas.getContext('2d', {alpha: false});
        this.#on = on;
    }

    get plan() { return this.drawn?.header.plan ?? null; }
    get canvas() { return this.#canvas; }

    async receive(header, bytes) {
        const place = ++this.#received;
        try {
            const file = new Blob([bytes], {type: `image/${header.format}`});
            const bitmap = await createImageBitmap(file, {colorSpaceConversion: 'none'});
            if (place > this.#drawn_place) this.#draw(place, header, bytes, bitmap);
            bitmap.close();
        } catch (error) {
            console.warn(`frame ${header.frame} of stream ${header.stream} cannot be shown: ${error}`);
        }
        this.#on.shown(header);
    }

    forget() {
        this.#drawn_place = this.#received;
        this.drawn = null;
        this.#answer_waiting(null);
        this.#canvas.width = this.#canvas.width;
        for (const name of ['frame', 'format', 'width', 'height', 'wish']) delete this.#canvas.dataset[name];
    }

    // The newest lossless picture, now or when it comes; null if another call or forget() was first.
    lossless() {
        if (this.drawn?.header.format === 'png') return Promise.resolve(this.drawn);
        this.#answer_waiting(null);
        return new Promise((resolve) => this.#waiting = resolve);
    }

    #answer_waiting(drawn) {
        this.#waiting?.(drawn);
        this.#waiting = null;
    }

    // The picture on the canvas, for scripts: {frame, format, width, height, base64}, or null.
    async picture() {
        if (!this.drawn) return null;
        const {header, bytes} = this.drawn;
        const url = await new Promise((resolve, reject) => {
            const reader = new FileReader();
            reader.onload = () => resolve(reader.result);
            reader.onerror = () => reject(reader.error);
            reader.readAsDataURL(new Blob([bytes]));
        });
        const {frame, format} = header;
        return {frame, format, ...this.size(), base64: url.slice(url.indexOf(',') + 1)};
    }

    size() {
        return {width: this.#canvas.width, height: this.#canvas.height};
    }

    #draw(place, header, bytes, bitmap) {
        const {width, height} = bitmap;
        if (this.#canvas.width !== width) this.#canvas.width = width;
        if (this.#canvas.height !== height) this.#canvas.height = height;
        this.#context.drawImage(bitmap, 0, 0);
        this.#drawn_place = place;
        this.drawn = {header, bytes};
        Object.assign(this.#canvas.dataset, {
            frame: header.frame, format: header.format, width, height, wish: header.plan?.wish ?? 0,
        });
        if (header.format === 'png') this.#answer_waiting(this.drawn);
        this.#on.drawn(this);
    }
}
