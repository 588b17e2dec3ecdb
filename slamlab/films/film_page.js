// Page of one film: it lies in the page as text, and is played by itself where it may be.

const dark = matchMedia("(prefers-color-scheme: dark)");
const theme = () => (dark.matches ? DARK : LIGHT);

function filmOfPage() {
  try {
    const text = atob(document.getElementById("film").textContent.trim());
    return Uint8Array.from(text, (letter) => letter.charCodeAt(0));
  } catch {
    return new Uint8Array(); // no base64: a page that was cut off
  }
}

showFilm(document.getElementById("place"), filmOfPage(), theme(), { alone: true })
  .then((player) => dark.addEventListener("change", () => player?.picture.wear(theme())));
