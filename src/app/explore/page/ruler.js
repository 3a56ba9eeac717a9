// The ruler of speeds from rest to the end of the sweep: the window without instability, the usual limit, critical speeds and bands. Its
// handle is the operating speed.

import { node } from "./dom.js";

const PATH = "operating_rpm";
// Smallest distance between two labels.
const APART_PX = 34;

export class Ruler {
  // Shows what is shown, for a new width.
  #again = () => {};

  constructor(place, state) {
    this.state = state;
    this.marks = node("div", { className: "marks" });
    this.handle = node("input", {
      type: "range", min: 0, step: 1, "aria-label": "Operating speed, on the ruler",
      oninput: ({ timeStamp: stamp }) => state.set(PATH, Number(this.handle.value), { draft: true, stamp, run: PATH }),
      onchange: (event) => state.settle(event.timeStamp),
    });
    this.key = node("p", { className: "key" });
    place.append(this.marks, this.handle);
    place.after(this.key);
    new ResizeObserver(() => this.#again()).observe(place);
  }

  refresh() {
    const rpm = this.state.scene[PATH];
    this.handle.value = String(rpm ?? 0);
    this.handle.setAttribute("aria-valuetext", typeof rpm === "number" ? `${Math.round(rpm)} rpm` : "none");
  }

  // Shows the speeds of a chart; `items` are those of its diagram.
  show(speeds, items) {
    this.#again = () => this.show(speeds, items);
    const { to_rpm, window_rpm, window, limit_rpm, limit } = speeds;
    const mark = (className, from, to, title, label = "") => {
      const made = node("span", { className, title }, node("span", { textContent: label }));
      made.style.left = `${(100 * from) / to_rpm}%`;
      made.style.width = `${(100 * (to - from)) / to_rpm}%`;
      return made;
    };
    const bands = items.filter(({ item }) => item === "band").flatMap(({ shaded, colour, name }) => shaded.map(([from, to]) => {
      const made = mark("band", from, to, name);
      made.style.background = `var(--${colour})`;
      return made;
    }));
    let last = -Infinity;
    const room = (APART_PX * to_rpm) / (this.marks.clientWidth || 1);
    const critical = items.filter(({ role, x }) => role === "critical" && x <= to_rpm).map(({ x, name, label }) => {
      const isApart = x - last > room;
      if (isApart) last = x;
      return mark("critical", x, x, name, isApart ? label : "");
    });
    const usable = window_rpm === null ? [] : [mark("window", ...window_rpm, window)];
    const usual = limit_rpm === null || limit_rpm > to_rpm ? [] : [mark("limit", limit_rpm, limit_rpm, "", limit)];
    this.marks.replaceChildren(...usable, ...bands, ...critical, ...usual);
    const kinds = [...new Set(items.filter(({ item }) => item === "band").map(({ colour }) => colour))];
    const entries = [["window", window_rpm && `stable from ${window_rpm.map(Math.round).join(" to ")} rpm`], ...kinds.map((kind) => [kind, kind]), ["critical", critical.length > 0 && "critical speed"],
      ["limit", usual.length > 0 && `${limit} of the first`]];
    this.key.replaceChildren(...entries.filter(([, words]) => words).map(([className, textContent]) => node("span", { className, textContent })));
    this.handle.max = String(Math.ceil(to_rpm));
    this.refresh();
  }
}
