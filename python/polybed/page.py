"""What all pages share: looks, tables, escaped text and pictures, in one HTML file that needs no other.

Text becomes HTML in one way: text that is not Html is escaped where it enters a page, so that nothing from a file is read as HTML. And a
page names its scripts by their hashes: a browser runs no other, nor a handler in an element, and loads nothing.
"""

import base64
import hashlib
import html
import io
from pathlib import Path


class Html(str):
    """Text that is HTML already. What is joined to it is escaped."""

    def __add__(self, other):
        return Html(str.__add__(self, escaped(other)))

    def __radd__(self, other):
        return escaped(other) + self

    def join(self, parts):
        return Html(str.join(self, map(escaped, parts)))


LOOKS = Html(Path(__file__).with_name("page.css").read_text(encoding="utf-8"))


def escaped(value):
    """HTML that shows a value as text; of Html itself."""
    return value if isinstance(value, Html) else Html(html.escape(str(value)))


def markup(pattern, *values):
    """HTML of a pattern that stands in a source, its {} filled with values."""
    return Html(pattern.format(*map(escaped, values)))


def elements(tag, contents):
    return Html().join(markup(f"<{tag}>{{}}</{tag}>", content) for content in contents)


def table(head, rows, kind=""):
    """An empty head leaves its row out."""
    top = markup("<thead>{}</thead>", elements("tr", [elements("th", head)])) if any(head) else ""
    body = elements("tr", [elements("td", row) for row in rows])
    return markup('<table class="{}">{}<tbody>{}</tbody></table>', kind, top, body)


def source(text):
    """Where numbers come from."""
    return markup('<p class="source">{}</p>', text)


def file_name(*parts):
    return markup("<code>{}</code>", Path(*parts))


def listing(text):
    """Lines as they are typed."""
    return markup("<pre>{}</pre>", text)


def warnings(lines):
    """A section of its own, behind the results; nothing without any."""
    items = Html().join(markup('<li class="warning">{}</li>', line) for line in lines)
    return section("warnings", "Warnings", markup("<ul>{}</ul>", items)) if lines else Html()


def section(name, title, body):
    """A part of a page with its heading; nothing without a body."""
    return markup('<section id="{}"><h2>{}</h2>{}</section>', name, title, body) if body else Html()


def picture(figure, told, alternative=""):
    """A figure of matplotlib in the page itself, with what it was drawn from; nothing for no figure."""
    if figure is None:
        return Html()
    import matplotlib.pyplot as plt
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", bbox_inches="tight")
    plt.close(figure)
    data = base64.b64encode(buffer.getvalue()).decode()
    return markup('<p><img alt="{}" src="data:image/png;base64,{}"></p>', alternative, data) + source(told)


def allowed(texts):
    """Scripts or looks as a policy names them: none, or each by its hash."""
    hashes = [base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() for text in texts]
    return " ".join(f"'sha256-{each}'" for each in hashes) or "'none'"


def page(title, under, body, scripts=(), follows=False):
    """The whole file. under: the line below the title; scripts: texts, run in order at the end; follows: the page asks its server for more."""
    asked = "'self'" if follows else "'none'"
    policy = (f"default-src 'none'; base-uri 'none'; form-action 'none'; img-src data:; style-src {allowed([LOOKS])}; "
              f"script-src {allowed(scripts)}; connect-src {asked}")
    return markup('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><meta http-equiv="Content-Security-Policy" content="{}">'
                  '<meta name="viewport" content="width=device-width"><link rel="icon" href="data:,"><title>{}</title><style>{}</style></head>\n'
                  '<body><h1>{}</h1><p class="under" id="under">{}</p>\n{}\n{}</body></html>\n',
                  policy, title, LOOKS, title, under, body, elements("script", map(Html, scripts)))
