"""The laboratory in the page: the package's motions, sixty frames a second, and what its reader asks for."""

import math
from dataclasses import asdict
from urllib.parse import urlencode

import numpy as np
import pytest
from visits import HTML

from duffing import Duffing, lyapunov_spectrum, paper
from duffing.flow import integrate

ADDRESS = "chapters/laboratory.html"
TIGHT = {"rtol": 1e-13, "atol": 1e-15}
# At the end of each period: x, v and the tangent's growth so far; and how many of the steps were in a creep.
MOTION = """([parameters, x, v, periods]) => {
  const motion = new laboratory.Motion(parameters, x, v), rows = [];
  let creeps = 0;
  for (let k = 0; k < periods; k++) {
    while (motion.step(motion.duration) < motion.duration) creeps += motion.creep > 0;
    motion.closePeriod();
    rows.push([motion.x, motion.v, motion.stretching]);
  }
  return [rows, creeps];
}"""
STATE = "() => ({time: laboratory.run.time, periods: laboratory.run.periods, x: laboratory.run.motion.x,"
STATE += " v: laboratory.run.motion.v, lambda: laboratory.run.lambda ?? null, goes: laboratory.goes,"
STATE += " points: laboratory.run.points.x.length})"


class Laboratory:
    """The page's laboratory with its controls by name."""

    def __init__(self, visit):
        self.visit, self.page = visit, visit.page

    @property
    def state(self):
        return self.visit.value(STATE)

    @property
    def says(self):
        return self.page.locator("#laboratory-says").inner_text()

    def field(self, name):
        return self.page.locator(f"#laboratory-{name}")

    def set(self, **values):
        for name, value in values.items():
            self.field(name).fill(str(value))
            self.field(name).press("Enter")

    def press(self, name):
        self.page.get_by_role("button", name=name, exact=True).click()

    def rests(self):
        """Wait until nothing runs any more."""
        self.page.wait_for_function("!laboratory.goes", timeout=60_000)


@pytest.fixture
def laboratory(opened):
    """laboratory(values): the page, opened by a link that carries the values, when it has computed what they ask."""

    def make(**values):
        fragment = f"#{urlencode(values)}" if values else ""
        lab = Laboratory(opened(None, ADDRESS + fragment))
        lab.rests()
        return lab

    return make


def parameters(osc):
    return {name: float(value) for name, value in asdict(osc).items()}


def motion(lab, osc, state, periods):
    rows, creeps = lab.visit.value(MOTION, [parameters(osc), *state, periods])
    return np.array(rows).T, creeps


CREEPS = [  # the last two pass through zero force in the creep: a tangent direction is annihilated
    (Duffing(alpha=0.3, p=0.3, mu=0.12), paper.START),
    (Duffing(alpha=0.5, p=0.5, mu=0.1), (1.05, 0.0)),
    (Duffing(alpha=0.5, p=0.3, mu=0.1), (1.05, 0.0)),
    (Duffing(p=0.1, mu=0.05), paper.START),
]
FLIES = [(Duffing(p=p, mu=mu), paper.START) for p in (0.1, 0.5, 1.0) for mu in (0.15, 0.27)]
OTHERS = [
    (Duffing(alpha=0.3, p=0.7, mu=0.3, omega=0.3, delta=1, gamma=0.5), (-0.3, 0.4)),
    (Duffing(p=0.1, mu=0.3, omega=3, delta=-4, gamma=2), paper.START),
    (Duffing(p=1.5, mu=0.2), paper.START),
    (Duffing(p=3, mu=0.2), paper.START),
    (Duffing(p=2, mu=0), (1, 0)),
    (Duffing(alpha=0, mu=0.2), paper.START),
]


def test_the_laboratory_follows_the_package_for_ten_periods(laboratory):
    lab = laboratory()
    for osc, state in CREEPS + FLIES + OTHERS:
        expected = integrate(osc, state, np.arange(11) * osc.period, tangents=1, **TIGHT)
        found, creeps = motion(lab, osc, state, 10)
        np.testing.assert_allclose(found[:2], expected.states[:, 1:, 0], rtol=0, atol=1e-8, err_msg=str(osc))
        growth = np.cumsum(expected.growth[0, :, 0])
        np.testing.assert_allclose(found[2], growth, rtol=0, atol=1e-6, err_msg=str(osc))
        assert (creeps > 0) or (osc, state) not in CREEPS, osc
    assert lab.visit.errors == [] and lab.visit.requests == []


