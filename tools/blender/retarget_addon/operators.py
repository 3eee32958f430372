"""What the panel's buttons do."""

import json
import os
import pathlib
import tempfile

import bpy

from . import clips, program

TRACK = "Retarget"


def preferences(context):
    addon = context.preferences.addons.get(__package__)
    return addon.preferences if addon else None


def find_program(context):
    chosen = preferences(context)
    path = program.find(chosen.program if chosen else "")
    if not path:
        raise ValueError("the program `retarget` is not found; name it in the add-on's preferences")
    return path


class Request:
    """What is to be solved, checked and written to files."""

    def __init__(self, context):
        settings = context.scene.retarget
        self.scene = context.scene
        self.armatures = [settings.figure_a, settings.figure_b]
        for label, armature in zip("ab", self.armatures):
            if armature is None:
                raise ValueError(f"figure {label}: choose an armature")
            if armature.animation_data is None or not (
                armature.animation_data.action or armature.animation_data.nla_tracks
            ):
                raise ValueError(f"{armature.name}: has no action")
        if self.armatures[0] == self.armatures[1]:
            raise ValueError("figures a and b are one armature; choose two")
        first, last = settings.first, settings.last
        if settings.whole_scene:
            first, last = self.scene.frame_start, self.scene.frame_end
        if last <= first:
            raise ValueError(f"frames {first} to {last}: the last must be after the first")
        self.frames = list(range(first, last + 1))
        self.fps = self.scene.render.fps / self.scene.render.fps_base
        self.template_at = (settings.template_frame - first) / self.fps
        if not 0 <= settings.template_frame - first < len(self.frames):
            raise ValueError(f"frame {settings.template_frame}, where the template is laid in, is "
                             f"not among frames {first} to {last}")
        self.skeletons = [clips.Skeleton(armature) for armature in self.armatures]

    def write_clips(self, folder, frames=None):
        paths = []
        for label, skeleton in zip("ab", self.skeletons):
            path = os.path.join(folder, f"{label}.bvh")
            text = clips.write_bvh(skeleton, frames or self.frames, self.scene, self.fps)
            pathlib.Path(path).write_text(text)
            paths.append(path)
        return paths


def add_markers(action, report, figure, first):
    """Where feet stand and where tags hold."""
    def mark(frame, text):
        action.pose_markers.new(text[:63]).frame = first + frame

    for contact in report["contacts"][figure]:
        mark(contact["first"], f"{contact['node']} planted")
        mark(contact["last"], f"{contact['node']} free")
    for k, tangle in enumerate(report["tangles"]):
        words = " ".join(str(n) for n in tangle[figure])
        mark(0, f"tag {k + 1}: {words}")
        mark(report["frames"] - 1, f"tag {k + 1} end")


def apply_result(request, folder):
    """New actions on a track above all others of each armature. Returns the report."""
    with open(os.path.join(folder, "report.json")) as file:
        report = json.load(file)
    first = request.frames[0]
    made = []
    for label, skeleton in zip("ab", request.skeletons):
        text = pathlib.Path(folder, f"{label}.bvh").read_text()
        name = f"{skeleton.armature.name} retargeted"
        made.append(clips.make_action(skeleton, text, first, name, request.scene))
    for label, skeleton, action in zip("ab", request.skeletons, made):
        add_markers(action, report, label, first)
        data = skeleton.armature.animation_data
        if data.action is not None:
            # The action in use becomes a strip of its own, so that the new one stands above it.
            original = data.action
            track = data.nla_tracks.new()
            track.name = original.name
            track.strips.new(original.name, int(original.frame_range[0]), original)
            data.action = None
        track = data.nla_tracks.new()
        track.name = TRACK
        strip = track.strips.new(action.name, first, action)
        strip.extrapolation = "NOTHING"
    return report


