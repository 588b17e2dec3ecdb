"""What a student sees in JupyterLab."""


def test_the_course_opens_without_an_error_and_asks_no_other_machine_for_anything(visit):
    visit.open("00_start_here.ipynb")
    visit.page.wait_for_selector(".jp-RenderedHTML img")
    assert visit.errors == []
    assert visit.abroad == []
