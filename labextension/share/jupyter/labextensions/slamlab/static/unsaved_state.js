// Unsaved state: JupyterLab completes metadata of a notebook when it opens it, which is no change by the user.

// content without the metadata that JupyterLab fills in
function content(model) {
  const { metadata, cells } = model.toJSON();
  const own = { ...metadata, language_info: 0, kernelspec: 0 };
  const plain = cells.map((cell) => ({ ...cell, metadata: { ...cell.metadata, trusted: 0 } }));
  return JSON.stringify([own, plain]);
}

export async function keepClean(panel) {
  const { context, sessionContext } = panel;
  await context.ready;
  if (context.model.dirty) return; // restored with changes
  const opened = content(context.model);
  await sessionContext.ready;
  const kernel = sessionContext.session?.kernel;
  if (!kernel) return;
  await Promise.all([kernel.info, kernel.spec]);
  // JupyterLab writes after the same promises, perhaps later
  for (const wait of [0, 200, 1000]) {
    await new Promise((done) => setTimeout(done, wait));
    if (panel.isDisposed || content(context.model) !== opened) return;
    context.model.dirty = false;
  }
}
