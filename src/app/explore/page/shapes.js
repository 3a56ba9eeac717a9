// Shapes of a saw as paths, in metres.

import { drawn } from "./dom.js";

export const radians = (value) => (value * Math.PI) / 180;

// Returns half the width of the drawing: the radius of the blade and a margin of 12 %.
export const reachOf = ({ blade }) => 0.5 * blade.outer_diameter_m * 1.12;

export const viewOf = (reach) => `${-reach} ${-reach} ${2 * reach} ${2 * reach}`;

// Returns the transform that moves a shape about the centre of a pad to its place.
export function atPad({ radius_m, angle_deg }) {
  return `translate(${polar(radius_m, angle_deg).join(" ")}) rotate(${-angle_deg})`;
}

// Coordinates in the drawing, where y points down. The angle is counted counterclockwise from the right, in the
// direction of rotation.
export function polar(r, angle_deg) {
  return [r * Math.cos(radians(angle_deg)), -r * Math.sin(radians(angle_deg))];
}

export const circle = (r) => ellipse(r, r);

function ellipse(a, b) {
  return `M${-a} 0A${a} ${b} 0 1 0 ${a} 0A${a} ${b} 0 1 0 ${-a} 0Z`;
}

// Draws the parts of the blade that do not move by hand.
export function ground({ blade, mount }) {
  const [a, b] = [0.5 * blade.inner_diameter_m, 0.5 * blade.outer_diameter_m];
  const collar = mount.kind === "collar" ? [["collar", circle(0.5 * mount.diameter_m) + circle(a)]] : [];
  const slits = blade.slots ? [["slot", cuts(b, blade.slots)]] : [];
  const parts = [["plate", toothed(b, blade.teeth ?? 0) + circle(a)], ["bore", circle(a)], ...collar, ...slits];
  return parts.map(([name, d]) => drawn("path", { class: name, d, "fill-rule": "evenodd" }));
}

// Path of the slots at the moment at which one of them is at 0°.
function cuts(b, { count, depth_m }) {
  const ends = (angle) => [b, b - depth_m].map((r) => polar(r, angle).join(" ")).join("L");
  return Array.from({ length: count }, (_, k) => `M${ends((360 * k) / count)}`).join("");
}

// Path of a pad about its centre.
export function outline(long, wide, shape) {
  const [h, v] = [long / 2, wide / 2];
  return shape === "round" ? ellipse(h, v) : `M${-h} ${-v}H${h}V${v}H${-h}Z`;
}

// Returns the path of the signs of what holds or damps a pad, where `u` is the unit of the drawing: a spring at its outer edge
// for an arm, waves along its inner edge for a film, and a box at a corner for a controller.
export function signs({ arm, film, controller }, long, wide, u) {
  const [h, v] = [long / 2, wide / 2];
  const spring = [[0, 0], [3, 0], [5, -4], [8, 4], [11, -4], [14, 4], [16, 0], [19, 0]].map(([x, y]) => `${h + x * u} ${y * u}`).join("L");
  const wave = Array.from({ length: 4 }, (_, k) => `q${(k % 2 ? 4 : -4) * u} ${v / 4} 0 ${v / 2}`).join("");
  const box = `M${h - 4 * u} ${v - 4 * u}h${8 * u}v${8 * u}h${-8 * u}ZM${h - 2 * u} ${v}h${4 * u}`;
  return [arm && `M${spring}`, film && `M${-h - 4 * u} ${-v}${wave}`, controller && box].filter(Boolean).join("");
}

// Returns whether a part of a pad is beside the blade, at the bore or beyond the rim.
export function overhangs({ radius_m, radial_length_m, tangential_length_m, shape }, { inner_diameter_m, outer_diameter_m }) {
  const half = 0.5 * radial_length_m;
  const outermost = shape === "round" ? radius_m + half : Math.hypot(radius_m + half, 0.5 * tangential_length_m);
  return outermost > 0.5 * outer_diameter_m || radius_m - half < 0.5 * inner_diameter_m;
}

// Path of everything in the drawing that is not the blade.
export function besideBlade({ inner_diameter_m, outer_diameter_m }, reach) {
  return `M${-reach} ${-reach}H${reach}V${reach}H${-reach}Z${circle(0.5 * outer_diameter_m)}${circle(0.5 * inner_diameter_m)}`;
}

// Returns a small picture of a saw.
export function thumbnail(scene) {
  const reach = reachOf(scene);
  const least = (length) => Math.max(length, 0.1 * reach);
  const pads = (scene.guides ?? []).map((pad) => {
    const sides = [pad.radial_length_m, pad.tangential_length_m].map(least);
    const [body, sign] = [outline(sides[0], sides[1], pad.shape), signs(pad, sides[0], sides[1], 0.014 * reach)];
    return drawn("g", { class: "pad", transform: atPad(pad) }, drawn("path", { class: "body", d: body }), drawn("path", { class: "sign", d: sign }));
  });
  return drawn("svg", { class: "thumbnail", "aria-hidden": "true", viewBox: viewOf(reach) }, ...ground(scene), ...pads);
}

// Path of the rim. The shape of its teeth is an illustration: the model has a circular rim.
function toothed(b, teeth) {
  if (teeth < 3 || teeth > 400) return circle(b);
  const pitch = 360 / teeth;
  const depth = Math.min(0.03 * b, 0.4 * ((2 * Math.PI * b) / teeth));
  let path = "";
  for (let k = 0; k < teeth; k++) {
    const [x, y] = polar(b - depth, k * pitch);
    const [u, v] = polar(b, k * pitch + 0.62 * pitch);
    const [p, q] = polar(b - depth, k * pitch + 0.7 * pitch);
    path += `${k === 0 ? "M" : "L"}${x} ${y}L${u} ${v}L${p} ${q}`;
  }
  return `${path}Z`;
}
