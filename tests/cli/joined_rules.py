"""What breaks the rules of joined ends in a fluid, in words of --set: see case_rules_test.py."""
AIR, TILTED = ["fluid.name=air", "fluid.equation_of_state=ideal_gas"], "column.gravity_direction=[1,-1]"
AT_TOP = ('inlet.at = "top"', "inlet.at=top")
JOINED = "column.ends=periodic"


def jets(*parts):
    return "jet=[" + ", ".join(f"{{from={a}, to={b}, superficial_velocity=0.1}}" for a, b in parts) + "]"


JOINED_IN_FLUID = {
    **{f'column.ends = "periodic" in a fluid and {what} cannot be combined yet: {remedy}': [JOINED, *settings] for what, remedy, settings in (
        ("column.grading_across", "leave it out", ["column.grading_across=1.1"]),
        ("a round column", 'use column.shape = "box"', ["column.shape=axisymmetric"]),
        ("column.gravity_direction other than down", "leave it out", [TILTED]),
        ("a compressible fluid, whose pressure is given at a top,", 'use fluid.equation_of_state = "incompressible"', AIR))},
    'column.pressure_gradient = "weight" and dem.held = true contradict each other: the fluid does not carry particles that are held; give a '
    "number, negative for an upward flow": [JOINED, "dem.held=true"],
    'column.pressure_gradient cannot act: it drives a fluid between joined ends, column.ends = "periodic"': ["column.pressure_gradient=-100 Pa/m"],
    **{f"{what} cannot act between joined ends: column.pressure_gradient drives the fluid": [JOINED, setting] for what, setting in (
        ("inlet.superficial_velocity", "inlet.superficial_velocity=0.1"), ("[[jet]]", jets(([0.01], [0.02]))), AT_TOP)},
    'bed.start = "settled" and column.ends = "periodic" contradict each other: there is no bottom that carries the bed; use "mixed"': [
        JOINED, "bed.start=settled"],
    "column.pressure_gradient = {} Pa/m: the speed that it gives to particles is unknown and sets their step: give dem.greatest_speed": [
        JOINED, "inlet.superficial_velocity=!", "column.pressure_gradient=-100"],
}