@pytest.mark.parametrize(("p", "mu"), [(0.1, 0.05), (0.1, 0.15), (0.1, 0.25), (0.5, 0.2), (1.0, 0.1)])
def test_the_running_exponent_is_that_of_the_package(laboratory, p, mu):
    lab = laboratory(p=p, mu=mu, transient=40, periods=140)
    expected = lyapunov_spectrum(Duffing(p=p, mu=mu), paper.START, 100, 40, k=1, rtol=1e-12, atol=1e-14)
    assert lab.state["periods"] == 140 and lab.state["points"] == 100
    assert lab.state["lambda"] == pytest.approx(expected.exponents[0], abs=1e-6)
    shown = lab.page.locator("#laboratory-exponent").inner_text().replace("−", "-")
    assert float(shown) == pytest.approx(expected.exponents[0], abs=6e-5)


def test_a_chaotic_exponent_agrees_within_its_standard_error(laboratory):
    lab = laboratory(p=0.1, mu=0.27, transient=40, periods=240)
    expected = lyapunov_spectrum(Duffing(p=0.1, mu=0.27), paper.START, 200, 40, k=1)
    assert lab.state["lambda"] == pytest.approx(expected.exponents[0], abs=4 * math.sqrt(2) * expected.error[0])
    assert lab.state["lambda"] > 0


