// The structure of what a phone shows: targets are large enough and within reach, nothing lies over anything else, nothing is
// cut, and nothing covers the robot.

/** In the page. @return one line for each fault. */
function look() {
  const kTarget = 44;
  /** Round and shadowed things may touch, px. */
  const kTouch = 4;
  const root = document.querySelector("dialog[open]") ?? document.querySelector(`.${document.querySelector("#app").dataset.screen}-screen`);
  const name = (element) => `${element.tagName.toLowerCase()}.${[...element.classList].join(".")} "${(element.ariaLabel ?? element.textContent).trim().slice(0, 30)}"`;
  const isSeen = (element) => element.checkVisibility({visibilityProperty: true}) && element.getBoundingClientRect().width > 1;
  /** What is seen of it in the boxes that scroll. */
  const seenBox = (element) => {
    let {left, top, right, bottom} = element.getBoundingClientRect();
    let isScrolled = false;
    for (let outer = element.parentElement; outer; outer = outer.parentElement) {
      const {overflowX, overflowY} = getComputedStyle(outer);
      const scrolls = [overflowX, overflowY].some((value) => value === "auto" || value === "scroll");
      if (!scrolls) continue;
      isScrolled = true;
      const box = outer.getBoundingClientRect();
      left = Math.max(left, box.left);
      top = Math.max(top, box.top);
      right = Math.min(right, box.right);
      bottom = Math.min(bottom, box.bottom);
    }
    return {left, top, right, bottom, isScrolled};
  };
  const overlap = (a, b) => Math.min(Math.min(a.right, b.right) - Math.max(a.left, b.left), Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top));
  const faults = [];
  const controls = [...root.querySelectorAll("button, input, select, textarea, [role=application]")].filter(isSeen);
  const boxes = controls.map((element) => ({element, box: seenBox(element)}));
  for (const {element, box} of boxes) {
    const {width, height} = element.getBoundingClientRect();
    if (Math.min(width, height) < kTarget - 0.5) faults.push(`${name(element)} is ${width.toFixed(0)}x${height.toFixed(0)} px`);
    if (!box.isScrolled && (box.left < -1 || box.top < -1 || box.right > innerWidth + 1 || box.bottom > innerHeight + 1)) {
      faults.push(`${name(element)} leaves the screen: ${JSON.stringify(box)}`);
    }
  }
  if (root.scrollWidth > root.clientWidth + 1) faults.push(`${name(root)} is cut: ${root.scrollWidth} of ${root.clientWidth} px`);
  // The large view is what things lie on.
  const apart = boxes.filter(({element}) => !element.matches(".camera-large .image-main"));
  for (const [i, a] of apart.entries()) {
    for (const b of apart.slice(i + 1)) {
      // The camera's switches lie on its image.
      if (a.element.closest(".image") && b.element.closest(".image")) continue;
      if (overlap(a.box, b.box) > kTouch) faults.push(`${name(a.element)} and ${name(b.element)} overlap`);
    }
  }
  for (const element of root.querySelectorAll("button, p, span, strong, h1, h2, h3, small, label")) {
    if (!isSeen(element) || element.classList.contains("unseen")) continue;
    const {overflow} = getComputedStyle(element);
    const isCut = element.scrollWidth > element.clientWidth + 1 && element.clientWidth > 0 && overflow !== "visible";
    if (isCut) faults.push(`${name(element)} is cut: ${element.scrollWidth} of ${element.clientWidth} px`);
  }
  // The robot is where its joints are.
  const screen = document.querySelector(".controller-screen");
  if (root === screen && !screen.classList.contains("camera-large")) {
    const places = Object.values(window.naoRemote.ballPlaces());
    const xs = places.map(([x]) => x);
    const ys = places.map(([, y]) => y);
    const robot = {left: Math.min(...xs), right: Math.max(...xs), top: Math.min(...ys), bottom: Math.max(...ys)};
    const parts = [".status", ".link", ".image", ".modes", ".strips", ".hint", ".cause", ".message", ".joystick", ".stop", ".joint-card", ".teach-bar"];
    for (const element of parts.flatMap((part) => [...screen.querySelectorAll(part)]).filter(isSeen)) {
      if (overlap(robot, element.getBoundingClientRect()) > kTouch) faults.push(`${name(element)} covers the robot`);
    }
    const size = Math.max(robot.bottom - robot.top, robot.right - robot.left);
    if (size < (innerWidth > innerHeight ? 0.18 : 0.08) * innerHeight) faults.push(`the robot is ${size.toFixed(0)} px large`);
  }
  return faults;
}

/** Faults of the layout, one line each. */
export function faultsOfLayout(phone) {
  return phone.page.evaluate(look);
}
