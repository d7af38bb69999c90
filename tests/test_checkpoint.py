"""Finished blocks in a folder: what is kept is never computed again, and what does not fit is never trusted."""

import os
import pickle
import re
import shutil
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from sweep_cases import PLANE, diverges_at, marked, marks, starts

from duffing import DivergedError, Duffing, blocks, lyapunov_spectrum
from duffing.blocks import over_blocks
from duffing.sweep import checkpoint
from duffing.sweep import families as sweep
from duffing.sweep.checkpoint import Checkpoint

BLOCKS = 10  # of four members


def run(folder, function=marks, osc=PLANE, state=None, **options):
    state = starts(osc) if state is None else state
    return over_blocks(function, osc, state, options, block=4, checkpoint=folder)


def lines(path):
    return path.read_text(encoding="utf-8").splitlines() if path.exists() else []


@pytest.fixture
def kept(tmp_path):
    """A folder with all blocks of a run, and the file in which `marks` notes what it computes from now on."""
    folder, log = tmp_path / "new" / "blocks", tmp_path / "log"
    run(folder, log=str(log))
    assert len(lines(log)) == len(list(folder.iterdir())) == BLOCKS
    log.unlink()
    return folder, log


def test_a_finished_run_is_read_back_and_nothing_computed(kept):
    folder, log = kept
    np.testing.assert_array_equal(run(folder, log=str(log)), marked(PLANE, starts(PLANE)))
    assert lines(log) == []


def test_what_is_kept_by_threads_serves_any_executor_and_reports_progress_at_once(kept):
    folder, log = kept
    next(folder.iterdir()).unlink()
    calls = []
    with ThreadPoolExecutor(1) as executor:
        result = over_blocks(
            marks, PLANE, starts(PLANE), {"log": str(log)},
            block=4, executor=executor, checkpoint=folder, progress=lambda done, total: calls.append(done),
        )  # what, and how  # fmt: skip
    np.testing.assert_array_equal(result, marked(PLANE, starts(PLANE)))
    assert len(lines(log)) == 1
    assert calls == list(range(4, 41, 4))


def flipped(place):
    def damage(content, others):
        at = int(place * (len(content) - 1))
        return content[:at] + bytes([content[at] ^ 1]) + content[at + 1 :]

    return damage


