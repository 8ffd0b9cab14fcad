/// How the program calibrates a tracker that does not calibrate itself.
#pragma once

#include <cstdint>

#include "experiment/base/enum_names.h"
#include "experiment/units.h"

namespace overt {

/// What makes gaze on the screen of what the tracker measures.
enum class CalibrationModel : std::uint8_t {
    polynomial, ///< in each coordinate: of first order up to 5 targets, of second from 9 on
    homography  ///< of a plane seen from elsewhere
};
template <>
inline constexpr auto names_of<CalibrationModel> = enum_names<CalibrationModel>("polynomial", "homography");

/// By what a target counts as looked at.
enum class TargetAcceptance : std::uint8_t {
    fixation, ///< gaze rested
    key       ///< the operator pressed the space bar while it did
};
template <>
inline constexpr auto names_of<TargetAcceptance> = enum_names<TargetAcceptance>("fixation", "key");

struct CalibrationSettings {
    int points = 9;            ///< 3, 5, 9 or 13
    int validation_points = 5; ///< likewise, at other places
    CalibrationModel model = CalibrationModel::polynomial;
    TargetAcceptance accept = TargetAcceptance::fixation;
    double area = 0.8;       ///< share of the screen's width and height that the targets span
    double target_deg = 0.6; ///< diameter of the target's disc
    double fixation_s = 0.3; ///< for which gaze must rest
    double fixation_reach_deg =
        1.0;                 ///< how far samples may lie from their median while it does (RestingGaze)
    double patience_s = 8.0; ///< for one target
};

} // namespace overt
