/// How alike two maps are, and how well a map tells where fixations fell.
///
/// A map is a number for each place; `areas` says how much of the surface each place stands for (all 1 for
/// the pixels of a picture). Without areas the tessellation of a mesh would decide the result. The formulas
/// are those of the MIT saliency benchmark (Bylinskii, Judd, Oliva, Torralba and Durand 2019, "What do
/// different evaluation metrics tell us about saliency models?", IEEE TPAMI 41(3), and its published code)
/// and of pysaliency (Kümmerer), where sums over pixels become sums over places weighted by area.
///
/// All spans of a call are equally long. Maps and areas are finite and areas are not negative. Nothing is
/// given where a formula has no value: constant maps, maps without mass, no fixation.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace overt {

/// Pearson's correlation of two maps over the surface, -1 … 1. Nothing if one of them is constant.
std::optional<double> correlation(std::span<const double> a, std::span<const double> b,
                                  std::span<const double> areas);

/// What is done to a map before two are intersected.
enum class SimConvention : std::uint8_t {
    mit,        ///< scaled from its minimum and maximum to 0 … 1, then divided by its integral
    pysaliency, ///< less its minimum if that is negative, then divided by its integral
};

/// SIM, the intersection of histograms, 0 … 1: integral of the lesser of both maps. Nothing if one of them
/// has no integral.
std::optional<double> similarity(std::span<const double> a, std::span<const double> b,
                                 std::span<const double> areas, SimConvention convention);

/// Kullback and Leibler's divergence of `model` from `truth`, in nats: integral of Q ln(e + Q / (P + e)) with
/// both maps divided by their integrals and multiplied by the mean area, so that on equal areas P and Q are
/// the probabilities of the benchmark's code, and e = 2.2204e-16.
std::optional<double> kl_divergence(std::span<const double> model, std::span<const double> truth,
                                    std::span<const double> areas);

/// How the standard deviation of a map divides: pysaliency by N, the benchmark's MATLAB code by N - 1 (with
/// areas: by N - 1 of N equal areas).
enum class NssConvention : std::uint8_t { population, sample };

/// Normalised scanpath saliency: the mean over fixations of (map - mean of the map) / its standard deviation.
/// `at_fixations` are the map's values there.
std::optional<double> nss(std::span<const double> map, std::span<const double> areas,
                          std::span<const double> at_fixations,
                          NssConvention convention = NssConvention::population);

/// Information gain over a baseline in bits per fixation: mean of log2(e + P) - log2(e + B) at fixations,
/// with both maps divided by their integrals and multiplied by the mean area.
std::optional<double> information_gain(std::span<const double> map, std::span<const double> baseline,
                                       std::span<const double> areas,
                                       std::span<const double> map_at_fixations,
                                       std::span<const double> baseline_at_fixations);

/// The integral of a map over the surface.
double integral(std::span<const double> map, std::span<const double> areas);

} // namespace overt
