// Colours of the figures, which are lighter on a dark page.

export const DARK_PAPER = [22, 25, 30];
const WHITE = [255, 255, 255];

export const mix = (a, b, share) => a.map((channel, i) => Math.round(channel * share + b[i] * (1 - share)));
export const css = (/** @type {number[]} */ [r, g, b]) => `rgb(${r}, ${g}, ${b})`;

// Returns the colours of the page as CSS. Printed paper has those of a light page.
function theme(colours, onPaper = false) {
  const dark = !onPaper && matchMedia("(prefers-color-scheme: dark)").matches;
  const chosen = {};
  for (const [name, colour] of Object.entries(colours)) {
    // On a dark page, lines and letters are lightened for contrast, and shades are darkened.
    if (!dark) chosen[name] = css(colour);
    else if (name.endsWith("_shade")) chosen[name] = css(mix(colours[name.replace("_shade", "")], DARK_PAPER, 0.55));
    else if (name.endsWith("_streak")) chosen[name] = css(mix(colour, DARK_PAPER, 0.6));
    else chosen[name] = css(mix(colour, WHITE, 0.52));
  }
  if (dark) {
    Object.assign(chosen, { paper: css(DARK_PAPER), ink: "rgb(232, 235, 239)", quiet: "rgb(158, 165, 175)", grid: "rgb(44, 49, 57)" });
  }
  return { ...chosen, dark };
}

// Sets the colours of the page as custom properties for the style sheet, and returns them.
export function publish(colours, onPaper) {
  const chosen = theme(colours, onPaper);
  for (const [name, colour] of Object.entries(chosen)) {
    document.documentElement.style.setProperty(`--${name.replaceAll("_", "-")}`, String(colour));
  }
  return chosen;
}
