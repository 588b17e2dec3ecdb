// The time that a browser takes to draw.

const FRAMES = 2; // what changes its size when it is drawn is laid out anew in the next frame

// Wait until a stop is drawn as it stays.
export async function settled() {
  for (let frame = 0; frame < FRAMES; frame++) await new Promise(requestAnimationFrame);
}
