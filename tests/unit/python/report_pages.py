"""What tests of pages share: a run whose case has a title and names that would be marks of HTML, and what a page holds."""

import html.parser
import json
import re

EVIL = '<img src=x onerror="document.title=1">&</script>'
VOID = {"meta", "link", "img", "br", "input"}


class Page(html.parser.HTMLParser):
    """A page taken apart: every element is closed by its own end; what it loads, its elements by name, its text."""

    def __init__(self, text):
        super().__init__()
        self.open, self.loaded, self.elements, self.text = [], [], [], []
        self.feed(text)
        self.close()
        if self.open:
            raise ValueError(f"not closed: {self.open}")

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))
        self.loaded += [value for name, value in attributes if name in ("src", "href") and not value.startswith("data:")]
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            raise ValueError(f"{tag} is closed where it is not open")

    def handle_data(self, data):
        if not self.open or self.open[-1] not in ("script", "style"):
            self.text.append(data)


def data_of(text):
    """What the script of a page draws."""
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.S)[1])


def add_case(directory, **more):
    """Gives a sample run a case with that title, what limited its steps, and what else is named."""
    path = directory / "run.json"
    case = f"title = {json.dumps(EVIL)}\n[run]\nuntil = 1.0\n[inlet]\nsuperficial_velocity = [[0.0, 0.023]]\n[effects]\ndrag = \"cello\"\n"
    row = {"effect": "lift", "bound": 0.19, "up_to": 0.22, "number": "lift over weight", "reason": f"0.19 > 0.02 {EVIL}"}
    record = json.loads(path.read_text()) | {
        "case": case, "overrides": [f"title={EVIL}"], "time_s": 1.0, "warnings": [EVIL],
        "invariants": [{"name": "mass", "worst": 1e-14, "limit": 1e-12}], "neglected": {"sum": 0.19, "promise": 0.02, "rows": [row]}}
    path.write_text(json.dumps(record | more))
