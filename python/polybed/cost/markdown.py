"""cost.md: the table of a sweep, what its error is made of, and advice."""

from pathlib import Path

from polybed.cost.judge import advice, settings_text
from polybed.cost.timing import timing_of
from polybed.cost.work import weighed


def percent(share):
    return "-" if share is None else f"{100 * share:.2g}"


def cell_of(row, name):
    quantity = row.quantities.get(name)
    return "-" if quantity is None else f"{100 * quantity.error:.2g} +- {percent(quantity.error_interval)}"


def status_of(sweep, number):
    """How much dearer a dominated row is than the cheapest that is at least as accurate; whether a row is recommended."""
    row = sweep.rows[number]
    if sweep.recommendation and sweep.recommendation.row == number:
        return f"{row.status} <- {100 * sweep.options.target:.2g} % on {sweep.ranking}"
    if row.status != "dominated":
        return row.status
    error = row.quantities[sweep.ranking].error
    least = min([row.rate, *(r.rate for r in sweep.rows if r.status == "pareto" and r.quantities[sweep.ranking].error <= error)])
    return f"dominated: {row.rate / least:.2g} x dearer" if 0 < least < row.rate else row.status


def table_of(sweep):
    names = sweep.options.quantities
    lines = ["| # | settings | s/sim-s | work, s | CPU, s |" + "".join(f" {name} % |" for name in names) + " status |",
             "| ---: | --- | ---: | ---: | ---: |" + " ---: |" * len(names) + " --- |"]
    for n, row in enumerate(sweep.rows):
        seconds = timing_of(row.cpu).median if row.cpu else 0.0
        cells = [str(n), settings_text(sweep, row), f"{row.rate:.3g}", f"{weighed(row.outcome.counters):.3g}", f"{seconds:.3g}",
                 *(cell_of(row, name) for name in names), status_of(sweep, n)]
        lines.append(f"| {' | '.join(cells)} |")
    return lines


def shares_of(title, shares):
    rows = [f"| {share.row} | {percent(share.value)} | {share.note} |" for share in shares]
    return ["", f"| {title} | % | |", "| --- | ---: | --- |", *rows] if rows else []


def sweep_markdown(sweep, of):
    """The text of cost.md."""
    path = Path(of.path)
    name, reference = path.parent.name if path.name == "case.toml" else path.name, sweep.reference
    note = f" ({reference.note})" if reference.note else ""
    lines = [f"case {name}   model {sweep.options.model}   {'chaotic' if sweep.chaotic else 'not chaotic'}   "
             f"reference: {reference.kind or 'none'}{note}",
             f"clock {sweep.options.clock}   outcome {sweep.outcome}   commit {of.commit}", "", *advice(sweep), "", *table_of(sweep),
             *shares_of(f"error of {sweep.ranking}", sweep.attribution),
             *shares_of("input, changed by what it is usually known to", sweep.inputs)]
    if sweep.additive_off is not None:
        lines += ["", f"additive model off by {100 * sweep.additive_off:.2g} %"]
    for warning in sweep.warnings:
        lines += ["", f"warning: {warning}"]
    return "\n".join(lines) + "\n"
