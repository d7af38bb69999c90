"""Error against work, integrator by integrator: arrays in, a figure out."""

from .style import BLACK, BLUE, GREEN, PURPLE, VERMILION, PageFigure, styled

METHODS = {  # the integrators' colours, markers and dashes in the work-precision figure
    "Runge-Kutta 4, fixed step": (BLACK, "o", ":"),
    "SciPy DOP853": (BLUE, "s", "--"),
    "SciPy LSODA": (GREEN, "^", "-."),
    "SciPy Radau": (PURPLE, "v", (0, (5, 1, 1, 1))),
    "friction time": (VERMILION, "D", "-"),
}


@styled
def work_precision(tables):
    """Error against force evaluations, one panel for each p: dict p -> dict method -> (evaluations, error)."""
    fig = PageFigure(figsize=(6.8, 3.9))
    panels = fig.subplots(1, len(tables), sharey=True, squeeze=False)[0]
    for axes, (p, table) in zip(panels, tables.items(), strict=True):
        for method, (evaluations, error) in table.items():
            colour, marker, dash = METHODS[method]
            axes.loglog(evaluations, error, color=colour, marker=marker, linestyle=dash, markersize=4, label=method)
        axes.set(title=f"$p = {p:g}$", xlabel="force evaluations")
    panels[0].set_ylabel("error of $(x, v)$ (dimensionless)")
    fig.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return fig
