// Opens scenes from files, examples and addresses, and saves files of the scene.

import { download } from "./dom.js";
import { bare, carried, link } from "./link.js";
import { Changed, Refused, measured, read, saved, write } from "./talk.js";

export class Files {
  // JSON of the scene as it was last opened or saved. The present scene has unsaved changes if it differs.
  #onDisk;

  // JSON of the scene in the address, or null.
  #linked = null;
  // Text of the file of the saw, which another program has changed.
  #changed = "";

  #saving = null;
  // `say(text)` shows an error, and `notify(text)` a message that stays. `refusal()` returns why the scene is refused, or an
  // empty text. `onReplaced()` is called before another saw replaces the present one, `onBusy(name)`
  // while the program makes a file, and with null after it, and `onChanged(name)` when another program has changed the
  // file of the saw. `shown()` waits for the identifier of the scene's chart.
  constructor(state, kept, begun, { say, notify, refusal, onReplaced, onBusy, onChanged, shown }) {
    this.state = state;
    this.kept = kept;
    this.begun = begun;
    this.say = say;
    this.notify = notify;
    this.refusal = refusal;
    this.onReplaced = onReplaced;
    this.onBusy = onBusy;
    this.onChanged = onChanged;
    this.shown = shown;
    this.saved(begun.scene);
    state.origin = this.#origin(this.#ofProgram(), begun.scene);
    addEventListener("hashchange", () => this.#paste());
  }

  saved(scene = this.state.scene) {
    this.#onDisk = JSON.stringify(scene);
  }

  get isSaved() {
    return JSON.stringify(this.state.scene) === this.#onDisk;
  }

  // Returns the file that the program was started with as a target for saving, or null.
  #ofProgram() {
    const { file } = this.begun;
    return file && { ...file, write: () => write(this.state.scene) };
  }

  // Returns a local file as a target for saving. The browser asks its user for permission when the page first writes to
  // it.
  #ofBrowser(handle, text) {
    let known = text;
    const put = async () => {
      const found = await handle.getFile().then((file) => file.text());
      if (found !== known) throw new Changed((known = found));
      const stream = await handle.createWritable();
      await stream.write(this.#text());
      await stream.close();
      known = this.#text();
    };
    return { name: handle.name, plain: isPlain(text), write: put };
  }

