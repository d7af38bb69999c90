"""Builds in strange surroundings, on a small book: what the machine does is no error of the book."""

import os
import re
import subprocess
import sys
import textwrap
from pathlib import Path

import isolation
import pytest
import small_book

SECOND = "chapters/second.md"
JUPYTER_BOOK = "from jupyter_book.cli.main import main; main()"  # the command jupyter-book


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """A small book after a good build. Each test edits it as it likes and leaves it so that it can be built."""
    root = small_book.make(tmp_path_factory.mktemp("books") / "small book")
    code, output = small_book.build(root)
    assert code == 0, output
    return root


def edit(root, old, new, page=SECOND):
    path = root / page
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")


def files(root):
    html = root / "_build" / "html"
    return {path.relative_to(html).as_posix() for path in html.rglob("*") if path.is_file()}


def test_a_folder_for_matplotlib_that_cannot_be_does_no_harm_now_or_later(built):
    edit(built, 'print("second")', 'import matplotlib.font_manager\nprint("third")')
    for variables in ({"MPLCONFIGDIR": "/proc/nope", "HOME": "/proc/nope"}, {}):
        code, output = small_book.build(built, **variables)
        assert code == 0, output
        assert "Matplotlib" not in (built / "_build" / "html" / "chapters" / "second.html").read_text(encoding="utf-8")
    edit(built, 'print("third")', 'print("second")')


SAID = """import logging, sys, warnings
print("thrown away: printed", file=sys.stderr)
warnings.warn("thrown away: warned")
logging.getLogger("duffing.sweep").warning("thrown away: logged")
print("second")"""


def test_what_the_project_prints_warns_of_or_logs_fails_the_build_and_is_shown(built):
    edit(built, 'print("second")', SAID)
    code, output = small_book.build(built)
    edit(built, SAID, 'print("second")')
    assert code != 0
    for how in ("printed", "warned", "logged"):
        assert re.search(rf"second\.md:\d+: WARNING: stderr was found[^\n]*:\n.*thrown away: {how}", output, re.DOTALL)


def test_what_a_failing_run_said_is_not_shown_once_its_reason_is_gone_though_no_cell_has_changed(built, tmp_path):
    """The reason lies outside of the cells, as a machine's does."""
    reason = tmp_path / "reason"
    reason.touch()
    addition = (
        f'import os, sys\nif os.path.exists({str(reason)!r}):\n    print("bad", file=sys.stderr)\nprint("second")'
    )
    edit(built, 'print("second")', addition)
    assert small_book.build(built)[0] != 0
    reason.unlink()
    code, output = small_book.build(built)
    edit(built, addition, 'print("second")')
    assert code == 0, output


def test_what_a_library_logs_about_the_machine_goes_to_a_file_and_not_into_the_page(built):
    addition = (
        'import logging\nlogging.getLogger("matplotlib.font_manager").warning("building the font cache")\nprint(2)'
    )
    edit(built, 'print("second")', addition)
    code, output = small_book.build(built)
    assert code == 0, output
    assert "building the font cache" in (built / "_build" / "kernels" / "messages.log").read_text(encoding="utf-8")
    edit(built, addition, 'print("second")')


def test_a_chapter_that_was_renamed_leaves_nothing_behind(built):
    before = files(built)
    (built / SECOND).rename(built / "chapters" / "third.v2.md")
    edit(built, "chapters/second", "chapters/third.v2", page="_toc.yml")
    code, output = small_book.build(built)
    assert code == 0, output
    renamed = files(built)
    assert not [name for name in renamed if "second" in name]
    assert {name.replace("third.v2", "second") for name in renamed} == before
    (built / "chapters" / "third.v2.md").rename(built / SECOND)
    edit(built, "chapters/third.v2", "chapters/second", page="_toc.yml")
    assert small_book.build(built)[0] == 0
    assert files(built) == before


PICTURE = """from IPython.display import Image, display
from matplotlib.figure import Figure
import io
buffer = io.BytesIO()
Figure(figsize=(1, {height})).savefig(buffer, format="png")
display(Image(buffer.getvalue()))
print("second")"""


def test_a_picture_that_changed_leaves_no_older_one_behind(built):
    for height in (1, 2):
        edit(built, 'print("second")', PICTURE.format(height=height))
        code, output = small_book.build(built)
        assert code == 0, output
        assert len([name for name in files(built) if name.startswith("_images/")]) == 1
        edit(built, PICTURE.format(height=height), 'print("second")')


