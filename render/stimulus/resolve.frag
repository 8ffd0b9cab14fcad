#version 330 core
// The mean of each square block of samples: a box filter one pixel wide.
out vec4 mean;
uniform sampler2D samples;
uniform int per_side;
void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * per_side;
    vec4 sum = vec4(0.0);
    for (int y = 0; y < per_side; ++y) {
        for (int x = 0; x < per_side; ++x) sum += texelFetch(samples, first + ivec2(x, y), 0);
    }
    mean = sum / float(per_side * per_side);
}
