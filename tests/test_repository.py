"""What others read in this repository: the workflows, Binder's files, the citation, the licences."""

import os
import re
import tomllib
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
each_workflow = pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)


def pythons():
    """The versions that pyproject.toml allows: ">=3.11,<3.14" are 3.11, 3.12 and 3.13."""
    first, end = map(int, re.fullmatch(r">=3\.(\d+),<3\.(\d+)", PROJECT["requires-python"]).groups())
    return [f"3.{minor}" for minor in range(first, end)]


def steps(path):
    (job,) = yaml.safe_load(path.read_text(encoding="utf-8"))["jobs"].values()
    return job, job["steps"]


def python_of(path):
    (version,) = [step["with"]["python-version"] for step in steps(path)[1] if "python-version" in step.get("with", {})]
    return version


@each_workflow
def test_a_workflow_runs_the_commands_of_the_local_check_and_no_others(path):
    local = [
        line for line in (ROOT / ".ci" / "run").read_text(encoding="utf-8").splitlines() if line.startswith("make ")
    ]
    assert [step["run"] for step in steps(path)[1] if "run" in step] == local == ["make lint test book check-book"]


def test_workflows_test_every_python_that_the_project_allows_and_publish_from_one():
    job, _ = steps(ROOT / ".github" / "workflows" / "ci.yml")
    assert job["strategy"]["matrix"]["python"] == pythons()
    assert python_of(ROOT / ".github" / "workflows" / "ci.yml") == "${{ matrix.python }}"
    assert python_of(ROOT / ".github" / "workflows" / "publish.yml") in pythons()


@each_workflow
def test_a_workflow_pins_its_actions_its_machine_and_what_it_may_do(path):
    job, all_steps = steps(path)
    for step in all_steps:
        assert "run" in step or re.fullmatch(r"actions/[\w-]+@[0-9a-f]{40}", step["uses"]), step
    assert re.fullmatch(r"ubuntu-\d\d\.\d\d", job["runs-on"])
    assert job["timeout-minutes"] <= 60
    assert yaml.safe_load(path.read_text(encoding="utf-8"))["permissions"]["contents"] == "read"


def test_the_published_folder_is_the_one_that_the_book_is_built_into():
    _, all_steps = steps(ROOT / ".github" / "workflows" / "publish.yml")
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
