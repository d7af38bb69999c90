"""Why M measures a distance: the manifolds at a section and the energy along them. Arrays in, a figure out."""

from .style import BLACK, GREY, STABLE, UNSTABLE, PageFigure, styled


@styled
def distance(loop, unstable, stable, ends, times, energies):
    """Left: loop and curves of W^U and W^S in the plane, (2, n) each; right: the energy along one orbit on each.

    ends : the points (2, 2) at which the curves meet the section, that of W^U first
    times, energies : pairs (n,), (m,): before the section on W^U, after it on W^S; the section is at time zero
    """
    fig = PageFigure(figsize=(8.0, 3.8))
    plane, energy = fig.subplots(1, 2)
    plane.plot(*loop, color=GREY, linewidth=3.5, alpha=0.5, label="homoclinic orbit, Eq. 8")
    plane.plot(*unstable, color=UNSTABLE, label="$W^U$")
    plane.plot(*stable, color=STABLE, linestyle="--", label="$W^S$")
    plane.axhline(0, color=BLACK, linestyle=":", linewidth=1.0, label="section")
    plane.plot(*ends, "o", color=BLACK, markersize=4.5)
    (right, _), (left, _) = ends.T
    arrow = {"arrowstyle": "<->", "color": BLACK, "shrinkA": 0, "shrinkB": 0}
    plane.annotate("", (left, -0.05), (right, -0.05), arrowprops=arrow)
    plane.text((left + right) / 2, -0.075, "$d$", ha="center", va="top")
    middle = (left + right) / 2
    plane.set(xlim=(middle - 0.3, middle + 0.2), ylim=(-0.45, 0.45))
    plane.set(xlabel="displacement $x$ (dimensionless)", ylabel="velocity $v$ (dimensionless)")
    for t, values, colour, dash in zip(times, energies, (UNSTABLE, STABLE), ("-", "--"), strict=True):
        energy.plot(t, values, color=colour, linestyle=dash)
    low, high = energies[1][0], energies[0][-1]
    energy.annotate("", (0, low), (0, high), arrowprops=arrow)
    energy.text(-0.3, 0.3 * low + 0.1 * high, r"$\mathrm{M}(t_0)$", ha="right", va="center")
    energy.axhline(0, color=GREY, linewidth=0.8)
    energy.set(xlabel="time $t - t_0$ (dimensionless)", ylabel="energy $H^0$ (dimensionless)")
    fig.legend(*plane.get_legend_handles_labels(), loc="outside upper center", ncols=4)
    return fig
