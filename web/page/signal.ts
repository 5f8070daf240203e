// Who wants to know, and telling them.

export class Signal<T = void> {
    #listeners: ((value: T) => void)[] = [];

    on(listener: (value: T) => void): void {
        this.#listeners.push(listener);
    }

    emit(value: T): void {
        for (const listener of this.#listeners) listener(value);
    }
}

/** Calls `work` once no call came for `milliseconds`. */
export function settled(milliseconds: number, work: () => void): { soon(): void; never(): void } {
    let timer: ReturnType<typeof setTimeout> | undefined;
    return {
        soon() {
            clearTimeout(timer);
            timer = setTimeout(work, milliseconds);
        },
        never() {
            clearTimeout(timer);
        },
    };
}
