"""Reads the GLB files that Talus writes, into numpy arrays in Blender's axes: metres, z up.

Knows nothing of Blender, and no glTF but Talus's own.
"""

import json
import struct
from dataclasses import dataclass, field

import numpy as np

_DTYPES = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32,
           5126: np.float32}
_COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


class GlbError(Exception):
    """What is wrong with a file, in one line."""


@dataclass
class Mesh:
    """Triangles in their own coordinates; what the file has not is None."""
    name: str
    positions: np.ndarray
    normals: np.ndarray
    triangles: np.ndarray
    texture_coordinates: np.ndarray
    colors: np.ndarray
    material: int


@dataclass
class Stones:
    """Instances relative to `origin`; `shapes` numbers the meshes."""
    origin: np.ndarray
    meshes: list
    positions: np.ndarray
    quaternions: np.ndarray  # x, y, z, w
    scales: np.ndarray
    shapes: np.ndarray


@dataclass
class Surface:
    """Ground or water."""
    origin: np.ndarray
    mesh: Mesh


@dataclass
class Scene:
    surfaces: dict = field(default_factory=dict)  # "ground", "water"
    stones: Stones = None
    materials: list = field(default_factory=list)  # as glTF has them
    images: list = field(default_factory=list)  # (name, bytes of a PNG)


def read(path):
    """The scene of a file; raises GlbError."""
    with open(path, "rb") as file:
        data = file.read()
    try:
        return _Reader(data).scene()
    except (KeyError, IndexError, TypeError, ValueError, struct.error) as error:
        raise GlbError(f"it is not as Talus writes it: {error}") from error


def _z_up(v):
    return np.stack([v[..., 0], -v[..., 2], v[..., 1]], axis=-1)


def _turned(q, v):
    """Vectors turned by quaternions x, y, z, w."""
    t = 2 * np.cross(q[..., :3], v)
    return v + q[..., 3:] * t + np.cross(q[..., :3], t)


def _product(p, q):
    """The rotation by q, then by p."""
    xyz = p[..., 3:] * q[..., :3] + q[..., 3:] * p[..., :3] + np.cross(p[..., :3], q[..., :3])
    w = p[..., 3:] * q[..., 3:] - np.sum(p[..., :3] * q[..., :3], axis=-1, keepdims=True)
    return np.concatenate([xyz, w], axis=-1)


