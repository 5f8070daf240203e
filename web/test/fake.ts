// A worker with the answers of one four-bar, to look at the page without the module: `LINKAGE_FAKE=1 npm run build`.

import type { Moved, Place, Question, Show } from "../page/protocol";

const TURN = 2 * Math.PI;

function about() {
    const lengths = { l1: 80, l2: 20, l3: 50, l4: 70 };
    return {
        name: "FourBar",
        paragraphs: ["A four-bar."],
        parameters: Object.entries(lengths).map(([name, value]) => ({ name, is_angle: false, unit: null, value, text: String(value) })),
        inputs: [{ name: "theta2", is_angle: true }],
        unknowns: [{ name: "theta3", is_angle: true }, { name: "theta4", is_angle: true }],
        points: ["B", "C"],
        outputs: [{ name: "mu", is_angle: true }],
        jumps: [null],
        scenes: [{ name: "Running", parameters: [], simulates: true }],
        refusal: null,
    };
}

function solve([l1 = 0, l2 = 0, l3 = 0, l4 = 0]: number[], theta2: number, side: number): { unknowns: number[]; b: number[]; c: number[] } | null {
    const b = [l2 * Math.cos(theta2), l2 * Math.sin(theta2)] as const;
    const [dx, dy] = [l1 - b[0], -b[1]];
    const d = Math.hypot(dx, dy);
    const a = (d * d + l3 * l3 - l4 * l4) / (2 * d);
    const h2 = l3 * l3 - a * a;
    if (h2 < 0) return null;
    const h = side * Math.sqrt(h2);
    const c = [b[0] + (a * dx - h * dy) / d, b[1] + (a * dy + h * dx) / d] as const;
    return { unknowns: [Math.atan2(c[1] - b[1], c[0] - b[0]), Math.atan2(-c[1], l1 - c[0])], b: [...b], c: [...c] };
}

const frame = { origin: [120, 300] as [number, number], scale: 3 };
const X = (x: number): string => (frame.origin[0] + frame.scale * x).toFixed(2);
const Y = (y: number): string => (frame.origin[1] - frame.scale * y).toFixed(2);
let traced: string | null = null;

function picture(parameters: number[], place: Place, show: Show, side: number): Moved | { why: string } {
    const theta2 = place.inputs[0] ?? 0;
    const found = solve(parameters, theta2, side);
    if (found === null) return { why: "group theta3, theta4 does not close, its links do not reach each other" };
    const { b, c } = found;
    const d = [parameters[0] ?? 0, 0];
    const line = (p: number[], q: number[], kind: string): string =>
        `<g class="${kind}"><path class="link" d="M${X(p[0] ?? 0)} ${Y(p[1] ?? 0)}L${X(q[0] ?? 0)} ${Y(q[1] ?? 0)}" stroke-width="12"/></g>`;
    const joints = [["O", [0, 0]], ["B", b], ["C", c], ["D", d]] as [string, number[]][];
    const svg =
        `<svg class="linkage" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 480 393"><style>.linkage .core{opacity:1}</style><rect class="paper" width="100%" height="100%"/>` +
        (show.traces && traced ? `<path class="curve" d="${traced}"/>` : "") +
        line([0, 0], b, "drive") + line(b, c, "a") + line(d, c, "b") +
        joints.map(([name, [x = 0, y = 0]]) => `<g transform="translate(${X(x)} ${Y(y)})"><circle class="joint" r="4.5"/><text x="9" y="-8">${name}</text></g>`).join("") +
        "</svg>";
    return {
        mechanism: 0,
        parameters,
        place: { inputs: [theta2], unknowns: found.unknowns },
        picture: { svg, ...frame, joints: joints.map(([name, [x = 0, y = 0]]) => ({ name, x, y })) },
        numbers: [
            { name: "theta3", is_angle: true, value: found.unknowns[0] ?? 0, rate: 0.3, acceleration: -1 },
            { name: "theta4", is_angle: true, value: found.unknowns[1] ?? 0, rate: 0.1, acceleration: 12345 },
        ],
        stopped: null,
    };
}

