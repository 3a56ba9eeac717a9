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

// Returns a small picture of a saw.
export function thumbnail(scene) {
  const reach = reachOf(scene);
  const least = (length) => Math.max(length, 0.1 * reach);
  const pads = (scene.guides ?? []).map((pad) => {
    const d = outline(least(pad.radial_length_m), least(pad.tangential_length_m), pad.shape);
    return drawn("g", { class: "pad" }, drawn("path", { class: "body", d, transform: atPad(pad) }));
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
