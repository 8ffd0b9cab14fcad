/// What is said of missed refreshes: no number of them where nothing proves it.
#pragma once

#include <string>

#include "experiment/base/counted.h"

namespace overt {

/// "3 refreshes missed"; without proven times "missed refreshes: unproven", or how many seem to have been.
inline std::string missed_in_words(int missed, bool has_proven_times) {
    if (!has_proven_times && missed == 0)
        return "missed refreshes: unproven";
    return counted(missed, "refresh", "refreshes") +
           (has_proven_times ? " missed" : " missed, by times that nothing proves");
}

} // namespace overt
