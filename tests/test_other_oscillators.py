"""Every figure of the paper for other oscillators: "change it yourself" is a promise.

Scaling is the exact check: with lengths in units of sqrt(-delta/gamma) and times in units of 1/sqrt(-delta) every
oscillator is one with delta = -1, gamma = 1. With delta = -4, gamma = 4 the units are powers of two, so that at p = 1
the very same digits come out, chaos included.
"""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.colors import to_hex

from book.figures import paper as figures
from book.figures import small_p as figures_small_p
from book.studies import missing_parameters, reproduction, small_p
from duffing import Duffing, critical_amplitude, homoclinic_orbit, paper
from duffing.manifolds.curves import stable_manifold, unstable_manifold

OTHER = Duffing(alpha=0.25, p=0.4, mu=0.8, omega=0.7, delta=-2.0, gamma=0.5)
# LINEAR with another unit of length (1), of time (1/2) and so of velocity (2) and of forcing (4).
LINEAR = Duffing(alpha=0.1, p=1.0, mu=0.0, omega=1.0)
SCALED = replace(LINEAR, alpha=0.2, omega=2.0, delta=-4.0, gamma=4.0)
SCALED_START = (0.45, 0.2)


def fig1a():
    x = np.linspace(-5, 5, 201)
    return figures.fig1a(x, OTHER.potential(x))


def fig1b():
    v, p = np.linspace(-3, 3, 101), np.array([0.2, 0.4, 1.2])
    return figures.fig1b(v, p, replace(OTHER, alpha=1.0, p=p[:, None]).damping(v))


def fig2():
    forced = replace(OTHER, p=1.0)
    forced = replace(forced, mu=2 * critical_amplitude(forced))
    loops = [homoclinic_orbit(OTHER, np.linspace(-9, 9, 101), side) for side in (1, -1)]
    return figures.fig2(loops, [("above", [stable_manifold(forced)], [unstable_manifold(forced)])])


def fig3a():
    p, omega = np.array([0.2, 0.4, 1.2]), np.linspace(0.2, 3, 50)
    return figures.fig3a(omega, p, reproduction.critical_ratio(p, omega, osc=OTHER))


def fig3b():
    p = np.array([0.4, 1.2])
    onset = reproduction.onsets(p, step=0.2, last=2.0, osc=OTHER, start=(1.0, 0.0), threshold=0.05)
    return figures.fig3b(p, critical_amplitude(replace(OTHER, p=p)), p, onset)


def fig4():
    mu, exponent = reproduction.exponent_curve(0.4, step=0.1, last=2.0, osc=OTHER, start=(1.0, 0.0))
    return figures.fig4(mu, exponent, 0.4, paper.THRESHOLD)


def fig5():
    motion = reproduction.motion(1.2, osc=OTHER, end=200.0, start=(1.0, 0.0))
    early, late = (motion.part(*span, OTHER.period) for span in ((0.0, 100.0), (100.0, 200.0)))
    return figures.fig5(early[0], late[0], early[1], late[1], settled=100.0)


def fig6():
    motion = reproduction.motion(1.2, osc=OTHER, end=200.0, start=(1.0, 0.0))
    return figures.fig6(motion.t, motion.path[0], 100.0)


def resolved():
    curve = reproduction.exponent_curve(0.4, step=0.2, last=2.0, osc=OTHER)
    return figures_small_p.resolved_exponents(
        *curve, *small_p.exact_curve(0.4, step=0.2, last=2.0, osc=OTHER), paper.THRESHOLD
    )


def many_starts():
    window = small_p.window(columns=2, rows=2, step=0.2, first=0.8, last=1.2, periods=50, osc=OTHER)
    return figures_small_p.many_starts(*window, *reproduction.exponent_curve(0.4, step=0.2, last=2.0, osc=OTHER))


def dry_limit():
    p, mu = (0.2, 0.4), (0.2, 0.4, 0.8, 1.2, 1.6)
    return figures_small_p.dry_limit(np.array(p), small_p.dry_limit(p, mu, osc=OTHER)[0], np.array(mu))


FIGURES = (fig1a, fig1b, fig2, fig3a, fig3b, fig4, fig5, fig6, resolved, many_starts, dry_limit)


@pytest.mark.parametrize("draw", FIGURES)
def test_a_figure_for_another_oscillator_shows_all_its_data(draw):
    fig = draw()
    assert fig.axes
    for axes in fig.axes:
        horizontal, vertical = sorted(axes.get_xlim()), sorted(axes.get_ylim())
        curves = [line for line in axes.lines if line.get_transform() == axes.transData]  # no lines across the axes
        points = np.concatenate([line.get_xydata() for line in curves])
        assert np.isfinite(points).all()
        inside = (points >= (horizontal[0], vertical[0])) & (points <= (horizontal[1], vertical[1]))
        # W^S and W^U go on for ever, and a start can lie outside the forcings that a figure shows.
        whole = {fig2: 0.5, many_starts: 0.5}.get(draw, 1.0)
        assert inside.all(axis=1).mean() >= whole
    assert fig.image("svg")


