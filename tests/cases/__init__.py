"""What the regression of figures compares, a module a chapter: its CASES, name -> Case (see `case`)."""
