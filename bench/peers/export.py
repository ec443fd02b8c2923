#!/usr/bin/env python3
"""Turn a Phalanx scene into a Mitsuba 3 scene: FOLDER/scene.xml and its meshes.

What Mitsuba cannot express in the same way is an error that names the key; nothing is dropped.
The filter is left out on purpose: both renderers are compared with a box of one pixel.
"""
import argparse
import json
import os
import sys

import numpy as np

NO_ROULETTE = 1_000_000
CAMERAS = {"pinhole": "perspective", "thin_lens": "thinlens", "orthographic": "orthographic"}


def camera_plugin(keys, film):
    import mitsuba as mi
    kind = keys.get("type", "pinhole")
    if kind not in CAMERAS:
        keys.refuse("type", f"'{kind}' has no twin in Mitsuba")
    position, target = keys.vector("position", [0, 0, 0]), keys.vector("look_at", [0, 0, -1])
    distance = float(np.linalg.norm(target - position))
    to_world = mi.ScalarTransform4f().look_at(
        position.tolist(), target.tolist(), keys.vector("up", [0, 1, 0]).tolist())
    plugin = {"type": CAMERAS[kind], "near_clip": 1e-3 * distance, "far_clip": 1e4 * distance,
              "sampler": {"type": "independent"}, "film": film}
    if kind == "orthographic":
        half_width = keys.get("height") / 2 * film["width"] / film["height"]
        to_world = to_world @ mi.ScalarTransform4f().scale([half_width, half_width, 1])
    else:
        plugin |= {"fov": float(keys.get("fov", 45)), "fov_axis": "y"}
    if kind == "thin_lens":
        plugin |= {"aperture_radius": float(keys.get("aperture_radius")),
                   "focus_distance": float(keys.get("focus_distance", distance))}
    keys.finish()
    return plugin | {"to_world": to_world}


def film_plugin(keys):
    plugin = {"type": "hdrfilm", "width": keys.get("width", 512), "height": keys.get("height", 512),
              "rfilter": {"type": "box"}, "pixel_format": "rgb", "component_format": "float32"}
    keys.get("filter", None), keys.get("exposure", 0)
    keys.finish()
    return plugin


def integrator_plugin(keys):
    """Ours counts scattering events, Mitsuba path edges: its 1 is what a camera sees directly."""
    if keys.get("type", "path") != "path":
        keys.refuse("type", "only path tracing is compared")
    keys.get("roulette_depth", 4)
    plugin = {"type": "path", "max_depth": keys.get("max_depth", 16) + 1, "rr_depth": NO_ROULETTE}
    keys.finish()
    return plugin


def scene_plugins(keys, folder, scene_folder, plain):
    """The scene as Mitsuba's nested dictionary; meshes are written to `folder`."""
    from export_lights import light_plugin
    from export_materials import Materials
    from export_shapes import Shapes, bsdf_id
    from export_textures import Textures
    for ignored in ("version", "description", "sampler"):
        keys.get(ignored, None)
    textures = Textures(keys.objects("textures"), folder, scene_folder)
    materials = Materials(keys.objects("materials"), textures, plain)
    scene = {"type": "scene", "integrator": integrator_plugin(keys.object("integrator")),
             "sensor": camera_plugin(keys.object("camera"), film_plugin(keys.object("film")))}
    scene |= {bsdf_id(name): bsdf for name, bsdf in materials.bsdf.items()}
    shapes = Shapes(materials, folder, scene_folder)
    plugins = [p for shape in keys.objects("shapes") for p in shapes.plugins(shape)]
    plugins += instance_plugins(keys, shapes, scene)
    plugins += [light_plugin(light, folder, scene_folder) for light in keys.objects("lights")]
    scene |= {f"object-{i}": plugin for i, plugin in enumerate(plugins)}
    keys.finish()
    return scene


def instance_plugins(keys, shapes, scene):
    """Groups become shape groups of `scene`; what shines in them is copied for each instance."""
    import mitsuba as mi
    from transforms import transform_of
    groups = {}
    for group in keys.objects("groups"):
        name, members = group.get("name"), group.objects("shapes")
        group.finish()
        groups[name] = [s for s in members if shapes.emits(s)]
        dark = [p for s in members if not shapes.emits(s) for p in shapes.plugins(s)]
        if dark:
            scene["group-" + name] = {"type": "shapegroup"} | {
                f"{name}-{i}": plugin for i, plugin in enumerate(dark)}
    plugins = []
    for instance in keys.objects("instances"):
        name, m = instance.get("group"), transform_of(instance)
        instance.finish()
        plugins += [p for shape in groups[name] for p in shapes.plugins(shape, placed=m)]
        if "group-" + name in scene:
            plugins.append({"type": "instance", "to_world": mi.ScalarTransform4f(m),
                            "group": {"type": "ref", "id": "group-" + name}})
    return plugins


def export_scene(scene, folder, scene_folder, plain=True):
    """`scene`: the parsed scene file. `scene_folder`: where its file names start. `plain`: with
    Mitsuba's own plugins only; else rough surfaces are adapted (correlated_masking.py,
    conserving_coat.py)."""
    from scene_keys import Keys
    os.makedirs(folder, exist_ok=True)
    return scene_plugins(Keys(scene, ""), folder, scene_folder, plain)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene")
    parser.add_argument("-o", "--output", required=True, metavar="FOLDER")
    options = parser.parse_args()
    import mitsuba as mi
    mi.set_variant("scalar_rgb")
    from scene_keys import Unsupported
    with open(options.scene) as file:
        scene = json.load(file)
    try:
        plugins = export_scene(scene, options.output, os.path.dirname(os.path.abspath(options.scene)))
    except Unsupported as problem:
        sys.exit(f"export: {options.scene}: {problem}")
    configuration = mi.parser.ParserConfig("scalar_rgb")
    parsed = mi.parser.parse_dict(configuration, plugins)
    mi.parser.write_file(parsed, os.path.join(options.output, "scene.xml"))


if __name__ == "__main__":
    main()
