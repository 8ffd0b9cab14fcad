/// A probe as an attempt at a trial showed it.
#pragma once

#include <string>

#include "experiment/attitude.h"

namespace overt {

/// In one step `show`.
struct ShownProbe {
    int step = 0;              ///< which of the attempt's steps, from 1
    std::string id;            ///< of the probe
    std::string point;         ///< name of its place
    int place = 0;             ///< which of what the trial shows it stands on (Trial::shown)
    int shown_refreshes = 0;   ///< flips while its stimulus was lit
    int visible_refreshes = 0; ///< of these, at which the place was seen, and the mark drawn
    // At the first flip.
    bool was_visible = false;
    ScreenPoint at = {}; ///< of the screen, also where it is hidden
    Attitude truth = {}; ///< of the surface
};

} // namespace overt
