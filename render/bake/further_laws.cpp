#include "render/bake/further_laws.h"

#include <cmath>

#include <fmt/format.h>

#include "render/bake/glass.h"
#include "render/bake/microfacets.h"
#include "render/bake/thin_film.h"

namespace overt {

namespace {

glm::vec3 eye_at(double cosine) {
    return glm::vec3(glm::dvec3(std::sqrt(1.0 - cosine * cosine), 0.0, cosine));
}

constexpr glm::vec3 upright(0.0f, 0.0f, 1.0f);
constexpr std::uint32_t law_paths = 32768;

/// Films of an index and a thickness over bodies without loss, and over gold: an independent evaluation.
void add_films(std::vector<SurfaceLaw>& laws) {
    struct Known {
        double film, nm, body, cosine, reflectances[3];
    };
    constexpr double wavelengths[] = {450.0, 550.0, 650.0};
    for (const Known& known : {Known{1.33, 400, 1.0, 1.0, {.064806, .003471, .064569}},
                               Known{1.33, 400, 1.0, 0.5, {.089956, .190982, .112349}},
                               Known{1.5, 300, 1.33, 1.0, {.020059, .058416, .060497}},
                               Known{1.5, 300, 1.33, 0.5, {.114239, .109722, .070864}},
                               Known{1.3, 400, 1.5, 1.0, {.015240, .036018, .007148}},
                               Known{1.3, 400, 1.5, 0.5, {.055241, .032341, .070966}}})
        for (std::size_t i = 0; i < 3; ++i)
            laws.push_back({fmt::format("film of {} nm, index {} on {}: reflectance at {} nm, cosine {}",
                                        known.nm, known.film, known.body, wavelengths[i], known.cosine),
                            film_reflectance(wavelengths[i], known.film, known.nm, known.body, known.cosine),
                            known.reflectances[i], 2e-6});
    const ComplexIndex& gold = metal_index("Au");
    struct OfGold {
        double wavelength, cosine, reflectance;
    };
    for (const auto& [wavelength, cosine, reflectance] :
         {OfGold{450, 1.0, .143766}, OfGold{550, 1.0, .898245}, OfGold{650, 1.0, .903101},
          OfGold{450, 0.5, .426423}, OfGold{550, 0.5, .864543}, OfGold{650, 0.5, .837115}}) {
        const auto bin = static_cast<std::size_t>((wavelength - first_bin_centre_nm) / bin_width_nm);
        laws.push_back({fmt::format("film of 200 nm, index 2.4 on gold: reflectance at {} nm, cosine {}",
                                    wavelength, cosine),
                        film_reflectance(wavelength, 2.4, 200, {gold.n[bin], gold.k[bin]}, cosine),
                        reflectance, 2e-5});
    }
}

/// Share of light from everywhere that brushed mirrors without loss give back at once, seen along x.
double furnace_of(GgxWidths alpha, double cosine) {
    const glm::vec3 eye = eye_at(cosine);
    double sum = 0.0;
    for (std::uint32_t path = 0; path < law_paths; ++path) {
        SampleSequence sequence(9, {1, 1}, path);
        const glm::vec3 micro = ggx_visible_normal(eye, alpha, sequence.next_two());
        const glm::vec3 out = 2.0f * glm::dot(eye, micro) * micro - eye;
        sum += static_cast<double>(ggx_visible_share(out, alpha)) / law_paths;
    }
    return sum;
}

void add_brushed(std::vector<SurfaceLaw>& laws) {
    const GgxWidths alpha{0.1f, 0.5f};
    const glm::vec3 eye = glm::normalize(glm::vec3(0.3f, 0.1f, 0.8f)),
                    out = glm::normalize(glm::vec3(-0.4f, 0.2f, 0.7f)), half = glm::normalize(eye + out);
    const double of_normals = static_cast<double>(ggx_density(half, alpha));
    laws.push_back({"brushed, alpha 0.1 and 0.5: density of normals of a pair of directions", of_normals,
                    2.345731, 1e-4});
    laws.push_back(
        {"brushed: density of that pair",
         static_cast<double>(ggx_visible_share(eye, alpha)) * of_normals / (4.0 * static_cast<double>(eye.z)),
         0.629750, 1e-4});
    constexpr double cosines[] = {1.0, 0.8, 0.5, 0.2}, along[] = {.8822, .8814, .8779, .8512},
                     across[] = {.8822, .8596, .8329, .8490};
    for (std::size_t i = 0; i < 4; ++i) {
        laws.push_back(
            {fmt::format("brushed, alpha 0.05 along the sight and 0.4 across: single scattering, cosine {}",
                         cosines[i]),
             furnace_of({0.05f, 0.4f}, cosines[i]), along[i], 2e-3});
        laws.push_back(
            {fmt::format("brushed, alpha 0.4 along the sight and 0.05 across: single scattering, cosine {}",
                         cosines[i]),
             furnace_of({0.4f, 0.05f}, cosines[i]), across[i], 2e-3});
    }
}

void add_glass(std::vector<SurfaceLaw>& laws) {
    MaterialSettings material;
    material.kind = MaterialKind::glass;
    material.ior = 1.5168;
    material.abbe = 64.166;
    const Glass bk7(material);
    struct Index {
        int band;
        double known;
    };
    for (const auto& [band, known] : {Index{0, 1.530849}, Index{15, 1.518522}, Index{30, 1.513064}})
        laws.push_back({fmt::format("glass as N-BK7: index at {} nm, against Sellmeier's formula",
                                    first_bin_centre_nm + bin_width_nm * band),
                        static_cast<double>(bk7.index(band)), known, 2e-4});
    // Of an evaluation whose shadowing of the way in and out is not independent: near grazing it has more.
    struct Shares {
        double alpha, cosine, mirrored, passed;
    };
    for (const auto& [alpha, cosine, mirrored, passed] :
         {Shares{0.1, 1.0, .0397, .9592}, Shares{0.1, 0.5, .0854, .9068}, Shares{0.3, 1.0, .0352, .9530},
          Shares{0.3, 0.5, .0604, .8878}, Shares{0.6, 1.0, .0242, .9315}}) {
        material.ior = 1.5;
        material.abbe = {};
        material.roughness = alpha;
        const Glass glass(material);
        double back = 0.0, through = 0.0;
        for (std::uint32_t path = 0; path < law_paths; ++path) {
            SampleSequence sequence(3, {1, 2}, path);
            const GlassMeeting met = glass.meet(eye_at(cosine), upright, upright, true, -1, sequence);
            back += static_cast<double>(met.mirrored.value[0] * met.mirrored_share) / law_paths;
            through += static_cast<double>(met.passed.value[0] * met.passed_share) / law_paths;
        }
        laws.push_back(
            {fmt::format("rough glass, alpha {}: mirrored, cosine {}", alpha, cosine), back, mirrored, 2e-3});
        laws.push_back({fmt::format("rough glass, alpha {}: let through, cosine {}", alpha, cosine), through,
                        passed, 4e-3});
    }
}

} // namespace

std::vector<SurfaceLaw> further_laws() {
    std::vector<SurfaceLaw> laws;
    add_films(laws);
    add_brushed(laws);
    add_glass(laws);
    return laws;
}

} // namespace overt
