/// What an observer who does not see the screen is told of an object that can be turned.
#pragma once

#include <string>

#include "experiment/session_time.h"

namespace overt {

struct TurningOffer {
    int show = 0;              ///< which of the attempt's, from 0
    int place = 0;             ///< of the object, in Trial::shown
    SessionTime since{};       ///< from then on it can be turned
    double lasts_s = 0.0;      ///< for so long at most
    bool is_elevation = false; ///< the offer is of its elevation, which has one of its own
    std::string less, more;   ///< keys that turn it clockwise and counter-clockwise, or take its front up and
                              ///< down; empty: the mouse does
    bool drags_tilt = false;  ///< a drag up or down has it tilt
    double speed_deg_s = 0.0; ///< while one is held
    double deg_per_px = 0.0;  ///< of a drag to the right, or downwards
    double right_px = 0.0, down_px = 0.0;    ///< the middle of its image, from the middle of the screen
    double turn_sd_deg = 0.0, pause_s = 0.0; ///< as ObserverTurn has them of simulated observers
};

} // namespace overt
