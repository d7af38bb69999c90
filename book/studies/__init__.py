"""The computations behind the chapters: a chapter's module bears its name."""
