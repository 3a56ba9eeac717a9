// What a chart says about the place under the pointer: the values of the axes in its corner, and the names of the items
// there as a tooltip.

import { toSegment } from "./branches.js";
import { node, write } from "./dom.js";
import { formUnit } from "./fields.js";
import { shown } from "./words.js";

const NEAR_PX = 6;

function inWords(value, unit) {
  const own = formUnit(unit);
  return `${shown(value * own.scale, 4).replace("-", "−")} ${own.unit}`.trim();
}

// Returns the index of the value that is nearest to another one.
function nearest(values, value) {
  const off = values.map((one) => Math.abs(one - value));
  return off.indexOf(Math.min(...off));
}

// Name of an item at a place, or undefined if it is not there. `axes` convert values to pixels.
const NAMES = {
  line({ x, y, name, said }, { axes, pixels }) {
    const ends = x.map((at, k) => [axes.x.at(at), axes.y.at(y[k])]);
    const k = ends.findIndex((end, i) => i + 1 < x.length && ![y[i], y[i + 1]].includes(null) && toSegment(pixels, end, ends[i + 1]) < NEAR_PX);
    return k < 0 ? undefined : said[k] ?? name;
  },
  points({ x, y, name, said }, { axes, pixels: [left, top] }) {
    const k = x.findIndex((at, i) => Math.hypot(axes.x.at(at) - left, axes.y.at(y[i]) - top) < NEAR_PX);
    return k < 0 ? undefined : said[k] ?? name;
  },
  upright: ({ x, name }, { axes, pixels }) => (Math.abs(axes.x.at(x) - pixels[0]) < NEAR_PX ? name : undefined),
  band: ({ shaded, name }, { x }) => (shaded.some(([from, to]) => from <= x && x <= to) ? name : undefined),
  bars({ edges, heights, name }, { x, y }) {
    const height = heights[edges.findLastIndex((edge) => edge <= x)];
    return 0 <= y && y <= height ? `${name} ${shown(height, 4)}`.trim() : undefined;
  },
  area(item, { x, y }) {
    const k = nearest(item.x, x);
    return item.low[k] <= y && y <= item.high[k] ? item.name : undefined;
  },
  heat({ x: columns, y: rows, z, colours, name, unit }, { x, y }) {
    const value = z[nearest(rows, y)][nearest(columns, x)];
    return value === null ? undefined : colours.length > 1 ? `${name} ${inWords(value, unit)}` : name;
  },
};

// Follows the pointer over an element. `look(event)` returns the panel there with its two axes, and the pixels of the
// pointer, or null. Returns the element with the values.
export function readOut(over, look) {
  const words = node("span", { className: "at" });
  over.addEventListener("pointermove", (event) => {
    const seen = look(event);
    const [x, y] = seen ? ["x", "y"].map((side, k) => seen.axes[side].of(seen.pixels[k])) : [];
    write(words, seen ? [inWords(x, seen.panel.x.unit), inWords(y, seen.panel.y.unit)].join(", ") : "");
    const names = (seen?.panel.items ?? []).map((item) => NAMES[item.item]?.(item, { ...seen, x, y })).filter(Boolean);
    over.title = names.at(-1) ?? "";
  });
  over.addEventListener("pointerleave", () => write(words, ""));
  return words;
}
