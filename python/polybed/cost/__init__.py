"""Error against time for a case, and the settings that follow: `polybed cost`. What a sweep is: docs/guide/accuracy-and-time.md."""
