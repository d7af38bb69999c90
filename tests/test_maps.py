"""The planes of lambda_1 are the exponents of their points, and know which integrator is right for which."""

from dataclasses import replace

import numpy as np
import pytest

from book.studies import maps
from duffing import Duffing, critical_amplitude, lyapunov_spectrum, paper

SHORT = {"transient": 5, "periods": 10}


def test_a_pixel_is_the_exponent_at_its_middle():
    plane = maps.exponent_plane("p", 0.5, 1.5, pixels=3, top=0.06, **SHORT)
    np.testing.assert_allclose(plane.values, [0.5, 1.0, 1.5])
    np.testing.assert_allclose(plane.mu, [0.02, 0.04, 0.06])
    osc = Duffing(alpha=0.1, p=0.5, mu=0.04, omega=1.0)
    accurate = lyapunov_spectrum(osc, paper.START, 10, 5, k=1, rtol=1e-10, atol=1e-12)
    assert plane.exponent[1, 0] == pytest.approx(accurate.exponents[0], abs=1e-4)
    linear = lyapunov_spectrum(replace(osc, p=1.0, mu=0.06), paper.START, 10, 5, k=1, rtol=1e-10, atol=1e-12)
    assert plane.exponent[2, 1] == pytest.approx(linear.exponents[0], abs=1e-4)


def test_the_frequency_is_the_abscissa_of_the_other_plane():
    osc = replace(paper.OSCILLATOR, p=1.0)
    plane = maps.exponent_plane("omega", 0.8, 1.2, pixels=2, top=0.1, osc=osc, **SHORT)
    alone = lyapunov_spectrum(replace(osc, omega=1.2, mu=0.05), paper.START, 10, 5, k=1, method="rk4")
    assert plane.exponent[0, 1] == alone.exponents[0]


def test_a_finer_plane_holds_the_same_numbers_where_the_middles_agree():
    coarse = maps.exponent_plane("p", 1.0, 2.0, pixels=3, **SHORT)
    fine = maps.exponent_plane("p", 1.0, 2.0, pixels=9, **SHORT)
    assert fine.mu[-1] == coarse.mu[-1]
    np.testing.assert_array_equal(fine.exponent[-1, ::4], coarse.exponent[-1])


def test_thresholds_are_eq_13_and_the_tangencies_that_have_an_answer():
    (line, mu_c), (few, mu_t) = maps.thresholds("p", 0.1, 2.0, points=5, crosses=3)
    np.testing.assert_allclose(mu_c, critical_amplitude(Duffing(p=line)))
    assert few.tolist() == [0.1, 1.05, 2.0]
    np.testing.assert_allclose(mu_t, critical_amplitude(Duffing(p=few)), rtol=0.025)
    assert maps.thresholds("omega", 0.9, 1.1, points=5, crosses=2)[1][0].size == 2  # at p = 0.1
    far = Duffing(alpha=3.0, p=0.1)  # too strong a damping for a saddle orbit between the wells
    assert maps.thresholds("omega", 0.9, 1.1, points=5, crosses=2, osc=far)[1][0].size == 0


@pytest.mark.parametrize(
    ("bad", "name"), [({"field": "alpha"}, "field"), ({"first": 0.0}, "first"), ({"pixels": 1}, "pixels")]
)
def test_what_a_plane_cannot_be_is_refused_by_name(bad, name):
    with pytest.raises(ValueError, match=name):
        maps.exponent_plane(**{"field": "p", "first": 0.5, "last": 1.0, "pixels": 4, **bad})
