"""The paper's own figures."""

from dataclasses import replace

import numpy as np

from book.figures import paper as figures
from book.studies import reproduction
from duffing import Duffing, critical_amplitude, homoclinic_orbit, paper
from duffing.paper import P_ONSET

from .case import Case, to_roundoff


def _potential():
    x = np.linspace(-1.8, 1.8, 91)
    return {"x": x, "potential": Duffing().potential(x)}


def _damping():
    v, p = np.linspace(-1.5, 1.5, 91), np.array([0.1, 0.3, 0.5, 1.0, 2.0, 3.0])
    return {"v": v, "p": p, "damping": Duffing(alpha=1.0, p=p[:, None]).damping(v)}


def _ratio():
    p, omega = np.array([0.1, 0.3, 0.5, 1.0, 2.0, 3.0]), np.linspace(0.1, 2.6, 60)
    return {"p": p, "omega": omega, "ratio": reproduction.critical_ratio(p, omega)}


def _manifolds():
    from book.studies import homoclinic_orbits as study  # all other figures stand on the core alone

    osc = Duffing(alpha=0.1, p=1.0)
    data = {}
    for ratio in (0.5, 2.0):
        forced = replace(osc, mu=ratio * critical_amplitude(osc))
        _, stable, unstable, point = study.manifolds(forced, ratio, length=6.0)
        for kind, curves in (("stable", stable), ("unstable", unstable)):
            data |= {f"{kind} {branch} {ratio}": evenly(curve) for branch, curve in zip((1, -1), curves, strict=True)}
        data[f"point {ratio}"] = np.array([np.nan, np.nan]) if point is None else point
    return data


def evenly(curve, points=200):
    """A curve (2, n) at equal steps of its length, so that the spacing chosen along it does not count."""
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(curve, axis=1)))])
    # The first, uncrowded part: lobes stretch errors like chaos does.
    at = np.linspace(0.0, min(length[-1], 6.0), points)
    return np.array([np.interp(at, length, row) for row in curve])


def _draw_manifolds(data):
    t = np.linspace(-12, 12, 200)
    loops = [homoclinic_orbit(Duffing(), t, side) for side in (1, -1)]

    def case(ratio):
        curves = ([data[f"{kind} {branch} {ratio}"] for branch in (1, -1)] for kind in ("stable", "unstable"))
        return f"{ratio}", *curves, data[f"point {ratio}"]

    return figures.fig2(loops, [case(ratio) for ratio in (0.5, 2.0)])


def _strobed():
    from book.studies import homoclinic_orbits as study

    t, path, points = study.strobed(Duffing(alpha=0.1, p=1.0, mu=0.05), (1.3, 0.0), 6, samples=40)
    return {"t": t, "path": path, "points": points}


def _near_curves(data, reference):
    for name, expected in reference.items():
        np.testing.assert_allclose(data[name], expected, atol=2e-4, err_msg=name)


def _onsets():
    p = np.linspace(0.02, 3.1, 80)
    line = critical_amplitude(replace(paper.OSCILLATOR, p=p))
    return {"p": p, "mu_c": line, "p_onset": np.array(P_ONSET), "onset": reproduction.onsets(P_ONSET)}


def _near_onsets(data, reference):
    to_roundoff(data, {name: reference[name] for name in ("p", "mu_c", "p_onset")})
    # The first mu with a chaotic average is decided by transients, hence by round-off where windows are narrow.
    difference = np.abs(data["onset"] - reference["onset"])
    assert np.max(difference) < 0.03, difference
    assert np.median(difference) < 0.006, difference


def _exponents(p):
    mu, exponent = reproduction.exponent_curve(p)
    return {"mu": mu, "exponent": exponent}


FIG_4 = (-1.4, 0.3), (0.225, 0.295, -0.15, 0.25)  # the exponent's axis and the inset


def _near_exponents(window, regular):
    def compare(data, reference):
        to_roundoff(data, {"mu": reference["mu"]})
        mu, ours, theirs = data["mu"], data["exponent"], reference["exponent"]
        calm = (mu >= regular[0]) & (mu <= regular[1])
        np.testing.assert_allclose(ours[calm], theirs[calm], atol=2e-4)
        inside = (mu >= window[0]) & (mu <= window[1])
        assert abs(ours[inside].mean() - theirs[inside].mean()) < 0.03
        assert abs(np.sum(ours > paper.THRESHOLD) - np.sum(theirs > paper.THRESHOLD)) <= 8

    return compare


def _motion(mu):
    motion = reproduction.motion(mu)
    late, points = motion.part(paper.SETTLED, paper.END, paper.OSCILLATOR.period)
    first = motion.t < 5.001 * paper.OSCILLATOR.period
    return {
        "t": motion.t[first],
        "path": motion.path[:, first],
        "points": motion.points[:, :5],
        "late": np.array([np.ptp(late[0]), np.ptp(late[1]), np.max(np.ptp(points, axis=1))]),
    }


def _near_motion(late_tolerance):
    def compare(data, reference):
        to_roundoff(data, {"t": reference["t"]})
        for name in ("path", "points"):
            np.testing.assert_allclose(data[name], reference[name], atol=1e-9, err_msg=name)
        np.testing.assert_allclose(data["late"], reference["late"], atol=late_tolerance)

    return compare


CASES = {
    "fig1a": Case(_potential, lambda d: figures.fig1a(d["x"], d["potential"]), to_roundoff),
    "fig1b": Case(_damping, lambda d: figures.fig1b(d["v"], d["p"], d["damping"]), to_roundoff),
    "fig2": Case(_manifolds, _draw_manifolds, _near_curves),
    "stroboscopic": Case(_strobed, lambda d: figures.stroboscopic(d["t"], d["path"], d["points"]), _near_curves),
    "fig3a": Case(_ratio, lambda d: figures.fig3a(d["omega"], d["p"], d["ratio"]), to_roundoff),
    "fig3b": Case(_onsets, lambda d: figures.fig3b(d["p"], d["mu_c"], d["p_onset"], d["onset"]), _near_onsets),
    "fig4a": Case(
        lambda: _exponents(paper.P_SMALL),
        lambda d: figures.fig4(d["mu"], d["exponent"], paper.P_SMALL, paper.THRESHOLD, *FIG_4),
        _near_exponents(window=(0.268, 0.277), regular=(0.10, 0.18)),
    ),
    "fig4b": Case(
        lambda: _exponents(paper.P_LINEAR),
        lambda d: figures.fig4(d["mu"], d["exponent"], paper.P_LINEAR, paper.THRESHOLD, *FIG_4),
        _near_exponents(window=(0.235, 0.260), regular=(0.0, 0.15)),
    ),
    # Late motion: a chaotic attractor's extent statistically; a periodic orbit's to the noise of the step.
    "fig5a": Case(
        lambda: _motion(paper.MU_CHAOTIC),
        lambda d: figures.fig5(None, d["path"], None, d["points"]),
        _near_motion(0.3),
    ),
    "fig5b": Case(
        lambda: _motion(paper.MU_REGULAR),
        lambda d: figures.fig5(d["path"][:, :200], d["path"][:, 200:], d["points"][:, :2], d["points"][:, 2:]),
        _near_motion(1e-3),
    ),
    "fig6a": Case(
        lambda: _motion(paper.MU_CHAOTIC), lambda d: figures.fig6(d["t"], d["path"][0], 15.0), _near_motion(0.3)
    ),
    "fig6b": Case(
        lambda: _motion(paper.MU_REGULAR), lambda d: figures.fig6(d["t"], d["path"][0], 15.0), _near_motion(1e-3)
    ),
}
