"""Where Chromium is: Debian's (`apt-get install chromium`), Google's, or the one that the variable CHROMIUM names."""

import os
import shutil


def found():
    """(path, None), or (None, a sentence that says what to do)."""
    named = os.environ.get("CHROMIUM")
    if named:
        path = shutil.which(named)
        return path, None if path else f"CHROMIUM = {named!r}: there is no such program"
    path = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    return path, None if path else "no Chromium found: `apt-get install chromium`, or name one: CHROMIUM=/path make ..."
