"""A bar for a person who watches, silence for everybody else."""

import os
import subprocess
import sys
import termios
import time

import nbformat
import pytest
from jupyter_client import BlockingKernelClient
from nbclient import NotebookClient

from duffing import Duffing, lyapunov_spectrum
from duffing.sweep import progress
from duffing.sweep.progress import reporting

CALL = """
import numpy as np
from duffing import Duffing, lyapunov_spectrum
lyapunov_spectrum(Duffing(mu=np.linspace(0.1, 0.3, 300)), periods=2, transient=0, method="rk4", progress=True);
"""


def test_at_a_terminal_a_bar_is_drawn_on_the_error_stream():
    main, side = os.openpty()
    termios.tcsetwinsize(side, (24, 80))
    process = subprocess.Popen([sys.executable, "-c", CALL], stdout=subprocess.PIPE, stderr=side, stdin=side)
    os.close(side)
    seen = b""
    while b"300/300" not in seen:
        try:
            part = os.read(main, 4096)
        except OSError:  # Linux: nobody writes any more
            part = b""
        if not part:
            break
        seen += part
    out, _ = process.communicate(timeout=60)
    os.close(main)
    assert process.returncode == 0
    assert b"100%|" in seen
    assert b"300/300 [" in seen
    assert b" members/s]" in seen
    assert out == b""


def test_a_pipe_and_a_file_stay_empty(tmp_path):
    done = subprocess.run([sys.executable, "-c", CALL], capture_output=True, check=True)
    assert (done.stdout, done.stderr) == (b"", b"")


@pytest.fixture(scope="module")
def notebook():
    """A notebook whose first cell has run as the cells of the book do, and the client with its live kernel."""
    cells = [nbformat.v4.new_code_cell(CALL)]
    client = NotebookClient(nbformat.v4.new_notebook(cells=cells), kernel_name="python3", timeout=100)
    with client.setup_kernel():
        client.execute_cell(cells[0], 0)
        yield client


def test_a_notebook_that_is_run_for_a_book_holds_no_output_at_all(notebook):
    (cell,) = notebook.nb.cells
    assert cell.execution_count == 1
    assert cell.outputs == []


def test_in_a_notebook_that_is_open_in_a_front_end_a_bar_is_drawn_and_nothing_is_complained_of(notebook):
    """The same kernel; the request now comes, as JupyterLab's do, from where a question could be answered."""
    client = BlockingKernelClient()
    client.load_connection_info(notebook.km.get_connection_info())
    client.start_channels()
    request = client.execute(CALL, allow_stdin=True)
    messages, deadline = [], time.monotonic() + 60
    while time.monotonic() < deadline:
        message = client.get_iopub_msg(timeout=60)
        if message["parent_header"].get("msg_id") == request:
            messages.append((message["msg_type"], message["content"]))
            if message["content"].get("execution_state") == "idle":
                break
    client.stop_channels()
    kinds = {kind for kind, _ in messages}
    streams = {name: "".join(c["text"] for k, c in messages if k == "stream" and c["name"] == name)
               for name in ("stdout", "stderr")}  # a line for each  # fmt: skip
    assert "error" not in kinds
    assert streams["stderr"] == ""
    assert "300/300" in streams["stdout"] or "comm_open" in kinds  # characters or, with ipywidgets, a widget


def test_a_run_that_fails_leaves_the_bar_where_it_was_and_its_error_is_seen(monkeypatch, capsys):
    monkeypatch.setattr(progress, "watched", lambda: True)
    with pytest.raises(ZeroDivisionError), reporting(True, 10) as report:
        report(4)
        report(1 / 0)
    assert "4/10" in capsys.readouterr().err


def test_a_function_is_called_with_what_is_done_and_the_whole():
    calls = []
    with reporting(lambda done, total: calls.append((done, total)), 10) as report:
        report(4)
        report(10)
    assert calls == [(4, 10), (10, 10)]


@pytest.mark.parametrize("silent", [None, False])
def test_nothing_is_shown_without_being_asked_for(silent, monkeypatch, capsys):
    monkeypatch.setattr(progress, "watched", lambda: True)
    with reporting(silent, 10) as report:
        report(10)
    assert capsys.readouterr() == ("", "")


@pytest.mark.parametrize("wrong", [1, "bar", 0.5])
def test_any_other_progress_is_named(wrong):
    with pytest.raises(ValueError, match=f"^progress = {wrong!r}"):
        lyapunov_spectrum(Duffing(), progress=wrong)
