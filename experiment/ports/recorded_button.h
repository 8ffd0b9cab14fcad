/// A button of a response box, as the record keeps it.
#pragma once

#include <optional>
#include <string>

#include "experiment/box_time.h"

namespace overt {

struct RecordedButton {
    SessionTime at;                              ///< the estimate of when it happened
    SessionDuration uncertainty{};               ///< it happened within ± this of `at`
    int trial = -1;                              ///< -1: outside of trials
    std::string box;                             ///< as the protocol calls it
    bool is_operators = false;                   ///< the box lies in the operator's hand, not the observer's
    int button = 0;                              ///< as the box numbers it
    std::string name;                            ///< what is written on it
    bool is_down = false;                        ///< else it was let go
    std::optional<BoxTime> device_time = {};     ///< by the box's own clock, where it has one
    std::string meaning = {};                    ///< by the protocol; empty: none
    int sitting = 1;                             ///< of one that was read
    std::optional<std::int64_t> attempt_id = {}; ///< of one that was read, in a trial: the attempt's id
};

} // namespace overt
