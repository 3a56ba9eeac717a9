// Makes a field for every quantity in the schema of scenes, so that the page can set all that the library reads.

import { LOST } from "./backend.js";
import { node } from "./dom.js";
import { fieldOf, unitOf } from "./fields.js";
import { lacks, putIn, read } from "./parts.js";
import { Range } from "./range.js";
import { get } from "./scene.js";
import { Refused } from "./talk.js";
import { partName, shown, tidy } from "./words.js";

// Parts of the saw that can be selected, in the order of their groups.
const PARTS = ["blade", "guides", "mount", "cut"];
// Order of the first quantities; the others follow in the order of the schema. The first one is always shown.
const ORDER = ["operating_rpm", ...PARTS];
// Groups that the chart does not use, or only on request, and the command that uses each.
const ELSEWHERE = { cut: "cut", "cut.washboarding": "washboard", runup: "runup", side_force: "deflect", friction: "gap", spline: "cut" };

// Numbers that influence the speeds of most saws. Their fields reserve a line for the influence before it is computed,
// so that the form does not jump.
const WEIGHED = new RegExp("^(blade[.](thickness_m|profile[[].*thickness_m|rim[.]mass_per_tooth_kg|material[.](youngs_modulus_pa|density_kg_per_m3))"
  + "|guides[[].*[.](radius_m|angle_deg|stiffness_n_per_m)|membrane[.].*(expansion_per_k|rim_rise_k|eigenstrain|groove_depth_m)|membrane[.]roll_tension.*radius_m)$");

export class Form {
  // `say(text)` shows an error that belongs to no field.
  constructor(place, { schema, needs }, state, say) {
    this.search = node("input", { type: "search", id: "search", placeholder: "Find a quantity", ariaLabel: "Find a quantity" });
    this.search.addEventListener("input", () => this.#reveal());
    this.chips = [...PARTS, ""].map((part) => {
      const chip = node("button", { type: "button", value: part, textContent: partName(part) || "All quantities" });
      chip.addEventListener("click", () => {
        this.search.value = "";
        this.#reveal(part);
      });
      return chip;
    });
    this.place = node("div");
    place.append(node("div", { className: "tools parts" }, ...this.chips, this.search), this.place);
    this.schema = schema;
    this.needs = needs;
    this.state = state;
    this.say = say;
    this.fields = new Map();
    this.found = [];
    // Path of the part that was added last; null after its fields are made.
    this.fresh = null;
    // Part whose fields are shown; empty if those of all parts are.
    this.part = PARTS[0];
  }

  // Shows the fields of a part, of all parts, or those that are searched for.
  #reveal(part = this.part) {
    this.part = part;
    const wanted = this.search.value.trim().toLowerCase();
    const isFound = ({ htmlFor, textContent }) => `${htmlFor} ${textContent}`.toLowerCase().includes(wanted);
    for (const chip of this.chips) chip.setAttribute("aria-pressed", String(wanted === "" && chip.value === part));
    for (const field of this.place.querySelectorAll(".field")) field.hidden = !isFound(field.querySelector("label"));
    for (const group of this.place.querySelectorAll("details")) {
      group.hidden = wanted !== "" && !group.querySelector(".field:not([hidden])");
      group.open ||= wanted !== "" || group.dataset.path === part;
    }
    for (const child of this.place.children) {
      const path = child.dataset.path ?? child.querySelector("[id]").id;
      child.hidden ||= wanted === "" && part !== "" && ![part, ORDER[0]].includes(path);
    }
  }

  // Shows the field or the group with this path; all of them if it is empty.
  reveal(path) {
    this.search.value = "";
    this.#reveal(this.part && path.split(/[.[]/)[0]);
    const place = this.fields.get(path)?.element ?? this.place.querySelector(`details[data-path="${path}"]`);
    for (let part = place?.closest("details"); part; part = part.parentElement.closest("details")) part.open = true;
  }

