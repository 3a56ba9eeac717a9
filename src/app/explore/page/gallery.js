// Cards of saws: all examples in a dialog, and three ways to begin at the first visit.

import { node } from "./dom.js";
import { thumbnail } from "./shapes.js";
import { partName } from "./words.js";

const VISITED = "sawflutter visited";
// Saws of the first visit, by the starts of their names: that of the paper, and one with a collar.
const FIRST = ["Guided spline arbor saw", "400 mm blade between collars"];

function card(picture, name, words, onClick) {
  return node("button", { type: "button", className: "card", onclick: onClick }, picture, node("strong", { textContent: name }), node("span", { textContent: words }));
}

// Returns the parts by which a saw differs from a plain blade with pads.
function featuresOf({ blade, guides = [], membrane = {}, ...others }) {
  const found = [...["profile", "slots", "rim"].filter((part) => blade[part]), ...Object.keys(membrane), ...["cut", "damping", "excitation"].filter((part) => others[part]),
    ...["arm", "film", "controller"].filter((part) => guides.some((pad) => pad[part]))];
  return found.map(partName);
}

function inWords(scene) {
  const { blade, guides = [], mount } = scene;
  const count = `${guides.length || "no"} pad${guides.length === 1 ? "" : "s"}`;
  return [`${Math.round(blade.outer_diameter_m * 1e3)} mm, ${count}, ${mount.kind}`, ...featuresOf(scene)].join(", ");
}

// Fills the dialog; `choose(example)` opens a saw.
export function offerExamples(dialog, examples, choose) {
  const cards = examples.map((example) => card(thumbnail(example), example.name, inWords(example), () => {
    dialog.close();
    choose(example);
  }));
  dialog.querySelector(".cards").append(...cards);
}

// Fills and shows the cards of the first visit. The first card keeps the saw that is shown; `choose(example)` opens
// another one, `open()` a file, and `end()` removes the cards. Returns whether this is the first visit.
export function welcome(place, examples, { end, choose, open }) {
  try {
    if (localStorage.getItem(VISITED)) return false;
    localStorage.setItem(VISITED, "1");
  } catch {
    return false;
  }
  const after = (then) => () => {
    end();
    then();
  };
  const [own, collar] = FIRST.map((start) => examples.find(({ name }) => name.startsWith(start)) ?? examples[0]);
  const file = node("span", { className: "thumbnail", textContent: "+", "aria-hidden": "true" });
  place.querySelector(".cards").append(
    card(thumbnail(own), "The saw of a paper", inWords(own), after(() => {})),
    card(thumbnail(collar), "A saw with a collar", inWords(collar), after(() => choose(collar))),
    card(file, "A saw of your own", "open a scene file", after(open)));
  place.hidden = false;
  return true;
}
