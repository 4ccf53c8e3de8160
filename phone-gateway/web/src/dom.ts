/** Makes elements in one expression: el("button", {class: "stop"}, "Stop"). */

type Attributes = Record<string, string | number | boolean | ((event: never) => void) | undefined>;

/** @param attributes  true: present; false or undefined: absent; a function under "onclick" and the
 * like: a listener. */
export function el<K extends keyof HTMLElementTagNameMap>(
    tag: K, attributes: Attributes = {},
    ...children: (Node | string | null)[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") {
      element.addEventListener(name.replace(/^on/, ""), value as EventListener);
    } else if (value !== undefined && value !== false) {
      element.setAttribute(name, value === true ? "" : String(value));
    }
  }
  element.append(...children.filter((child) => child !== null));
  return element;
}

/** A drawing made of one path, decorative: what it means is said in words beside it.
 * @param size  edge of the square that the path is drawn in. */
export function drawing(path: string, size: number, className: string): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", `0 0 ${size} ${size}`);
  svg.setAttribute("aria-hidden", "true");
  svg.classList.add(className);
  const shape = document.createElementNS("http://www.w3.org/2000/svg", "path");
  shape.setAttribute("d", path);
  svg.append(shape);
  return svg;
}

/** An icon drawn with lines in a 24x24 box. */
export function icon(path: string): SVGSVGElement {
  return drawing(path, 24, "icon");
}

/** Leaves the page alone where nothing changes: states come 60 times a second. */
export function setText(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}
