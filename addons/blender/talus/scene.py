"""Puts a scene that was read into Blender, or anew into where it was put before.

A scene is a collection with `ground`, `water` and `stones` below it. Stones are one object of
points, drawn by Geometry Nodes as instances of the objects in `stone shapes`. What belongs to a file
is known by the custom properties `talus_file` and `talus_part`, so that collections and objects may
be renamed and moved.
"""

import os

import bpy
import numpy as np

from . import glb

_FILE, _PART = "talus_file", "talus_part"


def put(context, path):
    """Imports a file; returns how many stones it has. Raises glb.GlbError, and then nothing has
    changed."""
    scene = glb.read(path)
    collection = _collection(context.scene.collection, os.path.abspath(path), "scene",
                             os.path.splitext(os.path.basename(path))[0])
    materials = _Materials(scene)
    for name in ("ground", "water"):
        surface = scene.surfaces.get(name)
        _put_surface(collection, name, surface, materials)
    _put_stones(context, collection, scene.stones, materials)
    return len(scene.stones.positions) if scene.stones else 0


def _collection(parent, path, part, name):
    """The collection below `parent` of that file and part, made if there is none."""
    for found in parent.children_recursive:
        if found.get(_FILE) == path and found.get(_PART) == part:
            return found
    made = bpy.data.collections.new(name)
    made[_FILE], made[_PART] = path, part
    parent.children.link(made)
    return made


def _objects(collection):
    """The objects of a collection by the parts they are."""
    return {found[_PART]: found for found in collection.objects if _PART in found}


def _new_object(collection, part, name):
    made = bpy.data.objects.new(name, bpy.data.meshes.new(name))
    made[_PART] = part
    collection.objects.link(made)
    return made


def _remove(objects):
    meshes = [found.data for found in objects]
    bpy.data.batch_remove(objects)
    bpy.data.batch_remove([mesh for mesh in meshes if mesh.users == 0])


def _put_surface(collection, name, surface, materials):
    if surface is None:
        _remove_part(collection, name)
        return
    part = _collection(collection, collection[_FILE], name, name)
    found = _objects(part).get(name) or _new_object(part, name, name)
    found.location = surface.origin
    _fill(found.data, surface.mesh, materials)


def _put_stones(context, collection, stones, materials):
    if stones is None:
        _remove_part(collection, "stones")
        _remove_part(collection, "shapes")
        return
    part = _collection(collection, collection[_FILE], "stones", "stones")
    shapes = _collection(part, collection[_FILE], "shapes", "stone shapes")
    _hide(context.view_layer.layer_collection, shapes)
    _put_shapes(shapes, stones, materials)
    points = _objects(part).get("stones") or _new_object(part, "stones", "stones")
    points.location = stones.origin
    _fill_points(points.data, stones)
    if not any(modifier.type == "NODES" for modifier in points.modifiers):
        points.modifiers.new("stones", "NODES").node_group = _instancing(shapes)


def _remove_part(collection, name):
    for part in collection.children_recursive:
        if part.get(_PART) == name:
            _remove(list(part.objects))


def _put_shapes(collection, stones, materials):
    """One object for each mesh. Instances pick them in the order of their names."""
    digits = len(str(len(stones.meshes) - 1))
    known = _objects(collection)
    for k, mesh in enumerate(stones.meshes):
        name = f"stone {k:0{digits}}"
        found = known.pop(k, None) or _new_object(collection, k, name)
        if found.name != name:
            found.name = name
        _fill(found.data, mesh, materials)
    _remove(list(known.values()))


def _hide(layer, collection):
    """Shapes stand at the origin and are seen only as instances."""
    for child in layer.children:
        if child.collection == collection:
            child.exclude = True
        _hide(child, collection)


def _fill(mesh, source, materials):
    """Gives a mesh other geometry. A material that it has stays."""
    mesh.clear_geometry()
    mesh.vertices.add(len(source.positions))
    mesh.vertices.foreach_set("co", _flat(source.positions))
    corners = source.triangles.ravel()
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(len(source.triangles))
    mesh.polygons.foreach_set("loop_start", np.arange(0, len(corners), 3, dtype=np.int32))
    if bpy.app.version < (4, 0, 0):
        mesh.polygons.foreach_set("loop_total", np.full(len(source.triangles), 3, np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(len(source.triangles), bool))
    if source.texture_coordinates is not None:
        # glTF counts downward.
        uv = source.texture_coordinates[corners] * (1, -1) + (0, 1)
        mesh.uv_layers.new(name="UVMap").data.foreach_set("uv", _flat(uv))
    if source.colors is not None:
        colors = mesh.color_attributes.new("Color", "FLOAT_COLOR", "POINT")
        colors.data.foreach_set("color", _flat(source.colors))
    if not mesh.materials:
        mesh.materials.append(materials.of(source.material))
    mesh.update(calc_edges=True)
    if bpy.app.version < (4, 1, 0):
        mesh.use_auto_smooth = True
    mesh.normals_split_custom_set_from_vertices(source.normals)


def _fill_points(mesh, stones):
    mesh.clear_geometry()
    mesh.vertices.add(len(stones.positions))
    mesh.vertices.foreach_set("co", _flat(stones.positions))
    for name, kind, key, values in (("rotation", "FLOAT_VECTOR", "vector",
                                     _euler(stones.quaternions)),
                                    ("scale", "FLOAT", "value", stones.scales),
                                    ("shape", "INT", "value", stones.shapes)):
        attribute = mesh.attributes.new(name, kind, "POINT")
        dtype = np.int32 if kind == "INT" else np.float32
        attribute.data.foreach_set(key, np.ascontiguousarray(values, dtype).ravel())
    mesh.update()


def _flat(values):
    return np.ascontiguousarray(values, np.float32).ravel()


def _euler(q):
    """Quaternions x, y, z, w as XYZ angles; Blender 3.4 takes no quaternions."""
    x, y, z, w = q.T
    sine = np.clip(2 * (w * y - x * z), -1, 1)
    upright = np.abs(sine) > 1 - 1e-7  # x and z turn about one axis; all of it goes to x
    about_x = np.where(upright, 2 * np.arctan2(x, w),
                       np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)))
    about_z = np.where(upright, 0, np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))
    return np.stack([about_x, np.arcsin(sine), about_z], axis=-1)


