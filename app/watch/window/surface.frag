#version 330 core
in vec3 seen_colour;
in float facing;
out vec4 pixel;

void main() {
    // Enough shade to see the shape, not so much that colours leave their scale.
    pixel = vec4(seen_colour * mix(0.45, 1.0, facing), 1.0);
}
