// Films of a lesson, each loaded when it comes near: a script, for a page that is a file may fetch none.
{
  const arrived = new Map(); // file to what takes its text
  const scheme = matchMedia("(prefers-color-scheme: dark)");

  window.slamlabFilm = (file, text) => arrived.get(file)?.(text);

  function theme() {
    const { theme: chosen } = document.body.dataset;
    return chosen == "dark" || (chosen != "light" && scheme.matches) ? DARK : LIGHT;
  }

  function load(place) {
    const { folder, file } = place.dataset;
    arrived.set(file, async (text) => {
      const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
      const player = await showFilm(place, bytes, theme());
      if (!player) return;
      const applyTheme = () => player.picture.applyTheme(theme());
      scheme.addEventListener("change", applyTheme);
      new MutationObserver(applyTheme).observe(document.body, { attributeFilter: ["data-theme"] });
    });
    const script = document.createElement("script");
    script.src = folder + file;
    document.head.append(script);
  }

  const watcher = new IntersectionObserver((seen) => {
    for (const { isIntersecting, target } of seen) {
      if (!isIntersecting) continue;
      watcher.unobserve(target);
      load(target);
    }
  }, { rootMargin: "400px" });
  for (const place of document.querySelectorAll(".slamlab-film")) watcher.observe(place);
}
