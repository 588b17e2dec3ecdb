// Sliders of a lesson's figures: each value has a picture that was drawn beforehand. Without scripts the
// picture of the first values stays.
{
  const made = (tag, more) => Object.assign(document.createElement(tag), more);

  function control({ name, kind, first, words }, changed) {
    const label = made("label", {}), said = made("output", { textContent: words[first] });
    label.append(name.replaceAll("_", " ") + " ");
    if (kind == "range") {
      const slider = made("input", { type: "range", min: 0, max: words.length - 1, step: 1, value: first });
      slider.setAttribute("aria-valuetext", words[first]);
      slider.addEventListener("input", () => {
        said.textContent = words[slider.value];
        slider.setAttribute("aria-valuetext", words[slider.value]);
        changed(Number(slider.value));
      });
      label.append(slider, " ", said);
      return { label, reset: () => { slider.value = first; said.textContent = words[first]; } };
    }
    const choice = made("select", {});
    words.forEach((word, at) => choice.append(new Option(word, at, at == first, at == first)));
    choice.addEventListener("change", () => changed(Number(choice.value)));
    label.append(choice);
    return { label, reset: () => { choice.value = first; } };
  }

  for (const place of document.querySelectorAll(".slamlab-sliders")) {
    const { folder, controls } = JSON.parse(place.querySelector("script").textContent);
    const picture = place.querySelector("img"), row = made("div", { className: "slamlab-controls" });
    const all = controls.map((each) => control(each, (at) => {
      // one control moves at a time, the others stand as at first
      for (const other of all) if (other !== mine()) other.reset();
      picture.src = folder + each.pictures[at];
      picture.alt = each.alts[at];
    }));
    let current = null;
    function mine() { return current; }
    all.forEach((each) => {
      for (const kind of ["input", "change"]) {
        each.label.addEventListener(kind, () => { current = each; }, { capture: true });
      }
      row.append(each.label);
    });
    place.prepend(row);
    if (controls.length > 1) {
      row.append(made("small", { textContent: "Here one control moves at a time; in the notebook, all." }));
    }
  }
}
