"""Materials: which BSDF of Mitsuba scatters as ours does.

Ours scatter on both sides unless light passes through them; Mitsuba's reflect on the outer side
only, so they are wrapped in "twosided".
"""
import os
import re

import numpy as np

from export_textures import rgb
from scene_keys import Unsupported

LOBES = {"conductor": {"smooth"}, "dielectric": {"smooth"}, "thindielectric": {"smooth"},
         "null": {"smooth"}, "mask": {"smooth", "rough"}, "plastic": {"smooth", "rough"}}
LEAST_ALPHA = 1e-3  # below it microfacets become a smooth surface


def alpha_of(keys, default):
    """Width of the microfacet distribution: the key alpha, or roughness squared."""
    if "alpha" in keys:
        return float(keys.get("alpha"))
    roughness = keys.get("roughness", default)
    if isinstance(roughness, str):
        keys.refuse("roughness", "Mitsuba's textures hold alpha, which is its square")
    return float(roughness) ** 2


def reflecting(keys, bsdf):
    """On both sides, unless the material says otherwise."""
    if keys.get("one_sided", False):
        return bsdf
    return {"type": "twosided", "bsdf": bsdf}


def diffuse(keys, materials):
    return reflecting(keys, {"type": "diffuse",
                             "reflectance": materials.textures.colour(keys, "reflectance", 0.5)})


def mirror(keys, materials):
    """Only the perfect one: ours follows Schlick's curve, Mitsuba's smooth metals Fresnel's."""
    if isinstance(keys.get("reflectance", 0.5), str) or np.any(keys.colour("reflectance", 0.5) != 1):
        keys.refuse("reflectance", "Schlick's curve on a smooth surface; only 1 has a twin")
    return reflecting(keys, {"type": "conductor", "material": "none"})


def dielectric(keys, materials):
    alpha = alpha_of(keys, 0)
    bsdf = glass("dielectric" if alpha < LEAST_ALPHA else "roughdielectric", keys, materials)
    if alpha < LEAST_ALPHA:
        return bsdf
    bsdf |= {"distribution": "ggx", "alpha": alpha, "sample_visible": True}
    return materials.masked(bsdf, alpha, alpha)


def thin_dielectric(keys, materials):
    return glass("thindielectric", keys, materials)


def glass(kind, keys, materials):
    return {"type": kind, "int_ior": float(keys.get("ior", 1.5)), "ext_ior": 1.0,
            "specular_reflectance": materials.textures.colour(keys, "specular", 1),
            "specular_transmittance": materials.textures.colour(keys, "transmittance", 1)}


def conductor(keys, materials):
    """eta and k: Fresnel's equations. A reflectance: Schlick's curve, as the metallic half of
    "principled" has it."""
    if keys.get("multiple_scattering", False):
        keys.refuse("multiple_scattering", "Mitsuba's metals scatter once only")
    if "roughness_x" in keys:
        alpha_u, alpha_v = (float(keys.get(key)) ** 2 for key in ("roughness_x", "roughness_y"))
    else:
        alpha_u = alpha_v = alpha_of(keys, 0.1)
    if min(alpha_u, alpha_v) < LEAST_ALPHA:
        keys.refuse("alpha", f"below {LEAST_ALPHA} the program has a mirror with Schlick's curve")
    eta, k = eta_and_k(keys)
    if eta is not None:
        bsdf = {"type": "roughconductor", "distribution": "ggx", "sample_visible": True,
                "alpha_u": alpha_u, "alpha_v": alpha_v, "eta": rgb(eta), "k": rgb(k)}
    elif alpha_u == alpha_v:
        bsdf = {"type": "principled", "metallic": 1.0, "roughness": float(np.sqrt(alpha_u)),
                "base_color": materials.textures.colour(keys, "reflectance", 0.5)}
    else:
        keys.refuse("roughness_x", "only metals by eta and k may have two roughnesses")
    return reflecting(keys, materials.masked(bsdf, alpha_u, alpha_v))


def eta_and_k(keys):
    """From the scene, or from the program's own table of metals; (None, None) without."""
    if "metal" not in keys:
        return keys.colour("eta", None), keys.colour("k", None)
    table = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../src/scene/metals.cpp")
    with open(table) as file:
        numbers = r'\{"%s", \{([^}]*)\}, \{([^}]*)\}\}' % re.escape(keys.get("metal"))
        found = re.search(numbers, file.read())
    if not found:
        keys.refuse("metal", "unknown")
    return tuple(np.array([float(x) for x in group.split(",")]) for group in found.groups())


def coated_diffuse(keys, materials):
    alpha = alpha_of(keys, 0)
    bsdf = {"type": "plastic", "int_ior": float(keys.get("ior", 1.5)), "ext_ior": 1.0,
            "nonlinear": True,
            "diffuse_reflectance": materials.textures.colour(keys, "reflectance", 0.5),
            "specular_reflectance": materials.textures.colour(keys, "specular", 1)}
    if alpha >= LEAST_ALPHA:
        bsdf |= {"type": "roughplastic", "distribution": "ggx", "alpha": alpha,
                 "sample_visible": True}
        if not materials.plain:
            bsdf = {"type": "conserving_coat", "nested": bsdf, "alpha": alpha,
                    "eta": bsdf["int_ior"], "reflectance": bsdf["diffuse_reflectance"]}
    return reflecting(keys, bsdf)


