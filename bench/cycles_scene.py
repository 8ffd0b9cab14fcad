# A scene for Blender Cycles like that of a coordinate-encoded map of overt: the same figure, turned about the same axis,
# seen by the same camera, its pixels numbers that nothing bends. `frame` is the map's JSON sidecar.
import json
import math
import sys

import bpy
import mathutils


def arguments_of(parser):
    """What stands behind Blender's own arguments."""
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:])


def read_frame(sidecar):
    with open(sidecar) as file:
        return json.load(file)


def figure_from(mesh, up):
    """The mesh alone in an empty scene, upright as overt has it: `up` is the file's axis, y or z."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="io_mesh_ply")
    bpy.ops.import_mesh.ply(filepath=mesh)
    figure = bpy.context.selected_objects[0]
    # Which file axis becomes x, y and z: the rotations that bring the file's upward axis to +z.
    rows = {"z": ((1, 0, 0), (0, 1, 0), (0, 0, 1)), "y": ((1, 0, 0), (0, 0, -1), (0, 1, 0))}[up]
    figure.data.transform(mathutils.Matrix(rows).to_4x4())
    return figure


def turn(figure, frame, angle_deg):
    """About the vertical through the middle of the box."""
    low, high = frame["bounds"]["min"], frame["bounds"]["max"]
    axis = mathutils.Matrix.Translation([(a + b) / 2 for a, b in zip(low, high)])
    figure.matrix_world = axis @ mathutils.Matrix.Rotation(math.radians(angle_deg), 4, "Z") @ axis.inverted()


def nodes_of(owner):
    """Nodes and links of a material or a world, none there yet."""
    owner.use_nodes = True
    owner.node_tree.nodes.clear()
    return owner.node_tree.nodes, owner.node_tree.links


def set_material(figure, material):
    figure.data.materials.clear()
    figure.data.materials.append(material)


def aim_camera(frame):
    scene = bpy.context.scene
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    at, target = mathutils.Vector(frame["camera"]["position"]), mathutils.Vector(frame["camera"]["target"])
    camera.location = at
    camera.rotation_mode = "QUATERNION"
    camera.rotation_quaternion = (target - at).to_track_quat("-Z", "Y")
    camera.data.sensor_fit = "VERTICAL"
    camera.data.angle_y = math.radians(frame["camera"]["vertical_fov_deg"])
    camera.data.clip_start = 1e-3 * (target - at).length
    camera.data.clip_end = 1e3 * (target - at).length


def render_plainly(frame, samples):
    """Cycles on the processor, the picture's size, and values as they come. Gives the scene."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.render.film_transparent = True
    scene.render.dither_intensity = 0.0
    scene.render.use_compositing = scene.render.use_sequencer = False
    scene.view_settings.view_transform = "Raw"
    scene.render.resolution_x, scene.render.resolution_y = frame["size_px"]
    scene.render.resolution_percentage = 100
    scene.render.image_settings.color_mode = "RGBA"
    return scene
