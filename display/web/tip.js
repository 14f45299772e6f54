// The small box with numbers beside the pointer.

import {fill_rows} from './tables.js';

export class Tip {
    #box;
    #title;
    #table;

    constructor(box) {
        this.#box = box;
        this.#title = box.querySelector('strong');
        this.#table = box.querySelector('table');
    }

    // `hover(event)` shows the tip for the pointer. Under a finger it stays until the next touch.
    attach(element, hover) {
        element.addEventListener('pointermove', hover);
        element.addEventListener('pointerdown', hover);
        element.addEventListener('pointerleave', ({pointerType}) => pointerType === 'mouse' && this.hide());
        document.addEventListener('pointerdown', ({target}) => target !== element && this.hide());
    }

    // `rows` are lists of texts: name, value, and more.
    show(x, y, title, rows) {
        this.#title.textContent = title;
        fill_rows(this.#table, rows);
        this.#box.hidden = false;
        const {offsetWidth: width, offsetHeight: height} = this.#box;
        const left = x + 14 + width > innerWidth - 4 ? x - 14 - width : x + 14;
        const top = y + 14 + height > innerHeight - 4 ? y - 14 - height : y + 14;
        const [at_x, at_y] = [left, top].map((at) => Math.max(Math.round(at), 4));
        this.#box.style.transform = `translate(${at_x}px, ${at_y}px)`;
    }

    hide() { this.#box.hidden = true; }
}