function sideOf({ unknowns: [theta3 = 0, theta4 = 0] }: Place): number {
    return Math.sin(theta3 - theta4) > 0 ? 1 : -1;
}

function answer(question: Question): object {
    switch (question.do) {
        case "words":
            return { keywords: ["param"], functions: ["sin"] };
        case "load":
            return { mechanisms: [about()] };
        case "compile": {
            const from = question.text.indexOf("mistake");
            if (from < 0) return { mechanisms: [about()] };
            return { mistakes: [{ from, to: from + 7, line: 1, column: 1, text: "this is a mistake", help: "remove it" }] };
        }
        case "begin":
            return picture(question.parameters, { inputs: [TURN / 6], unknowns: [] }, question.show, 1);
        case "picture":
            return picture(question.parameters, question.place, question.show, sideOf(question.place));
        case "follow":
            return picture(question.to.parameters, { inputs: question.to.inputs, unknowns: [] }, question.show, sideOf(question.place));
        case "drag": {
            const old = question.place.inputs[0] ?? 0;
            const angle = Math.atan2(question.to[1], question.to[0]);
            const theta2 = angle + TURN * Math.round((old - angle) / TURN);
            return picture(question.parameters, { inputs: [theta2], unknowns: [] }, question.show, sideOf(question.place));
        }
        case "positions":
            return {
                positions: [1, -1].map((side) => {
                    const shown = picture(question.parameters, { inputs: question.inputs, unknowns: [] }, { traces: false, velocities: false, accelerations: false, along: 0, rate: 1, language: "en" }, side);
                    return "why" in shown ? null : { branch: side > 0 ? "theta3_theta4=left" : "theta3_theta4=right", unknowns: shown.place.unknowns, svg: shown.picture.svg };
                }).filter((position) => position !== null),
                more: false,
            };
        case "motion": {
            const side = sideOf(question.place);
            const path = Array.from({ length: 121 }, (_, k) => solve(question.parameters, (k * TURN) / 120, side)?.c ?? [0, 0]);
            traced = `M${path.map(([x = 0, y = 0]) => `${X(x)} ${Y(y)}`).join("L")}`;
            const columns = ["theta3", "theta3_rate", "theta3_acceleration", "theta4", "mu", "mu_rate", "C_x", "C_y", "C_velocity_x", "C_speed"];
            return { least: 0, largest: TURN, is_angle: true, ends: [], turns: true, columns: columns.map((name) => ({ name, is_angle: !name.startsWith("C") })) };
        }
        case "chart":
            return { svg: `<svg class="chart" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 400 298"><text class="title" x="8" y="17">${question.columns.join(", ")}</text><path class="k0 curve" d="M48 200 Q200 20 384 180"/></svg>` };
        case "csv":
            return { text: "theta2,theta3\n0,1\n" };
        case "sheet":
            return { text: `<header><p class="over">Kinematics</p><h1>FourBar</h1></header><section><h2>Constraint equations</h2><p>${question.language}</p><p id="value">theta2 = ${question.place.inputs[0]}</p><math display="block"><mi>x</mi><mo>=</mo><mfrac><mn>1</mn><mi>l</mi></mfrac></math></section>` };
        case "circuits":
            return { positions: 2, more: false, circuits: 2, motions: [1, 2].map((circuit) => ({ circuit, least: 0, largest: TURN, way: "turns", turns: 1 })), charts: [] };
        case "report":
            return { html: "<header><p class=over>Report</p><h1>FourBar</h1></header><section><h2>Mobility</h2><p>4 links.</p></section>" };
        case "rust":
            return { text: "pub struct FourBar;\n" };
        case "simulate": {
            const times = Array.from({ length: 101 }, (_, k) => k / 50);
            return { lines: ["From 0 s to 2 s."], sections: [], times, places: times.map((t) => ({ inputs: [3 * t], unknowns: [1, 0] })), csv: "time\n0\n" };
        }
    }
}

self.onmessage = (event: MessageEvent<{ module: unknown } | { id: number; question: Question }>): void => {
    const message = event.data;
    if ("module" in message) self.postMessage({ ready: true });
    else self.postMessage({ id: message.id, answer: answer(message.question), milliseconds: 0 });
};
