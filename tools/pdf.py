"""The whole book as one PDF, _build/duffing-book.pdf (make pdf): all chapters as one page, printed by Chromium.

No TeX. The book is built first; nothing runs again. Chromium is Debian's, or the one that CHROMIUM names.
"""

import sys
from pathlib import Path

import chromium
from jupyter_book.sphinx import build_sphinx
from playwright.sync_api import sync_playwright

ROOT = Path(__file__).parents[1]
FOOT = (
    '<div style="width: 100%; font-size: 8px; text-align: center"><span class="pageNumber"></span> / '
    '<span class="totalPages"></span></div>'
)


def one_page(root):
    """Write all chapters as one page; returns its path."""
    build = root / "_build"
    result = build_sphinx(
        root,
        build / "singlehtml",
        noconfig=True,
        path_config=root / "_config.yml",
        confoverrides={"external_toc_path": "_toc.yml", "latex_individualpages": False},
        doctreedir=build / "doctrees",
        builder="singlehtml",
        quiet=True,
    )
    if result != 0:
        sys.exit("The book as one page is not written: see the messages above.")
    # Sphinx writes it in the folder of the first chapter, with paths as seen from the folder above.
    return (build / "singlehtml" / "chapters" / "index.html").rename(build / "singlehtml" / "book.html")


def printed(page, path, browser):
    """Print a page as PDF once its equations are typeset and all its pictures are there."""
    with sync_playwright() as play:
        window = play.chromium.launch(executable_path=browser, args=["--no-sandbox", "--disable-gpu"])
        tab = window.new_page(color_scheme="light")
        tab.set_default_timeout(120_000)
        tab.goto(page.as_uri())
        tab.evaluate("MathJax.startup.promise.then(() => null)")
        # Pictures below the screen are fetched when they are looked at; print looks at none.
        tab.evaluate("""() => Promise.all([...document.images].map(image => {
            image.loading = "eager";
            return image.decode();
        })).then(() => null)""")
        tab.pdf(
            path=path,
            format="A4",
            scale=0.8,
            margin={"top": "18mm", "bottom": "18mm", "left": "16mm", "right": "16mm"},
            display_header_footer=True,
            header_template="<span></span>",
            footer_template=FOOT,
            outline=True,
            tagged=True,
        )
        window.close()


def main():
    browser, missing = chromium.found()
    if missing:
        sys.exit(missing)
    path = ROOT / "_build" / "duffing-book.pdf"
    printed(one_page(ROOT), path, browser)
    print(f"{path}  {path.stat().st_size / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
