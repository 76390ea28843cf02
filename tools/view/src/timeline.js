// Places of the time slider, and which frame of each run belongs to them.

const FITS = 1e-9;

// Of a frame: how far the run is, by its stages, its time or the number of the frame.
function progress(run, way) {
    const frames = run.frames;
    if (way === "time") return frames.map((frame) => frame.time);
    if (way === "frame") return frames.map((_, i) => i);
    const begins = [...new Set(frames.map((frame) => frame.begin))];
    return frames.map((frame) => {
        const stage = begins.indexOf(frame.begin), last = frames.findLast((other) => other.begin === frame.begin);
        const done = last.cycle > frame.begin ? (frame.cycle - frame.begin) / (last.cycle - frame.begin) : 1;
        return stage + 0.999 * done;
    });
}

export class Timeline {
    constructor(runs, way) {
        const each = runs.map((run) => progress(run, way));
        const all = [...new Set(each.flat())].sort((a, b) => a - b);
        this.places = all.filter((place, i) => i === 0 || place - all[i - 1] > FITS * Math.max(1, Math.abs(place)));
        // The last frame of each run that is not ahead of the place; before its first one, that.
        this.frames = this.places.map((place) => each.map((own) => Math.max(0, own.findLastIndex((one) => one <= place + FITS * Math.max(1, Math.abs(place))))));
    }

    get length() {
        return this.places.length;
    }

    // The place at which this run shows the frame whose time is nearest.
    placeOfTime(runs, time) {
        let best = 0, least = Infinity;
        this.frames.forEach((numbers, place) =>
            numbers.forEach((number, run) => {
                const distance = Math.abs(runs[run].frames[number].time - time);
                if (distance < least) (least = distance), (best = place);
            }));
        return best;
    }
}
