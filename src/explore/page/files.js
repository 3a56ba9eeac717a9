// Scenes from files, examples and addresses, and files of the scene.

import { download, node } from "./dom.js";
import { bare, carried, link } from "./link.js";
import { Refused, measured, read, saved, write } from "./talk.js";

export class Files {
  // The scene as it was last saved to a file, or as the program was started with.
  #onDisk;

  // The scene that the address carries.
  #linked = null;
  // Name of the file that the scene was opened from, without its ending.
  #stem = null;

  #saving = null;
  // `say(words)` is for what went wrong, `onReplaced()` for another saw than before, `onBusy(what)` for
  // a file that is made; `shown()` waits for the name of the scene's chart.
  constructor(state, kept, begun, { say, onReplaced, onBusy, shown }) {
    this.state = state;
    this.kept = kept;
    this.begun = begun;
    this.say = say;
    this.onReplaced = onReplaced;
    this.onBusy = onBusy;
    this.shown = shown;
    this.saved(begun.scene);
    state.origin = this.#origin(this.#ofProgram(), begun.scene);
    addEventListener("hashchange", () => this.#paste());
  }

  // The scene is on the disk.
  saved(scene = this.state.scene) {
    this.#onDisk = JSON.stringify(scene);
  }

  get isSaved() {
    return JSON.stringify(this.state.scene) === this.#onDisk;
  }

  // The file that the program was started with.
  #ofProgram() {
    const { file } = this.begun;
    return file && { ...file, write: () => write(this.state.scene) };
  }

  // A file of this computer that the browser lets the page write to, once its user agrees.
  #ofBrowser(handle, text) {
    const put = async () => {
      const stream = await handle.createWritable();
      await stream.write(this.#text());
      await stream.close();
    };
    return { name: handle.name, plain: isPlain(text), write: put };
  }

  // The file that a saw came from and can be saved to, if any, and the saw as it is there.
  #origin(target, scene) {
    return { target, written: JSON.stringify(scene) };
  }

  // The file that the saw can be saved to, and whether the saw differs from it; nothing without one.
  get target() {
    const { target, written } = this.state.origin;
    return target && { name: target.name, differs: JSON.stringify(this.state.scene) !== written };
  }

  // Saves the saw to the file that it came from.
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
      const elsewhere = "“Save a copy” saves the saw elsewhere";
      const reason = error instanceof Refused ? error.message
        : error instanceof DOMException ? `${target.name} was not saved: ${error.message}; ${elsewhere}`
        : `${target.name} was not saved: the program does not answer any more; ${elsewhere}`;
      this.say(reason);
    }
  }

  #text() {
    return `${JSON.stringify(this.state.scene, null, 2)}\n`;
  }

  // A file of this saw: "six-pads-campbell.png", and "six-pads.json" of the scene itself.
  nameOf(file) {
    const plain = (this.state.scene.name ?? "").normalize("NFD").replace(/\p{M}/gu, "").toLowerCase();
    const stem = this.#stem ?? (plain.replace(/[^a-z0-9]+/g, "-").slice(0, 60).replace(/^-|-$/g, "") || "saw");
    return file === "scene.json" ? `${stem}.json` : `${stem}-${file}`;
  }

  // Whether another saw may take the place of this one.
  #mayReplace(name) {
    return this.isSaved || confirm(`Open “${name}” in place of the saw as you have changed it? “Undo” brings that back.`);
  }

  // Of the scene as it is now; what was linked before is another one.
  changed(scene) {
    this.kept.keep(scene);
    if (this.#linked !== JSON.stringify(scene)) bare();
  }

  // Another saw in place of this one.
  #open(scene, { stem = null, target = null } = {}) {
    this.#stem = stem;
    this.saved(scene);
    this.onReplaced();
    this.state.replace(scene, this.#origin(target, scene));
  }

  offerExamples(list) {
    const { examples } = this.begun;
    list.append(...examples.map(({ name }, k) => node("option", { value: k, textContent: name })));
    list.addEventListener("change", () => {
      const example = examples[Number(list.value)];
      list.value = "";
      if (example && this.#mayReplace(example.name)) this.#open(example);
    });
  }

  async save(name) {
    if (name === "scene.json") {
      // Without the server: it may have ended.
      download(this.nameOf(name), new Blob([this.#text()], { type: "application/json" }));
      this.saved();
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

  // No file is made any more.
  stop() {
    this.#saving?.abort();
    this.#saving = null;
  }

  // A scene, or a table of measured frequencies. What is neither leaves everything as it is. With a `handle` the page
  // can save to the file.
  async open(file, handle = null) {
    try {
      const text = await file.text();
      if (/\.(csv|tsv|txt)$/i.test(file.name)) {
        const points = await measured(file.name, text);
        this.state.change((scene) => (scene.measured = points), { structure: true });
        return;
      }
      const scene = await read(text);
      if (this.#mayReplace(file.name)) this.#open(scene, { stem: file.name.replace(/\.[^.]*$/, ""), target: handle && this.#ofBrowser(handle, text) });
    } catch (error) {
      this.say(`${file.name} was not opened, the scene is as it was: ${error.message}`);
    }
  }

  // Puts the address with the scene in it where it can be pasted from; `button` says where.
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

  // The scene of the address, or an edited one that this tab goes on with: then `note` is shown.
  async restore(note) {
    const linked = await this.#carried();
    const earlier = await this.kept.restored(linked);
    if (linked !== null) return this.#openLinked(linked);
    if (earlier === null || JSON.stringify(earlier) === JSON.stringify(this.begun.scene)) return undefined;
    note.hidden = false;
    return this.state.replace(earlier);
  }

  async #carried() {
    try {
      const text = await carried();
      return text === null ? null : await read(text);
    } catch (error) {
      this.say(`The scene in the address cannot be read: ${error.message}`);
      bare();
      return null;
    }
  }

  #openLinked(scene) {
    this.#linked = JSON.stringify(scene);
    this.#open(scene);
  }

  // An address with a scene that was pasted over that of the page.
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

// Whether a text is JSON without comments.
function isPlain(text) {
  try {
    JSON.parse(text);
    return true;
  } catch {
    return false;
  }
}
