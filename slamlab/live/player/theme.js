// Theme: neutral colours of a drawing: background (paper), text (ink), grid and frame (axis).
// Colours with a meaning come with their layers (slamlab/views/colours.py).

const LIGHT = { paper: "#ffffff", ink: "#333333", grid: "#e4e4e4", axis: "#9a9a9a" };
const DARK = { paper: "#17191c", ink: "#dcdcdc", grid: "#33363b", axis: "#83878d" };
const LEGIBLE = 4.5; // minimum contrast of a layer's colour to a dark background (WCAG 2.2, 1.4.3)

// red, green, blue from 0 to 1 of #rrggbb
const channels = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);
const hexOf = (rgb) =>
  "#" + rgb.map((value) => Math.round(255 * value).toString(16).padStart(2, "0")).join("");

// relative luminance (WCAG 2.2)
function luminance(hex) {
  const linear = channels(hex).map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
  return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
}

// a layer's colour for this background: colours are chosen for white, and made lighter, with the
// same hue, for a dark background; black becomes white
function legible(colour, paper) {
  const ground = luminance(paper);
  if (ground > 0.4) return colour;
  const rgb = channels(colour), high = Math.max(...rgb), low = Math.min(...rgb);
  const flipped = 1 - (high + low) / 2 > (high + low) / 2 ? rgb.map((v) => 1 - high - low + v) : rgb;
  for (let white = 0; white <= 1; white += 0.05) {
    const mixed = hexOf(flipped.map((v) => v + white * (1 - v)));
    if ((luminance(mixed) + 0.05) / (ground + 0.05) >= LEGIBLE) return mixed;
  }
  return "#ffffff";
}
