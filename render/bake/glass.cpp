#include "render/bake/glass.h"

#include <algorithm>
#include <cmath>

#include "render/bake/conductor.h"
#include "render/bake/microfacets.h"

namespace overt {

namespace {

/// n_F - n_C by the Abbe number, and from it Cauchy's B, with the lines' wavelengths in nm.
double cauchy_b(double ior, double abbe) {
    constexpr double f = 486.13, c = 656.27;
    return (ior - 1.0) / abbe / (1.0 / (f * f) - 1.0 / (c * c));
}

} // namespace

Glass::Glass(const MaterialSettings& material)
    : ior_(static_cast<float>(material.ior)), disperses_(material.abbe.has_value()),
      alpha_(material.roughness ? static_cast<float>(material.alpha()) : 0.0f) {
    if (!disperses_)
        return;
    constexpr double d = 587.56;
    const double b = cauchy_b(material.ior, *material.abbe), a = material.ior - b / (d * d);
    for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
        const double wavelength = first_bin_centre_nm + bin_width_nm * static_cast<double>(bin);
        indices_[bin] = static_cast<float>(a + b / (wavelength * wavelength));
    }
}

/// What a path carries on its way through facets.
class Glass::Colours {
  public:
    /// Of a path of `band` that meets the surface from outside, if it `enters`.
    Colours(const Glass& glass, bool enters, int band, SampleSequence& sequence)
        : glass_(&glass), enters_(enters), band_(band) {
        // Colours part where a path goes in that has them all: each is followed as often.
        if (glass.disperses() && band < 0)
            band_ = std::min(static_cast<int>(sequence.next() * static_cast<float>(spectral_bins)),
                             spectral_bins - 1);
        parts_ = band_ != band;
        all_.value.fill(1.0f);
    }

    /// Index beyond a facet by that on its side.
    float relative(bool from_beyond) const { return relative_of(band_, from_beyond); }

    /// The path is mirrored by a facet that it meets at `cosine`, with the chance of the facet's reflectance
    /// or, if `is_given`, in any case.
    void mirror(float cosine, bool from_beyond, bool is_given) {
        const float reflected = dielectric_fresnel(relative(from_beyond), cosine);
        if (is_given)
            given_ *= reflected;
        if (!parts_ || has_parted_)
            return;
        // All colours went this way, each with a chance of its own; the way counts by the mean of these.
        float mean = 0.0f;
        for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
            const float of_bin = dielectric_fresnel(relative_of(static_cast<int>(bin), from_beyond), cosine);
            all_.value[bin] *= of_bin;
            chance_.value[bin] *= is_given ? 1.0f : of_bin;
            mean += chance_.value[bin] / static_cast<float>(spectral_bins);
        }
        mean_chance_ = mean;
    }
    void let_through(float cosine, bool from_beyond, bool is_given) {
        if (is_given)
            given_ *= 1.0f - dielectric_fresnel(relative(from_beyond), cosine);
        has_parted_ = parts_;
    }

    void write_to(GlassWay& way, int band_before) const {
        if (!parts_) {
            way.band = band_before;
            way.carried = Bins::filled(given_);
        } else if (has_parted_) {
            way.band = band_;
            way.carried = Bins{};
            way.carried.value[static_cast<std::size_t>(band_)] = static_cast<float>(spectral_bins) * given_;
        } else {
            way.band = -1;
            way.carried = all_;
            scale(way.carried, 1.0f / mean_chance_);
        }
    }

  private:
    float relative_of(int band, bool from_beyond) const {
        return enters_ != from_beyond ? glass_->index(band) : 1.0f / glass_->index(band);
    }

    const Glass* glass_;
    bool enters_;
    int band_;           ///< that the path is followed with
    bool parts_ = false; ///< it came with all and leaves with one if it is let through
    bool has_parted_ = false;
    float given_ = 1.0f; ///< left by what was not chance
    Bins all_, chance_ = Bins::filled(1.0f);
    float mean_chance_ = 1.0f;
};

