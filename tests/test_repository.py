"""What others read in this repository: the workflows, Binder's files, the citation, the licences."""

import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
each_workflow = pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)


def pythons():
    """The versions that are tested, as the classifiers of pyproject.toml name them: "3.11" and so on."""
    named = "Programming Language :: Python :: "
    return [line.removeprefix(named) for line in PROJECT["classifiers"] if line.startswith(named)]


def jobs(path):
    return yaml.safe_load(path.read_text(encoding="utf-8"))["jobs"]


def main_job(path):
    """The job that does what .ci/run does: all there is but for the one elsewhere."""
    (job,) = [job for name, job in jobs(path).items() if name != "elsewhere"]
    return job, job["steps"]


def python_of(path):
    (version,) = [
        step["with"]["python-version"] for step in main_job(path)[1] if "python-version" in step.get("with", {})
    ]
    return version


@each_workflow
def test_a_workflow_runs_the_commands_of_the_local_check_and_no_others(path):
    lines = (ROOT / ".ci" / "run").read_text(encoding="utf-8").splitlines()
    local = [line for line in lines if line.startswith("make ")]
    assert [step["run"] for step in main_job(path)[1] if "run" in step] == local == ["make lint test book check-book"]


def test_a_job_of_its_own_runs_the_core_where_strangers_work():
    steps = jobs(ROOT / ".github" / "workflows" / "ci.yml")["elsewhere"]["steps"]
    assert [step["run"] for step in steps if "run" in step] == ["make elsewhere"]


def test_workflows_test_every_python_that_the_project_names_and_publish_from_one():
    job, _ = main_job(ROOT / ".github" / "workflows" / "ci.yml")
    assert job["strategy"]["matrix"]["python"] == pythons()
    assert python_of(ROOT / ".github" / "workflows" / "ci.yml") == "${{ matrix.python }}"
    assert python_of(ROOT / ".github" / "workflows" / "publish.yml") in pythons()


def test_the_tested_pythons_are_the_same_wherever_they_are_named_and_a_newer_one_is_not_refused():
    oldest, newest = pythons()[0], pythons()[-1]
    assert PROJECT["requires-python"] == f">={oldest}"
    assert [int(version.split(".")[1]) for version in pythons()] == list(range(11, 11 + len(pythons())))
    text = {
        name: (ROOT / name).read_text(encoding="utf-8") for name in ("README.md", "environment.txt", "pyproject.toml")
    }
    text["about"] = (ROOT / "chapters" / "about.md").read_text(encoding="utf-8")
    for name in ("README.md", "environment.txt", "about"):
        assert f"Python {oldest} to {newest}" in text[name], name
        assert set(re.findall(r"Python (3\.\d+)", text[name])) <= {oldest}, name
    assert f'target-version = "py{oldest.replace(".", "")}"' in text["pyproject.toml"]


@pytest.mark.skipif(not shutil.which("make"), reason="no make here")
@pytest.mark.parametrize(
    ("minor", "refused", "said"), [(10, True, "is needed"), (12, False, ""), (99, False, "untested")]
)
def test_make_refuses_an_older_python_says_that_a_newer_one_is_untested_and_goes_on(minor, refused, said, tmp_path):
    """With a Python that only claims its version, on a copy that has nothing else: it ends where it would install."""
    for name in ("Makefile", "pyproject.toml", "environment.txt"):
        shutil.copy(ROOT / name, tmp_path / name)
    claims = f"import sys\nsys.version_info = (3, {minor}, 0, 'final', 0)\nexec(sys.argv.pop(1))\n"
    (tmp_path / "claims.py").write_text(claims, encoding="utf-8")
    script = f'#!/bin/sh\n[ "$1" = -c ] || exit 7\nshift\nexec "{sys.executable}" "{tmp_path}/claims.py" "$@"\n'
    (tmp_path / "fake").write_text(script, encoding="utf-8")
    (tmp_path / "fake").chmod(0o755)
    done = subprocess.run(
        ["make", ".venv/ready", "PYTHON=./fake"], cwd=tmp_path, capture_output=True, encoding="utf-8", timeout=60
    )
    text = done.stdout + done.stderr
    assert said in text and ("Making .venv" in text) != refused, text
    assert ("untested" in text) == (said == "untested"), text


