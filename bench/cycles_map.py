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
import os
import sys
import time

import bpy

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
from cycles_scene import aim_camera, arguments_of, figure_from, nodes_of, read_frame, render_plainly, set_material, turn

parser = argparse.ArgumentParser()
parser.add_argument("--mesh", required=True)
parser.add_argument("--up", default="z")
parser.add_argument("--sidecar", required=True)
parser.add_argument("--times")
parser.add_argument("--png")
parser.add_argument("--angles", default="0,5,10,15,20,25,-10,-20")
arguments = arguments_of(parser)
frame = read_frame(arguments.sidecar)
low, high = frame["bounds"]["min"], frame["bounds"]["max"]

figure = figure_from(arguments.mesh, arguments.up)
for polygon in figure.data.polygons:
    polygon.use_smooth = False

# Colour = (position - low) / (high - low), in linear light.
material = bpy.data.materials.new("coordinates")
nodes, links = nodes_of(material)
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
set_material(figure, material)
aim_camera(frame)

# Nothing may mix two surfaces in a pixel.
scene = render_plainly(frame, 1)
scene.cycles.pixel_filter_type = "BLACKMAN_HARRIS"
scene.cycles.filter_width = 0.01
scene.cycles.max_bounces = 0
scene.render.use_persistent_data = True
scene.render.image_settings.file_format = "PNG"
scene.render.image_settings.color_depth = "16"

seconds = []
for number, angle in enumerate(float(word) for word in arguments.angles.split(",")):
    turn(figure, frame, angle)
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
