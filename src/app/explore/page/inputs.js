// Inputs of tasks, each of which keeps what is typed or chosen while the scene changes.

import { arrange, node } from "./dom.js";
import { placeOf, unitOf } from "./fields.js";
import { get } from "./scene.js";
import { shown, tidy } from "./words.js";

const field = (words, control) => node("div", { className: "field" }, node("label", { htmlFor: control.id, textContent: words }), control);
const menu = (id, options) => node("select", { id }, ...options.map(([value, textContent]) => node("option", { value, textContent })));

// Returns the paths of the numbers of a scene that have a usual tolerance, each with this tolerance in the unit of its
// key.
function usualTolerances(tolerances, scene) {
  return tolerances.flatMap(({ path, plus_minus, share }) => {
    const places = path.startsWith("guides[]") ? (scene.guides ?? []).map((_, i) => path.replace("[]", `[${i}]`)) : [path];
    return places.map((place) => [place, get(scene, place)]).filter(([, value]) => typeof value === "number")
      .map(([place, value]) => [place, tidy(Number((plus_minus + share * value).toPrecision(3)))]);
  });
}

class Tolerances {
  #all = [];

  constructor(place, usual) {
    this.place = place;
    this.usual = usual;
  }

  refresh(scene) {
    const usual = usualTolerances(this.usual, scene).map(([path, width]) => ({ path, width, ...unitOf(path) }));
    const typed = new Map(this.#all.map((one) => [one.path, one]));
    this.#all = usual.map(({ path, width, unit, scale }) => {
      const before = typed.get(path);
      const defaultValue = shown(tidy(width * scale));
      if (before?.unit === unit) {
        before.input.defaultValue = defaultValue;
        return before;
      }
      const input = node("input", { id: `study:${path}`, type: "text", defaultValue });
      // A typed number keeps the unit in which it was typed.
      const text = before && before.input.value !== before.input.defaultValue ? before.input.value : null;
      if (text !== null) input.value = /[\d.,]$/.test(text.trim()) ? `${text} ${before.unit}` : text;
      return { path, unit, input, field: field(`± ${placeOf(path)}, ${unit}`, input) };
    });
    arrange(this.place, this.#all.map((one) => one.field));
  }

  get asked() {
    return { tolerances: this.#all.map(({ path, input }) => ({ path, plus_minus: input.value })) };
  }
}

// The numbers along the axes of a map: any that has a usual tolerance.
class Axes {
  #offered = "";
  #axes = [];

  constructor(place, usual) {
    this.place = place;
    this.usual = usual;
  }

  refresh(scene) {
    const numbers = usualTolerances(this.usual, scene).map(([path]) => [path, placeOf(path)]);
    if (String(numbers) === this.#offered) return;
    this.#offered = String(numbers);
    const chosen = this.#axes.map(({ value }) => value);
    this.#axes = [numbers, [["", "rotation speed"], ...numbers]].map((all, k) => menu(`map-axis-${k}`, all));
    this.#axes.forEach((axis, k) => {
      if ([...axis.options].some(({ value }) => value === chosen[k])) axis.value = chosen[k];
    });
    this.place.replaceChildren(...this.#axes.map((axis, k) => field(["Horizontal axis", "Vertical axis"][k], axis)));
  }

  get asked() {
    return { axes: this.#axes.map(({ value }) => value).filter((path) => path !== "") };
  }
}

// The number to be sized: any that has a usual tolerance, or the operating speed; with or without bounds.
class Sized {
  #offered = "";
  #number = node("select");
  #each = node("input", { id: "size-for", type: "text", placeholder: "the scene alone", title: "The ranges for values of another number too, like blade.thickness_m=2.0mm,2.2mm" });
  #bounds = node("input", { id: "size-bounds", type: "text", placeholder: "usual", title: "The usual bounds, or others like 1.8mm..3.2mm" });

  constructor(place, usual) {
    this.place = place;
    this.usual = usual;
  }

  refresh(scene) {
    const numbers = [...usualTolerances(this.usual, scene).map(([path]) => [path, placeOf(path)]), ["operating_rpm", "operating speed"]];
    if (String(numbers) === this.#offered) return;
    this.#offered = String(numbers);
    const chosen = this.#number.value;
    this.#number = menu("size-number", numbers);
    if (numbers.some(([path]) => path === chosen)) this.#number.value = chosen;
    this.place.replaceChildren(field("Number", this.#number), field("Bounds", this.#bounds), field("For", this.#each));
  }

  get asked() {
    const bounds = this.#bounds.value.trim();
    return { options: { vary: bounds === "" ? this.#number.value : `${this.#number.value}=${bounds}`, each: this.#each.value } };
  }
}

class Goal {
  #goal = menu("place-goal", [["flutter", "largest flutter speed"], ["window", "widest stable window around the operating speed"]]);
  #least = node("input", { id: "place-least", type: "text", placeholder: "none" });

  constructor(place) {
    place.append(field("Goal", this.#goal), field("Lower limit of the first critical speed, rpm", this.#least));
  }

  refresh() {}

  get asked() {
    return { options: { goal: this.#goal.value, min_critical_rpm: this.#least.value } };
  }
}

export const INPUTS = { study: Tolerances, map: Axes, place: Goal, size: Sized };
