# A coordinate-encoded map by Blender Cycles: an emitting material whose colour is the object's coordinates within
# its bounding box, one sample in the middle of each pixel. To be run by Blender:
#
#   blender -b --factory-startup -P cycles_map.py -- --mesh M.ply --up y --sidecar FRAME.json --times T.json [--png DIR]
#
# The sidecar is that of a map of the same mesh (overt lut): camera and box are taken from it. Writes the seconds
# of each render after the first as a JSON list. With --png also 16-bit PNGs with their sidecars, fit for a
# protocol's key `lut`, for the angles of --angles (degrees).
import argparse
import json
import math
import os
import sys
import time

import bpy
import mathutils

parser = argparse.ArgumentParser()
parser.add_argument("--mesh", required=True)
parser.add_argument("--up", default="z")
parser.add_argument("--sidecar", required=True)
parser.add_argument("--times")
parser.add_argument("--png")
parser.add_argument("--angles", default="0,5,10,15,20,25,-10,-20")
arguments = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])
frame = json.load(open(arguments.sidecar))
low, high = frame["bounds"]["min"], frame["bounds"]["max"]

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.preferences.addon_enable(module="io_mesh_ply")
bpy.ops.import_mesh.ply(filepath=arguments.mesh)
figure = bpy.context.selected_objects[0]
# Which file axis becomes x, y and z: the rotations that bring the file's upward axis to +z.
rows = {"z": ((1, 0, 0), (0, 1, 0), (0, 0, 1)), "y": ((1, 0, 0), (0, 0, -1), (0, 1, 0))}[arguments.up]
figure.data.transform(mathutils.Matrix(rows).to_4x4())
for polygon in figure.data.polygons:
    polygon.use_smooth = False

# Colour = (position - low) / (high - low), in linear light.
material = bpy.data.materials.new("coordinates")
material.use_nodes = True
nodes, links = material.node_tree.nodes, material.node_tree.links
nodes.clear()
position = nodes.new("ShaderNodeTexCoord")
from_low = nodes.new("ShaderNodeVectorMath")
from_low.operation = "SUBTRACT"
from_low.inputs[1].default_value = low
share = nodes.new("ShaderNodeVectorMath")
share.operation = "DIVIDE"
share.inputs[1].default_value = [b - a if b > a else 1.0 for a, b in zip(low, high)]
emission = nodes.new("ShaderNodeEmission")
output = nodes.new("ShaderNodeOutputMaterial")
links.new(position.outputs["Object"], from_low.inputs[0])
links.new(from_low.outputs[0], share.inputs[0])
links.new(share.outputs[0], emission.inputs["Color"])
links.new(emission.outputs[0], output.inputs["Surface"])
figure.data.materials.clear()
figure.data.materials.append(material)

camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
bpy.context.scene.collection.objects.link(camera)
bpy.context.scene.camera = camera
at, target = mathutils.Vector(frame["camera"]["position"]), mathutils.Vector(frame["camera"]["target"])
camera.location = at
camera.rotation_mode = "QUATERNION"
camera.rotation_quaternion = (target - at).to_track_quat("-Z", "Y")
camera.data.sensor_fit = "VERTICAL"
camera.data.angle_y = math.radians(frame["camera"]["vertical_fov_deg"])
camera.data.clip_start = 1e-3 * (target - at).length
camera.data.clip_end = 1e3 * (target - at).length

# Nothing may mix two surfaces in a pixel, or bend the numbers.
scene = bpy.context.scene
scene.render.engine = "CYCLES"
scene.cycles.device = "CPU"
scene.cycles.samples = 1
scene.cycles.use_adaptive_sampling = False
scene.cycles.use_denoising = False
scene.cycles.pixel_filter_type = "BLACKMAN_HARRIS"
scene.cycles.filter_width = 0.01
scene.cycles.max_bounces = 0
scene.render.film_transparent = True
scene.render.dither_intensity = 0.0
scene.render.use_persistent_data = True
scene.render.use_compositing = scene.render.use_sequencer = False
scene.view_settings.view_transform = "Raw"
scene.render.resolution_x, scene.render.resolution_y = frame["size_px"]
scene.render.resolution_percentage = 100
scene.render.image_settings.file_format = "PNG"
scene.render.image_settings.color_mode = "RGBA"
scene.render.image_settings.color_depth = "16"

axis = mathutils.Matrix.Translation([(a + b) / 2 for a, b in zip(low, high)])
seconds = []
for number, angle in enumerate(float(word) for word in arguments.angles.split(",")):
    figure.matrix_world = axis @ mathutils.Matrix.Rotation(math.radians(angle), 4, "Z") @ axis.inverted()
    bpy.context.view_layer.update()
    begin = time.perf_counter()
    bpy.ops.render.render(write_still=False)
    seconds.append(time.perf_counter() - begin)
    if arguments.png:
        os.makedirs(arguments.png, exist_ok=True)
        stem = os.path.join(arguments.png, "frame_%04d" % number)
        bpy.data.images["Render Result"].save_render(stem + ".png", scene=scene)
        sidecar = {"scale": 65535, "bounds": frame["bounds"], "camera": frame["camera"], "angle_deg": angle}
        json.dump(sidecar, open(stem + ".json", "w"), indent=1)
if arguments.times:
    json.dump(seconds[1:], open(arguments.times, "w"))
