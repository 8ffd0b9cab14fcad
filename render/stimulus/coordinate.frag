#version 330 core
// Which triangle is nearest at the pixel's centre: its number + 1; 0 stays where there is none.
layout(location = 0) out uint triangle_code;
void main() { triangle_code = uint(gl_PrimitiveID) + 1u; }
