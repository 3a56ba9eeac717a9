// What a part of the scene begins with when it is put in: values that compute, and that a designer
// would start from.

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
  "membrane.residual_stress[]": (scene) => {
    const rows = scene.membrane?.residual_stress ?? [];
    const last = rows.at(-1)?.radius_m ?? collar(scene);
    return { radius_m: rows.length === 0 ? round(collar(scene), 3) : round(0.5 * (last + rim(scene)), 3), hoop_pa: 0 };
  },
  cut: (scene) => ({
    angle_deg: 0, depth_m: round(0.25 * rim(scene), 2), tangential_n_per_tooth: 100, radial_n_per_tooth: 10, lateral_n_per_tooth: 1,
    speeds: [{ rpm: operating(scene) }],
  }),
  "cut.washboarding": () => ({ stiffness_n_per_m: 20000 }),
  "cut.speeds[]": (scene) => ({ rpm: operating(scene) }),
  runup: (scene) => ({ from_rpm: 0, to_rpm: round(1.5 * operating(scene), 2), duration_s: 60, force_n: 5, angle_deg: 0 }),
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
