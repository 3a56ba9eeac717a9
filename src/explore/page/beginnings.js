// What a part of the scene begins with when it is put in: values that compute, and that a designer
// would start from.

import { get, set } from "./scene.js";

const opposite = (angle) => (angle > 0 ? angle - 180 : angle + 180);

// The angle farthest from those of the pads there are: no pad comes to lie on another.
function freeAngle(angles) {
  if (angles.length === 0) return -55;
  if (angles.length === 1) return opposite(angles[0]);
  const apart = (x, y) => Math.abs(((x - y + 540) % 360) - 180);
  const distance = (angle) => Math.min(...angles.map((other) => apart(angle, other)));
  const all = Array.from({ length: 72 }, (_, k) => 5 * k - 175);
  return all.reduce((best, angle) => (distance(angle) > distance(best) ? angle : best));
}

const round = (value, digits) => Number(value.toPrecision(digits));
const rim = (scene) => 0.5 * scene.blade.outer_diameter_m;
const collar = (scene) => 0.5 * (scene.mount?.diameter_m ?? scene.blade.inner_diameter_m);
const between = (scene, share) => round(collar(scene) + share * (rim(scene) - collar(scene)), 3);
const operating = (scene) => scene.operating_rpm ?? 1800;

// So many teeth have a pitch that is usual.
const USUAL_PITCH_M = 0.03;
const teethOf = (scene) => scene.blade.teeth ?? Math.max(Math.round((2 * Math.PI * rim(scene)) / USUAL_PITCH_M), 12);

// A triangle of steel, half as high as the pitch.
function toothMass(scene) {
  const pitch = (2 * Math.PI * rim(scene)) / teethOf(scene);
  return scene.blade.material.density_kg_per_m3 * scene.blade.thickness_m * 0.25 * pitch * pitch;
}

// The row of a table over the radius that is put in next, with the values of its neighbours: between the last one
// and the rim, or where rows are farthest apart.
function nextRow(scene, rows, values) {
  if (!rows?.length) return { radius_m: round(collar(scene), 3), ...values };
  const radii = [...rows.map((row) => row.radius_m), rim(scene)];
  const gaps = rows.map((_, i) => radii[i + 1] - radii[i]);
  const at = gaps.at(-1) > 1e-3 * rim(scene) ? rows.length - 1 : gaps.indexOf(Math.max(...gaps));
  const next = rows[at + 1] ?? rows[at];
  const key = Object.keys(values)[0];
  return { radius_m: round(0.5 * (radii[at] + radii[at + 1]), 4), [key]: 0.5 * (rows[at][key] + next[key]) };
}

const inOrder = (rows) => rows.sort((x, y) => x.radius_m - y.radius_m);

// What else a part needs of the scene, once it is in it.
const NEEDS = {
  "blade.rim": (scene) => (scene.blade.teeth ??= teethOf(scene)),
  cut: (scene) => (scene.blade.teeth ??= teethOf(scene)),
  // Without damping the smallest delayed force lets some mode grow.
  "cut.washboarding": (scene) => {
    scene.operating_rpm ??= operating(scene);
    scene.damping ??= { material_retardation_time_s: 1e-6 };
  },
  // One way of saying it.
  "membrane.temperature.table[]": ({ membrane: { temperature } }) => {
    for (const key of ["rim_rise_k", "from_radius_m", "exponent"]) delete temperature[key];
    inOrder(temperature.table);
  },
  "membrane.residual_stress[]": (scene) => inOrder(scene.membrane.residual_stress),
  "blade.profile[]": (scene) => inOrder(scene.blade.profile),
};

// Nothing but its own stiffness holds the blade to the side.
const isFree = (scene) => scene.mount?.kind !== "collar" && !scene.guides?.length;

// One that soft guides yield to by less than the thickness of the blade: the model is linear.
function sideForce(scene) {
  if (scene.mount?.kind === "collar") return 5;
  const stiffness = (scene.guides ?? []).reduce((sum, guide) => sum + (guide.stiffness_n_per_m ?? 0), 0);
  return round(Math.min(Math.max(0.01 * scene.blade.thickness_m * stiffness, 1e-3), 5), 1);
}

