"""What the chapters compute, draw and judge; the package `duffing` knows nothing of it."""
