// How things are drawn: the colours of the figures, lighter on a dark page, and the marks of
// a Campbell diagram on a canvas.

export const NEGLIGIBLE_PER_S = 1e-3;
const DASH = [6, 4];
const FINE_DASH = [4, 4];
const DARK_PAPER = [22, 25, 30];
const WHITE = [255, 255, 255];

const mix = (a, b, share) => a.map((channel, i) => Math.round(channel * share + b[i] * (1 - share)));
const css = (/** @type {number[]} */ [r, g, b]) => `rgb(${r}, ${g}, ${b})`;

// Paper is white.
export function theme(colours, onPaper = false) {
  const dark = !onPaper && matchMedia("(prefers-color-scheme: dark)").matches;
  const chosen = {};
  for (const [name, colour] of Object.entries(colours)) {
    // Lines and letters are lightened until they stand out; shades are darkened.
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

// The same colours for the style sheet.
export function publish(colours, onPaper) {
  const chosen = theme(colours, onPaper);
  for (const [name, colour] of Object.entries(chosen)) {
    document.documentElement.style.setProperty(`--${name.replaceAll("_", "-")}`, String(colour));
  }
  return chosen;
}

export function waveColour(colours, direction) {
  return direction === "forward" ? colours.forward : direction === "standing" ? colours.standing : colours.backward;
}

export const bandColour = (colours, kind) => (kind === "flutter" ? colours.flutter : colours.divergence);

// What a stretch of a branch between two samples looks like, as in the figures.
function lookOf(report, branch, i) {
  const middle = 0.5 * (branch.rpm[i] + branch.rpm[i + 1]);
  const grows = branch.growth_per_s[i] > NEGLIGIBLE_PER_S || branch.growth_per_s[i + 1] > NEGLIGIBLE_PER_S;
  const inside = grows && report.instabilities.some((band) => band.from_rpm <= middle && middle <= band.to_rpm);
  if (inside) return "unstable";
  return branch.krein_sign[i] < 0 || branch.krein_sign[i + 1] < 0 ? "reflected" : "plain";
}

export function stretches(report, branch) {
  const all = [];
  for (let i = 0; i + 1 < branch.rpm.length; i++) {
    const look = lookOf(report, branch, i);
    // Guides let waves stand at rest, whatever they do from there on.
    const direction = branch.direction[i + 1];
    const last = all.at(-1);
    if (last?.look === look && last.direction === direction) last.to = i + 1;
    else all.push({ look, direction, from: i, to: i + 1 });
  }
  return all;
}

// Highest frequency worth showing, as in the figures.
export function highestShown(report) {
  const { branches, from_rpm, complete_to_hz } = report.campbell;
  const atRest = branches.filter((b) => b.rpm[0] === from_rpm).map((b) => b.frequency_hz[0]);
  const lowest = atRest.sort((x, y) => x - y).slice(0, 6);
  const reflected = branches.flatMap((b) => b.frequency_hz.filter((_, i) => b.krein_sign[i] < 0));
  const bands = report.instabilities.map((band) => band.frequency_hz);
  const measured = (report.scene.measured?.rows ?? []).flatMap((row) => row.frequencies_hz.filter((hz) => hz !== null));
  const wanted = 1.1 * [...lowest, ...reflected, ...bands, ...measured].reduce((x, y) => Math.max(x, y), 0);
  const top = Math.min(wanted, complete_to_hz > 0 ? complete_to_hz : Infinity);
  return top > 0 ? top : 1;
}

// What lies above the panel is not drawn: of a damped saw that is most of it.
function trace(context, place, branch, from, to, top) {
  const at = (i) => place(branch.rpm[i], branch.frequency_hz[i]);
  let goesOn = false;
  context.beginPath();
  for (let i = from; i < to; i++) {
    const isAbove = Math.min(branch.frequency_hz[i], branch.frequency_hz[i + 1]) > top;
    if (!isAbove && !goesOn) context.moveTo(...at(i));
    if (!isAbove) context.lineTo(...at(i + 1));
    goesOn = !isAbove;
  }
  context.stroke();
}

// `top` is the frequency at the upper end of the panel.
export function drawBranches(context, place, report, colours, { scale, top, highlighted = undefined, ghost = false }) {
  // From the highest down, so that the lowest lie on top.
  for (const branch of [...report.campbell.branches].reverse()) {
    const strong = branch === highlighted ? 1.6 : 0;
    context.globalAlpha = ghost ? 0.45 : 1;
    for (const { look, direction, from, to } of stretches(report, branch)) {
      context.strokeStyle = ghost ? colours.standing : waveColour(colours, direction);
      context.lineWidth = (ghost ? 1 : look === "unstable" ? 3.4 : 1.6 + strong) * scale;
      context.setLineDash(look === "reflected" ? DASH.map((d) => d * scale) : []);
      trace(context, place, branch, from, to, top);
    }
  }
  context.globalAlpha = 1;
  context.setLineDash([]);
}

export function drawBands(context, x, box, report, colours, scale) {
  for (const band of report.instabilities) {
    const [left, right] = [x(band.from_rpm), x(band.to_rpm)];
    const narrow = right - left < 2 * scale;
    context.fillStyle = colours[`${band.kind}_${narrow ? "streak" : "shade"}`];
    context.fillRect(left, box.top, Math.max(right - left, 1.2 * scale), box.height);
  }
}

export function verticalLine(context, at, box, colour, scale, dash = FINE_DASH) {
  context.strokeStyle = colour;
  context.lineWidth = scale;
  context.setLineDash(dash.map((d) => d * scale));
  context.beginPath();
  context.moveTo(at, box.top);
  context.lineTo(at, box.top + box.height);
  context.stroke();
  context.setLineDash([]);
}

// Names at the right ends of the branches, pushed apart; those without room are left out.
// As much of a text as there is room for.
function fitted(context, text, room) {
  if (context.measureText(text).width <= room) return text;
  let cut = text.length - 1;
  while (cut > 1 && context.measureText(`${text.slice(0, cut)}…`).width > room) cut -= 1;
  return `${text.slice(0, cut).trimEnd()}…`;
}

export function labelEnds(context, place, box, report, colours, scale) {
  const height = 13 * scale;
  const labels = report.campbell.branches
    .filter((branch) => branch.rpm.at(-1) >= report.campbell.to_rpm * (1 - 1e-9))
    .map((branch) => ({ branch, end: place(branch.rpm.at(-1), branch.frequency_hz.at(-1))[1] }))
    .filter(({ end }) => end >= box.top && end <= box.top + box.height)
    .sort((x, y) => x.end - y.end);
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
  context.font = `${11 * scale}px Inter, Helvetica, Arial, sans-serif`;
  context.textAlign = "left";
  context.textBaseline = "middle";
  const right = box.left + box.width;
  for (const { branch, end, at } of labels) {
    if (Math.abs(at - end) > 60 * scale || at < box.top - height) continue;
    const colour = waveColour(colours, branch.direction.at(-1));
    context.fillStyle = colour;
    context.fillText(fitted(context, branch.label, context.canvas.width - right - 16 * scale), right + 14 * scale, at);
    context.strokeStyle = colour;
    context.globalAlpha = 0.5;
    context.lineWidth = scale;
    context.beginPath();
    context.moveTo(right + 2 * scale, end);
    context.lineTo(right + 12 * scale, at);
    context.stroke();
    context.globalAlpha = 1;
  }
}

export function drawMeasured(context, place, measured, colours, scale) {
  context.strokeStyle = colours.ink;
  context.fillStyle = colours.paper;
  context.lineWidth = 1.2 * scale;
  for (const row of measured.rows) {
    for (const frequency of row.frequencies_hz.filter((hz) => hz !== null)) {
      const [x, y] = place(row.rpm, frequency);
      context.beginPath();
      context.arc(x, y, 3 * scale, 0, 2 * Math.PI);
      context.fill();
      context.stroke();
    }
  }
}