class _Reader:
    def __init__(self, data):
        if len(data) < 20 or data[:4] != b"glTF":
            raise GlbError("this is no GLB file")
        length, = struct.unpack_from("<I", data, 12)
        try:
            self.json = json.loads(data[20:20 + length])
        except ValueError as error:
            raise GlbError("its JSON is malformed or cut off") from error
        if self.json.get("asset", {}).get("generator") != "Talus":
            raise GlbError("Talus did not write it; use File > Import > glTF 2.0")
        claimed = sum(buffer["byteLength"] for buffer in self.json.get("buffers", []))
        self.buffer = memoryview(data)[28 + length:]
        if len(self.buffer) < claimed:
            raise GlbError("it is cut off")

    def scene(self):
        root = self.json["scenes"][0]
        extras = root.get("extras", {})
        if extras.get("instances") == "flattened":
            raise GlbError("its stones are one mesh; build with --instances gpu, or use "
                           "File > Import > glTF 2.0")
        self.step = extras.get("position_step", 1.0)
        scene = Scene(materials=self.json.get("materials", []))
        for image in self.json.get("images", []):
            view = self.json["bufferViews"][image["bufferView"]]
            begin = view.get("byteOffset", 0)
            scene.images.append((image["name"], bytes(
                self.buffer[begin:begin + view["byteLength"]])))
        for index in root.get("nodes", []):
            node = self.json["nodes"][index]
            if node["name"] == "stones":
                scene.stones = self.stones(node)
            else:
                origin = _z_up(np.array(node.get("translation", [0, 0, 0]), float))
                scene.surfaces[node["name"]] = Surface(origin, self.mesh(node["mesh"], 1.0))
        return scene

    def rows(self, index):
        """An accessor as an array of rows; normalized integers as fractions."""
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        dtype = np.dtype(_DTYPES[accessor["componentType"]])
        columns = _COMPONENTS[accessor["type"]]
        stride = view.get("byteStride", dtype.itemsize * columns)
        rows = np.ndarray((accessor["count"], columns), dtype, self.buffer,
                          view.get("byteOffset", 0) + accessor.get("byteOffset", 0),
                          (stride, dtype.itemsize))
        if accessor.get("normalized"):
            return np.maximum(rows / np.float32(np.iinfo(dtype).max), -1)
        return rows

    def mesh(self, index, step):
        mesh = self.json["meshes"][index]
        primitive = mesh["primitives"][0]
        attributes = primitive["attributes"]

        def optional(name):
            return self.rows(attributes[name]) if name in attributes else None

        return Mesh(name=mesh["name"],
                    positions=_z_up(self.rows(attributes["POSITION"]) * step),
                    normals=_z_up(self.rows(attributes["NORMAL"])),
                    triangles=self.rows(primitive["indices"]).reshape(-1, 3).astype(np.int32),
                    texture_coordinates=self.texture_coordinates(primitive),
                    colors=optional("COLOR_0"),
                    material=primitive["material"])

    def texture_coordinates(self, primitive):
        if "TEXCOORD_0" not in primitive["attributes"]:
            return None
        texture = self.json["materials"][primitive["material"]]["normalTexture"]
        transform = texture.get("extensions", {}).get("KHR_texture_transform", {})
        return self.rows(primitive["attributes"]["TEXCOORD_0"]) * transform.get("scale", [1, 1])

    def stones(self, node):
        """All nodes below `node`: those of instances and those of one stone each."""
        parts = []
        origin = np.array(node.get("translation", [0, 0, 0]), float)
        for child in node["children"]:
            self.collect(self.json["nodes"][child], np.zeros(3), parts)
        numbers = sorted({mesh for mesh, _, _, _ in parts})
        shape = {mesh: k for k, mesh in enumerate(numbers)}
        shapes = np.concatenate([np.full(len(p), shape[mesh]) for mesh, p, _, _ in parts])
        quaternions = np.concatenate([q for _, _, q, _ in parts])
        # y up to z up: the axis of a rotation turns like any vector.
        quaternions = np.concatenate([_z_up(quaternions), quaternions[:, 3:]], axis=-1)
        return Stones(origin=_z_up(origin),
                      meshes=[self.mesh(mesh, self.step) for mesh in numbers],
                      positions=_z_up(np.concatenate([p for _, p, _, _ in parts])),
                      quaternions=quaternions,
                      scales=np.concatenate([s for _, _, _, s in parts]),
                      shapes=shapes)

    def collect(self, node, origin, parts):
        """Appends (mesh, positions, quaternions, scales) of a node and of those below it."""
        translation = origin + np.array(node.get("translation", [0, 0, 0]), float)
        if "mesh" not in node:
            for child in node.get("children", []):
                self.collect(self.json["nodes"][child], translation, parts)
            return
        rotation = np.array(node.get("rotation", [0, 0, 0, 1]), float)
        scale = node.get("scale", [1])[0]
        extension = node.get("extensions", {}).get("EXT_mesh_gpu_instancing")
        if extension is None:
            places = np.zeros((1, 3)), np.array([[0, 0, 0, 1.0]]), np.ones(1)
        else:
            places = self.places(extension["attributes"])
        positions, quaternions, scales = places
        parts.append((node["mesh"],
                      translation + scale * _turned(rotation, positions),
                      _product(np.broadcast_to(rotation, quaternions.shape), quaternions),
                      scale * scales / self.step))

    def places(self, attributes):
        positions = self.rows(attributes["TRANSLATION"]).astype(float)
        count = len(positions)
        quaternions = np.tile([0, 0, 0, 1.0], (count, 1))
        scales = np.ones(count)
        if "ROTATION" in attributes:
            quaternions = self.rows(attributes["ROTATION"]).astype(float)
        if "SCALE" in attributes:
            scales = self.rows(attributes["SCALE"])[:, 0].astype(float)
        return positions, quaternions, scales
