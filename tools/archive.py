"""Packs the built book for a repository of record: _build/duffing-book.zip, and its checksum beside it (make archive).

Inside: the pages, the licences, how to cite it, the environment it was built with, and SHA256SUMS of every file
(`sha256sum -c SHA256SUMS`). The same files give the same bytes: names are sorted, times and permissions fixed.
"""

import hashlib
import sys
import zipfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
BESIDE = ("CITATION.cff", "LICENSE", "LICENSE-text", "README.md", "environment.txt")
EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest time that a zip can name


def contents(root):
    """Dict name in the archive -> bytes, with the checksums of all as one file more."""
    html = root / "_build" / "html"
    files = {f"html/{path.relative_to(html).as_posix()}": path for path in html.rglob("*") if path.is_file()}
    files |= {name: root / name for name in BESIDE}
    found = {name: files[name].read_bytes() for name in sorted(files)}
    sums = "".join(f"{hashlib.sha256(data).hexdigest()}  {name}\n" for name, data in found.items())
    return found | {"SHA256SUMS": sums.encode()}


def pack(found, path):
    """Write the archive, whole or not at all; returns its SHA-256 in hexadecimal."""
    unfinished = path.with_suffix(".unfinished")
    with zipfile.ZipFile(unfinished, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, data in found.items():
            entry = zipfile.ZipInfo(f"duffing-book/{name}", EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            entry.create_system = 3  # permissions as on Unix, wherever it is packed
            archive.writestr(entry, data)
    unfinished.replace(path)
    return hashlib.sha256(path.read_bytes()).hexdigest()


def main():
    if not (ROOT / "_build" / "complete").is_file():
        sys.exit("There is no complete book in _build: run `make book` first.")
    path = ROOT / "_build" / "duffing-book.zip"
    checksum = pack(contents(ROOT), path)
    path.with_suffix(".zip.sha256").write_text(f"{checksum}  {path.name}\n", encoding="utf-8")
    print(f"{path}  {path.stat().st_size / 1e6:.1f} MB\nSHA-256 {checksum}")


if __name__ == "__main__":
    main()
