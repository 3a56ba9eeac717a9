// Keeps the edited scene of each tab in the storage of the browser.

const PREFIX = "sawflutter scene ";
const TAB = "sawflutter tab";
// Largest number of kept scenes; the oldest are removed first.
const MOST = 30;
// Longest time that a reloaded tab waits until its earlier page releases the lock of its name, and the interval of
// attempts.
const PATIENCE_MS = 1000;
const STEP_MS = 50;

// A kept scene belongs to a tab and to the scene that the program was started with.
export class Kept {
  // Whether the browser stored the latest scene.
  works = true;
  #tab = null;

  constructor(begun) {
    this.begun = JSON.stringify(begun);
  }

  // Returns the edited scene with which this tab continues, or null: its own from before a reload, or the latest one
  // that no open tab has. If the address has another scene, the tab starts with a new name, so that it overwrites no
  // kept scene.
  async restored(linked) {
    try {
      const all = entries().filter(({ begun }) => begun === this.begun).sort((x, y) => y.at - x.at);
      const own = sessionStorage.getItem(TAB);
      const mine = all.find(({ tab }) => tab === own);
      const isLinked = JSON.stringify(linked) === JSON.stringify(mine?.scene);
      if (linked !== null && !isLinked) return await this.#goesOn(crypto.randomUUID());
      const isFree = mine || !entries().some(({ tab }) => tab === own);
      if (own !== null && isFree && (await held(own, PATIENCE_MS))) return await this.#goesOn(own, mine);
      // A duplicated tab starts with the scene of the original tab, under a new name.
      if (mine) return await this.#goesOn(crypto.randomUUID(), mine);
      for (const entry of all) if (await held(entry.tab)) return await this.#goesOn(entry.tab, entry);
      return await this.#goesOn(crypto.randomUUID());
    } catch {
      this.works = false;
      return null;
    }
  }

  async #goesOn(tab, entry) {
    await held(tab);
    this.#tab = tab;
    sessionStorage.setItem(TAB, tab);
    return entry?.scene ?? null;
  }

  // Keeps the scene of this tab. The scene that the program was started with is not kept, because it has no changes.
  keep(scene) {
    if (this.#tab === null) return;
    try {
      const key = PREFIX + this.#tab;
      if (JSON.stringify(scene) === this.begun) localStorage.removeItem(key);
      else localStorage.setItem(key, JSON.stringify({ begun: this.begun, tab: this.#tab, scene, at: Date.now() }));
      const old = entries().sort((x, y) => x.at - y.at).slice(0, -MOST);
      old.forEach(({ tab }) => localStorage.removeItem(PREFIX + tab));
      this.works = true;
    } catch {
      // The page also works without the storage of the browser.
      this.works = false;
    }
  }
}

function entries() {
  const keys = Object.keys(localStorage).filter((key) => key.startsWith(PREFIX));
  const all = keys.map((key) => {
    try {
      return JSON.parse(localStorage.getItem(key));
    } catch {
      return null;
    }
  });
  return all.filter((entry) => entry?.tab && entry.scene);
}

const names = new Set();

// Locks the name of a tab as long as this page is open. Returns false if another tab has it, after `patience`
// milliseconds.
async function held(tab, patience = 0) {
  if (names.has(tab)) return true;
  const take = () => new Promise((resolve) => {
    navigator.locks.request(`${TAB} ${tab}`, { ifAvailable: true }, (lock) => {
      resolve(lock !== null);
      return lock && new Promise(() => {});
    });
  });
  for (let waited = 0; ; waited += STEP_MS) {
    if (await take()) {
      names.add(tab);
      return true;
    }
    if (waited >= patience) return false;
    await new Promise((resolve) => setTimeout(resolve, STEP_MS));
  }
}
