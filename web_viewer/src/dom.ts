// Helpers that create and find elements, and format numbers.

type Attributes = Record<string, string | number | boolean | undefined>;

/** Creates an element; an attribute with the value true has no text, false and undefined are
 *  omitted. */
export function make<K extends keyof HTMLElementTagNameMap>(
    tag: K,
    attributes: Attributes = {},
    ...children: (Node | string | undefined)[]
): HTMLElementTagNameMap[K] {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
        if (value === undefined || value === false) continue;
        element.setAttribute(name, value === true ? "" : String(value));
    }
    element.append(...children.filter((child) => child !== undefined));
    return element;
}

/** Creates an SVG element, with attributes as in make(). */
export function draw<K extends keyof SVGElementTagNameMap>(
    tag: K,
    attributes: Attributes = {},
    ...children: (Node | string | undefined)[]
): SVGElementTagNameMap[K] {
    const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [name, value] of Object.entries(attributes)) {
        if (value === undefined || value === false) continue;
        element.setAttribute(name, value === true ? "" : String(value));
    }
    element.append(...children.filter((child) => child !== undefined));
    return element;
}

/** Returns the element of index.html with this id; throws if there is none. */
export function byId<T extends HTMLElement>(id: string): T {
    const element = document.getElementById(id);
    if (!element) throw new Error(`index.html has no #${id}`);
    return element as T;
}

const thousands = "\u202f";

/** Returns a whole number with narrow spaces between thousands: "12 480". */
export function grouped(value: number): string {
    return String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, thousands);
}

/** Returns a number of bytes as text: "812 B", "340 kB", "1.24 MB". */
export function kilobytes(bytes: number): string {
    if (bytes < 1000) return `${bytes} B`;
    if (bytes < 1e6) return `${grouped(bytes / 1000)} kB`;
    return `${(bytes / 1e6).toFixed(2)} MB`;
}
