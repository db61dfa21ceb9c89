"""The documentation as HTML, made by Sphinx from the Markdown of the README, the docs and the cases:

    cmake --build build --target docs

The pages stay as they are read in the sources; what only the site needs is added here. A link without a target is an error (-W).
"""
import re
import shutil
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from polybed.version import __version__  # noqa: E402

project = "polybed"
author = copyright = "the polybed authors"
version = release = __version__
root_doc = "README"
include_patterns = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "LICENSE", "docs/**", "cases/**"]
exclude_patterns = ["build*", "**/.*", "runs", "docs/site"]
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.mathjax"]
source_suffix = {".md": "markdown"}
myst_heading_anchors = 4
autodoc_typehints = "description"
autodoc_member_order = "bysource"
pygments_style = "friendly"
suppress_warnings = ["misc.highlighting_failure", "myst.header"]

html_theme = "furo"
html_title = f"polybed {version}"
html_show_copyright = html_show_sphinx = html_copy_source = html_show_sourcelink = False
html_show_search_summary = False  # a browser does not let a page from a file read others
html_additional_pages = {"index": "to_readme.html"}
templates_path = ["."]
# Debian's MathJax, copied into the site: its pages are read without a network.
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_CHTML-full"
MATHJAX = Path("/usr/share/javascript/mathjax")

PARTS = {"Guide": "guide", "Reference": "reference", "Theory": "theory", "Record": "record"}
PYTHON = "\n```{eval-rst}\n.. automodule:: polybed\n   :members:\n```\n"


def contents():
    """The pages by part, in the order in which docs/README.md links them."""
    overview = (ROOT / "docs/README.md").read_text()
    links = list(dict.fromkeys(re.findall(r"\]\(((?:guide|reference|theory|record)/[\w-]+)\.md", overview)))
    text = "\n```{toctree}\n:hidden:\n\ndocs/README\n```\n"
    for caption, folder in PARTS.items():
        listed = [link for link in links if link.startswith(folder)]
        listed += sorted(name for p in (ROOT / "docs" / folder).glob("*.md") if (name := f"{folder}/{p.stem}") not in listed)
        text += f"\n```{{toctree}}\n:hidden:\n:caption: {caption}\n\n" + "".join(f"docs/{link}\n" for link in listed) + "```\n"
    cases = sorted(path.relative_to(ROOT).with_suffix("") for path in (ROOT / "cases").rglob("README.md"))
    text += "\n```{toctree}\n:hidden:\n:caption: Cases\n\n" + "".join(f"{path}\n" for path in cases) + "```\n"
    return text + "\n```{toctree}\n:hidden:\n:caption: Project\n\nCONTRIBUTING\nCHANGELOG\n```\n"


def complete(app, page, source):
    """Adds what only the site has; GitHub and Sphinx name a block of mathematics differently."""
    source[0] = re.sub(r"^```math$", "```{math}", source[0], flags=re.M)
    source[0] += {"README": contents(), "docs/reference/python": PYTHON}.get(page, "")


def finish(app, error):
    """Puts MathJax in, and Gumshoe in front of Furo's script: Debian leaves an import there, which no browser takes from a file."""
    if error is not None or app.builder.format != "html":
        return
    static = Path(app.outdir) / "_static"
    if not (static / "mathjax").exists():
        shutil.copytree(MATHJAX, static / "mathjax", ignore=shutil.ignore_patterns("png", "unpacked", "localization", "test"))
    script = static / "scripts/furo.js"
    imported, text = 'import Gumshoe from "./gumshoe-patched.js";', script.read_text()
    if imported in text:
        script.write_text((static / "scripts/gumshoe-patched.js").read_text() + text.replace(imported, ""))


def setup(app):
    app.connect("source-read", complete)
    app.connect("env-get-outdated", lambda *_: ["README"])  # its contents are those of the folders
    app.connect("build-finished", finish)
