"""The page of a run, report.html: one file that stands alone, made of what the run directory holds."""
