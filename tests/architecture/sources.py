"""The files that the checks read: those that git tracks or would track, or, outside git, all below the root."""
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]


def tracked(*suffixes):
    found = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-z", "--cached", "--others", "--exclude-standard"], capture_output=True, text=True)
    if found.returncode == 0:
        names = found.stdout.split("\0")
    else:
        names = [str(p.relative_to(ROOT)) for p in ROOT.rglob("*") if p.is_file()]
    paths = [ROOT / n for n in names if n.endswith(suffixes) and not n.startswith("build")]
    return sorted(p for p in paths if p.exists())


def report(problems, what):
    """Prints the problems; the exit code says whether there were any."""
    for problem in problems:
        print(problem)
    print(f"{what}: {len(problems)} problems")
    return 1 if problems else 0
