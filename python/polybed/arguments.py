"""Command lines: what several commands take alike."""

import argparse

# Options by name: as argparse takes them.
ALIKE = {"case": {"metavar": "CASE", "help": "the case file"},
         "--set": {"action": "append", "default": [], "metavar": "KEY=VALUE", "help": "in place of what the file says"},
         "--until": {"metavar": "TIME", "help": 'simulated time, e.g. "20 s"'},
         "--quiet": {"action": "store_true", "help": "no progress"},
         "--json": {"action": "store_true", "help": "one JSON object on standard output, nothing else there"},
         "--no-picture": {"dest": "picture", "action": "store_false", "help": "no pictures and pages at the end"}}


def parser_of(command, description, *alike):
    """The parser of a command with some of these options."""
    parser = argparse.ArgumentParser(prog=f"polybed {command}", allow_abbrev=False, description=description)
    for name in alike:
        parser.add_argument(name, **ALIKE[name])
    return parser


def whole(low, high):
    """What reads a whole number in a range."""
    def read(text):
        number = int(text)
        if not low <= number <= high:
            raise argparse.ArgumentTypeError(f"{number} is not in range {low} to {high}")
        return number
    read.__name__ = "whole number"
    return read
