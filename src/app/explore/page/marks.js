// Colours of the figures, which are lighter on a dark page, and the drawing of the items of a chart on a canvas.

const DASH = [6, 4];
const FINE_DASH = [4, 4];
const FONT = "Inter, Helvetica, Arial, sans-serif";
const DARK_PAPER = [22, 25, 30];
const WHITE = [255, 255, 255];

const mix = (a, b, share) => a.map((channel, i) => Math.round(channel * share + b[i] * (1 - share)));
const css = (/** @type {number[]} */ [r, g, b]) => `rgb(${r}, ${g}, ${b})`;

// Returns the colours of the page as CSS. Printed paper has those of a light page.
function theme(colours, onPaper = false) {
  const dark = !onPaper && matchMedia("(prefers-color-scheme: dark)").matches;
  const chosen = {};
  for (const [name, colour] of Object.entries(colours)) {
    // On a dark page, lines and letters are lightened for contrast, and shades are darkened.
    if (!dark) chosen[name] = css(colour);
    else if (name.endsWith("_shade")) chosen[name] = css(mix(colours[name.replace("_shade", "")], DARK_PAPER, 0.55));
    else if (name.endsWith("_streak")) chosen[name] = css(mix(colour, DARK_PAPER, 0.6));
    else chosen[name] = css(mix(colour, WHITE, 0.52));
  }
  if (dark) {
    Object.assign(chosen, { paper: css(DARK_PAPER), ink: "rgb(232, 235, 239)", quiet: "rgb(158, 165, 175)", grid: "rgb(44, 49, 57)" });
  }
  return { ...chosen, dark };
}

// Sets the colours of the page as custom properties for the style sheet, and returns them.
export function publish(colours, onPaper) {
  const chosen = theme(colours, onPaper);
  for (const [name, colour] of Object.entries(chosen)) {
    document.documentElement.style.setProperty(`--${name.replaceAll("_", "-")}`, String(colour));
  }
  return chosen;
}

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

  // Clips what `draw` draws to the panel.
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
    this.#stroke(colour, width, dash);
    this.context.beginPath();
    this.context.moveTo(x, this.box.top);
    this.context.lineTo(x, this.box.top + this.box.height);
    this.context.stroke();
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

  #stroke(colour, width, dash = []) {
    this.context.strokeStyle = colour;
    this.context.lineWidth = width * this.scale;
    this.context.setLineDash(dash.map((d) => d * this.scale));
  }

  // Segments entirely above the panel are skipped, and a null in `x` interrupts a line.
  #trace({ x, y }) {
    let goesOn = false;
    this.context.beginPath();
    for (let i = 0; i + 1 < x.length; i++) {
      const isSeen = x[i] !== null && x[i + 1] !== null && Math.max(this.y(y[i]), this.y(y[i + 1])) >= this.box.top;
      if (isSeen && !goesOn) this.context.moveTo(this.x(x[i]), this.y(y[i]));
      if (isSeen) this.context.lineTo(this.x(x[i + 1]), this.y(y[i + 1]));
      goesOn = isSeen;
    }
    this.context.stroke();
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

  #has(at) {
    return this.x(at) >= this.box.left && this.x(at) <= this.box.left + this.box.width;
  }

  // Writes a note of the program across the panel, on a background in the colour of the page.
  note(words) {
    const [left, middle] = [this.box.left + 10 * this.scale, this.box.top + this.box.height / 2];
    this.#letters(this.colours.paper, "left", 12);
    this.context.fillRect(left - 4 * this.scale, middle - 9 * this.scale, this.context.measureText(words).width + 8 * this.scale, 18 * this.scale);
    this.context.fillStyle = this.colours.quiet;
    this.context.fillText(words, left, middle);
  }

  // Labels the vertical lines above the panel or below its upper edge. The operating speed is labelled first; labels
  // without room are omitted.
  labelUprights(items) {
    const { context, scale } = this;
    const taken = [];
    const uprights = items.filter(({ item, x }) => item === "upright" && this.#has(x));
    const isLater = ({ role }) => Number(role !== "operating");
    for (const { x, label } of uprights.sort((a, b) => isLater(a) - isLater(b))) {
      this.#letters(this.colours.ink, "center");
      const half = context.measureText(label).width / 2 + 3 * scale;
      const [left, right] = [this.x(x) - half, this.x(x) + half];
      const isFree = (row) => !taken.some((other) => other.row === row && other.left < right && left < other.right);
      const row = [-8, 8].find(isFree);
      if (row === undefined || taken.some((other) => other.label === label)) continue;
      taken.push({ row, left, right, label });
      const middle = this.box.top + row * scale;
      context.fillStyle = this.colours.paper;
      if (row > 0) context.fillRect(left, middle - 7 * scale, right - left, 14 * scale);
      context.fillStyle = this.colours.ink;
      context.fillText(label, this.x(x), middle);
    }
  }

  // Labels the bands in rows at the top of the panel, beside each band, in order of decreasing growth rate; labels
  // without room are omitted.
  labelBands(items, rows, height) {
    const taken = [];
    const shown = items.filter((band) => band.item === "band" && band.shaded.length > 0 && (this.#has(band.to) || this.#has(band.from)));
    for (const band of shown.sort((a, b) => b.peak_growth_per_s - a.peak_growth_per_s)) {
      this.#letters(this.colours[band.colour], "left");
      const [width, gap] = [this.context.measureText(band.label).width, 5 * this.scale];
      const sides = [this.x(band.to) + gap, this.x(band.from) - gap - width];
      const places = Array.from({ length: rows }, (_, row) => sides.map((left) => ({ left, right: left + width, row }))).flat();
      const free = places.find(({ left, right, row }) => left >= this.box.left && right <= this.context.canvas.width
        && !taken.some((other) => other.row === row && other.left < right + gap && left < other.right + gap));
      if (!free) continue;
      taken.push(free);
      const middle = this.box.top + height * (0.6 + free.row) * this.scale;
      // A translucent background keeps the label legible where thin bands pass behind it.
      this.context.globalAlpha = 0.75;
      this.context.fillStyle = this.colours.paper;
      this.context.fillRect(free.left, middle - 6 * this.scale, width, 12 * this.scale);
      this.context.globalAlpha = 1;
      this.context.fillStyle = this.colours[band.colour];
      this.context.fillText(band.label, free.left, middle);
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
      this.#stroke(colour, 1);
      context.globalAlpha = 0.5;
      context.beginPath();
      context.moveTo(right + 2 * scale, end);
      context.lineTo(right + 12 * scale, at);
      context.stroke();
      context.globalAlpha = 1;
    }
  }
}

// Shortens a text to a width in canvas pixels.
function fitted(context, text, room) {
  if (context.measureText(text).width <= room) return text;
  let cut = text.length - 1;
  while (cut > 1 && context.measureText(`${text.slice(0, cut)}…`).width > room) cut -= 1;
  return `${text.slice(0, cut).trimEnd()}…`;
}
