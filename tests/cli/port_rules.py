"""For each rule of jets, feeds and discharges in sides what breaks it, in words of --set as in case_rules_test.py."""
from wall_rules import AROUND, ROUND, TAPERED


def part(table, *parts):
    """Entries of a table: at, from, to."""
    more = 'species="fine", velocity=1, ' if table == "feed" else ""
    entries = (f'{{{more}superficial_velocity=0.1, at="{at}", from={low}, to={high}}}' for at, low, high in parts)
    return f"{table}=[" + ", ".join(entries) + "]"


def open_side(at, low, high, more=""):
    """A discharge with a pressure."""
    return f'discharge=[{{pressure=0, at="{at}", from={low}, to={high}{more}}}]'


LOW, HIGH = ([0.02], [0.04]), ([0.1], [0.15])
PORTS = {
    **{f'{table}.at = "{{}}"{told}': [part(table, (at, *LOW)), *words] for table in ("jet", "feed", "discharge") for told, at, words in (
        (": a column of two dimensions has two sides, left and right", "front", []),
        (' and column.sides = "periodic" contradict each other: joined sides have no wall', "left", ["column.sides=periodic"]),
        (' is no side of an axisymmetric column, whose wall is "right"', "left", [AROUND]),
        (", from {} to {} m: a port lies where column.profile has its greatest diameter, {} m, as the grid ends there: {}", "right", TAPERED))},
    **{f'{table}.at = "{{}}" in a cylinder{told}': [part(table, ("left", [low, 0.02], [0.04, 0.04])), *ROUND, *words]
       for table in ("jet", "feed", "discharge") for told, low, words in (
           (f": {table}.from and {table}.to lie between {{}} and {{}} m across, where the wall faces that side: a part of the next side takes "
            "the rest", 0.005, []),)},
    'jet.at = "top": a jet enters through the bottom or a side': [part("jet", ("top", *LOW))],
    'discharge.at = "top": a discharge lies in the bottom or a side; solids leave through the top by column.outlet = "open"': [
        part("discharge", ("top", *LOW))],
    "[[discharge]] number {} reaches beyond the round column, {} m in diameter: move discharge.from and discharge.to inwards": [
        *ROUND, part("discharge", ("bottom", [0, 0.02], [0.04, 0.04]))],
    "discharge.from and discharge.to have {} and {} numbers: {} here": [part("discharge", ("left", [0.02, 0.01], [0.04, 0.03]))],
    "a discharge from {} to {} m {}": [part("discharge", ("left", [0.1], [0.3]))],
    "two discharges overlap: [[discharge]] number {} and {}": [part("discharge", ("left", *LOW), ("left", [0.03], [0.05]))],
    "[[discharge]] number {} overlaps [[{}]] number {}": [part("discharge", ("left", *LOW)), part("jet", ("right", *LOW), ("left", *LOW))],
    "[[discharge]] number {} takes discharge.superficial_velocity or, in a side, discharge.pressure: give one of them": [
        open_side("left", *LOW, more=", superficial_velocity=0.1")],
    "[[discharge]] number {} in the bottom cannot have a pressure, as the distributor's flow is given: use discharge.superficial_velocity": [
        open_side("bottom", *LOW)],
    '[[discharge]] number {} has a pressure, but inlet.at = "top" gives the flow at both ends: use discharge.superficial_velocity, or '
    'column.outlet = "lid" without inlet.at': [open_side("left", *LOW), "inlet.at=top"],
    "discharge.pressure = {} Pa of [[discharge]] number {} is below vacuum: it is relative to fluid.outlet_pressure = {} Pa; raise one of "
    "them": ["fluid.name=air", "fluid.equation_of_state=ideal_gas", 'discharge=[{pressure=-2e5, at="left", from=[0.02], to=[0.04]}]'],
    'column.outlet = "lid" needs a [[discharge]] with discharge.pressure, through which leaves what enters': ["column.outlet=lid"],
    "[[discharge]] number {} has a pressure and shares a cell with [[{}]] number {}: move them apart, or take smaller cells": [
        open_side("left", [0.02], [0.034]), part("jet", ("left", [0.036], [0.05]))],
    "[[discharge]] cannot act: column.closed = true": ["column.closed=true", part("discharge", ("left", *LOW))],
    'column.ends = "periodic" and [[discharge]] contradict each other': ["column.ends=periodic", part("discharge", ("left", *LOW))],
    "[[discharge]] cannot act in a sheared box: its fluid moves with its flow": ["dem.shear_rate=1", part("discharge", ("left", *LOW))],
    "[[discharge]] number {} and [[feed]] number {} share a cell ({}): move them apart, or take smaller cells": [
        part("discharge", ("left", [0.02], [0.034])), part("feed", ("left", [0.036], [0.05]))],
    "dem.opening = {} m: a [[discharge]] opens the bottom, too: leave one of them out": ["dem.opening=0.01", part("discharge", ("bottom", *LOW))],
}
PORTS_FOR_ONE_MODEL = {
    'discharge.at = "bottom" in a round column or under a round wall: polybed tfm can run it, polybed dem cannot: particles leave through the '
    'top, by column.outlet = "open", or without a fluid through dem.opening': [*ROUND, part("discharge", ("bottom", [0.02, 0.02], [0.04, 0.04]))],
    "[[discharge]] number {}: the largest particle, of {} m, must fit through: move discharge.from and discharge.to apart": [part("discharge", ("left", [0.1], [0.1005]))],
    "[[discharge]] number {} and {} touch but do not form one rectangle: polybed tfm can run it, polybed dem cannot, as particles would meet a "
    "rim there; make them one, or move them apart": [
        "column.size=['0.1 m', '0.2 m', '0.1 m']", "column.cells=[20, 40, 20]",
        part("discharge", ("left", [0, 0], [0.0625, 0.0625]), ("left", [0.0625, 0.03125], [0.09375, 0.09375]))],
    "[[discharge]] in a compressible fluid: polybed tfm can run it, polybed dem cannot: the mass of the fluid that takes the place of a particle "
    'as it leaves would be missing; use fluid.equation_of_state = "incompressible"': [
        "fluid.name=air", "fluid.equation_of_state=ideal_gas", part("discharge", ("left", *HIGH))],
}
