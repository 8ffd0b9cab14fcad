/// Places on surfaces that observers pointed at as their answers.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/statistics/estimate.h"

namespace overt {

/// Answers that belong together: of one observer, answer and object.
struct PointsOf {
    std::string observer; ///< empty: all together
    std::string task, answer;
    int object = 0; ///< index into StudyResults::objects
    friend auto operator<=>(const PointsOf&, const PointsOf&) = default;
};

/// One answer of a trial that gives results. What was missed is none.
struct AnsweredPointRow {
    PointsOf of;
    int session = 0; ///< index into StudyResults::sessions
    int trial = 0;   ///< from 1, in the observer's order
    std::string by;  ///< "mouse", "gaze" or "fixation"
    /// In the mesh's unit, from its origin; nothing beside the object.
    std::optional<glm::dvec3> place = {};
    std::optional<std::uint32_t> triangle = {}, part = {};
    glm::dvec3 barycentric{0.0}; ///< of the triangle's corners
    std::string part_name = {};
    /// Of how exactly it was pointed (SurfaceFootprint), in the mesh's unit; nothing: not known.
    std::optional<double> largest_sd = {};
    std::optional<double> response_s = {};
};

/// How places of an answer lie to each other. Distances go straight through space, in mm.
struct PointSpreadRow {
    PointsOf of;
    int answers = 0, on_surface = 0, observers = 0;
    /// The place with the least sum of squared distances to all others: a place that was pointed at.
    std::optional<glm::dvec3> middle = {}; ///< in the mesh's unit
    std::string middle_part = {};
    /// Root mean square of the distances from it.
    std::optional<double> spread_mm = {};
    Estimate within_mm;  ///< mean distance of two places of one observer; of all: mean over observers
    Estimate between_mm; ///< of two places of different observers; of all alone
    /// Mean distance of two places that are drawn evenly from the object's pictures, for as long as they are
    /// shown.
    std::optional<double> chance_mm = {};
    Estimate of_chance; ///< between_mm as a share of it; 1: no more alike than by chance
};

/// Share of an answer's places on an area.
struct PointAreaRow {
    PointsOf of;
    std::string area;
    int answers = 0; ///< on the object
    int on_area = 0;
    int observers = 0;
    Estimate share;                       ///< of one observer: without an interval
    std::optional<double> by_chance = {}; ///< of the exposure
};

/// How far two answers of one trial lie apart.
struct PointPairRow {
    std::string observer; ///< empty: all together
    std::string task, first, second;
    int object = 0;
    int trials = 0, observers = 0;
    Estimate distance_mm;
};

struct StudyPoints {
    std::vector<AnsweredPointRow> given;
    std::vector<PointSpreadRow> spreads;
    std::vector<PointAreaRow> areas;
    std::vector<PointPairRow> pairs;
};

} // namespace overt
