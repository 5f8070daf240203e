// Builds the page: `dist/` as a folder of files and as one file, `dist/linkage.html`. Neither asks the network for anything.
//
// `dist/live-head.html` and `dist/live-body.html` are the parts that `linkage sheet --live` adds to a sheet.
//
// LINKAGE_WASM=path and LINKAGE_LIVE_WASM=path take modules that are built already: that of the page, and that of live sheets.
// LINKAGE_DRAFT=1 makes larger and slower modules, in less time. LINKAGE_FAKE=1 takes the answers of test/fake.ts in place of a module.

import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { brotliCompressSync, constants, deflateRawSync, gzipSync } from "node:zlib";
import esbuild from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const root = dirname(here);
const dist = process.env.LINKAGE_DIST ?? join(here, "dist");
const isFake = process.env.LINKAGE_FAKE === "1";
const isDraft = process.env.LINKAGE_DRAFT === "1";

/** The examples in the order of the menu: simple ones first, then those with a scene. */
const ORDER = [
    "four_bar slider_crank scotch_yoke hoecken chebyshev roberts watt_line peaucellier pantograph",
    "crank_shaper whitworth rack_steering jansen klann engine door_closer compressor",
].flatMap((names) => names.split(" "));

function examples() {
    const found = new Map();
    for (const folder of ["linkages", "machines"]) {
        const path = join(root, "examples", folder);
        for (const file of readdirSync(path).filter((name) => name.endsWith(".linkage"))) {
            found.set(basename(file, ".linkage"), readFileSync(join(path, file), "utf8"));
        }
    }
    const names = [...ORDER.filter((name) => found.has(name)), ...[...found.keys()].filter((name) => !ORDER.includes(name)).sort()];
    return names.map((name) => ({ name, text: found.get(name) }));
}

/** The settings of a draft, which are those of dev/wasm/run: the crates that both need are built once. */
const DRAFT = { CARGO_PROFILE_DEV_OPT_LEVEL: "1", CARGO_PROFILE_DEV_BUILD_OVERRIDE_OPT_LEVEL: "0" };

/** A module, without names. With -Os it would be 5 % smaller, and 10 % larger once it is deflated, which is what is sent. */
function wasm(path, ...options) {
    if (path === undefined) {
        const target = [...(isDraft ? [] : ["--profile", "page"]), "--target", "wasm32-unknown-unknown", ...options];
        execFileSync("cargo", ["build", ...target, "-p", "linkage-page"], { cwd: root, stdio: "inherit", env: { ...process.env, ...(isDraft ? DRAFT : {}) } });
        const folder = process.env.CARGO_TARGET_DIR ?? join(root, "target");
        path = join(folder, "wasm32-unknown-unknown", isDraft ? "debug" : "page", "linkage_page.wasm");
    }
    if (isDraft) return readFileSync(path);
    const small = join(dist, "linkage.wasm");
    const features = ["--enable-bulk-memory", "--enable-nontrapping-float-to-int", "--enable-sign-ext", "--enable-mutable-globals"];
    const more = ["--enable-multivalue", "--enable-reference-types", "--enable-simd"];
    const optimizer = join(here, "node_modules", "binaryen", "bin", "wasm-opt");
    execFileSync(process.execPath, [optimizer, "-O1", "-s", "1", ...features, ...more, "--strip-debug", "--strip-producers", path, "-o", small], { stdio: "inherit" });
    const bytes = readFileSync(small);
    rmSync(small);
    return bytes;
}

/** Names, versions and licences of what esbuild took from node_modules, and of the crates in the module. */
function licences(inputs) {
    const packages = new Map();
    for (const input of inputs) {
        const match = /node_modules\/((?:@[^/]+\/)?[^/]+)\//u.exec(input);
        if (match) packages.set(match[1], join(here, "node_modules", match[1]));
    }
    const parts = [own(), ...crates()];
    for (const [name, path] of [...packages].sort()) {
        const { version, license } = JSON.parse(readFileSync(join(path, "package.json"), "utf8"));
        const file = readdirSync(path).find((file) => /^licen[cs]e/iu.test(file));
        parts.push(`${name} ${version}: ${license}\n\n${file ? readFileSync(join(path, file), "utf8").trim() : ""}`);
    }
    return `${parts.join(`\n\n${"-".repeat(72)}\n\n`)}\n`;
}