def test_the_loops_of_another_oscillator_fill_their_picture():
    loop = homoclinic_orbit(OTHER, np.linspace(-9, 9, 1001))
    axes = fig2().axes[0]
    for values, (low, high) in zip(loop, (axes.get_xlim(), axes.get_ylim()), strict=True):
        assert -low == high
        assert 0.6 < np.max(np.abs(values)) / high < 0.9


def test_the_exponent_curve_of_a_scaled_oscillator_is_the_scaled_curve():
    mu, exponent = reproduction.exponent_curve(1.0, step=0.05, last=0.3, osc=LINEAR)
    scaled_mu, scaled = reproduction.exponent_curve(1.0, step=0.2, last=1.2, osc=SCALED, start=SCALED_START)
    np.testing.assert_allclose(scaled_mu, 4 * mu, rtol=1e-15)
    # The paths are the same to the last bit. The tangent vector begins with length one in either unit of velocity,
    # which differ by two; a logarithm spread over the whole time.
    assert np.all(np.abs(scaled - 2 * exponent) < np.log(2) / (paper.PERIODS * SCALED.period))


def test_the_onset_of_a_scaled_oscillator_is_the_scaled_onset():
    (onset,) = reproduction.onsets((1.0,), step=0.05, osc=LINEAR)
    threshold = 2 * paper.THRESHOLD
    (scaled,) = reproduction.onsets((1.0,), step=0.2, last=1.4, osc=SCALED, start=SCALED_START, threshold=threshold)
    assert scaled == pytest.approx(4 * onset, rel=1e-15)


def test_the_motion_of_a_scaled_oscillator_is_the_scaled_motion():
    motion = reproduction.motion(0.25, osc=LINEAR, end=100.0)
    scaled = reproduction.motion(1.0, osc=SCALED, end=50.0, start=SCALED_START)
    np.testing.assert_array_equal(scaled.t, motion.t / 2)
    np.testing.assert_array_equal(scaled.path, motion.path * [[1.0], [2.0]])


def test_starts_cover_both_wells_of_any_double_well():
    x, v = small_p.starts(osc=OTHER)  # wells at +-2, and -delta/sqrt(gamma) = 2.83
    assert (x.min(), x.max()) == pytest.approx((-2.8, 2.8))
    assert v.max() == pytest.approx(0.6 * 2 * np.sqrt(2))
    with pytest.raises(ValueError, match=r"^delta = 1.0: must be < 0"):
        small_p.starts(osc=Duffing(delta=1.0))


def test_the_ratio_of_equation_13_needs_no_damping():
    p, omega = (0.5, 1.0), (1.0, 2.0)
    undamped = reproduction.critical_ratio(p, omega, osc=Duffing(alpha=0.0))
    np.testing.assert_array_equal(undamped, reproduction.critical_ratio(p, omega, osc=Duffing(alpha=3.0)))


@pytest.mark.parametrize("step", [0.05, 0.1, 0.25])
def test_exponents_that_the_book_does_not_use_are_told_apart(step):
    looks = [figures.line_of(p) for p in step * np.arange(1, 13)]
    assert len({(to_hex(look["color"]), str(look["linestyle"])) for look in looks}) == 12
    assert len({look["label"] for look in looks}) == 12


def test_a_small_grid_of_mu_is_not_rounded_away():
    np.testing.assert_allclose(reproduction.mu_grid(1e-7, 4e-7), np.arange(5) * 1e-7, rtol=1e-12)


@pytest.mark.parametrize(
    ("call", "complaint"),
    [
        (lambda: reproduction.mu_grid(0), r"^step = 0: must be a finite number > 0"),
        (lambda: reproduction.mu_grid(0.1, last=0.05), r"^step = 0.1: must be at most last = 0.05"),
        (lambda: reproduction.motion(0.2, every=0), r"^every = 0: must be a whole number >= 1"),
        (lambda: reproduction.motion(0.2, every=3), r"^every = 3: must divide 500"),
        (lambda: reproduction.motion(0.2, end=1.0), r"^end = 1.0: must be at least a period"),
        (lambda: missing_parameters.plane(alpha_step=0.0), r"^alpha_step = 0.0: must be"),
    ],
)
def test_bad_grids_and_lengths_are_named(call, complaint):
    with pytest.raises(ValueError, match=complaint):
        call()