def test_a_frame_of_one_trajectory_is_done_in_less_than_a_sixtieth_of_a_second(laboratory):
    lab = laboratory(p=0.1, mu=0.27, periods=50)
    lab.press("Run")
    lab.visit.value("() => { laboratory.frames.length = 0; }")
    lab.page.wait_for_function("laboratory.frames.length >= 120")
    frames = sorted(lab.visit.value("laboratory.frames"))
    assert frames[len(frames) // 2] < 1000 / 60
    # The speed chosen is 2 periods a second, and is kept.
    began = lab.state["time"]
    lab.page.wait_for_timeout(2000)
    assert lab.state["time"] - began > 3


def test_the_page_answers_while_it_computes_as_fast_as_it_goes(laboratory):
    lab = laboratory(p=0.1, mu=0.05, periods=2)
    lab.field("speed").fill("8")
    assert lab.page.locator("#laboratory-pace").inner_text() == "as fast as it goes"
    lab.press("Run")
    lab.visit.value("() => { laboratory.frames.length = 0; }")
    began = lab.state["periods"]
    lab.page.wait_for_timeout(2000)
    assert lab.visit.value("laboratory.frames.length") > 20
    assert lab.state["periods"] - began > 20
    lab.press("Pause")
    assert lab.says == "Paused."


def test_it_pauses_out_of_sight_and_goes_on_in_sight(laboratory):
    lab = laboratory(periods=2)
    lab.press("Run")
    lab.page.set_viewport_size({"width": 1280, "height": 300})
    lab.visit.value("document.querySelector('h2:last-of-type, section:last-of-type h2').scrollIntoView()")
    lab.visit.value("scrollTo(0, document.body.scrollHeight)")
    lab.page.wait_for_function("!laboratory.goes")
    stands = lab.state["time"]
    lab.page.wait_for_timeout(500)
    assert lab.state["time"] == stands
    lab.visit.value("document.querySelector('#laboratory').scrollIntoView()")
    lab.page.wait_for_function("then => laboratory.run.time > then", arg=stands)
    lab.visit.value("""() => {
      Object.defineProperty(document, "hidden", { configurable: true, get: () => true });
      document.dispatchEvent(new Event("visibilitychange"));
    }""")
    assert not lab.state["goes"]
    lab.page.wait_for_timeout(100)
    stands = lab.state["time"]
    lab.page.wait_for_timeout(300)
    assert lab.state["time"] == stands


def test_who_asks_for_less_motion_sees_a_new_picture_once_a_second(laboratory):
    lab = laboratory(periods=2)
    seen = {}
    for wish in ("reduce", "no-preference"):
        lab.page.emulate_media(reduced_motion=wish)
        lab.set(x=0.45)
        seen[wish] = lab.visit.value("""async () => {
          const picture = document.querySelector("#laboratory-phase"), pictures = new Set();
          for (const end = performance.now() + 3000; performance.now() < end;) {
            await new Promise(requestAnimationFrame);
            pictures.add(picture.toDataURL());
          }
          return pictures.size;
        }""")
    assert 2 <= seen["reduce"] <= 5
    assert seen["no-preference"] > 15


def test_a_link_carries_the_state(laboratory, opened):
    values = {"alpha": 0.2, "p": 0.5, "mu": 0.21, "omega": 1.1, "delta": -1.2, "gamma": 0.9, "x": -0.3, "v": 0.25}
    lab = laboratory(periods=1)
    lab.set(**values, transient=3)
    lab.press("Pause")
    for _ in range(7):
        lab.press("One period")
    lab.press("Link to this state")
    assert "now carries this state" in lab.says
    before, address = lab.state, lab.page.url
    other = Laboratory(opened(None, ADDRESS + address[address.index("#") :]))
    other.rests()
    assert other.state == before and before["periods"] >= 7
    assert {name: float(other.field(name).input_value()) for name in values} == values
    osc = Duffing(**{name: value for name, value in values.items() if name not in "xv"})
    ends = integrate(osc, (-0.3, 0.25), np.arange(before["periods"] + 1) * osc.period, **TIGHT).states[:, -1, 0]
    np.testing.assert_allclose([before["x"], before["v"]], ends, atol=1e-8)


def test_a_link_that_names_a_few_values_leaves_the_others_at_the_papers_and_nothing_out(laboratory):
    lab = laboratory(mu=0.2, periods=4)
    names = ("alpha", "p", "mu", "omega", "delta", "gamma", "x", "v", "transient")
    assert [float(lab.field(name).input_value()) for name in names] == [0.1, 0.1, 0.2, 1, -1, 1, *paper.START, 0]
    assert lab.state["points"] == lab.state["periods"] == 4


def test_the_initial_condition_is_set_by_a_click_and_by_keys(laboratory):
    lab = laboratory(periods=1)
    for name in ("phase", "strobe"):
        box = lab.field(name).bounding_box()
        lab.field(name).click(position={"x": box["width"] * 0.75, "y": box["height"] * 0.3})
        lab.press("Pause")
        x, v = (float(lab.field(key).input_value()) for key in "xv")
        assert 0.4 < x < 1.2 and 0.2 < v < 1.2
        assert lab.visit.value("[laboratory.run.trail.x[0], laboratory.run.trail.v[0]]") == [x, v]
        lab.set(x=0.45, v=0.1)
    lab.field("x").press("ArrowUp")
    lab.field("v").press("PageDown")
    assert lab.visit.value("[laboratory.run.trail.x[0], laboratory.run.trail.v[0]]") == [0.46, 0]


def test_the_present_state_becomes_the_initial_condition(laboratory):
    lab = laboratory(p=0.5, mu=0.2, periods=5)
    ends = lab.state
    lab.press("Start from the present state")
    lab.press("Pause")
    assert lab.visit.value("[laboratory.run.trail.x[0], laboratory.run.trail.v[0]]") == [ends["x"], ends["v"]]


@pytest.mark.parametrize(
    ("name", "text", "sentence"),
    [
        ("alpha", "-0.1", "alpha = -0.1: must be a finite number ≥ 0."),
        ("p", "0", "p = 0: must be a number from 0.02 to 10."),
        ("mu", "strong", "mu = strong: must be a finite number."),
        ("omega", "0", "omega = 0: must be a finite number > 0."),
        ("delta", "1e999", "delta = 1e999: must be a finite number."),
        ("gamma", "", "gamma = (nothing): must be a finite number."),
        ("x", "0,45", "x = 0,45: must be a finite number."),
        ("v", "<b>1</b>", "v = <b>1</b>: must be a finite number."),
        ("transient", "1.5", "transient = 1.5: must be a whole number from 0 to 10000."),
    ],
)
def test_a_wrong_value_is_named_with_what_is_allowed(laboratory, name, text, sentence):
    lab = laboratory(periods=1)
    before = lab.state
    lab.set(**{name: text})
    assert lab.says == sentence
    assert lab.field(name).get_attribute("aria-invalid") == "true"
    lab.press("Run")
    assert lab.state == before and lab.says == sentence
    lab.set(**{name: "1"})
    assert lab.says == "" and lab.field(name).get_attribute("aria-invalid") is None
    assert lab.state["goes"]


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"p": "-1"}, "The link is not taken as it stands. p = -1: must be a number from 0.02 to 10."),
        ({"beta": "1"}, "The link is not taken as it stands. beta = 1: the name must be one of alpha, p, mu"),
        ({"periods": "1e9"}, "The link is not taken as it stands. periods = 1e9: must be a whole number"),
        ({"gamma": "-1", "x": "2", "periods": "5"}, "After 0."),
    ],
)
def test_a_link_that_cannot_be_followed_says_why(laboratory, values, sentence):
    lab = laboratory(**values)
    assert lab.says.startswith(sentence)
    assert not lab.state["goes"]
    assert lab.visit.errors == []


