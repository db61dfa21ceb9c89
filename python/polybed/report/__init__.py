"""The page of a run, report.html: one file that needs no other, made from the run directory."""
