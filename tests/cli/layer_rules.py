"""For each rule of layered beds what breaks it, in words of --set as in case_rules_test.py."""

COUNTED = ["bed.volume_share=!", "bed.static_height=!"]  # the amount is said elsewhere
FINE = 'species="fine", height=0.02'


def layers(*parts):
    return "layer=[" + ", ".join(f"{{{part}}}" for part in parts) + "]"


LAYERS = {
    'bed.layer cannot act: bed.start is not "layered"': ["bed.layer=[1]"],
    "bed.layer has {} numbers, there are {} species": ["bed.start=layered", "bed.layer=[1, 2]"],
    'bed.start = "{}" and [[layer]] both say where the bed starts: leave bed.start out': [*COUNTED, layers(FINE), "bed.start=mixed"],
    "bed.particles and [[layer]] both say how much there is: leave bed.particles out": [*COUNTED, layers(FINE), "bed.particles=[10]"],
    "bed.layer and [[layer]] both say what the layers are: leave bed.layer out": [*COUNTED, layers(FINE), "bed.layer=[1]"],
    "bed.volume_share differs from the shares in [[layer]]: leave bed.volume_share out": [layers(FINE), "bed.volume_share=[0.9]"],
    "bed.static_height differs from the amount in [[layer]]: leave bed.static_height out": [layers(FINE)],
    "[[layer]] number {} has {} of layer.species and layer.volume_share: give one of them": [*COUNTED, layers("height=0.02")],
    'layer.species = "{}": no such species; {}': [*COUNTED, layers('species="fin", height=0.02')],
    "layer.volume_share has {} numbers, there are {} species": [*COUNTED, layers("volume_share=[0.5, 0.5], height=0.02")],
    "layer.volume_share sums to {}, not to 1": [*COUNTED, layers("volume_share=[0.9], height=0.02")],
    "layer.from and layer.to have {} and {} numbers: {} here": [*COUNTED, layers(FINE + ", from=[0.01, 0.02], to=[0.03]")],
    "a layer from {} to {} m {}": [*COUNTED, layers(FINE + ", from=[0.02], to=[0.07]")],
    "[[layer]] number {} does not lie level: only {} % of it lies on layers up to {} m high; give a [[layer]] for each part": [
        *COUNTED, layers(FINE + ", from=[0], to=[0.03]", FINE)],
    "layer.solids_fraction = {}: spheres of these sizes fill at most {} of the volume, and about 0.6 when they settle": [
        *COUNTED, layers(FINE + ", solids_fraction=0.85")],
}
