// Histories beside the blocks, with a mark that moves with the frames.
import uPlot from "uplot";
import { scaledUnit } from "./fields.js";
import { element } from "./dom.js";

const COLOURS = ["--c0", "--c1", "--c2", "--c3", "--c4", "--c5"];
const LOG_FROM = 1e3; // greatest value over least positive one, from which on energies stand on a logarithmic axis

const FAINT = 1e-12; // of the greatest value: less is round-off, and no tick of a logarithmic axis stands there
const TINY = 1e-9; // of its unit: axes that end below are counted in powers of ten, as ticks are rounded to sixteen digits

// What values are divided by, and how the axis says it.
function axisUnit(ofValues, greatest) {
    const [factor, unit] = scaledUnit(ofValues, greatest);
    if (!(greatest > 0) || greatest >= TINY * factor) return [factor, unit];
    const exponent = Math.floor(Math.log10(greatest / factor));
    return [factor * 10 ** exponent, `1e${exponent} ${unit}`.trim()];
}

const panelOf = (name, unit) => (unit !== "1" ? unit : name.endsWith("_points") ? "points" : name);

// As few digits as tell all ticks apart.
export function tickTexts(ticks) {
    const given = ticks.filter((tick) => tick !== null && tick !== undefined), far = (tick) => tick && (Math.abs(tick) >= 1e5 || Math.abs(tick) < 1e-3);
    for (let digits = 4; ; ++digits) {
        const texts = given.map((tick) => (given.some(far) ? (tick ? tick.toExponential(Math.max(0, digits - 4)) : "0") : `${+tick.toPrecision(digits)}`));
        if (digits < 12 && new Set(texts).size < new Set(given).size) continue;
        return ticks.map((tick) => (tick === null || tick === undefined ? "" : texts[given.indexOf(tick)]));
    }
}

// A position that changes little is drawn from its first value on, as hdem plot does it; 0 for anything else.
export function startOf(name, values) {
    if (!name.startsWith("position")) return 0;
    let [first, low, high] = [NaN, Infinity, -Infinity];
    for (const value of values) {
        if (!Number.isFinite(value)) continue;
        if (first !== first) first = value;
        if (value < low) low = value;
        if (value > high) high = value;
    }
    return high - low < 0.05 * Math.abs(first) ? first : 0;
}

export class Histories {
    constructor(root, onTime) {
        Object.assign(this, { root, onTime, charts: [], tables: [], time: 0 });
        this.watch = new ResizeObserver(() => {
            for (const chart of this.charts) chart.setSize({ width: this.root.clientWidth, height: chart.height });
        });
        this.watch.observe(root);
    }

    // `tables`: for each run the table with the chosen name, or undefined
    show(tables, names) {
        this.clear();
        const columns = tables.flatMap((table, run) => (table ? table.columns.map((column) => ({ ...column, run, time: table.time })) : []));
        const panels = new Map();
        for (const column of columns) {
            const panel = panelOf(column.name, column.unit);
            panels.set(panel, [...(panels.get(panel) ?? []), column]);
        }
        for (const same of panels.values()) this.add(same, names, tables.filter(Boolean).length > 1);
    }

    clear() {
        for (const chart of this.charts) chart.destroy();
        this.charts = [];
        this.root.replaceChildren();
    }

    add(columns, names, several) {
        const style = getComputedStyle(document.documentElement), ink = style.getPropertyValue("--soft"), grid = style.getPropertyValue("--grid");
        const starts = columns.map(({ name, values }) => startOf(name, values));
        let greatest = 0, least = Infinity;
        columns.forEach(({ values }, i) => {
            for (const value of values) {
                const size = Math.abs(value - starts[i]);
                if (size > greatest) greatest = size;
                if (value > 0 && value < least) least = value;
            }
        });
        const log = columns.every(({ unit, name }) => unit === "J" || name === "unbalanced_force_ratio") && greatest > LOG_FROM * least;
        const [factor, unit] = axisUnit(columns[0].unit, greatest);
        const scaled = columns.map(({ values }, i) => Array.from(values, (value) => (log && !(value > FAINT * greatest) ? null : Number.isFinite(value) ? (value - starts[i]) / factor : null)));
        const data = uPlot.join(columns.map(({ time }, i) => [Array.from(time), scaled[i]]));
        const kinds = [...new Set(columns.map(({ name }) => name))];
        const axis = { stroke: ink, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid, width: 1 }, font: "11px system-ui, sans-serif" };
        const series = columns.map(({ name, run, unit: own }, i) => ({
            label: name.replaceAll("_", " ") + (starts[i] ? ` from ${+starts[i].toPrecision(6)} ${own}` : "") + (several ? ` · ${names[run]}` : ""), stroke: style.getPropertyValue(COLOURS[kinds.indexOf(name) % COLOURS.length]),
            width: 1.5, dash: run ? [6, 3] : undefined, spanGaps: true, points: { show: false },
        }));
        const holder = element("div", { className: "chart" });
        this.root.append(holder);
        const chart = new uPlot({
            width: this.root.clientWidth, height: 150, scales: { x: { time: false }, y: { distr: log ? 3 : 1 } },
            axes: [{ ...axis, size: 26, values: (_, ticks) => tickTexts(ticks) },
                   { ...axis, ...(log ? { grid: { show: false }, ticks: { show: false } } : {}), size: (_, texts) => Math.max(52, 14 + 7 * Math.max(0, ...(texts ?? []).map((text) => text.length))), values: (_, ticks) => tickTexts(ticks) }],
            series: [{ label: "s", value: (_, time) => (time === null || time === undefined ? "–" : time.toPrecision(5)) }, ...series],
            legend: { live: false }, cursor: { sync: { key: "hdem" }, drag: { x: true, y: false }, points: { size: 5 } }, hooks: { draw: [(u) => this.drawMark(u)] },
        }, data, holder);
        holder.prepend(element("b", { textContent: unit ? `[${unit}]` : "[–]" }));
        let down = null;
        chart.over.addEventListener("pointerdown", (event) => (down = event.clientX));
        chart.over.addEventListener("pointerup", (event) => {
            if (down !== null && Math.abs(event.clientX - down) < 4) this.onTime(chart.posToVal(event.offsetX, "x"));
            down = null;
        });
        this.charts.push(chart);
    }

    drawMark(chart) {
        const x = chart.valToPos(this.time, "x", true), { left, top, width, height } = chart.bbox;
        this.markAt = x;
        if (!(x >= left - 1 && x <= left + width + 1)) return;
        const style = getComputedStyle(document.documentElement), { ctx } = chart;
        ctx.save();
        ctx.strokeStyle = style.getPropertyValue("--mark");
        ctx.lineWidth = 2 * (window.devicePixelRatio || 1);
        ctx.beginPath();
        ctx.moveTo(x, top);
        ctx.lineTo(x, top + height);
        ctx.stroke();
        ctx.restore();
    }

    moveTo(time) {
        if (time === this.time) return;
        this.time = time;
        for (const chart of this.charts) chart.redraw(false, false);
    }
}
