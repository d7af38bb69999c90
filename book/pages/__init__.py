"""Pages that move: widgets in the reader's browser, without a server or a network."""
