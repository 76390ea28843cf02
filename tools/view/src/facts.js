// What is known of one block, for the pointer and for the list beside the picture.
import { CLASSES, FIELDS, FLAG, digits, withUnit } from "./fields.js";
import { element } from "./dom.js";

const MOST_CONTACTS = 8;

const inDegrees = (value) => `${digits((value * 180) / Math.PI, 3)}°`;

// The nearest things, for the tip at the pointer: name, displacement, greatest force.
export function tipOf(pane, block) {
    const { run, frame, contacts, view } = pane, dx = frame.get("displacement_x")[block], dy = frame.get("displacement_y")[block];
    const lines = [["Displacement", `${withUnit(Math.hypot(dx, dy), "m", 3)}`], ["in x, y", `${withUnit(dx, "m", 3)}, ${withUnit(dy, "m", 3)}`]];
    if (FIELDS[view.field] && !view.field.startsWith("displacement")) lines.push([FIELDS[view.field].label, withUnit(frame.field(view.field)[block], FIELDS[view.field].unit, 3)]);
    else if (CLASSES[view.field] && view.field !== "none") lines.push([CLASSES[view.field].label, CLASSES[view.field].classes(view.runs)[CLASSES[view.field].numbers(frame, view.runs)[block]]?.[0] ?? "–"]);
    if (contacts) {
        const mine = contactsOf(contacts, block), net = mine.reduce((sum, one) => sum + one.normal, 0);
        lines.push(["Contacts", `${mine.length}`], ["Sum of normal forces", withUnit(net, "N", 3)]);
        if (mine.length) lines.push(["Greatest", `${withUnit(mine[0].normal, "N", 3)} from ${run.names[mine[0].other]}`]);
    }
    return [run.names[block], lines];
}

// Contacts of a block in this frame, the greatest normal force first.
export function contactsOf(contacts, block) {
    const { first, second } = contacts.rows, normal = contacts.get("normal_force"), shear = contacts.get("shear_force"), found = [];
    for (let i = 0; i < contacts.row.length; ++i) {
        const a = first[contacts.row[i]], b = second[contacts.row[i]];
        if (a === block || b === block) found.push({ other: a === block ? b : a, normal: normal[i], shear: shear[i] });
    }
    return found.sort((x, y) => y.normal - x.normal);
}

export function factsOf(pane, block) {
    const { run, frame, contacts } = pane, at = (name) => frame.get(name)[block], of = (name, unit) => withUnit(frame.field(name)[block], unit);
    const flags = frame.flags[block], [ox, oy] = run.facts.origin, pose = pane.scene.pose;
    const states = [[FLAG.fixed, "fixed"], [FLAG.detached, "detached"], [FLAG.next, "next to the excavation"]].filter(([flag]) => flags & flag).map(([, name]) => name);
    const rows = [
        ["Material", run.facts.materials[run.material[block]] ?? "–"], ["State", states.join(", ") || "free"],
        ["Centroid", `${digits(ox + pose[4 * block], 5)}, ${digits(oy + pose[4 * block + 1], 5)} m`],
        ["Area, mass", `${digits(run.area[block], 3)} m², ${digits(run.mass[block], 4)} kg/m`],
        ["Displacement", of("displacement", "m")], ["in x, y", `${withUnit(at("displacement_x"), "m", 3)}, ${withUnit(at("displacement_y"), "m", 3)}`],
        ["Rotation", inDegrees(at("rotation"))], ["Speed", of("speed", "m/s")],
        ["σ₁, σ₃", `${of("stress_1", "Pa")}, ${of("stress_3", "Pa")}`],
        ["σxx, σyy, σxy", ["stress_xx", "stress_yy", "stress_xy"].map((name) => withUnit(at(name), "Pa", 3)).join(", ")],
    ];
    const table = element("table", { className: "facts" }, ...rows.map(([name, value]) => element("tr", {}, element("th", { textContent: name }), element("td", { textContent: value }))));
    if (!contacts) return [table, element("p", { className: "note", textContent: "The page has no contacts of this frame." })];
    const mine = contactsOf(contacts, block);
    const head = element("tr", {}, ...["Contact with", "Normal", "Shear"].map((name) => element("th", { textContent: name })));
    const list = element("table", { className: "facts contacts" }, head, ...mine.slice(0, MOST_CONTACTS).map((one) =>
        element("tr", {}, element("td", { textContent: run.names[one.other] }), element("td", { textContent: withUnit(one.normal, "N", 3) }), element("td", { textContent: withUnit(one.shear, "N", 3) }))));
    const more = mine.length > MOST_CONTACTS ? [element("p", { className: "note", textContent: `and ${mine.length - MOST_CONTACTS} more` })] : [];
    return [table, list, ...more];
}
