// Notebook protection: changes during a lecture are not saved until the lecturer decides.

import { button } from "../element.js";
import { goToCell } from "./active_cell.js";
import { strip } from "./banner.js";

// folding changes the order of a cell's keys
const inOrder = (key, value) =>
  value && value.constructor === Object ? Object.fromEntries(Object.entries(value).sort()) : value;

const plain = (model) => JSON.stringify(model.toJSON(), inOrder);

// Prevent saving from now on; `end` of the result asks whether to keep changes, if there are any.
export function protect(panel, Widget) {
  const { context } = panel;
  if (context.slamlabKept) return context.slamlabKept; // an earlier lecture still waits for the decision
  const before = plain(context.model), wasDirty = context.model.dirty;
  let asking;
  context.save = async () => { asking?.node.querySelector("button").focus(); };
  Object.defineProperty(context, "canSave", { value: false, configurable: true }); // autosave would move the focus
  const release = () => {
    delete context.save; // the prototype's method applies again
    delete context.canSave;
    delete context.slamlabKept;
    asking?.dispose();
  };
  const restore = () => {
    const { activeCell } = panel.content, place = activeCell?.model.id;
    context.model.fromJSON(JSON.parse(before));
    context.model.dirty = wasDirty;
    release();
    goToCell(panel.content, panel.content.widgets.findIndex(({ model }) => model.id === place));
  };
  const sources = new Map(JSON.parse(before).cells.map(({ id, source }) => [id, [source].flat().join("")]));
  context.slamlabKept = {
    // Restore the code of one cell; whether it had changed.
    restoreCell({ model }) {
      const source = sources.get(model.id);
      if (source === undefined || source === model.sharedModel.getSource()) return false;
      model.sharedModel.setSource(source);
      return true;
    },
    end() {
      if (plain(context.model) === before) {
        context.model.dirty = wasDirty;
        release();
      } else if (!asking) {
        const answers = [button("Restore it", restore), button("Keep the changes", release)];
        asking = strip(panel, Widget, "The lecture changed this lesson. ", ...answers);
      }
    },
  };
  return context.slamlabKept;
}
