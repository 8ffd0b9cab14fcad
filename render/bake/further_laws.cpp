#include "render/bake/further_laws.h"

#include <cmath>

#include <fmt/format.h>

#include "render/bake/conductor.h"
#include "render/bake/glass.h"
#include "render/bake/medium.h"
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

/// What three formulas for one meeting let through from outside near grazing, at an index of 1.5, alpha 0.6
/// and a cosine of 0.05: they disagree, and the walk over the surface (add_glass) is the judge.
void add_shadowings(std::vector<SurfaceLaw>& laws) {
    constexpr float alpha = 0.6f, ior = 1.5f;
    const glm::vec3 eye = eye_at(0.05);
    const auto lambda = [&](glm::vec3 direction) {
        return 1.0 / static_cast<double>(ggx_visible_share(direction, alpha)) - 1.0;
    };
    const double in = lambda(eye);
    double product = 0.0, correlated = 0.0, walked = 0.0;
    for (std::uint32_t path = 0; path < law_paths; ++path) {
        SampleSequence sequence(11, {1, 2}, path);
        const glm::vec3 micro = ggx_visible_normal(eye, alpha, sequence.next_two());
        const glm::vec3 through = glm::refract(-eye, micro, 1.0f / ior);
        if (!(through.z < 0.0f))
            continue;
        const double passed =
            (1.0 - static_cast<double>(dielectric_fresnel(ior, glm::dot(eye, micro)))) / law_paths;
        const double out = lambda(-through);
        product += passed / (1.0 + out);
        correlated += passed * (1.0 + in) / (1.0 + in + out);
        walked += passed * (1.0 + in) *
                  std::exp(std::lgamma(1.0 + in) + std::lgamma(1.0 + out) - std::lgamma(2.0 + in + out));
    }
    const std::string what = "rough glass, alpha 0.6, cosine 0.05, let through by one facet, ";
    laws.push_back({what + "Smith's shares multiplied", product, .5098, 2e-3});
    laws.push_back({what + "shares of one side correlated (as PBRT 4)", correlated, .7642, 2e-3});
    laws.push_back({what + "shares of both sides (beta function), as the walk has it", walked, .2568, 2e-3});
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
    material.abbe = {};
    // Shares that leave after one facet and after all, each way, of a walk in double precision from facet to
    // facet of a surface of Smith's; what is mirrored once is also as PBRT 4 has it. What is let through once
    // has Euler's beta function for its shadowing: seen near grazing that is a third of what 1 / (1 + A + B)
    // gives (PBRT 4: 0.764), and half of Smith's shares multiplied (0.510), which are for light that stays on
    // one side. Facets beyond the first give back what is missing: with them nothing is lost.
    struct Shares {
        double ior, alpha, cosine, mirrored_once, passed_once, mirrored;
    };
    for (const auto& [ior, alpha, cosine, mirrored_once, passed_once, mirrored] :
         {Shares{1.5, 0.1, 1.0, .0397, .9592, .0398}, Shares{1.5, 0.1, 0.5, .0860, .9062, .0878},
          Shares{1.5, 0.1, 0.05, .3544, .5717, .3768}, Shares{1.5, 0.3, 1.0, .0356, .9528, .0368},
          Shares{1.5, 0.3, 0.5, .0608, .8856, .0652}, Shares{1.5, 0.3, 0.05, .1698, .5928, .1763},
          Shares{1.5, 0.6, 1.0, .0243, .9313, .0268}, Shares{1.5, 0.6, 0.5, .0383, .7933, .0427},
          Shares{1.5, 0.6, 0.05, .0997, .2568, .1086}, Shares{1.0 / 1.5, 0.3, 1.0, .0488, .8503, .1308},
          Shares{1.0 / 1.5, 0.6, 1.0, .0424, .6333, .2837},
          Shares{1.0 / 1.5, 0.6, 0.05, .6428, .0001, .9840}}) {
        const bool enters = ior > 1.0;
        material.ior = enters ? ior : 1.0 / ior;
        material.roughness = alpha;
        const Glass glass(material);
        double once[2]{}, all[2]{};
        for (std::uint32_t path = 0; path < law_paths; ++path)
            for (const GlassTurn turn : {GlassTurn::mirrored, GlassTurn::let_through}) {
                SampleSequence sequence(3, {1, 2}, path);
                const GlassWay way = glass.meet(eye_at(cosine), upright, upright, enters, -1, turn, sequence);
                const double share = static_cast<double>(way.carried.value[0]) / law_paths;
                all[way.goes_through ? 1 : 0] += share;
                if (way.facets == 1)
                    once[way.goes_through ? 1 : 0] += share;
            }
        const std::string what = fmt::format("rough glass from {}, alpha {}, cosine {}",
                                             enters ? "outside" : "inside", alpha, cosine);
        laws.push_back({what + ": mirrored by one facet", once[0], mirrored_once, 2e-3});
        laws.push_back({what + ": let through by one facet", once[1], passed_once, 3e-3});
        laws.push_back({what + ": mirrored by all", all[0], mirrored, 4e-3});
        laws.push_back({what + ": all light", all[0] + all[1], 1.0, 1e-4});
    }
}

