// A panel of the chart. uPlot draws the axes, and the function `draw` of the caller draws the items.

import { shown } from "./words.js";

// uPlot is loaded by a separate script, which defines a global.
const { uPlot } = /** @type {any} */ (globalThis);

const FONT = "12px Inter, Helvetica, Arial, sans-serif";

function axis(label, size, splits, tick = (/** @type {number} */ value) => value) {
  const values = (_, places) => places.map((v) => shown(tick(v), 4).replace("-", "−"));
  return { label, labelFont: FONT, font: FONT, size, labelSize: 18, gap: 4, space: splits ? 24 : 50, ticks: { size: 4 }, values, splits };
}

// Returns the positions of round values on an axis from `least` to `most`, far enough apart to be legible. On a root
// scale, the positions are the square roots of the values.
const ROUND = [0.01, 0.03, 0.1, 0.3, 1, 3, 10, 30, 100, 300, 1000];
export function splitsOf(rooted, least, most) {
  const apart = 0.16 * (most - least);
  if (!rooted) {
    const ten = 10 ** Math.floor(Math.log10(apart));
    const step = ten * ([1, 2, 5].find((digit) => digit * ten >= apart) ?? 10);
    const first = Math.ceil(least / step);
    return Array.from({ length: Math.floor(most / step) - first + 1 }, (_, k) => (first + k) * step);
  }
  const marked = [0];
  let last = 0;
  for (const root of ROUND.map(Math.sqrt)) {
    if (root - last < apart) continue;
    if (root <= most) marked.push(root);
    if (-root >= least) marked.unshift(-root);
    last = root;
  }
  return marked;
}

// Makes a panel. Its only series is invisible: uPlot needs one for its axes, but the speeds of the branches differ, so
// that `draw` draws them.
export function plot(place, { height, label, splits = undefined, tick = undefined, yRange, draw, room, xLabel }) {
  let range = null;
  const options = {
    width: 600,
    height,
    padding: [18, room, 0, 0],
    legend: { show: false },
    cursor: { drag: { x: false, y: false }, y: false, points: { show: false } },
    scales: { x: { time: false, range: () => range ?? [0, 1] }, y: { range: () => yRange() } },
    axes: [axis(xLabel, 28), axis(label, 46, splits, tick)],
    series: [{}, { show: true, stroke: "transparent", points: { show: false } }],
    hooks: { drawAxes: [draw] },
  };
  const chart = new uPlot(options, [[0, 1], [null, null]], place);
  // The browser test finds the chart here.
  place.chart = chart;
  return {
    chart,
    setRange(wanted) {
      range = wanted;
      const [least, most] = yRange();
      // Outside of a batch, each of these calls would draw the panel once more.
      chart.batch(() => {
        chart.setData([range, [null, null]], false);
        chart.setScale("x", { min: range[0], max: range[1] });
        chart.setScale("y", { min: least, max: most });
        chart.redraw(false, true);
      });
    },
    setColours(colours) {
      for (const each of chart.axes) {
        Object.assign(each, { stroke: () => colours.quiet });
        each.grid.stroke = () => colours.grid;
        each.ticks.stroke = () => colours.grid;
      }
      chart.redraw(false, true);
    },
  };
}
