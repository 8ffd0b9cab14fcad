/// What the measured places of fixations say of the areas that were looked at, given the tracker's error.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "experiment/animation.h"
#include "experiment/scene/areas.h"
#include "experiment/scene/viewing.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// Where the tracker saw a fixation, halfway through.
struct MeasuredPlace {
    PoseIndex pose; ///< lit then
    glm::dvec2 image_px{0.0};
    glm::dvec2 sigma_px{0.0}; ///< standard deviation of the tracker's error along each axis, > 0
    int trial = 0; ///< its fixations share their constant error, and follow each other in lists of places
};

/// An error that a trial may have, in standard deviations of the tracker's along each axis.
struct TrialError {
    glm::dvec2 sigmas{0.0};
    double probability = 0.0; ///< before anything was measured; their sum is 1
};

/// The tracker's error of a trial is one of these, and a rest that differs from fixation to fixation and is
/// normal with trial_error_rest standard deviations along each axis: together they have the variance of the
/// tracker's error. A grid of triangles, whose steps are as fine as the rest is wide.
std::span<const TrialError> trial_errors();
inline constexpr double trial_error_rest = 0.28;

/// A measured place farther than this from everything that is seen of the object says nothing of its areas:
/// 99 % of normal errors in the plane are smaller (Rayleigh's distribution).
inline constexpr double farthest_sigmas = 3.035;

/// Which places of the surface were looked at is estimated from all fixations together: cells of the surface,
/// equal in area, get the weights under which the measured places are most probable, with each place
/// normally distributed about the picture of the cell that was looked at. That is maximum likelihood for a
/// mixture (Laird, Journal of the American Statistical Association 73, 1978), climbed by EM as in
/// Richardson's and Lucy's deconvolution (1972, 1974); in each pose only cells that nothing hides can be
/// looked at. Each area of the object is asked apart: of its weights and those of all else together the
/// area's alone give the one probability of a fixation, the others' alone the other.
///
/// The fixations of a trial share an error. Each step therefore first asks how probable each of
/// trial_errors() and each share of the area is in a trial, given all of its fixations, and then, given
/// these, what was looked at. The evidence of a fixation is what its place says given the errors that the
/// *other* fixations of its trial leave probable, so that the product over fixations is a pseudo-likelihood
/// (Besag, The Statistician 24, 1975).
///
/// By fixation and area. Empty for fixations of which no area tells, such as those beyond farthest_sigmas,
/// and all if they are a few only; of an area that has no triangle, or all of them, nothing tells. `poses` by
/// PoseIndex. The same on any number of processors. Throws GraphicsError if the mesh's rays cannot be cast.
std::vector<std::vector<AreaEvidence>> area_evidence(const Mesh& mesh, const Areas& areas,
                                                     const SceneView& scene,
                                                     std::span<const ObjectPose> poses,
                                                     std::span<const MeasuredPlace> fixations);

/// The share of fixations on an area under which what was measured is most probable, 0 … 1; nothing without
/// any that tells. Each fixation counts for inside and elsewhere by its evidence.
std::optional<double> most_probable_share(std::span<const AreaEvidence> fixations);

/// Each observer's share, of those with fixations that tell. From the most probable share p of all together
/// one step of scoring: p + sum of (inside - elsewhere) / (p inside + (1 - p) elsewhere) over the sum of its
/// squares. The mean of the former is the observer's distance from p times that of the latter, whatever the
/// distance, so that shares are without bias however little an observer's fixations tell; most probable
/// shares of single observers end at 0 and 1, and their mean is drawn to the middle. For the same reason
/// these may lie beyond 0 and 1. Where p itself is within 0.02 of 0 or 1, each has its most probable share.
std::vector<double> shares_of_observers(std::span<const std::vector<AreaEvidence>> observers);

} // namespace overt
