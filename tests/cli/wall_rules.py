"""For each rule of a round or graded column and of walls inside what breaks it, in words of --set as in case_rules_test.py."""
from feed_rules import feeds
from layer_rules import COUNTED, FINE, layers

ROUND = ["column.shape=cylinder", "column.size=[0.06,0.06,0.2]", "column.cells=[6,6,20]"]
AROUND = "column.shape=axisymmetric"


def tapered(*rows):
    """Of a column of 120 mm by 200 mm in cells of 10 mm."""
    return [AROUND, "column.profile=" + str([list(row) for row in rows])]


TAPERED = tapered((0, 0.06), (0.1, 0.12), (0.2, 0.12))
GRADED = "column.grading=1.1"
ACROSS = "column.grading_across=1.1"


def wall(start, end, shape="flat", thickness=0):
    return f'wall=[{{from={start}, to={end}, shape="{shape}", thickness={thickness}}}]'


WALLS = {
    "column.grading = {} needs column.graded_above, the height above which layers of cells grow: above the bed when it is expanded": [GRADED],
    "column.graded_above cannot act without column.grading, the ratio of the heights of layers, for example 1.1": ["column.graded_above=0.1"],
    "column.graded_above = {} m leaves no layers to grade in a column of {} m: lower it, or leave out column.grading": [
        GRADED, "column.graded_above=0.195"],
    "column.grading and column.profile cannot be combined yet: leave out one of them": [GRADED, "column.graded_above=0.1", *TAPERED],
    "column.grading and [[wall]] in a fluid cannot be combined yet: leave out one of them": [
        GRADED, "column.graded_above=0.15", wall([0.02, 0.1], [0.06, 0.1], thickness=0.02)],
    'column.grading_across makes cells smaller at flat side walls: it needs column.shape = "box" and column.sides = "wall"': [
        ACROSS, "column.sides=periodic"],
    "column.grading_across needs at least three cells across: column.cells has fewer": [ACROSS, "column.cells=[2, 20]"],
    "column.grading_across = {} makes cells in the middle {} times as wide as at the walls, at most 10: use a smaller ratio or fewer cells": [
        ACROSS, "column.cells=[60, 20]"],
    **{f"column.grading_across and {what} cannot be combined yet: leave out one of them": [ACROSS, *words] for what, words in (
        ("[[jet]]", ["jet=[{from=[0.02], to=[0.04], superficial_velocity=0.1}]"]), ("[[feed]]", [feeds("")]),
        ("[[discharge]]", ['discharge=[{at="right", pressure=0, from=[0.1], to=[0.12]}]']),
        ("[[wall]]", [wall([0.02, 0.1], [0.06, 0.1], thickness=0.02)]),
        ("[[layer]] with from", [*COUNTED, layers(FINE + ", from=[0.02], to=[0.04]")]),
        ("a compressible fluid", ["fluid.equation_of_state=tait"]),
        ("column.gravity_direction other than down", ["column.gravity_direction=[0.1, -1]"]))},
    "[[wall]] number {} is a rod without thickness: give its diameter in wall.thickness": [wall([0.02, 0.1], [0.02, 0.1], "rod")],
    'column.shape = "cylinder" takes column.size = [diameter, diameter, height]': ["column.shape=cylinder"],
    "species.diameter: {} m is more than half the diameter of the round column, {} m": [
        "column.shape=cylinder", "column.size=[0.0015,0.0015,0.2]", "column.cells=[1,1,20]"],
    'column.shape = "axisymmetric" takes column.size = [radius, height]': ["column.shape=axisymmetric", *ROUND[1:]],
    'column.depth and column.shape = "axisymmetric" contradict each other: leave column.depth out': [AROUND, "column.depth=0.01"],
    'column.sides = "periodic" and column.shape = "{}" contradict each other: use column.sides = "wall"': [
        *ROUND, "column.sides=periodic"],
    "[[layer]] number {} has corners, a round column has none: leave layer.from and layer.to out": [
        *ROUND, *COUNTED, layers(FINE + ", from=[0.02, 0.02], to=[0.04, 0.04]")],
    "[[feed]] of {} reaches beyond the round column, {} m in diameter: move feed.from and feed.to inwards, or leave them out": [
        *ROUND, feeds(", from=[0.0, 0.02], to=[0.04, 0.04]")],
    "[[jet]] number {} reaches beyond the round column, {} m in diameter: move jet.from and jet.to inwards": [
        *ROUND, "jet=[{from=[0, 0.02], to=[0.04, 0.04], superficial_velocity=0.1}]"],
    "column.cells: {} cells across and {} deep in a round column: at most four times as many one way": [*ROUND, "column.cells=[1, 6, 20]"],
    'column.profile is for round columns: use column.shape = "axisymmetric" or "cylinder"': TAPERED[1:],
    "column.profile goes from {} to {} m: from 0 to the height of the column, {} m": tapered((0, 0.06), (0.1, 0.12)),
    "column.profile: too many pairs at {} m: a step inside has two, each end has one": tapered((0, 0.06), (0.1, 0.06), (0.1, 0.08), (0.1, 0.12), (0.2, 0.12)),
    "column.profile is {} m in diameter where it is widest, column.size {} m: make them equal": tapered((0, 0.06), (0.2, 0.1)),
    "column.profile: {} m at its narrowest are {} cells, at least {}: take more cells in column.cells": tapered((0, 0.03), (0.2, 0.12)),
    "wall.from and wall.to have {} and {} numbers: 2 here, x and y, or diameter and height of a round one": [wall([0.01], [0.02, 0.01])],
    "[[wall]] number {} is {} m in diameter at its narrow end, less than two particles, {} m: widen it": [
        wall([0.0015, 0.1], [0.02, 0.12], "cone")],
    '[[wall]] number {} has diameters of {} and {} m: a cylinder has one; use shape = "cone"': [wall([0.01, 0.1], [0.02, 0.12], "cylinder")],
    "[[wall]] number {} does not lie in the column, {} m wide and {} m high": [wall([0, 0.1], [0.5, 0.01])],
    "[[wall]] number {} has no length: its ends are one point": [wall([0.01, 0.01], [0.01, 0.01])],
    '[[wall]] number {} is flat beside round walls: use shape = "cone" or "cylinder" for all of them, or column.shape = "box" and flat ones': [
        *ROUND, wall([0, 0.05], [0.02, 0.01])],
    **{f"[[wall]]: {told}": [wall([0, 0.05], [0.02, 0.01]), *words] for told, words in (
        ("[[jet]], [[feed]] and [[discharge]] in the sides cannot be combined with it in a fluid yet, except in a cylinder where it is round and "
         "at most half as wide",
         ['jet=[{at="left", from=[0.05], to=[0.08], superficial_velocity=0.1}]']),
        ('bed.start = "layered" cannot be combined with it in a fluid; use "mixed"', ["bed.start=layered"]),
        ('column.sides = "periodic" would end it at the side; use "wall"', ["column.sides=periodic"]),
        ('column.ends = "periodic" cannot be combined with it; use "wall"', ["column.ends=periodic"]),
        ('bed.start = "random" would place particles on both sides of it; use "mixed"', ["bed.start=random"]))},
    '[[wall]] number {} is {} m thick, in the fluid it needs {} m or more on these cells, a rod twice as much as a cell: give wall.thickness, '
    'take smaller cells, or set fluid.name = "none"': [wall([0.02, 0.1], [0.06, 0.1], thickness=0.005)],
    "[[wall]] number {} begins {} m above the bottom, through which the fluid enters: at least one cell, {} m": [
        wall([0.02, 0.01], [0.06, 0.01], thickness=0.01)],
    "[[wall]]: a cone or cylinder needs three dimensions; give column.size three numbers": [wall([0.02, 0.01], [0.04, 0.05], "cone")],
}

