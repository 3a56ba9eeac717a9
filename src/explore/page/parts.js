// Parts that are put into the scene: the program gives their values.

import { get } from "./scene.js";
import { part } from "./talk.js";

let underWay = 0;

// Whether a part is on its way.
export const isPuttingIn = () => underWay > 0;

// Puts a part in, and what it needs. `path` ends with [] for another entry of a list; `kind` is that of a mount.
// `before(made)` is called with the new scene just before it takes the place of the other.
export async function putIn(state, path, { kind = "", before = (/** @type {any} */ _) => {} } = {}) {
  underWay += 1;
  try {
    for (;;) {
      const asked = JSON.stringify(state.scene);
      const made = await part({ scene: state.scene, path, kind });
      // A scene that was changed while the program answered gets the part once more.
      if (JSON.stringify(state.scene) !== asked) continue;
      before(made);
      return state.replace(made);
    }
  } finally {
    underWay -= 1;
  }
}

// The value at a path; with [] in it, those of every entry of the list.
function valuesAt(scene, path) {
  const [list, key] = path.split("[].");
  return key === undefined ? [get(scene, path)] : (get(scene, list) ?? []).map((entry) => get(entry, key));
}

const isThere = (value) => (Array.isArray(value) ? value.length > 0 : value !== undefined && value !== null);

// Why a part cannot be put into this scene, or a task cannot be computed for it; nothing where it can.
export function lacks(needs, name, scene) {
  const need = needs.find((one) => one.of === name);
  const has = ({ path, is }) => valuesAt(scene, path).some((value) => (is === null ? isThere(value) : value === is));
  return need && !need.any.some(has) ? need.otherwise : "";
}
