"""Everyone can read every page: light or dark, on a telephone, with the keyboard, with a screen reader."""

import io
from importlib.resources import files

import matplotlib.image
import numpy as np
import pytest

AXE = files("axe_playwright_python").joinpath("axe.min.js").read_text(encoding="utf-8")
PHONE, DESK = 390, 1280
PAPER = 841  # a line of the PDF (tools/pdf.py): A4 less its margins, at 80 per cent
# Right edges beyond the screen, except inside a box that scrolls by itself.
TOO_WIDE = """() => {
  const scrolls = element => element && (/auto|scroll|hidden/.test(getComputedStyle(element).overflowX)
    ? element != document.body && element != document.documentElement : scrolls(element.parentElement));
  return [...document.querySelectorAll("main *")]
    .filter(element => element.getBoundingClientRect().right > innerWidth + 1 && !scrolls(element))
    .map(element => element.outerHTML.slice(0, 100));
}"""


def luminance(pixels):
    """Relative luminance (WCAG 2) of sRGB values in 0 to 1."""
    linear = np.where(pixels <= 0.04045, pixels / 12.92, ((pixels + 0.055) / 1.055) ** 2.4)
    return linear @ [0.2126, 0.7152, 0.0722]


def ground_and_contrast(picture):
    """Luminance of a picture's ground as seen on the page, and every pixel's contrast with it (WCAG 2: 1 to 21)."""
    light = luminance(matplotlib.image.imread(io.BytesIO(picture.screenshot()))[..., :3])
    ground = np.median(np.concatenate([light[:3].ravel(), light[-3:].ravel()]))
    return ground, np.maximum(light + 0.05, ground + 0.05) / np.minimum(light + 0.05, ground + 0.05)


def test_what_stands_out_in_a_figure_by_day_stands_out_by_night(visit):
    seen = {}
    for theme in ("light", "dark"):
        visit.look(theme=theme)
        seen[theme] = [ground_and_contrast(picture) for picture in visit.page.locator("main figure img").all()]
    for (paper, by_day), (night, by_night) in zip(seen["light"], seen["dark"], strict=True):
        assert paper > 0.8 and night < 0.1
        ink = by_day > 7
        assert ink.any()
        assert np.mean(by_night[ink] > 4.5) > 0.95


def test_no_page_scrolls_sideways_on_a_telephone(visit):
    visit.look(width=PHONE)
    assert visit.value("document.documentElement.scrollWidth") == PHONE
    assert visit.value(TOO_WIDE) == []


def test_no_table_is_wider_than_the_paper(visit):
    visit.page.emulate_media(media="print")
    visit.look(width=PAPER)
    too_wide = "tables => tables.filter(t => t.offsetWidth > t.parentElement.clientWidth).map(t => t.textContent)"
    found = visit.page.eval_on_selector_all(".bd-content table", too_wide)
    visit.page.emulate_media(media="screen")
    assert found == []


@pytest.mark.parametrize(("width", "theme"), [(DESK, "light"), (PHONE, "light"), (DESK, "dark")])
def test_axe_finds_nothing(visit, width, theme):
    visit.look(width=width, theme=theme)
    visit.value(AXE)
    # The theme alters colours alone: in the dark only these are looked at again.
    rules = "{resultTypes: ['violations']}" if theme == "light" else "{runOnly: ['color-contrast']}"
    found = visit.value(f"axe.run(document, {rules})")["violations"]
    assert [(rule["id"], rule["impact"], [node["html"][:100] for node in rule["nodes"]]) for rule in found] == []


def test_the_keyboard_reaches_the_content_the_search_and_the_sidebar(visit):
    visit.look()
    visit.value("() => { document.activeElement.blur(); getSelection().removeAllRanges(); scrollTo(0, 0); }")
    seen = []
    for _ in range(200):  # more links than the sidebar of any page
        visit.page.keyboard.press("Tab")
        seen.append(
            visit.value("""() => {
              const here = document.activeElement, inside = where => Boolean(here.closest(where));
              return inside("#pst-skip-link") ? "skip link" : inside(".search-button__button") ? "search"
                : inside(".bd-sidebar-primary nav") ? "sidebar" : inside("main") ? "content" : "other"; }""")
        )
    assert {"search", "sidebar", "content"} <= set(seen)


def test_the_skip_link_comes_first_and_leads_to_the_content(opened):
    visit = opened(None, "chapters/model.html")
    visit.page.keyboard.press("Tab")
    assert visit.value("Boolean(document.activeElement.closest('#pst-skip-link'))")
    visit.page.keyboard.press("Enter")
    visit.page.keyboard.press("Tab")
    assert visit.value("Boolean(document.activeElement.closest('main'))")


def test_every_picture_says_what_is_seen_and_not_its_caption(visit):
    pictures = visit.value("""() => [...document.querySelectorAll("figure")].map(figure => [
        figure.querySelector("img, svg[role=img]")?.getAttribute("alt")
          ?? figure.querySelector("svg[role=img]")?.getAttribute("aria-label") ?? "",
        figure.querySelector(".caption-text")?.textContent ?? ""])""")
    for alternative, caption in pictures:
        assert len(alternative) > 20, caption
        assert alternative.strip() != caption.strip()


def test_no_slider_is_too_short_for_a_finger(visit):
    visit.look(width=PHONE)
    sliders = visit.page.locator("input[type=range]").all()
    assert all(slider.bounding_box()["width"] > 150 for slider in sliders)
