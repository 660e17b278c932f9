"""A scene file as a dictionary for Mitsuba's `load_dict`. What each convention is: the scene format
in docs/; where the two programs differ, the code below says how it is made up for.

What has no counterpart raises `NoCounterpart`: perfect refraction, EWA filtering, debugging views
and filters that Mitsuba has with one radius only.
"""

import json
from pathlib import Path
from typing import Any

import numpy as np
from convert_lights import convert_environment, convert_light, point
from convert_textures import FLIP_V, Matrix, NoCounterpart, convert_material, convert_texture
from mitsuba_types import Plugin, load_mitsuba, rgb

NO_ROULETTE = 1 << 20
"""A depth that no path reaches. Ours may play Russian roulette: both are unbiased."""

BLACK: Plugin = {"type": "diffuse", "reflectance": rgb([0, 0, 0])}
"""A light without a material; Mitsuba would make it grey."""


def convert(path: Path) -> Plugin:
    """The scene file as a Mitsuba scene."""
    scene = json.loads(path.read_text(encoding="utf-8"))
    out: Plugin = {"type": "scene"}
    out["integrator"], lights = convert_integrator(scene)
    out["sensor"] = convert_camera(scene)
    lights += [convert_light(light) for light in scene.get("lights", [])]
    if "environment_map" in scene:
        environment = scene["environment_map"]
        texture = scene["textures"][environment["texture_name"]]
        lights.append(convert_environment(path.parent, environment, texture))
    out |= {f"light_{i}": light for i, light in enumerate(lights)}
    for i, item in enumerate(scene.get("objects", [])):
        out[f"object_{i}"] = convert_object(path.parent, scene, item)
    return out


def convert_integrator(scene: Plugin) -> tuple[Plugin, list[Plugin]]:
    """The integrator, and the light that belongs to it.

    Our `max_depth` counts scattering events; Mitsuba's counts segments of the path, one more.
    """
    settings = scene["integrator"]
    specular = {"glass", "refraction"} & {m["type"] for m in scene.get("materials", {}).values()}
    lights: list[Plugin] = []
    depth = settings.get("max_depth", 12)
    if settings["type"] in ("direct", "intersection_test"):
        if specular:
            # Ours follow clear surfaces to the one that is lit; Mitsuba's `direct` does not.
            raise NoCounterpart(f"{settings['type']} through clear materials")
        depth = 1
    elif settings["type"] != "path":
        raise NoCounterpart(f"the integrator {settings['type']}")
    if settings["type"] == "intersection_test":
        lights.append(
            point(
                settings.get("point_light_position", [0, 5, 0]),
                settings.get("point_light_flux", [1, 1, 1]),
            )
        )
    return {"type": "path", "max_depth": depth + 1, "rr_depth": NO_ROULETTE}, lights


def convert_camera(scene: Plugin) -> Plugin:
    """Both show `ref_up` upwards and what is on the right on the right."""
    mi = load_mitsuba()
    camera = scene.get("camera", {})
    return {
        "type": "perspective",
        "fov": float(camera.get("fov", 45)),
        "fov_axis": "y",
        "near_clip": 1e-3,
        "far_clip": 1e5,
        "to_world": mi.ScalarTransform4f().look_at(
            camera.get("position", [0, 0, 1]),
            camera.get("look_at", [0, 0, 0]),
            camera.get("ref_up", [0, 1, 0]),
        ),
        "film": convert_film(scene.get("film", {})),
        "sampler": {"type": "independent"},
    }


def convert_film(film: Plugin) -> Plugin:
    """Mitsuba adds a sample to all pixels around it and divides by the weights; ours draws samples
    from the filter. Both estimate the same weighted mean, given samples beyond the border."""
    width, height = film.get("resolution", [600, 600])
    return {
        "type": "hdrfilm",
        "width": width,
        "height": height,
        "pixel_format": "rgb",
        "component_format": "float32",
        "sample_border": True,
        "rfilter": convert_filter(film.get("filter", {})),
    }


def convert_filter(settings: Plugin) -> Plugin:
    """Ours: exp(-alpha x^2) less its value at the radius. Mitsuba's Gaussian is the same with alpha
    = 1 / (2 stddev^2) and always ends at 4 stddev; its box has radius 1/2, its Mitchell 2."""
    kind, radius = settings.get("type", "box"), settings.get("radius", 0.5)
    if kind == "tent":
        return {"type": "tent", "radius": float(radius)}
    if kind == "gaussian":
        deviation = (2 * settings.get("alpha", 2.0)) ** -0.5
        if abs(radius - 4 * deviation) > 1e-6:
            raise NoCounterpart(f"a Gaussian that ends at {radius / deviation} deviations, not 4")
        return {"type": "gaussian", "stddev": deviation}
    if kind == "mitchell" and radius == 2:
        return {"type": "mitchell", "B": settings.get("B", 1 / 3), "C": settings.get("C", 1 / 3)}
    if kind == "box" and radius == 0.5:
        return {"type": "box"}
    raise NoCounterpart(f"a {kind} filter of radius {radius}")


def convert_object(folder: Path, scene: Plugin, item: Plugin) -> Plugin:
    """A shape with its material and its light. Both let a surface shine on its normal's side."""
    shape = convert_shape(folder, item)
    to_uv = FLIP_V if item["type"] == "rect" else np.eye(4)

    def texture(name: str) -> Plugin:
        return convert_texture(folder, scene["textures"][name], to_uv)

    shape["bsdf"] = BLACK
    if "material_name" in item:
        shape["bsdf"] = convert_material(scene["materials"][item["material_name"]], texture)
    if "light" in item:
        shape["emitter"] = {"type": "area", "radiance": rgb(item["light"]["radiance"])}
    return shape


def placement(item: Plugin) -> Matrix:
    """First `transform`, then `translate`."""
    matrix = np.array(item.get("transform", np.eye(4).ravel()), dtype=float).reshape(4, 4)
    move = np.eye(4)
    move[:3, 3] = item.get("translate", [0, 0, 0])
    result: Matrix = move @ matrix
    return result


def convert_shape(folder: Path, item: Plugin) -> Plugin:
    """Spheres agree, texture coordinates included. Mitsuba's rectangle is [-1, 1]^2."""
    mi = load_mitsuba()
    if item["type"] == "sphere":
        center = [float(v) for v in item["center"]]
        return {"type": "sphere", "center": center, "radius": float(item["radius"])}
    matrix = placement(item)
    if item["type"] == "rect":
        half = np.diag([0.5, 0.5, 1.0, 1.0])
        return {"type": "rectangle", "to_world": mi.ScalarTransform4f(matrix @ half)}
    return convert_mesh(folder / item["path"], matrix)


def convert_mesh(path: Path, matrix: Matrix) -> Plugin:
    """Both flip v of an OBJ file once. Mitsuba invents smooth normals for a file without any unless
    it is told not to. A transform that mirrors turns its geometric normals inside out (ours stay
    outside); with normals in the file the shading normals decide, and they stay outside."""
    mi = load_mitsuba()
    smooth = any(line.startswith("vn ") for line in path.read_text().splitlines())
    out: dict[str, Any] = {
        "type": "obj",
        "filename": str(path),
        "to_world": mi.ScalarTransform4f(matrix),
        "face_normals": not smooth,
    }
    if not smooth and np.linalg.det(matrix[:3, :3]) < 0:
        out["flip_normals"] = True
    return out
