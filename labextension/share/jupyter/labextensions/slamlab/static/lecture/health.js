// Health of the kernel and the server: what is wrong, and the key that mends it; and JupyterLab's dialogs,
// which would lie unseen below the slides and hold the keys.

import { Signal } from "./signal.js";

const RESTART = "The outputs remain, but controls do not work. Press R twice to restart it and run all cells.";
const TROUBLES = {
  lost: "The notebook server does not answer, so no cell can run. Start the course again in its terminal and open the "
    + "new address. The outputs remain until then.",
  none: "There is no kernel, so no cell can run. Press R twice to start it and run all cells.",
  dead: `The kernel has died. ${RESTART}`,
  died: `The kernel died and was started again without results. ${RESTART}`,
  starting: "The kernel is starting …",
  empty: "No cell has run since the kernel started, so controls do not work. Press r to run all cells up to here.",
};
const STOPPED = ["lost", "none", "dead"]; // nothing can run
const GONE = [...STOPPED, "died"]; // what ran will never end
const DIED = ["dead", "autorestarting"];
const STARTING = ["starting", "autorestarting", "restarting"];
const COUNT = "print(get_ipython().execution_count)"; // 1 if no cell has run
const POLLING = 2000; // [ms] between two requests to a server that does not answer

export class Health {
  changed = new Signal();
  trouble = ""; // a key of TROUBLES
  #results = ""; // "empty" or "died": the kernel has no results

  constructor(deck) {
    this.deck = deck;
    this.session = deck.panel.sessionContext;
    const look = () => this.#look();
    const probe = () => this.#probe();
    const status = (_, now) => {
      if (DIED.includes(now)) this.#results = "died";
      else if (now === "restarting" && !this.mending) this.#results ||= "empty";
      look();
    };
    const { connectionFailure } = deck.app.serviceManager;
    const signals = [[this.session.statusChanged, status], [this.session.kernelChanged, look],
      [this.session.connectionStatusChanged, probe], [connectionFailure, probe]];
    for (const [signal, listener] of signals) signal.connect(listener);
    const dialogs = new MutationObserver(() => this.#raise());
    dialogs.observe(document.body, { childList: true });
    deck.ended.connect(() => {
      for (const [signal, listener] of signals) signal.disconnect(listener);
      dialogs.disconnect();
      clearTimeout(this.polling);
      this.over = true;
    });
    this.#raise();
    look();
    this.session.ready.then(() => deck.run(COUNT)).then((count) => {
      if (count.trim() === "1" && !this.used) this.#results ||= "empty";
      look();
    }).catch(() => {});
  }

  get text() { return TROUBLES[this.trouble] ?? ""; }

  // Whether no cell can run.
  get stopped() { return STOPPED.includes(this.trouble); }

  // A cell runs.
  runs() {
    this.used = true;
    this.#results = "";
    this.#look();
  }

  // Await a restart that the lecturer asked for; cells run after it.
  async mend(restarted) {
    this.#results = "";
    this.mending = true;
    return restarted.catch(() => false).finally(() => { this.mending = false; });
  }

  // Resolves when what runs will never end, because the kernel or the server is gone.
  gone() {
    return new Promise((resolve) => {
      const listener = () => {
        if (!GONE.includes(this.trouble)) return;
        this.changed.disconnect(listener);
        resolve(false);
      };
      this.changed.connect(listener);
    });
  }

  #look() {
    const kernel = this.session.session?.kernel;
    const awaited = this.#results === "died" && kernel?.status === "unknown"; // until the server has started it again
    const status = awaited || STARTING.includes(kernel?.status) ? "starting" : kernel?.status === "dead" ? "dead" : this.#results;
    const trouble = this.lost ? "lost" : kernel ? status : "none";
    if (trouble === this.trouble) return;
    this.trouble = trouble;
    this.changed.emit();
  }

  // Ask whether the server answers, until it does.
  async #probe() {
    clearTimeout(this.polling);
    const { baseUrl } = this.session.sessionManager.serverSettings;
    const answers = await fetch(`${baseUrl}api`, { cache: "no-store" }).then(({ ok }) => ok, () => false);
    if (this.over) return;
    this.lost = !answers;
    if (this.lost) this.polling = setTimeout(() => this.#probe(), POLLING);
    this.#look();
  }

  // Close a dialog that only informs, which the slides do themselves; show one that asks above them.
  #raise() {
    for (const dialog of document.querySelectorAll("body > .jp-Dialog:not([popover])")) {
      const buttons = dialog.querySelectorAll(".jp-Dialog-footer button.jp-Dialog-button");
      if (buttons.length === 1) buttons[0].click();
      else {
        dialog.popover = "manual";
        dialog.showPopover();
        dialog.querySelector(".jp-Dialog-button.jp-mod-accept, input, button")?.focus();
      }
    }
  }
}