namespace {

/// A mirrored path is turned about the facet; (0, 0, 0) of a path that is mirrored whole.
struct FacetWays {
    float cosine;
    glm::vec3 back, through;
    FacetWays(glm::vec3 to_eye, glm::vec3 micro, float relative)
        : cosine(std::clamp(glm::dot(micro, to_eye), 0.0f, 1.0f)),
          back(glm::normalize(2.0f * cosine * micro - to_eye)),
          through(glm::refract(-to_eye, micro, 1.0f / relative)) {
        if (through != glm::vec3(0.0f))
            through = glm::normalize(through);
    }
    bool is_mirror() const { return through == glm::vec3(0.0f); }
};

/// Of a path at a height below which there is `share` of a rough surface, that goes on in `direction` above
/// it: the share at the facet that it meets next, by a number from 0 to 1; 1 or more: it leaves (Heitz et
/// al. 2016, with heights spread evenly).
float next_share(float share, glm::vec3 direction, float alpha, float number) {
    const float tan_squared = (1.0f - direction.z * direction.z) / (direction.z * direction.z);
    const float slope = std::sqrt(1.0f + alpha * alpha * std::max(0.0f, tan_squared));
    const float lambda = 0.5f * (direction.z > 0.0f ? slope - 1.0f : -slope - 1.0f);
    if (lambda == 0.0f)
        return 1.0f;
    return share / std::pow(1.0f - number, 1.0f / lambda);
}

} // namespace

GlassWay Glass::meet(glm::vec3 to_eye, glm::vec3 normal, glm::vec3 surface_normal, bool enters, int band,
                     GlassTurn turn, SampleSequence& sequence) const {
    Colours colours(*this, enters, band, sequence);
    GlassWay way = alpha_ > 0.0f ? meet_rough(to_eye, normal, turn, colours, sequence)
                                 : meet_polished(to_eye, normal, surface_normal, turn, colours, sequence);
    colours.write_to(way, band);
    if (way.direction == glm::vec3(0.0f))
        way.carried = Bins{};
    return way;
}

GlassWay Glass::meet_polished(glm::vec3 to_eye, glm::vec3 normal, glm::vec3 surface_normal, GlassTurn turn,
                              Colours& colours, SampleSequence& sequence) const {
    constexpr float least_depth = 1e-5f;
    FacetWays ways(to_eye, normal, colours.relative(false));
    // The shading normal may send it back: then the triangle's own normal has the say.
    if (!ways.is_mirror() && glm::dot(ways.through, surface_normal) > -least_depth)
        ways = {to_eye, surface_normal, colours.relative(false)};
    GlassWay way;
    const bool is_given = turn != GlassTurn::by_chance;
    way.goes_through =
        !ways.is_mirror() &&
        (is_given ? turn == GlassTurn::let_through
                  : sequence.next() >= dielectric_fresnel(colours.relative(false), ways.cosine));
    if (way.goes_through)
        colours.let_through(ways.cosine, false, is_given);
    else if (turn != GlassTurn::let_through)
        colours.mirror(ways.cosine, false, is_given);
    else
        return way; // all is mirrored
    way.direction = way.goes_through ? ways.through : ways.back;
    return way;
}

GlassWay Glass::meet_rough(glm::vec3 to_eye, glm::vec3 normal, GlassTurn turn, Colours& colours,
                           SampleSequence& sequence) const {
    constexpr int most_facets = 128; // what is still among them is below 1e-4 of what came
    const NormalFrame frame(normal);
    glm::vec3 along = -frame.to_local(to_eye);
    float share = 1.0f; // of the surface below where the path is, seen from the side that it came from
    bool is_beyond = false;
    GlassWay way;
    for (way.facets = 1; way.facets <= most_facets; ++way.facets) {
        // Facets are seen from beyond as from above, upside down.
        const float up = is_beyond ? -1.0f : 1.0f;
        const bool is_first = way.facets == 1;
        float next = 0.0f;
        if (!is_first) {
            next = next_share(is_beyond ? 1.0f - share : share, up * along, alpha_, sequence.next());
            if (next >= 1.0f && up * along.z > 0.0f) {
                way.facets -= 1;
                way.goes_through = is_beyond;
                way.direction = frame.to_world(along);
                return way;
            }
        }
        const glm::vec3 micro = up * ggx_visible_normal(-up * along, alpha_, sequence.next_two());
        if (is_first)
            next = next_share(share, along, alpha_, sequence.next());
        next = std::clamp(next, 1e-6f, 1.0f - 1e-6f);
        share = is_beyond ? 1.0f - next : next;
        const FacetWays ways(-along, micro, colours.relative(is_beyond));
        const bool is_given = is_first && turn != GlassTurn::by_chance;
        bool passes = !ways.is_mirror();
        if (passes)
            passes = is_given
                         ? turn == GlassTurn::let_through
                         : sequence.next() >= dielectric_fresnel(colours.relative(is_beyond), ways.cosine);
        if (passes)
            colours.let_through(ways.cosine, is_beyond, is_given);
        else if (!is_given || turn == GlassTurn::mirrored)
            colours.mirror(ways.cosine, is_beyond, is_given);
        else
            return way; // all is mirrored
        along = passes ? ways.through : ways.back;
        is_beyond = is_beyond != passes;
    }
    return way;
}

} // namespace overt
