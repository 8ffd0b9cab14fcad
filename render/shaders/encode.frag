#version 330 core
// Linear light into the bytes of the video signal. Formats: CRS Bits# manual's Mono++ and Color++ (as Psychtoolbox and PsychoPy
// drive them). Rounding is the same everywhere: floor(value * levels + 0.5) of a value clamped to 0 … 1.
out vec4 wire;

uniform sampler2D linear_light;
uniform int mode;             // 0 native 8 bit, 1 Mono++, 2 Color++
uniform float inverse_gamma;

vec3 light_at(ivec2 pixel) { return texelFetch(linear_light, pixel, 0).rgb; }
vec3 display_value(vec3 light) { return pow(clamp(light, 0.0, 1.0), vec3(inverse_gamma)); }
uvec3 code_16bit(vec3 value) { return uvec3(floor(value * 65535.0 + 0.5)); }

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    uvec3 bytes;
    if (mode == 0) {
        bytes = uvec3(floor(display_value(light_at(pixel)) * 255.0 + 0.5));
    } else if (mode == 1) {
        // Rec.709 luminance as grey; high byte in red, low byte in green, no overlay in blue.
        uint code = code_16bit(display_value(vec3(dot(light_at(pixel), vec3(0.2126, 0.7152, 0.0722))))).x;
        bytes = uvec3(code >> 8u, code & 255u, 0u);
    } else {
        // Each pair of pixels carries one colour: the mean of both in linear light, high bytes left, low bytes right.
        ivec2 left = ivec2(pixel.x & ~1, pixel.y);
        ivec2 right = ivec2(min(left.x + 1, textureSize(linear_light, 0).x - 1), pixel.y);
        uvec3 code = code_16bit(display_value(0.5 * (light_at(left) + light_at(right))));
        bytes = (pixel.x & 1) == 0 ? code >> 8u : code & 255u;
    }
    wire = vec4(vec3(bytes) / 255.0, 1.0);
}
