"""Measurements of a live view in a browser: latency and frame rate."""

import statistics

# calls back after each picture of a live view or an image, or each new text of a button
WATCH = """
([root, back]) => {
  if (root.tagName != "IMG") {
    const watcher = new MutationObserver(back);
    watcher.observe(root, { attributeFilter: ["data-frame"], childList: true });
    return () => watcher.disconnect();
  }
  root.addEventListener("load", back);
  return () => root.removeEventListener("load", back);
}
"""
CLICK = f"""
([root, button]) => new Promise((done) => {{
  const begin = performance.now();
  const end = ({WATCH})([root, () => {{ end(); done(performance.now() - begin); }}]);
  button.click();
}})
"""
COUNT = f"""
([root, seconds]) => new Promise((done) => {{
  const begin = performance.now();
  let pictures = 0;
  const end = ({WATCH})([root, () => {{ pictures += 1; }}]);
  setTimeout(() => {{
    end();
    done(1000 * pictures / (performance.now() - begin));
  }}, 1000 * seconds);
}})
"""


def measured(cell, root, run, pause, quick):
    """Measure the median latency from a click to the picture [ms] and the frame rate [1/s].

    Parameters
    ----------
    cell, root : Locator of the cell and of what is drawn in it
    run, pause : str, the text of the buttons
    quick : bool, fewer presses and less time
    """
    page, shown = cell.page, root.element_handle()

    def button(text):
        return cell.get_by_role("button", name=text, exact=True)

    wait = pressed(page, shown, button("step").element_handle(), quick)
    button(run).click()
    page.wait_for_timeout(500)
    rate = page.evaluate(COUNT, [shown, 2 if quick else 6])
    button(pause).click()
    page.wait_for_timeout(1500)  # what is on its way arrives
    return wait, rate


def pressed(page, shown, button, quick):
    """Measure the median time from a click on a button to a change of the view [ms]."""
    presses = 5 if quick else 30
    waits = [page.evaluate(CLICK, [shown, button]) for _ in range(3 + presses)][3:]
    return statistics.median(waits)
