// The WebSocket to the display: opened again whenever it is lost.

const kFirstRetryMs = 250;
const kLongestRetryMs = 4000;

// Parses a binary message: {header, bytes}, or null if it is none.
export function parse_picture(buffer) {
    if (!(buffer instanceof ArrayBuffer) || buffer.byteLength < 4) return null;
    const size = new DataView(buffer).getUint32(0, true);
    if (size > buffer.byteLength - 4) return null;
    const header = parse_object(new TextDecoder().decode(new Uint8Array(buffer, 4, size)));
    if (!header || !Number.isInteger(header.frame) || !['jpeg', 'png'].includes(header.format)) return null;
    if (header.stream !== 0 && header.stream !== 1) return null;
    return {header, bytes: new Uint8Array(buffer, 4 + size)};
}

function parse_object(text) {
    try {
        const value = JSON.parse(text);
        return value !== null && typeof value === 'object' && !Array.isArray(value) ? value : null;
    } catch {
        return null;
    }
}

// Calls on.open(), on.lost(seconds until the next try), on.note(object), on.picture(header, bytes).
export class Connection {
    #url;
    #on;
    #socket = null;
    #retry_ms = kFirstRetryMs;
    #timer = 0;

    constructor(url, on) {
        this.#url = url;
        this.#on = on;
        // A computer that wakes up or gets its network back need not wait for the timer.
        addEventListener('online', () => this.#hasten());
        document.addEventListener('visibilitychange', () => document.hidden || this.#hasten());
        this.#open();
    }

    // Drops the object while there is no connection: after a new one the page says everything anew.
    send(object) {
        if (this.#socket?.readyState !== WebSocket.OPEN) return false;
        this.#socket.send(JSON.stringify(object));
        return true;
    }

    #open() {
        this.#timer = 0;
        const socket = new WebSocket(this.#url);
        socket.binaryType = 'arraybuffer';
        this.#socket = socket;
        socket.onopen = () => {
            this.#retry_ms = kFirstRetryMs;
            this.#on.open();
        };
        socket.onmessage = ({data}) => {
            if (socket !== this.#socket) return;
            if (typeof data === 'string') {
                const note = parse_object(data);
                if (note) this.#on.note(note);
            } else {
                const picture = parse_picture(data);
                if (picture) this.#on.picture(picture.header, picture.bytes);
            }
        };
        socket.onclose = () => {
            if (socket !== this.#socket) return;
            this.#socket = null;
            this.#timer = setTimeout(() => this.#open(), this.#retry_ms);
            this.#on.lost(this.#retry_ms / 1000);
            this.#retry_ms = Math.min(2 * this.#retry_ms, kLongestRetryMs);
        };
    }

    #hasten() {
        if (!this.#timer) return;
        clearTimeout(this.#timer);
        this.#open();
    }
}
