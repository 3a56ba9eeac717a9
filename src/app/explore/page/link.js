// Writes a scene into the address of the page and reads it from there.

// Longest address in characters. Some browsers and mail programs truncate longer ones.
const LONGEST_LINK = 8000;

async function through(stream, bytes) {
  const piped = new Blob([bytes]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(piped).arrayBuffer());
}

// Returns the address of the page with the scene in it, or null if it would be too long.
export async function link(scene) {
  const packed = await through(new CompressionStream("deflate-raw"), new TextEncoder().encode(JSON.stringify(scene)));
  const text = btoa(String.fromCharCode(...packed)).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
  const address = `${location.origin}${location.pathname}#scene=${text}`;
  return address.length <= LONGEST_LINK ? address : null;
}

// Returns the text of the scene in the address, or null.
export async function carried() {
  const found = /^#scene=(.*)$/.exec(location.hash);
  if (!found) return null;
  const packed = Uint8Array.from(atob(found[1].replaceAll("-", "+").replaceAll("_", "/")), (c) => c.charCodeAt(0));
  return new TextDecoder().decode(await through(new DecompressionStream("deflate-raw"), packed));
}

// Removes the scene from the address, for use when the address does not describe the present scene.
export function bare() {
  if (location.hash.startsWith("#scene=")) history.replaceState(null, "", location.pathname);
}
