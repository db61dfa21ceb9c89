"""What all pages share: looks, tables, escaped text and pictures, in one HTML file that needs no other."""

import base64
import html
import io
from pathlib import Path

LOOKS = Path(__file__).with_name("page.css").read_text(encoding="utf-8")


def escaped(text):
    """Text of a case, a path or a message as HTML."""
    return html.escape(str(text))


def table(head, rows, kind=""):
    """Cells are HTML already; an empty head leaves its row out."""
    cells = "".join(f"<th>{cell}</th>" for cell in head)
    body = "".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows)
    top = f"<thead><tr>{cells}</tr></thead>" if any(head) else ""
    return f'<table class="{kind}">{top}<tbody>{body}</tbody></table>'


def source(text):
    """Where numbers come from; HTML already."""
    return f'<p class="source">{text}</p>'


def file_name(*parts):
    return f"<code>{escaped(Path(*parts))}</code>"


def listing(text):
    """Lines as they are typed."""
    return f"<pre>{escaped(text)}</pre>"


def warnings(lines):
    """A section of its own, behind the results; nothing without any."""
    if not lines:
        return ""
    return section("warnings", "Warnings", "<ul>" + "".join(f'<li class="warning">{escaped(line)}</li>' for line in lines) + "</ul>")


def section(name, title, body):
    """A part of a page with its heading; nothing without a body."""
    return f'<section id="{name}"><h2>{escaped(title)}</h2>{body}</section>' if body else ""


def folded(title, body):
    """What is shown when somebody opens it."""
    return f"<details><summary>{escaped(title)}</summary>{body}</details>"


def picture(figure, told, alternative=""):
    """A figure of matplotlib in the page itself, with what it was drawn from (HTML); nothing for no figure."""
    if figure is None:
        return ""
    import matplotlib.pyplot as plt
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", bbox_inches="tight")
    plt.close(figure)
    data = base64.b64encode(buffer.getvalue()).decode()
    return f'<p><img alt="{escaped(alternative)}" src="data:image/png;base64,{data}"></p>' + source(told)


def page(title, under, body, script=""):
    """The whole file. title: text; under: HTML of the line below it; script: what stands at the end of the body, HTML."""
    return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
            f'<link rel="icon" href="data:,"><title>{escaped(title)}</title><style>{LOOKS}</style></head>\n'
            f'<body><h1>{escaped(title)}</h1><p class="under" id="under">{under}</p>\n{body}\n{script}</body></html>\n')
