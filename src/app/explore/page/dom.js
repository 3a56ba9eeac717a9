// Helper functions for elements of the page.

/** @returns {any} */
export const by = (id) => document.getElementById(id);

// Sets a text if it differs. Setting an equal text would cause another layout and another announcement by screen
// readers.
export function write(place, text) {
  if (place.textContent !== text) place.textContent = text;
}

// Makes an element. Names that are not those of a property are attributes.
/** @returns {any} */
export function node(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in made) made[name] = value;
    else made.setAttribute(name, value);
  }
  made.append(...children);
  return made;
}

const SVG = "http://www.w3.org/2000/svg";

export function drawn(tag, attributes, ...children) {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  made.append(...children);
  return made;
}

// Gives an element these children. Those that it has already stay, with their focus, selection and folds.
export function arrange(place, wanted) {
  for (const child of [...place.childNodes]) if (!wanted.includes(child)) child.remove();
  wanted.forEach((child, k) => place.childNodes[k] === child || place.insertBefore(child, place.childNodes[k] ?? null));
}

let terms = {};
let pattern = /(?!)/;

// Takes the terms that `explain` marks, each with its definition.
export function learn(glossary) {
  terms = Object.fromEntries(Object.entries(glossary).flatMap(([term, text]) => [[term.replace(/ wave$/, ""), text], [term, text]]));
  const words = Object.keys(terms).sort((x, y) => y.length - x.length);
  pattern = new RegExp(`(?<![\\w-])(${words.join("|")})(?=s?(?![\\w-]))`, "i");
}

// Marks the first term of the glossary in each text of an element, with its definition for the pointer.
export function explain(place) {
  const walker = document.createTreeWalker(place, NodeFilter.SHOW_TEXT);
  const texts = [];
  while (walker.nextNode()) texts.push(/** @type {Text} */ (walker.currentNode));
  for (const text of texts) {
    const found = pattern.exec(text.data);
    if (!found) continue;
    const term = text.splitText(found.index);
    term.splitText(found[0].length);
    const marked = node("dfn", { title: terms[found[0].toLowerCase()] });
    term.replaceWith(marked);
    marked.append(term);
  }
  return place;
}

export function download(name, blob) {
  const link = node("a", { href: URL.createObjectURL(blob), download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
