// The questions that the page asks the module, and its answers: JSON both ways. Each question is answered on its own: the module
// keeps only the compiled text and what it computed last. Angles are radians and count turns; lengths are those of the text.

/** Why there is no answer, in one sentence. */
export type Refusal = { why: string };

/** A mistake of the text; places are offsets in UTF-16 units, as in JavaScript. */
export type Mistake = { from: number; to: number; line: number; column: number; text: string; help: string | null };

export type Quantity = { name: string; is_angle: boolean };
export type Parameter = { name: string; is_angle: boolean; unit: string | null; value: number; text: string | null };
export type About = {
    name: string;
    /** The doc comment, paragraph by paragraph, as plain text. */
    paragraphs: string[];
    parameters: Parameter[];
    inputs: Quantity[];
    unknowns: Quantity[];
    points: string[];
    outputs: Quantity[];
    /** The jump of each output that is an angle, where an atan2 in its formula goes from pi to -pi. */
    jumps: (number | null)[];
    scenes: { name: string; parameters: Parameter[]; simulates: boolean }[];
    /** Why it cannot be moved: it calls functions in Rust, or is too large. */
    refusal: string | null;
};

export type Place = { inputs: number[]; unknowns: number[] };
export type At = { mechanism: number; parameters: number[]; place: Place };
/** What the picture shows; `along` is the place of the input that moves, `rate` its rate (others rest); `language` that of its legend. */
export type Show = { traces: boolean; velocities: boolean; accelerations: boolean; along: number; rate: number; language: "en" | "it" };

/** A picture: x in pixels of its viewBox is origin[0] + scale * x, y is origin[1] - scale * y. */
export type Picture = { svg: string; origin: [number, number]; scale: number; joints: { name: string; x: number; y: number }[] };
export type Numbers = { name: string; is_angle: boolean; value: number; rate: number; acceleration: number }[];
/** Why a motion goes no further: a group at a dead point, a coordinate at an end of its range, no position of its own near. */
export type Limit =
    | { is: "dead_point" | "change_point"; group: string }
    | { is: "least" | "largest"; of: string }
    | { is: "no_direction" | "too_near" | "no_position" }
    | { is: "too_long"; steps: number }
    | { is: "error"; why: string };
/** `input` is the place of the input that moved; none if it was a motion to other parameters. */
export type Stop = Limit & { input: number | null };
export type Moved = At & { picture: Picture; numbers: Numbers; /** The limit at which the motion stopped. */ stopped: Stop | null };

export type Question =
    /** First of all, and after each change of the text. */
    | { do: "compile"; text: string }                              // { mistakes: Mistake[] } or { mechanisms: About[] }
    /** Mechanisms that were compiled before, of a live sheet: the answer is that of a text. */
    | { do: "load"; written: string }
    | { do: "words" }                                              // { keywords: string[]; functions: string[] } of the language, for colours and completion
    /** A first position: at the first value of each input, or at other inputs that have one. */
    | ({ do: "begin"; mechanism: number; parameters: number[]; near?: Place; show: Show }) // Moved; `near` is a position of the text before
    | ({ do: "positions"; mechanism: number; parameters: number[]; inputs: number[] })  // { positions: { branch: string; unknowns: number[]; svg: string }[]; more: boolean }
    | ({ do: "picture"; show: Show } & At)                         // Moved
    /** Follows the motion to other inputs, and to other parameters. */
    | ({ do: "follow"; to: { parameters: number[]; inputs: number[] }; show: Show } & At) // Moved
    /** Moves an input so that a joint comes near a place of the plane. */
    | ({ do: "drag"; joint: string; to: [number, number]; show: Show } & At)            // Moved
    /** Follows the whole motion: its range, and the traces of points, which pictures show from then on. */
    | ({ do: "motion"; along: number; rate: number; steps: number } & At)               // { least: number; largest: number; is_angle: boolean; ends: (Limit | null)[]; turns: boolean; columns: Quantity[] }
    /** A chart over the motion that was followed last; of at most five columns. */
    | { do: "chart"; columns: string[] }                           // { svg: string }
    | { do: "csv" }                                                // { text: string } of the motion that was followed last
    /** rate: null for a sheet without velocities and accelerations. form: html is the content of <main>. */
    | ({ do: "sheet"; rate: number | null; language: "en" | "it"; form: "html" | "latex" | "text" } & At)   // { text: string }
    | ({ do: "circuits"; mechanism: number; parameters: number[]; inputs: number[]; along: number })        // Circuits
    | ({ do: "report" } & At)                                      // { html: string }
    | ({ do: "rust"; mechanism: number })                          // { text: string }
    | ({ do: "simulate"; scene: number; values: number[]; rates: number[]; to: number; tolerance: number; steps: number } & At) // Simulated

/** The circuits; motions are numbered in their charts, circuits here, both from 1. */
export type Circuits = {
    positions: number;
    /** True if others are left out. */
    more: boolean;
    circuits: number;
    motions: { circuit: number; least: number | null; largest: number | null; way: "turns" | "to_and_fro" | "ends" | "open"; turns: number }[];
    charts: { name: string; svg: string }[];
};

export type Simulated = {
    /** Events, and why it ended before its end. */
    lines: string[];
    sections: { heading: string; charts: string[] }[];
    /** Frames for play: times, and the position at each; asked for one by one with `picture`. */
    times: number[];
    places: Place[];
    csv: string;
};
// While a question is answered the worker posts { id, progress: number } (0 to 1) at times; then { id, answer } or { id, answer: Refusal }.
// Page to worker: { id, question }. To stop: terminate the worker, start another one with the same WebAssembly.Module, compile again.
//
// Plain exports of the module: memory; room(length: u32) -> u32 (address for the question, UTF-8); ask(length: u32) -> u32 (length of the
// answer); answer() -> u32 (its address). Import: page.progress(part: f64). A trap (panic) ends the instance: the worker says so, and is started again.
