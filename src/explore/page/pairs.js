// Pads that are changed in pairs: the image of a pad follows it.

const IMAGES = { mirrored: (angle) => 180 - angle, opposed: (angle) => angle + 180 };
// A pad this close to an image is the partner.
const NEAR_M = 5e-4;
const NEAR_DEG = 0.5;

// Between −180° and 180°, in tenths.
const turned = (angle) => Math.round(10 * (((((angle + 180) % 360) + 360) % 360) - 180)) / 10;

// The image of a pad; nothing where pads are changed one by one.
export function imageOf(pad, kind) {
  return IMAGES[kind] ? { ...pad, angle_deg: turned(IMAGES[kind](pad.angle_deg)) } : null;
}

// The number of the pad that is the image of another one, or −1.
export function partnerOf(guides, index, kind) {
  const image = imageOf(guides[index], kind);
  return image === null ? -1 : guides.findIndex((pad, i) => i !== index
    && Math.abs(pad.radius_m - image.radius_m) < NEAR_M && Math.abs(turned(pad.angle_deg - image.angle_deg)) < NEAR_DEG);
}

// Changes the partner of the pad that differs from `before` in the same way.
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
