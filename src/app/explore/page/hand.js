// Moves and magnifies a panel by hand: the wheel with Ctrl or ⌘ and two fingers magnify it, a drag shifts it, and a tap chooses a point.

// Turns of the wheel, in pixels, that halve the range.
const HALVING_PX = 300;
// A pointer that moved less than this has tapped.
const TAP_PX = 6;

// `magnify(factor, px)` scales the range about a place and returns whether it has changed, `shift(px)` moves it, and
// `tap(event)` chooses a point.
export function hand(over, { magnify, shift, tap }) {
  const down = new Map();
  let moved = 0;
  over.addEventListener("wheel", (event) => {
    // The wheel alone scrolls the page.
    if ((event.ctrlKey || event.metaKey) && magnify(2 ** (event.deltaY / HALVING_PX), event.offsetX)) event.preventDefault();
  }, { passive: false });
  over.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    over.setPointerCapture(event.pointerId);
    down.set(event.pointerId, event.offsetX);
    moved = 0;
  });
  over.addEventListener("pointermove", (event) => {
    const from = down.get(event.pointerId);
    if (from === undefined) return;
    down.set(event.pointerId, event.offsetX);
    moved += Math.abs(event.offsetX - from);
    const other = [...down].find(([id]) => id !== event.pointerId)?.[1];
    if (other === undefined) shift(event.offsetX - from);
    else magnify(Math.abs((from - other) / (event.offsetX - other || 1)), other);
  });
  const end = (event) => {
    if (down.delete(event.pointerId) && event.type === "pointerup" && moved < TAP_PX) tap(event);
  };
  over.addEventListener("pointerup", end);
  over.addEventListener("pointercancel", end);
}
