#version 330 core
// 16-bit codes into the levels of the video signal, in whole numbers: floor(code * levels / 65535 + share). The share is a half, or
// runs through 4096 equal steps over a tile of pixels and over the refreshes.
out vec4 signal;

uniform sampler2D codes;       // RGBA16
uniform usampler2D ranks;      // the tile, 64 x 64, each of 0 … 4095 once
uniform int levels;
uniform int dithered;
uniform int refresh;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    uvec3 code = uvec3(texelFetch(codes, pixel, 0).rgb * 65535.0 + 0.5);
    uvec3 share = uvec3(32767u);
    if (dithered != 0) {
        uint rank = texelFetch(ranks, pixel & 63, 0).r;
        // 2531 / 4096 is nearest to the golden section: the steps that a pixel takes over time fill the range evenly from the first on.
        // A third of the range lies between the channels, so that they are not raised in the same pixels.
        uvec3 step = (uvec3(rank + uint(refresh) * 2531u) + uvec3(0u, 1365u, 2731u)) & 4095u;
        share = step * 65535u / 4096u;
    }
    uvec3 level = (code * uint(levels) + share) / 65535u;
    signal = vec4(vec3(level) / float(levels), 1.0);
}
