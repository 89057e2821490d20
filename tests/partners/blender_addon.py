"""Blender installs the add-on from its zip file and opens instanced GLBs with it: as many stones at
the same places as the stock importer finds in the GLB of nodes, and importing again updates what is
there."""

import os
import random
import sys

try:
    import numpy
except ImportError:
    print("skipped: Blender needs numpy (python3-numpy)")
    sys.exit(77)

# Debian's numpy is newer than the stock importer of Blender 3.4.
if "bool" not in vars(numpy):
    numpy.bool = bool

import bpy  # noqa: E402
import mathutils  # noqa: E402

MILLIMETRE = 1e-3


def clear():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="talus")


def corners(obj, matrix):
    return [matrix @ mathutils.Vector(corner) for corner in obj.bound_box]


def by_place(stones):
    """Sorted by x, at which no two stones are."""
    return sorted(stones, key=lambda stone: stone[0].translation.x)


def drawn():
    """(matrix, corners of the box) of every instance that is drawn."""
    graph = bpy.context.evaluated_depsgraph_get()
    return by_place([(i.matrix_world.copy(), corners(i.object, i.matrix_world))
                     for i in graph.object_instances if i.is_instance])


def nodes_of(path):
    clear()
    bpy.ops.import_scene.gltf(filepath=path)
    return by_place([(o.matrix_world.copy(), corners(o, o.matrix_world))
                     for o in bpy.data.objects if o.type == "MESH"])


def same_places(folder):
    expected = nodes_of(os.path.join(folder, "near_nodes.glb"))
    clear()
    bpy.ops.import_scene.talus(filepath=os.path.join(folder, "near.glb"))
    found = drawn()
    assert len(found) == len(expected) == 3000, f"{len(found)} stones for {len(expected)}"
    for i in random.Random(1).sample(range(len(found)), 10):
        for corner, other in zip(found[i][1], expected[i][1]):
            distance = (corner - other).length
            assert distance < MILLIMETRE, f"stone {i} is {distance} m off"
    worst = max((a[0].translation - b[0].translation).length for a, b in zip(found, expected))
    assert worst < MILLIMETRE, f"a stone is {worst} m off"
    print(f"{len(found)} stones at the same places, to {worst * 1e6:.0f} micrometres")


def counts():
    return [len(things) for things in (bpy.data.objects, bpy.data.meshes, bpy.data.materials,
                                       bpy.data.collections, bpy.data.images,
                                       bpy.data.node_groups)]


def collections_and_update(folder):
    clear()
    path = os.path.join(folder, "landscape.glb")
    bpy.ops.import_scene.talus(filepath=path)
    top = bpy.data.collections["landscape"]
    assert {part.name for part in top.children} == {"ground", "water", "stones"}
    assert [part.name for part in bpy.data.collections["stones"].children] == ["stone shapes"]
    ground = bpy.data.objects["ground"]
    assert len(ground.data.vertices) == 41 * 41
    assert len(drawn()) == 300
    assert not any(shape.visible_get() for shape in bpy.data.collections["stone shapes"].objects)

    # What an artist changed stays; what the file says comes back.
    chosen = bpy.data.materials.new("chosen")
    ground.data.materials[0] = chosen
    ground.name, top.name = "my ground", "my scene"
    points = bpy.data.objects["stones"]
    points.data = bpy.data.meshes.new("nothing")
    assert not drawn()
    before = counts()
    bpy.ops.import_scene.talus(filepath=path)
    assert len(drawn()) == 300
    assert ground.data.materials[0] == chosen
    assert counts() == before, f"{before} became {counts()}"
    print("importing again updates what is there")


def refusals(folder):
    clear()
    for name in ("flattened.glb", "none.glb", "stones.json"):
        before = counts()
        try:
            bpy.ops.import_scene.talus(filepath=os.path.join(folder, name))
        except RuntimeError as refusal:
            assert name in str(refusal), refusal
        else:
            raise AssertionError(f"{name} was imported")
        assert counts() == before


def main(folder, archive):
    bpy.ops.preferences.addon_install(filepath=archive)
    same_places(folder)
    collections_and_update(folder)
    refusals(folder)


main(*sys.argv[sys.argv.index("--") + 1:])
