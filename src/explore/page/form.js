// A field for every quantity of a scene, made from its schema: what the library can read, the
// page can set.

import { get } from "./scene.js";
import { shown, tidy, unitOf } from "./words.js";

// A slider has this many steps.
const NOTCHES = 400;
// Where a quantity begins that is new in the scene and has no default; by its key.
const BEGINNINGS = {
  radius_m: 0.2, angle_deg: 0, radial_length_m: 0.1, tangential_length_m: 0.1, stiffness_n_per_m: 1e7,
  diameter_m: 0.25, to_rpm: 3000, duration_s: 60, force_n: 5, rpm: 1800, teeth: 20, pressure_angle_deg: 30,
  contact_stiffness_n_per_m_3_2: 7e9, contact_damping_n_s_3_2_per_m_3_2: 4700, operating_rpm: 1800,
};
// Parts that this chart does not depend on, and the command that looks at them.
const ELSEWHERE = { cut: "cut", runup: "runup", spline: "cut" };

function node(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

export class Form {
  constructor(place, schema, state) {
    Object.assign(this, { place, schema, state });
    this.fields = new Map();
  }

  // Makes the fields anew, where the scene has got or lost a part.
  build() {
    const open = new Set([...this.place.querySelectorAll("details[open]")].map((d) => d.dataset.path));
    const first = this.place.childElementCount === 0;
    const focused = document.activeElement?.id;
    this.fields.clear();
    const parts = this.#object(this.schema, "", this.state.scene);
    this.place.replaceChildren(...parts);
    for (const part of this.place.querySelectorAll("details")) {
      part.open = first ? /^(blade|guides)/.test(part.dataset.path) && !part.dataset.path.endsWith("material") : open.has(part.dataset.path);
    }
    if (focused) document.getElementById(focused)?.focus();
  }

  // Shows the numbers of the scene, except in the field that is being typed in.
  refresh() {
    for (const field of this.fields.values()) field.show(get(this.state.scene, field.path));
  }

  // The library's own words at the field they are about.
  refuse(key, message) {
    let told = false;
    for (const field of this.fields.values()) {
      const own = key !== null && field.path === key;
      field.error(own ? message : "");
      told ||= own;
      if (own) field.element.closest("details")?.setAttribute("open", "");
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
    return Object.entries(schema.properties ?? {}).flatMap(([key, raw]) => {
      const at = path ? `${path}.${key}` : key;
      const inner = this.#resolve(raw);
      return this.#part(inner, at, key, value?.[key], required.includes(key));
    });
  }

  #part(schema, path, key, value, required) {
    if (key === "measured" || key === "kind") return [];
    if (schema.oneOf && schema.oneOf.every((choice) => choice.properties?.kind)) return [this.#variants(schema, path, value)];
    if (schema.enum || schema.oneOf) return [this.#choice(schema, path, key)];
    if (schema.type === "object" || schema.properties) return [this.#group(schema, path, key, value, required)];
    if (schema.type === "array") return [this.#list(schema, path, key, value)];
    if (schema.type === "number" || schema.type === "integer") return [this.#number(schema, path, key, value, required)];
    if (schema.type === "string") return [this.#text(schema, path, key)];
    return [];
  }

  #details(path, title, description, ...children) {
    const remark = ELSEWHERE[path] ? ` Not in this chart: see “sawflutter ${ELSEWHERE[path]}”.` : "";
    const details = node("details", {}, node("summary", { textContent: title, title: (description ?? "") + remark }));
    details.dataset.path = path;
    if (remark) details.append(node("p", { className: "remark", textContent: remark.trim() }));
    details.append(...children);
    return details;
  }

  #group(schema, path, key, value, required) {
    const title = key.replaceAll("_", " ");
    const there = value !== undefined && value !== null;
    const children = there ? this.#object(schema, path, value) : [];
    if (!required) children.push(this.#switch(path, title, there, () => this.#beginning(schema)));
    return this.#details(path, there ? title : `${title} (none)`, schema.description, ...children);
  }

  #switch(path, title, there, make) {
    const textContent = there ? `Take ${title} out` : `Put ${title} in`;
    const button = node("button", { type: "button", textContent });
    button.addEventListener("click", () => this.state.set(path, there ? undefined : make(), { structure: true }));
    return button;
  }

  #list(schema, path, key, value) {
    const items = this.#resolve(schema.items);
    if (items.type === "string") return this.#lines(path, key);
    const title = key.replaceAll("_", " ");
    const one = title.replace(/(?<!s)s$/, "");
    const parts = (value ?? []).map((item, i) => {
      const at = `${path}[${i}]`;
      const out = this.#switch(at, `${one} ${i + 1}`, true);
      return this.#details(at, `${one} ${i + 1}`, items.description, ...this.#object(items, at, item), out);
    });
    const add = node("button", { type: "button", textContent: `Add a ${one}` });
    add.addEventListener("click", () => {
      const more = (scene) => {
        const list = get(scene, path) ?? [];
        const fresh = list.length > 0 ? beside(list.at(-1)) : this.#beginning(items);
        (path.includes(".") ? get(scene, path.slice(0, path.lastIndexOf("."))) : scene)[key] = [...list, fresh];
      };
      this.state.change(more, { structure: true });
    });
    return this.#details(path, `${title} (${parts.length})`, schema.description, ...parts, add);
  }

  #beginning(schema) {
    const made = {};
    for (const key of schema.required ?? []) {
      const inner = this.#resolve(schema.properties[key]);
      if (inner.type === "object" || inner.properties) made[key] = this.#beginning(inner);
      else if (inner.enum) made[key] = inner.enum[0];
      else if (inner.oneOf) made[key] = inner.oneOf[0].const ?? inner.oneOf[0].enum?.[0];
      else if (inner.type === "array") made[key] = [];
      else made[key] = inner.default ?? BEGINNINGS[key] ?? (inner.type === "string" ? "" : 1);
    }
    return made;
  }

  #variants(schema, path, value) {
    const kinds = schema.oneOf.map((choice) => choice.properties.kind.const ?? choice.properties.kind.enum[0]);
    const chosen = schema.oneOf[kinds.indexOf(value?.kind)];
    const select = node("select", { id: `${path}.kind` }, ...kinds.map((kind) => node("option", { value: kind, textContent: kind })));
    select.value = value?.kind;
    select.addEventListener("change", () => {
      const next = schema.oneOf[kinds.indexOf(select.value)];
      this.state.set(path, { ...this.#beginning(next), kind: select.value }, { structure: true });
    });
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
    this.fields.set(path, { path, element, show, error });
    show(get(this.state.scene, path));
    return element;
  }

  #choice(schema, path, key) {
    const values = schema.enum ?? schema.oneOf.flatMap((choice) => choice.const ?? choice.enum);
    const select = node("select", { id: path }, ...values.map((value) => node("option", { value, textContent: value })));
    select.addEventListener("change", () => this.state.set(path, select.value));
    const row = node("div", { className: "field", title: schema.description ?? "" },
      node("label", { htmlFor: path, textContent: key.replaceAll("_", " ") }), select);
    return this.#register(path, row, (value) => (select.value = value ?? schema.default ?? values[0]));
  }

  #text(schema, path, key) {
    const input = node("input", { id: path, type: "text" });
    input.addEventListener("change", () => this.state.set(path, input.value));
    const row = node("div", { className: "field wide", title: schema.description ?? "" }, node("label", { htmlFor: path, textContent: key }), input);
    return this.#register(path, row, (value) => document.activeElement !== input && (input.value = value ?? ""));
  }

  #lines(path, key) {
    const area = node("textarea", { id: path, rows: 4 });
    area.addEventListener("change", () => {
      const lines = area.value.split("\n").filter((line) => line.trim() !== "");
      this.state.set(path, lines.length > 0 ? lines : undefined);
    });
    const row = node("div", { className: "field wide" }, node("label", { htmlFor: path, textContent: key }), area);
    const shows = (value) => document.activeElement !== area && (area.value = (value ?? []).join("\n"));
    return this.#details(`${path}:lines`, key, "", this.#register(path, row, shows));
  }

  #number(schema, path, key, value, required) {
    const { unit, scale, name } = unitOf(key);
    const whole = schema.type === "integer";
    const fallback = schema.default ?? undefined;
    const input = node("input", { id: path, type: "text", inputMode: "decimal", autocomplete: "off" });
    if (!required) input.placeholder = typeof fallback === "number" ? shown(fallback * scale) : "none";
    const slider = node("input", { type: "range", min: 0, max: NOTCHES, step: 1 });
    slider.setAttribute("aria-label", `${name} slider`);
    const range = new Range(key, value ?? fallback ?? BEGINNINGS[key] ?? 0, this.state.scene);
    const send = (number, options) => this.state.set(path, number, options);
    input.addEventListener("change", () => {
      const text = input.value.trim().replace(",", ".").replace("−", "-");
      if (text === "" && !required) send(undefined);
      else if (text !== "" && Number.isFinite(Number(text))) send(tidy(Number(text) / scale));
      // What is no number the library shall refuse in its own words.
      else send(text);
    });
    const slid = () => tidy(whole ? Math.round(range.value(slider.value)) : Number(range.value(slider.value).toPrecision(4)));
    slider.addEventListener("input", (event) => send(slid(), { draft: true, stamp: event.timeStamp }));
    slider.addEventListener("change", () => this.state.settle());
    const label = node("label", { htmlFor: path }, name, " ", node("span", { className: "unit", textContent: unit }));
    const row = node("div", { className: "field number", title: schema.description ?? "" }, label, input, slider);
    return this.#register(path, row, (number) => {
      const known = number ?? fallback;
      const typed = number === undefined || number === null ? "" : typeof number === "number" ? shown(tidy(number * scale), 12) : number;
      if (document.activeElement !== input || !row.contains(document.activeElement)) input.value = typed;
      else if (Number(input.value) !== Number(typed)) input.value = typed;
      if (typeof known === "number") {
        range.include(known);
        slider.value = range.notch(known);
        slider.setAttribute("aria-valuetext", `${shown(known * scale)} ${unit}`);
      }
    });
  }
}

