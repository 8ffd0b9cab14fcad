/// What decides the numbers of a study besides its sessions.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "experiment/base/enum_names.h"
#include "experiment/events/event_thresholds.h"
#include "experiment/screen_areas/screen_areas_file.h"
#include "experiment/statistics/bootstrap.h"
#include "experiment/statistics/paired_evidence.h"
#include "experiment/statistics/permutation.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// What maps are blurred with: heat along the surface, a Gaussian in space on the vertices, or the paper's on
/// a grid of voxels.
enum class MapKernel : std::uint8_t { geodesic, euclidean, voxel };
template <>
inline constexpr auto names_of<MapKernel> = enum_names<MapKernel>("geodesic", "euclidean", "voxel");

/// The standard deviation of the kernel.
struct KernelWidth {
    double value = 1.0;
    bool is_mm = false; ///< of the object; else degrees of the observer's eye
};

/// Trials beyond a limit are excluded; nothing: none are for that reason.
struct ExclusionRules {
    std::optional<double> most_lost_share;   ///< of samples, blinks apart, 0 … 1
    std::optional<double> most_accuracy_deg; ///< mean error of the validation before the trial
    std::optional<double> most_drift_deg;    ///< at the drift check
    std::optional<int> most_missed_refreshes;
};

/// Those that have a limit.
std::vector<ExclusionRule> rules_of(const ExclusionRules& rules);

/// The first rule that a trial breaks; nothing: it counts. A trial without a validation or a drift check
/// keeps the limits of these; one whose missed refreshes are unproven does not.
std::optional<ExclusionRule> broken_rule(const StudyQuality& quality, const ExclusionRules& rules);

/// A map that says where gaze should go: a PLY file with a number at each vertex, of an object or, if it is
/// not named, of each that it fits.
struct ModelFile {
    std::string object;
    std::filesystem::path file;
};

struct StudyOptions {
    std::vector<std::string> by{"task", "object", "material"};
    bool is_by_asked = false; ///< somebody asked for these columns: a factor with one level is refused
    std::string compare = "material"; ///< the column whose levels are compared within observers
    std::vector<std::string> areas;   ///< that are compared, that of figure 4 first; empty: all
    KernelWidth sigma;
    MapKernel kernel = MapKernel::geodesic;
    double shortest_fixation_s = 0.0;
    double least_on_surface = 0.5; ///< share of a fixation's samples that must meet the object
    /// A sample that misses the object by no more than this counts at the nearest place of its outline.
    /// Nothing: the mean error of the validation before the trial, and 0 if there was none.
    std::optional<double> reach_deg;
    ExclusionRules exclude;
    /// Fixations, saccades and blinks are found anew in all sessions, by these thresholds. Nothing: those on
    /// record, and found in imports that have none.
    std::optional<ChosenThresholds> detect_events;
    std::vector<ChosenScreenArea> screen_areas; ///< besides those that recordings tell
    std::string screen_areas_file;              ///< their file's name; empty: none
    /// Labels that stand for the same observer as another, and that one's.
    std::vector<std::pair<std::string, std::string>> same_observer;
    TemplateChoice onto;           ///< the object to whose surface all gaze is brought
    double time_step_s = 1.0;      ///< of the time course
    std::vector<ModelFile> models; ///< whose predictions are compared with observers'
    double confidence = 0.95;
    double smallest_effect = 0.5; ///< d_z that would be of interest: bounds of tests of equivalence, > 0
    int resamples = 2000;         ///< of the bootstrap
    int permutations = 1000;      ///< where all are too many
    bool threshold_free = false;  ///< maps of differences are tested without a threshold, too
    std::uint64_t seed = 1;       ///< of everything that is drawn
    BootstrapSettings bootstrap() const { return {resamples, confidence, seed}; }
    /// Of differences of observers.
    PairedEvidence evidence(std::span<const double> differences) const {
        return paired_evidence(differences, smallest_effect, confidence);
    }
    PermutationSettings permutation() const { return {5 * permutations, 100000, seed}; }
};

/// As the report and the tables have them, so that they tell what was done without the command line.
std::vector<StudyParameter> parameters_of(const StudyOptions& options);

} // namespace overt
