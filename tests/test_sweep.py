"""Families in blocks: the same numbers however they are cut and wherever they run."""

from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest

from duffing import Duffing, lyapunov_spectrum, sweep


@pytest.mark.parametrize("method", ["auto", "rk4"])
def test_results_are_bit_for_bit_the_same_with_any_executor_and_block(method, monkeypatch):
    osc = Duffing(p=np.array([[0.5], [1.0]]), mu=np.linspace(0.1, 0.3, 35))
    options = {"periods": 8, "transient": 2, "method": method}
    here = lyapunov_spectrum(osc, **options)
    monkeypatch.setattr(sweep, "BLOCK", 16)
    with ThreadPoolExecutor(2) as threads:
        np.testing.assert_array_equal(lyapunov_spectrum(osc, executor=threads, **options).history, here.history)
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as processes:
        np.testing.assert_array_equal(lyapunov_spectrum(osc, executor=processes, **options).history, here.history)


def test_progress_counts_members_up_to_the_whole_family():
    calls = []
    osc = Duffing(mu=np.linspace(0.1, 0.3, 300))
    lyapunov_spectrum(osc, periods=2, transient=0, k=1, method="rk4", progress=lambda *call: calls.append(call))
    assert calls == [(256, 300), (300, 300)]
