#version 330 core
// Metals and plastics under a light probe, approximated for the graphics processor: one mirrored direction per point, looked up in a probe
// blurred beforehand, dimmed where the figure itself is in the way, with one bounce of its own colour from there.
in vec3 world_position;
in vec3 world_normal;
in vec3 object_position;
in vec4 world_openness;
in vec2 place;
in vec2 place_of_metal;
in vec3 colour;

layout(location = 0) out vec4 linear_light; // display RGB, alpha 1 on the object

uniform vec3 camera_position;    // world, about the centre
uniform sampler2D mirrored;      // the probe as this material mirrors it; for a diffuse one, irradiance / pi
uniform sampler2D sharp;         // the probe itself, for the coat
uniform sampler2D soft;          // irradiance / pi, for what the figure itself sends back
uniform vec3 reflectance;        // at normal incidence (metals), or albedo
uniform float lobe_radius;       // half-angle in radians over which the material gathers light
uniform float exposure;
uniform float light_turn;        // of the probe about the vertical, in whole turns
uniform int is_diffuse;
uniform int is_coated;
uniform int is_painted;          // the object's file says its colours
uniform int has_picture;
uniform sampler2D picture;       // of colours
uniform int has_metal;           // a picture says what is metal, in its blue channel
uniform sampler2D metal;
uniform float metallic;          // factor on it
// Of metals and plastics, by the root of the cosine: mirrored, with the clear coat's in alpha; even; where the file says colours, these are
// of black, and two more rows of what each share of its colour adds; with a picture of metal, four rows of what is none and four of what is.
uniform sampler2D shares;
uniform float coat_ior;
uniform float glass_ior;         // 1: no light goes through
uniform vec3 coat_absorbance;    // for one pass of the nominal thickness, at normal incidence
uniform float bump_slope;        // greatest slope of the coat's bumps
uniform float bump_scale;        // bumps per unit of length

const float pi = 3.14159265358979;

vec3 probe(sampler2D picture, vec3 direction) {
    vec2 place = vec2(atan(direction.x, direction.y) / (2.0 * pi) + 0.5 + light_turn, acos(clamp(direction.z, -1.0, 1.0)) / pi);
    return textureLod(picture, place, 0.0).rgb;
}

// Fresnel reflectance of a metal from its reflectance at normal incidence (Schlick 1994).
vec3 metal_fresnel(vec3 at_normal, float cosine) {
    return at_normal + (vec3(1.0) - at_normal) * pow(clamp(1.0 - cosine, 0.0, 1.0), 5.0);
}

