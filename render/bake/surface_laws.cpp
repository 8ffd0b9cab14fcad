#include "render/bake/surface_laws.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "experiment/base/random.h"
#include "render/bake/microfacets.h"

namespace overt {

namespace {

glm::vec3 at_cosine(double cosine, double azimuth = 0.0) {
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    return {static_cast<float>(sine * std::cos(azimuth)), static_cast<float>(sine * std::sin(azimuth)),
            static_cast<float>(cosine)};
}

SurfaceEvent seen_at(glm::vec3 to_eye) { return {to_eye, {0.0f, 0.0f, 1.0f}}; }

double first_bin(const Bins& bins) { return static_cast<double>(bins.value[0]); }

/// Cells that are even in s with cosine = 1 - s^2, so that half of them are within 40 degrees of the normal.
struct Cells {
    int rings, sectors;
    double ring_area(int ring) const { // over the sectors
        return (2.0 * ring + 1.0) / (static_cast<double>(rings) * rings) * 2.0 * std::numbers::pi / sectors;
    }
    /// Sum over the middles of `fine` x `fine` places in each cell of `value` times their solid angle.
    template <class Value> double sum(int ring, int sector, int fine, const Value& value) const {
        double sum = 0.0;
        const Cells parts{rings * fine, sectors * fine};
        for (int i = 0; i < fine; ++i) {
            const int r = ring * fine + i;
            const double s = (r + 0.5) / parts.rings;
            for (int j = 0; j < fine; ++j)
                sum += parts.ring_area(r) *
                       value(at_cosine(1.0 - s * s,
                                       2.0 * std::numbers::pi * (sector * fine + j + 0.5) / parts.sectors));
        }
        return sum;
    }
    int ring_of(double cosine) const {
        return std::min(rings - 1, static_cast<int>(std::sqrt(std::max(0.0, 1.0 - cosine)) * rings));
    }
};

/// Of what an eye at azimuth 0 is sent: fine opposite to it, where lobes are narrow at grazing angles.
template <class Value> double over_upper_hemisphere(const Value& value) {
    constexpr int rings = 600, sectors = 160;
    double sum = 0.0;
    for (int ring = 0; ring < rings; ++ring) {
        const double s = (ring + 0.5) / rings, ring_area = 2.0 * s / rings;
        for (int sector = 0; sector < sectors; ++sector) {
            const double q = 2.0 * (sector + 0.5) / sectors - 1.0;
            const double azimuth = std::numbers::pi * (1.0 + q * q * q);
            sum +=
                ring_area * 6.0 * std::numbers::pi * q * q / sectors * value(at_cosine(1.0 - s * s, azimuth));
        }
    }
    return sum;
}

template <class Take>
void for_each_path(const LayeredSurface& surface, double cosine, int paths, const Take& take) {
    const SurfaceEvent event = seen_at(at_cosine(cosine));
    for (int i = 0; i < paths; ++i) {
        SampleSequence sequence(1, {3, 5}, static_cast<std::uint32_t>(i));
        Bins carried = Bins::filled(1.0f);
        take(surface.scatter(event, sequence, carried), carried);
    }
}

MaterialSettings rough(MaterialKind kind, double roughness) {
    MaterialSettings material;
    material.kind = kind;
    material.roughness = roughness;
    return material;
}

} // namespace

LayeredSurface grey_surface(const MaterialSettings& material, double reflectance) {
    const Bins grey = Bins::filled(static_cast<float>(reflectance));
    switch (material.kind) {
    case MaterialKind::rough_conductor:
        return rough_metal_surface(material, ConductorTable([&](double) { return grey; }));
    case MaterialKind::metallic_roughness:
        return metallic_roughness_surface(material, grey);
    default:
        return plastic_surface(material, grey);
    }
}

double albedo_by_steps(const LayeredSurface& surface, double cosine) {
    const SurfaceEvent event = seen_at(at_cosine(cosine));
    return over_upper_hemisphere([&](glm::vec3 onward) {
        return first_bin(surface.value(event, onward)) * static_cast<double>(onward.z);
    });
}

double albedo_by_paths(const LayeredSurface& surface, double cosine, int paths) {
    double sum = 0.0;
    for_each_path(surface, cosine, paths, [&](glm::vec3 onward, const Bins& carried) {
        sum += onward == glm::vec3(0.0f) ? 0.0 : first_bin(carried);
    });
    return sum / paths;
}

double largest_asymmetry(const LayeredSurface& surface) {
    RandomStream random(1, "pairs of directions");
    double largest = 0.0;
    for (int pair = 0; pair < 1000; ++pair) {
        const glm::vec3 one = at_cosine(random.uniform(0.01, 1.0), random.uniform(0.0, 6.28)),
                        other = at_cosine(random.uniform(0.01, 1.0), random.uniform(0.0, 6.28));
        const double there = first_bin(surface.value(seen_at(one), other)),
                     back = first_bin(surface.value(seen_at(other), one));
        largest = std::max(largest, std::abs(there - back) / std::max({there, back, 1e-12}));
    }
    return largest;
}

double density_error(const LayeredSurface& surface, double cosine) {
    const SurfaceEvent event = seen_at(at_cosine(cosine));
    constexpr int paths = 16384;
    int below = 0;
    for_each_path(surface, cosine, paths,
                  [&](glm::vec3 onward, const Bins&) { below += onward == glm::vec3(0.0f) ? 1 : 0; });
    const double above = over_upper_hemisphere(
        [&](glm::vec3 onward) { return static_cast<double>(surface.density(event, onward)); });
    return std::abs(above + static_cast<double>(below) / paths - 1.0);
}

double density_misfit(const LayeredSurface& surface, double cosine, int paths) {
    constexpr Cells cells{16, 24};
    const SurfaceEvent event = seen_at(at_cosine(cosine));
    std::vector<double> counts(static_cast<std::size_t>(cells.rings * cells.sectors));
    RandomStream random(2, "numbers of paths");
    for (int i = 0; i < paths; ++i) {
        // Numbers of chance: those of a picture are spread more evenly, which chi square knows nothing of.
        SampleSequence sequence(random.next_bits(), {i % 4096, i / 4096}, 0);
        Bins carried = Bins::filled(1.0f);
        const glm::vec3 onward = surface.scatter(event, sequence, carried);
        if (onward == glm::vec3(0.0f))
            continue;
        const double turn = std::atan2(static_cast<double>(onward.y), static_cast<double>(onward.x)) /
                            (2.0 * std::numbers::pi);
        const int sector =
            std::min(cells.sectors - 1, static_cast<int>((turn - std::floor(turn)) * cells.sectors));
        counts[static_cast<std::size_t>(cells.ring_of(static_cast<double>(onward.z)) * cells.sectors +
                                        sector)] += 1.0;
    }
    double chi_square = 0.0;
    int cells_used = 0;
    for (int ring = 0; ring < cells.rings; ++ring)
        for (int sector = 0; sector < cells.sectors; ++sector) {
            const double expected = paths * cells.sum(ring, sector, 24, [&](glm::vec3 onward) {
                return static_cast<double>(surface.density(event, onward));
            });
            if (expected < 5.0)
                continue;
            const double miss = counts[static_cast<std::size_t>(ring * cells.sectors + sector)] - expected;
            chi_square += miss * miss / expected;
            ++cells_used;
        }
    return chi_square / cells_used;
}

std::vector<SurfaceLaw> surface_laws() {
    std::vector<SurfaceLaw> laws;
    constexpr double cosines[] = {1.0, 0.8, 0.5, 0.2, 0.05};

    // Fresnel, by an evaluation of the formulas in double precision.
    for (const auto& [cosine, known] :
         {std::pair{1.0, 0.04}, {0.8, 0.043895}, {0.5, 0.089187}, {0.2, 0.338894}, {0.05, 0.752131}})
        laws.push_back({fmt::format("Fresnel, index 1.5, cosine {}", cosine),
                        static_cast<double>(dielectric_fresnel(1.5f, static_cast<float>(cosine))), known,
                        1e-6});
    struct Mean {
        double ior, inner, outer;
    };
    for (const auto& [ior, inner, outer] :
         {Mean{1.33, 0.471949, 0.065931}, Mean{1.5, 0.596346, 0.091778}, Mean{1.6, 0.650877, 0.106246}}) {
        laws.push_back(
            {fmt::format("reflectance from within, index {}", ior), inner_reflectance(ior), inner, 2e-6});
        laws.push_back(
            {fmt::format("reflectance from outside, index {}", ior), outer_reflectance(ior), outer, 2e-6});
    }

    // Albedo of lobes alone (separable Smith, as Cycles 3.4 has it).
    struct Lobe {
        double alpha, ior; ///< 0: mirrors without loss
        std::array<double, 5> known;
        double mean;
    };
    for (const Lobe& lobe : {Lobe{0.05, 0.0, {0.9973, 0.9965, 0.9927, 0.9624, 0.8794}, 0.9912},
                             Lobe{0.13, 0.0, {0.9794, 0.9729, 0.9488, 0.8786, 0.8886}, 0.9564},
                             Lobe{0.3, 0.0, {0.8774, 0.8560, 0.8181, 0.8159, 0.8619}, 0.8428},
                             Lobe{0.6, 0.0, {0.5915, 0.5966, 0.6247, 0.6939, 0.7515}, 0.6156},
                             Lobe{1.0, 0.0, {0.3069, 0.3409, 0.4091, 0.5114, 0.5845}, 0.3766},
                             Lobe{0.05, 1.5, {0.0399, 0.0442, 0.0890, 0.2997, 0.4750}, 0.08577},
                             Lobe{0.1, 1.5, {0.0396, 0.0443, 0.0859, 0.2356, 0.3382}, 0.07778},
                             Lobe{0.3, 1.5, {0.0356, 0.0395, 0.0606, 0.1114, 0.1476}, 0.05355}}) {
        const LobeAlbedo albedo(lobe.alpha, [&](double cosine) {
            return lobe.ior == 0.0 ? 1.0
                                   : static_cast<double>(dielectric_fresnel(static_cast<float>(lobe.ior),
                                                                            static_cast<float>(cosine)));
        });
        const std::string of = fmt::format("lobe of alpha {}, {}", lobe.alpha,
                                           lobe.ior == 0.0 ? "no loss" : fmt::format("index {}", lobe.ior));
        for (std::size_t i = 0; i < std::size(cosines); ++i)
            laws.push_back({fmt::format("{}, cosine {}", of, cosines[i]),
                            static_cast<double>(albedo.at(static_cast<float>(cosines[i]))), lobe.known[i],
                            6e-4});
        laws.push_back({of + ", mean", static_cast<double>(albedo.mean()), lobe.mean, 3e-4});
    }

    // A plastic of reflectance 0.5 at a pair of directions.
    const glm::vec3 view = glm::normalize(glm::vec3(0.3f, 0.1f, 0.8f)),
                    light = glm::normalize(glm::vec3(-0.4f, 0.2f, 0.7f));
    struct Pair {
        double alpha, matt, gloss;
    };
    for (const auto& [alpha, matt, gloss] :
         {Pair{0.05, 0.159975, 0.004769}, Pair{0.1, 0.158602, 0.014308}, Pair{0.3, 0.155857, 0.021670}}) {
        const MaterialSettings material = rough(MaterialKind::plastic, alpha);
        const double black = first_bin(grey_surface(material, 0.0).value(seen_at(view), light));
        laws.push_back(
            {fmt::format("plastic, alpha {}: gloss of a pair of directions", alpha), black, gloss, 3e-6});
        laws.push_back({fmt::format("plastic, alpha {}: body of that pair", alpha),
                        first_bin(grey_surface(material, 0.5).value(seen_at(view), light)) - black, matt,
                        1e-4});
    }
    // Its albedo, in both readings of its reflectance.
    struct Reading {
        PlasticBody body;
        std::array<double, 5> known;
    };
    for (const Reading& reading : {Reading{PlasticBody::light, {0.5198, 0.5221, 0.5429, 0.6178, 0.6691}},
                                   Reading{PlasticBody::pigment, {0.3158, 0.3191, 0.3487, 0.4554, 0.5285}}}) {
        MaterialSettings material = rough(MaterialKind::plastic, 0.1);
        material.body = reading.body;
        const LayeredSurface surface = grey_surface(material, 0.5);
        for (std::size_t i = 0; i < std::size(cosines); ++i)
            laws.push_back({fmt::format("plastic of {}, alpha 0.1: albedo, cosine {}", name_of(reading.body),
                                        cosines[i]),
                            albedo_by_steps(surface, cosines[i]), reading.known[i], 1e-3});
    }
    // Metal with all light between its mirrors, of Schlick's curve.
    struct Metal {
        double alpha, colour, known;
    };
    for (const auto& [alpha, colour, known] : {Metal{0.3, 0.9, 0.8845}, Metal{0.3, 0.5, 0.4643},
                                               Metal{0.6, 0.9, 0.8529}, Metal{0.6, 0.5, 0.3953}}) {
        MaterialSettings material = rough(MaterialKind::metallic_roughness, std::sqrt(alpha));
        material.metallic = 1.0;
        laws.push_back({fmt::format("metal of colour {}, alpha {}: albedo, cosine 0.5", colour, alpha),
                        albedo_by_steps(grey_surface(material, colour), 0.5), known, 1e-3});
    }

    // A coat of index 1.5 above what gives nothing back is the gloss of a black plastic, whatever is below.
    for (const MaterialKind kind :
         {MaterialKind::plastic, MaterialKind::rough_conductor, MaterialKind::metallic_roughness}) {
        MaterialSettings coated = rough(kind, 0.3);
        coated.ior = 1.0;
        coated.clear_coat = 1.0;
        coated.clear_coat_roughness = std::sqrt(0.3);
        laws.push_back({fmt::format("coat of alpha 0.3 over black {}: gloss of that pair", name_of(kind)),
                        first_bin(grey_surface(coated, 0.0).value(seen_at(view), light)), 0.021670, 3e-6});
    }

    // White surfaces give back all light, whichever way it is reckoned; all are the same there and back; and
    // directions come as often as density() says.
    struct Law {
        std::string name;
        MaterialSettings material;
    };
    std::vector<Law> all;
    for (const double alpha : {0.1, 0.3, 0.8}) {
        all.push_back({fmt::format("plastic, alpha {}", alpha), rough(MaterialKind::plastic, alpha)});
        all.push_back(
            {fmt::format("rough metal, alpha {}", alpha), rough(MaterialKind::rough_conductor, alpha)});
        all.back().material.multiple_scattering = true;
    }
    for (const MaterialKind kind : {MaterialKind::plastic, MaterialKind::rough_conductor}) {
        MaterialSettings material = rough(kind, 0.3);
        material.multiple_scattering = true;
        material.clear_coat = 1.0;
        material.clear_coat_roughness = 0.2;
        all.push_back({fmt::format("{}, alpha 0.3, under a coat", name_of(kind)), material});
    }
    for (const double metallic : {0.0, 0.5, 1.0}) {
        MaterialSettings material = rough(MaterialKind::metallic_roughness, 0.6);
        material.metallic = metallic;
        all.push_back({fmt::format("metallic-roughness, metallic {}", metallic), material});
        material.clear_coat = 0.7;
        material.clear_coat_roughness = 0.35;
        all.push_back({fmt::format("the same under a coat of 0.7"), material});
    }
    for (const auto& [name, material] : all) {
        const LayeredSurface white = grey_surface(material, 1.0);
        const bool is_coated = material.clear_coat > 0.0;
        for (const double cosine : {1.0, 0.5, 0.2}) {
            const double by_steps = albedo_by_steps(white, cosine);
            laws.push_back({fmt::format("{}: white furnace, cosine {}", name, cosine), by_steps, 1.0, 1.5e-3,
                            is_coated});
            laws.push_back({fmt::format("{}: the same by paths, against steps", name),
                            albedo_by_paths(white, cosine, 16384) - by_steps, 0.0, 4e-3});
        }
        const LayeredSurface grey = grey_surface(material, 0.4);
        laws.push_back({name + ": reciprocity", largest_asymmetry(grey), 0.0, 2e-4});
        laws.push_back({name + ": density sums to 1, cosine 0.5", density_error(grey, 0.5), 0.0, 2e-3});
        laws.push_back(
            {name + ": chi square of directions, cosine 0.5", density_misfit(grey, 0.5, 40000), 1.0, 0.35});
    }
    return laws;
}

} // namespace overt
