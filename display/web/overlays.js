// Draws the partition over a picture, as in Samanta 2000, figures 10 and 14, and in the simulator's studies:
// the model is dimmed, tiles are tinted, transferred pixels turn white, boxes are wireframes. Everything
// follows from the plan and the objects note.

import {css_colour, ink_on, server_colour} from './colours.js';
import {area, borders, boxes_at, group_ids, hull, rectangles, wireframe} from './geometry.js';

const kDim = 0.4;  // black over the model, which leaves 0.6 of its brightness
const kTint = 0.32;
const kBehind = 0.3;  // a box leaves this much of the lines behind it
const kSlices = 24;
// More boxes would hold up the pictures, or the page itself.
export const kMostWhileMoving = 4000;
export const kMostBoxes = 12000;
const kWhitePerTransfer = 0.45;
const kWhitest = 0.9;
const kReplicated = {colour: 'rgb(255 196 46)', opacity: 0.95};
const kBoxes = {colour: 'rgb(130 205 255)', opacity: 0.8};
const kGroups = {opacity: 0.9};
const kNumberSize = 13;  // CSS pixels

export const kLayers = ['tiles', 'groups', 'boxes', 'swaths', 'overlap'];

// The object ids of each server; null if the plan has none.
export function groups_of(plan) {
    return plan?.groups?.map((deltas) => deltas ? group_ids(deltas) : []) ?? null;
}

// The opacity of white on pixels that are transferred `count` times.
export function whiteness(count) {
    return kWhitest * (1 - (1 - kWhitePerTransfer) ** count);
}

// Draws the layers of the set `show`. The canvas lies over the picture and has its own number of pixels.
// `objects` counts only if it has the plan's generation. `hot` is a server to point out; `at_rest` says
// whether there is time for finer lines.
export function draw_overlays(canvas, plan, objects, show, hot = null, at_rest = true) {
    const context = canvas.getContext('2d');
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, canvas.width, canvas.height);
    if (!plan || (show.size === 0 && hot === null)) return;
    const draw = new Layers(context, canvas, plan, at_rest);
    if (show.size > 0) draw.dim();
    if (show.has('tiles')) draw.tints();
    if (show.has('swaths')) draw.swaths();
    if (show.has('tiles') || show.has('swaths') || show.has('overlap')) draw.borders();
    const known = objects?.generation === plan.generation && objects.boxes;
    if (known && objects.count <= kMostBoxes && plan.clip?.length === 16) {
        const boxes = boxes_at(objects.boxes, objects.end_boxes, plan.pose);
        const servers = servers_by_object(plan);
        if (show.has('boxes')) draw.boxes(boxes, () => [kBoxes.colour], kBoxes.opacity);
        if (show.has('groups') && servers) {
            const colours = plan.tiles.map((_, server) => css_colour(server_colour(server)));
            draw.boxes(boxes, (id) => servers.get(id)?.map((server) => colours[server]), kGroups.opacity);
        }
        if (show.has('overlap') && servers)
            draw.boxes(boxes, (id) => servers.get(id)?.length > 1 ? [kReplicated.colour] : null,
                       kReplicated.opacity);
    }
    if (show.has('tiles')) draw.numbers();
    if (hot !== null) draw.outline(hot);
}

// A Map of object id to the servers that draw it; null if the plan does not say.
function servers_by_object(plan) {
    const groups = groups_of(plan);
    if (!groups) return null;
    const servers = new Map();
    groups.forEach((ids, server) => {
        for (const id of ids) {
            const known = servers.get(id);
            if (known) known.push(server);
            else servers.set(id, [server]);
        }
    });
    return servers;
}

class Layers {
    #to;
    #width;
    #height;
    #plan;
    #at_rest;
    #per_pixel;  // canvas pixels for a picture pixel

    constructor(context, {width, height}, plan, at_rest) {
        this.#to = context;
        this.#width = width;
        this.#height = height;
        this.#plan = plan;
        this.#per_pixel = width / plan.width;
        this.#at_rest = at_rest;
    }

    dim() {
        this.#to.fillStyle = `rgb(0 0 0 / ${kDim})`;
        this.#to.fillRect(0, 0, this.#width, this.#height);
    }

