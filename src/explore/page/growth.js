// The growth rates of the branches, as lines on the lower panel.

import { NEGLIGIBLE_PER_S, bandColour } from "./marks.js";

// `x` and `y` are the places of a speed and of a growth rate.
export function drawGrowth(context, x, y, report, colours, scale) {
  const damped = report.terms.some((term) => term.includes("damping"));
  context.lineWidth = 1.6 * scale;
  for (const branch of report.campbell.branches) {
    // One stroke for as long as the colour stays: a damped saw has thousands of stretches.
    let [colour, end] = [null, null];
    for (let i = 0; i + 1 < branch.rpm.length; i++) {
      const stretch = stretchOf(report, branch, i, damped, colours);
      if (!stretch) continue;
      if (stretch.colour !== colour) {
        if (colour) context.stroke();
        [colour, end] = [stretch.colour, null];
        context.strokeStyle = colour;
        context.beginPath();
      }
      const [from, to] = stretch.ends;
      if (from[0] !== end?.[0] || from[1] !== end[1]) context.moveTo(x(from[0]), y(from[1]));
      context.lineTo(x(to[0]), y(to[1]));
      end = to;
    }
    if (colour) context.stroke();
  }
}

// Colour and ends of what is drawn of a branch between two samples, if anything is.
function stretchOf(report, branch, i, damped, colours) {
  const growth = [branch.growth_per_s[i], branch.growth_per_s[i + 1]];
  const speeds = [branch.rpm[i], branch.rpm[i + 1]];
  const both = (ends) => ends.map((rpm, k) => [rpm, damped ? growth[k] : Math.max(growth[k], 0)]);
  if (Math.max(...growth) <= NEGLIGIBLE_PER_S) return damped ? { colour: colours.standing, ends: both(speeds) } : null;
  const inside = growth[0] > growth[1] ? speeds[0] : speeds[1];
  // Where bands overlap, the branch grows in its own.
  const around = report.instabilities.filter((b) => b.from_rpm <= inside && inside <= b.to_rpm);
  const band = around.find((b) => b.branches.includes(branch.branch));
  // Without damping growth begins and ends with the band, wherever the samples are.
  const within = damped || !band ? speeds : speeds.map((rpm) => Math.min(Math.max(rpm, band.from_rpm), band.to_rpm));
  return { colour: bandColour(colours, band?.kind ?? "flutter"), ends: both(within) };
}
