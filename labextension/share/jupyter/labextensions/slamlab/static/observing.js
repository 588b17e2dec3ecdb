// Observe a notebook: call a function once for each element that matches a selector, now or later.

export function forEachElement(panel, selector, attend) {
  const seen = new WeakSet();
  const look = () => {
    for (const element of panel.content.node.querySelectorAll(selector)) {
      if (seen.has(element)) continue;
      seen.add(element);
      attend(element);
    }
  };
  const observer = new MutationObserver(look);
  observer.observe(panel.content.node, { childList: true, subtree: true });
  panel.disposed.connect(() => observer.disconnect());
  look();
}