@pytest.mark.skipif(not shutil.which("make"), reason="no make here")
def test_an_environment_that_was_made_at_another_place_or_with_another_python_is_made_anew(tmp_path):
    first, copy, moved = (tmp_path / name for name in ("a checkout", "a copy", "moved"))
    (first / ".venv" / "bin").mkdir(parents=True)
    shutil.copy(ROOT / "Makefile", first)
    for name in ("ready", "installed"):
        (first / ".venv" / name).touch()
    (first / ".venv" / "place").write_text(f"{first}\n", encoding="utf-8")
    (first / ".venv" / "bin" / "python").symlink_to(sys.executable)

    def ready_after(folder, *more):
        subprocess.run(["make", "clean", *more], cwd=folder, check=True, capture_output=True, timeout=60)
        return (folder / ".venv" / "ready").exists()

    shutil.copytree(first, copy, symlinks=True)
    assert ready_after(first) and not ready_after(copy)
    assert ready_after(first, f"PYTHON={sys.executable}")
    (first / "other").write_text("#!/bin/sh\necho Python 3.1\n", encoding="utf-8")
    (first / "other").chmod(0o755)
    first.rename(moved)
    assert not ready_after(moved)
    (moved / ".venv" / "place").write_text(f"{moved}\n", encoding="utf-8")
    (moved / ".venv" / "ready").touch()
    assert ready_after(moved) and not ready_after(moved, "PYTHON=./other")


def plain_commands():
    """The README's commands for a machine without make."""
    block = re.search(
        r"\*\*Without make\*\*.*?\n\n((?:    [^\n]*\n)+)", (ROOT / "README.md").read_text(encoding="utf-8"), re.S
    )
    return [line.strip() for line in block[1].strip().splitlines()]


def test_the_plain_commands_install_what_make_installs_and_build_and_test_the_same():
    """That the book they build is the same: test_strange_builds.py."""
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    venv, activate, install, build, test = plain_commands()
    assert venv == "python3 -m venv .venv" and "-m venv .venv" in makefile
    assert activate == ". .venv/bin/activate"
    assert install == "pip install -r environment.txt" and "$(INSTALL) -r environment.txt" in makefile
    assert build == "jupyter-book build ." and f"{build} -W -n --keep-going" in (ROOT / "README.md").read_text(
        encoding="utf-8"
    )
    assert test == "pytest" and "$(BIN)/python -m pytest --numprocesses=2" in makefile


def test_make_lint_looks_at_every_file_of_the_project_and_at_nothing_of_the_readers():
    listed = re.search(r"^SOURCES := (.*)$", (ROOT / "Makefile").read_text(encoding="utf-8"), re.M)[1].split()
    ours = {path.relative_to(ROOT).parts[0] for path in ROOT.rglob("*.py") if not path.is_relative_to(ROOT / "_build")}
    hidden = {name for name in ours if name.startswith(".") or name == "build"}
    assert {name for name in ours if (ROOT / name).is_dir()} - hidden <= set(listed)


def test_what_make_and_pip_leave_is_known_to_git_and_to_make_clean():
    ignored = (ROOT / ".gitignore").read_text(encoding="utf-8").split()
    clean = re.search(r"^clean:\n\trm -rf (.*)$", (ROOT / "Makefile").read_text(encoding="utf-8"), re.M)[1].split()
    for name in ("_build", "build", "*.egg-info"):
        assert f"{name}/" in ignored and name in clean


