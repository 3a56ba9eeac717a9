// Drawing of the items of a chart on a canvas.

import { DARK_PAPER, css, mix } from "./colours.js";
import { shown } from "./words.js";

const DASH = [6, 4];
const FINE_DASH = [4, 4];
const FONT = "Inter, Helvetica, Arial, sans-serif";
// Draws the items of a chart on one of its panels. `x` and `y` convert values to canvas pixels, `box` is the panel in
// canvas pixels, and `scale` is the number of canvas pixels for each pixel of the page.
export class Painter {
  constructor(context, { x, y, box, scale, colours }) {
    this.context = context;
    this.x = x;
    this.y = y;
    this.box = box;
    this.scale = scale;
    this.colours = colours;
  }

  within(draw) {
    this.context.save();
    this.context.beginPath();
    this.context.rect(this.box.left, this.box.top, this.box.width, this.box.height);
    this.context.clip();
    draw();
    this.context.restore();
  }

  // Draws the bands, narrow ones last, so that a wide one does not hide them.
  bands(items) {
    const stretches = items.filter(({ item }) => item === "band").flatMap((band) => band.shaded.map((ends) => ({ band, ends: ends.map(this.x) })));
    for (const narrow of [false, true]) {
      for (const { band, ends: [left, right] } of stretches) {
        if (right - left < 2 * this.scale !== narrow) continue;
        this.context.fillStyle = this.colours[narrow ? band.streak : band.shade];
        this.context.fillRect(left, this.box.top, Math.max(right - left, 1.2 * this.scale), this.box.height);
      }
    }
  }

  upright(at, colour, width, dash) {
    const x = this.x(at);
    this.#line(colour, width, [[x, this.box.top], [x, this.box.top + this.box.height]], dash);
  }

  uprights(items, alarm) {
    for (const { x, role, colour, dashed } of items.filter(({ item }) => item === "upright")) {
      const operating = role === "operating";
      this.upright(x, this.colours[operating && alarm ? "alarm" : colour], operating ? 1.6 : 0.8, dashed ? FINE_DASH : []);
    }
  }

  // Draws the lines. The branch with the number `highlighted` is thicker. If `ghost` is given, the items are those of a
  // pinned saw: only its branches are drawn, in grey, with the dashes `ghost`.
  lines(items, { highlighted = null, ghost = null } = {}) {
    for (const line of items) {
      if (line.item !== "line" || (ghost && line.branch === null)) continue;
      const strong = line.branch !== null && line.branch === highlighted && line.width < 3 ? 1.6 : 0;
      this.context.globalAlpha = ghost ? 0.45 : line.tint;
      const dash = line.width > 1 ? DASH : FINE_DASH;
      this.#stroke(this.colours[ghost ? "standing" : line.colour], ghost ? 1 : line.width + strong, ghost ?? (line.dashed ? dash : []));
      this.#trace(line);
    }
    this.context.globalAlpha = 1;
    this.context.setLineDash([]);
  }

