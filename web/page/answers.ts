// The answer to each question of the protocol.

import type { About, Circuits, Limit, Mistake, Moved, Quantity, Question, Refusal, Simulated } from "./protocol";

export type Position = { branch: string; unknowns: number[]; svg: string };
export type Motion = { least: number; largest: number; is_angle: boolean; ends: (Limit | null)[]; turns: boolean; columns: Quantity[] };
export type Compiled = { mistakes: Mistake[] } | { mechanisms: About[] };

export type Answers = {
    compile: Compiled;
    load: Compiled;
    words: { keywords: string[]; functions: string[] };
    begin: Moved;
    positions: { positions: Position[]; more: boolean };
    picture: Moved;
    follow: Moved;
    drag: Moved;
    motion: Motion;
    chart: { svg: string };
    csv: { text: string };
    sheet: { text: string };
    circuits: Circuits;
    report: { html: string };
    rust: { text: string };
    simulate: Simulated;
};

export type Kind = keyof Answers;
export type QuestionOf<K extends Kind> = Extract<Question, { do: K }>;

export function isRefusal(answer: object): answer is Refusal {
    return "why" in answer;
}
