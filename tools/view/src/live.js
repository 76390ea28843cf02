// A page of a run that goes on is written anew with each frame; it loads itself again and comes back as it was left.

const KEY = "hdem-view";

// What the last page of this file showed, taken over into this one. The place of the slider, where it was not the last one.
export async function remember(view, facts) {
    if (!facts.live) return null;
    let before = null;
    try {
        before = JSON.parse(sessionStorage.getItem(KEY));
    } catch {
        return null; // no storage here: the page begins anew each time
    }
    if (before?.names !== names(view)) return null;
    for (const [id, value] of Object.entries(before.chosen)) {
        const control = document.getElementById(id);
        if (!control) continue;
        if (control.type === "checkbox") control.checked = value;
        else control.value = value;
        control.dispatchEvent(new Event("change"));
    }
    view.panes.forEach((pane, i) => before.cameras[i] && Object.assign(pane.camera, before.cameras[i]));
    return before.atEnd ? null : before.place;
}

function keep(view) {
    const chosen = {};
    for (const control of document.querySelectorAll("aside select[id], aside input[id], footer select[id]")) chosen[control.id] = control.type === "checkbox" ? control.checked : control.value;
    const atEnd = view.place === view.timeline.length - 1;
    const cameras = view.panes.map(({ camera: { x, y, scale, fitted } }) => ({ x, y, scale, fitted }));
    try {
        sessionStorage.setItem(KEY, JSON.stringify({ names: names(view), chosen, cameras, place: view.place, atEnd }));
    } catch {
        // as above
    }
}

const names = (view) => view.runs.map((run) => run.facts.name).join("|");

export function startLive(view, facts) {
    const sign = document.getElementById("live");
    if (!facts.live) return;
    let follows = true, touched = 0;
    sign.hidden = false;
    const say = () => (sign.textContent = follows ? "● Live" : "○ Paused");
    say();
    sign.addEventListener("click", () => ((follows = !follows), say()));
    for (const kind of ["keydown", "pointerdown", "wheel"]) addEventListener(kind, () => (touched = performance.now()), { passive: true });
    const every = Math.max(1000 * facts.live.every, 4 * window.hdem.ready); // a page that takes long to open is loaded less often
    setInterval(() => {
        if (!follows || view.playing || document.hidden || performance.now() - touched < 2500) return;
        keep(view);
        location.reload();
    }, every);
}
