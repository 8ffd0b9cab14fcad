/// How often gaze comes back, and how alike two ways of gaze are: on any surface whose distances are known.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace overt {

/// Recurrence of a sequence of fixations (Anderson, Bischof, Laidlaw, Risko and Kingstone, Behavior Research
/// Methods 45, 2013, 842-856), as shares of 1.
struct Recurrence {
    double recurrence = 0.0; ///< share of the pairs of fixations that are near each other
    /// Of these pairs the share that is in diagonals of two and more: fixations that repeat a way. Nothing
    /// without a pair, as the next.
    std::optional<double> determinism;
    /// Mean number of fixations from the first to the second of such a pair, over the most that it can be.
    std::optional<double> return_distance;
};

/// `is_near(i, j)` of fixations i < j of `count`. Nothing for fewer than two.
std::optional<Recurrence> recurrence(std::size_t count,
                                     const std::function<bool(std::size_t, std::size_t)>& is_near);

/// The distance of a fixation of one sequence from one of another, >= 0; infinite: on another piece of the
/// surface.
using FixationDistance = std::function<double(std::size_t of_a, std::size_t of_b)>;

/// ScanMatch (Cristino, Mathot, Theeuwes and Gilchrist, Behavior Research Methods 42, 2010, 692-700): each
/// fixation counts once for each `bin_s` of its duration, once at least; sequences are aligned by Needleman
/// and Wunsch's algorithm with gaps that cost nothing and substitutions that give 1 - distance / threshold,
/// no less than -1; the score is divided by the length of the longer one. 1: the same places in the same
/// order for as long. Durations in seconds. Nothing if either is empty.
std::optional<double> scan_match(std::span<const double> durations_a, std::span<const double> durations_b,
                                 const FixationDistance& distance, double threshold, double bin_s);

/// A way from one fixation to the next: length along the surface, and the straight vector between both
/// places.
struct GazeStep {
    double length = 0.0;
    double x = 0.0, y = 0.0, z = 0.0;
};

/// Each 0 … 1, 1: the same.
struct MultiMatch {
    double shape = 0.0, length = 0.0, direction = 0.0, position = 0.0, duration = 0.0;
};

/// A sequence of fixations, and the steps between them: one fewer.
struct GazeWay {
    std::span<const double> durations;
    std::span<const GazeStep> steps;
};

/// MultiMatch (Jarodzka, Holmqvist and Nyström 2010; Dewhurst et al., Behavior Research Methods 44, 2012,
/// 1079-1100) without the simplification of sequences: steps are aligned by the shortest path through the
/// matrix of the lengths of the differences of their vectors; then medians over the aligned pairs of these
/// differences over twice the `extent`, of differences of length and of the distances of the fixations from
/// which the steps set out over the extent, of angles over pi, and of differences of durations over the
/// longer one, each taken from 1. `extent` > 0: the largest distance there is. Nothing if either has fewer
/// than two fixations.
std::optional<MultiMatch> multi_match(const GazeWay& a, const GazeWay& b, const FixationDistance& distance,
                                      double extent);

} // namespace overt
