// HTML of the visible slide: text, formulas and pictures, without hidden content (later steps, notes, folded
// code) and controls. The server sanitises it again.

const ALONE = new Set(["SCRIPT", "STYLE", "BUTTON", "INPUT", "SELECT", "TEXTAREA", "TEMPLATE", "IFRAME", "NOSCRIPT"]);
const NOT_SHOWN = ".jp-InputPrompt, .jp-OutputPrompt, .jp-Collapser, .jp-InternalAnchorLink, .jp-CellFooter, "
  + ".jp-Toolbar, .jp-Cell-Placeholder, .slamlab-dead, "
  + ".widget-slider, .widget-dropdown, .widget-play, mjx-assistive-mml";
const KEPT = new Set(("H1 H2 H3 H4 H5 H6 P UL OL LI DL DT DD TABLE THEAD TBODY TR TH TD CAPTION PRE CODE BLOCKQUOTE "
  + "STRONG EM B I U S SUB SUP BR HR FIGURE FIGCAPTION DIV KBD").split(" "));
const SPANS = ["colspan", "rowspan", "start", "scope"];

function seen(element) {
  const style = getComputedStyle(element);
  return style.display !== "none" && style.visibility === "visible" && style.opacity !== "0";
}

function pictureOf(source, width, height) {
  const canvas = document.createElement("canvas");
  Object.assign(canvas, { width, height });
  const pen = canvas.getContext("2d");
  pen.fillStyle = "#ffffff";
  pen.fillRect(0, 0, width, height);
  pen.drawImage(source, 0, 0, width, height);
  return canvas.toDataURL("image/png");
}

async function pictureOfDrawing(svg) {
  const { width, height } = svg.getBoundingClientRect();
  const copy = svg.cloneNode(true);
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("width", width);
  copy.setAttribute("height", height);
  const image = new Image();
  image.src = `data:image/svg+xml,${encodeURIComponent(new XMLSerializer().serializeToString(copy))}`;
  await image.decode();
  return pictureOf(image, 2 * Math.ceil(width), 2 * Math.ceil(height));
}

class Copy {
  constructor(sourceOf) {
    this.sourceOf = sourceOf; // full text of an editor, part of which may not be rendered
    this.made = document.implementation.createHTMLDocument(""); // in which pictures are not loaded
  }

  element(tag, text) {
    const element = this.made.createElement(tag);
    if (text !== undefined) element.textContent = text;
    return element;
  }

  picture(alt, address) {
    const picture = this.element("img");
    picture.setAttribute("alt", alt ?? "");
    picture.setAttribute("src", address);
    return picture;
  }

  async special(node) {
    if (node.matches(".cm-editor")) {
      const block = this.element("pre");
      block.append(this.element("code", this.sourceOf(node)));
      return block;
    }
    if (node.tagName === "MJX-CONTAINER") {
      const formula = node.querySelector("math");
      if (!formula) return this.element("code", node.getAttribute("aria-label") ?? "");
      const copy = this.made.importNode(formula, true);
      if (node.hasAttribute("display")) copy.setAttribute("display", "block");
      return copy;
    }
    if (node.tagName === "math") return this.made.importNode(node, true);
    if (node.tagName === "IMG") {
      if (!node.naturalWidth) return null; // not loaded
      const plain = /^data:image\/(png|jpeg|gif|webp);base64,/.test(node.src);
      return this.picture(node.alt, plain ? node.src : pictureOf(node, node.naturalWidth, node.naturalHeight));
    }
    const named = node.getAttribute("aria-label") ?? node.closest("[aria-label]")?.getAttribute("aria-label");
    if (node.tagName === "CANVAS") {
      return node.width && node.height ? this.picture(named, pictureOf(node, node.width, node.height)) : null;
    }
    if (node.tagName === "svg") return this.picture(named, await pictureOfDrawing(node));
    return undefined;
  }

  async into(target, node) {
    for (const child of node.childNodes) {
      if (child.nodeType === Node.TEXT_NODE) target.append(child.data);
      if (child.nodeType !== Node.ELEMENT_NODE) continue;
      if (ALONE.has(child.tagName) || child.matches(NOT_SHOWN) || !seen(child)) continue;
      const special = await this.special(child).catch(() => null); // for example a picture of another site
      if (special !== undefined) {
        if (special) target.append(special);
      } else if (KEPT.has(child.tagName)) {
        const copy = this.element(child.tagName);
        for (const name of SPANS) if (child.hasAttribute(name)) copy.setAttribute(name, child.getAttribute(name));
        await this.into(copy, child);
        // omit JupyterLab's nested boxes
        if (child.tagName !== "DIV") target.append(copy);
        else if ([...copy.children].some((inner) => inner.tagName !== "SPAN")) target.append(...copy.childNodes);
        else if (copy.textContent.trim()) target.append(copy);
      } else {
        await this.into(target, child);
      }
    }
    return target;
  }
}

// HTML of the visible content of an element; sourceOf(editor) returns an editor's text.
export async function copyOf(element, sourceOf) {
  const copy = new Copy(sourceOf);
  return (await copy.into(copy.element("div"), element)).innerHTML.trim();
}

export { seen };
