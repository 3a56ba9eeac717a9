// Helper functions for elements of the page.

// Sets a text if it differs. Setting an equal text would cause another layout and another announcement by screen
// readers.
export function write(place, text) {
  if (place.textContent !== text) place.textContent = text;
}

export function node(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
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
