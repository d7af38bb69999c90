"""How far a long run has come: a bar for a person who watches, and silence for everybody else."""

import sys
import warnings
from contextlib import contextmanager


@contextmanager
def reporting(progress, total):
    """A context that gives a function report(done), to be called as parts of `total` members get done.

    progress : True draws a bar (tqdm) where somebody watches; a function is called as progress(done, total);
        None or False is silent

    Raises ValueError for anything else.
    """
    if progress is True and watched():
        with _bar(total) as bar:
            yield lambda done: bar.update(done - bar.n)
    elif progress is None or isinstance(progress, bool):
        yield lambda done: None
    elif callable(progress):
        yield lambda done: progress(done, total)
    else:
        raise ValueError(f"progress = {progress!r}: must be True, False, None or a function of (done, total)")


def watched():
    """Whether a person sees the output as it comes: at a terminal, or at a notebook opened in a front end.

    A notebook's request to run a cell says whether its sender could answer a question (`allow_stdin` in Jupyter's
    messaging protocol). JupyterLab can; what runs the cells of a book cannot, and there an output is a blemish.
    """
    cell = _request()
    if cell is not None:
        return bool(cell.get("content", {}).get("allow_stdin", False))
    return sys.stderr is not None and sys.stderr.isatty()


def _request():
    """The message that asked for this cell to run; None outside of notebooks."""
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    kernel = getattr(shell, "kernel", None)
    return None if kernel is None else kernel.get_parent()


def _bar(total):
    with warnings.catch_warnings():
        # In a notebook without ipywidgets it says so and draws with characters instead, which is good enough.
        warnings.simplefilter("ignore")
        from tqdm.auto import tqdm
    # In a notebook the error stream has a red background.
    return tqdm(total=total, unit=" members", file=sys.stderr if _request() is None else sys.stdout)
