#version 330 core
// An object as it stands on the turntable. Positions are relative to the centre of the bounding box, so that float keeps
// its precision for meshes far from their origin.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 openness; // mean unblocked direction, share of the hemisphere that is unblocked
layout(location = 3) in vec2 picture_place; // where on its material's picture, if that has one
layout(location = 5) in vec2 surface_place; // where on its picture of metal
layout(location = 4) in vec3 corner_colour; // of the file: its material's, times that of the corner

uniform mat4 clip_from_object;
uniform mat4 world_from_object; // about the centre

out vec3 world_position;
out vec3 world_normal;
out vec3 object_position;
out vec4 world_openness;
out vec2 place;
out vec2 place_of_metal;
out vec3 colour;

void main() {
    world_position = (world_from_object * vec4(position, 1.0)).xyz;
    world_normal = mat3(world_from_object) * normal;
    world_openness = vec4(mat3(world_from_object) * openness.xyz, openness.w);
    object_position = position;
    place = picture_place;
    place_of_metal = surface_place;
    colour = corner_colour;
    gl_Position = clip_from_object * vec4(position, 1.0);
}
