// What is not to be lost: edits in the browser's storage, the scene in the address, files on the
// disk without a server.

const PREFIX = "sawflutter scene ";
// Scenes kept at most; the oldest go first.
const MOST = 30;
// Browsers and mail cut longer addresses off.
const LONGEST_LINK = 8000;

// Edits belong to the scene that the program was started with.
export class Kept {
  constructor(begun) {
    this.key = PREFIX + JSON.stringify(begun);
  }

  // The edited scene of an earlier visit.
  restored() {
    try {
      const found = JSON.parse(localStorage.getItem(this.key));
      return found?.scene ?? null;
    } catch {
      return null;
    }
  }

  keep(scene) {
    try {
      localStorage.setItem(this.key, JSON.stringify({ scene, at: Date.now() }));
      const all = Object.keys(localStorage).filter((key) => key.startsWith(PREFIX));
      const age = (key) => JSON.parse(localStorage.getItem(key))?.at ?? 0;
      all.sort((x, y) => age(x) - age(y)).slice(0, -MOST).forEach((key) => localStorage.removeItem(key));
    } catch {
      // A browser that keeps nothing still has the page.
    }
  }

  forget() {
    try {
      localStorage.removeItem(this.key);
    } catch {
      // Nothing was kept.
    }
  }
}

async function through(stream, bytes) {
  const piped = new Blob([bytes]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(piped).arrayBuffer());
}

// The address of the page with the scene in it; nothing where it would be too long.
export async function link(scene) {
  const packed = await through(new CompressionStream("deflate-raw"), new TextEncoder().encode(JSON.stringify(scene)));
  const text = btoa(String.fromCharCode(...packed)).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
  const address = `${location.origin}${location.pathname}#scene=${text}`;
  return address.length <= LONGEST_LINK ? address : null;
}

// The text of the scene that the address carries.
export async function carried() {
  const found = /^#scene=([\w-]+)$/.exec(location.hash);
  if (!found) return null;
  const packed = Uint8Array.from(atob(found[1].replaceAll("-", "+").replaceAll("_", "/")), (c) => c.charCodeAt(0));
  return new TextDecoder().decode(await through(new DecompressionStream("deflate-raw"), packed));
}

export function download(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
