#include "render/bake/own_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiment/base/parallel.h"
#include "render/bake/light_colour.h"
#include "render/bake/microfacets.h"

namespace overt {

namespace {

/// Roughness of a picture in steps: so fine that a step cannot be told in a highlight, and few enough that
/// each has tables of its own.
constexpr int roughness_steps = 32;

constexpr float pi_of_own = std::numbers::pi_v<float>;
constexpr float least_even = 1e-6f; ///< see LayeredSurface

std::size_t step_of(float roughness) {
    return static_cast<std::size_t>(std::lround(std::clamp(roughness, 0.0f, 1.0f) * roughness_steps));
}

/// Steps that the surface can be found to have: those between the extremes of each material's picture.
std::vector<std::size_t> steps_of(const SurfaceAppearance& appearance) {
    std::array<bool, roughness_steps + 1> has{};
    for (const FileMaterial& material : appearance.materials) {
        float least = 1.0f, most = 1.0f;
        if (material.surface_picture.picture >= 0) {
            const auto& texels =
                appearance.pictures[static_cast<std::size_t>(material.surface_picture.picture)]->texels;
            const auto [low, high] =
                std::ranges::minmax_element(texels, {}, [](const glm::u8vec4& texel) { return texel.y; });
            least = static_cast<float>(low->y) / 255.0f;
            most = static_cast<float>(high->y) / 255.0f;
        }
        const std::size_t from = step_of(material.roughness * least), to = step_of(material.roughness * most);
        std::fill(has.begin() + static_cast<std::ptrdiff_t>(from),
                  has.begin() + static_cast<std::ptrdiff_t>(to) + 1, true);
    }
    std::vector<std::size_t> steps;
    for (std::size_t step = 0; step < has.size(); ++step)
        if (has[step])
            steps.push_back(step);
    if (appearance.materials.empty())
        steps.push_back(step_of(FileMaterial().roughness));
    return steps;
}

/// Schlick's curve without its colour: 0 at normal incidence, 1 at grazing.
float rise_towards_grazing(float cosine) {
    const float rest = 1.0f - std::clamp(cosine, 0.0f, 1.0f), square = rest * rest;
    return square * square * rest;
}

} // namespace

/// How often each part is chosen.
struct OwnSurface::Chances {
    float coat = 0.0f, mirrors = 0.0f, even = 0.0f; ///< 1 together
};

OwnSurface::OwnSurface(std::shared_ptr<const SurfaceAppearance> appearance, const MaterialSettings& material)
    : appearance_(std::move(appearance)), is_matt_(material.kind == MaterialKind::diffuse),
      is_pigment_(material.kind == MaterialKind::plastic && material.body == PlasticBody::pigment),
      ior_(static_cast<float>(material.ior)),
      inner_(static_cast<float>(is_pigment_ ? inner_reflectance(material.ior) : 0.0)),
      has_own_roughness_(material.kind == MaterialKind::own) {
    for (std::size_t channel = 0; channel < 3; ++channel)
        basis_[channel] = Bins::of(reflectance_basis()[channel]);
    if (is_matt_)
        return;
    if (material.kind == MaterialKind::plastic)
        metallic_ = 0.0f;
    else if (material.kind == MaterialKind::metallic_roughness)
        metallic_ = static_cast<float>(material.given_metallic());
    if (has_own_roughness_) {
        level_of_step_.assign(roughness_steps + 1, 0);
        for (const std::size_t step : steps_of(*appearance_)) {
            level_of_step_[step] = levels_.size();
            const float roughness = static_cast<float>(step) / roughness_steps;
            levels_.push_back({usable_alpha(roughness * roughness), {}, {}, {}});
        }
        Given given;
        if (material.reflectance)
            given.colour = glm::vec3(*material.reflectance);
        if (material.metallic)
            given.metallic = static_cast<float>(*material.metallic);
        if (material.roughness) {
            given.level = levels_.size();
            levels_.push_back({usable_alpha(material.alpha()), {}, {}, {}});
        }
        if (given.colour || given.metallic || given.level)
            for (const bool is_given : given_materials(material, *appearance_))
                given_.push_back(is_given ? given : Given());
    } else {
        levels_.push_back({usable_alpha(material.alpha()), {}, {}, {}});
    }
    parallel_for(static_cast<int>(3 * levels_.size()), [&](int index) {
        Level& level = levels_[static_cast<std::size_t>(index / 3)];
        const auto alpha = static_cast<double>(level.alpha);
        switch (index % 3) {
        case 0:
            level.dielectric = LobeAlbedo(alpha, [&](double cosine) {
                return static_cast<double>(dielectric_fresnel(ior_, static_cast<float>(cosine)));
            });
            break;
        case 1:
            level.lossless = LobeAlbedo(alpha, [](double) { return 1.0; });
            break;
        default:
            level.grazing = LobeAlbedo(alpha, [](double cosine) {
                return static_cast<double>(rise_towards_grazing(static_cast<float>(cosine)));
            });
        }
    });
    coat_ = clear_coat_of(material);
}

OwnPoint OwnSurface::point(std::uint32_t triangle, glm::vec2 place) const {
    SurfaceLook look = look_at(*appearance_, triangle, place);
    OwnPoint point;
    std::optional<std::size_t> level;
    if (!given_.empty()) {
        const Given& given =
            given_[appearance_->triangle_materials.empty() ? 0 : appearance_->triangle_materials[triangle]];
        look.colour = given.colour.value_or(look.colour);
        look.metallic = given.metallic.value_or(look.metallic);
        level = given.level;
    }
    add_lit(point.colour, Bins::filled(1.0f), basis_, look.colour);
    for (float& value : point.colour.value) {
        value = std::clamp(value, 0.0f, 1.0f);
        if (is_pigment_)
            value *= (1.0f - inner_) / (1.0f - value * inner_);
    }
    point.metallic = metallic_.value_or(look.metallic);
    if (has_own_roughness_ && !is_matt_)
        point.level = level ? *level : level_of_step_[step_of(look.roughness)];
    return point;
}

OwnSurface::Chances OwnSurface::chances(const OwnPoint& point, float cosine) const {
    const Level& level = levels_[point.level];
    const float m = point.metallic, largest = point.colour.largest();
    float mean = 0.0f;
    for (std::size_t bin = 0; bin < spectral_bins; ++bin)
        mean += point.colour.value[bin] / static_cast<float>(spectral_bins);
    const float lossless = level.lossless.at(cosine), grazing = level.grazing.at(cosine),
                dielectric = level.dielectric.at(cosine);
    const float by_coat = coat_ ? coat_->albedo.at(cosine) : 0.0f;
    const float by_mirrors =
        (1.0f - by_coat) * (m * (mean * (lossless - grazing) + grazing) + (1.0f - m) * dielectric);
    const float evenly = (1.0f - by_coat) * ((1.0f - m) * largest * (1.0f - dielectric) +
                                             m * largest * largest * (1.0f - lossless));
    // As of LayeredSurface: what is even is never asked too seldom.
    constexpr float least = 0.05f;
    const float glossy = by_coat + by_mirrors;
    if (glossy <= 0.0f)
        return {0.0f, 0.0f, 1.0f};
    const float even = std::max(least, evenly / (glossy + evenly)), share = (1.0f - even) / glossy;
    return {share * by_coat, share * by_mirrors, even};
}

glm::vec3 OwnSurface::scatter(const SurfaceEvent& event, SampleSequence& sequence, Bins& carried) const {
    const OwnPoint& point = *event.point;
    const NormalFrame frame(event.normal);
    if (is_matt_) {
        multiply(carried, point.colour);
        return frame.to_world(cosine_direction(sequence.next_two()));
    }
    const glm::vec3 to_eye = frame.to_local(event.to_eye);
    const Chances chance = chances(point, to_eye.z);
    const float choice = sequence.next();
    const glm::vec2 place = sequence.next_two();
    glm::vec3 onward;
    if (choice < chance.even) {
        onward = frame.to_world(cosine_direction(place));
    } else {
        const float alpha = choice < chance.even + chance.coat ? coat_->alpha : levels_[point.level].alpha;
        const glm::vec3 micro = frame.to_world(ggx_visible_normal(to_eye, alpha, place));
        onward = glm::normalize(2.0f * glm::dot(event.to_eye, micro) * micro - event.to_eye);
    }
    if (frame.to_local(onward).z <= 0.0f)
        return glm::vec3(0.0f);
    take(event, onward, carried);
    return onward;
}

float OwnSurface::density(const SurfaceEvent& event, glm::vec3 onward) const {
    const NormalFrame frame(event.normal);
    const glm::vec3 to_eye = frame.to_local(event.to_eye), out = frame.to_local(onward);
    if (is_matt_)
        return std::max(0.0f, out.z) / pi_of_own;
    if (to_eye.z <= 0.0f || out.z <= 0.0f)
        return 0.0f;
    const Chances chance = chances(*event.point, to_eye.z);
    float density = chance.even * out.z / pi_of_own;
    density += chance.mirrors * ggx_mirror_density(to_eye, out, levels_[event.point->level].alpha);
    if (coat_)
        density += chance.coat * ggx_mirror_density(to_eye, out, coat_->alpha);
    return density;
}

Bins OwnSurface::value(const SurfaceEvent& event, glm::vec3 onward) const {
    const OwnPoint& point = *event.point;
    const NormalFrame frame(event.normal);
    const glm::vec3 to_eye = frame.to_local(event.to_eye), out = frame.to_local(onward);
    Bins value{};
    if (is_matt_) {
        value = point.colour;
        scale(value, out.z > 0.0f ? 1.0f / pi_of_own : 0.0f);
        return value;
    }
    if (to_eye.z <= 0.0f || out.z <= 0.0f)
        return value;
    const Level& level = levels_[point.level];
    const float towards = std::min(1.0f, glm::dot(to_eye, glm::normalize(to_eye + out)));
    const float m = point.metallic;
    float below_coat = 1.0f;
    if (coat_) {
        below_coat = (1.0f - coat_->albedo.at(to_eye.z)) * (1.0f - coat_->albedo.at(out.z));
        value = Bins::filled(ggx_mirror_density(to_eye, out, coat_->alpha) *
                             ggx_visible_share(out, coat_->alpha) / out.z);
        coat_->reflectance.multiply_into(value, towards);
    }
    const float mirrored = below_coat * ggx_mirror_density(to_eye, out, level.alpha) *
                           ggx_visible_share(out, level.alpha) / out.z;
    const float rise = rise_towards_grazing(towards), clear = dielectric_fresnel(ior_, towards);
    const auto left = [&](const LobeAlbedo& taken) {
        return below_coat * (1.0f - taken.at(to_eye.z)) * (1.0f - taken.at(out.z)) /
               (pi_of_own * std::max(least_even, 1.0f - taken.mean()));
    };
    const float of_body = (1.0f - m) * left(level.dielectric), of_metal = m * left(level.lossless);
    const float given = level.lossless.mean();
    for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
        const float c = point.colour.value[bin];
        const float mean = c + (1.0f - c) / 21.0f; // of Schlick's curve, over light from everywhere
        value.value[bin] += mirrored * (m * (c + (1.0f - c) * rise) + (1.0f - m) * clear) + of_body * c +
                            of_metal * mean * mean * given / (1.0f - mean * (1.0f - given));
    }
    return value;
}