class RETARGET_OT_solve(bpy.types.Operator):
    """Solve the two motions as one scene; the result is a new layer above the originals"""

    bl_idname = "retarget.solve"
    bl_label = "Solve"
    bl_options = {"REGISTER", "UNDO"}

    wait: bpy.props.BoolProperty(default=False, options={"HIDDEN", "SKIP_SAVE"})

    _job = None  # one at a time

    @classmethod
    def poll(cls, context):
        return cls._job is None

    def execute(self, context):
        settings = context.scene.retarget
        try:
            path = find_program(context)
            template = settings.template_path()
            self.request = Request(context)
            self.folder = tempfile.mkdtemp(prefix="retarget-blender-")
            a, b = self.request.write_clips(self.folder)
        except (ValueError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.out = os.path.join(self.folder, "out")
        arguments = [
            path, "--clip-a", a, "--clip-b", b, "--template", template, "--out", self.out,
            "--units-a", "m", "--units-b", "m", "--up-a", "y", "--up-b", "y",
            "--fps", f"{self.request.fps:.9g}", "--template-at", f"{self.request.template_at:.9g}",
            "--progress", "json",
        ]
        job = program.Job(arguments)
        if self.wait:
            job.wait()
            return self.finish(context, job)
        type(self)._job = job
        settings.status = job.describe()
        self.timer = context.window_manager.event_timer_add(0.2, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        job = type(self)._job
        settings = context.scene.retarget
        if event.type == "ESC" and event.value == "PRESS" or settings.cancel:
            job.cancel()
            settings.cancel = False
            self.end(context, "Cancelled")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if job.poll() is None:
            settings.status = job.describe()
            for area in context.screen.areas:
                area.tag_redraw()
            return {"PASS_THROUGH"}
        self.end(context, "")
        return self.finish(context, job)

    def end(self, context, status):
        context.window_manager.event_timer_remove(self.timer)
        context.scene.retarget.status = status
        type(self)._job = None

    def finish(self, context, job):
        settings = context.scene.retarget
        if job.poll() not in (0, 3, 4):
            settings.status = job.error()
            self.report({"ERROR"}, job.error())
            return {"CANCELLED"}
        try:
            report = apply_result(self.request, self.out)
        except (ValueError, KeyError, OSError, ReferenceError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        settings.report = os.path.join(self.out, "report.html")
        missed = [r["name"] for r in report["requirements"] if not r["met"]]
        settings.status = "Missed: " + ", ".join(missed) if missed else "Every requirement is met"
        self.report({"WARNING" if missed else "INFO"}, settings.status)
        return {"FINISHED"}


class RETARGET_OT_cancel(bpy.types.Operator):
    """Stop the solve; nothing is changed"""

    bl_idname = "retarget.cancel"
    bl_label = "Cancel"

    def execute(self, context):
        context.scene.retarget.cancel = True
        return {"FINISHED"}


class RETARGET_OT_open_report(bpy.types.Operator):
    """Open the report of the last solve in the browser"""

    bl_idname = "retarget.open_report"
    bl_label = "Open report"

    @classmethod
    def poll(cls, context):
        return bool(context.scene.retarget.report)

    def execute(self, context):
        bpy.ops.wm.url_open(url=pathlib.Path(context.scene.retarget.report).as_uri())
        return {"FINISHED"}


class RETARGET_OT_make_template(bpy.types.Operator):
    """A template posture from both armatures as they stand in the current frame"""

    bl_idname = "retarget.make_template"
    bl_label = "Template from this frame"

    filepath: bpy.props.StringProperty(subtype="FILE_PATH", default="template.yaml")
    filter_glob: bpy.props.StringProperty(default="*.yaml", options={"HIDDEN"})
    check_existing: bpy.props.BoolProperty(default=True, options={"HIDDEN"})
    overwrite: bpy.props.BoolProperty(default=False, options={"HIDDEN", "SKIP_SAVE"})

    def invoke(self, context, event):
        self.overwrite = True  # the file browser warns of what is there
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        try:
            path = find_program(context)
            request = Request(context)
            frame = context.scene.frame_current
            with tempfile.TemporaryDirectory() as folder:
                # Twice: a clip of one frame has no rate.
                a, b = request.write_clips(folder, [frame, frame])
                out = bpy.path.abspath(self.filepath)
                if os.path.exists(out) and not self.overwrite:
                    raise ValueError(f"{out} is there already; choose another name")
                name = pathlib.Path(out).stem
                job = program.Job([path, "template", "--from-clips", a, b, "--frame", "0",
                                   "--units-a", "m", "--units-b", "m", "--up-a", "y", "--up-b", "y",
                                   "--name", name, "--out", out, "--force"])
                if job.wait() != 0:
                    raise ValueError(job.error())
        except (ValueError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        context.scene.retarget.template_file = out
        self.report({"INFO"}, f"Written to {out}")
        return {"FINISHED"}


CLASSES = (
    RETARGET_OT_solve,
    RETARGET_OT_cancel,
    RETARGET_OT_open_report,
    RETARGET_OT_make_template,
)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
