// The scene in the address of the page.

// Browsers and mail cut longer addresses off.
const LONGEST_LINK = 8000;

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

// The address without a scene: from the first change on it would be another one.
export function bare() {
  if (location.hash.startsWith("#scene=")) history.replaceState(null, "", location.pathname);
}
