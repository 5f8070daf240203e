// Elements by one call. Strings become text nodes, never markup.

type Value = string | number | boolean | null | ((event: never) => void);
type Child = Node | string | null | undefined;

/** An element with attributes, listeners (`onclick`) and children; a boolean attribute is there or not. */
export function h<K extends keyof HTMLElementTagNameMap>(
    tag: K,
    attributes: Record<string, Value> = {},
    ...children: Child[]
): HTMLElementTagNameMap[K] {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
        if (typeof value === "function") {
            element.addEventListener(name.slice(2), value as EventListener);
        } else {
            set(element, name, value);
        }
    }
    element.append(...children.filter((child): child is Node | string => child != null));
    return element;
}

/** Sets an attribute, or removes it. */
export function set(element: Element, name: string, value: string | number | boolean | null): void {
    if (value === null || value === false) {
        element.removeAttribute(name);
    } else {
        element.setAttribute(name, value === true ? "" : String(value));
    }
}

/** Replaces the children of an element. */
export function fill(element: Element, ...children: Child[]): void {
    element.replaceChildren(...children.filter((child): child is Node | string => child != null));
}

let count = 0;
/** An id that no other element has. */
export function freshId(stem: string): string {
    count += 1;
    return `${stem}-${count}`;
}
