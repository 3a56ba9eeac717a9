// Adds parts to the scene, with values from the program, and numbers that it reads from texts.

import { get } from "./scene.js";
import { numbers, part } from "./talk.js";

let underWay = 0;

// Returns whether the program is asked for a part or a number that is not in the scene yet.
export const isAsking = () => underWay > 0;

async function asking(work) {
  underWay += 1;
  try {
    return await work();
  } finally {
    underWay -= 1;
  }
}

// Returns the numbers that the texts of a field mean, as the program reads them.
export const read = (path, texts) => asking(() => numbers(path, texts));

// Adds a part to the scene, and other values that it needs. `path` ends with [] for another entry of a list; `kind` is
// the kind of a mount. `before(made)` is called with the new scene just before it replaces the present one.
export async function putIn(state, path, { kind = "", before = (/** @type {any} */ _) => {} } = {}) {
  return asking(async () => {
    for (;;) {
      const asked = JSON.stringify(state.scene);
      const made = await part({ scene: state.scene, path, kind });
      // If the scene was changed while the program answered, the part is requested again for the changed scene.
      if (JSON.stringify(state.scene) !== asked) continue;
      before(made);
      return state.replace(made);
    }
  });
}

// Returns the value at a path or, if the path contains [], the values of all entries of the list.
function valuesAt(scene, path) {
  const [list, key] = path.split("[].");
  return key === undefined ? [get(scene, path)] : (get(scene, list) ?? []).map((entry) => get(entry, key));
}

const isThere = (value) => (Array.isArray(value) ? value.length > 0 : value !== undefined && value !== null);

// Returns why a part cannot be added to this scene, or a task cannot be computed for it; empty if it can.
export function lacks(needs, name, scene) {
  const fits = (value, { is, absent }) => (absent ? !isThere(value) : is === null ? isThere(value) : value === is);
  const has = (condition) => valuesAt(scene, condition.path).some((value) => fits(value, condition));
  const unmet = needs.find((need) => need.of === name && !need.any.some(has));
  return unmet?.otherwise ?? "";
}
