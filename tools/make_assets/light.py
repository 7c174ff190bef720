"""The light of the show: an arctic dusk. What the scripts bake into vertex colours (linear, 1 is
white).

Cool light of sky and aurora from above and from the viewer's left, a last warm band over the end of
the fjord, and the warm lamps. Frame: wall, metres.
"""

import math

from mesh import add, clamp, dot, mix, mul, scaled, sub, unit
from noise import fbm

WATER_Y = -1.2  # the fjord's level; the wall's lower edge is at -1.119
DUSK_AZIMUTH = 0.10  # of the warm band, radians to the right of -z
SKY_UP = (0.085, 0.150, 0.205)
SKY_DOWN = (0.020, 0.038, 0.060)
MOON = (0.20, 0.29, 0.36)
TO_MOON = unit((-0.62, 0.62, 0.48))
DUSK = (0.55, 0.22, 0.10)
TO_DUSK = unit((0.10, 0.16, -1.0))
LAMP = (1.0, 0.50, 0.17)


def gaussian(x, width):
    return math.exp(-0.5 * (x / width) ** 2)


def sky_colour(azimuth, elevation):
    """Radiance of the sky without aurora; radians, elevation >= 0."""
    e = math.degrees(elevation)
    a = math.degrees(azimuth - DUSK_AZIMUTH)
    colour = mix((0.020, 0.090, 0.150), (0.0045, 0.011, 0.034), 1 - math.exp(-e / 19))
    teal = 0.7 * math.exp(-e / 9.0)
    colour = add(colour, mul((0.020, 0.085, 0.105), teal))
    rose = gaussian(a, 46) * math.exp(-e / 11.0)
    colour = add(colour, mul((0.150, 0.052, 0.090), rose))
    glow = gaussian(a, 34) * math.exp(-((e / 7.0) ** 1.2))
    return add(colour, mul((1.10, 0.42, 0.11), glow))


def fogged(colour, position, density=1 / 5600.0):
    """Aerial perspective towards the sky's colour at the horizon in that direction."""
    x, y, z = position
    distance = math.sqrt(x * x + z * z)
    azimuth = math.atan2(x, -z)
    height = max(0.0, y - WATER_Y)
    amount = 1 - math.exp(-distance * density * math.exp(-height / 900.0))
    amount = amount + (0.30 * math.exp(-height / 60.0)) * (1 - math.exp(-distance / 900.0)) * (
        1 - amount
    )
    veil = mul(sky_colour(azimuth, math.radians(3.5)), 0.82)
    return mix(colour, veil, clamp(amount))


def lamp_light(position, normal, lamps, wrap=0.15):
    """Irradiance from point lamps ((x, y, z), strength, reach in metres)."""
    total = 0.0
    for place, strength, reach in lamps:
        d = sub(place, position)
        squared = dot(d, d)
        if squared > 9 * reach * reach:
            continue
        facing = max(0.0, (dot(normal, d) / math.sqrt(squared + 1e-9) + wrap) / (1 + wrap))
        fade = 1 - squared / (9 * reach * reach)
        total += strength * facing * fade / (1 + squared / (reach * reach) * 4)
    return mul(LAMP, total)


def shade(position, normal, albedo, lamps=(), shadow=1.0):
    """Diffuse light of the dusk on a surface; `shadow` dims sky and moon."""
    up = 0.5 + 0.5 * normal[1]
    light = mul(mix(SKY_DOWN, SKY_UP, up), shadow)
    light = add(light, mul(MOON, max(0.0, dot(normal, TO_MOON)) * shadow))
    light = add(light, mul(DUSK, max(0.0, dot(normal, TO_DUSK)) * 0.8))
    light = add(light, lamp_light(position, normal, lamps))
    return scaled(albedo, light)


def grain(position, scale=9.0, seed=5):
    """A factor around 1 that keeps a surface from looking like plastic."""
    x, y, z = position
    return 0.72 + 0.56 * fbm((x + 0.7 * z) * scale, (y + 0.31 * z) * scale * 0.35, 2, seed)
