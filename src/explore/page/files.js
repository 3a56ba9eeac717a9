// Scenes from files, examples and addresses, and files of the scene.

import { node } from "./dom.js";
import { carried, download, link } from "./kept.js";
import { clone } from "./scene.js";
import { measured, read, saved } from "./talk.js";

export class Files {
  // The scene as it was last saved to a file, or as the program was started with.
  #onDisk;

  // `say(words)` is for what went wrong.
  constructor(state, kept, begun, say) {
    Object.assign(this, { state, kept, begun, say });
    this.saved(begun.scene);
  }

  // The scene is on the disk.
  saved(scene = this.state.scene) {
    this.#onDisk = JSON.stringify(scene);
  }

  get isSaved() {
    return JSON.stringify(this.state.scene) === this.#onDisk;
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
      if (!example) return;
      this.saved(example);
      this.replace(clone(example));
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
      this.saved(scene);
      this.replace(scene);
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
    history.replaceState(null, "", address);
    try {
      await navigator.clipboard.writeText(address);
      button.textContent = "Link copied";
    } catch {
      button.textContent = "Link is in the address bar";
    }
    setTimeout(() => (button.textContent = "Link"), 3000);
  }

  // The scene of the address, or that of an earlier visit with unsaved edits: then `note` is shown.
  async restore(note) {
    try {
      const text = await carried();
      if (text !== null) return this.replace(await read(text));
    } catch (error) {
      this.say(`The scene in the address cannot be read: ${error.message}`);
    }
    const earlier = this.kept.restored();
    if (earlier === null || JSON.stringify(earlier) === JSON.stringify(this.begun.scene)) return undefined;
    note.hidden = false;
    return this.replace(earlier);
  }

  startOver() {
    this.kept.forget();
    this.saved(this.begun.scene);
    this.replace(clone(this.begun.scene));
  }
}