  // Combines the file that a saw can be saved to, or null, with the scene as the file contains it, and with the name,
  // without extension, of the file that the saw was opened from, or null.
  #origin(target, scene, stem = null) {
    return { target, written: JSON.stringify(scene), stem };
  }

  // Name of the file that the saw can be saved to, and whether the saw differs from it; null if there is no file.
  get target() {
    const { target, written } = this.state.origin;
    return target && { name: target.name, differs: JSON.stringify(this.state.scene) !== written };
  }

  // Saves the saw to the file that it came from. If the file has comments, the user is asked first.
  async write() {
    const { origin } = this.state;
    const { target } = origin;
    if (!target.plain && !confirm(`${target.name} has comments, which are lost when the page saves it. Save it?`)) return;
    const scene = JSON.stringify(this.state.scene);
    try {
      await target.write();
      target.plain = true;
      origin.written = scene;
      if (scene === JSON.stringify(this.state.scene)) this.saved();
      this.say("");
    } catch (error) {
      if (error instanceof Changed) {
        this.#changed = error.text;
        this.onChanged(target.name);
        return;
      }
      const reason = error instanceof DOMException ? error.message : "the program does not answer any more";
      this.say(error instanceof Refused ? error.message : `${target.name} was not saved: ${reason}; “Save a copy” saves the saw elsewhere`);
    }
  }

  // Opens the file of the saw as another program has changed it.
  async load() {
    const { target } = this.state.origin;
    await this.#opening(target.name, async () => {
      this.#open(await read(this.#changed), { stem: this.state.origin.stem, target: { ...target, plain: isPlain(this.#changed) } });
    });
  }

  #text() {
    return `${JSON.stringify(this.state.scene, null, 2)}\n`;
  }

  // Returns the name of a file of this saw, such as "six-pads-campbell.png", or "six-pads.json" for the scene itself.
  nameOf(file) {
    const plain = (this.state.scene.name ?? "").normalize("NFD").replace(/\p{M}/gu, "").toLowerCase();
    const stem = this.state.origin.stem ?? (plain.replace(/[^a-z0-9]+/g, "-").slice(0, 60).replace(/^-|-$/g, "") || "saw");
    return file === "scene.json" ? `${stem}.json` : `${stem}-${file}`;
  }

  // Returns true if all changes are saved, or if the user agrees to replace the saw.
  #mayReplace(name) {
    return this.isSaved || confirm(`Open “${name}” in place of the saw as you have changed it? “Undo” brings that back.`);
  }

  // Keeps a changed scene in the browser, and removes the scene from the address if it is a different one.
  changed(scene) {
    this.kept.keep(scene);
    if (this.#linked !== JSON.stringify(scene)) bare();
  }

  // Replaces the scene by that of another saw, which has no unsaved changes.
  #open(scene, { stem = null, target = null } = {}) {
    this.saved(scene);
    this.notify("");
    this.onReplaced();
    this.state.replace(scene, this.#origin(target, scene, stem));
  }

  choose(example) {
    if (this.#mayReplace(example.name)) this.#open(example);
  }

  async save(name) {
    if (name === "scene.json") {
      // The page writes this file itself, because the server may have ended.
      download(this.nameOf(name), new Blob([this.#text()], { type: "application/json" }));
      this.saved();
      const refusal = this.refusal();
      this.notify(refusal && `${this.nameOf(name)} is saved, but sawflutter will refuse it: ${refusal}`);
      return;
    }
    this.stop();
    const saving = (this.#saving = new AbortController());
    try {
      const chart = await this.shown();
      this.onBusy(name);
      download(this.nameOf(name), await saved(name, this.state.scene, chart, saving.signal));
    } catch (error) {
      if (error.name !== "AbortError") this.say(error.message);
    }
    if (this.#saving === saving) this.onBusy(null);
  }

  stop() {
    this.#saving?.abort();
    this.#saving = null;
  }

  // Opens a scene or a table of measured frequencies. If the file is neither, the scene does not change. With a
  // `handle`, the page can save to the file.
  async open(file, handle = null) {
    await this.#opening(file.name, async () => {
      if (/\.(csv|tsv|txt)$/i.test(file.name)) {
        const points = await measured(file.name, await file.arrayBuffer());
        this.state.change((scene) => (scene.measured = points), { structure: true });
        return;
      }
      const text = await file.text();
      const inner = sceneOfReport(text);
      const scene = await read(inner ?? text);
      if (!this.#mayReplace(file.name)) return;
      if (inner) this.#open(scene);
      else this.#open(scene, { stem: file.name.replace(/\.[^.]*$/, ""), target: handle && this.#ofBrowser(handle, text) });
      if (inner) this.notify(`${file.name} is a report of sawflutter; this is its scene.`);
    });
  }

  async #opening(name, open) {
    await open().catch((error) => this.say(`${name} was not opened, the scene is as it was: ${error.message}`));
  }

  // Writes the scene into the address and copies it to the clipboard. The label of `button` then says where the link
  // is.
  async copyLink(button) {
    const address = await link(this.state.scene);
    if (address === null) {
      this.say("The scene is too long for an address; save it as a file instead.");
      return;
    }
    this.#linked = JSON.stringify(this.state.scene);
    history.replaceState(null, "", address);
    try {
      await navigator.clipboard.writeText(address);
      button.textContent = "Link is copied";
    } catch {
      button.textContent = "Link is in the address bar";
    }
    setTimeout(() => (button.textContent = "Copy link"), 3000);
  }

  // Opens the scene of the address. Without one, restores an edited scene that the browser kept, if any, and shows
  // `note`. Returns whether there was either.
  async restore(note) {
    const linked = await this.#carried();
    const earlier = await this.kept.restored(linked);
    if (linked !== null) {
      this.#openLinked(linked);
      return true;
    }
    if (earlier === null || JSON.stringify(earlier) === JSON.stringify(this.begun.scene)) return false;
    note.hidden = false;
    this.state.replace(earlier);
    return true;
  }

  async #carried() {
    try {
      const text = await carried();
      return text === null ? null : await read(text);
    } catch (error) {
      this.notify(`The link has no scene that can be read: ${error instanceof Refused ? error.message : "it is incomplete; copy the whole link"}`);
      bare();
      return null;
    }
  }

  #openLinked(scene) {
    this.#linked = JSON.stringify(scene);
    this.#open(scene);
  }

  // Opens the scene of an address that the user pasted into the address bar of the open page.
  async #paste() {
    const scene = await this.#carried();
    if (scene === null || JSON.stringify(scene) === JSON.stringify(this.state.scene)) return;
    if (this.#mayReplace(scene.name)) this.#openLinked(scene);
    else bare();
  }

  startOver() {
    this.#open(this.begun.scene, { target: this.#ofProgram() });
  }
}

// Returns the scene of a report as text; null if the text is no report.
function sceneOfReport(text) {
  try {
    const { scene, blade } = JSON.parse(text);
    return scene && !blade ? JSON.stringify(scene) : null;
  } catch {
    return null;
  }
}

// Returns whether a text is JSON without comments.
function isPlain(text) {
  try {
    JSON.parse(text);
    return true;
  } catch {
    return false;
  }
}
