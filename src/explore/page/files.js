// Scenes from files, examples and addresses, and files of the scene.

import { download, node } from "./dom.js";
import { bare, carried, link } from "./link.js";
import { clone } from "./scene.js";
import { measured, read, saved } from "./talk.js";

export class Files {
  // The scene as it was last saved to a file, or as the program was started with.
  #onDisk;

  // The scene that the address carries.
  #linked = null;

  // `say(words)` is for what went wrong, `onReplaced()` for another saw than before.
  constructor(state, kept, begun, { say, onReplaced }) {
    Object.assign(this, { state, kept, begun, say, onReplaced });
    this.saved(begun.scene);
    addEventListener("hashchange", () => this.#paste());
  }

  // The scene is on the disk.
  saved(scene = this.state.scene) {
    this.#onDisk = JSON.stringify(scene);
  }

  get isSaved() {
    return JSON.stringify(this.state.scene) === this.#onDisk;
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
  #open(scene) {
    this.saved(scene);
    this.onReplaced();
    this.replace(clone(scene));
  }

  replace(scene) {
    this.state.change((current) => {
      for (const key of Object.keys(current)) delete current[key];
      Object.assign(current, scene);
    }, { structure: true });
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
      download(name, new Blob([`${JSON.stringify(this.state.scene, null, 2)}\n`], { type: "application/json" }));
      this.saved();
      return;
    }
    try {
      download(name, await saved(name, this.state.scene));
    } catch (error) {
      this.say(error.message);
    }
  }

  // A scene, or a table of measured frequencies. What is neither leaves everything as it is.
  async open(file) {
    try {
      const text = await file.text();
      if (/\.(csv|tsv|txt)$/i.test(file.name)) {
        const points = await measured(file.name, text);
        this.state.change((scene) => (scene.measured = points), { structure: true });
        return;
      }
      const scene = await read(text);
      if (this.#mayReplace(file.name)) this.#open(scene);
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
      button.textContent = "Link copied";
    } catch {
      button.textContent = "Link is in the address bar";
    }
    setTimeout(() => (button.textContent = "Link"), 3000);
  }

  // The scene of the address, or an edited one that this tab goes on with: then `note` is shown.
  async restore(note) {
    const linked = await this.#carried();
    const earlier = await this.kept.restored(linked);
    if (linked !== null) return this.#openLinked(linked);
    if (earlier === null || JSON.stringify(earlier) === JSON.stringify(this.begun.scene)) return undefined;
    note.hidden = false;
    return this.replace(earlier);
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
    this.#open(this.begun.scene);
  }
}