void OwnSurface::take(const SurfaceEvent& event, glm::vec3 onward, Bins& carried) const {
    if (is_matt_) {
        multiply(carried, event.point->colour);
        return;
    }
    const float cosine = glm::dot(event.normal, onward), per_steradian = density(event, onward);
    if (per_steradian <= 0.0f || cosine <= 0.0f) {
        carried = Bins{};
        return;
    }
    multiply(carried, value(event, onward));
    scale(carried, cosine / per_steradian);
}

std::vector<bool> given_materials(const MaterialSettings& material, const SurfaceAppearance& appearance) {
    std::vector<bool> given(std::max<std::size_t>(appearance.materials.size(), 1), material.of.empty());
    for (std::size_t i = 0; i < appearance.materials.size(); ++i)
        given[i] =
            given[i] || std::ranges::find(material.of, appearance.materials[i].name) != material.of.end();
    return given;
}

namespace {

/// The sums of what some of the file's materials are, by area.
struct LookSums {
    double area = 0.0, metallic = 0.0, roughness = 0.0;
    glm::dvec3 colour{0.0};

    void add(const MaterialSettings& material, const MeanLook& of, bool may_be_given) {
        area += of.area;
        colour += of.area *
                  (may_be_given && material.reflectance ? *material.reflectance : glm::dvec3(of.look.colour));
        metallic += of.area * (may_be_given && material.metallic ? *material.metallic
                                                                 : static_cast<double>(of.look.metallic));
        roughness += of.area * (may_be_given && material.roughness ? *material.roughness
                                                                   : static_cast<double>(of.look.roughness));
    }

