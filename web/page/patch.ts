// Changes elements into others of the same structure in place: what stays the same keeps its scroll, selection and focus.

/** Gives `old` the children of `fresh`. */
export function patch(old: ParentNode & Node, fresh: Node): void {
    const before = [...old.childNodes];
    const after = [...fresh.childNodes];
    after.forEach((node, index) => {
        const there = before[index];
        if (there === undefined) {
            old.appendChild(node);
        } else if (there instanceof Text && node instanceof Text) {
            if (there.data !== node.data) there.data = node.data;
        } else if (there instanceof Element && node instanceof Element && isAlike(there, node)) {
            attributes(there, node);
            patch(there, node);
        } else {
            old.replaceChild(node, there);
        }
    });
    for (const node of before.slice(after.length)) old.removeChild(node);
}

function isAlike(a: Element, b: Element): boolean {
    return a.localName === b.localName && a.namespaceURI === b.namespaceURI;
}

function attributes(old: Element, fresh: Element): void {
    for (const { name } of [...old.attributes]) {
        if (!fresh.hasAttribute(name)) old.removeAttribute(name);
    }
    for (const { name, value } of fresh.attributes) {
        if (old.getAttribute(name) !== value) old.setAttribute(name, value);
    }
}