  // Draws straight lines through points, in canvas pixels.
  #line(colour, width, points, dash = []) {
    this.#stroke(colour, width, dash);
    this.context.beginPath();
    for (const [x, y] of points) this.context.lineTo(x, y);
    this.context.stroke();
  }

  #stroke(colour, width, dash = []) {
    this.context.strokeStyle = colour;
    this.context.lineWidth = width * this.scale;
    this.context.setLineDash(dash.map((d) => d * this.scale));
  }

  // Segments entirely above the panel are skipped, and a null interrupts a line.
  #trace({ x, y }) {
    let goesOn = false;
    this.context.beginPath();
    for (let i = 0; i + 1 < x.length; i++) {
      const isSeen = ![x[i], x[i + 1], y[i], y[i + 1]].includes(null) && Math.max(this.y(y[i]), this.y(y[i + 1])) >= this.box.top;
      if (isSeen && !goesOn) this.context.moveTo(this.x(x[i]), this.y(y[i]));
      if (isSeen) this.context.lineTo(this.x(x[i + 1]), this.y(y[i + 1]));
      goesOn = isSeen;
    }
    this.context.stroke();
  }

  areas(items) {
    for (const { item, x, low, high, edges, heights, colour, tint } of items) {
      if (item !== "area" && item !== "bars") continue;
      this.context.fillStyle = this.colours[colour];
      this.context.globalAlpha = tint;
      if (item === "bars") heights.forEach((height, k) => this.#fill(edges[k], edges[k + 1], 0, height));
      else x.forEach((at, k) => this.#fill((at + (x[k - 1] ?? at)) / 2, (at + (x[k + 1] ?? at)) / 2, low[k], high[k]));
      this.context.globalAlpha = 1;
    }
  }

  #fill(from, to, low, high) {
    if (low === null || high === null || low >= high) return;
    const [left, top] = [this.x(from), this.y(high)];
    this.context.fillRect(left, top, this.x(to) - left, this.y(low) - top);
  }

  // Fills the cells of grids, which end half way to their neighbours and at the ends of the axes.
  cells(items, [left, right], [bottom, top]) {
    const edges = (values, first, last) => [first, ...values.slice(1).map((value, k) => (value + values[k]) / 2), last];
    for (const heat of items.filter(({ item }) => item === "heat")) {
      const [x, y] = [edges(heat.x, left, right).map(this.x), edges(heat.y, bottom, top).map(this.y)];
      heat.z.forEach((row, j) => row.forEach((value, i) => {
        if (value === null) return;
        this.context.fillStyle = this.#ramp(heat, value);
        // Half a pixel more leaves no gap between neighbours.
        this.context.fillRect(x[i], y[j + 1], x[i + 1] - x[i] + 0.5, y[j] - y[j + 1] + 0.5);
      }));
    }
  }

  #ramp({ colours, range, spread }, value) {
    const [low, at, high] = [range[0], value, range[1]].map((one) => (spread === "logarithmic" ? Math.log10(one) : one));
    const place = Math.min(Math.max((at - low) / (high - low || 1), 0), 1) * (colours.length - 1);
    const below = Math.min(Math.floor(place), Math.max(colours.length - 2, 0));
    const colour = colours.length > 1 ? mix(colours[below + 1], colours[below], place - below) : colours[0];
    return css(this.colours.dark ? mix(colour, DARK_PAPER, 0.72) : colour);
  }

  scaleOf(heat, { unit, scale }) {
    const left = this.box.left + this.box.width + 10 * this.scale;
    const [least, most] = heat.range;
    const value = (share) => (heat.spread === "logarithmic" ? least * (most / least) ** share : least + share * (most - least));
    for (let k = 0; k < 40; k++) {
      this.context.fillStyle = this.#ramp(heat, value((k + 0.5) / 40));
      this.context.fillRect(left, this.box.top + (1 - (k + 1) / 40) * this.box.height, 12 * this.scale, this.box.height / 40 + 1);
    }
    this.#letters(this.colours.quiet, "left", 10);
    for (const share of [0, 0.5, 1]) {
      const words = `${shown(value(share) * scale, 3)} ${share === 1 ? unit : ""}`;
      this.context.fillText(words, left + 16 * this.scale, this.box.top + (1 - share) * this.box.height);
    }
  }

  axes(x, y, hasNumbers) {
    const { left, top, width, height } = this.box;
    this.#stroke(this.colours.grid, 1);
    this.context.strokeRect(left, top, width, height);
    let free = -Infinity;
    for (const [value, words] of x.ticks) {
      const at = this.x(value);
      this.#line(this.colours.grid, 1, [[at, top], [at, top + height]]);
      this.#letters(this.colours.quiet, "center");
      const half = this.context.measureText(words).width / 2;
      if (at - half < free || at < left - 1 || at > left + width + 1) continue;
      free = at + half + 6 * this.scale;
      this.context.fillText(words, at, top + height + 10 * this.scale);
    }
    for (const [value, words] of hasNumbers ? y.ticks : []) {
      const at = this.y(value);
      if (at < top - 1 || at > top + height + 1) continue;
      this.#line(this.colours.grid, 1, [[left, at], [left + width, at]]);
      this.#letters(this.colours.quiet, "right");
      this.context.fillText(fitted(this.context, words, left - 18 * this.scale), left - 5 * this.scale, at);
    }
    this.#letters(this.colours.quiet, "center");
    this.context.fillText(x.title, left + width / 2, top + height + 28 * this.scale);
    this.context.save();
    this.context.translate(left - 50 * this.scale, top + height / 2);
    this.context.rotate(-Math.PI / 2);
    this.context.fillText(fitted(this.context, y.title, height), 0, 0);
    this.context.restore();
  }

  heading(words, at) {
    this.#letters(this.colours.ink, "left", 12);
    this.context.fillText(fitted(this.context, words, this.box.width), this.box.left, at);
  }

  texts(items) {
    const [left, width] = [this.box.left, this.box.width];
    const write = (words, x, y, colour) => {
      this.#letters(this.colours[colour], "left", 10);
      const wide = this.context.measureText(words).width;
      const at = Math.min(this.x(x) + 5 * this.scale, left + width - wide);
      this.context.fillText(words, at, this.y(y) - 8 * this.scale);
    };
    for (const { item, x, y, text, label, colour } of items) {
      if (item === "label") write(text, x, y, colour);
      const middle = Math.floor((x?.length ?? 0) / 2);
      if (item === "line" && label && ![x[middle], y[middle]].includes(null)) write(label, x[middle], y[middle], colour);
    }
  }

  cross(shares) {
    const [x, y] = shares;
    const { left, top, width, height } = this.box;
    const [at, level] = [left + x * width, top + (1 - y) * height];
    this.#line(this.colours.ink, 1.5, [[at, top], [at, top + height]]);
    this.#line(this.colours.ink, 1.5, [[left, level], [left + width, level]]);
  }

  points(items) {
    for (const { x, y, colour, size, shape } of items.filter(({ item }) => item === "points")) {
      this.#stroke(this.colours[colour], 0.2 * size);
      const hollow = shape === "ring";
      this.context.fillStyle = this.colours[hollow ? "paper" : colour];
      x.forEach((at, i) => {
        this.context.beginPath();
        this.context.arc(this.x(at), this.y(y[i]), 0.5 * size * this.scale, 0, 2 * Math.PI);
        this.context.fill();
        if (hollow) this.context.stroke();
      });
    }
  }

  ring(at, height, radius) {
    this.#stroke(this.colours.ink, 2);
    this.context.beginPath();
    this.context.arc(this.x(at), this.y(height), radius * this.scale, 0, 2 * Math.PI);
    this.context.stroke();
  }

  #letters(colour, align, size = 11) {
    this.context.font = `${size * this.scale}px ${FONT}`;
    this.context.textAlign = align;
    this.context.textBaseline = "middle";
    this.context.fillStyle = colour;
  }

  // Writes a text from `left` on, on a background in the colour of the page. `beside` and `height` are in pixels of the page.
  #onPaper(text, colour, left, middle, { beside = 0, height, opacity = 1 }) {
    const { context, scale } = this;
    context.globalAlpha = opacity;
    context.fillStyle = this.colours.paper;
    context.fillRect(left - beside * scale, middle - 0.5 * height * scale, context.measureText(text).width + 2 * beside * scale, height * scale);
    context.globalAlpha = 1;
    context.fillStyle = this.colours[colour];
    context.fillText(text, left, middle);
  }

  #has(at) {
    return this.x(at) >= this.box.left && this.x(at) <= this.box.left + this.box.width;
  }

  // Writes a note of the program across the panel, on a background in the colour of the page.
  note(words) {
    const [left, middle] = [this.box.left + 10 * this.scale, this.box.top + this.box.height / 2];
    this.#letters(this.colours.paper, "left", 12);
    const lines = broken(this.context, words, this.box.width - 20 * this.scale);
    lines.forEach((line, k) => {
      this.#onPaper(line, "quiet", left, middle + 16 * (k - 0.5 * (lines.length - 1)) * this.scale, { beside: 4, height: 18 });
    });
  }

  // Labels the vertical lines above the panel or below its upper edge. The operating speed is labelled first; labels
  // without room are omitted.
  labelUprights(items) {
    const { context, scale } = this;
    const taken = [];
    const uprights = items.filter(({ item, x }) => item === "upright" && this.#has(x));
    const isLater = ({ role }) => Number(role !== "operating");
    for (const { x, label } of uprights.sort((a, b) => isLater(a) - isLater(b))) {
      this.#letters(this.colours.ink, "left");
      const half = context.measureText(label).width / 2;
      const [left, right] = [this.x(x) - half - 3 * scale, this.x(x) + half + 3 * scale];
      const isFree = (row) => !taken.some((other) => other.row === row && other.left < right && left < other.right);
      const row = [-8, 8].find(isFree);
      if (row === undefined || taken.some((other) => other.label === label)) continue;
      taken.push({ row, left, right, label });
      this.#onPaper(label, "ink", this.x(x) - half, this.box.top + row * scale, { beside: 3, height: row > 0 ? 14 : 0 });
    }
  }

  // Labels the bands in rows at the top of the panel, beside each band, in order of decreasing growth rate; labels
  // without room are omitted.
  labelBands(items, rows, height) {
    const taken = [];
    const wanted = items.filter((band) => band.item === "band" && band.shaded.length > 0 && (this.#has(band.to) || this.#has(band.from)));
    for (const band of wanted.sort((a, b) => b.peak_growth_per_s - a.peak_growth_per_s)) {
      this.#letters(this.colours[band.colour], "left");
      const [width, gap] = [this.context.measureText(band.label).width, 5 * this.scale];
      const sides = [this.x(band.to) + gap, this.x(band.from) - gap - width];
      const places = Array.from({ length: rows }, (_, row) => sides.map((left) => ({ left, right: left + width, row }))).flat();
      const free = places.find(({ left, right, row }) => left >= this.box.left && right <= this.context.canvas.width
        && !taken.some((other) => other.row === row && other.left < right + gap && left < other.right + gap));
      if (!free) continue;
      taken.push(free);
      // A translucent background keeps the label legible where thin bands pass behind it.
      this.#onPaper(band.label, band.colour, free.left, this.box.top + height * (0.6 + free.row) * this.scale, { height: 12, opacity: 0.92 });
    }
  }

  // Writes the names of lines at their right ends, moved apart; names without room are omitted.
  labelEnds(items) {
    const { context, box, scale } = this;
    const height = 13 * scale;
    const labels = items
      .filter((line) => line.item === "line" && line.end !== "")
      .map((line) => ({ line, end: this.y(line.y.at(-1)), at: 0 }))
      .filter(({ end }) => end >= box.top && end <= box.top + box.height)
      .sort((a, b) => a.end - b.end);
    let free = box.top - height / 2;
    for (const label of labels) {
      label.at = Math.max(label.end, free + height);
      free = label.at;
    }
    let limit = box.top + box.height + height / 2;
    for (const label of [...labels].reverse()) {
      label.at = Math.min(label.at, limit);
      limit = label.at - height;
    }
    const right = box.left + box.width;
    for (const { line, end, at } of labels) {
      if (Math.abs(at - end) > 60 * scale || at < box.top - height) continue;
      const colour = this.colours[line.colour];
      this.#letters(colour, "left");
      context.fillText(fitted(context, line.end, context.canvas.width - right - 16 * scale), right + 14 * scale, at);
      context.globalAlpha = 0.5;
      this.#line(colour, 1, [[right + 2 * scale, end], [right + 12 * scale, at]]);
      context.globalAlpha = 1;
    }
  }
}

// Breaks a text into lines that are no wider than a width in canvas pixels.
function broken(context, text, room) {
  const lines = [""];
  for (const word of text.split(" ")) {
    const longer = `${lines.at(-1)} ${word}`.trimStart();
    if (context.measureText(longer).width <= room) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  return lines;
}

function fitted(context, text, room) {
  if (context.measureText(text).width <= room) return text;
  let cut = text.length - 1;
  while (cut > 1 && context.measureText(`${text.slice(0, cut)}…`).width > room) cut -= 1;
  return `${text.slice(0, cut).trimEnd()}…`;
}
