"""The archive of the book: the same files give the same bytes, and its checksums are those of what it holds."""

import hashlib
import os
import sys
import zipfile
from pathlib import Path

import pytest

BOOK = Path(__file__).parents[1]
sys.path.append(str(BOOK / "tools"))

import archive  # noqa: E402 - its folder is put on the path above


@pytest.fixture
def root(tmp_path):
    (tmp_path / "_build" / "html" / "chapters").mkdir(parents=True)
    for name in (*archive.BESIDE, "_build/html/index.html", "_build/html/chapters/model.html"):
        (tmp_path / name).write_text(f"this is {name}\n", encoding="utf-8")
    return tmp_path


def test_files_of_another_day_give_the_same_archive(root, tmp_path):
    first = archive.pack(archive.contents(root), tmp_path / "first.zip")
    for path in root.rglob("*.html"):
        os.utime(path, (0, 0))
        path.chmod(0o600)
    assert archive.pack(archive.contents(root), tmp_path / "second.zip") == first
    (root / "LICENSE").write_text("another\n", encoding="utf-8")
    assert archive.pack(archive.contents(root), tmp_path / "third.zip") != first


def test_the_archive_holds_the_pages_the_licences_and_a_true_checksum_of_each(root, tmp_path):
    archive.pack(archive.contents(root), tmp_path / "book.zip")
    with zipfile.ZipFile(tmp_path / "book.zip") as packed:
        files = {name.removeprefix("duffing-book/"): packed.read(name) for name in packed.namelist()}
    sums = dict(reversed(line.split("  ")) for line in files.pop("SHA256SUMS").decode().splitlines())
    assert set(files) == {*archive.BESIDE, "html/index.html", "html/chapters/model.html"}
    assert sums == {name: hashlib.sha256(data).hexdigest() for name, data in files.items()}


def test_what_goes_beside_the_pages_is_in_the_repository():
    assert [name for name in archive.BESIDE if not (BOOK / name).is_file()] == []
