// Drawings and sheets of the module, as elements. The module escapes what it writes; here only known elements and attributes
// pass, so that a mistake there cannot become a script. An iframe would be as safe, but could be neither patched in place nor
// follow the theme, nor pass its height on.

const HTML = new Set(
    ("main header section article div p span h1 h2 h3 h4 h5 dl dt dd ul ol li table caption thead tbody tr th td figure " +
        "figcaption abbr code pre em strong i b sub sup br hr details summary small a img").split(" "),
);
const MATH = new Set(
    ("math semantics annotation mrow mi mn mo ms mtext mspace msub msup msubsup mfrac msqrt mroot mover munder munderover " +
        "mtable mtr mtd mstyle mpadded mphantom menclose mmultiscripts mprescripts none").split(" "),
);
const SVG = new Set(
    ("svg g path rect circle ellipse line polyline polygon text tspan title desc defs clipPath linearGradient stop " +
        "marker use symbol").split(" "),
);
const KNOWN: Record<string, Set<string>> = {
    "http://www.w3.org/1999/xhtml": HTML,
    "http://www.w3.org/1998/Math/MathML": MATH,
    "http://www.w3.org/2000/svg": SVG,
};

/** Styles that came along; they are adopted instead, where the policy of styles lets them pass. */
export type Cleaned = { content: DocumentFragment; styles: string[] };

/** Parses the content of an HTML page. */
export function cleanHtml(text: string): Cleaned {
    const { rest, styles } = unstyled(text);
    return { content: clean(new DOMParser().parseFromString(rest, "text/html").body.childNodes), styles };
}

/** Parses one SVG drawing; null if it is none. */
export function cleanSvg(text: string): Cleaned | null {
    const { rest, styles } = unstyled(text);
    const root = new DOMParser().parseFromString(rest, "image/svg+xml").documentElement;
    return root.localName === "svg" ? { content: clean([root]), styles } : null;
}

/** Style elements are taken out before parsing: the policy reports them even in a document that is never shown. */
function unstyled(text: string): { rest: string; styles: string[] } {
    const styles: string[] = [];
    const rest = text.replace(/<style>([^<]*)<\/style>/gu, (_, style: string) => {
        styles.push(style);
        return "";
    });
    return { rest, styles };
}

function clean(nodes: Iterable<Node>): DocumentFragment {
    const content = document.createDocumentFragment();
    for (const node of nodes) copy(node, content);
    return content;
}

function copy(node: Node, to: Node): void {
    if (node instanceof Text) {
        to.appendChild(document.createTextNode(node.data));
    } else if (node instanceof Element) {
        const space = node.namespaceURI ?? "";
        if (KNOWN[space]?.has(node.localName)) {
            const element = document.createElementNS(space, node.localName);
            for (const { name, value } of node.attributes) {
                if (isHarmless(name, value)) element.setAttribute(name, value);
            }
            for (const child of node.childNodes) copy(child, element);
            to.appendChild(element);
        }
    }
}

function isHarmless(name: string, value: string): boolean {
    const lower = name.toLowerCase();
    if (lower.startsWith("on") || lower === "style" || lower === "srcset" || lower.startsWith("xmlns")) return false;
    if (lower === "href" || lower === "xlink:href") return value.startsWith("#");
    if (lower === "src") return value.startsWith("data:image/");
    return true;
}