DAMAGES = {
    "empty": lambda content, others: b"",
    "first line alone": lambda content, others: content.partition(b"\n")[0],
    "half": lambda content, others: content[: len(content) // 2],
    "one byte short": lambda content, others: content[:-1],
    "one byte more": lambda content, others: content + b"\0",
    "another block": lambda content, others: others,
    "somebody's array": lambda content, others: b"\x93NUMPY" + content,
    "somebody's pickle": lambda content, others: pickle.dumps(np.zeros(3)),
    "a sealed array of another": lambda content, others: (
        content.partition(b"\n")[0] + b"\n" + others.partition(b"\n")[2]
    ),
    **{f"one bit at {place}": flipped(place) for place in (0.0, 0.1, 0.2, 0.5, 0.9, 1.0)},
}


@pytest.mark.parametrize("damage", DAMAGES.values(), ids=DAMAGES)
def test_a_file_that_is_cut_short_changed_or_foreign_is_computed_again(kept, damage):
    folder, log = kept
    path, other = sorted(folder.iterdir())[:2]
    content = path.read_bytes()
    path.write_bytes(damage(content, other.read_bytes()))
    with pytest.warns(RuntimeWarning, match=f"{path.name} is damaged"):
        result = run(folder, log=str(log))
    np.testing.assert_array_equal(result, marked(PLANE, starts(PLANE)))
    assert len(lines(log)) == 1
    assert path.read_bytes() == content


def test_every_single_bit_of_a_file_counts(tmp_path):
    store = Checkpoint(tmp_path, marks, {})
    store.keep("k", np.array([[1.0, 2.0]]))
    (path,) = tmp_path.iterdir()
    content = bytearray(path.read_bytes())
    for at in range(8 * len(content)):
        content[at // 8] ^= 1 << at % 8
        path.write_bytes(content)
        with pytest.warns(RuntimeWarning, match="damaged"):
            assert store.load("k") is None
        content[at // 8] ^= 1 << at % 8
    path.write_bytes(content)
    np.testing.assert_array_equal(store.load("k"), [[1.0, 2.0]])


def test_other_files_and_what_a_killed_run_left_half_written_are_left_alone(kept):
    folder, log = kept
    for name in ("notes.txt", "tmpabc.part", "x.block"):
        (folder / name).write_text("mine", encoding="utf-8")
    run(folder, log=str(log))
    assert lines(log) == []
    assert {(folder / name).read_text(encoding="utf-8") for name in ("notes.txt", "tmpabc.part", "x.block")} == {"mine"}


def marks_with_option(osc, state, threads, log=None, more=0):
    return marks(osc, state, threads, log)


def same_marks(osc, state, threads, log=None, more=0):
    return marks(osc, state, threads, log)


STATE = starts(PLANE)
ULP = np.nextafter(0.1, 1.0)
CHANGES = {
    "a state": {"state": STATE + np.eye(2, 40)},
    "another function": {"function": same_marks},
    "an option": {"more": 1},
    **{name: {"osc": replace(PLANE, **{name: value})} for name, value in
       {"alpha": ULP, "p": PLANE.p + 1, "mu": PLANE.mu + 1, "omega": 2.0, "delta": -2.0, "gamma": 2.0}.items()},
}  # a line for all fields  # fmt: skip


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_a_changed_parameter_state_function_or_option_reuses_no_block(tmp_path, change):
    log, folder = tmp_path / "log", tmp_path / "kept"
    before = {"function": marks_with_option, "log": str(log), "more": 0}
    run(folder, **before)
    log.unlink()
    run(folder, **{**before, **change})
    # A state was changed in two members of forty, all else in all.
    assert len(lines(log)) == (2 if "state" in change else BLOCKS)


@pytest.mark.parametrize(
    "change",
    [{"periods": 5}, {"transient": 1}, {"k": 1}, {"method": "auto"}, {"steps_per_period": 25}, {"history": False}],
)
def test_each_argument_of_the_exponents_that_changes_their_numbers_is_told_apart(tmp_path, change):
    osc = Duffing(mu=np.linspace(0.1, 0.3, 4))
    options = {"periods": 4, "transient": 0, "method": "rk4", "steps_per_period": 20, "checkpoint": tmp_path}
    if change.get("method") == "auto":
        del options["steps_per_period"]
        lyapunov_spectrum(osc, **options)
    lyapunov_spectrum(osc, **options)
    files = len(list(tmp_path.iterdir()))
    lyapunov_spectrum(osc, **{**options, **change})
    assert len(list(tmp_path.iterdir())) == files + 1


def test_the_number_of_threads_changes_no_number_and_no_block(tmp_path):
    osc = Duffing(mu=np.linspace(0.1, 0.3, 4))
    for threads in (1, 2):
        lyapunov_spectrum(osc, periods=4, method="rk4", threads=threads, checkpoint=tmp_path)
    assert len(list(tmp_path.iterdir())) == 1


@pytest.fixture
def fresh_surroundings():
    checkpoint.surroundings.cache_clear()
    yield
    checkpoint.surroundings.cache_clear()


def test_an_edit_anywhere_in_the_package_or_another_version_of_what_it_needs_reuses_no_block(
    tmp_path, monkeypatch, fresh_surroundings
):
    known = [checkpoint.surroundings()]

    def assert_changed():
        checkpoint.surroundings.cache_clear()
        assert checkpoint.surroundings() not in known
        known.append(checkpoint.surroundings())

    first, second = checkpoint.PACKAGES
    copy = shutil.copytree(first, tmp_path / "duffing", ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(checkpoint, "PACKAGES", [copy, second])
    checkpoint.surroundings.cache_clear()
    assert checkpoint.surroundings() == known[0]
    module = copy / "integrators" / "powers.py"
    module.write_text(module.read_text(encoding="utf-8") + "\n", encoding="utf-8")
    assert_changed()
    module.rename(module.with_name("potencies.py"))
    assert_changed()
    monkeypatch.setattr(checkpoint, "PACKAGES", [copy])
    assert_changed()
    version = checkpoint.version
    for name in ("numba", "numpy", "scipy"):
        monkeypatch.setattr(checkpoint, "version", lambda n, name=name: version(n) + (".1" if n == name else ""))
        assert_changed()
    monkeypatch.setattr(checkpoint.platform, "python_version", lambda: "3.99.0")
    assert_changed()


def test_a_function_whose_change_could_go_unnoticed_is_refused(tmp_path):
    for function in (lambda osc, state, threads: state, test_a_finished_run_is_read_back_and_nothing_computed.__call__):
        with pytest.raises(ValueError, match=r"^checkpoint: function = .* top level"):
            run(tmp_path, function)
    with pytest.raises(ValueError, match=r"^checkpoint: an option of type object"):
        run(tmp_path, more=object())


def test_an_error_leaves_the_finished_blocks_in_the_folder(tmp_path):
    last = float(PLANE.mu[-1, 0])
    with pytest.raises(DivergedError):
        over_blocks(diverges_at, PLANE, starts(PLANE), {"mu": last, "threads": 1}, block=4, checkpoint=tmp_path)
    # On one thread blocks are done in turn: four, one that fails, and of the others those done before all is stopped.
    assert 4 <= len(list(tmp_path.glob("*.block"))) <= 7


def test_two_runs_at_once_on_one_folder_agree_and_leave_it_sound(tmp_path):
    with ThreadPoolExecutor(4) as pool:
        results = list(pool.map(lambda _: run(tmp_path), range(4)))
    for result in results:
        np.testing.assert_array_equal(result, marked(PLANE, starts(PLANE)))
    assert len(list(tmp_path.iterdir())) == BLOCKS
    log = tmp_path / "log"
    run(tmp_path)  # a damaged file would warn
    assert lines(log) == []


SCRIPT = """
import sys
import numpy as np
from duffing import Duffing, blocks, lyapunov_spectrum
blocks.BLOCK_SECONDS = 0.02
osc = Duffing(p=0.1, mu=np.linspace(0.1, 0.3, 400))
spectrum = lyapunov_spectrum(osc, periods=60, method="rk4", checkpoint=sys.argv[1])
np.save(sys.argv[2], spectrum.history)
"""


def test_a_run_killed_half_way_goes_on_where_it_was_and_ends_with_the_identical_array(tmp_path, monkeypatch):
    folder, end = tmp_path / "kept", tmp_path / "end.npy"
    process = subprocess.Popen([sys.executable, "-c", SCRIPT, folder, end])
    deadline = time.monotonic() + 60
    while not folder.exists() or len(list(folder.glob("*.block"))) < 5:
        assert process.poll() is None, "ended before it could be killed"
        assert time.monotonic() < deadline
        time.sleep(0.001)
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    assert not end.exists()
    before = {path.name: path.stat().st_mtime_ns for path in folder.glob("*.block")}
    computed = []
    run_rows = sweep.run_task

    def counting(*arguments):
        computed.append(arguments)
        return run_rows(*arguments)

    monkeypatch.setattr(sweep, "run_task", counting)
    monkeypatch.setattr(blocks, "BLOCK_SECONDS", 0.02)
    osc = Duffing(p=0.1, mu=np.linspace(0.1, 0.3, 400))
    options = {"periods": 60, "method": "rk4"}
    resumed = lyapunov_spectrum(osc, checkpoint=folder, **options)
    after = {path.name: path.stat().st_mtime_ns for path in folder.glob("*.block")}
    assert 5 <= len(before) < len(after)
    assert len(computed) == len(after) - len(before)
    assert before.items() <= after.items()  # none was written again
    monkeypatch.undo()
    for ours, same in zip(resumed, lyapunov_spectrum(osc, **options), strict=True):
        np.testing.assert_array_equal(ours, same)


def test_a_folder_that_cannot_be_is_named(tmp_path):
    file = tmp_path / "file"
    file.touch()
    for wrong in (file, file / "below", 3, b"bytes\0"):
        with pytest.raises(ValueError, match=r"^checkpoint = .* must be a folder that can be written to"):
            lyapunov_spectrum(PLANE, checkpoint=wrong)


@pytest.mark.skipif(os.name != "posix", reason="permissions of another kind")
def test_a_folder_that_may_not_be_written_to_is_named(tmp_path):
    script = (
        "import os, sys\n"
        "import duffing.sweep.families\n"  # which the user below need not be able to read
        "from duffing import Duffing, lyapunov_spectrum\n"
        "folder = sys.argv[1]\n"
        "if os.getuid() == 0:\n"  # the superuser may write anywhere
        "    try: os.setuid(65534)\n"
        "    except OSError: folder = '/proc/duffing-checkpoint'\n"  # in a container that knows no other user
        "try: lyapunov_spectrum(Duffing(), checkpoint=folder)\n"
        "except ValueError as error: print(error)"
    )
    folder = Path("/") / "duffing-checkpoint"  # nobody but the superuser may make it
    out = subprocess.run(
        [sys.executable, "-c", script, folder], capture_output=True, text=True, check=True, encoding="utf-8"
    ).stdout
    assert re.match(r"checkpoint = '(/proc)?/duffing-checkpoint': must be a folder that can be written to", out)
    assert not folder.exists()


def test_a_disk_that_fails_while_running_is_named_with_the_folder(tmp_path, monkeypatch):
    def full(*arguments):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(checkpoint.os, "replace", full)
    with pytest.raises(OSError, match=r"^checkpoint = .*: a block cannot be kept .*No space left"):
        run(tmp_path)
    assert list(tmp_path.iterdir()) == []