// Exact Fresnel reflectance from air into a dielectric, unpolarised.
float dielectric_fresnel(float cosine, float ior) {
    float inside = sqrt(max(0.0, 1.0 - (1.0 - cosine * cosine) / (ior * ior)));
    float parallel = (ior * cosine - inside) / (ior * cosine + inside);
    float perpendicular = (cosine - ior * inside) / (cosine + ior * inside);
    return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

// Share of a lobe about `direction` that leaves the figure: the open directions are taken as a cone.
float openness_towards(vec3 direction) {
    float open_radius = acos(sqrt(clamp(1.0 - world_openness.w, 0.0, 1.0)));
    float away = acos(clamp(dot(direction, normalize(world_openness.xyz + 1e-4 * world_normal)), -1.0, 1.0));
    float penumbra = max(lobe_radius, 0.45);
    return 1.0 - smoothstep(open_radius - penumbra, open_radius + penumbra, away);
}

// Light from a direction: the probe where it is open, else the figure itself. Metal in a fold is lit by metal: its colour deepens.
vec3 incoming(sampler2D picture, vec3 direction, vec3 tint) {
    float open = openness_towards(direction);
    vec3 outward = normalize(world_openness.xyz + 0.4 * direction + 1e-4 * world_normal);
    vec3 folded = tint * mix(tint * tint, vec3(1.0), world_openness.w) * probe(soft, outward) * (0.15 + 0.85 * world_openness.w);
    return mix(folded, probe(picture, direction), open);
}

// Light that a matt surface gives back, of reflectance 1 in the open; in a fold its own light goes to and fro, as in a hollow that is
// the same everywhere.
vec3 evenly_lit(vec3 normal, vec3 tint) {
    float open = world_openness.w;
    vec3 outward = normalize(world_openness.xyz + 0.2 * normal);
    return probe(soft, outward) * open / (vec3(1.0) - clamp(tint, 0.0, 0.98) * (1.0 - open));
}

vec4 share_in(int row, float cosine) {
    float at = sqrt(cosine) * float(textureSize(shares, 0).x - 1);
    int before = min(int(at), textureSize(shares, 0).x - 2);
    return mix(texelFetch(shares, ivec2(before, row), 0), texelFetch(shares, ivec2(before + 1, row), 0), at - float(before));
}

vec4 painted_share(int kind, float cosine, vec3 own) {
    vec4 share = share_in(kind, cosine);
    share.rgb = clamp(share.rgb + own * share_in(kind + 2, cosine).rgb, 0.0, 1.0);
    return share;
}

vec4 share_of(int kind, float cosine, vec3 own) {
    if (is_painted == 0)
        return share_in(kind, cosine);
    vec4 share = painted_share(kind, cosine, own);
    if (has_metal == 1)
        share = mix(share, painted_share(kind + 4, cosine, own), clamp(metallic * texture(metal, place_of_metal).b, 0.0, 1.0));
    return share;
}

// Noise of Perlin's kind on a lattice, with its gradient; hashing after Jarzynski and Olano 2020 (pcg3d).
uvec3 hashed(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
    return v;
}

vec3 lattice_gradient(ivec3 corner) {
    return vec3(hashed(uvec3(corner + 65536))) * (2.0 / 4294967295.0) - 1.0;
}

float noise(vec3 place) {
    ivec3 cell = ivec3(floor(place));
    vec3 f = place - vec3(cell);
    vec3 s = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    float corners[8];
    for (int i = 0; i < 8; ++i) {
        ivec3 corner = ivec3(i & 1, (i >> 1) & 1, i >> 2);
        corners[i] = dot(lattice_gradient(cell + corner), f - vec3(corner));
    }
    return mix(mix(mix(corners[0], corners[1], s.x), mix(corners[2], corners[3], s.x), s.y),
               mix(mix(corners[4], corners[5], s.x), mix(corners[6], corners[7], s.x), s.y), s.z);
}

vec3 bumpy_normal(vec3 normal) {
    vec3 place = object_position * bump_scale;
    const float step_size = 0.02;
    float here = noise(place);
    vec3 slope = vec3(noise(place + vec3(step_size, 0, 0)), noise(place + vec3(0, step_size, 0)),
                      noise(place + vec3(0, 0, step_size))) - here;
    slope *= bump_slope / step_size;
    // The bumps live in object space; the turn about z is undone by the frame that world_normal came from.
    return normalize(normal - (slope - normal * dot(slope, normal)));
}

void main() {
    vec3 normal = normalize(world_normal);
    vec3 to_camera = normalize(camera_position - world_position);
    // Interpolated normals may lean away at the silhouette.
    normal = normalize(normal + to_camera * max(0.0, 1e-3 - dot(normal, to_camera)));
    vec3 light;
    vec3 own = reflectance;
    if (is_painted == 1)
        own = clamp(colour * (has_picture == 1 ? texture(picture, place).rgb : vec3(1.0)), 0.0, 1.0);
    if (is_diffuse == 1) {
        light = own * evenly_lit(normal, own);
    } else if (is_coated == 1) {
        vec3 bumpy = bumpy_normal(normal);
        bumpy = normalize(bumpy + to_camera * max(0.0, 0.02 - dot(bumpy, to_camera)));
        float cosine = clamp(dot(bumpy, to_camera), 0.0, 1.0);
        float shine = dielectric_fresnel(cosine, coat_ior);
        vec3 mirror = reflect(-to_camera, bumpy);
        // Below the coat the silver is smooth, but seen and lit through the bumps.
        vec3 inside = refract(-to_camera, bumpy, 1.0 / coat_ior);
        vec3 mirrored_inside = reflect(inside, normal);
        vec3 outward = normalize(mix(reflect(-to_camera, normal), mirror, 0.5));
        float path = 1.0 / max(dot(-inside, normal), 0.2) + 1.0 / max(dot(mirrored_inside, normal), 0.2);
        vec3 through = exp(-coat_absorbance * path);
        vec3 silver = metal_fresnel(reflectance, max(dot(-inside, normal), 0.0));
        light = shine * incoming(sharp, mirror, reflectance * through)
              + (1.0 - shine) * (1.0 - shine) * through * silver * incoming(mirrored, outward, reflectance * through);
    } else {
        float cosine = clamp(dot(normal, to_camera), 0.0, 1.0);
        vec3 mirror = reflect(-to_camera, normal);
        vec4 shown = share_of(0, cosine, own);
        vec3 even = share_of(1, cosine, own).rgb;
        vec3 tint = shown.rgb + even;
        if (glass_ior > 1.0) {
            // As through a ball that has the same normal, in and out: what is behind, turned upside down.
            vec3 inside = refract(-to_camera, normal, 1.0 / glass_ior);
            vec3 far_normal = normal - 2.0 * dot(normal, inside) * inside;
            vec3 out_of_it = refract(inside, -far_normal, glass_ior);
            light = shown.rgb * probe(mirrored, mirror) + even * probe(mirrored, out_of_it == vec3(0.0) ? inside : out_of_it);
        } else {
            light = shown.rgb * incoming(mirrored, mirror, tint) + even * evenly_lit(normal, tint) + shown.a * incoming(sharp, mirror, tint);
        }
    }
    linear_light = vec4(exposure * light, 1.0);
}
