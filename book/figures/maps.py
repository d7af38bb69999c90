"""Pictures of lambda_1 over a plane of parameters: arrays in, a matplotlib Figure out. Nothing is computed here."""

from .style import BLACK, GREEN, panel, styled

_LIMIT = 0.2  # of the colour scale; what is beyond it is drawn in its last colour


@styled
def exponent_plane(values, mu, exponent, critical, tangency, xlabel):
    """lambda_1 (len(mu), len(values)) as an image; critical and tangency: (values, mu) of the line and the crosses."""
    fig, axes = panel(xlabel, r"forcing amplitude $\mu$ (dimensionless)", figsize=(6.8, 5.2))
    (half_x, half_y) = ((values[-1] - values[0]) / (len(values) - 1) / 2, (mu[-1] - mu[0]) / (len(mu) - 1) / 2)
    extent = (values[0] - half_x, values[-1] + half_x, mu[0] - half_y, mu[-1] + half_y)
    image = axes.imshow(
        exponent,
        origin="lower",
        extent=extent,
        aspect="auto",
        interpolation="nearest",
        cmap="PuOr_r",
        vmin=-_LIMIT,
        vmax=_LIMIT,
    )
    axes.grid(False)
    axes.plot(*critical, color=BLACK, linewidth=2, label=r"critical amplitude $\mu_c$, Eq. 13")
    axes.plot(*tangency, "x", color=GREEN, markersize=8, markeredgewidth=2.2, label="homoclinic tangency, computed")
    axes.set(xlim=extent[:2], ylim=(0, extent[3]))
    fig.colorbar(image, ax=axes, extend="both", label=r"$\lambda_1$ (per unit time)")
    fig.legend(loc="outside upper center", ncols=2)
    return fig
