"""Blender imports the GLB of nodes: every stone is an object of its own, in its place, and those of
one prototype share a mesh."""

import json
import math
import os
import sys

try:
    import numpy
except ImportError:
    print("skipped: Blender's glTF importer needs numpy (python3-numpy)")
    sys.exit(77)

# Debian's numpy is newer than the importer of Blender 3.4.
if "bool" not in vars(numpy):
    numpy.bool = bool

import bpy  # noqa: E402
import mathutils  # noqa: E402


def main(folder):
    with open(os.path.join(folder, "stones.json"), encoding="utf-8") as file:
        stones = json.load(file)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=os.path.join(folder, "nodes.glb"))

    objects = [o for o in bpy.data.objects if o.type == "MESH"]
    assert len(objects) == len(stones), f"{len(objects)} objects for {len(stones)} stones"
    assert len({o.data.name for o in objects}) == len({s["prototype"] for s in stones})
    assert bpy.data.objects["stones"].type == "EMPTY"

    by_name = {o.name: o for o in objects}
    in_run = {}
    for stone in stones:
        k = stone["prototype"]
        index = in_run[k] = in_run.get(k, -1) + 1
        obj = by_name[f"stones/{k}/{index}"]
        position, turn, scale = obj.matrix_world.decompose()
        # Blender keeps single precision: some millimetres at 50 km from the origin.
        distance = (position - mathutils.Vector(stone["position"])).length
        assert distance < 1e-2, f"{obj.name} is {distance} m off"
        x, y, z, w = stone["rotation"]
        angle = turn.rotation_difference(mathutils.Quaternion((w, x, y, z))).angle
        angle = min(angle, 2 * math.pi - angle)
        assert angle < 2e-3, f"{obj.name} is turned by {angle}"
        assert abs(scale.x - stone["scale"]) < 1e-4, f"{obj.name} has another size"
        assert len(obj.data.polygons) == stone["triangles"]
    print(f"{len(objects)} stones where they should be")


main(sys.argv[sys.argv.index("--") + 1])
