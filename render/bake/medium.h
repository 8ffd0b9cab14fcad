/// What is inside a translucent body: light is scattered and absorbed on its way, alike everywhere.
#pragma once

#include <cstdint>

#include "experiment/protocol/protocol.h"
#include "render/bake/spectral_bins.h"

namespace overt {

/// Changes whenever the same inputs would give other light: part of the key under which frames are kept.
constexpr int medium_version = 1;

/// Random numbers of a walk, of which there may be a million: of one path, from where it entered. The mixing
/// function of splitmix64 (Steele, Lea & Flood 2014) on a counter.
class WalkNumbers {
  public:
    WalkNumbers() = default;
    explicit WalkNumbers(std::uint64_t seed) : state_(seed) {}
    /// In [0, 1).
    float next() {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t mixed = state_;
        mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9u;
        mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebu;
        return static_cast<float>((mixed ^ (mixed >> 31)) >> 40) * 0x1p-24f;
    }

  private:
    std::uint64_t state_ = 0;
};

/// What a path in a medium is about, besides the light that it carries.
struct MediumPath {
    int band = -1; ///< whose free paths it has; -1: it has not been in the medium yet
    Bins chance;   ///< of its flights so far, had it another band's free paths: by the mean of all 31
    WalkNumbers numbers;
    int scatterings = 0;
    // Since what it carries was last settled; only how often and how far counts, not in which order.
    int unsettled = 0;
    float flown = 0.0f, absorbed_over = 0.0f;
};

/// Flights between scatterings are as long as one band has them, chosen evenly when the path first goes in,
/// and all bands are carried: each by its own chance of just these flights over the mean chance of all bands
/// (the balance heuristic; Wilkie, Nawaz, Droske, Weidlich & Hanika 2014, "Hero wavelength spectral
/// sampling"). What is absorbed is taken away by Beer and Lambert's law, not by chance: so bands that
/// scatter alike need no such weights, and a medium that does not scatter is coloured glass.
class Medium {
  public:
    /// Of kind `translucent`, in a mesh whose unit is the millimetre.
    explicit Medium(const MaterialSettings& material);

    const Bins& scattering() const { return scattering_; } ///< per unit of length
    const Bins& absorption() const { return absorption_; } ///< per unit of length
    bool scatters() const { return most_scattering_ > 0.0f; }
    float most_scattering() const { return most_scattering_; } ///< of all bands, per unit of length

    /// A path goes in for the first time, with a number from 0 to 1 and the seed of its others.
    static void enter(MediumPath& path, float number, std::uint64_t seed);
    /// Of a band between scatterings; infinite if it has none.
    float mean_flight(int band) const { return 1.0f / scattering_.value[static_cast<std::size_t>(band)]; }
    /// Length of a flight by a number from 0 to 1; infinite of a band that is not scattered.
    float free_path(int band, float number) const;
    /// The path has flown `length` to where it is scattered.
    static void scatter_after(float length, MediumPath& path) {
        ++path.scatterings;
        ++path.unsettled;
        path.flown += length;
        path.absorbed_over += length;
    }
    /// The path has flown `length` to the border, which does not count what is absorbed on the way.
    static void fly(float length, MediumPath& path) { path.flown += length; }
    /// Takes from `carried` what of this is not settled.
    void settle(MediumPath& path, Bins& carried) const;

    /// The direction after a scattering (Henyey & Greenstein 1941), all bands alike.
    glm::vec3 onward(glm::vec3 direction, glm::vec2 numbers) const;
    /// Density per solid angle at which it is turned by an angle of this cosine.
    static double phase(double anisotropy, double cosine);

  private:
    Bins scattering_, absorption_;
    Bins log_scattering_; ///< to the base of 2
    float most_scattering_ = 0.0f;
    float anisotropy_;
    bool is_grey_ = false; ///< all bands scatter alike
    bool absorbs_ = false;
};

/// Share of light from everywhere that a half space of a medium gives back, where its border neither mirrors
/// nor bends: `albedo` scattered of what is scattered or absorbed, by van de Hulst's formula (1980, "Multiple
/// Light Scattering", in Hapke's form), within 0.0025 of exact numbers. Forward scattering by similarity.
double half_space_albedo(double albedo, double anisotropy);

} // namespace overt
