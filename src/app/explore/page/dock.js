// Keeps the diagram visible on a narrow screen while the form is scrolled.

const NARROW = "(max-width: 1000px)";

export function dock(chart) {
  const place = chart.parentElement;
  const narrow = matchMedia(NARROW);
  const update = () => {
    const isShown = narrow.matches && place.getBoundingClientRect().width > 0;
    const isPassed = isShown && place.getBoundingClientRect().top < 0;
    if (isPassed === chart.classList.contains("docked")) return;
    // Padding takes the place of the docked diagram, so that the content below does not jump.
    const height = chart.offsetHeight;
    place.style.paddingTop = isPassed ? `${height}px` : "";
    document.documentElement.style.scrollPaddingTop = isPassed ? `${height + 8}px` : "";
    chart.classList.toggle("docked", isPassed);
  };
  addEventListener("scroll", update, { passive: true });
  addEventListener("resize", update);
}
