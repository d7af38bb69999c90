"""Friction time pictured: a crossing of v = 0, a creep, error against work. Arrays in, a figure out."""

from .style import BLACK, BLUE, GREEN, GREY, PURPLE, VERMILION, PageFigure, styled

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


@styled
def crossing(t, s, rows):
    """A passage through v = 0 against time and against friction time: rows of x, v and Y, (3, n)."""
    fig = PageFigure(figsize=(7.2, 4.8))
    panels = fig.subplots(3, 2, sharex="col", sharey="row")
    labels = ("$x$", "$v$", r"$Y = \mathrm{sign}(v)\,|v|^p$")
    for row, (name, values) in enumerate(zip(labels, rows, strict=True)):
        for axes, along, colour, dash in zip(panels[row], (t, s), (BLUE, VERMILION), ("--", "-"), strict=True):
            if row:  # x stays on one side
                axes.axhline(0, color=GREY, linewidth=0.8)
            axes.plot(along, values, color=colour, linestyle=dash)
        panels[row, 0].set_ylabel(name)
    for axes, along, name in zip(panels[-1], (t, s), ("time $t$", "friction time $s$"), strict=True):
        axes.set(xlabel=f"{name} (dimensionless)", xlim=(along[0], along[-1]))
    return fig


@styled
def creep(periods, x, damping, force):
    """A creep against time in periods, (n,) each: x above; below the damping force Y and the force F / alpha."""
    fig = PageFigure(figsize=(7.2, 4.2))
    above, below = fig.subplots(2, 1, sharex=True)
    above.plot(periods, x, color=VERMILION)
    above.set_ylabel("$x$ (dimensionless)")
    for bound in (-1, 1):
        below.axhline(bound, color=GREY, linestyle=":", linewidth=1.0)
    below.plot(periods, force, color=BLUE, linestyle="--", linewidth=2.2, label=r"$F/\alpha$")
    below.plot(periods, damping, color=VERMILION, linewidth=1.0, label="$Y$")
    below.set(xlabel="time (forcing periods)", ylabel=r"force$\,/\,\alpha$", xlim=(periods[0], periods[-1]))
    fig.legend(*below.get_legend_handles_labels(), loc="outside upper center", ncols=2)
    return fig