def black(keys, materials):
    return reflecting(keys, {"type": "diffuse", "reflectance": rgb([0, 0, 0])})


def blend(keys, materials):
    """Mitsuba 3.9 loses light where only one of the two is smooth: a quarter of a perfect mirror with
    three quarters of black reflects 0.129."""
    parts = [materials.part(keys.get(key)) for key in ("a", "b")]
    if len(lobes(parts[0]) | lobes(parts[1])) > 1:
        keys.refuse("a", "Mitsuba's blends of smooth and rough materials lose light")
    return {"type": "blendbsdf", "weight": materials.textures.number(keys, "weight", 0.5),
            "first": parts[0], "second": parts[1]}


def lobes(bsdf):
    """Some of "smooth" and "rough": what a BSDF scatters into."""
    nested = [value for value in bsdf.values() if isinstance(value, dict) and is_bsdf(value)]
    if bsdf["type"] not in ("conserving_coat", "correlated_masking") and nested:
        return set().union(*(lobes(part) for part in nested))
    return LOBES.get(bsdf["type"], {"rough"})


def is_bsdf(plugin):
    return plugin["type"] not in ("rgb", "bitmap", "checkerboard", "mesh_attribute")


def hair(keys, materials):
    return {"type": "hair", "sigma_a": rgb(keys.colour("absorption")), "ext_ior": 1.0,
            "int_ior": float(keys.get("ior", 1.55)), "scale_tilt": float(keys.get("tilt", 2)),
            "longitudinal_roughness": float(keys.get("roughness", 0.3)),
            "azimuthal_roughness": float(keys.get("azimuthal_roughness", 0.3))}


def null(keys, materials):
    return {"type": "null"}


KINDS = {f.__name__: f for f in (diffuse, mirror, dielectric, thin_dielectric, conductor,
                                 coated_diffuse, black, blend, hair, null)}


class Materials:
    """The scene's materials by name: what they scatter, what they emit, whether they need uv."""

    def __init__(self, all_keys, textures, plain):
        self.textures, self.plain = textures, plain
        self.keys = {keys.get("name"): keys for keys in all_keys}
        self.bsdf, self.radiance, self.emits_on_both_sides, self.needs_uv = {}, {}, {}, {}
        for name in self.keys:
            self._add(name)

    def masked(self, bsdf, alpha_u, alpha_v):
        """A GGX material, with our masking unless plain."""
        if self.plain:
            return bsdf
        return {"type": "correlated_masking", "nested": bsdf, "alpha_u": alpha_u,
                "alpha_v": alpha_v}

    def part(self, name):
        """What the material of this name scatters, as a part of another one."""
        self._add(name)
        return self.bsdf[name]

    def _add(self, name):
        if name in self.bsdf:
            return
        keys = self.keys[name]
        kind = keys.get("type")
        if kind not in KINDS:
            raise Unsupported(f"{keys.path}/type: '{kind}' has no twin in Mitsuba")
        bsdf = self._with_opacity(keys, self._with_relief(keys, KINDS[kind](keys, self)))
        self.bsdf[name] = bsdf
        scale = keys.colour("emission_scale", 1)
        emits = np.any(scale != 0) and keys.get("emission", 0) != 0 and np.any(keys.value["emission"])
        self.radiance[name] = self.textures.colour(keys, "emission", 0, scale) if emits else None
        self.emits_on_both_sides[name] = bool(keys.get("two_sided", False))
        if emits and bsdf["type"] == "mask":
            keys.refuse("opacity", "Mitsuba's lamps shine whatever their opacity")
        self.needs_uv[name] = needs_uv(keys) or any(
            self.needs_uv[part] for part in (keys.value.get("a"), keys.value.get("b"))
            if part in self.needs_uv)
        keys.finish()

    def _with_opacity(self, keys, bsdf):
        if "opacity" not in keys:
            return bsdf
        return {"type": "mask", "opacity": self.textures.number(keys, "opacity", 1), "nested": bsdf}

    def _with_relief(self, keys, bsdf):
        if "normal_map" not in keys:
            return bsdf
        if keys.get("normal_scale", 1) != 1:
            keys.refuse("normal_scale", "Mitsuba's normal maps have no scale")
        normal_map = {"type": "normalmap", "bsdf": bsdf["bsdf"], "use_shadowing_function": False,
                      "flip_invalid_normals": False,
                      "normalmap": self.textures.raw(keys.get("normal_map"))}
        return {"type": "twosided", "bsdf": normal_map}


def needs_uv(keys):
    textured = any(isinstance(value, str) for key, value in keys.value.items()
                   if key not in ("name", "type", "metal", "a", "b"))
    return textured or keys.value.get("roughness_x") != keys.value.get("roughness_y")
