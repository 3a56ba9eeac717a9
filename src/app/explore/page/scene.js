// The scene that the page changes, with its history for undo and redo.

import { follow } from "./pairs.js";

const STEPS = 200;
// Longest time between two changes of one run.
const RUN_MS = 1500;

export const clone = (value) => structuredClone(value);

// Returns the saw of a scene as text. A scene with another name and other notes has the same results.
export const sawOf = ({ name: _name, notes: _notes, ...saw }) => JSON.stringify(saw);

// Returns the paths of the values in which two scenes differ.
export function differences(before, after, path = "") {
  if (Object(before) !== before || Object(after) !== after) return before === after ? [] : [path];
  const inner = (key) => (Array.isArray(after) ? `${path}[${key}]` : path ? `${path}.${key}` : key);
  return [...new Set([...Object.keys(before), ...Object.keys(after)])].flatMap((key) => differences(before[key], after[key], inner(key)));
}

// "guides[0].radius_m" → ["guides", 0, "radius_m"]
export function steps(path) {
  return [...path.matchAll(/([^.[\]]+)|\[(\d+)\]/g)].map(([, name, index]) => name ?? Number(index));
}

export function get(scene, path) {
  return steps(path).reduce((part, step) => part?.[step], scene);
}

export function set(scene, path, value) {
  const way = steps(path);
  const last = way.pop();
  const place = way.reduce((part, step) => (part[step] ??= {}), scene);
  if (value === undefined) {
    if (Array.isArray(place)) place.splice(last, 1);
    else delete place[last];
  } else {
    place[last] = value;
  }
}

// Calls `listener(scene, { draft, structure, stamp, released })` after every change. `structure` is true if parts may
// have been added or removed, `stamp` is the time of a move, and `released` the time at which a drag ended. A change
// that continues, such as a drag, is a draft. All drafts of a drag are one step of undo, and so are the changes of one
// `run`, such as presses of one key, within RUN_MS.
export class SceneState {
  #past = [];
  #future = [];
  #before = null;
  #pending = null;
  #run = { name: null, at: 0 };
  // Kind of the pairs in which pads are changed, see pairs.js; empty if they are changed one by one.
  pairs = "";
  // Path of the number that was changed last; null after another change.
  changed = null;
  // File that the scene comes from, see files.js. Undo restores it with the scene.
  origin = null;

  constructor(scene, listener) {
    this.scene = clone(scene);
    this.listener = listener;
  }

  change(edit, { path = null, draft = false, structure = false, stamp = undefined, run = null, origin = this.origin } = {}) {
    this.#before ??= { scene: clone(this.scene), origin: this.origin };
    [this.origin, this.changed] = [origin, path];
    const earlier = this.pairs && clone({ guides: this.scene.guides ?? [] });
    edit(this.scene);
    if (earlier) follow(earlier, this.scene, this.pairs);
    this.#pending = run;
    if (!draft) this.#settle();
    this.listener(this.scene, { draft, structure, stamp });
  }

  set(path, value, options) {
    this.change((scene) => set(scene, path, value), { ...options, path });
  }

  // Replaces the scene by another one, in one step of undo.
  replace(scene, origin = this.origin) {
    this.change((current) => {
      for (const key of Object.keys(current)) delete current[key];
      Object.assign(current, clone(scene));
    }, { structure: true, origin });
  }

  // Ends a drag, or a change by a key, at the time `released`.
  settle(released) {
    if (this.#before === null) return;
    this.#settle();
    this.listener(this.scene, { draft: false, structure: false, released });
  }

  // Ends a drag, and restores the scene before it.
  cancel() {
    if (this.#before === null) return;
    ({ scene: this.scene, origin: this.origin } = this.#before);
    [this.#before, this.#pending] = [null, null];
    this.listener(this.scene, { draft: false, structure: true });
  }

  #settle() {
    if (JSON.stringify(this.#before.scene) !== JSON.stringify(this.scene)) {
      const now = performance.now();
      const goesOn = this.#pending !== null && this.#run.name === this.#pending && now - this.#run.at < RUN_MS;
      this.#run = { name: this.#pending, at: now };
      if (!goesOn) this.#past.push(this.#before);
      this.#past.splice(0, this.#past.length - STEPS);
      this.#future = [];
    }
    this.#before = null;
    this.#pending = null;
  }

  // Whether a drag, or a change by a key, has not ended.
  get isMoving() {
    return this.#before !== null;
  }

  get canUndo() {
    return this.#past.length > 0;
  }

  get canRedo() {
    return this.#future.length > 0;
  }

  undo() {
    this.#travel(this.#past, this.#future);
  }

  redo() {
    this.#travel(this.#future, this.#past);
  }

  #travel(from, to) {
    if (from.length === 0) return;
    to.push({ scene: this.scene, origin: this.origin });
    ({ scene: this.scene, origin: this.origin } = from.pop());
    this.#run = { name: null, at: 0 };
    [this.#before, this.changed] = [null, null];
    this.listener(this.scene, { draft: false, structure: true });
  }
}
