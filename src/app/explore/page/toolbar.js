// The buttons, menus and keys of the page.

import { by, write } from "./dom.js";
import { useInches } from "./fields.js";

/** @returns {any} */
const first = (selector) => document.querySelector(selector);

const INCHES = "sawflutter inches";

// Returns whether an element contains a text that is not in the scene. The browser's own undo then applies to the text.
function isBeingTyped(element) {
  if (!element.matches("input[type=text], textarea")) return false;
  return !by("fields").contains(element) || element.value !== element.defaultValue;
}

// Closes a menu when an entry is chosen, when the pointer or the focus moves elsewhere, and on Escape. Checkboxes and
// the button that copies the link leave it open.
function menu(place) {
  const close = () => (place.open = false);
  place.addEventListener("click", (event) => event.target.closest("button") && event.target.id !== "link" && close());
  place.addEventListener("change", (event) => event.target.type !== "checkbox" && close());
  place.addEventListener("focusout", (event) => event.relatedTarget && !place.contains(event.relatedTarget) && close());
  addEventListener("pointerdown", (event) => !place.contains(event.target) && close());
  place.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    close();
    place.querySelector("summary").focus();
  });
}

// Connects the buttons to the parts of the page. `select(path)` and `adding(on)` select a part and let the next click add a
// pad, and `endWelcome()` removes the cards of the first visit. Returns `refresh()`, which updates the buttons, and `measure()`, which takes over the unit of the last visit.
export function toolbar({ state, files, kept, pinned, charts, blade, form, tabs, result, select, adding, endWelcome }) {
  function refresh() {
    const name = state.scene.name || "unnamed saw";
    write(by("saw-name"), name);
    document.title = `${name} – sawflutter`;
    const focused = /** @type {any} */ (document.activeElement);
    by("undo").disabled = !state.canUndo;
    by("redo").disabled = !state.canRedo;
    // If the button that was pressed is disabled now, the other one gets the focus.
    if (focused.disabled) [by("undo"), by("redo")].find((button) => !button.disabled)?.focus();
    const source = state.scene.measured?.source;
    by("points").hidden = source === undefined;
    by("source").title = source ?? "";
    const { target } = files;
    by("write").hidden = target === null;
    by("write").textContent = target ? `Save to ${target.name}` : "";
    by("write").title = by("write").textContent;
    by("write").disabled = !target?.differs || !by("conflict").hidden;
    const copy = first("[data-save='scene.json']");
    copy.textContent = target ? "Save a copy" : "Save saw";
    copy.classList.toggle("main", target === null);
    by("pin").disabled = pinned.isFull;
    by("sides").hidden = !pinned.isNamed;
  }

  // Shows lengths in inches or millimetres; the scene does not change.
  function measure(on) {
    by("inches").checked = on;
    useInches(on);
    form.build();
    tabs.refresh();
    if (result.latest) result.compare();
    try {
      localStorage.setItem(INCHES, on ? "1" : "");
    } catch {
      // Without the storage of the browser, the choice lasts until the page is closed.
    }
  }

  // The menu that opened the dialog is closed by then, and could not take the focus.
  by("examples").addEventListener("close", () => first(".menu summary").focus());
  by("fields").addEventListener("focusin", (event) => select(form.partOf(event.target)));
  addEventListener("keydown", (event) => event.key === "Escape" && adding(false));
  const decide = (how) => async () => {
    by("conflict").hidden = true;
    await how();
    refresh();
  };
  const clicks = {
    undo: () => state.undo(),
    redo: () => state.redo(),
    pin: () => {
      pinned.pin(result.latest);
      result.compare();
      refresh();
    },
    gallery: () => by("examples").showModal(),
    add: () => adding(!blade.isAdding),
    link: () => files.copyLink(by("link")),
    all: () => charts.zoom(null),
    over: () => {
      by("restored").hidden = true;
      files.startOver();
    },
    write: decide(() => files.write()),
    overwrite: decide(() => files.write()),
    load: decide(() => files.load()),
    print: () => print(),
    begin: endWelcome,
    dismiss: () => (by("notice").hidden = true),
  };
  for (const [id, then] of Object.entries(clicks)) by(id).addEventListener("click", then);
  by("pairs").addEventListener("change", (event) => (state.pairs = event.target.value));
  by("side").addEventListener("change", () => result.compare());
  by("inches").addEventListener("change", (event) => measure(event.target.checked));
  by("measured").addEventListener("change", (event) => charts.showMeasured(event.target.checked));
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    const [file] = event.dataTransfer.files;
    if (!file) return;
    // The handle is requested at once, because the dropped items are only available during the event.
    const handle = /** @type {any} */ (event.dataTransfer.items[0]).getAsFileSystemHandle?.() ?? Promise.resolve(null);
    handle.catch(() => null).then((found) => files.open(file, found));
  });
  addEventListener("beforeunload", (event) => {
    if (!files.isSaved && !kept.works) event.preventDefault();
  });
  by("open").addEventListener("click", async (event) => {
    if (!("showOpenFilePicker" in globalThis)) return;
    // This dialog, unlike that of the input element, gives a handle by which the page can save to the file.
    event.preventDefault();
    const [handle] = await /** @type {any} */ (globalThis).showOpenFilePicker().catch(() => []);
    if (handle) await files.open(await handle.getFile(), handle);
  });
  by("open").addEventListener("change", async (event) => {
    if (event.target.files[0]) await files.open(event.target.files[0]);
    // An empty value allows the user to choose the same file again.
    event.target.value = "";
  });
  for (const button of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("[data-save]"))) {
    button.addEventListener("click", () => files.save(button.dataset.save));
  }
  addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || isBeingTyped(event.target)) return;
    const undo = event.key === "z" && !event.shiftKey;
    const redo = event.key === "y" || (event.key.toLowerCase() === "z" && event.shiftKey);
    if (undo) state.undo();
    if (redo) state.redo();
    if (undo || redo) event.preventDefault();
  });
  menu(document.querySelector(".menu"));
  return { refresh, measure: () => measure(localStorage.getItem(INCHES) === "1") };
}
