# The same figure in the same light by Blender Cycles, and how far a baked frame is from it. To be run by Blender:
#
#   blender -b --factory-startup -P cycles_bake.py -- --mesh M.ply --up y --sidecar FRAME.json --probe P.hdr
#       --roughness 0 --samples 256 --ours FRAME.exr
#
# The sidecar is that of a map of the same frame (overt lut): camera, box and angle are taken from it. The metal
# reflects all light; --roughness is GGX's alpha, 0: a mirror. Prints the comparison as one line of JSON.
import argparse
import json
import math
import os
import sys
import tempfile

import bpy
import mathutils

parser = argparse.ArgumentParser()
parser.add_argument("--mesh", required=True)
parser.add_argument("--up", default="z")
parser.add_argument("--sidecar", required=True)
parser.add_argument("--probe", required=True)
parser.add_argument("--roughness", type=float, default=0.0)
parser.add_argument("--samples", type=int, default=256)
parser.add_argument("--crease-deg", type=float, default=50.0)
parser.add_argument("--ours", required=True)
arguments = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])
frame = json.load(open(arguments.sidecar))
low, high = frame["bounds"]["min"], frame["bounds"]["max"]

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.preferences.addon_enable(module="io_mesh_ply")
bpy.ops.import_mesh.ply(filepath=arguments.mesh)
figure = bpy.context.selected_objects[0]
rows = {"z": ((1, 0, 0), (0, 1, 0), (0, 0, 1)), "y": ((1, 0, 0), (0, 0, -1), (0, 1, 0))}[arguments.up]
figure.data.transform(mathutils.Matrix(rows).to_4x4())
for polygon in figure.data.polygons:
    polygon.use_smooth = True
figure.data.use_auto_smooth = True
figure.data.auto_smooth_angle = math.radians(arguments.crease_deg)
axis = mathutils.Matrix.Translation([(a + b) / 2 for a, b in zip(low, high)])
figure.matrix_world = axis @ mathutils.Matrix.Rotation(math.radians(frame["angle_deg"]), 4, "Z") @ axis.inverted()

material = bpy.data.materials.new("white metal")
material.use_nodes = True
nodes, links = material.node_tree.nodes, material.node_tree.links
nodes.clear()
metal = nodes.new("ShaderNodeBsdfGlossy")
metal.distribution = "GGX" if arguments.roughness > 0 else "SHARP"
metal.inputs["Color"].default_value = (1, 1, 1, 1)
metal.inputs["Roughness"].default_value = math.sqrt(arguments.roughness)  # Cycles squares it
links.new(metal.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
figure.data.materials.clear()
figure.data.materials.append(material)

scene = bpy.context.scene
world = bpy.data.worlds.new("light")
scene.world = world
world.use_nodes = True
nodes, links = world.node_tree.nodes, world.node_tree.links
nodes.clear()
probe = nodes.new("ShaderNodeTexEnvironment")
probe.image = bpy.data.images.load(arguments.probe)
probe.image.colorspace_settings.name = "Linear"
turn = nodes.new("ShaderNodeMapping")
turn.inputs["Rotation"].default_value = (0, 0, math.radians(-90))
background = nodes.new("ShaderNodeBackground")
links.new(nodes.new("ShaderNodeTexCoord").outputs["Generated"], turn.inputs["Vector"])
links.new(turn.outputs[0], probe.inputs["Vector"])
links.new(probe.outputs["Color"], background.inputs["Color"])
links.new(background.outputs[0], nodes.new("ShaderNodeOutputWorld").inputs["Surface"])

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

scene.render.engine = "CYCLES"
cycles = scene.cycles
cycles.device = "CPU"
cycles.samples = arguments.samples
cycles.use_adaptive_sampling = False
cycles.use_denoising = False
cycles.pixel_filter_type = "BOX"
cycles.filter_width = 1.0
cycles.max_bounces = cycles.glossy_bounces = 64
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
cycles.blur_glossy = 0.0
cycles.caustics_reflective = True
scene.render.film_transparent = True
scene.render.use_compositing = scene.render.use_sequencer = False
scene.view_settings.view_transform = "Raw"
width, height = frame["size_px"]
scene.render.resolution_x, scene.render.resolution_y = width, height
scene.render.resolution_percentage = 100
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_mode = "RGBA"
scene.render.image_settings.color_depth = "32"
scene.render.filepath = os.path.join(tempfile.mkdtemp(), "cycles.exr")
bpy.ops.render.render(write_still=True)


def pixels_of(path):
    image = bpy.data.images.load(path)
    image.colorspace_settings.name = "Raw"
    image.alpha_mode = "CHANNEL_PACKED"
    if tuple(image.size) != (width, height):
        sys.exit("%s: %d x %d instead of %d x %d" % (path, *image.size, width, height))
    return list(image.pixels)


def blurred(channel):
    """A Gaussian of 2 px over rows, then over columns."""
    weights = [math.exp(-0.5 * (k / 2.0) ** 2) for k in range(-6, 7)]
    weights = [w / sum(weights) for w in weights]

    def along(values, step, count, lines, line_step):
        result = [0.0] * len(values)
        for line in range(lines):
            for i in range(count):
                total = 0.0
                for k, weight in enumerate(weights):
                    j = min(max(i + k - 6, 0), count - 1)
                    total += weight * values[line * line_step + j * step]
                result[line * line_step + i * step] = total
        return result

    return along(along(channel, 1, width, height, width), width, height, width, 1)


ours, theirs = pixels_of(arguments.ours), pixels_of(scene.render.filepath)
inside = [i for i in range(width * height) if min(ours[4 * i + 3], theirs[4 * i + 3]) > 0.999]
alpha = sum(abs(ours[4 * i + 3] - theirs[4 * i + 3]) for i in range(width * height)) / (width * height)
green, other = ours[1::4], theirs[1::4]
mean = sum(other[i] for i in inside) / len(inside)
ratios = [sum(ours[4 * i + c] for i in inside) / sum(theirs[4 * i + c] for i in inside) for c in range(3)]
soft, other_soft = blurred(green), blurred(other)
rmse = math.sqrt(sum((soft[i] - other_soft[i]) ** 2 for i in inside) / len(inside)) / mean
print("COMPARISON " + json.dumps({"mean_ratio": ratios, "blurred_relative_rmse": rmse, "mean_alpha_difference": alpha,
                                  "pixels": len(inside)}))
