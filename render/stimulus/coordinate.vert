#version 330 core
// The hidden pass: the same camera and pose as the stimulus, nothing but geometry.
layout(location = 0) in vec3 position;
uniform mat4 clip_from_object;
void main() { gl_Position = clip_from_object * vec4(position, 1.0); }
