/// What was set with gauges, and the reliefs that settings speak of.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/attitude.h"
#include "experiment/statistics/estimate.h"

namespace overt {

/// Settings that belong together: of one observer, answer and picture of an object.
struct ReliefOf {
    std::string observer; ///< empty: all together
    std::string task, answer;
    std::string object, material, light, motion, view; ///< ids of what was shown
    int frame = 0;                                     ///< of the motion, in which it was set
    friend auto operator<=>(const ReliefOf&, const ReliefOf&) = default;
};

/// One setting of a trial that gives results.
struct GaugeSettingRow {
    ReliefOf of;
    int session = 0; ///< index into StudyResults::sessions
    int trial = 0;   ///< from 1, in the observer's order
    std::string point;
    /// The place in the camera's coordinates, in the mesh's unit: x to the right, y up, z towards the viewer,
    /// negative.
    double x = 0.0, y = 0.0, z = 0.0;
    Attitude set;
    std::optional<Attitude> truth;
    bool is_at_limit = false;
    std::optional<double> response_s;
};

/// A place of a relief.
struct ReliefPointRow {
    ReliefOf of;
    std::string point;
    int settings = 0;
    Attitude mean = {};     ///< of the unit normals that were set
    double resultant = 1.0; ///< length of their mean: 1 if all are alike
    std::optional<Attitude> truth = {};
    std::optional<double> deviation_deg = {}; ///< of the mean from the truth
    double x = 0.0, y = 0.0;                  ///< in the mean depth of the relief, in the mesh's unit
    double true_z = 0.0;                      ///< towards the eye, from the mean depth
    std::optional<double> z = {}; ///< of the relief, with a mean of 0; nothing: it could not be put together
};

/// A relief and the truth.
struct ReliefRow {
    ReliefOf of;
    int settings = 0, points = 0, edges = 0;
    int clipped = 0;                     ///< points of which the mean was too steep and was taken for less so
    std::optional<double> deviation_deg; ///< mean over settings
    std::optional<double> repeat_sd_deg; ///< of the normals at a place about their mean, pooled
    std::optional<double> residual;      ///< root mean square over edges, in the mesh's unit
    // z = a + gain true, and z = a + gain true + x_shear x + y_shear y.
    std::optional<double> gain, r, affine_gain, x_shear, y_shear, affine_r;
    std::string note; ///< why there is none of these; empty: there are
    /// Rises of depth that were set over those of the surface, place by place (AttitudeRegression): of one
    /// observer with the bootstrap over places, of all with that over observers.
    Estimate attitude_gain;
    std::optional<double> attitude_x_shear, attitude_y_shear, attitude_r;
    std::optional<double> planted; ///< gain that simulated observers were given
};

struct StudyReliefs {
    std::vector<GaugeSettingRow> settings;
    std::vector<ReliefPointRow> points;
    std::vector<ReliefRow> reliefs;
};

} // namespace overt
