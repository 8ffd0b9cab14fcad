/// The display box of a sitting, as a session's record has it: which one there was, or why there was none.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/box_time.h"
#include "experiment/session_time.h"

namespace overt {

struct RecordedBox {
    enum class Use : std::uint8_t {
        box,       ///< it was found and switched
        declined,  ///< the protocol says that there is none
        simulated, ///< nothing was shown on a real screen in real time
        no_mode,   ///< the output needs none
    };
    Use use = Use::no_mode;
    // Of a box only.
    std::string port, product, serial_number, firmware_date;
    std::string mode;                ///< that it was switched to
    std::string gamma_table;         ///< that it was told to use, a file on its disk
    SessionDuration settled_after{}; ///< from the command to the second of two equal rates
    double video_rate_hz = 0.0;      ///< as it measures it
    bool operator==(const RecordedBox&) const = default;
};
std::string_view name_of(RecordedBox::Use use);

/// What a session's log says of a box, for a line in a terminal and the record.
std::string describe(const RecordedBox& box);

/// The line through a sitting's readings of session clock and box.
struct BoxClockFit {
    int readings = 0;
    double drift_ppm = 0.0; ///< by how much a second of the session exceeds one of the box
    double drift_uncertainty_ppm = 0.0;
    SessionTime zero;              ///< when the box's clock showed 0
    SessionDuration uncertainty{}; ///< bound on the error of session times, the largest at any reading
};

/// At least one reading; all from one run of the box's clock.
BoxClockFit fit_box_clock(const std::vector<BoxClockPair>& readings);

} // namespace overt
