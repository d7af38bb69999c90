"""The first correction to mu_c for p < 1, where it is not of order alpha^2: friction near the saddle orbit.

For smooth damping the tangency lies at mu_c (1 + c alpha^2): time reversal, t -> -t with alpha -> -alpha, and mirror
symmetry leave the splitting no second-order term at omega t0 = pi/2. For p < 1 a greater term comes from where the loop
is as slow as the saddle orbit, v = alpha V. With D(v) = sign(v) |v|^p, X' the velocity of the saddle orbit there and
Y' = exp(t - tau) that of the loop leaving it, damping takes the power Y' [D(X' + Y') - D(X')], of which Eq. 9 counts
Y' D(Y') and the smooth second order p |Y'|^p X'. What is left of it,

    K = integral of Y' [D(X' + Y') - D(X') - D(Y') - p |Y'|^(p-1) X'] dt,

and the same for the return with -Y', gives mu_t = mu_c (1 + alpha^(1+p) (K_u + K_s) / damping_integral + ...). X' is
taken without damping, wrong by a relative alpha^p: what follows is of order alpha^(1+2p), or alpha^2 for p > 1/2.
The loop is outermost at omega t0 = pi/2 and was at alpha Y a time log(2 sqrt(2) / alpha) before: K_u + K_s is periodic
in log(alpha). Half a forcing period exchanges the two, so its period is pi sqrt(-delta) / omega. The terms that follow
have no such exchange: with them the period is twice as long.
"""

import numpy as np

from .. import checks
from ..melnikov import critical_amplitude, damping_integral

_NODES = 200_001


def tangency_correction(osc):
    """mu_t / mu_c - 1 to leading order in alpha for p < 1, (*family); osc.mu is not used.

    To about 1e-4 of it, by the trapezoidal rule. Raises ValueError unless delta < 0 < gamma, 0.05 <= p <= 0.95 and
    0 < alpha < 1.
    """
    unit = checks.model(osc).dimensionless().members()
    if np.any(unit.p < 0.05) or np.any(unit.p > 0.95):
        raise ValueError(f"p = {osc.p}: must be in [0.05, 0.95], where the integral of the correction can be computed")
    if np.any(unit.alpha <= 0) or np.any(unit.alpha >= 1):
        raise ValueError(f"alpha = {osc.alpha}: must be in (0, 1), dimensionless, for an expansion in small alpha")
    values = [
        alpha ** (1 + p) * _excess(p, omega, alpha, mu / alpha) / damping
        for alpha, p, omega, mu, damping in np.transpose(
            [unit.alpha, unit.p, unit.omega, critical_amplitude(unit), damping_integral(unit)]
        )
    ]
    return np.reshape(values, osc.shape)[()]


def _excess(p, omega, alpha, forcing):
    """K_u + K_s for the forcing amplitude mu = alpha forcing."""
    tau = np.pi / 2 / omega - np.log(2 * np.sqrt(2) / alpha)
    # The integrand falls off as exp(p (t - tau)) before, as exp(-(1 - p) (t - tau)) after.
    t = np.linspace(tau - 16 / p, tau + 16 / (1 - p), _NODES)
    leaving, orbit = np.exp(t - tau), forcing * omega / (1 + omega**2) * np.sin(omega * t)
    total = np.zeros_like(t)
    for y in (leaving, -leaving):
        terms = _power(orbit + y, p) - _power(orbit, p) - _power(y, p) - p * leaving ** (p - 1) * orbit
        total += y * terms
    # Far out the terms cancel to p (p - 1) / 2 Y'^(p-1) X'^2 each, and what is left of them in floats is noise.
    far = leaving > 1e4 * forcing
    total[far] = p * (p - 1) * leaving[far] ** (p - 1) * orbit[far] ** 2
    return np.trapezoid(total, t)


def _power(v, p):
    return np.sign(v) * np.abs(v) ** p
