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

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
from cycles_scene import aim_camera, arguments_of, figure_from, nodes_of, read_frame, render_plainly, set_material, turn

parser = argparse.ArgumentParser()
parser.add_argument("--mesh", required=True)
parser.add_argument("--up", default="z")
parser.add_argument("--sidecar", required=True)
parser.add_argument("--probe", required=True)
parser.add_argument("--roughness", type=float, default=0.0)
parser.add_argument("--samples", type=int, default=256)
parser.add_argument("--crease-deg", type=float, default=50.0)
parser.add_argument("--ours", required=True)
arguments = arguments_of(parser)
frame = read_frame(arguments.sidecar)
width, height = frame["size_px"]

figure = figure_from(arguments.mesh, arguments.up)
for polygon in figure.data.polygons:
    polygon.use_smooth = True
figure.data.use_auto_smooth = True
figure.data.auto_smooth_angle = math.radians(arguments.crease_deg)
turn(figure, frame, frame["angle_deg"])

material = bpy.data.materials.new("white metal")
nodes, links = nodes_of(material)
metal = nodes.new("ShaderNodeBsdfGlossy")
metal.distribution = "GGX" if arguments.roughness > 0 else "SHARP"
metal.inputs["Color"].default_value = (1, 1, 1, 1)
metal.inputs["Roughness"].default_value = math.sqrt(arguments.roughness)  # Cycles squares it
links.new(metal.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
set_material(figure, material)

world = bpy.data.worlds.new("light")
bpy.context.scene.world = world
nodes, links = nodes_of(world)
probe = nodes.new("ShaderNodeTexEnvironment")
probe.image = bpy.data.images.load(arguments.probe)
probe.image.colorspace_settings.name = "Linear"
mapping = nodes.new("ShaderNodeMapping")
mapping.inputs["Rotation"].default_value = (0, 0, math.radians(-90))
background = nodes.new("ShaderNodeBackground")
links.new(nodes.new("ShaderNodeTexCoord").outputs["Generated"], mapping.inputs["Vector"])
links.new(mapping.outputs[0], probe.inputs["Vector"])
links.new(probe.outputs["Color"], background.inputs["Color"])
links.new(background.outputs[0], nodes.new("ShaderNodeOutputWorld").inputs["Surface"])

aim_camera(frame)
scene = render_plainly(frame, arguments.samples)
cycles = scene.cycles
cycles.pixel_filter_type = "BOX"
cycles.filter_width = 1.0
cycles.max_bounces = cycles.glossy_bounces = 64
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
cycles.blur_glossy = 0.0
cycles.caustics_reflective = True
scene.render.image_settings.file_format = "OPEN_EXR"
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
