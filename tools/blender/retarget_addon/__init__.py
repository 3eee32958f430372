"""Retarget for Blender: two armatures with actions become one scene of two tangled people.

The panel stands in the side bar of the 3D view (N), tab Retarget. docs/blender.md says more.
"""

bl_info = {
    "name": "Retarget",
    "author": "The retarget authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Side bar > Retarget",
    "description": "Two captured motions become one scene of two tangled people",
    "category": "Animation",
}

from . import interface, operators


def register():
    operators.register()
    interface.register()


def unregister():
    interface.unregister()
    operators.unregister()