def test_a_solution_that_leaves_every_bound_is_named(laboratory):
    lab = laboratory(gamma=-1, x=2, periods=5)
    assert "the solution leaves every bound: the computation ends here." in lab.says


def test_the_buttons_load_the_figures_of_the_paper(laboratory):
    lab = laboratory(periods=1)
    after = round(paper.SETTLED / paper.OSCILLATOR.period)
    for name, mu in (("Fig. 5a", paper.MU_CHAOTIC), ("Fig. 5b", paper.MU_REGULAR)):
        lab.press(name)
        lab.rests()
        assert lab.state["periods"] == paper.PERIODS and lab.state["points"] == paper.PERIODS - after
        assert float(lab.field("mu").input_value()) == mu
        wells = lab.visit.value("new Set(laboratory.run.points.x.map(Math.sign)).size")
        assert wells == (2 if mu == paper.MU_CHAOTIC else 1)


def test_a_scan_over_mu_draws_the_exponents_of_figure_4b(laboratory):
    lab = laboratory(periods=1)
    lab.press("Fig. 4b")
    lab.rests()
    assert lab.says == "The scan is finished: 40 values of μ."
    mu, exponents = lab.visit.value("[laboratory.exponents.mu, laboratory.exponents.lambda]")
    regular = np.array(mu) < 0.195
    family = Duffing(p=1.0, mu=np.array(mu)[regular])
    expected = lyapunov_spectrum(family, paper.START, paper.PERIODS, 0, k=1).exponents[0]
    np.testing.assert_allclose(np.array(exponents)[regular], expected, atol=1e-6)
    assert len(mu) == 40 and regular.sum() == 19


@pytest.mark.parametrize(("width", "theme"), [(360, "light"), (360, "dark"), (1280, "dark")])
def test_every_panel_is_drawn_in_the_colours_of_the_theme(laboratory, width, theme):
    lab = laboratory(periods=30)
    lab.visit.look(width=width, theme=theme)
    assert lab.visit.value("document.documentElement.scrollWidth") <= width
    for name in ("phase", "strobe", "history", "running", "against"):
        # The axes' ink, the most frequent grey: light on dark, dark on light.
        grey = lab.visit.value(
            """name => {
              const picture = document.querySelector(`#laboratory-${name}`);
              const { data } = picture.getContext("2d").getImageData(0, 0, picture.width, picture.height);
              const seen = {};
              for (let i = 0; i < data.length; i += 4) {
                const grey = Math.abs(data[i] - data[i + 2]) < 40;
                if (grey && data[i + 3] > 250) seen[data[i]] = (seen[data[i]] ?? 0) + 1;
              }
              const [colour] = Object.entries(seen).sort((a, b) => b[1] - a[1])[0];
              return Number(colour);
            }""",
            name,
        )
        assert (grey > 150) == (theme == "dark"), name


def test_the_page_of_the_laboratory_is_light():
    assert (HTML / ADDRESS).stat().st_size < 200_000
