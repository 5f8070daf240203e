// The words of the page in English. The other languages have the same ones, or do not compile.

import type { Circuits, Limit } from "../protocol";

export const en = {
    code: "en" as "en" | "it",
    ownName: "English",
    title: "linkage: planar mechanisms from loop equations",
    slogan: "Planar mechanisms from loop equations",

    // The head.
    examples: "Examples",
    file: "File",
    open: "Open a file…",
    save: "Save as a file",
    share: "Copy the link",
    copy: "Copy",
    copyMacro: "Rust: the macro with this text",
    copyRust: "Rust: the code that the macro writes",
    copyLatex: "LaTeX: the sheet",
    copySvg: "SVG: the picture",
    copyCsv: "CSV: the motion",
    language: "Language",
    theme: "Colours",
    themes: { auto: "As the system", light: "Light", dark: "Dark" },
    licences: "Licences",
    close: "Close",
    skip: "Skip to the picture",

    // The text.
    textLabel: "The mechanism, as text",
    text: "Text",
    mistakes: (count: number): string => (count === 1 ? "1 mistake" : `${count} mistakes`),
    noMistakes: "No mistakes",
    compiling: "Reading the text…",
    place: (line: number, column: number): string => `line ${line}, column ${column}`,
    empty: "An empty text has no mechanism: begin with one of the examples.",
    tooLong: (kilobytes: number): string => `This text has ${kilobytes} kB; the page takes texts of up to 1000 kB.`,

    // Tabs.
    views: "Views",
    picture: "Picture",
    sheet: "Sheet",
    charts: "Charts",
    circuits: "Circuits",
    simulation: "Simulation",
    report: "Report",
    rust: "Rust",
    mechanism: "Mechanism",

    // The picture.
    old: "This is an earlier text or choice.",
    oldText: "The text has mistakes: this is the last one without.",
    show: "Show",
    traces: "Traces",
    velocities: "Velocities",
    accelerations: "Accelerations",
    along: "Moves",
    rate: "at",
    perSecond: "/s",
    pictureLabel: (name: string): string => `${name} at this position. Its joints can be dragged; the sliders do the same.`,
    dragHint: "Drag a joint: the input follows the pointer.",
    positions: "Positions",
    morePositions: "There are many positions: others are left out.",
    positionsHint: "All positions at these inputs",
    position: (branch: string): string => `Position ${branch}`,
    onlyPosition: "the only one",
    noPositions: "There is no position at these inputs.",

    // Sliders.
    sliders: "Sliders and numbers",
    inputs: "Inputs",
    parameters: "Parameters",
    numbers: "Numbers",
    value: (name: string): string => `${name}, value`,
    notNumber: "Write a number, such as 12.5 or 45°.",
    reset: "As in the text",
    intoText: "Into the text",
    turn: (count: number): string => `turn ${count}`,
    name: "Name",
    valueHead: "Value",
    rateHead: "Rate",
    accelerationHead: "Acceleration",
    ends: "Limits",
    hide: "Hide",
    limit: (limit: Limit): string => {
        switch (limit.is) {
            case "dead_point":
                return `dead point of ${limit.group}`;
            case "change_point":
                return `change point of ${limit.group}, where motions cross`;
            case "no_direction":
                return "dead point or change point";
            case "least":
                return `least value of ${limit.of}`;
            case "largest":
                return `largest value of ${limit.of}`;
            case "too_near":
                return "other positions are too near to know which one goes on";
            case "no_position":
                return "the loops do not close here";
            case "too_long":
                return `more than ${limit.steps} steps`;
            case "error":
                return limit.why;
        }
    },
    inputStops: (input: string, value: string, limit: string): string => `${input} stops at ${value}: ${limit}.`,
    parametersStop: (limit: string): string => `The parameters go no further: ${limit}.`,

    // Charts.
    choose: "Columns",
    chooseHint: "Choose columns: each kind of quantity has a chart.",
    overMotion: (name: string): string => `Over the motion of ${name}`,

    // Circuits.
    circuitsHead: (positions: number, motions: number, circuits: number): string => {
        const count = (count: number, of: string): string => `${count} ${of}${count === 1 ? "" : "s"}`;
        return `${count(positions, "position")}, ${count(motions, "motion")}, ${count(circuits, "circuit")}`;
    },
    motionOfCircuit: (motion: number, circuit: number): string => `motion ${motion}, circuit ${circuit}`,
    way: ({ way, turns }: Circuits["motions"][number], input: string, least: string, largest: string): string => {
        switch (way) {
            case "turns":
                return `${input} turns fully${turns === 1 ? "" : `; the motion closes after ${turns} turns`}`;
            case "to_and_fro":
                return `${input} goes to and fro between ${least} and ${largest}`;
            case "ends":
                return `${input} from ${least} to ${largest}, at the ends of ranges`;
            case "open":
                return `${input} from ${least} to ${largest} and on: the motion does not close`;
        }
    },

    // Simulation.
    scene: "Scene",
    until: "until",
    seconds: "s",
    startRates: "Rates at the start",
    tolerance: "Relative tolerance",
    run: "Simulate",
    play: "Play",
    pause: "Pause",
    time: "Time",
    speed: "Speed",
    noScenes: "This mechanism has no scene: a scene names bodies and forces, as in the examples Door closer and Engine.",
    notSimulated: "This scene has no motion to compute.",
    sceneParameters: "Parameters of the scene",
    fromHere: "From this position",

    // Work.
    stop: "Stop",
    stopped: "Stopped.",
    replaced: "A newer question took its place.",
    again: "Compute again",
    working: { compile: "Reading the text", move: "Moving", draw: "Drawing", motion: "Following the motion", positions: "Finding positions", chart: "Drawing charts", tab: "Computing", copy: "Computing" },
    loading: "Loading…",

    // Failures, a sentence each.
    noWebAssembly: "This browser has no WebAssembly, which the page computes with: a browser of 2023 or later has it.",
    followed: (file: string): string => `This page follows ${file}.`,
    serverGone: "The program that serves this page has ended: the file is not followed any more.",
    jumped: "No motion leads here from the position before: this is the nearest position with the values of the text.",
    liveFailed: "The sliders of this sheet cannot be loaded: its file may be incomplete. The numbers are those of the position with which it was written.",
    liveFold: "Sliders and picture",
    moduleFailed: "The part of the page that computes cannot be loaded: the file may be incomplete.",
    trap: "The computation failed on this text, and was started again; the text is as it was.",
    noLongerCompiles: "The text no longer compiles.",
    damagedLink: "The link is damaged: its text cannot be read.",
    newerLink: "The link is of a newer version of this page.",
    longLink: (kilobytes: string): string => `A link with this text has ${kilobytes} kB, more than the 8 kB that every program passes on: save a file instead.`,
    linkPlace: "The position of the link does not close the loops: this is another one.",
    notText: "This file is not a text.",
    copied: (item: string): string => `Copied: ${item}`,
    linkItem: "the link",
    notCopied: "The browser does not let the page copy: copy it from here.",
    saved: (name: string): string => `Saved: ${name}`,

    // Examples: a title and a sentence each.
    exampleWords: {
        four_bar: ["Four-bar", "Crank, coupler and rocker: the linkage of a university sheet on constraint equations."] as [string, string],
        slider_crank: ["Slider-crank", "The centred slider-crank, driven by its slider as an engine or by its crank as a compressor."] as [string, string],
        scotch_yoke: ["Scotch yoke", "One scalar equation: the smallest mechanism there is."] as [string, string],
        chebyshev: ["Chebyshev’s line", "Crossed rockers whose coupler’s middle is guided nearly straight."] as [string, string],
        hoecken: ["Hoecken’s line", "A crank-rocker that draws a straight line at nearly constant speed."] as [string, string],
        roberts: ["Roberts’ line", "Three equal triangles, the middle one with an apex that runs nearly straight."] as [string, string],
        watt_line: ["Watt’s line", "Two equal arms and a link between them: the guide of steam engines."] as [string, string],
        peaucellier: ["Peaucellier’s cell", "An inversor: the first linkage with an exactly straight line."] as [string, string],
        pantograph: ["Pantograph", "Two inputs: the pen repeats the tracer’s path, larger."] as [string, string],
        crank_shaper: ["Crank shaper", "A slotted lever moves the ram slowly forth and quickly back."] as [string, string],
        whitworth: ["Whitworth’s quick return", "The slotted arm turns all the way round, and drives a ram."] as [string, string],
        rack_steering: ["Rack steering", "A rack and two tie rods turn the front wheels of a car."] as [string, string],
        jansen: ["Jansen’s leg", "A leg of Theo Jansen’s walking machine: five dyads, ten unknown angles."] as [string, string],
        klann: ["Klann’s leg", "A walking leg with bent links, by its patent."] as [string, string],
        engine: ["Engine", "A slider-crank driven by gas, on a brake: four strokes, to simulate."] as [string, string],
        compressor: ["Compressor", "Compressed air, a counterweight and the loads on all bearings."] as [string, string],
        door_closer: ["Door closer", "A door that closes by spring and oil, latches, bounces and rests."] as [string, string],
    },
};

export type Words = typeof en;
