"""The figures, drawn from arrays: a chapter's module bears its name. Nothing is computed here."""
