// Wait for the browser to render.

export const FRAMES = 2; // elements that change size when rendered are laid out in the next frame

// Wait until the layout of a stop is final.
export async function settled() {
  for (let frame = 0; frame < FRAMES; frame++) await new Promise(requestAnimationFrame);
}
