"""The pictures of a run, one module each; `polybed.plot` chooses among them and writes the files."""
