// Keeps the answer and the diagram visible on a narrow screen while the form is scrolled, one below the other.

const NARROW = "(max-width: 1000px)";

export function dock(...parts) {
  const narrow = matchMedia(NARROW);
  const update = () => {
    let top = 0;
    for (const part of parts) {
      const place = part.parentElement;
      const { top: own, width } = place.getBoundingClientRect();
      const isPassed = narrow.matches && width > 0 && own < top;
      if (isPassed !== part.classList.contains("docked")) {
        // Padding takes the place of the docked part, so that the content below does not jump.
        place.style.paddingTop = isPassed ? `${part.offsetHeight}px` : "";
        part.classList.toggle("docked", isPassed);
      }
      part.style.top = isPassed ? `${top}px` : "";
      if (isPassed) top += part.offsetHeight;
    }
    document.documentElement.style.scrollPaddingTop = top > 0 ? `${top + 8}px` : "";
  };
  addEventListener("scroll", update, { passive: true });
  addEventListener("resize", update);
}
