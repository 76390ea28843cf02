// Mouse, pen and fingers over a pane: pan, zoom, point at a block, pin it.
import { tipOf } from "./facts.js";
import { element } from "./dom.js";

const CLICK = 4; // pixels that a click may move

export function followPointer(pane, view) {
    const { canvas } = pane, down = new Map();
    let moved = 0, spread = 0;
    const place = (event) => {
        const box = canvas.getBoundingClientRect();
        return [event.clientX - box.left, event.clientY - box.top];
    };
    canvas.addEventListener("wheel", (event) => {
        event.preventDefault();
        pane.camera.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0016)), ...place(event));
        view.cameraMoved(pane);
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => {
        canvas.setPointerCapture(event.pointerId);
        canvas.focus({ preventScroll: true });
        down.set(event.pointerId, place(event));
        if (down.size === 1) moved = 0;
        spread = distance(down);
    });
    canvas.addEventListener("pointermove", (event) => {
        const here = place(event), before = down.get(event.pointerId);
        if (!before) return point(pane, view, here);
        const [dx, dy] = [here[0] - before[0], here[1] - before[1]];
        moved += Math.hypot(dx, dy);
        down.set(event.pointerId, here);
        if (moved < CLICK) return;
        point(pane, view, null);
        pane.camera.pan(dx / down.size, dy / down.size);
        if (down.size === 2) {
            const now = distance(down), [a, b] = [...down.values()];
            pane.camera.zoom(now / spread, 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]));
            spread = now;
        }
        view.cameraMoved(pane);
    });
    for (const kind of ["pointerup", "pointercancel"])
        canvas.addEventListener(kind, (event) => {
            if (kind === "pointerup" && down.size === 1 && moved < CLICK && event.button === 0) view.pin(pane, pane.blockAt(...place(event)));
            down.delete(event.pointerId);
        });
    canvas.addEventListener("pointerleave", () => point(pane, view, null));
    canvas.addEventListener("dblclick", (event) => {
        pane.camera.zoom(2, ...place(event));
        view.cameraMoved(pane);
    });
}

function distance(down) {
    const [a, b] = [...down.values()];
    return b ? Math.max(1, Math.hypot(a[0] - b[0], a[1] - b[1])) : 1;
}

// The tip stands beside the pointer, inside of the pane.
export function point(pane, view, here) {
    const block = here ? pane.blockAt(...here) : -1;
    pane.pointer = here;
    if (block !== pane.hovered) {
        pane.hovered = block;
        pane.mark("hovered", block);
        view.redraw();
    }
    pane.tip.hidden = block < 0;
    if (block < 0) return;
    const [name, lines] = tipOf(pane, block);
    pane.tip.replaceChildren(element("b", { textContent: name }), element("table", {}, ...lines.map(([what, value]) =>
        element("tr", {}, element("th", { textContent: what }), element("td", { textContent: value })))));
    const { width, height } = pane.tip.getBoundingClientRect();
    const left = here[0] + 16 + width > pane.camera.width ? here[0] - width - 12 : here[0] + 16;
    const top = here[1] + 14 + height > pane.camera.height ? here[1] - height - 10 : here[1] + 14;
    pane.tip.style.transform = `translate(${Math.max(4, left)}px, ${Math.max(4, top)}px)`;
}
