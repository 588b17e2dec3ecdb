// What was read is kept by this browser, and nowhere else.
// No module: a page that is opened as a file may load none.
{
  const KEY = "slamlab-read";
  const page = location.pathname.split("/").slice(-2).join("/");

  function kept() {
    try {
      return new Set(JSON.parse(localStorage.getItem(KEY) ?? "[]"));
    } catch {
      return new Set(); // a file's page may keep nothing in some browsers
    }
  }

  function keep(read) {
    try {
      localStorage.setItem(KEY, JSON.stringify([...read]));
    } catch {
      // then it is known until the page is left
    }
  }

  function showTicks(read) {
    for (const link of document.querySelectorAll(".sidebar-tree a.reference")) {
      const name = new URL(link.href).pathname.split("/").slice(-2).join("/");
      link.classList.toggle("slamlab-was-read", read.has(name));
    }
  }

  const read = kept();
  showTicks(read);
  if (/^(notebooks|exercises)\//.test(page)) {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "slamlab-read";
    const tell = () => {
      button.textContent = read.has(page) ? "Read ✓" : "Mark as read";
      button.setAttribute("aria-pressed", String(read.has(page)));
    };
    button.addEventListener("click", () => {
      if (!read.delete(page)) read.add(page);
      keep(read);
      showTicks(read);
      tell();
    });
    tell();
    document.querySelector("article[role=main]")?.append(button);
  }
}