def _instancing(shapes):
    """Nodes that draw at each point the shape that it names."""
    group = bpy.data.node_groups.new("Talus stones", "GeometryNodeTree")
    if hasattr(group, "interface"):  # Blender 4
        for direction in ("INPUT", "OUTPUT"):
            group.interface.new_socket("Geometry", in_out=direction,
                                       socket_type="NodeSocketGeometry")
    else:
        group.inputs.new("NodeSocketGeometry", "Geometry")
        group.outputs.new("NodeSocketGeometry", "Geometry")
    nodes, link = group.nodes, group.links.new

    def attribute(name, kind):
        node = nodes.new("GeometryNodeInputNamedAttribute")
        node.data_type = kind
        node.inputs["Name"].default_value = name
        return next(socket for socket in node.outputs if socket.enabled)

    info = nodes.new("GeometryNodeCollectionInfo")
    info.inputs["Collection"].default_value = shapes
    info.inputs["Separate Children"].default_value = True
    info.inputs["Reset Children"].default_value = True
    instance = nodes.new("GeometryNodeInstanceOnPoints")
    instance.inputs["Pick Instance"].default_value = True
    link(nodes.new("NodeGroupInput").outputs[0], instance.inputs["Points"])
    link(info.outputs[0], instance.inputs["Instance"])
    link(attribute("shape", "INT"), instance.inputs["Instance Index"])
    link(attribute("rotation", "FLOAT_VECTOR"), instance.inputs["Rotation"])
    link(attribute("scale", "FLOAT"), instance.inputs["Scale"])
    link(instance.outputs[0], nodes.new("NodeGroupOutput").inputs[0])
    return group


class _Materials:
    """Materials of a file as Principled ones, made when they are first asked for."""

    def __init__(self, scene):
        self.scene = scene
        self.made = {}
        self.images = {}

    def of(self, index):
        if index not in self.made:
            self.made[index] = self.make(self.scene.materials[index])
        return self.made[index]

    def make(self, source):
        material = bpy.data.materials.new(source["name"])
        material.use_nodes = True
        nodes, link = material.node_tree.nodes, material.node_tree.links.new
        shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
        surface = source["pbrMetallicRoughness"]
        shader.inputs["Roughness"].default_value = surface.get("roughnessFactor", 1)
        factor = surface.get("baseColorFactor")
        if factor is not None:
            shader.inputs["Base Color"].default_value = factor
            shader.inputs["Alpha"].default_value = factor[3]
            material.blend_method = "BLEND"
            return material
        vertex_color = nodes.new("ShaderNodeVertexColor")
        vertex_color.layer_name = "Color"
        color = vertex_color.outputs["Color"]
        if "baseColorTexture" in surface:
            texture = self.texture(material, surface["baseColorTexture"], "sRGB")
            color = _mixed(material, color, texture.outputs["Color"])
        link(color, shader.inputs["Base Color"])
        if "metallicRoughnessTexture" in surface:
            texture = self.texture(material, surface["metallicRoughnessTexture"], "Non-Color")
            channels = nodes.new("ShaderNodeSeparateColor")
            link(texture.outputs["Color"], channels.inputs[0])
            link(channels.outputs[1], shader.inputs["Roughness"])
        if "normalTexture" in source:
            texture = self.texture(material, source["normalTexture"], "Non-Color")
            bump = nodes.new("ShaderNodeNormalMap")
            link(texture.outputs["Color"], bump.inputs["Color"])
            link(bump.outputs["Normal"], shader.inputs["Normal"])
        return material

    def texture(self, material, info, color_space):
        node = material.node_tree.nodes.new("ShaderNodeTexImage")
        node.image = self.image(info["index"], color_space)
        return node

    def image(self, index, color_space):
        if index not in self.images:
            name, data = self.scene.images[index]
            image = bpy.data.images.new(name, 1, 1)
            image.pack(data=data, data_len=len(data))
            image.source = "FILE"
            image.colorspace_settings.name = color_space
            self.images[index] = image
        return self.images[index]


def _mixed(material, a, b):
    """The product of two colors."""
    node = material.node_tree.nodes.new("ShaderNodeMixRGB")
    node.blend_type = "MULTIPLY"
    node.inputs["Fac"].default_value = 1
    material.node_tree.links.new(a, node.inputs["Color1"])
    material.node_tree.links.new(b, node.inputs["Color2"])
    return node.outputs["Color"]