  // Makes all fields anew, after a part of the scene was added or removed. Open groups, focus and selection are kept.
  build() {
    const open = new Set([...this.place.querySelectorAll("details[open]")].map((d) => d.dataset.path));
    const selected = this.place.querySelector("details.selected")?.dataset.path;
    const focused = document.activeElement?.id;
    this.fields.clear();
    const parts = this.#object(this.schema, "", this.state.scene);
    this.place.replaceChildren(...parts);
    for (const part of this.place.querySelectorAll("details")) {
      part.open = part.dataset.path === this.fresh || open.has(part.dataset.path) || /^guides\[\d+\]$/.test(part.dataset.path);
    }
    this.#reveal();
    this.fresh = null;
    if (focused) this.#focus(focused);
    this.influence(this.found);
    if (selected) this.select(selected);
  }

  // Returns the focus to the element with this id. If its entry of a list was removed, the button that adds an entry
  // gets the focus.
  #focus(id) {
    const list = `${id.replace(/\[\d+\][^[]*$/, "")}:add`;
    (document.getElementById(id) ?? document.getElementById(list))?.focus({ preventScroll: true });
  }

  // Shows the values of the scene. During a drag, only the fields whose values changed are updated.
  refresh(draft = false) {
    for (const field of this.fields.values()) {
      const value = get(this.state.scene, field.path);
      if (draft && field.value === value) continue;
      field.value = value;
      field.show(value);
    }
  }

  // Returns the path of the pad, cut or probe that an element of the form belongs to, or null.
  partOf(element) {
    const paths = ["cut", "probe"];
    const part = element.closest("details[data-path^='guides['], details[data-path='cut'], details[data-path='probe']");
    const path = part?.dataset.path;
    return path && (paths.includes(path) || /^guides\[\d+\]$/.test(path)) ? path : null;
  }

  // Opens and marks the fields of a pad, the cut or the probe; unmarks all if `path` is null.
  select(path) {
    for (const part of this.place.querySelectorAll("details.selected")) part.classList.remove("selected");
    if (!path) return;
    this.reveal(path);
    this.place.querySelector(`details[data-path="${path}"]`)?.classList.add("selected");
  }

  // Shows beside each number how it influences the speeds.
  influence(found) {
    this.found = found;
    const by = new Map(found.map((one) => [one.path, one]));
    for (const { path, element } of this.fields.values()) {
      const place = element.querySelector(".influence");
      if (!place) continue;
      const one = by.get(path);
      place.hidden = !one?.words && !WEIGHED.test(path);
      place.querySelector(".words").textContent = one?.words ?? "";
      place.querySelector(".bar").style.width = `${Math.round(100 * (one?.share ?? 0))}%`;
    }
  }

  // Returns the text of a refusal, in the unit of its field if the form has one.
  inWords({ key, message, told }) {
    return (this.fields.has(key) && told) || message;
  }

  // Shows a refusal at its field, and at that of the number that was changed last, and removes earlier ones. Returns whether
  // the form has one of these fields.
  refuse(refusal) {
    const causes = refusal instanceof Refused ? [refusal.key, this.state.changed] : [];
    let told = false;
    for (const field of this.fields.values()) {
      const own = causes.includes(field.path);
      if (!field.isUnread) field.error(own ? this.inWords(refusal) : "");
      if (own && !told) this.reveal(field.path);
      told ||= own;
    }
    return told;
  }

  #resolve(schema) {
    let found = schema;
    while (found?.$ref) {
      const { $ref, ...own } = found;
      const target = $ref.slice(2).split("/").reduce((part, step) => part?.[step], this.schema);
      found = { ...target, ...own };
    }
    const choices = found?.anyOf ?? [];
    const some = choices.filter((choice) => choice.type !== "null");
    if (choices.length > some.length && some.length === 1) {
      return { ...this.#resolve(some[0]), description: found.description, optional: true };
    }
    if (Array.isArray(found?.type) && found.type.includes("null")) {
      return { ...found, type: found.type.find((type) => type !== "null"), optional: true };
    }
    return found ?? {};
  }

  #object(schema, path, value) {
    const required = schema.required ?? [];
    const place = (/** @type {[string, any]} */ [key]) => (path === "" && ORDER.includes(key) ? ORDER.indexOf(key) : ORDER.length);
    const entries = Object.entries(schema.properties ?? {}).sort((x, y) => place(x) - place(y));
    return entries.flatMap(([key, raw]) => {
      const at = path ? `${path}.${key}` : key;
      const inner = this.#resolve(raw);
      return this.#part(inner, at, key, value?.[key], required.includes(key));
    });
  }

  #part(schema, path, key, value, required) {
    if (["measured", "kind", "$schema"].includes(key)) return [];
    if (schema.oneOf && schema.oneOf.every((choice) => choice.properties?.kind)) return [this.#variants(schema, path, value)];
    if (schema.enum || schema.oneOf) return [this.#choice(schema, path, key)];
    if (schema.type === "object" || schema.properties) return [this.#group(schema, path, key, value, required)];
    if (schema.type === "array") return [this.#list(schema, path, key, value)];
    if (schema.type === "number" || schema.type === "integer") return [this.#number(schema, path, key, value, required)];
    if (schema.type === "string") return [this.#text(schema, path, key)];
    return [];
  }

  #details(path, title, description, ...children) {
    const elsewhere = path === "cut" ? "In this chart only where chart_rpm is given" : "Not in this chart";
    const remark = ELSEWHERE[path] ? ` ${elsewhere}: see “sawflutter ${ELSEWHERE[path]}”.` : "";
    const details = node("details", {}, node("summary", { textContent: title, title: (description ?? "") + remark }));
    details.dataset.path = path;
    if (remark) details.append(node("p", { className: "remark", textContent: remark.trim() }));
    details.append(...children);
    return details;
  }

  #group(schema, path, key, value, required) {
    const title = partName(key);
    const there = value !== undefined && value !== null;
    const children = there ? this.#object(schema, path, value) : [];
    const lacking = there ? "" : lacks(this.needs, path, this.state.scene);
    if (lacking) children.push(node("p", { className: "remark", textContent: lacking }));
    else if (!required) children.push(this.#switch(path, title, there));
    return this.#details(path, there ? title : `${title} (none)`, schema.description, ...children);
  }

  #switch(path, title, there) {
    const textContent = there ? `Take ${title} out` : `Put ${title} in`;
    // The button has an equal id when the part is added and when it is removed, so that it keeps the focus.
    const button = node("button", { type: "button", id: `${path}:switch`, textContent });
    button.addEventListener("click", () => (there ? this.state.set(path, undefined, { structure: true }) : this.#putIn(path, path)));
    return button;
  }

  // Adds a part to the scene and opens the group with the path `fresh`.
  async #putIn(path, fresh, kind = "") {
    try {
      await putIn(this.state, path, { kind, before: () => (this.fresh = fresh) });
    } catch (error) {
      this.build();
      this.say(this.inWords(error));
    }
  }

  #list(schema, path, key, value) {
    const items = this.#resolve(schema.items);
    if (items.type === "string") return this.#lines(path, key);
    if (items.type === "number") return this.#numbers(schema, path);
    const title = partName(key);
    const one = title.replace(/(?<!s)s$/, "");
    const parts = (value ?? []).map((item, i) => {
      const at = `${path}[${i}]`;
      const out = this.#switch(at, `${one} ${i + 1}`, true);
      return this.#details(at, `${one} ${i + 1}`, items.description, ...this.#object(items, at, item), out);
    });
    const add = node("button", { type: "button", id: `${path}:add`, textContent: `Add a ${one}` });
    add.addEventListener("click", () => this.#putIn(`${path}[]`, `${path}[${parts.length}]`));
    return this.#details(path, `${title} (${parts.length})`, schema.description, ...parts, add);
  }

  #variants(schema, path, value) {
    const kinds = schema.oneOf.map((choice) => choice.properties.kind.const ?? choice.properties.kind.enum[0]);
    const chosen = schema.oneOf[kinds.indexOf(value?.kind)];
    const select = node("select", { id: `${path}.kind` }, ...kinds.map((kind) => node("option", { value: kind, textContent: kind })));
    select.value = value?.kind;
    select.addEventListener("change", () => this.#putIn(path, path, select.value));
    const label = node("label", { htmlFor: select.id, textContent: "kind" });
    const row = node("div", { className: "field" }, label, select);
    return this.#details(path, path, schema.description, row, ...(chosen ? this.#object(chosen, path, value) : []));
  }

  #register(path, element, show) {
    const fault = node("p", { className: "fault", role: "alert", id: `${path}:fault` });
    element.append(fault);
    const control = element.querySelector("input, select, textarea");
    control.setAttribute("aria-describedby", fault.id);
    const error = (message) => {
      if (fault.textContent !== message) fault.textContent = message;
      if (message) control.setAttribute("aria-invalid", "true");
      else control.removeAttribute("aria-invalid");
    };
    const field = { path, element, error, isUnread: false, show: shows };
    function shows(value) {
      show(value);
      if (field.isUnread) error("");
      field.isUnread = false;
      // The default value is the text of the scene. A control whose text differs is being typed in.
      if (!control.matches("select")) control.defaultValue = control.value;
    }
    this.fields.set(path, field);
    shows(get(this.state.scene, path));
    return element;
  }

  // Passes the numbers that the texts of a field mean to `take`. A text that the program does not read stays in its field
  // with the reason, and the scene does not change.
  async #read(path, texts, take) {
    try {
      take(await read(path, texts));
    } catch (error) {
      const field = this.fields.get(path);
      field.isUnread = true;
      field.error(error instanceof Refused ? this.inWords(error) : LOST);
    }
  }

  // Reads texts again that were typed while the program did not answer.
  readAgain() {
    const unread = [...this.fields.values()].filter(({ isUnread }) => isUnread);
    for (const { element } of unread) element.querySelector("input").dispatchEvent(new Event("change"));
  }

  #choice(schema, path, key) {
    const values = schema.enum ?? schema.oneOf.flatMap((choice) => choice.const ?? choice.enum);
    const select = node("select", { id: path }, ...values.map((value) => node("option", { value, textContent: value })));
    select.addEventListener("change", () => {
      // A pad that lifts off needs a gap, for which the program has a usual one.
      if (select.value === "one_sided") this.#putIn(path.replace(/contact$/, "gap_m"), null);
      else this.state.set(path, select.value);
    });
    const row = node("div", { className: "field", title: schema.description ?? "" },
      node("label", { htmlFor: path, textContent: key.replaceAll("_", " ") }), select);
    return this.#register(path, row, (value) => (select.value = value ?? schema.default ?? values[0]));
  }

  #text(schema, path, key) {
    const input = node("input", { id: path, type: "text" });
    input.addEventListener("change", () => this.state.set(path, input.value));
    const row = node("div", { className: "field wide", title: schema.description ?? "" }, node("label", { htmlFor: path, textContent: key }), input);
    return this.#register(path, row, (value) => isWritten(input) && (input.value = value ?? ""));
  }

  #lines(path, key) {
    const area = node("textarea", { id: path, rows: 4 });
    area.addEventListener("change", () => {
      const lines = area.value.split("\n").filter((line) => line.trim() !== "");
      this.state.set(path, lines.length > 0 ? lines : undefined);
    });
    const row = node("div", { className: "field wide" }, node("label", { htmlFor: path, textContent: key }), area);
    const shows = (value) => isWritten(area) && (area.value = (value ?? []).join("\n"));
    return this.#details(`${path}:lines`, key, "", this.#register(path, row, shows));
  }

  // Makes a field for a list of numbers, which are shown with commas between them.
  #numbers(schema, path) {
    const { unit, scale, name } = unitOf(path);
    const input = node("input", { id: path, type: "text", placeholder: "none" });
    input.addEventListener("change", () => {
      const texts = input.value.split(/[,;\s]+/).filter((text) => text !== "");
      this.#read(path, texts, (numbers) => this.state.set(path, numbers.length > 0 ? numbers : undefined));
    });
    const label = node("label", { htmlFor: path }, name, " ", node("span", { className: "unit", textContent: unit }));
    const row = node("div", { className: "field wide", title: schema.description ?? "" }, label, input);
    const shows = (value) => isWritten(input) && (input.value = (value ?? []).map((number) => shown(number * scale)).join(", "));
    return this.#register(path, row, shows);
  }

  #number(schema, path, key, value, required) {
    const { unit, scale, name, digits } = unitOf(path);
    const whole = schema.type === "integer";
    const field = fieldOf(path);
    const fallback = schema.default ?? undefined;
    const input = node("input", { id: path, type: "text", autocomplete: "off" });
    const typical = schema.examples?.[0];
    const none = typeof typical === "number" ? `none, typically ${shown(typical * scale)}` : "none";
    if (!required) input.placeholder = typeof fallback === "number" ? shown(fallback * scale) : none;
    const slider = node("input", { type: "range", min: 0, max: Range.NOTCHES, step: 1 });
    const fullName = inWords(path, name);
    input.setAttribute("aria-label", unit ? `${fullName}, ${unit}` : fullName);
    slider.setAttribute("aria-label", `${fullName}, slider`);
    const range = new Range(field, value ?? fallback, this.state.scene);
    const send = (number, options) => this.state.set(path, number, options);
    input.addEventListener("change", () => {
      if (input.value.trim() === "" && !required) send(undefined);
      else this.#read(path, [input.value], ([number]) => send(number));
    });
    const slid = () => tidy(whole ? Math.round(range.value(slider.value)) : Number(range.value(slider.value).toPrecision(4)));
    slider.addEventListener("input", (event) => send(slid(), { draft: true, stamp: event.timeStamp, run: path }));
    slider.addEventListener("change", (event) => this.state.settle(event.timeStamp));
    const label = node("label", { htmlFor: path }, name, " ", node("span", { className: "unit", textContent: unit }));
    const bar = node("span", { className: "track", ariaHidden: "true" }, node("span", { className: "bar" }));
    const influence = node("p", { className: "influence", hidden: !WEIGHED.test(path) }, node("span", { className: "words" }), bar);
    const row = node("div", { className: "field number", title: schema.description ?? "" }, label, input, slider, influence);
    return this.#register(path, row, (number) => {
      const known = number ?? fallback;
      const typed = number === undefined || number === null ? "" : typeof number === "number" ? shown(tidy(number * scale), digits) : number;
      if (document.activeElement !== input || !row.contains(document.activeElement)) input.value = typed;
      else if (Number(input.value) !== Number(typed)) input.value = typed;
      slider.disabled = typeof number !== "number";
      if (typeof known === "number") {
        slider.value = range.notch(known);
        slider.setAttribute("aria-valuetext", `${shown(known * scale)} ${unit}`);
      }
    });
  }
}

// Returns whether a field may be overwritten, because nothing is being typed in it.
const isWritten = (field) => document.activeElement !== field || field.value === field.defaultValue;

// Returns the accessible name of a field, such as "guides 1: radius" for "guides[0].radius_m". Each field has a
// different one.
function inWords(path, name) {
  const parts = path.split(".").slice(0, -1);
  const words = parts.map((part) => part.replace(/\[(\d+)\]/g, (_, index) => ` ${Number(index) + 1}`).replaceAll("_", " "));
  return [...words, name].join(": ");
}
