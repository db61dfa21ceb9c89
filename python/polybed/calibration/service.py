"""What the program answers in a calibration, app/calibrate.cpp: the plan of a case, names of boxes, how a table reads."""

import contextlib
import json
import os
import subprocess

from polybed.ending import FILE, StudyError
from polybed.runner import start


class Service:
    """The program, asked line by line: a process of its own, or, on ranks, the one that has started this one and whose socket is the
    standard input."""

    def __init__(self, on_ranks=False):
        self.child = None
        coding = {"encoding": "utf-8", "errors": "surrogateescape"}
        if on_ranks:
            self.questions, self.answers = os.fdopen(os.dup(0), "w", **coding), os.fdopen(os.dup(0), **coding)
            return
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
        self.child = start(["calibrate", "--serve"], process_group=0, **pipes, **coding)
        self.questions, self.answers = self.child.stdin, self.child.stdout

    def ask(self, *words):
        """The answer to a question."""
        with contextlib.suppress(BrokenPipeError):  # it has ended, which the answer shows
            self.questions.write(json.dumps(list(map(str, words)), ensure_ascii=False) + "\n")
            self.questions.flush()
        return self.answer()

    def answer(self):
        """The next line that is answered. Raises StudyError with the code of a program that has ended."""
        line = self.answers.readline()
        if not line:
            code = self.child.wait() if self.child else FILE
            raise StudyError(code if code >= 0 else 128 - code)
        return json.loads(line)

    def close(self):
        with contextlib.suppress(BrokenPipeError):
            self.questions.close()
        self.answers.close()
        if self.child:
            self.child.wait()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
