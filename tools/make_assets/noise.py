"""Smooth, repeatable noise: value noise on a hashed lattice and sums of its octaves."""

import math


def hashed(x, y, z=0):
    """A number in [0, 1) for three whole numbers."""
    h = (x * 374761393 + y * 668265263 + z * 2147483647 + 1013904223) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    h = ((h ^ (h >> 16)) * 2246822519) & 0xFFFFFFFF
    return ((h ^ (h >> 15)) & 0xFFFFFF) / 0x1000000


def noise(x, y, seed=0):
    """In [0, 1), one feature per unit."""
    ix, iy = math.floor(x), math.floor(y)
    fx, fy = x - ix, y - iy
    fx, fy = fx * fx * (3 - 2 * fx), fy * fy * (3 - 2 * fy)
    a, b = hashed(ix, iy, seed), hashed(ix + 1, iy, seed)
    c, d = hashed(ix, iy + 1, seed), hashed(ix + 1, iy + 1, seed)
    low = a + (b - a) * fx
    return low + (c + (d - c) * fx - low) * fy


def fbm(x, y, octaves, seed=0):
    """In [0, 1): octaves of noise, each twice as fine and half as strong."""
    total, weight, scale = 0.0, 0.5, 1.0
    for k in range(octaves):
        total += weight * noise(x * scale + 17.3 * k, y * scale - 9.1 * k, seed + k)
        weight, scale = weight * 0.5, scale * 2.0
    return total / (1 - 0.5**octaves)


def ridged(x, y, octaves, seed=0):
    """In [0, 1]: sharp crests, for mountains (the detail grows where it is high already)."""
    total, weight, scale, gain, norm = 0.0, 1.0, 1.0, 1.0, 0.0
    for k in range(octaves):
        crest = 1 - abs(2 * noise(x * scale + 31.7 * k, y * scale + 11.9 * k, seed + k) - 1)
        crest *= crest
        total += crest * weight * gain
        norm += weight
        gain = min(1.0, crest * 1.6)
        weight, scale = weight * 0.5, scale * 2.03
    return total / norm
