"""For each rule of resolved flow what breaks it, in words of --set as in case_rules_test.py."""

FREE = ["resolve.motion=free", "resolve.voidage=[0.6]"]

RESOLVED = {
    "resolve.spheres = {} leaves none of species '{}': take more": [
        'species=[{name="fine", diameter=0.8e-3, density=1395}, {name="rare", diameter=0.8e-3, density=1395}]',
        "bed.volume_share=[0.999999, 1e-6]", "resolve.voidage=[0.6]"],
    "resolve.reynolds = {} at a voidage of {}: the viscosity would be {} in cells and steps, stable from {}; take "
    "resolve.cells_per_diameter = {} or more, or fewer resolve.grids": ["resolve.voidage=[0.6]", "resolve.reynolds=[300]"],
    "resolve.cells_per_diameter = {}: the pores are {} cells wide on the coarsest grid at a voidage of {}, they need {}; take {} or more, "
    "or fewer resolve.grids": ["resolve.voidage=[0.35]", "resolve.cells_per_diameter=6"],
    "resolve.spheres = {}: at a voidage of {} the box is {} of the largest diameters wide; spheres that travel need {}, so that none "
    "touches another and its image: take {} or more": [*FREE, "resolve.spheres=2"],
    "species.sphericity = {} of '{}': polybed resolve finds the drag on spheres; leave it out, or [resolve]": [
        "resolve.voidage=[0.6]", "species.fine.sphericity=0.9"],
    'resolve.motion = "free": the weight of the spheres decides on the Reynolds number; leave out resolve.reynolds': [
        *FREE, "resolve.reynolds=[5]"],
    'resolve.until is the time of free spheres, and resolve.motion = "{}": leave out resolve.until': ["resolve.until=1"],
    'effects.lubrication = "{}": resolve.motion = "free" resolves the flow between spheres; use "film" or "none"': [
        *FREE, "effects.lubrication=wet_restitution"],
    'resolve.motion = "free" needs {}': ["resolve.motion=free", "column.gravity=0"],
    "resolve.motion = \"free\": species '{}' is {} times as dense as the fluid; drag acts on free spheres one step late, which is stable "
    "from {} times on": [*FREE, "species.fine.density=1050"],
    "resolve.cells_per_diameter = {}: free spheres at a voidage of {} would fall at a viscosity of {} in cells and steps, stable from {}; take "
    "{} or more, or fewer resolve.grids": [*FREE, "species.fine.density=9000"],
}