/// Share of light from everywhere that a half space of a medium without a border sends to an eye at a cosine,
/// of a band: by walks as the path tracer has them.
double half_space_by_walks(const Medium& medium, double cosine, std::size_t bin) {
    double back = 0.0;
    for (std::uint32_t walk = 0; walk < law_paths; ++walk) {
        SampleSequence sequence(13, {1, 2}, walk);
        MediumPath path;
        medium.enter(path, sequence.next(), walk);
        Bins carried = Bins::filled(1.0f);
        glm::vec3 along = -eye_at(cosine);
        float height = 0.0f, number = sequence.next();
        glm::vec2 turn = sequence.next_two();
        while (carried.value[bin] > 1e-4f) {
            const float flight = medium.free_path(path.band, number);
            if (height + flight * along.z > 0.0f) {
                const float left = -height / along.z;
                medium.fly(left, path);
                medium.settle(path, carried);
                absorb(carried, medium.absorption(), left);
                back += static_cast<double>(carried.value[bin]) / law_paths;
                break;
            }
            height += flight * along.z;
            medium.scatter_after(flight, path);
            medium.settle(path, carried);
            along = medium.onward(along, turn);
            number = path.numbers.next();
            turn = glm::vec2{path.numbers.next(), path.numbers.next()};
        }
    }
    return back;
}

/// Plane albedos of isotropic scattering by Chandrasekhar's H function (1950, "Radiative Transfer").
void add_media(std::vector<SurfaceLaw>& laws) {
    struct Known {
        double albedo, cosine, share;
    };
    for (const auto& [albedo, cosine, share] :
         {Known{0.5, 1.0, .11523}, Known{0.5, 0.2, .21266}, Known{0.9, 1.0, .41495}, Known{0.9, 0.5, .50794},
          Known{0.9, 0.05, .65225}, Known{0.99, 1.0, .75272}}) {
        MaterialSettings material;
        material.kind = MaterialKind::translucent;
        material.scattering_per_mm.fill(3.0 * albedo);
        material.absorption_per_mm.fill(3.0 * (1.0 - albedo));
        laws.push_back(
            {fmt::format("translucent half space, albedo {}, cosine {}: given back", albedo, cosine),
             half_space_by_walks(Medium(material), cosine, 0), share, 6e-3});
        // A band of its own among others that scatter twice as much and half as much.
        material.scattering_per_mm = {6.0 * albedo, 3.0 * albedo, 1.5 * albedo};
        laws.push_back(
            {fmt::format("the same as the green of a coloured medium, albedo {}, cosine {}", albedo, cosine),
             half_space_by_walks(Medium(material), cosine, 14), share, 2e-2});
    }
    for (const double g : {-0.5, 0.5, 0.9}) {
        MaterialSettings material;
        material.kind = MaterialKind::translucent;
        material.scattering_anisotropy = g;
        const Medium medium(material);
        double mean = 0.0;
        for (std::uint32_t path = 0; path < law_paths; ++path) {
            SampleSequence sequence(14, {1, 2}, path);
            mean += static_cast<double>(medium.onward(upright, sequence.next_two()).z) / law_paths;
        }
        laws.push_back({fmt::format("mean cosine of scattering with an anisotropy of {}", g), mean, g, 2e-3});
    }
}

} // namespace

std::vector<SurfaceLaw> further_laws() {
    std::vector<SurfaceLaw> laws;
    add_films(laws);
    add_brushed(laws);
    add_glass(laws);
    add_shadowings(laws);
    add_media(laws);
    return laws;
}

} // namespace overt
