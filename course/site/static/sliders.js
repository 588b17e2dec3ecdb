// Sliders of a lesson's figures: each value has a picture that was drawn beforehand. Without scripts the
// picture of the first values stays.
{
  const made = (tag, more) => Object.assign(document.createElement(tag), more);

  // a labelled slider or choice; move(at) calls nobody
  function control({ name, kind, first, words }, changed) {
    const label = made("label", { textContent: `${name.replaceAll("_", " ")} ` });
    if (kind == "range") {
      const slider = made("input", { type: "range", min: 0, max: words.length - 1, step: 1 });
      const said = made("output", {});
      const move = (at) => {
        slider.value = at;
        said.textContent = words[at];
        slider.setAttribute("aria-valuetext", words[at]);
      };
      slider.addEventListener("input", () => {
        move(slider.value);
        changed(Number(slider.value));
      });
      label.append(slider, said);
      move(first);
      return { label, move };
    }
    const choice = made("select", {});
    words.forEach((word, at) => choice.append(new Option(word, at)));
    choice.addEventListener("change", () => changed(Number(choice.value)));
    label.append(choice);
    const move = (at) => { choice.value = at; };
    move(first);
    return { label, move };
  }

  for (const place of document.querySelectorAll(".slamlab-sliders")) {
    const { folder, controls } = JSON.parse(place.querySelector("script").textContent);
    const picture = place.querySelector("img"), row = made("div", { className: "slamlab-controls" });
    const all = controls.map(({ pictures, alts, ...each }, mine) => control(each, (at) => {
      // one moves at a time, the others stand as at first
      all.forEach(({ move }, other) => other == mine || move(controls[other].first));
      Object.assign(picture, { src: folder + pictures[at], alt: alts[at] });
    }));
    row.append(...all.map(({ label }) => label));
    if (all.length > 1) {
      row.append(made("small", { textContent: "Here one moves at a time; in the notebook all do." }));
    }
    place.prepend(row);
  }
}
