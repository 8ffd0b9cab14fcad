#include "render/bake/layered_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/bake/microfacets.h"

namespace overt {

namespace {

constexpr float pi_of_lobe = std::numbers::pi_v<float>;

/// Where mirrors give back all, nothing is left that could be even; and 0 / 0 must not be.
constexpr float least_left = 1e-6f;

/// Where a direction at a cosine lies among rows that are even in its root.
struct RowPlace {
    int row;
    float share;
};
RowPlace row_place(float cosine, int rows) {
    const float place = std::sqrt(std::clamp(cosine, 0.0f, 1.0f)) * static_cast<float>(rows - 1);
    const int row = std::min(static_cast<int>(place), rows - 2);
    return {row, place - static_cast<float>(row)};
}

} // namespace

LobeAlbedo::LobeAlbedo(double alpha, const std::function<double(double)>& reflectance)
    : share_(static_cast<std::size_t>(rows)) {
    // The mean over visible normals, which a mirror's reflectance and the shadowing of what it mirrors weigh:
    // steps over the disc in which they are drawn, fine at its edge, where the far normals are that the long
    // tail of GGX has.
    constexpr int rings = 64, sectors = 12;
    const auto rough = static_cast<float>(alpha);
    for (int row = 0; row < rows; ++row) {
        const float root = static_cast<float>(row) / static_cast<float>(rows - 1);
        const float cosine = std::max(root * root, 1e-5f);
        const glm::vec3 eye(std::sqrt(std::max(0.0f, 1.0f - cosine * cosine)), 0.0f, cosine);
        double sum = 0.0;
        for (int ring = 0; ring < rings; ++ring) {
            const double edge = (ring + 0.5) / rings; // the square of the radius is 1 - edge^3
            const double share = 3.0 * edge * edge / (rings * 4.0 * sectors);
            const auto radius = static_cast<float>(std::sqrt(1.0 - edge * edge * edge));
            for (int sector = 0; sector < 4 * sectors; ++sector) {
                // In each quarter of the square that disc_place makes a disc of.
                const float along = (static_cast<float>(sector % sectors) + 0.5f) / (0.5f * sectors) - 1.0f;
                const float sign = sector / sectors < 2 ? 1.0f : -1.0f;
                glm::vec2 place(sign * radius, sign * radius * along);
                if (sector / sectors % 2 == 1)
                    place = {place.y, place.x};
                const glm::vec3 micro = ggx_visible_normal(eye, rough, 0.5f * (place + 1.0f));
                const float towards = std::clamp(glm::dot(eye, micro), 0.0f, 1.0f);
                const glm::vec3 out = 2.0f * towards * micro - eye;
                if (out.z > 0.0f)
                    sum += share * reflectance(static_cast<double>(towards)) *
                           static_cast<double>(ggx_visible_share(out, rough));
            }
        }
        share_[static_cast<std::size_t>(row)] = static_cast<float>(std::clamp(sum, 0.0, 1.0));
    }
    // 2 times the integral of E cos over the cosine, which is s^2: 4 times that of E s^3 over s, exact for
    // what at() gives, so that nothing is lost between the two.
    double mean = 0.0;
    for (int row = 0; row + 1 < rows; ++row) {
        const double from = static_cast<double>(row) / (rows - 1),
                     to = static_cast<double>(row + 1) / (rows - 1);
        const double at_from = static_cast<double>(share_[static_cast<std::size_t>(row)]);
        const double slope =
            (static_cast<double>(share_[static_cast<std::size_t>(row + 1)]) - at_from) / (to - from);
        mean += (at_from - slope * from) * (std::pow(to, 4) - std::pow(from, 4)) +
                0.8 * slope * (std::pow(to, 5) - std::pow(from, 5));
    }
    mean_ = static_cast<float>(mean);
}

float LobeAlbedo::at(float cosine) const {
    const auto [row, share] = row_place(cosine, rows);
    const float* from = &share_[static_cast<std::size_t>(row)];
    return from[0] + share * (from[1] - from[0]);
}

/// How often each part is chosen.
struct LayeredSurface::Chances {
    float coat = 0.0f, mirrors = 0.0f, even = 0.0f; ///< 1 together
};

LayeredSurface::Chances LayeredSurface::chances(float cosine) const {
    const float by_coat = coat ? coat->albedo.at(cosine) : 0.0f;
    const float by_mirrors = (1.0f - by_coat) * mirrors.albedo.at(cosine);
    float evenly = 0.0f;
    for (const Even& even : evens)
        evenly += even.colour.largest() * (1.0f - even.taken.at(cosine));
    evenly *= 1.0f - by_coat;
    // Never so seldom that one path of what is even outshines all others: a lamp that the mirrors do not show
    // is found by it alone.
    constexpr float least = 0.05f;
    const float glossy = by_coat + by_mirrors;
    if (glossy <= 0.0f)
        return {0.0f, 0.0f, 1.0f};
    const float even = evens.empty() ? 0.0f : std::max(least, evenly / (glossy + evenly));
    const float share = (1.0f - even) / glossy;
    return {share * by_coat, share * by_mirrors, even};
}

glm::vec3 LayeredSurface::scatter(const SurfaceEvent& event, SampleSequence& sequence, Bins& carried) const {
    const NormalFrame frame(event.normal);
    const glm::vec3 to_eye = frame.to_local(event.to_eye);
    const Chances chance = chances(to_eye.z);
    const float choice = sequence.next();
    const glm::vec2 place = sequence.next_two();
    glm::vec3 onward;
    if (choice < chance.even) {
        onward = frame.to_world(cosine_direction(place));
    } else {
        const float alpha = choice < chance.even + chance.coat ? coat->alpha : mirrors.alpha;
        const glm::vec3 micro = frame.to_world(ggx_visible_normal(to_eye, alpha, place));
        onward = glm::normalize(2.0f * glm::dot(event.to_eye, micro) * micro - event.to_eye);
    }
    if (frame.to_local(onward).z <= 0.0f)
        return glm::vec3(0.0f); // met another of the small mirrors: what those send on is in what is even
    take(event, onward, carried);
    return onward;
}

float LayeredSurface::density(const SurfaceEvent& event, glm::vec3 onward) const {
    const NormalFrame frame(event.normal);
    const glm::vec3 to_eye = frame.to_local(event.to_eye), out = frame.to_local(onward);
    if (to_eye.z <= 0.0f || out.z <= 0.0f)
        return 0.0f;
    const Chances chance = chances(to_eye.z);
    float density = chance.even * out.z / pi_of_lobe;
    density += chance.mirrors * ggx_mirror_density(to_eye, out, mirrors.alpha);
    if (coat)
        density += chance.coat * ggx_mirror_density(to_eye, out, coat->alpha);
    return density;
}

Bins LayeredSurface::value(const SurfaceEvent& event, glm::vec3 onward) const {
    Bins value{};
    const NormalFrame frame(event.normal);
    const glm::vec3 to_eye = frame.to_local(event.to_eye), out = frame.to_local(onward);
    if (to_eye.z <= 0.0f || out.z <= 0.0f)
        return value;
    const float towards = std::min(1.0f, glm::dot(to_eye, glm::normalize(to_eye + out)));
    const auto add_mirrors = [&](const Mirrors& of, float share) {
        Bins mirrored = Bins::filled(share * ggx_mirror_density(to_eye, out, of.alpha) *
                                     ggx_visible_share(out, of.alpha) / out.z);
        of.reflectance.multiply_into(mirrored, towards);
        add(value, mirrored);
    };
    float below_coat = 1.0f;
    if (coat) {
        below_coat = (1.0f - coat->albedo.at(to_eye.z)) * (1.0f - coat->albedo.at(out.z));
        add_mirrors(*coat, 1.0f);
    }
    add_mirrors(mirrors, below_coat);
    for (const Even& even : evens) {
        Bins given = even.colour;
        scale(given, below_coat * (1.0f - even.taken.at(to_eye.z)) * (1.0f - even.taken.at(out.z)) /
                         (pi_of_lobe * std::max(least_left, 1.0f - even.taken.mean())));
        add(value, given);
    }
    return value;
}

void LayeredSurface::take(const SurfaceEvent& event, glm::vec3 onward, Bins& carried) const {
    const float cosine = glm::dot(event.normal, onward);
    const float per_steradian = density(event, onward);
    if (per_steradian <= 0.0f || cosine <= 0.0f) {
        carried = Bins{};
        return;
    }
    multiply(carried, value(event, onward));
    scale(carried, cosine / per_steradian);
}

} // namespace overt
