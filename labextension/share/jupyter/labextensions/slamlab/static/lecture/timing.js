// Timing of a lecture: sections begin at slides with planned minutes.

// Sections of slides {title, minutes}: [{title, slide, minutes, from, to}], from and to in minutes.
function sectionsOf(slides) {
  const sections = [];
  let from = 0;
  slides.forEach(({ title, minutes }, slide) => {
    if (!(minutes > 0)) return;
    sections.push({ title, slide, minutes, from, to: from + minutes });
    from += minutes;
  });
  return sections;
}

// Section of a slide; undefined before the first one.
const sectionAt = (sections, slide) => sections.findLast((section) => section.slide <= slide);

// First and last slide of a slide's section; the slide itself if nothing is planned.
export function slidesOfSection(slides, slide) {
  const sections = sectionsOf(slides);
  const section = sectionAt(sections, slide);
  if (!sections.length) return [slide, slide];
  const next = sections.find((one) => one.slide > slide);
  return [section?.slide ?? 0, (next?.slide ?? slides.length) - 1];
}

// Planned start of a slide's section [min].
export const plannedAt = (slides, slide) => sectionAt(sectionsOf(slides), slide)?.from ?? 0;

// Text about the time at a slide, `elapsed` minutes after the start.
export function planAt(slides, slide, elapsed) {
  const sections = sectionsOf(slides);
  if (!sections.length) return "no minutes are planned";
  const whole = sections.at(-1).to;
  const section = sectionAt(sections, slide);
  if (!section) return `${whole} min planned`;
  const late = Math.floor(elapsed - section.to), early = Math.floor(section.from - elapsed);
  const off = late >= 1 ? `, ${late} min behind` : early >= 1 ? `, ${early} min ahead` : "";
  return `section ${section.from}–${section.to} of ${whole} min${off}`;
}

// Seconds as minutes and seconds.
export function clockFace(seconds) {
  const whole = Math.max(0, Math.floor(seconds));
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
}
