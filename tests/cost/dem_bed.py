"""The bed that dem_peers.py gives every program: material, time step, list, and the particles; SI.

All particles drift together by half the skin in LIST_EVERY steps. Contacts do not notice; a program that renews its
neighbour list when a particle has moved half the skin does so about as often as one that renews it every LIST_EVERY
steps, and particles keep crossing the periodic faces and those between ranks. Without gravity the rest comes to rest.
"""
import math

import numpy as np

import dem_packing

DIAMETER, DENSITY = 1e-3, 2500.0
YOUNG, POISSON, FRICTION, RESTITUTION = 1e7, 0.25, 0.5, 0.9
STEP = 5e-6  # s; 0.1 over the frequency of a contact as pressed as these are, and 0.1 of the time of a Rayleigh wave
SKIN = 0.1 * DIAMETER
LIST_EVERY = 100
SPEED = 0.01  # m/s: standard deviation of each component of the velocity and of that of the surface from spin
FRACTION, COUNT, SEED = 0.64, 4000, 1

MASS = DENSITY * math.pi / 6 * DIAMETER**3
REDUCED_RADIUS, REDUCED_MASS = DIAMETER / 4, MASS / 2
YOUNG_OF_PAIR = YOUNG / (2 * (1 - POISSON**2))  # E*: 1/E* = sum (1 - nu^2)/E
SHEAR_OF_PAIR = YOUNG / (4 * (1 + POISSON) * (2 - POISSON))  # G*: 1/G* = sum (2 - nu)/G, G = E/(2(1 + nu))
DAMPING_RATIO = math.sqrt(4 * SHEAR_OF_PAIR / YOUNG_OF_PAIR)  # c_t/c_n, as S_t/S_n = 4 G*/E*


def damping_ratio(restitution):
    """beta = -ln e/sqrt(pi^2 + ln^2 e): of a contact that may pull while it opens."""
    log = math.log(restitution)
    return -log / math.sqrt(math.pi**2 + log**2)


def normal_damping(overlap):
    """c_n = 2 sqrt(5/6) beta sqrt(S_n m*), S_n = 2 E* a, a the contact radius: kg/s."""
    stiffness = 2 * YOUNG_OF_PAIR * math.sqrt(REDUCED_RADIUS * overlap)
    return 2 * math.sqrt(5 / 6) * damping_ratio(RESTITUTION) * math.sqrt(stiffness * REDUCED_MASS)


def settle(count=COUNT):
    return dem_packing.settle(count, FRACTION, SEED)


def make(packing, copies=1):
    """The bed of copies^3 times the settled packing, each particle with a random velocity and spin of its own.

    contacts and listed: per particle, in contact and within the skin of it; overlap_m: mean of the contacts.
    """
    x, box = packing
    overlap = dem_packing.overlaps(x, box, dem_packing.within(x, box, 1 + SKIN / DIAMETER))[0]
    touching = overlap[overlap > 0]
    facts = {"contacts": 2 * len(touching) / len(x), "listed": 2 * len(overlap) / len(x),
             "overlap_m": float(touching.mean()) * DIAMETER}
    x, box = dem_packing.tile(x, box, copies)
    random = np.random.default_rng((SEED, copies))
    v, spin = random.normal(0, SPEED, x.shape), random.normal(0, 2 * SPEED / DIAMETER, x.shape)
    drift = SKIN / 2 / (LIST_EVERY * STEP)
    v += drift / math.sqrt(3) - v.mean(axis=0)
    return facts | {"count": len(x), "box": box * DIAMETER, "x": x * DIAMETER, "v": v, "w": spin,
                    "drift_J": 0.5 * len(x) * MASS * drift**2}
