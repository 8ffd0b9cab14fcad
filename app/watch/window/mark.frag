#version 330 core
in vec4 mark_colour;
in float size_px, radius, line;
out vec4 pixel;

void main() {
    float away = length(gl_PointCoord - vec2(0.5)) * size_px;
    float inside = line > 0.0 ? 0.5 * line - abs(away - radius) : radius - away;
    pixel = vec4(mark_colour.rgb, mark_colour.a * clamp(inside + 0.5, 0.0, 1.0));
}
