"""What the runs of dem_peers.py are judged by."""
import math
import statistics

MOST_SPREAD = 0.10  # of the CPU time over the runs; beyond it nothing is ranked
SAME_CONTACTS = 0.02
# Of the kinetic energy while it falls by half in 100 steps. LAMMPS and LIGGGHTS differ by 1.4 % with one law on paper,
# as they treat a spring that slides differently; another spring, 8 G* a dxi in place of 8 G* a xi, makes 7 to 10 %.
SAME_ENERGY = 0.05
BUSY = 0.95  # CPU over wall seconds of all ranks; below, other jobs had the cores
GOALS = {"LIGGGHTS": {1: 2.5}, "LAMMPS": {1: 1.3, 3: 1.2}}  # polybed's rate over the peer's, by copies of the packing
SPEED_UP = {3: 1.85}  # two ranks over one


def spread(values):
    """Of fewer than three runs nothing is known."""
    if len(values) < 3:
        return math.inf
    return (max(values) - min(values)) / statistics.median(values)


def rate_goals(mine, run, peers, copies):
    """polybed's rate on one rank against each peer's, as (sentence, met); met None: not judged."""
    lines = []
    for name, peer in peers.items():
        goal = next((goals.get(copies) for start, goals in GOALS.items() if name.startswith(start)), None)
        if goal is None:
            continue
        ratio = run["rate"] / peer["rate"]
        noisy = [n for n, r in ((mine, run), (name, peer)) if r["spread"] > MOST_SPREAD]
        note = f"; the times of {' and '.join(noisy)} spread by more than {MOST_SPREAD:.0%}" if noisy else ""
        sentence = f"{mine}: {ratio:.2f} times {name}, goal at least {goal:g}{note}"
        lines.append((sentence, None if noisy else ratio >= goal))
    return lines


def speed_up(name, one, two, copies):
    """Wall seconds of one rank over those of two."""
    goal = SPEED_UP[copies]
    gain = two["wall_rate"] / one["wall_rate"]
    note = "" if two["busy"] >= BUSY else f"; its cores were busy with other jobs for {1 - two['busy']:.0%} of the time"
    noisy = one["spread"] > MOST_SPREAD or two["spread"] > MOST_SPREAD
    note += f"; times spread by more than {MOST_SPREAD:.0%}" if noisy else ""
    return f"{name}: two ranks {gain:.2f} times one, goal at least {goal:g}{note}", None if note else gain >= goal


def same_contacts(runs):
    """All programs end with the same number of contacts per particle."""
    found = {name: run["contacts"] for name, run in runs.items() if run["contacts"] is not None}
    if len(found) < 2:
        return "contacts per particle: fewer than two programs", None
    apart = max(found.values()) / min(found.values()) - 1
    return (f"contacts per particle: {', '.join(f'{n} {c:.3f}' for n, c in found.items())}; apart by {apart:.2%}, "
            f"at most {SAME_CONTACTS:.0%}"), apart <= SAME_CONTACTS


def same_energy(first, second, traces):
    """Two programs with one law lose their kinetic energy alike."""
    pairs = [(a, b) for a, b in zip(traces[first], traces[second]) if a["step"] > 0]
    apart = max(abs(a["kinetic_J"] / b["kinetic_J"] - 1) for a, b in pairs)
    return (f"kinetic energy of {first} and {second}, same law, over {pairs[-1][0]['step']} steps: apart by "
            f"{apart:.2%}, at most {SAME_ENERGY:.0%}"), apart <= SAME_ENERGY
