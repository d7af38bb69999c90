"""What the chapters show: the paper rerun, studies, findings and verdicts, tables, widgets, more figures."""
