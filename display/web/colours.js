// The colour of a server, as in the simulator's pictures: steps of the plastic number's sequence through hue
// and lightness in Björn Ottosson's OKLCH, so that neighbours differ however many there are.

export function server_colour(id) {
    const step = (part) => (0.5 + part * id) % 1;
    return from_oklch(0.56 + 0.34 * step(0.5698402909980532), 0.15, step(0.7548776662466927));
}

export function css_colour([red, green, blue], opacity = 1) {
    return `rgb(${red} ${green} ${blue} / ${opacity})`;
}

// Black or white, whichever reads better on the colour (by WCAG's contrast).
export function ink_on(rgb) {
    const [r, g, b] = rgb.map((byte) => {
        const v = byte / 255;
        return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
    });
    return 0.2126 * r + 0.7152 * g + 0.0722 * b > 0.179 ? '#000' : '#fff';
}

function from_oklch(lightness, chroma, turns) {
    const a = chroma * Math.cos(2 * Math.PI * turns);
    const b = chroma * Math.sin(2 * Math.PI * turns);
    const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
    const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
    const s = (lightness - 0.0894841775 * a - 1.2914855480 * b) ** 3;
    return [
        4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
        -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
        -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s,
    ].map((linear) => {
        const v = Math.min(Math.max(linear, 0), 1);
        return Math.floor((v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055) * 255 + 0.5);
    });
}
