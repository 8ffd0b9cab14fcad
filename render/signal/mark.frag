#version 330 core
// Pixels that lie no farther than half a width from a line through points get one light; all others stay as they are. Nothing is blended:
// what is there is encoded. Where two neighbours carry one colour, both are drawn, or neither.
out vec4 code;

const int most_points = 65;
uniform vec2 points[most_points]; // in pixels of the target, from its first row's first corner
uniform int count;
uniform float reach;              // half the width
uniform int joined;               // pixels that carry one colour
uniform vec4 inks[2];             // of even and odd columns, encoded

float distance_to(vec2 from, vec2 to, vec2 at) {
    vec2 along = to - from;
    float squared = dot(along, along);
    float share = squared > 0.0 ? clamp(dot(at - from, along) / squared, 0.0, 1.0) : 0.0;
    return distance(at, from + share * along);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 at = vec2((float(pixel.x / joined) + 0.5) * float(joined), float(pixel.y) + 0.5);
    float nearest = distance(at, points[0]);
    for (int i = 1; i < count; ++i)
        nearest = min(nearest, distance_to(points[i - 1], points[i], at));
    if (nearest > reach)
        discard;
    code = inks[pixel.x & 1];
}
