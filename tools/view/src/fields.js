// What blocks can be coloured by. A field gives a value for each block of a frame.

// A loop: from() takes ten times as long.
function filled(type, count, value) {
    const all = new type(count);
    for (let i = 0; i < count; ++i) all[i] = value(i);
    return all;
}

const magnitude = (x, y) => filled(Float32Array, x.length, (i) => Math.sqrt(x[i] * x[i] + y[i] * y[i]));

function principal(frame, sign) {
    const xx = frame.get("stress_xx"), yy = frame.get("stress_yy"), xy = frame.get("stress_xy");
    return filled(Float32Array, xx.length, (i) => {
        const half = 0.5 * (xx[i] - yy[i]);
        return 0.5 * (xx[i] + yy[i]) + sign * Math.sqrt(half * half + xy[i] * xy[i]);
    });
}

// motion: what is detached has far more of it than the others. grows: counts since the stage began.
const stored = (name) => (frame) => frame.get(name);
const field = (label, unit, values, more = {}) => ({ label, unit, values, ...more });

export const FIELDS = {
    displacement: field("Displacement", "m", (f) => magnitude(f.get("displacement_x"), f.get("displacement_y")), { motion: true, grows: true }),
    displacement_x: field("Displacement in x", "m", stored("displacement_x"), { motion: true, signed: true, grows: true }),
    displacement_y: field("Displacement in y", "m", stored("displacement_y"), { motion: true, signed: true, grows: true }),
    rotation: field("Rotation", "rad", stored("rotation"), { motion: true, signed: true, grows: true }),
    speed: field("Speed", "m/s", (f) => magnitude(f.get("velocity_x"), f.get("velocity_y")), { motion: true }),
    velocity_x: field("Velocity in x", "m/s", stored("velocity_x"), { motion: true, signed: true }),
    velocity_y: field("Velocity in y", "m/s", stored("velocity_y"), { motion: true, signed: true }),
    angular_velocity: field("Angular velocity", "rad/s", stored("angular_velocity"), { motion: true, signed: true }),
    kinetic_energy: field("Kinetic energy", "J", stored("kinetic_energy"), { motion: true }),
    stress_magnitude: field("Stress, magnitude", "Pa", (f) => {
        const xx = f.get("stress_xx"), yy = f.get("stress_yy"), xy = f.get("stress_xy");
        return filled(Float32Array, xx.length, (i) => Math.sqrt(xx[i] * xx[i] + yy[i] * yy[i] + 2 * xy[i] * xy[i]));
    }),
    stress_1: field("Greatest principal stress", "Pa", (f) => principal(f, 1), { signed: true }),
    stress_3: field("Least principal stress", "Pa", (f) => principal(f, -1), { signed: true }),
    stress_xx: field("Stress σxx", "Pa", stored("stress_xx"), { signed: true }),
    stress_yy: field("Stress σyy", "Pa", stored("stress_yy"), { signed: true }),
    stress_xy: field("Stress σxy", "Pa", stored("stress_xy"), { signed: true }),
};

const REGIMES = [["No contact", "#c9ccd1"], ["Force", "#56b4e9"], ["Impulse", "#d55e00"]];
const STATES = [["Free", "#d9cfb4"], ["Fixed", "#8d949c"], ["Next to the excavation", "#56b4e9"], ["Detached", "#d55e00"]];
const MATERIALS = ["#e8d9b5", "#56b4e9", "#009e73", "#e69f00", "#cc79a7", "#0072b2", "#f0e442", "#d55e00"];

export const FLAG = { regime: 3, fixed: 4, detached: 8, next: 16 };

function stateOf(flags) {
    return flags & FLAG.detached ? 3 : flags & FLAG.fixed ? 1 : flags & FLAG.next ? 2 : 0;
}

// Of all runs of the page, each name once: numbers of a run are its own.
const materialNames = (runs) => [...new Set(runs.flatMap((run) => run.facts.materials))];

function materialNumbers(frame, runs) {
    const names = materialNames(runs), { material, facts } = frame.run, numbers = facts.materials.map((name) => names.indexOf(name));
    return filled(Uint32Array, material.length, (i) => numbers[material[i]]);
}

// Classes: a number for each block, and the name and colour of each number, the same in all runs of the page.
export const CLASSES = {
    regime: { label: "Contact regime", classes: () => REGIMES, numbers: (frame) => filled(Uint8Array, frame.flags.length, (i) => frame.flags[i] & FLAG.regime) },
    state: { label: "State", classes: () => STATES, numbers: (frame) => filled(Uint8Array, frame.flags.length, (i) => stateOf(frame.flags[i])) },
    material: {
        label: "Material", classes: (runs) => materialNames(runs).map((name, i) => [name, MATERIALS[i % MATERIALS.length]]),
        numbers: materialNumbers,
    },
    none: { label: "None", classes: () => [["Blocks", "#e3d8bd"]], numbers: (frame) => new Uint8Array(frame.run.count) },
};

const OWN = new Set(["index", "flags", "displacement_x", "displacement_y", "rotation"]);

// Those that a later version of hdem's frames may have besides.
export function addFieldsOf(facts) {
    for (const frame of facts.frames)
        for (const [name, coding] of frame.chunk.layout)
            if (coding === "f2" && !OWN.has(name) && !FIELDS[name]) {
                const label = name.replaceAll("_", " ");
                FIELDS[name] = field(label[0].toUpperCase() + label.slice(1), "", stored(name), { signed: true });
            }
}

const PREFIXES = {
    m: [[1, "m"], [1e-3, "mm"], [1e-6, "µm"]], "m/s": [[1, "m/s"], [1e-3, "mm/s"], [1e-6, "µm/s"]], rad: [[Math.PI / 180, "°"]],
    Pa: [[1e6, "MPa"], [1e3, "kPa"], [1, "Pa"]], N: [[1e6, "MN"], [1e3, "kN"], [1, "N"]], "N m": [[1e6, "MN m"], [1e3, "kN m"], [1, "N m"]],
};

// Factor and name of the unit in which a number of this size reads best.
export function scaledUnit(unit, greatest) {
    const choice = PREFIXES[unit] ?? [[1, unit === "1" ? "" : unit]];
    return choice.find(([factor]) => greatest >= factor) ?? choice[choice.length - 1];
}

export function digits(value, count = 4) {
    if (!Number.isFinite(value)) return "–";
    const size = Math.abs(value);
    if (value === 0) return "0";
    const text = size >= 1e5 || size < 1e-3 ? value.toExponential(Math.max(0, count - 2)).replace("e+", "e") : String(+value.toPrecision(count));
    return text.replace("-", "−").replace("e-", "e−");
}

// Nothing is written in the greatest unit.
export function withUnit(value, unit, count = 4) {
    const [factor, name] = scaledUnit(unit, value === 0 ? Infinity : Math.abs(value));
    return `${digits(value / factor, count)} ${name}`.trim();
}
