// Widget of a live view: its comm is the channel of a live feed.

export default () => {
  let feed = null;

  return {
    initialize({ model }) {
      const { header, rows } = model.get("frame");
      feed = new LiveFeed((message) => model.send(message));
      feed.receive(header, rows);
      feed.drawn = header.number; // part of the widget: not to be acknowledged
      model.on("msg:custom", (header, buffers) => {
        if (header?.kind == "frame") feed.receive(header, buffers[0]);
      });
    },

    render({ model, el }) {
      const how = Object.fromEntries(
        ["width", "height", "title", "alt"].map((name) => [name, model.get(name)]));
      const picture = feed.show(how, jupyterTheme());
      // otherwise the notebook would handle the arrow keys
      for (const part of [picture.root, picture.canvas]) part.dataset.lmSuppressShortcuts = "true";
      const forget = onJupyterTheme(() => picture.applyTheme(jupyterTheme()));
      el.append(picture.root);
      return () => {
        forget();
        feed.leave(picture);
      };
    },
  };
};
