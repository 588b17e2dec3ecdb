// JupyterLab's colours as a theme of the player, and notification of changes.

const NAMES = {
  paper: "--jp-layout-color0", ink: "--jp-ui-font-color1",
  grid: "--jp-border-color2", axis: "--jp-border-color0",
};

function jupyterTheme() {
  const style = getComputedStyle(document.body), g = new OffscreenCanvas(1, 1).getContext("2d");
  const theme = { ...LIGHT };
  for (const name in NAMES) theme[name] = style.getPropertyValue(NAMES[name]).trim() || LIGHT[name];
  // as #rrggbb, from which legible colours are computed
  g.fillStyle = LIGHT.paper;
  g.fillStyle = theme.paper;
  return { ...theme, paper: g.fillStyle };
}

// calls back when the reader selects another theme; returns a function that stops this
function onJupyterTheme(changed) {
  const watcher = new MutationObserver(changed);
  watcher.observe(document.body, { attributeFilter: ["data-jp-theme-name", "data-jp-theme-light"] });
  return () => watcher.disconnect();
}
