// Opens pages of hdem view in a real browser and says what happens there, as one line of JSON. Called by view_test.py.
//     node view_browser.mjs MODULES CHROMIUM SCRATCH WHAT PAGE    MODULES: folder of node_modules with playwright-core
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const [modules, program, scratch, what, file] = process.argv.slice(2);
const { chromium } = createRequire(join(resolve(modules), "any.js"))("playwright-core");

const PATIENCE = 120000; // ms for anything that a page does by itself: no limit that a busy machine comes near to

async function open(browser, said, { path = file, script = null } = {}) {
    const page = await browser.newPage({ viewport: { width: 1200, height: 800 } });
    page.setDefaultTimeout(PATIENCE);
    if (script) await page.addInitScript(script);
    page.on("console", (message) => message.type() === "error" && said.problems.push(message.text()));
    page.on("pageerror", (error) => said.problems.push(`${error.message} ${error.stack}`));
    page.on("request", (request) => request.url().startsWith("blob:") || said.requests.push(request.url()));
    const begin = Date.now();
    await page.goto(`file://${resolve(path)}`, { waitUntil: "commit" });
    // A page that is still read has no message yet.
    await page.waitForFunction(() => window.hdem || document.getElementById("message")?.hidden === false);
    said.opened = (Date.now() - begin) / 1000;
    await page.waitForFunction(() => !window.hdem || window.hdem.histories !== undefined); // they come after the first picture
    return page;
}

const state = (page) => page.evaluate(() => {
    const { view } = window.hdem, [pane] = view.panes, { camera } = pane;
    return { counter: document.getElementById("counter").textContent, place: view.place, field: view.field, playing: view.playing, caption: pane.caption.textContent, layers: view.layers,
             joint: view.joint, scale: camera.scale, x: camera.x, y: camera.y, theme: document.documentElement.dataset.theme ?? "auto", drawn: view.drawn, pinned: pane.pinned,
             legend: document.getElementById("legend").textContent, block: document.getElementById("block").textContent, time: window.hdem.histories?.time, mark: window.hdem.histories?.markAt };
});

