// The form has a group for every part of the schema of scenes and a field for every quantity, so that the page can set
// all that the library reads. Each is made once, and follows the scene.

import { choice, line, lines, numbers, quantity } from "./controls.js";
import { arrange, node, write } from "./dom.js";
import { named, unitOf } from "./fields.js";
import { lacks, putIn } from "./parts.js";
import { inForm } from "./phrases.js";
import { get } from "./scene.js";
import { kindOf, resolved } from "./schema.js";
import { Refused } from "./talk.js";
import { lawOf, partName } from "./words.js";

// Parts of the saw that can be selected, in the order of their groups.
const PARTS = ["blade", "guides", "mount", "cut"];
// Order of the first quantities; the others follow in the order of the schema. The first one is always shown.
const ORDER = ["operating_rpm", ...PARTS];
// Groups that the chart does not use, or only on request, and the tab that uses each.
const ELSEWHERE = { cut: "Cut", "cut.washboarding": "Cut", runup: "Run-up and response", side_force: "Run-up and response", friction: "Guides", spline: "Cut" };

// Returns the path of the part that the program adds for a number that a scene lacks: for a number of a pad, the pad or a part
// of the first one. Null if the scene has the part.
function lackedPart(number, scene) {
  const block = number.split(".").slice(0, -1).join(".");
  const path = scene.guides?.length > 0 ? block.replace(/^guides\[\]\./, "guides[0].") : block.replace(/^guides\[\].*/, "guides[]");
  if (path === "" || path.startsWith("measured")) return null;
  const part = get(scene, path.replace(/\[\]$/, ""));
  return (Array.isArray(part) ? part.length > 0 : part !== undefined && part !== null) ? null : path;
}

export class Form {
  // Fields and groups that were made, and those fields that the present scene has.
  #made = new Map();
  #fields = new Map();
  #found = [];
  // Part whose fields are shown; empty if those of all parts are.
  #chosen = PARTS[0];