function own() {
    const mit = readFileSync(join(root, "LICENSE-MIT"), "utf8").trim();
    return `linkage: MIT OR Apache-2.0, at your choice\n\n${mit}`;
}

/** The crates of others that the module has, by cargo's own list. */
function crates() {
    if (isFake || !existsSync(join(here, "Cargo.toml"))) return [];
    const filter = ["--filter-platform", "wasm32-unknown-unknown"];
    const text = execFileSync("cargo", ["metadata", "--format-version", "1", "--locked", ...filter], { cwd: root, encoding: "utf8", maxBuffer: 2 ** 28 });
    const { packages, resolve } = JSON.parse(text);
    const byId = new Map(packages.map((item) => [item.id, item]));
    const nodes = new Map(resolve.nodes.map((node) => [node.id, node]));
    const seen = new Set();
    const visit = (id) => {
        if (seen.has(id)) return;
        seen.add(id);
        for (const { pkg, dep_kinds: kinds } of nodes.get(id)?.deps ?? []) {
            if (kinds.some(({ kind }) => kind === null)) visit(pkg);
        }
    };
    visit(packages.find(({ name }) => name === "linkage-page").id);
    return [...seen]
        .map((id) => byId.get(id))
        .filter(({ source }) => source !== null)
        .sort((a, b) => a.name.localeCompare(b.name))
        .map(({ name, version, license, manifest_path: manifest }) => {
            const folder = dirname(manifest);
            const files = readdirSync(folder).filter((file) => /^(licen[cs]e|copying|notice)/iu.test(file));
            const chosen = files.find((file) => /mit/iu.test(file)) ?? files[0];
            return `${name} ${version}: ${license}\n\n${chosen ? readFileSync(join(folder, chosen), "utf8").trim() : ""}`;
        });
}

/** Modules that exist only at the build. */
function virtual(modules) {
    return {
        name: "virtual",
        setup(build) {
            build.onResolve({ filter: /^linkage:/ }, ({ path }) => ({ path, namespace: "linkage" }));
            build.onLoad({ filter: /.*/, namespace: "linkage" }, ({ path }) => ({
                contents: JSON.stringify(modules[path] ?? ""),
                loader: "json",
            }));
        },
    };
}

async function bundle(entry, modules = {}) {
    const result = await esbuild.build({
        entryPoints: [join(here, entry)],
        bundle: true,
        write: false,
        minify: true,
        metafile: true,
        format: "iife",
        target: "es2022",
        charset: "utf8",
        legalComments: "none",
        loader: { ".css": "text" },
        plugins: [virtual(modules)],
        logLevel: "warning",
    });
    return { text: result.outputFiles[0].text, inputs: Object.keys(result.metafile.inputs) };
}

/** `</script`, `<script` and `<!--` cannot end a script element early. */
function inScript(text) {
    return text.replace(/<\/(script)/giu, "<\\/$1").replace(/<(script)/giu, "\\x3c$1").replaceAll("<!--", "\\x3c!--");
}

