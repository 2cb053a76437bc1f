// Small helpers to make and find elements.

type Attributes = Record<string, string | number | boolean | undefined>;

/** Makes an element; true is an attribute without value, false and undefined are none. */
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

/** Makes an element of a drawing. */
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

/** The element of index.html with this id. */
export function byId<T extends HTMLElement>(id: string): T {
    const element = document.getElementById(id);
    if (!element) throw new Error(`index.html has no #${id}`);
    return element as T;
}

const thousands = "\u202f";

/** 12480 -> "12 480", with narrow spaces. */
export function grouped(value: number): string {
    return String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, thousands);
}

/** Bytes as a person says them: "812 B", "340 kB", "1.24 MB". */
export function kilobytes(bytes: number): string {
    if (bytes < 1000) return `${bytes} B`;
    if (bytes < 1e6) return `${grouped(bytes / 1000)} kB`;
    return `${(bytes / 1e6).toFixed(2)} MB`;
}
