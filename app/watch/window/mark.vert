#version 330 core
// A ring or a disc about a place of the window.
layout(location = 0) in vec4 placed; // x, y from the top left, radius, width of the line (0: a disc), in pixels
layout(location = 1) in vec4 colour;
uniform ivec2 window_px;
out vec4 mark_colour;
out float size_px, radius, line;

void main() {
    radius = placed.z;
    line = placed.w;
    size_px = 2.0 * (radius + line) + 2.0;
    gl_Position = vec4(2.0 * placed.x / window_px.x - 1.0, 1.0 - 2.0 * placed.y / window_px.y, 0.0, 1.0);
    gl_PointSize = size_px;
    mark_colour = colour;
}
