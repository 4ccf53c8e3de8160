/** Makes elements in one expression: el("button", {class: "stop"}, "Stop"). */

/** True: present; false or undefined: absent; a function under "onclick" and the like: a listener. */
export type Attributes = Record<string, string | number | boolean | ((event: never) => void) | undefined>;

export type Child = Node | string | null;

export function el<K extends keyof HTMLElementTagNameMap>(
    tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  return complete(document.createElement(tag), attributes, children);
}

/** The same for a shape of a drawing. */
export function shape<K extends keyof SVGElementTagNameMap>(
    tag: K, attributes: Attributes, ...children: Child[]): SVGElementTagNameMap[K] {
  return complete(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
}

function complete<E extends Element>(element: E, attributes: Attributes, children: readonly Child[]): E {
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
  return shape("svg", {viewBox: `0 0 ${size} ${size}`, "aria-hidden": "true", class: className}, shape("path", {d: path}));
}

/** An icon drawn with lines in a 24x24 box. */
export function icon(path: string): SVGSVGElement {
  return drawing(path, 24, "icon");
}

/** "#3d9bff" of 0x3d9bff. */
export function cssColor(rgb: number): string {
  return `#${rgb.toString(16).padStart(6, "0")}`;
}

/** Leaves the page alone where nothing changes: states come 60 times a second. */
export function setText(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

/** The same for what is shown or not. */
export function setHidden(element: HTMLElement, isHidden: boolean): void {
  if (element.hidden !== isHidden) element.hidden = isHidden;
}
