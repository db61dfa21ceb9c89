#!/usr/bin/python3
"""What the account of energy misses of one impact, by the scheme alone and apart from the engine: a sphere on a plane, Hertz's
spring and a dashpot, the thesis scheme, the mean over phases at which the touch falls in a step. Prints the energy that motion
lacks over what the impact dissipates, against the steps in the contact. impact_account.py [RESTITUTION], default 0.9"""
import sys

import numpy as np

CONTACT = 2.9432751843 * 1.25**0.4  # duration of the elastic impact with mass, speed and Hertz's constant 1
STEPS = (20, 24, 28, 33, 40, 60, 80)
PHASES = (np.arange(32) + 0.5) / 32


def impact(steps, beta, clip, phases=PHASES):
    """Energy after, dissipated energy counted in over that before; speed after; dissipated energy. One row per phase."""
    dt = CONTACT / steps
    depth, speed = -dt * phases, np.ones_like(phases)
    force, dashpot, lost, parting = (np.zeros_like(phases) for _ in range(4))
    touched = inside = np.zeros(len(phases), bool)
    while not (touched & ~inside).all():
        going = ~(touched & ~inside)
        speed = np.where(going, speed - 0.5 * dt * force, speed)
        depth = np.where(going, depth + dt * speed, depth)
        ended = going & inside & (depth <= 0)
        inside = np.where(going, depth > 0, inside)
        overlap = np.where(inside, depth, 0)
        elastic = overlap**1.5
        total = elastic + 2 * beta * np.sqrt(1.5 * np.sqrt(overlap)) * speed
        total = np.where(inside, np.maximum(total, 0) if clip else total, 0)
        now = total - elastic
        # half of the last force's work and half of this one's over the drift; of a contact that ends what it still held
        lost = lost + np.where(inside, 0.5 * dt * (dashpot + now) * speed, 0) + np.where(ended, parting, 0)
        parting = np.where(inside & (total == 0), 0.4 * elastic * overlap, np.where(inside, 0.5 * dt * now * speed, 0))
        speed = np.where(going, speed - 0.5 * dt * total, speed)
        force, dashpot, touched = total, now, touched | inside
    return speed**2 + 2 * lost - 1, -speed, 2 * lost


def damping(restitution, clip):
    """Damping ratio that gives a restitution, by bisection with a fine step."""
    low, high = 0.0, 0.5
    for _ in range(40):
        middle = 0.5 * (low + high)
        if impact(2000, middle, clip, PHASES[:1])[1][0] > restitution:
            low = middle
        else:
            high = middle
    return low


def main(restitution=0.9):
    for clip in (True, False):
        beta = damping(restitution, clip)
        misses = [impact(steps, beta, clip) for steps in STEPS]
        text = "  ".join(f"{steps}: {-miss.mean() / lost.mean():.1e}" for steps, (miss, _, lost) in zip(STEPS, misses))
        print(f"tail {'clipped' if clip else 'kept'}, steps in the contact  {text}")


main(*map(float, sys.argv[1:2]))