const PARTS = {
  "guides[]": (scene) => {
    const last = scene.guides?.at(-1);
    const angle_deg = freeAngle((scene.guides ?? []).map((pad) => pad.angle_deg ?? 0));
    if (last) return { ...structuredClone(last), angle_deg };
    const length = round(0.3 * (rim(scene) - collar(scene)), 2);
    return { radius_m: between(scene, 0.6), angle_deg, radial_length_m: length, tangential_length_m: length, stiffness_n_per_m: 1e7 };
  },
  "membrane.temperature": () => ({ expansion_per_k: 1.2e-5, rim_rise_k: 0 }),
  "membrane.roll_tension[]": (scene) => ({ radius_m: between(scene, 0.5), width_m: round(0.1 * (rim(scene) - collar(scene)), 2), eigenstrain: 1e-4 }),
  "membrane.temperature.table[]": (scene) => nextRow(scene, scene.membrane?.temperature?.table, { rise_k: 0 }),
  "membrane.residual_stress[]": (scene) => nextRow(scene, scene.membrane?.residual_stress, { hoop_pa: 0 }),
  "blade.profile[]": (scene) => nextRow(scene, scene.blade.profile, { thickness_m: scene.blade.thickness_m }),
  "blade.rim": (scene) => ({ mass_per_tooth_kg: round(toothMass(scene), 1) }),
  cut: (scene) => ({
    angle_deg: 0, depth_m: round(0.25 * rim(scene), 2), tangential_n_per_tooth: 100, radial_n_per_tooth: 10, lateral_n_per_tooth: 1,
    speeds: [{ rpm: operating(scene) }],
  }),
  "cut.washboarding": () => ({ stiffness_n_per_m: 20000 }),
  "cut.speeds[]": (scene) => ({ rpm: operating(scene) }),
  runup: (scene) => ({ from_rpm: 0, to_rpm: round(1.5 * operating(scene), 2), duration_s: 60, force_n: sideForce(scene), angle_deg: 0 }),
  probe: () => ({ angle_deg: 90 }),
  sweep: (scene) => ({ from_rpm: 0, to_rpm: round(2 * operating(scene), 2) }),
};

// Single keys, where a part is not among those above.
const KEYS = {
  radius_m: (scene) => between(scene, 0.5), diameter_m: (scene) => round(0.35 * scene.blade.outer_diameter_m, 2),
  operating_rpm: () => 1800, rpm: operating, angle_deg: () => 0, teeth: () => 20, pressure_angle_deg: () => 30,
  contact_stiffness_n_per_m_3_2: () => 7e9, contact_damping_n_s_3_2_per_m_3_2: () => 4700,
  thickness_m: (scene) => scene.blade.thickness_m, rise_k: () => 0,
};

const pattern = (path) => path.replace(/\[\d+\]/g, "[]");

// A whole part, or nothing where it has no beginning of its own.
export const part = (path, scene) => PARTS[pattern(path)]?.(scene);

// A number by its key.
export const number = (key, scene) => KEYS[key]?.(scene);

// A part with values that compute, and what it is a part of.
export function putIn(scene, path) {
  const whole = path.includes(".") ? path.slice(0, path.lastIndexOf(".")) : null;
  if (whole && !get(scene, whole)) putIn(scene, whole);
  put(scene, path, part(path, scene));
}

// Puts a part with its values in, and what else it needs. `path` ends with [] for a part more of a list.
export function put(scene, path, made) {
  if (path.endsWith("[]")) set(scene, path.slice(0, -2), [...(get(scene, path.slice(0, -2)) ?? []), made]);
  else set(scene, path, made);
  NEEDS[pattern(path)]?.(scene);
}

// Why a part cannot be put into this saw; nothing where it can.
export function lacks(path, scene) {
  if (path === "spline" && scene.mount?.kind !== "spline") return "A spline needs the mount of that name.";
  if (["runup", "cut.washboarding"].includes(path) && isFree(scene)) return "This needs a guide or a collar that holds the blade.";
  return "";
}
