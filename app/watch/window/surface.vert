#version 330 core
// A surface whose vertices have a value, seen by an orbiting camera.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 colour;
uniform mat4 clip_from_object;
uniform vec3 to_eye; // direction from the surface to the camera, in object coordinates
out vec3 seen_colour;
out float facing;

void main() {
    gl_Position = clip_from_object * vec4(position, 1.0);
    seen_colour = colour;
    facing = abs(dot(normalize(normal), to_eye));
}