    MaterialSettings mean_of(const MaterialSettings& material) const {
        MaterialSettings mean = material;
        mean.reflectance = colour / area;
        mean.base = MaterialBase::given;
        mean.bumps = MaterialBumps::none;
        if (material.kind == MaterialKind::own) {
            mean.kind = MaterialKind::metallic_roughness;
            mean.metallic = metallic / area;
            mean.roughness = std::max(0.001, roughness / area);
        }
        return mean;
    }
};

/// By the file's materials: what each is, and whether something is given in its place.
std::vector<LookSums> look_sums(const MaterialSettings& material, const SurfaceAppearance& appearance,
                                const Mesh& mesh) {
    const std::vector<MeanLook> looks = mean_looks(appearance, mesh);
    const std::vector<bool> given = given_materials(material, appearance);
    std::vector<LookSums> sums(looks.size());
    for (std::size_t i = 0; i < looks.size(); ++i)
        sums[i].add(material, looks[i], material.kind == MaterialKind::own && given[i]);
    return sums;
}

} // namespace

std::vector<std::optional<MaterialSettings>>
each_on_average(const MaterialSettings& material, const SurfaceAppearance& appearance, const Mesh& mesh) {
    std::vector<std::optional<MaterialSettings>> each;
    for (const LookSums& of : look_sums(material, appearance, mesh))
        each.push_back(of.area > 0.0 ? std::optional(of.mean_of(material)) : std::nullopt);
    return each;
}

MaterialSettings on_average(const MaterialSettings& material, const SurfaceAppearance& appearance,
                            const Mesh& mesh) {
    LookSums all;
    for (const LookSums& of : look_sums(material, appearance, mesh)) {
        all.area += of.area;
        all.colour += of.colour;
        all.metallic += of.metallic;
        all.roughness += of.roughness;
    }
    return all.area > 0.0 ? all.mean_of(material) : material;
}

} // namespace overt
