"""The answers of the program in a calibration (app/calibrate.cpp): the plan of a case, names of boxes, how a table reads."""

import contextlib
import json
import subprocess

from polybed.ending import StudyError
from polybed.runner import ranks, start


class Service:
    """The program, asked line by line, on as many ranks as this process was started with."""

    def __init__(self):
        self.child = start(["calibrate", "--serve"], ranks(), True, stdin=subprocess.PIPE, stdout=subprocess.PIPE, encoding="utf-8",
                           errors="surrogateescape")
        self.questions, self.answers = self.child.stdin, self.child.stdout

    def ask(self, *words):
        """The answer to a question."""
        with contextlib.suppress(BrokenPipeError):  # the program has ended; reading its answer shows that
            self.questions.write(json.dumps(list(map(str, words)), ensure_ascii=False) + "\n")
            self.questions.flush()
        return self.answer()

    def answer(self):
        """The next line that is answered. Raises StudyError with the code of a program that has ended."""
        line = self.answers.readline()
        if not line:
            code = self.child.wait()
            raise StudyError(code if code >= 0 else 128 - code)
        return json.loads(line)

    def close(self):
        with contextlib.suppress(BrokenPipeError):
            self.questions.close()
        self.answers.close()
        self.child.wait()

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        if kind is KeyboardInterrupt:
            self.child.terminate()  # it may be in a box
        self.close()