function hash(text) {
    return `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
}

function policy({ script, style }) {
    const rules = {
        "default-src": "'none'",
        "script-src": `${script} 'wasm-unsafe-eval'`,
        "style-src": style,
        "img-src": "data: blob:",
        "worker-src": "blob:",
        "connect-src": "'none'",
        "base-uri": "'none'",
        "form-action": "'none'",
    };
    const content = Object.entries(rules).map(([name, value]) => `${name} ${value}`).join("; ");
    return `<meta http-equiv="Content-Security-Policy" content="${content}">`;
}

function fill(template, parts) {
    // A function, so that `$` in the parts has no meaning.
    return template.replace(/<!--(policy|styles|scripts)-->/gu, (_, name) => parts[name]);
}

rmSync(dist, { recursive: true, force: true });
mkdirSync(dist, { recursive: true });

const worker = await bundle(isFake ? "test/fake.ts" : "page/worker.ts");
const first = await bundle("page/main.ts", { "linkage:worker": worker.text, "linkage:examples": examples() });
const legal = licences([...first.inputs, ...worker.inputs]);
const modules = { "linkage:worker": worker.text, "linkage:examples": examples(), "linkage:licences": legal };
const script = inScript((await bundle("page/main.ts", modules)).text);
// An escape outside of a string or a regular expression would be a mistake of syntax.
await esbuild.transform(script, { loader: "js" });
const css = (await esbuild.transform(readFileSync(join(here, "page", "page.css"), "utf8"), { loader: "css", minify: true })).code;
const none = Buffer.from("AGFzbQEAAAA=", "base64");
const bytes = isFake ? none : wasm(process.env.LINKAGE_WASM);
const deflated = (bytes) => `linkageModule="${deflateRawSync(bytes, { level: 9 }).toString("base64")}"`;
const module = deflated(bytes);
const template = readFileSync(join(here, "page", "index.html"), "utf8");

const folder = fill(template, {
    policy: policy({ script: "'self'", style: "'self'" }),
    styles: '<link rel="stylesheet" href="style.css">',
    scripts: '<script src="module.js" defer></script>\n<script src="page.js" defer></script>',
});
const single = fill(template, {
    policy: policy({ script: `${hash(module)} ${hash(script)}`, style: hash(css) }),
    styles: `<style>${css}</style>`,
    scripts: `<script>${module}</script>\n<script>${script}</script>`,
});
// A live sheet: its own styles are those of a sheet, in a style element.
// In a draft it has the module of the page, which can do the same and more.
const isShared = isDraft && process.env.LINKAGE_LIVE_WASM === undefined;
const liveBytes = isFake ? none : isShared ? bytes : wasm(process.env.LINKAGE_LIVE_WASM, "--no-default-features");
const liveModule = deflated(liveBytes);
const liveScript = inScript((await bundle("page/live.ts", { "linkage:worker": worker.text })).text);
await esbuild.transform(liveScript, { loader: "js" });
const besides = "<style>@media (min-width: 80rem) { body.has-live { padding-right: 22rem } } @media (max-width: 80rem) { body.has-live { padding-bottom: 55vh } }</style>";
const liveBody = [
    '<script type="text/plain" id="linkage-data">LINKAGE_DATA</script>',
    `<script>${liveModule}</script>`,
    `<script>${liveScript}</script>`,
].join("\n");
const files = {
    "live-head.html": `${policy({ script: `${hash(liveModule)} ${hash(liveScript)}`, style: "'unsafe-inline'" })}\n${besides}\n`,
    "live-body.html": `${liveBody}\n`,
    "index.html": folder,
    "page.js": script,
    "module.js": module,
    "style.css": css,
    "licences.txt": legal,
    "linkage.html": single,
};
const size = (length) => `${(length / 1000).toFixed(0)} kB`.padStart(9);
const report = (name, data) => {
    const brotli = brotliCompressSync(data, { params: { [constants.BROTLI_PARAM_QUALITY]: 11 } });
    console.log(`${name.padEnd(14)}${size(data.length)}${size(gzipSync(data, { level: 9 }).length)} gzip${size(brotli.length)} brotli`);
};
for (const [name, text] of Object.entries(files)) {
    writeFileSync(join(dist, name), text);
    if (!isDraft) report(name, Buffer.from(text));
}
if (!isDraft) report("(wasm)", bytes);
if (!isDraft) report("(live wasm)", liveBytes);
