// Fields of the form: a control with its label and the reason why its text is refused. Each is made once and shows the
// values that the scene takes in one unit.

import { LOST } from "./backend.js";
import { node, write } from "./dom.js";
import { fieldOf, unitOf } from "./fields.js";
import { read } from "./parts.js";
import { Range } from "./range.js";
import { get } from "./scene.js";
import { Refused } from "./talk.js";
import { shown, tidy } from "./words.js";

// Numbers that influence the speeds of most saws. Their fields reserve a line for the influence before it is computed,
// so that the form does not jump.
const WEIGHED = new RegExp("^(blade[.](thickness_m|profile[[].*thickness_m|rim[.]mass_per_tooth_kg|material[.](youngs_modulus_pa|density_kg_per_m3))"
  + "|guides[[].*[.](radius_m|angle_deg|stiffness_n_per_m)|membrane[.].*(expansion_per_k|rim_rise_k|eigenstrain|groove_depth_m)|membrane[.]roll_tension.*radius_m)$");

class Field {
  // Whether the program has not read its text, which is therefore not in the scene.
  isUnread = false;
  #put;

  // `put(value)` shows a value of the scene, `renew()` takes a range about the present value, `weigh(influence)` shows how
  // the number influences the speeds, and `entry` is the path of the number that a text means.
  constructor(path, control, { name, className = "", title = "", more = [], put, entry = path, renew = () => {}, weigh = (_) => {} }) {
    this.path = path;
    this.entry = entry;
    this.control = control;
    this.fault = node("p", { className: "fault", role: "alert", id: `${path}:fault` });
    control.setAttribute("aria-describedby", this.fault.id);
    // A refusal is of the text that was there.
    control.addEventListener("input", () => this.refuse(""));
    this.element = node("div", { className: `field ${className}`, title }, node("label", { htmlFor: path }, ...[name].flat()), control, ...more, this.fault);
    this.renew = renew;
    this.weigh = weigh;
    this.#put = put;
  }

  show(value) {
    this.value = value;
    this.#put(value);
    if (this.isUnread) this.refuse("");
    this.isUnread = false;
    // The default value is the text of the scene. A control whose text differs is being typed in.
    if (!this.control.matches("select")) this.control.defaultValue = this.control.value;
  }

  // Shows why the value is refused; nothing if the reason is empty.
  refuse(reason) {
    write(this.fault, reason);
    if (reason) this.control.setAttribute("aria-invalid", "true");
    else this.control.removeAttribute("aria-invalid");
  }

  // Passes the numbers that texts mean to `take`. A text that the program does not read stays in its field with the
  // reason, and the scene does not change.
  async read(texts, take) {
    try {
      take(await read(this.entry, texts));
    } catch (error) {
      this.isUnread = true;
      this.refuse(error instanceof Refused ? error.told ?? error.message : LOST);
    }
  }
}

// A field for one of several words. `choose(value)` is called with the choice.
export function choice(path, name, values, { description: title = "", default: usual = values[0] }, choose) {
  const select = node("select", { id: path, onchange: () => choose(select.value) }, ...values.map((value) => node("option", { value, textContent: value })));
  return new Field(path, select, { name, title, put: (value) => (select.value = value ?? usual) });
}

// A field for a text. `send(text)` is called with what is typed, and `words(value)` returns the text of a value.
function typed(path, control, name, title, words, send, own = {}) {
  const put = (value) => {
    if (document.activeElement !== control || control.value === control.defaultValue) control.value = words(value);
  };
  control.onchange = () => send(control.value);
  return new Field(path, control, { name, title, className: "wide", put, ...own });
}

export function line(path, name, { description }, state) {
  return typed(path, node("input", { id: path, type: "text" }), name, description, (value) => value ?? "", (text) => state.set(path, text));
}

const withUnit = (name, unit) => [name, " ", node("span", { className: "unit", textContent: unit })];
const setList = (state, path, list) => state.set(path, list.length > 0 ? list : undefined);

export function lines(path, name, state) {
  const send = (text) => setList(state, path, text.split("\n").filter((one) => one.trim() !== ""));
  return typed(path, node("textarea", { id: path, rows: 4 }), name, "", (value) => (value ?? []).join("\n"), send);
}

// A field for a list of numbers, which are shown with commas between them.
export function numbers(path, { description }, state) {
  const { unit, scale, name } = unitOf(path);
  const words = (value) => (value ?? []).map((number) => shown(number * scale)).join(", ");
  const send = (text) => made.read(text.split(/[,;\s]+/).filter((one) => one !== ""), (list) => setList(state, path, list));
  const control = node("input", { id: path, type: "text", placeholder: "none" });
  const made = typed(path, control, withUnit(name, unit), description, words, send, { className: "list", entry: `${path}[]` });
  return made;
}

// A field for a number, with a slider and the influence of the number on the speeds.
export function quantity(path, schema, state, isRequired) {
  const { unit, scale, digits, name } = unitOf(path);
  const usual = schema.default ?? undefined;
  const fullName = inWords(path, name);
  let range;
  const send = (number, options) => state.set(path, number, options);
  const type = () => {
    if (input.value.trim() === "" && !isRequired) send(undefined);
    else made.read([input.value], ([number]) => send(number));
  };
  const slide = ({ timeStamp: stamp }) => {
    const value = range.value(slider.value);
    send(tidy(schema.type === "integer" ? Math.round(value) : Number(value.toPrecision(4))), { draft: true, stamp, run: path });
  };
  const typical = schema.examples?.[0];
  const none = typeof typical === "number" ? `none, typically ${shown(typical * scale)}` : "none";
  const placeholder = isRequired ? "" : typeof usual === "number" ? shown(usual * scale) : none;
  const input = node("input", { id: path, type: "text", autocomplete: "off", placeholder, "aria-label": unit ? `${fullName}, ${unit}` : fullName, onchange: type });
  const slider = node("input", {
    type: "range", min: 0, max: Range.NOTCHES, step: 1, "aria-label": `${fullName}, slider`, oninput: slide, onchange: (event) => state.settle(event.timeStamp),
  });
  const words = node("span", { className: "words" });
  const bar = node("span", { className: "bar" });
  const influence = node("p", { className: "influence", hidden: !WEIGHED.test(path) }, words, node("span", { className: "track", "aria-hidden": "true" }, bar));
  const renew = () => (range = new Range(fieldOf(path), get(state.scene, path) ?? usual, state.scene));
  const put = (value) => {
    const text = typeof value === "number" ? shown(tidy(value * scale), digits) : value ?? "";
    if (document.activeElement !== input || Number(input.value) !== Number(text)) input.value = text;
    slider.disabled = typeof value !== "number";
    const known = value ?? usual;
    if (typeof known !== "number") return;
    slider.value = range.notch(known);
    slider.setAttribute("aria-valuetext", `${shown(known * scale)} ${unit}`);
  };
  const weigh = (found) => {
    influence.hidden = !found?.words && !WEIGHED.test(path);
    words.textContent = found?.words ?? "";
    bar.style.width = `${Math.round(100 * (found?.share ?? 0))}%`;
  };
  const made = new Field(path, input, { name: withUnit(name, unit), className: "number", title: schema.description, more: [slider, influence], put, renew, weigh });
  return made;
}

// Returns the accessible name of a field, such as "guides 1: radius" for "guides[0].radius_m". Each field has a
// different one.
function inWords(path, name) {
  const parts = path.split(".").slice(0, -1);
  const words = parts.map((part) => part.replace(/\[(\d+)\]/g, (_, index) => ` ${Number(index) + 1}`).replaceAll("_", " "));
  return [...words, name].join(": ");
}