// A second pad stands opposite the first.
function beside(item) {
  const fresh = structuredClone(item);
  if (typeof fresh.angle_deg === "number") fresh.angle_deg = fresh.angle_deg > 0 ? fresh.angle_deg - 180 : fresh.angle_deg + 180;
  return fresh;
}

// What a slider spans: angles a whole turn, stiffnesses four decades, the rest around the value.
class Range {
  constructor(key, value, scene) {
    this.log = /(_n_per_m|_n_per_m_3_2|_n_s_per_m|_n_s_per_m3|tolerance|_retardation_time_s)$/.test(key) && value > 0;
    [this.from, this.to] = this.#ends(key, value, scene);
  }

  #ends(key, value, scene) {
    if (this.log) return [Math.log(value) - Math.log(100), Math.log(value) + Math.log(100)];
    if (key === "poisson_ratio") return [0, 0.49];
    if (key === "pressure_angle_deg") return [0, 45];
    if (key.endsWith("angle_deg")) return [-180, 180];
    if (key === "radius_m") return [0.5 * scene.blade.inner_diameter_m, 0.5 * scene.blade.outer_diameter_m];
    if (key.endsWith("rpm")) return [0, Math.max(2 * value, 4000)];
    if (value > 0) return [0.25 * value, 2 * value];
    if (value < 0) return [2 * value, -2 * value];
    return [0, key.endsWith("_m") ? 0.5 : key.endsWith("_s") ? 0.01 : key.endsWith("_per_m") ? 1000 : 10];
  }

  include(value) {
    const at = this.log ? Math.log(value) : value;
    if (!Number.isFinite(at)) return;
    this.from = Math.min(this.from, at);
    this.to = Math.max(this.to, at);
  }

  value(notch) {
    const at = this.from + (notch / NOTCHES) * (this.to - this.from);
    return this.log ? Math.exp(at) : at;
  }

  notch(value) {
    const at = this.log ? Math.log(value) : value;
    return Math.round(((at - this.from) / (this.to - this.from || 1)) * NOTCHES);
  }
}
