"""Opens scenes of Talus in Blender, stones as points for Geometry Nodes."""

import bpy
from bpy_extras.io_utils import ImportHelper

bl_info = {
    "name": "Talus scenes",
    "author": "The Talus authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "File > Import > Talus scene (.glb)",
    "description": "Ground, water and any number of stones from a scene.glb; importing it again "
                   "updates what is there",
    "category": "Import-Export",
}


class ImportTalus(bpy.types.Operator, ImportHelper):
    """Import a scene.glb of Talus, or update the one that was imported"""
    bl_idname = "import_scene.talus"
    bl_label = "Import Talus scene"
    bl_options = {"REGISTER", "UNDO"}

    filename_ext = ".glb"
    filter_glob: bpy.props.StringProperty(default="*.glb", options={"HIDDEN"})

    def execute(self, context):
        # numpy is there in every Blender but not in every Linux system's.
        try:
            from . import glb, scene
        except ImportError as error:
            self.report({"ERROR"}, f"{error}; install it, on Debian as python3-numpy")
            return {"CANCELLED"}
        try:
            stones = scene.put(context, self.filepath)
        except (OSError, glb.GlbError) as error:
            self.report({"ERROR"}, f"{self.filepath}: {error}")
            return {"CANCELLED"}
        self.report({"INFO"}, f"{stones} stones")
        return {"FINISHED"}


def _menu(self, _context):
    self.layout.operator(ImportTalus.bl_idname, text="Talus scene (.glb)")


def register():
    bpy.utils.register_class(ImportTalus)
    bpy.types.TOPBAR_MT_file_import.append(_menu)


def unregister():
    bpy.types.TOPBAR_MT_file_import.remove(_menu)
    bpy.utils.unregister_class(ImportTalus)
