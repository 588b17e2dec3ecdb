"""The site describes every public name of the library once, and no private one."""

import importlib

import slamlab
from course.site import formula_index, preparing, public_names

PAGES = preparing._modules()
DOCUMENTED = {
    (module, name): each
    for modules in public_names.by_component().values()
    for module, names in modules.items()
    for name, each in names.items()
}


def test_each_component_with_public_names_has_a_page_and_internal_ones_have_none():
    components = {name.removeprefix("api/").removesuffix(".md") for name in PAGES} - {"index"}
    assert components == set(public_names.by_component())
    assert components.isdisjoint(public_names.INTERNAL)
    assert all(f"\n{component}\n" in PAGES["api/index.md"] for component in components)
    documented = [*components, *public_names.INTERNAL]
    assert all(f"\n{component}  " in slamlab.__doc__ for component in documented)


def test_each_documented_name_is_exported():
    for module, name in DOCUMENTED:
        exporting = importlib.import_module(module)
        public = getattr(exporting, "__all__", [n for n in vars(exporting) if n[0] != "_"])
        assert name in public


def test_every_public_name_of_a_component_is_documented():
    for component in public_names.by_component():
        exporting = importlib.import_module(f"slamlab.{component}")
        for name in getattr(exporting, "__all__", ()):
            documented = any(getattr(exporting, name) is each for each in DOCUMENTED.values())
            assert documented, name
            assert name in PAGES[f"api/{component}.md"] or documented


def test_no_name_is_documented_twice():
    assert len({id(each) for each in DOCUMENTED.values()}) == len(DOCUMENTED)


def test_a_formula_links_the_page_of_a_public_function_and_of_no_other():
    assert public_names.page_of("slamlab.models.motion", "f_odometry") == "models"
    assert public_names.page_of("slamlab.posegraph.edge_error", "error") is None
    page = formula_index.page()
    assert "[`slamlab.models.motion.f_odometry`](api/models.md)" in page
    assert "[`slamlab.posegraph.edge_error.error`]" not in page


def test_each_guide_is_a_page():
    assert set(preparing.GUIDES) == {path.stem for path in (preparing.ROOT / "docs").glob("*.md")}