@each_workflow
def test_a_workflow_pins_its_actions_its_machine_and_what_it_may_do(path):
    for job in jobs(path).values():
        for step in job["steps"]:
            assert "run" in step or re.fullmatch(r"actions/[\w-]+@[0-9a-f]{40}", step["uses"]), step
        assert re.fullmatch(r"ubuntu-\d\d\.\d\d", job["runs-on"])
        assert job["timeout-minutes"] <= 120
    assert yaml.safe_load(path.read_text(encoding="utf-8"))["permissions"]["contents"] == "read"


def test_the_published_folder_is_the_one_that_the_book_is_built_into():
    _, all_steps = main_job(ROOT / ".github" / "workflows" / "publish.yml")
    (folder,) = [step["with"]["path"] for step in all_steps if "upload-pages" in step.get("uses", "")]
    assert folder == "_build/html"
    assert f"{folder}/" in (ROOT / "chapters" / "about.md").read_text(encoding="utf-8")


def test_binder_installs_the_pinned_environment_with_a_python_that_it_fits():
    lines = [
        line
        for line in (ROOT / "binder" / "requirements.txt").read_text(encoding="utf-8").splitlines()
        if line[0] != "#"
    ]
    (option, name) = lines[0].split()
    assert len(lines) == 1 and option == "-r"
    assert (ROOT / "binder" / name).resolve() == ROOT / "environment.txt"
    name, version = (ROOT / "binder" / "runtime.txt").read_text(encoding="utf-8").strip().split("-")
    assert name == "python" and version in pythons()


def test_binder_opens_chapters_as_notebooks():
    script = ROOT / "binder" / "postBuild"
    assert os.access(script, os.X_OK) and script.read_text(encoding="utf-8").startswith("#!/bin/bash\n")
    assert "jupytext-config set-default-viewer" in script.read_text(encoding="utf-8")
    assert "jupytext==" in (ROOT / "environment.txt").read_text(encoding="utf-8")


def test_the_citation_names_the_book_as_the_project_does_and_the_paper_as_the_bibliography_does():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    book = yaml.safe_load((ROOT / "_config.yml").read_text(encoding="utf-8"))
    assert citation["title"] == book["title"]
    assert [author["name"] for author in citation["authors"]] == [book["author"]]
    assert citation["version"] == PROJECT["version"]
    (paper,) = citation["references"]
    entry = re.search(
        r"@article\{Borowiec2007,(.*?)\n\}",
        (ROOT / "chapters" / "references.bib").read_text(encoding="utf-8"),
        re.DOTALL,
    )
    fields = dict(re.findall(r"(\w+)\s*=\s*\{(.*)\},", entry[1]))
    authors = " and ".join(f"{author['family-names']}, {author['given-names']}" for author in paper["authors"])
    assert authors == fields["author"]
    assert paper["title"] == fields["title"].replace("{", "").replace("}", "")
    assert (paper["journal"], str(paper["volume"]), str(paper["year"])) == tuple(
        fields[name] for name in ("journal", "volume", "year")
    )
    assert f"{paper['start']}--{paper['end']}" == fields["pages"]
    assert paper["identifiers"][0]["value"] == f"arXiv:{fields['eprint']}"


def test_both_licences_are_there_and_the_book_names_them():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert citation["license"] == PROJECT["license"]  # a list would mean: one or the other, for all of it
    assert "CC BY 4.0" in citation["abstract"]
    assert (ROOT / "LICENSE").read_text(encoding="utf-8").startswith("MIT License")
    text = (ROOT / "LICENSE-text").read_text(encoding="utf-8")
    for number in range(1, 9):
        assert f"\nSection {number} -- " in text
    address = "https://creativecommons.org/licenses/by/4.0/"
    assert address in text and address in (ROOT / "_config.yml").read_text(encoding="utf-8")


def test_every_slow_test_that_make_check_leaves_out_exists():
    for line in (ROOT / "tools" / "slow_tests.txt").read_text(encoding="utf-8").split():
        file, _, name = line.partition("::")
        assert f"def {name}(" in (ROOT / file).read_text(encoding="utf-8"), line
