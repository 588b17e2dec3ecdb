// Page of one film: the film is text in the page, and plays automatically unless motion is reduced.

const dark = matchMedia("(prefers-color-scheme: dark)");
const theme = () => (dark.matches ? DARK : LIGHT);

function filmOfPage() {
  try {
    const text = atob(document.getElementById("film").textContent.trim());
    return Uint8Array.from(text, (letter) => letter.charCodeAt(0));
  } catch {
    return new Uint8Array(); // not base64: the page is incomplete
  }
}

showFilm(document.getElementById("place"), filmOfPage(), theme(), { alone: true })
  .then((player) => dark.addEventListener("change", () => player?.picture.applyTheme(theme())));