def test_a_second_build_at_the_same_time_ends_with_one_sentence(built):
    code = "import sys; sys.path.append('book/sphinx'); import one_build; one_build.lock('_build'); print(); input()"
    command = [sys.executable, "-u", "-c", code]
    first = subprocess.Popen(command, cwd=built, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    try:
        assert first.stdout.readline()
        said = []
        for command in (["book/sphinx/build.py"], ["-c", JUPYTER_BOOK, "build", "."]):
            second = subprocess.run(
                [sys.executable, *command], cwd=built, capture_output=True, encoding="utf-8", timeout=120
            )
            assert second.returncode != 0
            said.append(second.stdout + second.stderr)
    finally:
        first.kill()
        first.communicate(timeout=60)
    assert said[0] == f"another build is at work in {built / '_build'}: wait until it has ended\n"
    assert "another build is at work" in said[1]
    assert small_book.build(built)[0] == 0, "the lock ends with the process that was killed"


def test_jupyter_books_own_command_builds_the_same_pages(tmp_path):
    roots = [small_book.make(tmp_path / name) for name in ("ours", "theirs")]
    code, output = small_book.build(roots[0])
    assert code == 0, output
    command = [sys.executable, "-c", JUPYTER_BOOK, "build", "."]
    variables = os.environ | {"MPLCONFIGDIR": "/proc/nope", "HOME": "/proc/nope"}
    run = subprocess.run(
        command, cwd=roots[1], env=variables, capture_output=True, text=True, encoding="utf-8", timeout=300
    )
    assert run.returncode == 0, run.stderr
    assert "WARNING" not in run.stderr
    assert files(roots[0]) == files(roots[1])
    pages = [(root / "_build" / "html" / "chapters" / "second.html").read_text(encoding="utf-8") for root in roots]
    ours, theirs = (re.sub(r"\d+\.\d+ s on \d{4}-\d\d-\d\d|\?v=\w+", "", page) for page in pages)
    assert ours == theirs


def test_chapters_compute_with_the_package_beside_them_whatever_else_is_installed(tmp_path):
    root, other = small_book.make(tmp_path / "copy", real=True), tmp_path / "site" / "duffing"
    other.mkdir(parents=True)
    (other / "__init__.py").write_text("raise ImportError('this is another duffing')\n", encoding="utf-8")
    edit(root, 'print("second")', "import book, duffing\nprint(book.__file__, duffing.__file__)")
    code, output = small_book.build(root, PYTHONPATH=os.pathsep.join([str(other.parent), str(small_book.BOOK)]))
    assert code == 0, output
    page = (root / "_build" / "html" / "chapters" / "second.html").read_text(encoding="utf-8")
    assert f"{root / 'book' / '__init__.py'} {root / 'duffing' / '__init__.py'}" in page


def test_no_personal_variable_reaches_a_kernel_and_what_lies_at_home_is_not_seen(tmp_path):
    personal = {
        "HOME": "/home/me",
        "PYTHONPATH": "/elsewhere",
        "PYTHONSTARTUP": "/home/me/.pythonrc",
        "PYTHONUTF8": "0",
        "PYTHONWARNINGS": "error",
        "MPLBACKEND": "tkagg",
        "MATPLOTLIBRC": "/home/me/matplotlibrc",
        "MPLCONFIGDIR": "/home/me/mpl",
        "IPYTHONDIR": "/home/me/.ipython",
        "JUPYTER_PATH": "/home/me/jupyter",
        "JUPYTER_CONFIG_DIR": "/home/me/.jupyter",
        "XDG_CONFIG_HOME": "/home/me/.config",
        "LC_ALL": "de_DE.ISO-8859-1",
        "LANG": "de_DE",
    }
    seen = isolation.surroundings(tmp_path / "kernels", tmp_path, personal | {"PATH": "/bin", "OMP_NUM_THREADS": "1"})
    assert seen["PATH"] == "/bin" and seen["OMP_NUM_THREADS"] == "1", "what tells of the machine stays"
    assert [
        name for name, value in seen.items() if "/home/me" in value or "elsewhere" in value or "de_DE" in value
    ] == []
    assert (seen["PYTHONUTF8"], seen["LC_ALL"], seen["PYTHONPATH"]) == ("1", "C", str(tmp_path))
    assert "PYTHONWARNINGS" not in seen and "MPLBACKEND" not in seen


def test_the_suite_tests_the_package_beside_it_whatever_is_installed(tmp_path):
    """As in a copy of the checkout, with the original installed and pytest called by its name."""
    copy = tmp_path / "copy"
    for name in ("tests/conftest.py", "tools/slow_tests.txt", "pyproject.toml", "book/sphinx/isolation.py",
                 "book/sphinx/run_report.py", "book/sphinx/fingerprint.py"):  # what the suite starts with  # fmt: skip
        (copy / name).parent.mkdir(parents=True, exist_ok=True)
        (copy / name).write_bytes((small_book.BOOK / name).read_bytes())
    (copy / "duffing").mkdir()
    (copy / "duffing" / "__init__.py").write_text("here = True\n", encoding="utf-8")
    test = "import duffing\n\ndef test_here():\n    assert duffing.here\n"
    (copy / "tests" / "test_here.py").write_text(test, encoding="utf-8")
    command = [
        sys.executable,
        "-c",
        "import pytest, sys; sys.exit(pytest.main())",
        "-p",
        "no:cacheprovider",
        str(copy / "tests"),
    ]
    variables = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    variables |= {"PYTHONPATH": str(small_book.BOOK), "PYTHONSAFEPATH": "1"}
    run = subprocess.run(
        command, cwd=copy, env=variables, capture_output=True, text=True, encoding="utf-8", timeout=120
    )
    assert run.returncode == 0, run.stdout + run.stderr


def test_ctrl_c_arrives_in_a_test_and_in_what_it_starts_where_the_run_ignores_it(tmp_path):
    """As under nohup: the test that proves it is run by a pytest that ignores SIGINT."""
    test = """
        import signal, subprocess, sys

        def test_it():
            assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
            code = "import signal; print(signal.getsignal(signal.SIGINT) is signal.default_int_handler)"
            assert subprocess.check_output([sys.executable, "-c", code], text=True, timeout=60).strip() == "True"
    """
    (tmp_path / "test_it.py").write_text(textwrap.dedent(test), encoding="utf-8")
    ignoring = (
        "import signal, sys; signal.signal(signal.SIGINT, signal.SIG_IGN); import pytest;"
        "sys.exit(pytest.main(['-p', 'conftest', '-p', 'no:cacheprovider', '-c', '/dev/null', sys.argv[1]]))"
    )
    variables = os.environ | {"PYTHONPATH": os.pathsep.join([str(small_book.BOOK), str(Path(__file__).parent)])}
    run = subprocess.run(
        [sys.executable, "-c", ignoring, str(tmp_path)], env=variables, capture_output=True, text=True,
        encoding="utf-8", timeout=120,
    )  # what, and how  # fmt: skip
    assert run.returncode == 0, run.stdout + run.stderr