  // `say(text)` shows an error that belongs to no field.
  constructor(place, { schema, needs }, state, say) {
    this.search = node("input", { type: "search", id: "search", placeholder: "Find a quantity", "aria-label": "Find a quantity", oninput: () => this.#show() });
    this.chips = [...PARTS, ""].map((value) => node("button", { type: "button", value, textContent: partName(value) || "All quantities", onclick: () => {
      this.search.value = "";
      this.#show(value);
    } }));
    this.place = node("div");
    this.offers = node("div", { id: "offers", role: "status" });
    place.append(node("div", { className: "tools parts" }, ...this.chips, this.search), this.offers, this.place);
    this.schema = schema;
    this.needs = needs;
    this.state = state;
    this.say = say;
  }

  // Shows the fields of a part, of all parts, or those that are searched for.
  #show(part = this.#chosen) {
    this.#chosen = part;
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
    this.offers.replaceChildren(...(wanted === "" ? [] : this.#offersFor(wanted)));
  }

  // Returns sentences about the parts that the scene lacks and that have a number of this name, with buttons that put them in.
  #offersFor(wanted) {
    const { scene } = this.state;
    const lacked = [...new Set(named(wanted).map((path) => lackedPart(path, scene)).filter(Boolean))];
    const isNone = lacked.length === 0 && !this.place.querySelector(".field:not([hidden])");
    if (isNone) return [node("p", { className: "remark", textContent: "No quantity has this name." })];
    const isOuter = (path) => lacked.every((other) => !path.startsWith(`${other}.`));
    return lacked.filter(isOuter).map((path) => {
      const name = partName(path.replace(/\[\]$/, "").split(".").at(-1));
      const put = node("button", { type: "button", textContent: `Put ${name} in`, onclick: () => this.#putIn(path) });
      return node("p", {}, `This saw has no ${name}. `, lacks(this.needs, path, scene) || put);
    });
  }

  #groupAt(path) {
    return this.place.querySelector(`details[data-path="${path}"]`);
  }

  // Shows the field or the group with this path; all of them if it is empty. The first quantity, which is always shown,
  // keeps the part.
  reveal(path) {
    this.search.value = "";
    this.#show(this.#chosen && (path === ORDER[0] ? this.#chosen : path.split(/[.[]/)[0]));
    const place = this.#fields.get(path)?.element ?? this.#groupAt(path);
    for (let group = place?.closest("details"); group; group = group.parentElement.closest("details")) group.open = true;
  }

  // Takes over the parts of the scene and the units of the form.
  build() {
    const focused = document.activeElement;
    this.#fields.clear();
    arrange(this.place, this.#object(this.schema, "", this.state.scene));
    for (const field of this.#fields.values()) field.renew();
    this.refresh();
    this.influence();
    this.#show();
    // The button of an entry that it has removed passes the focus to the one that adds an entry.
    if (!focused.isConnected) document.getElementById(`${focused.id.replace(/\[\d+\][^[]*$/, "")}:add`)?.focus({ preventScroll: true });
  }

  // Shows the values of the scene. During a drag, only the fields whose values changed are updated.
  refresh(draft = false) {
    for (const field of this.#fields.values()) {
      const value = get(this.state.scene, field.path);
      if (!draft || field.value !== value) field.show(value);
    }
  }

  // Returns the path of the pad, cut or probe that an element of the form belongs to, or null.
  partOf(element) {
    const parts = this.place.querySelectorAll("[data-path='guides'] > details, [data-path='cut'], [data-path='probe']");
    return [...parts].find((part) => part.contains(element))?.dataset.path ?? null;
  }

  // Opens and marks the fields of a part; unmarks all if `path` is null.
  select(path) {
    for (const part of this.place.querySelectorAll("details")) part.classList.toggle("selected", part.dataset.path === path);
    if (path) this.reveal(path);
  }

  influence(found = this.#found) {
    this.#found = found;
    const by = new Map(found.map((one) => [one.path, one]));
    for (const field of this.#fields.values()) field.weigh(by.get(field.path));
  }

  // Returns the text of a refusal, in the unit of its field if the form has one.
  inWords({ key, message, told }) {
    return (this.#fields.has(key?.replace(/\[\d*\]$/, "")) && told) || inForm(message);
  }

  // Shows a refusal at its field, and at that of the number that was changed last, and removes earlier ones. Returns whether
  // the form has one of these fields.
  refuse(refusal) {
    // A number in a list has the field of the list.
    const causes = refusal instanceof Refused ? [refusal.key?.replace(/\[\d*\]$/, ""), this.state.changed] : [];
    const own = [...this.#fields.values()].filter(({ path }) => causes.includes(path));
    for (const field of this.#fields.values()) if (!field.isUnread) field.refuse(own.includes(field) ? this.inWords(refusal) : "");
    if (own.length > 0 && !own.some(({ element }) => element.checkVisibility())) this.reveal(own[0].path);
    return own.length > 0;
  }

  // Reads texts again that were typed while the program did not answer.
  readAgain() {
    const unread = [...this.#fields.values()].filter(({ isUnread }) => isUnread);
    for (const { control } of unread) control.dispatchEvent(new Event("change"));
  }

  // Returns what has this key, which is made when it is first needed.
  #kept(key, make) {
    if (!this.#made.has(key)) this.#made.set(key, make());
    return this.#made.get(key);
  }

  #object({ properties = {}, required = [] }, path, value) {
    const place = (key) => (path === "" && ORDER.includes(key) ? ORDER.indexOf(key) : ORDER.length);
    const keys = Object.keys(properties).filter((key) => !["measured", "kind", "$schema"].includes(key)).sort((x, y) => place(x) - place(y));
    return keys.flatMap((key) => {
      const at = path ? `${path}.${key}` : key;
      const schema = resolved(properties[key], this.schema);
      return schema.type === "boolean" ? [] : [this.#part(schema, at, partName(key), value?.[key], required.includes(key))];
    });
  }

  #part(schema, path, name, value, isRequired) {
    const kind = kindOf(schema);
    if (kind === "object") return this.#objectGroup(schema, path, name, value, isRequired);
    if (kind === "variants") return this.#variants(schema, path, value);
    if (kind !== "array") return this.#field(path, () => this.#control(kind, schema, path, name, isRequired));
    const items = resolved(schema.items, this.schema);
    if (items.type === "number") return this.#field(path, () => numbers(path, schema, this.state));
    if (items.type !== "string") return this.#list(schema, items, path, name, value ?? []);
    return this.#group(`${path}:lines`, name, "", "", this.#field(path, () => lines(path, name, this.state)));
  }

  #field(path, make) {
    const field = this.#kept(`${path} ${unitOf(path).unit}`, make);
    this.#fields.set(path, field);
    return field.element;
  }

  #control(kind, schema, path, name, isRequired) {
    if (kind === "string") return line(path, name, schema, this.state);
    if (kind !== "choice") return quantity(path, schema, this.state, isRequired);
    const values = schema.enum ?? schema.oneOf.flatMap((one) => one.const ?? one.enum);
    return choice(path, name, values, schema, (value) => {
      // A pad that lifts off needs a gap, for which the program has a usual one.
      if (value === "one_sided") this.#putIn(path.replace(/contact$/, "gap_m"));
      else this.state.set(path, value);
    });
  }

  #group(path, title, description, remark, ...children) {
    const elsewhere = path === "cut" ? "In this chart only if its speed there is given" : "Not in this chart";
    const use = ELSEWHERE[path] ? `${elsewhere}: see the tab “${ELSEWHERE[path]}”.` : "";
    const group = this.#kept(`${path}:group`, () => node("details", { "data-path": path, open: /^guides\[\d+\]$/.test(path) },
      node("summary", { title: [description, use].filter(Boolean).join(" ") }), node("p", { className: "remark" })));
    const [summary, words] = group.children;
    write(summary, title);
    write(words, [use, remark].filter(Boolean).join(" "));
    arrange(group, [summary, words, ...children]);
    return group;
  }

  #objectGroup(schema, path, name, value, isRequired) {
    const isThere = (value ?? null) !== null;
    const remark = isThere && path.endsWith(".controller") ? lawOf(value) : "";
    const lacking = isThere ? "" : lacks(this.needs, path, this.state.scene);
    const children = isThere ? this.#object(schema, path, value) : [];
    if (!isRequired && !lacking) children.push(this.#switch(path, name, isThere));
    return this.#group(path, isThere ? name : `${name} (none)`, schema.description, lacking || remark, ...children);
  }

  #switch(path, name, isThere) {
    const turn = () => {
      if ((get(this.state.scene, path) ?? null) === null) this.#putIn(path);
      else this.state.set(path, undefined, { structure: true });
    };
    const button = this.#kept(`${path}:switch`, () => node("button", { type: "button", id: `${path}:switch`, onclick: turn }));
    write(button, isThere ? `Take ${name} out` : `Put ${name} in`);
    return button;
  }

  async #putIn(path, kind = "") {
    try {
      await putIn(this.state, path, { kind });
    } catch (error) {
      this.refresh();
      this.say(this.inWords(error));
    }
  }

  #list(schema, items, path, name, value) {
    const one = name.replace(/(?<!s)s$/, "");
    const parts = value.map((item, i) => {
      const at = `${path}[${i}]`;
      return this.#group(at, `${one} ${i + 1}`, items.description, "", ...this.#object(items, at, item), this.#switch(at, `${one} ${i + 1}`, true));
    });
    const add = this.#kept(`${path}:add`, () => node("button", { type: "button", id: `${path}:add`, textContent: `Add a ${one}`, onclick: async () => {
      const fresh = `${path}[${get(this.state.scene, path)?.length ?? 0}]`;
      await this.#putIn(`${path}[]`);
      this.#groupAt(fresh)?.toggleAttribute("open", true);
    } }));
    const lacking = lacks(this.needs, `${path}[]`, this.state.scene);
    return this.#group(path, `${name} (${parts.length})`, schema.description, lacking, ...parts, ...(lacking ? [] : [add]));
  }

  #variants(schema, path, value) {
    const kinds = schema.oneOf.map(({ properties: { kind } }) => kind.const ?? kind.enum[0]);
    const kind = this.#field(`${path}.kind`, () => choice(`${path}.kind`, "kind", kinds, {}, (chosen) => this.#putIn(path, chosen)));
    return this.#group(path, path, schema.description, "", kind, ...this.#object(schema.oneOf[kinds.indexOf(value?.kind)] ?? {}, path, value));
  }
}
