// A worker and the questions that wait for it: one is answered at a time, and of those that wait in one lane only the newest.

import type { Answers, Compiled, Kind, QuestionOf } from "./answers";
import { isRefusal } from "./answers";
import type { Question, Refusal } from "./protocol";
import { Signal } from "./signal";
import type { FromWorker, ToWorker } from "./worker";
import { word } from "./words";

/** Lanes, the most urgent first. */
const LANES = ["compile", "move", "draw", "motion", "positions", "chart", "tab", "copy"] as const;
export type Lane = (typeof LANES)[number];

/** How long a more urgent question waits for the running one before that is stopped, in milliseconds and in compilations. */
const PATIENCE = { milliseconds: 800, compilations: 2 };

/** The first question of a worker. */
type Reading = QuestionOf<"compile"> | QuestionOf<"load">;

type Waiting = {
    /** The text that the question is about; null if it is about none. */
    text: string | null;
    make: () => Question;
    resolve: (answer: object | null) => void;
};
type Running = Waiting & { id: number; lane: Lane; since: number; isPreparation: boolean };

export class Session {
    /** Something began, went on or ended: what runs and how far it is. */
    readonly changed = new Signal();
    progress: number | null = null;
    milliseconds = 0;

    #spawn: () => Worker;
    #module: WebAssembly.Module | BufferSource;
    #reading: (text: string) => Reading;
    #worker: Worker | null = null;
    #ready = false;
    #loaded: string | null = null;
    #waiting = new Map<Lane, Waiting>();
    #running: Running | null = null;
    #failures = 0;
    /** How long the last compilation took. */
    #compiling = 0;
    #ids = 0;

    /** `reading` is the question that gives the module a text, or mechanisms that were compiled before. */
    constructor(
        spawn: () => Worker,
        module: WebAssembly.Module | BufferSource,
        reading: (text: string) => Reading = (text) => ({ do: "compile", text }),
    ) {
        this.#spawn = spawn;
        this.#module = module;
        this.#reading = reading;
        this.#start();
    }

    /** The question that runs: its lane, and since when. */
    get running(): { lane: Lane; since: number } | null {
        return this.#running;
    }

    /** Compiles a text; whatever runs about an older text is stopped. */
    compile(text: string): Promise<Compiled | Refusal | null> {
        return this.ask("compile", text, () => this.#reading(text));
    }

    /**
     * Asks a question about a text. `make` is called when its turn comes, so that it starts from the newest answer.
     * The answer is null if a newer question took its place.
     */
    ask<K extends Kind>(lane: Lane, text: string | null, make: () => QuestionOf<K>): Promise<Answers[K] | Refusal | null> {
        return new Promise((resolve) => {
            this.#waiting.get(lane)?.resolve(null);
            this.#waiting.set(lane, { text, make, resolve: resolve as Waiting["resolve"] });
            this.#hurry(lane);
            this.#next();
        });
    }

    /** Stops what runs: the worker ends, another one starts. */
    stop(why = word().stopped): void {
        const running = this.#running;
        this.#running = null;
        if (running?.isPreparation) this.#drop(running.lane, { why });
        this.#restart();
        running?.resolve({ why });
        this.#next();
    }

    #start(): void {
        const worker = this.#spawn();
        worker.onmessage = (event: MessageEvent<FromWorker>) => this.#hear(event.data);
        worker.onerror = (event) => {
            event.preventDefault();
            this.#hear({ failed: event.message });
        };
        worker.postMessage({ module: this.#module } satisfies ToWorker);
        this.#worker = worker;
    }

    #restart(): void {
        this.#worker?.terminate();
        this.#ready = false;
        this.#loaded = null;
        this.progress = null;
        this.#start();
        this.changed.emit();
    }

    /** A question that waits for a less urgent one, or a text for an older one, stops it after a while. */
    #hurry(lane: Lane): void {
        const running = this.#running;
        if (running === null) return;
        const isMore = LANES.indexOf(lane) < LANES.indexOf(running.lane) || lane === "compile";
        if (!isMore) return;
        // A new worker compiles the text first: stopping has to be worth it.
        const end = running.since + PATIENCE.milliseconds + PATIENCE.compilations * this.#compiling;
        setTimeout(() => {
            if (this.#running === running && this.#waiting.has(lane)) this.stop(word().replaced);
        }, Math.max(0, end - performance.now()));
    }

    #next(): void {
        if (this.#running !== null || !this.#ready) return;
        const lane = LANES.find((name) => this.#waiting.has(name));
        const waiting = lane && this.#waiting.get(lane);
        if (!lane || !waiting) {
            this.changed.emit();
            return;
        }
        // A worker that has another text compiles this one first.
        const { text } = waiting;
        const isPreparation = lane !== "compile" && text !== null && this.#loaded !== text;
        if (!isPreparation) this.#waiting.delete(lane);
        const question: Question = isPreparation ? this.#reading(text) : waiting.make();
        this.#ids += 1;
        this.#running = { ...waiting, id: this.#ids, lane, since: performance.now(), isPreparation };
        if (isPreparation) this.#running.resolve = () => {};
        this.progress = null;
        this.#worker?.postMessage({ id: this.#ids, question } satisfies ToWorker);
        this.changed.emit();
    }

    #hear(message: FromWorker): void {
        if ("ready" in message) {
            this.#ready = true;
            this.#next();
        } else if ("failed" in message) {
            this.#fail();
        } else if (message.id === this.#running?.id) {
            if ("progress" in message) {
                this.progress = message.progress;
                this.changed.emit();
            } else if ("trap" in message) {
                this.#trap(this.#running);
            } else {
                this.milliseconds = message.milliseconds;
                this.#answered(this.#running, message.answer);
            }
        }
    }

    #answered(running: Running, answer: object): void {
        this.#running = null;
        this.progress = null;
        if (running.isPreparation || running.lane === "compile") {
            const isGood = !isRefusal(answer) && "mechanisms" in answer;
            this.#compiling = performance.now() - running.since;
            this.#loaded = isGood ? running.text : null;
            if (running.isPreparation && !isGood) this.#drop(running.lane, { why: word().noLongerCompiles });
        }
        running.resolve(answer);
        // The asker takes the answer first: the next question starts from it.
        queueMicrotask(() => this.#next());
    }

    /** A panic ended the instance. */
    #trap(running: Running): void {
        this.#running = null;
        if (running.isPreparation) this.#drop(running.lane, { why: word().trap });
        this.#restart();
        running.resolve({ why: word().trap });
    }

    /** The worker cannot be started: all that waits is refused, and nothing is tried again and again. */
    #fail(): void {
        this.#failures += 1;
        for (const lane of LANES) this.#drop(lane, { why: word().moduleFailed });
        this.#running?.resolve({ why: word().moduleFailed });
        this.#running = null;
        if (this.#failures < 3 && this.#ready) this.#restart();
        this.changed.emit();
    }

    #drop(lane: Lane, answer: Refusal): void {
        this.#waiting.get(lane)?.resolve(answer);
        this.#waiting.delete(lane);
    }
}