// After the frame that was asked for is on the screen, to the pixel, and nothing is still to be drawn.
async function settled(page) {
    await page.waitForFunction(() => {
        const { view } = window.hdem;
        return !view.busy && !view.due && view.panes.every((pane) => pane.shown === pane.wanted && pane.isExact);
    });
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

// What the tip says, once it is about this block.
async function tipOver(page, block) {
    await page.mouse.move(...(await placeOf(page, block)));
    await page.waitForFunction((name) => document.querySelector(".tip:not([hidden]) b")?.textContent === name, block);
    return page.locator(".tip").textContent();
}

async function press(page, ...keys) {
    for (const key of keys) await page.keyboard.press(key);
    await settled(page);
    return state(page);
}

// Of the picture alone, without what stands over it.
async function picture(page, name, pane = 0) {
    await settled(page);
    await page.evaluate(() => document.querySelectorAll(".caption, .scale-bar").forEach((one) => (one.style.visibility = "hidden")));
    await page.locator(".pane").nth(pane).screenshot({ path: join(scratch, `${name}.png`) });
}

const placeOf = (page, name) => page.evaluate((wanted) => {
    const [pane] = window.hdem.view.panes, block = pane.run.names.indexOf(wanted), { pose } = pane.scene, box = pane.canvas.getBoundingClientRect();
    const [x, y] = pane.camera.toScreen(pose[4 * block], pose[4 * block + 1]);
    return [box.left + x, box.top + y];
}, name);

// Before the scripts of a page: it loads itself again only when it is told that it may, however slow what comes before is.
const HELD = "{ const set = window.setInterval.bind(window); window.setInterval = (call, every) => set(() => window.mayReload && call(), every); }";

const steps = {
    async keys(browser, said) {
        const page = await open(browser, said);
        said.begin = await state(page);
        await page.selectOption("#field", "none");
        await press(page, "e", "o");
        await picture(page, "last");
        said.home = await press(page, "Home");
        await picture(page, "first");
        said.right = await press(page, "ArrowRight", "ArrowRight");
        said.left = await press(page, "ArrowLeft");
        said.end = await press(page, "End");
        await page.selectOption("#field", "state");
        await picture(page, "states");
        await page.selectOption("#field", "displacement");
        await picture(page, "hatched");
        said.second = await press(page, "2");
        await page.selectOption("#field", "none");
        said.forces = await press(page, "c");
        await picture(page, "forces");
        said.crosses = await press(page, "c", "s");
        await picture(page, "crosses");
        said.joints = await press(page, "s", "j");
        await picture(page, "joints");
        said.outlined = await press(page, "j", "j", "j", "o");
        await picture(page, "outlined");
        await page.keyboard.press("Home");
        await settled(page);
        await page.keyboard.press(" ");
        await page.waitForFunction(() => window.hdem.view.place >= 3);
        said.playing = await state(page);
        said.stopped = await press(page, " ");
        const dark = await press(page, "t", "t");
        said.theme = dark.theme;
        await picture(page, "dark");
    },
    async pointer(browser, said) {
        const page = await open(browser, said);
        await settled(page);
        said.tip = await tipOver(page, "ball");
        await page.mouse.click(...(await placeOf(page, "ball")));
        await page.waitForFunction(() => window.hdem.view.panes[0].pinned >= 0);
        said.pinned = await state(page);
        said.groundTip = await tipOver(page, "ground");
        const before = await state(page), ground = await placeOf(page, "ground");
        await page.mouse.wheel(0, -400); // does not wait
        await page.waitForFunction((scale) => window.hdem.view.panes[0].camera.scale !== scale, before.scale);
        await settled(page);
        said.zoom = [before.scale, (await state(page)).scale];
        await page.mouse.down();
        await page.mouse.move(ground[0] + 120, ground[1] + 40, { steps: 5 });
        await page.mouse.up();
        await settled(page);
        const moved = await state(page);
        said.moved = [before, moved].map(({ x, y }) => [x, y]);
        said.stillPinned = moved.pinned;
        said.fitted = await press(page, "f");
        said.escaped = await press(page, "Escape");
        const over = page.locator(".u-over").first(), box = await over.boundingBox();
        said.markAtEnd = (await state(page)).mark;
        await page.mouse.click(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
        await settled(page);
        said.atHalf = await state(page);
        said.charts = await page.locator(".chart").count();
        await page.selectOption("#magnify", "10");
        said.magnified = await page.evaluate(() => Array.from(window.hdem.view.panes[0].scene.pose.slice(0, 16)));
        await page.selectOption("#scope", "manual");
        await page.locator(".manual input").nth(1).fill("0.5");
        await page.locator(".manual input").nth(1).press("Enter");
        said.manual = (await state(page)).legend;
    },
    async positions(browser, said) {
        const page = await open(browser, said);
        await settled(page);
        said.labels = await page.locator(".chart .u-series .u-label").allTextContents();
        said.units = await page.locator(".chart > b").allTextContents();
    },
    async support(browser, said) {
        const page = await open(browser, said);
        await page.selectOption("#field", "none");
        await press(page, "e", "o");
        await picture(page, "drawn");
        said.drawn = await state(page);
        const has = async (id) => (await page.locator(id).count()) > 0;
        if (await has("#lining")) {
            said.moment = await press(page, "l");
            await picture(page, "moment");
            said.line = await press(page, "l");
            await picture(page, "line");
        }
        if (await has("#layer-water")) await press(page, "w");
        if (await has("#lining")) await press(page, "l");
        await picture(page, "without");
    },
    async extent(browser, said) {
        const page = await open(browser, said);
        await settled(page);
        Object.assign(said, await page.evaluate(() => {
            const [pane] = window.hdem.view.panes, [ox, oy] = pane.run.facts.origin, there = ([x0, y0, x1, y1]) => [x0 + ox, y0 + oy, x1 + ox, y1 + oy];
            return { box: there(pane.box), seen: there(pane.camera.view) };
        }));
    },
    async emptied(browser, said) {
        const page = await open(browser, said);
        await page.selectOption("#field", "none");
        await press(page, "e", "o");
        said.last = await state(page);
        await picture(page, "emptied_last");
        said.first = await press(page, "Home");
        await picture(page, "emptied_first");
        await page.mouse.click(...(await placeOf(page, "ball")));
        await page.waitForFunction(() => window.hdem.view.panes[0].pinned >= 0);
        await press(page, "c", "s", "j", "b"); // nothing of an empty frame can be drawn, and nothing fails
        said.pinned = await press(page, "End");
    },
    async compare(browser, said) {
        const page = await open(browser, said);
        await settled(page);
        said.panes = await page.evaluate(() => window.hdem.view.panes.map((pane) => pane.caption.textContent));
        await page.selectOption("#field", "none");
        await press(page, "e", "o");
        await picture(page, "compare0", 0);
        await picture(page, "compare1", 1);
        said.scales = await page.evaluate(() => window.hdem.view.panes.map((pane) => pane.camera.scale));
        await page.selectOption("#match", "time");
        await press(page, "Home", "ArrowRight", "ArrowRight", "ArrowRight");
        said.times = await page.evaluate(() => window.hdem.view.panes.map((pane) => pane.entry.time));
        const scale = said.scales[0];
        await page.mouse.move(200, 300);
        await page.mouse.wheel(0, -300);
        await page.waitForFunction((before) => window.hdem.view.panes[0].camera.scale !== before, scale);
        await settled(page);
        said.cameras = await page.evaluate(() => window.hdem.view.panes.map(({ camera, run }) => [camera.x + run.facts.origin[0], camera.y + run.facts.origin[1], camera.scale]));
        said.series = await page.locator(".u-legend .u-label").allTextContents();
    },
    async materials(browser, said) {
        const page = await open(browser, said);
        await settled(page);
        said.first = await state(page);
        await page.selectOption("#field", "material");
        await press(page, "e", "o");
        said.entries = await page.evaluate(() => [...document.querySelectorAll("#legend .entry")].map((entry) => [entry.textContent, entry.querySelector("i").style.background]));
        said.scales = await page.evaluate(() => window.hdem.view.panes.map((pane) => pane.camera.scale));
        await picture(page, "materials0", 0);
        await picture(page, "materials1", 1);
        await page.mouse.move(...(await placeOf(page, "m")));
        said.tip = await page.locator(".tip:not([hidden])").textContent();
    },
    async many(browser, said) {
        const page = await open(browser, said);
        await settled(page);
        said.blocks = await page.evaluate(() => window.hdem.runs[0].count);
        said.hasSheet = await page.evaluate(() => !!window.hdem.view.panes[0].scene.sheet);
        await press(page, "e", "o");
        await page.evaluate(() => { // each block in a colour of its own
            const { view } = window.hdem, [pane] = view.panes;
            pane.paint = function () {
                for (let i = 0; i < this.run.count; ++i) this.scene.colour.set([(97 * i) % 256, (57 * i + 40) % 256, (31 * i + 90) % 256, this.frame.present[i] ? (i % 3 ? 255 : 128) : 0], 4 * i);
            };
            pane.update();
        });
        await picture(page, "sheet");
        await page.evaluate(() => { const { view } = window.hdem; view.panes[0].camera.zoom(1.31, 100, 130); view.cameraMoved(view.panes[0]); });
        await picture(page, "sheet_zoomed");
        await press(page, "Home");
        await picture(page, "sheet_first");
        await press(page, "f", "-"); // a sheet of how they stand
        said.moved = await page.evaluate(() => { // those at the right side stand beside the model, and are turned there
            const { view } = window.hdem, [pane] = view.panes, { scene, run } = pane, { pose } = scene, x1 = pane.box[2];
            for (let i = 0; i < run.count; ++i) if (pose[4 * i] > x1 - 12) pose[4 * i] += 20, ([pose[4 * i + 2], pose[4 * i + 3]] = [pose[4 * i + 2] - 1e-2 * pose[4 * i + 3], pose[4 * i + 3] + 1e-2 * pose[4 * i + 2]]);
            scene.upload(view.ground);
            view.redraw();
            return scene.sheet.moved.length;
        });
        await picture(page, "sheet_moved");
        said.stillMoved = await page.evaluate(() => window.hdem.view.panes[0].scene.sheet.moved.length);
        const exact = () => page.evaluate(() => { const { view } = window.hdem; view.panes[0].scene.sheet = null; view.redraw(); });
        await exact();
        await picture(page, "exact_moved");
        await press(page, "End");
        await press(page, "Home");
        await page.evaluate(() => { const { view } = window.hdem, [pane] = view.panes; view.fit(); pane.camera.zoom(1.31, 100, 130); view.cameraMoved(pane); });
        await picture(page, "exact_first");
        await press(page, "End");
        await picture(page, "exact_zoomed");
        await press(page, "f");
        await picture(page, "exact");
    },
    async speed(browser, said) {
        const page = await open(browser, said);
        await page.waitForTimeout(4000); // the other frames are read in the background
        Object.assign(said, await page.evaluate(async () => {
            const { view, runs } = window.hdem, [pane] = view.panes;
            const count = async (what) => {
                const begin = performance.now(), drawn = view.drawn;
                for (let n = 0; performance.now() - begin < 4000; ++n) {
                    await new Promise((done) => requestAnimationFrame(done));
                    await what(n);
                }
                return (1000 * (view.drawn - drawn)) / (performance.now() - begin);
            };
            const pan = await count((n) => (pane.camera.pan(8 * Math.sin(n / 5), 8 * Math.cos(n / 7)), view.cameraMoved(pane)));
            const zoom = await count((n) => (pane.camera.zoom(n % 40 < 20 ? 1.02 : 1 / 1.02), view.cameraMoved(pane)));
            view.fit();
            await new Promise((done) => setTimeout(done, 500));
            const play = await count((n) => view.goTo(n % view.timeline.length));
            return { blocks: runs[0].count, frames: runs[0].frames.length, pan, zoom, play };
        }));
    },
    async live(browser, said) {
        const page = await open(browser, said, { script: HELD });
        said.sign = await page.evaluate(() => document.getElementById("live").hidden ? "" : document.getElementById("live").textContent);
        await press(page, "Home");
        await page.selectOption("#field", "speed");
        await page.evaluate(() => (window.isFirst = window.mayReload = true));
        await page.waitForFunction(() => !window.isFirst && window.hdem);
        await settled(page);
        said.again = await state(page);
    },
};

const said = { problems: [], requests: [] };
const browser = await chromium.launch({ executablePath: program, args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"] });
try {
    await steps[what](browser, said);
} catch (error) {
    said.problems.push(`${error.message}\n${error.stack}`);
} finally {
    await browser.close();
}
console.log(JSON.stringify(said));
