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

export function download(name, blob) {
  const link = node("a", { href: URL.createObjectURL(blob), download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
