// From values to colours: maps that are safe for the common kinds of colour blindness, the same as those of hdem plot.
import { interpolateRdBu, interpolateYlGnBu, interpolateViridis, interpolateCividis, interpolateInferno } from "d3-scale-chromatic";

export const MAPS = {
    standard: { label: "Standard", one: (t) => interpolateYlGnBu(t), two: (t) => interpolateRdBu(1 - t) },
    viridis: { label: "Viridis", one: interpolateViridis, two: interpolateViridis },
    cividis: { label: "Cividis", one: interpolateCividis, two: interpolateCividis },
    inferno: { label: "Inferno", one: interpolateInferno, two: interpolateInferno },
};

export function rgb(text) {
    if (text[0] === "#") return [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16));
    return text.match(/[\d.]+/g).slice(0, 3).map(Number);
}

// 256 colours as bytes
export function table(map, signed) {
    const bytes = new Uint8Array(256 * 3), take = signed ? MAPS[map].two : MAPS[map].one;
    for (let i = 0; i < 256; ++i) bytes.set(rgb(take(i / 255)), 3 * i);
    return bytes;
}

// How a block's colour is drawn, in its fourth byte.
export const GONE = 0, PLAIN = 255, HATCHED = 128;
const NO_VALUE = [170, 170, 170], FALLEN = [247, 207, 174];

export function colourByValue(out, frame, values, [low, high], bytes, hatchDetached) {
    const factor = high > low ? 255 / (high - low) : 0;
    for (let i = 0, to = 0; i < frame.run.count; ++i, to += 4) {
        if (!frame.present[i]) {
            out[to + 3] = GONE;
            continue;
        }
        const hatched = hatchDetached && frame.isDetached(i), value = values[i];
        out[to + 3] = hatched ? HATCHED : PLAIN;
        if (hatched || value !== value) {
            const c = hatched ? FALLEN : NO_VALUE;
            out[to] = c[0], (out[to + 1] = c[1]), (out[to + 2] = c[2]);
            continue;
        }
        const place = 3 * Math.min(255, Math.max(0, Math.round((value - low) * factor)));
        out[to] = bytes[place], (out[to + 1] = bytes[place + 1]), (out[to + 2] = bytes[place + 2]);
    }
}

export function colourByClass(out, frame, numbers, classes) {
    const colours = classes.map(([, colour]) => rgb(colour));
    for (let i = 0, to = 0; i < frame.run.count; ++i, to += 4) {
        const c = colours[numbers[i]] ?? NO_VALUE;
        out[to] = c[0], (out[to + 1] = c[1]), (out[to + 2] = c[2]), (out[to + 3] = frame.present[i] ? PLAIN : GONE);
    }
}
