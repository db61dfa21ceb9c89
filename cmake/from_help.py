#!/usr/bin/python3
"""Makes the manual page and the completions of bash and zsh from the help texts of the program.

    from_help.py PROGRAM PREFIX

writes PREFIX/share/man/man1/polybed.1.gz (polybed-hard's is the same), PREFIX/share/bash-completion/completions/polybed and
PREFIX/share/zsh/vendor-completions/_polybed.
"""
import gzip
import re
import subprocess
import sys
from pathlib import Path

HEADINGS = {"Positionals:": "Positionals", "Options:": "Options", "Subcommands:": "Subcommands",  # of CLI11, and of argparse:
            "positional arguments:": "Positionals", "options:": "Options"}
CHOICES = re.compile(r"(?!\{false)\{(.*)\}")


def names_and_value(head):
    """("-o,--output", "TEXT") of "-o,--output TEXT", and of "-o DIR, --output DIR" as argparse has it."""
    if ", -" in head:
        names = re.findall(r"(?:^|, )(--?[\w-]+)", head)
        return ",".join(names), head[head.index(names[-1]) + len(names[-1]):]
    names, _, value = head.partition(" ")
    return names, value


def sections(text):
    """{heading: [(names, value, help)]} of what --help prints, and the first line under "". Deeper ones are of a group of options."""
    column = 24 if text.startswith("usage:") else 30  # where argparse and CLI11 begin what they say of an option
    found, heading, indent = {"": text.lstrip().split("\n")[0]}, None, 0
    for line in text.split("\n"):
        if line.strip() in HEADINGS:
            heading, indent = found.setdefault(HEADINGS[line.strip()], []), len(line) - len(line.lstrip())
            continue
        line = line[indent:]
        if heading is None or not line.startswith("  ") or not line.strip() or line.strip().startswith("["):
            continue
        if line.startswith(" " * column):
            names, value, told = heading[-1]
            heading[-1] = (names, value, f"{told} {line.strip()}".strip())
        else:
            cut = column if line[column - 1:column] == " " else len(line)
            names, value = names_and_value(line[:cut].strip())
            heading.append((names, value.strip(), line[cut:].strip()))
    return found


def help_of(program, *command):
    done = subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=True)
    return sections(done.stdout)


def roff(text):
    escaped = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + escaped if escaped[:1] in ("'", ".") else escaped


def options_page(entries):
    lines = []
    for names, value, told in entries:
        shown = ", ".join(f"\\fB{roff(name)}\\fR" for name in names.replace("{false}", "").split(","))
        lines += [".TP", shown + (f" \\fI{roff(value)}\\fR" if value else ""), roff(told) or "\\&"]
    return lines


def manual(whole, commands, version):
    name, _, told = whole[""].partition(": ")
    lines = [f'.TH POLYBED 1 "" "{version}" "User Commands"', ".SH NAME", f"{name} \\- {roff(told)}", ".SH SYNOPSIS",
             ".B polybed", "[\\fIOPTIONS\\fR] \\fICOMMAND\\fR [\\fIARGUMENTS\\fR]", ".SH OPTIONS", *options_page(whole["Options"]),
             ".SH COMMANDS"]
    for command, page in commands.items():
        words = " ".join(name for name, *_ in page.get("Positionals", []))
        lines += [f".SS polybed {command} {words}".rstrip(), roff(page[""][0].upper() + page[""][1:]) + "."]
        entries = page.get("Positionals", []) + page.get("Options", [])
        lines += options_page(entry for entry in entries if not entry[0].startswith("-h"))
    lines += [".SH EXIT STATUS", "0 done, 2 the case or the command is wrong, 3 the numerics failed, 4 a file or a package is missing,",
              "5 MPI failed, 130 stopped by the user.", ".SH FILES", "/usr/share/polybed/cases: the cases.",
              "/usr/share/doc/polybed/html/index.html: the documentation."]
    return "\n".join(lines) + "\n"


def words_of(page):
    return [name for names, *_ in page.get("Options", []) for name in names.replace("{false}", "").split(",")]


def choices(page):
    """(option, its values) of options with a list of values."""
    return [(name, found[1].split(",")) for names, value, _ in page.get("Options", []) if (found := CHOICES.search(value))
            for name in names.split(",")]


def bash(whole, commands):
    cases = []
    for command, page in commands.items():
        values = "".join(f'      {name}) words="{" ".join(each)}" ;;\n' for name, each in choices(page))
        cases.append(f'    {command}) words="{" ".join(words_of(page))}"\n'
                     + (f'      case $before in\n{values}      esac\n' if values else "") + "      ;;")
    return f"""# Completion of polybed for bash, made from its help texts.
_polybed() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} command= words= entry
  for entry in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case $entry in -*|[0-9]*) ;; *) command=$entry; break ;; esac
  done
  case $command in
    '') words="{' '.join([*commands, *words_of(whole)])}" ;;
{chr(10).join(cases)}
  esac
  if [[ -z $command || $word == -* ]] || ! [[ $words == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  else
    compopt -o filenames
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}}
complete -F _polybed polybed
"""


def zsh_text(text):
    return re.sub(r"([\[\]:])", r"\\\1", text).replace("'", "'\\''")


def zsh_options(page):
    lines = []
    for names, value, told in page.get("Options", []):
        found = CHOICES.search(value)
        action = f":value:({' '.join(found[1].split(','))})" if found else ":value:_files" if value and "{false}" not in names else ""
        every = "*" if value.endswith("...") else ""
        lines += [f"'{every}{name}[{zsh_text(told)}]{action}'" for name in names.replace("{false}", "").split(",")]
    return lines


def zsh(whole, commands):
    listed = "\n".join(f"    '{command}:{zsh_text(page[''])}'" for command, page in commands.items())
    cases = "\n".join(f"    {command}) _arguments {' '.join(zsh_options(page))} '*:file:_files' ;;" for command, page in commands.items())
    return f"""#compdef polybed
# Completion of polybed for zsh, made from its help texts.
_polybed() {{
  local -a commands
  local context state state_descr line
  typeset -A opt_args
  commands=(
{listed}
  )
  _arguments -C {' '.join(zsh_options(whole))} '1:command:->command' '*::argument:->argument'
  case $state in
    command) _describe command commands ;;
    argument) case $words[1] in
{cases}
    esac ;;
  esac
}}
_polybed "$@"
"""


def main():
    program, prefix = sys.argv[1], Path(sys.argv[2])
    whole = help_of(program)
    commands = {name: help_of(program, name) | {"": told} for name, _, told in whole["Subcommands"]}
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.split(" (")[0].strip()
    page = manual(whole, commands, version).encode()
    for path, text in (("man/man1/polybed.1.gz", gzip.compress(page, mtime=0)),
                       ("man/man1/polybed-hard.1.gz", gzip.compress(b".so man1/polybed.1\n", mtime=0)),
                       ("bash-completion/completions/polybed", bash(whole, commands).encode()),
                       ("zsh/vendor-completions/_polybed", zsh(whole, commands).encode())):
        path = prefix / "share" / path
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text)


if __name__ == "__main__":
    main()
