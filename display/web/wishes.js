// The wish of this page's person. Every change goes to the display as the whole wish, at most once per
// animation frame. Also keeps the time of the input behind each wish, for the lag.

import {to_numbers} from './camera.js';

const kFields = ['algorithm', 'against', 'servers', 'objects', 'renderer', 'cull', 'path', 'paused'];
const kNoCounts = {step: 0, measure: 0, trace: 0};

export class Wishes {
    #send;
    #id = 0;
    #scheduled = false;
    #input_time = null;  // of the oldest input that the next wish carries
    #inputs = new Map();  // wish id to time of its input
    #camera = null;
    #since = new Map();  // field to the first wish that has or will have its value
    want = {};
    sent = null;

    // `send` takes the wish and returns whether it went out.
    constructor(send) { this.#send = send; }

    get camera() { return this.#camera; }
    get id() { return this.#id; }

    // Adopts the state without wishing for it. Counts begin at 0, which exceeds nothing that anybody wished
    // before.
    adopt(state, camera) {
        this.#camera = camera;
        this.#input_time = null;
        for (const field of kFields)
            if (state?.[field] !== undefined) this.want[field] = state[field];
        Object.assign(this.want, kNoCounts);
    }

    forget() {
        this.#camera = null;
        this.want = {};
        this.#since.clear();
        this.#inputs.clear();
        this.#input_time = null;
    }

    // `input_time` is the event's, on the page's clock; without it, no lag is measured.
    set(fields, input_time = null) {
        for (const field of Object.keys(fields)) this.#since.set(field, this.#id + 1);
        Object.assign(this.want, fields);
        this.#schedule(input_time);
    }

    look(camera, input_time = null) {
        this.#camera = camera;
        this.#schedule(input_time);
    }

    count(name) { this.set({[name]: this.want[name] + 1}); }

    // The first wish that carried the field's value; 0 if it was not this page's.
    since(field) { return this.#since.get(field) ?? 0; }

    // Returns the time of the input that led to this wish, once.
    take_input(id) {
        const time = this.#inputs.get(id) ?? null;
        for (const known of this.#inputs.keys())
            if (known <= id) this.#inputs.delete(known);
        return time;
    }

    #schedule(input_time) {
        if (input_time !== null) this.#input_time ??= input_time;
        if (this.#scheduled) return;
        this.#scheduled = true;
        requestAnimationFrame(() => {
            this.#scheduled = false;
            const input_time = this.#input_time;
            this.#input_time = null;
            if (!this.#camera) return;
            const wish = {type: 'wish', id: this.#id + 1, camera: to_numbers(this.#camera), ...this.want};
            if (!this.#send(wish)) return;
            this.#id = wish.id;
            this.sent = wish;
            if (input_time !== null) this.#inputs.set(wish.id, input_time);
        });
    }
}
