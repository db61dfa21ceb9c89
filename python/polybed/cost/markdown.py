"""cost.md: the table of a sweep, what its error is made of, and advice."""

from polybed.cost.judge import advice, settings_text
from polybed.cost.sweep import REFERENCE as KIND_REFERENCE
from polybed.cost.words import CLOCKS, REFERENCE, STATUS, case_name, part
from polybed.cost.work import weighed


def percent(share):
    return "-" if share is None else f"{100 * share:.2g}"


def cell_of(row, name):
    quantity = row.quantities.get(name)
    if quantity is None:
        return "-"
    return percent(quantity.error) + (f" +- {percent(quantity.error_interval)}" if quantity.error_interval else "")


def status_of(sweep, number):
    """How much dearer a dominated row is than the cheapest that is at least as accurate; whether a row is recommended."""
    row = sweep.rows[number]
    if sweep.recommended == number:
        return f"**recommended** for {100 * sweep.options.target:.2g} % in {sweep.ranking}"
    if row.kind == KIND_REFERENCE and row.done:
        return "reference"
    if row.status != "dominated":
        return STATUS.get(row.status, row.status)
    error = row.quantities[sweep.ranking].error
    least = min([row.rate, *(r.rate for r in sweep.rows if r.status == "pareto" and r.quantities[sweep.ranking].error <= error)])
    return f"{row.rate / least:.2g} times as dear as another as accurate" if 0 < least < row.rate else STATUS["dominated"]


def table_of(sweep):
    names = sweep.options.quantities
    lines = ["| # | settings | s for a simulated s | work, s | CPU, s |" + "".join(f" error of {name}, % |" for name in names) + " |",
             "| ---: | --- | ---: | ---: | ---: |" + " ---: |" * len(names) + " --- |"]
    for n, row in enumerate(sweep.rows):
        cells = [str(n), settings_text(sweep, row), f"{row.rate:.3g}", f"{weighed(row.outcome.counters):.3g}", f"{row.outcome.cpu:.3g}",
                 *(cell_of(row, name) for name in names), status_of(sweep, n)]
        lines.append(f"| {' | '.join(cells)} |")
    return lines


def shares_of(title, shares):
    rows = [f"| {part(share.row)} | {percent(share.value)} | {share.note} |" for share in shares]
    return ["", f"| {title} | % | |", "| --- | ---: | --- |", *rows] if rows else []


def sweep_markdown(sweep, of):
    reference = sweep.reference
    note = f" ({reference.note})" if reference.note else ""
    lines = [f"{case_name(of.path)} by polybed {sweep.options.model}; the bed is {'chaotic' if sweep.chaotic else 'not chaotic'}; computing times are "
             f"{CLOCKS[sweep.options.clock]}",
             f"an error is the distance from the reference: {REFERENCE[reference.kind]}{note}", "", *advice(sweep), "", *table_of(sweep),
             *shares_of(f"what the error of {sweep.ranking} is made of", sweep.attribution),
             *shares_of(f"change of {sweep.ranking} where a datum is off by its usual uncertainty", sweep.inputs)]
    if sweep.additive_off is not None:
        lines += ["", f"errors of the parts added in squares are off by {100 * sweep.additive_off:.2g} %"]
    for warning in sweep.warnings:
        lines += ["", f"warning: {warning}"]
    lines += ["", f"outcome {sweep.outcome}, commit {of.commit}"]
    return "\n".join(lines) + "\n"
