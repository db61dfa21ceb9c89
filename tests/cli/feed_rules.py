"""For each rule of particles that are fed what breaks it, in words of --set as in case_rules_test.py."""


def feeds(*parts, species="fine", velocity=1):
    return "feed=[" + ", ".join(f'{{species="{species}", velocity={velocity}, superficial_velocity=0.1{part}}}' for part in parts) + "]"


FEEDS = {
    "feed.from and feed.to have {} and {} numbers: {} here": [feeds(", from=[0.02]")],
    "a feed from {} to {} m {}": [feeds(", from=[0.02], to=[0.01]")],
    'feed.species = "{}": no such species': [feeds("", species="fin")],
    "a feed of {} of {} m/s at a velocity of {} m/s would be denser than the settled bed: raise feed.velocity above {} m/s": [
        feeds("", velocity=0.1)],
    "two feeds of {} overlap: [[feed]] number {} and {}": [feeds("", ", from=[0.02], to=[0.03]")],
    "[[feed]] of {} takes every cell of the top, where none of it can leave then though column.outlet = \"open\": give feed.from and feed.to "
    'for a part of the top, or column.outlet = "screen"': [feeds(', at="top"'), "column.outlet=open"],
    "dem.held = true and [[feed]] contradict each other: held particles do not move away from where they enter; leave one of them out": [
        "dem.held=true", feeds("")],
    "[[feed]] of {}: from {} to {} m there is less room than a particle needs, {} m: move feed.from and feed.to apart": [
        feeds(", from=[0.02], to=[0.0205]")],
    "[[feed]] of {}: particles that fill {} of the volume in which they enter find no random places, which takes at most {}: raise "
    "feed.velocity to {} m/s, or feed less": [feeds("", velocity=0.25)],
}