# Of one model.
ROUND_OF_MODELS = {
    "{} number {} lies on cells that the round wall cuts off: move it inwards, or take smaller cells": [
        *ROUND, "column.cells=[8,8,20]", "jet=[{from=[0.0064, 0.0130], to=[0.0074, 0.0149], superficial_velocity=0.1}]"],
    'column.shape = "{}" and tfm.solids_wall = "{}" cannot be combined yet: the solids slip freely along round walls': [
        AROUND, "tfm.solids_wall=johnson_jackson"],
    '[[wall]] and tfm.solids_wall = "{}" cannot be combined yet: the solids slip freely along walls inside': [
        wall([0.02, 0.1], [0.06, 0.1], thickness=0.02), "tfm.solids_wall=no_slip"],
    "[[wall]] in a round column with a fluid: polybed tfm can run it, polybed dem cannot yet": [
        *ROUND, wall([0.02, 0.1], [0.02, 0.15], "cylinder", 0.015)],
    '[[wall]] in a fluid and bed.start = "list:FILE" or "checkpoint:FILE" cannot be combined yet in polybed dem: particles could begin inside '
    'a wall; use "mixed"': [wall([0.02, 0.1], [0.06, 0.1], thickness=0.02), "bed.start=list:particles.csv"],
    '[[wall]] and dem.own_share = "removed" cannot be combined yet; use dem.own_share = "kept"': [
        wall([0.02, 0.1], [0.06, 0.1], thickness=0.02), "dem.own_share=removed"],
    'column.shape = "cylinder" and dem.own_share = "removed" cannot be combined yet; use dem.own_share = "kept"': [
        *ROUND, "dem.own_share=removed"],
    'column.grading and dem.own_share = "removed" cannot be combined yet; use dem.own_share = "kept"': [
        GRADED, "column.graded_above=0.1", "dem.own_share=removed"],
    'column.grading_across and collisions of solids in effects.solids_stress cannot be combined yet: use "frictional"': [
        ACROSS, "effects.solids_stress=kinetic"],
    "column.grading_across: polybed tfm can run it, polybed dem cannot yet": [ACROSS],
}
ROUND_FOR_ONE_MODEL = {
    'column.shape = "axisymmetric": polybed tfm can run it, polybed dem cannot: particles go around the axis; use "cylinder"': [AROUND],
}
