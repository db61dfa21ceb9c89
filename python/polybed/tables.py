"""Tables as lines of text and as Markdown; those of pages are in polybed.page."""


def text_table(head, rows, align="<", gap="  "):
    """Columns under each other, as wide as their widest cell. align: "<" or ">"; a line keeps no blanks at its end"""
    lines = [list(map(str, line)) for line in (head, *rows)]
    widths = [max(map(len, column)) for column in zip(*lines)]
    return "\n".join(gap.join(f"{cell:{align}{width}}" for cell, width in zip(line, widths)).rstrip() for line in lines)


def right_table(head, rows):
    """Numbers, all to the right."""
    return text_table(head, rows, ">", " ") + "\n"


def markdown_table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(map(str, line))} |" for line in lines)
