// What a lecture changes in a lesson is kept apart from its file until the lecturer says what to keep.

import { button } from "../element.js";
import { goToCell } from "./place.js";
import { strip } from "./strip.js";

// folding and unfolding moves a cell's keys about
const inOrder = (key, value) =>
  value && value.constructor === Object ? Object.fromEntries(Object.entries(value).sort()) : value;

const plain = (model) => JSON.stringify(model.toJSON(), inOrder);

// Keep a notebook's file as it is from now on; the result ends that with a question, if need be.
export function keepFile(panel, Widget) {
  const { context } = panel;
  if (context.slamlabKept) return context.slamlabKept; // an earlier lecture waits for its answer
  const before = plain(context.model), wasDirty = context.model.dirty;
  let asking;
  context.save = async () => { asking?.node.querySelector("button").focus(); };
  Object.defineProperty(context, "canSave", { value: false, configurable: true }); // autosave would call who types there
  const release = () => {
    delete context.save; // the prototype's own again
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
  context.slamlabKept = {
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