    tints() {
        this.#plan.tiles.forEach((tile, server) => {
            this.#to.fillStyle = css_colour(server_colour(server), kTint);
            this.#fill(this.#to, rectangles(tile));
        });
    }

    // n layers of 0.45 white make 1 - 0.55^n; of that 0.9.
    swaths() {
        const layer = this.#layer();
        layer.fillStyle = `rgb(255 255 255 / ${kWhitePerTransfer})`;
        for (const {rectangles: flat} of this.#plan.links ?? []) this.#fill(layer, rectangles(flat));
        this.#blend(layer, kWhitest);
    }

    borders() {
        const {width, height, tiles} = this.#plan;
        const thickness = Math.max(1, Math.floor((width + 320) / 640));
        tiles.forEach((tile, server) => {
            this.#to.fillStyle = css_colour(server_colour(server));
            this.#fill(this.#to, borders(tile, width, height, thickness));
        });
    }

    // Draws from far to near in slices, each of which fades the lines behind it. One slice a box would be
    // exact, but takes the browser too long. `colours_of` gives a box's colours, which take turns along its
    // edges; null: the box is not drawn.
    boxes(boxes, colours_of, opacity) {
        const {width, height, clip} = this.#plan;
        const frames = [];
        for (let id = 0; 6 * id < boxes.length; ++id) {
            const colours = colours_of(id);
            const frame = colours?.length ? wireframe(boxes, id, clip, width, height) : null;
            if (frame) frames.push({...frame, colours});
        }
        if (!this.#at_rest && frames.length > kMostWhileMoving) return;
        frames.sort((a, b) => b.depth - a.depth);
        const layer = this.#layer();
        // Browsers draw lines of one pixel several times as fast as any others.
        const fine = this.#at_rest && frames.length <= kMostWhileMoving;
        layer.lineWidth = fine ? Math.max(1, this.#width / 900) : 1;
        const size = Math.ceil(frames.length / kSlices);
        for (let begin = 0; begin < frames.length; begin += size)
            this.#slice(layer, frames.slice(begin, begin + size));
        this.#blend(layer, opacity);
    }

    #slice(layer, frames) {
        const scale = this.#per_pixel;
        const x = (at) => at * scale;
        const y = (at) => this.#height - at * scale;
        layer.globalCompositeOperation = 'destination-out';
        layer.fillStyle = `rgb(0 0 0 / ${1 - kBehind})`;
        layer.beginPath();
        const lines = new Map();  // colour to [x0, y0, x1, y1] of its lines
        for (const {edges, colours} of frames) {
            const points = [];
            for (let i = 0; i < edges.length; i += 5) {
                points.push([edges[i], edges[i + 1]], [edges[i + 2], edges[i + 3]]);
                const colour = colours[edges[i + 4] % colours.length];
                if (!lines.has(colour)) lines.set(colour, []);
                lines.get(colour).push(edges[i], edges[i + 1], edges[i + 2], edges[i + 3]);
            }
            hull(points).forEach((point, place) => {
                if (place === 0) layer.moveTo(x(point[0]), y(point[1]));
                else layer.lineTo(x(point[0]), y(point[1]));
            });
            layer.closePath();
        }
        layer.fill();
        layer.globalCompositeOperation = 'source-over';
        for (const [colour, ends] of lines) {
            layer.strokeStyle = colour;
            layer.beginPath();
            for (let i = 0; i < ends.length; i += 4) {
                layer.moveTo(x(ends[i]), y(ends[i + 1]));
                layer.lineTo(x(ends[i + 2]), y(ends[i + 3]));
            }
            layer.stroke();
        }
    }

    // Writes each server's number into its largest rectangle: colours alone do not name it.
    numbers() {
        const context = this.#to;
        const size = Math.round(kNumberSize * devicePixelRatio);
        context.font = `600 ${size}px system-ui, sans-serif`;
        context.textAlign = 'center';
        context.textBaseline = 'middle';
        this.#plan.tiles.forEach((tile, server) => {
            const sizes = rectangles(tile);
            if (sizes.length === 0) return;
            const [x0, y0, x1, y1] = sizes.reduce((best, next) => area(next) > area(best) ? next : best);
            const width = context.measureText(server).width + size;
            const scale = this.#per_pixel;
            if ((x1 - x0) * scale < width + 4 || (y1 - y0) * scale < size * 1.8) return;
            const x = (x0 + x1) / 2 * scale;
            const y = this.#height - (y0 + y1) / 2 * scale;
            const colour = server_colour(server);
            context.fillStyle = css_colour(colour);
            context.beginPath();
            context.roundRect(x - width / 2, y - size * 0.75, width, size * 1.5, size * 0.4);
            context.fill();
            context.fillStyle = ink_on(colour);
            context.fillText(server, x, y + size * 0.05);
        });
    }

    outline(server) {
        const {width, height, tiles} = this.#plan;
        if (!tiles[server]) return;
        this.#to.fillStyle = css_colour(server_colour(server));
        this.#fill(this.#to, borders(tiles[server], width, height, Math.ceil(3 / this.#per_pixel)));
    }

    #fill(context, list) {
        const scale = this.#per_pixel;
        context.beginPath();
        for (const [x0, y0, x1, y1] of list) {
            // Rounds both ends, so that neighbours leave no seam.
            const left = Math.round(x0 * scale);
            const top = Math.round(this.#height - y1 * scale);
            context.rect(left, top, Math.round(x1 * scale) - left,
                         Math.round(this.#height - y0 * scale) - top);
        }
        context.fill();
    }

    #layer() {
        const canvas = new OffscreenCanvas(this.#width, this.#height);
        return canvas.getContext('2d');
    }

    #blend(layer, opacity) {
        this.#to.globalAlpha = opacity;
        this.#to.drawImage(layer.canvas, 0, 0);
        this.#to.globalAlpha = 1;
    }
}
