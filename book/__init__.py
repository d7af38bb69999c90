"""What the chapters compute (`studies`), draw (`figures`), judge (`claims`) and show (`pages`), one name a chapter."""
