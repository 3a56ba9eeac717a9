// What is not to be lost: the edits of each tab in the browser's storage.

const PREFIX = "sawflutter scene ";
const TAB = "sawflutter tab";
// Scenes kept at most; the oldest go first.
const MOST = 30;
// A tab that is loaded again waits so long for what it was before to let go of its name.
const PATIENCE_MS = 1000;
const STEP_MS = 50;

// Edits belong to a tab and to the scene that the program was started with.
export class Kept {
  // Whether the browser has kept the latest scene.
  works = true;
  #tab = null;

  constructor(begun) {
    this.begun = JSON.stringify(begun);
  }

  // The edited scene that this tab goes on with: its own of before it was loaded again, or the latest
  // one that no open tab has. Where the address has a scene, others stay as they are kept.
  async restored(linked) {
    try {
      const all = entries().filter(({ begun }) => begun === this.begun).sort((x, y) => y.at - x.at);
      const own = sessionStorage.getItem(TAB);
      const mine = all.find(({ tab }) => tab === own);
      const isLinked = JSON.stringify(linked) === JSON.stringify(mine?.scene);
      if (linked !== null && !isLinked) return await this.#goesOn(crypto.randomUUID());
      const isFree = mine || !entries().some(({ tab }) => tab === own);
      if (own !== null && isFree && (await held(own, PATIENCE_MS))) return await this.#goesOn(own, mine);
      // A tab that was doubled begins with the scene of the other, and keeps its own.
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

  // A scene that was not changed needs not to be kept.
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
      // A browser that keeps nothing still has the page.
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

// Takes the name of a tab for as long as this page is open; false where another tab has it.
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
