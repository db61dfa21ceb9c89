"""Error against time for a case, and the settings that follow: `polybed cost`. What a sweep is: docs/accuracy-and-time.md."""
