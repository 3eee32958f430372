"""The panel, what it keeps, and the preferences."""

import bpy
import bpy.utils.previews

from . import operators, program

_previews = None
_items = []  # Blender does not keep the texts of a list that is made anew


def _templates(self, context):
    global _items
    chosen = operators.preferences(context) if context else None
    path = program.find(chosen.program if chosen else "")
    found = program.templates(program.libraries(path, chosen.library if chosen else ""))
    items = []
    for k, (name, template, picture) in enumerate(found):
        icon = 0
        if picture and _previews is not None:
            if picture not in _previews:
                _previews.load(picture, picture, "IMAGE")
            icon = _previews[picture].icon_id
        items.append((template, name.replace("_", " "), template, icon, k))
    _items = items or [("", "no templates found", "", 0, 0)]
    return _items


class RetargetSettings(bpy.types.PropertyGroup):
    figure_a: bpy.props.PointerProperty(
        name="a", type=bpy.types.Object, poll=lambda self, o: o.type == "ARMATURE",
        description="Armature of figure a, with its action")
    figure_b: bpy.props.PointerProperty(
        name="b", type=bpy.types.Object, poll=lambda self, o: o.type == "ARMATURE",
        description="Armature of figure b, with its action")
    template: bpy.props.EnumProperty(
        name="Template", items=_templates, description="Posture that is kept")
    template_file: bpy.props.StringProperty(
        name="File", subtype="FILE_PATH", description="A template of your own instead")
    whole_scene: bpy.props.BoolProperty(
        name="Frames of the scene", default=True, description="From its start to its end")
    first: bpy.props.IntProperty(name="First", default=1)
    last: bpy.props.IntProperty(name="Last", default=100)
    template_frame: bpy.props.IntProperty(
        name="Template at", default=1, description="Frame that is laid into the template")
    status: bpy.props.StringProperty(options={"SKIP_SAVE"})
    report: bpy.props.StringProperty()
    cancel: bpy.props.BoolProperty(options={"HIDDEN", "SKIP_SAVE"})

    def template_path(self):
        if self.template_file:
            return bpy.path.abspath(self.template_file)
        if not self.template:
            raise ValueError("choose a template, or name its file")
        return self.template


class RetargetPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: bpy.props.StringProperty(
        name="Program", subtype="FILE_PATH", description="`retarget`, if it is not on the path")
    library: bpy.props.StringProperty(
        name="Templates", subtype="DIR_PATH", description="A folder with templates of your own")

    def draw(self, context):
        self.layout.prop(self, "program")
        self.layout.prop(self, "library")


class RETARGET_PT_panel(bpy.types.Panel):
    bl_label = "Retarget"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Retarget"

    def draw(self, context):
        layout, settings = self.layout, context.scene.retarget
        layout.use_property_split = True
        column = layout.column()
        column.prop(settings, "figure_a")
        column.prop(settings, "figure_b")
        column = layout.column()
        if settings.template_file == "":
            column.template_icon_view(settings, "template", show_labels=True, scale=6)
            column.prop(settings, "template")
        column.prop(settings, "template_file")
        column.operator("retarget.make_template", icon="ARMATURE_DATA")
        column = layout.column()
        column.prop(settings, "whole_scene")
        if not settings.whole_scene:
            column.prop(settings, "first")
            column.prop(settings, "last")
        column.prop(settings, "template_frame")
        row = layout.row()
        row.scale_y = 1.5
        if operators.RETARGET_OT_solve._job is None:
            row.operator("retarget.solve", icon="PLAY")
        else:
            row.operator("retarget.cancel", icon="CANCEL")
        if settings.status:
            layout.label(text=settings.status)
        layout.operator("retarget.open_report", icon="URL")


CLASSES = (RetargetSettings, RetargetPreferences, RETARGET_PT_panel)


def register():
    global _previews
    _previews = bpy.utils.previews.new()
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.retarget = bpy.props.PointerProperty(type=RetargetSettings)


def unregister():
    global _previews
    del bpy.types.Scene.retarget
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
    bpy.utils.previews.remove(_previews)
    _previews = None
