// Bundles the page of hdem view into one template without data: node build.mjs NODE_MODULES OUTPUT.html
import { createRequire } from "node:module";
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const [modules, output] = process.argv.slice(2).map((path) => resolve(path)), here = dirname(fileURLToPath(import.meta.url));
const { buildSync } = createRequire(join(modules, "any.js"))("esbuild");
const common = { bundle: true, minify: true, write: false, nodePaths: [modules], legalComments: "none", logLevel: "warning", metafile: true, charset: "utf8" };

const script = buildSync({ ...common, entryPoints: [join(here, "src/main.js")], format: "esm", target: "es2022" });
const style = buildSync({ ...common, entryPoints: [join(here, "src/style.js")], outdir: "none" });
const css = style.outputFiles.find((file) => file.path.endsWith(".css")).text;

// The licences of what is bundled go into every page, as they ask for it.
const inputs = [script, style].flatMap((made) => Object.keys(made.metafile.inputs)), bundled = new Set();
for (const input of inputs) {
    const found = input.match(/.*node_modules\/((?:@[^/]+\/)?[^/]+)\//);
    if (found) bundled.add(found[1]);
}
const licences = [...bundled].sort().map((name) => {
    const folder = join(modules, name), { version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const file = ["LICENSE", "LICENSE.md", "LICENSE.txt"].find((one) => { try { return readFileSync(join(folder, one)); } catch { return false; } });
    if (!file) throw new Error(`${name} has no licence text`);
    return `${name} ${version} (${license})\n\n${readFileSync(join(folder, file), "utf8").trim()}`;
});
const notice = `This page holds code of:\n\n${licences.join("\n\n----\n\n")}`.replaceAll("--", "- -").replaceAll(/https?:\/\//g, "");

const put = (text, mark, what) => {
    if (text.split(mark).length !== 2) throw new Error(`index.html: ${mark} must stand there once`);
    return text.replace(mark, () => what);
};
let page = readFileSync(join(here, "index.html"), "utf8");
page = put(page, "/*STYLE*/", css);
page = put(page, "/*SCRIPT*/", script.outputFiles[0].text.trim());
page = put(page, "<!--DATA-->", `<!--\n${notice}\n-->\n<!--DATA-->`);
writeFileSync(output, page);
