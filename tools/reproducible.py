"""Runs every chapter twice, on one thread and on several, and compares all outputs bit for bit: `make reproducible`.

    python tools/reproducible.py [chapter ...]            for example chapters/model; all of the book without a name
    python tools/reproducible.py --save [chapter ...]     and keeps a hash of each output in _build/outputs.json
    python tools/reproducible.py --against [chapter ...]  and compares with the hashes kept, before a change of the code

Numbers, tables and pictures must be the same to the last byte. What cannot be is left out by its name: see LEFT_OUT.
Nothing of an earlier run is used but the hashes. Takes twice as long as the chapters run.
"""

import hashlib
import json
import os
import sys
import tempfile
from pathlib import Path

import jupytext
import yaml
from nbclient import NotebookClient

ROOT = Path(__file__).parents[1]
sys.path.append(str(ROOT / "book" / "sphinx"))
from isolation import isolate  # noqa: E402 - its folder is put on the path above

# Chapters and glued values that tell of the machine or of the clock, and why.
LEFT_OUT = {
    "chapters/about": "tells the machine and the versions",
    "chapters/scale": "measures the time that a block takes",
}
THREADS = (1, 4)
KEPT = ROOT / "_build" / "outputs.json"


def chapters():
    """The pages with cells, in the order of the book."""
    toc = yaml.safe_load((ROOT / "_toc.yml").read_text(encoding="utf-8"))
    pages = [toc["root"], *(page["file"] for part in toc["parts"] for page in part["chapters"])]
    return [page for page in pages if "{code-cell}" in (ROOT / f"{page}.md").read_text(encoding="utf-8")]


def run(chapter, threads, folder):
    """The chapter's notebook, executed in a kernel that believes in so many processors."""
    surroundings = folder / f"kernels-{threads}"
    isolate(surroundings, ROOT)
    script = f"from vectorized import processors\nprocessors.available = lambda: {threads}\n"
    (surroundings / "ipython" / "profile_default" / "startup" / "threads.py").write_text(script, encoding="utf-8")
    notebook = jupytext.read(ROOT / f"{chapter}.md")
    NotebookClient(notebook, timeout=1200, resources={"metadata": {"path": ROOT / "chapters"}}).execute()
    return notebook


def outputs(chapter, notebook):
    """dict: what ("chapters/x, cell 3, image/svg+xml" or "chapters/x, glued w") -> content."""
    found = {}
    for number, cell in enumerate(notebook.cells):
        for position, output in enumerate(cell.get("outputs", [])):
            glued = output.get("metadata", {}).get("scrapbook", {}).get("name")
            place = f"{chapter}, glued {glued}" if glued else f"{chapter}, cell {number}, output {position}"
            for kind, content in {**output.get("data", {}), "text": output.get("text", "")}.items():
                found[f"{place}, {kind}"] = content
    return found


def differences(first, second, left_out=tuple(LEFT_OUT)):
    """What is not the same in two dicts of `outputs`: one line each, empty when all is."""
    for name in sorted(first.keys() | second.keys()):
        if any(name.startswith(f"{word},") or f", glued {word}," in name for word in left_out):
            continue
        if name not in first or name not in second:
            yield f"{name}: in one run only"
        elif first[name] != second[name]:
            yield f"{name}: {str(first[name])[:60]!r} and {str(second[name])[:60]!r}"


def hashes(found):
    """dict: what -> hash of its content, for a dict of `outputs`."""
    return {name: hashlib.sha256(str(content).encode()).hexdigest()[:16] for name, content in found.items()}


def main(arguments):
    wishes, names = ({a for a in arguments if a[:2] == "--"}, [a for a in arguments if a[:2] != "--"])
    if wishes - {"--save", "--against"}:
        sys.exit(f"{' '.join(sorted(wishes))}: only --save and --against are known")
    before = json.loads(KEPT.read_text(encoding="utf-8")) if KEPT.exists() else {}
    if "--against" in wishes and not before:
        sys.exit(f"{KEPT} does not exist: run with --save first, before the change")
    bad, count, now = [], 0, {}
    os.chdir(ROOT)
    with tempfile.TemporaryDirectory() as folder:
        for chapter in names or chapters():
            one, several = (outputs(chapter, run(chapter, threads, Path(folder))) for threads in THREADS)
            found = list(differences(one, several))
            now |= hashes(one)
            if "--against" in wishes:
                kept = {name: content for name, content in before.items() if name.startswith(f"{chapter},")}
                found += [f"before and now, {line}" for line in differences(kept, hashes(one))]
            bad, count = bad + found, count + len(one)
            print(f"{chapter}: {len(one)} outputs, {len(found)} differ", *found, sep="\n    ", flush=True)
    if "--save" in wishes:
        KEPT.parent.mkdir(exist_ok=True)
        KEPT.write_text(json.dumps(before | now, indent=1, sort_keys=True), encoding="utf-8")
    if bad:
        sys.exit(f"{len(bad)} of {count} outputs are not reproduced.")
    print(f"All {count} outputs are the same on {THREADS[0]} thread and on {THREADS[1]}.")


if __name__ == "__main__":
    main(sys.argv[1:])
