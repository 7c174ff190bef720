"""The show, assets/show/show.glb: an arctic fjord at dusk behind a boat-ribbed hall that stands in
still water.

Coordinates are wall coordinates in metres (`--place as-is`). The water is a mirror because
everything above it is there twice: once upside down below the surface, which is a dark glass.
"""

import math

import gltf
import hall
import landscape
import orrery
import sky
from light import WATER_Y, fogged, shade
from mesh import Mesh, clamp, mul, placed, quaternion
from thin import thinned

REFLECTED = 0.86
EYES = [
    (x, y, z) for x in (-3, 3) for y in (-1.15, 2) for z in (0.05, 9)
]  # every eye is between these
# Radians that thinning may cost: of what is thin itself, near the screen, far away.
DELICATE, FINE, COARSE = 0.0003, 0.0007, 0.0022


def apparent(p):
    """Radians per metre at a place, from the nearest eye of those that matter; images in moving
    water need less.
    """
    aside = (max(0.0, abs(p[0]) - 1.2), max(0.0, abs(p[1] - 0.1) - 0.4), max(0.0, 0.4 - p[2]))
    share = 1.0 if p[1] > WATER_Y - 0.05 else 0.6
    return share / max(0.6, math.hypot(*aside))


def rippled_image(mesh):
    return hall.rippled(mesh.mirrored(WATER_Y))


def with_image(mesh, image, tolerance):
    """Both as they are seen, thinned; the image is dimmed."""
    whole = Mesh().append(mesh).append(image, tint=(REFLECTED, REFLECTED, REFLECTED))
    return thinned(whole.seen_from(EYES), tolerance, apparent)


def add_static(document, name, mesh, material, mirror=None):
    whole = Mesh().append(mesh)
    if mirror:
        whole.append(mirror, tint=(REFLECTED, REFLECTED, REFLECTED))
    whole = whole.seen_from(EYES)
    return document.node(name, document.mesh(name, whole, material))


def far_scene(document, baked):
    dome = Mesh().append(sky.dome(False)).append(sky.dome(True))
    texture = document.texture(sky.texture(), "dusk and aurora")
    document.node(
        "sky", document.mesh("sky", dome, document.material("sky", unlit=True, texture=texture))
    )
    document.node("stars", document.mesh("stars", sky.stars(), baked))
    mountains = thinned(landscape.mountains(390, 66), COARSE, apparent)
    add_static(document, "mountains", mountains, baked, mountains.mirrored(WATER_Y))
    forest = landscape.forest()
    add_static(document, "forest", forest, baked, forest.mirrored(WATER_Y))
    ground, built = landscape.islands()
    islands = with_image(ground, ground.mirrored(WATER_Y), COARSE)
    islands.append(with_image(built, built.mirrored(WATER_Y), FINE))
    add_static(document, "islands", islands, baked)


def near_scene(document, baked):
    """Hall, lamps, niche, reeds: one mesh. Returns the places of the halos."""
    lights = hall.lamps()
    timber, iron, glow, places = Mesh(), Mesh(), Mesh(), []
    for z in hall.RIB_Z:
        hall.rib(timber, z)
    hall.purlins(timber)
    timber.bake(hall.timber_light(lights))
    hall.posts(iron, glow, places)
    iron.bake(lambda p, n, c: fogged(shade(p, n, mul(c, 1.6), lights), p, 1 / 260.0))
    slight = Mesh().append(iron).append(glow)
    reeds = hall.reeds().bake(
        lambda p, n, c: shade(p, n, c, lights, 0.4 + 0.6 * clamp((p[1] - WATER_Y) * 3))
    )
    slight.append(reeds)
    frame = Mesh()
    hall.niche(frame)
    hall.mullions(frame)
    frame.bake(hall.niche_light(lights))
    whole = with_image(Mesh().append(timber).append(frame), rippled_image(timber), FINE)
    whole.append(with_image(slight, rippled_image(slight), DELICATE))
    add_static(document, "hall", whole, baked)
    return places


def boats(document, baked):
    """Two moored boats that rise and fall; each has its image."""
    moorings = (((-5.6, -10.5), 0.5, 0.0), ((6.4, -17.5), 2.5, 2.1))
    lights = hall.lamps()
    for k, ((x, z), turn, phase) in enumerate(moorings):
        at = placed((x, WATER_Y, z), quaternion((0, 1, 0), turn))
        world = Mesh().append(hall.boat(), at)
        place = at((1.6, 1.05, 0))
        body, glow = Mesh(), Mesh()
        hall.lantern(body, glow, place, 0.11)
        world.append(body)
        lamp = [(place, 1.4, 1.5)]
        world.bake(lambda p, n, c: fogged(shade(p, n, c, lights + lamp), p, 1 / 260.0))
        world.append(glow)
        world = thinned(world, FINE, apparent)
        for image in (False, True):
            part = world.mirrored(WATER_Y) if image else world
            local = Mesh().append(part, lambda p: (p[0] - x, p[1] - WATER_Y, p[2] - z))
            name = f"boat {k}" + (" image" if image else "")
            node = document.node(
                name, document.mesh(name, local, baked), translation=(x, WATER_Y, z)
            )
            rock(document, node, (x, z), phase, image)


def rock(document, node, place, phase, image):
    steps = 60
    times = [orrery.PERIOD * i / steps for i in range(steps + 1)]
    sign = -1 if image else 1
    waves = [2 * math.pi * 10 * i / steps + phase for i in range(steps + 1)]
    document.animate(
        node,
        "translation",
        times,
        [(place[0], WATER_Y + sign * 0.022 * math.sin(w), place[1]) for w in waves],
    )
    document.animate(
        node,
        "rotation",
        times,
        [quaternion((0.5, 0, 1), sign * 0.022 * math.sin(w + 1)) for w in waves],
    )


def glass(document, places):
    """All that is blended, from far to near: the water's surface, then the halos."""
    surface = document.material("water", unlit=True, blend=True)
    water = thinned(hall.water(), 2.5 * COARSE, apparent)
    document.node("water", document.mesh("water", water, surface))
    halos = Mesh()
    for (x, y, z), radius, strength in sorted(places, key=lambda p: p[0][2]):
        hall.halo(halos, (x, 2 * WATER_Y - y, z), 0.42 * radius, 0.55 * strength, stretch=2.6)
        hall.halo(halos, (x, y, z), radius, strength)
    x, y, z = orrery.CENTRE
    hall.halo(halos, (x, y, z - 0.09), 0.50, 0.42, (1.0, 0.62, 0.26))
    document.node(
        "halos",
        document.mesh(
            "halos", halos, document.material("halo", unlit=True, blend=True, double_sided=True)
        ),
    )


def make(file):
    document = gltf.Document("The window to the fjord")
    baked = document.material("baked", unlit=True)
    far_scene(document, baked)
    boats(document, baked)
    places = near_scene(document, baked)
    metal = document.material(
        "metal", (0.95, 0.95, 0.95, 1), metallic=1, roughness=0.26, emissive=(0.050, 0.026, 0.009)
    )
    enamel = document.material("enamel", metallic=0, roughness=0.28)
    ice = document.material(
        "ice", (0.85, 0.95, 1.0, 1), metallic=0, roughness=0.12, emissive=(0.01, 0.05, 0.07)
    )
    core = document.material("sun", unlit=True)
    orrery.build(document, metal, enamel, core, ice)
    glass(document, places)
    document.write(file)
