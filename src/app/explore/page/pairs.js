// Pads that are changed in pairs: a change of a pad is applied to its image too.

const IMAGES = { mirrored: (angle) => 180 - angle, opposed: (angle) => angle + 180 };
// A pad is the partner of another one if its radius and angle differ by less than this from those of the image.
const NEAR_M = 5e-4;
const NEAR_DEG = 0.5;

// Maps an angle to between −180° and 180°, rounded to 0.1°.
export const turned = (angle) => Math.round(10 * (((((angle + 180) % 360) + 360) % 360) - 180)) / 10;

// Returns the image of a pad, or null if pads are changed one by one.
export function imageOf(pad, kind) {
  return IMAGES[kind] ? { ...pad, angle_deg: turned(IMAGES[kind](pad.angle_deg)) } : null;
}

// Returns the index of the pad that is the image of the one at `index`, or −1.
function partnerOf(guides, index, kind) {
  const image = imageOf(guides[index], kind);
  return image === null ? -1 : guides.findIndex((pad, i) => i !== index
    && Math.abs(pad.radius_m - image.radius_m) < NEAR_M && Math.abs(turned(pad.angle_deg - image.angle_deg)) < NEAR_DEG);
}

// Finds the pad that differs from `before` and applies its change to its partner.
export function follow(before, scene, kind) {
  const [old, guides] = [before.guides ?? [], scene.guides ?? []];
  if (old.length !== guides.length) return;
  const index = guides.findIndex((pad, i) => JSON.stringify(pad) !== JSON.stringify(old[i]));
  const partner = index < 0 ? -1 : partnerOf(old, index, kind);
  if (partner < 0) return;
  const image = imageOf(guides[index], kind);
  for (const key of new Set([...Object.keys(old[index]), ...Object.keys(guides[index])])) {
    if (old[index][key] === guides[index][key] || Number.isNaN(image[key])) continue;
    if (image[key] === undefined) delete guides[partner][key];
    else guides[partner][key] = image[key];
  }
}
