// Container of the extension (module federation), written by hand: plain modules need no build.
// JupyterLab calls init with what the application shares, then get for the extension.

window._JUPYTERLAB = window._JUPYTERLAB || {};
window._JUPYTERLAB.slamlab = (() => {
  const here = document.currentScript.src;
  let scope;

  async function shared(name) {
    const [offered] = Object.values(scope[name]);
    return (await offered.get())();
  }

  return {
    init(shares) {
      scope = shares;
    },
    async get() {
      let found = []; // a failing extension must not stop the application
      try {
        const [{ plugins }, ...offered] = await Promise.all([
          import(new URL("index.js", here).href),
          shared("@jupyterlab/notebook"),
          shared("@jupyterlab/apputils"),
          shared("@lumino/widgets"),
        ]);
        found = plugins(Object.assign({}, ...offered));
      } catch (error) {
        console.error("slamlab:", error);
      }
      return () => ({ __esModule: true, default: found });
    },
  };
})();
