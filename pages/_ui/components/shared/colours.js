// Colours: those that mean something come from Python's palette as "#rrggbb", those of
// the page's theme from shared.css.

function rgbOf(hex) {
  const n = parseInt(hex.slice(1), 16);
  return [n >> 16, (n >> 8) & 255, n & 255];
}

// An opaque pixel in a Uint32Array over a canvas's data: red is the low byte.
const pixelOf = ([r, g, b]) => ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0;

const mixed = (from, to, share) => from.map((v, i) => Math.round(v + (to[i] - v) * share));

// The theme for a canvas, which cannot read color-mix() or a variable by itself.
function themeOf(root) {
  const probe = element("i");
  root.append(probe);
  const resolved = (name) => {
    probe.style.color = `var(--${name})`;
    return getComputedStyle(probe).color;
  };
  const names = ["ink", "paper", "muted", "line", "accent"];
  const theme = Object.fromEntries(names.map((name) => [name, resolved(name)]));
  probe.remove();
  // On a projector text is larger and marks are thicker.
  const style = getComputedStyle(root);
  const large = Number(style.getPropertyValue("--occsim-text")) || 1;
  return { ...theme, font: style.fontFamily, large };
}
