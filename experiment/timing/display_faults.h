/// What a display, or the machine before it, can do wrong: given refresh by refresh, or drawn from a seed.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "experiment/base/enum_names.h"
#include "experiment/session_time.h"

namespace overt {

/// One thing that goes wrong at one refresh of a presentation, counted by the display from the onset, 0: the
/// flip that aims at it is struck. If an earlier fault made that refresh go by, nothing aims at it, and the
/// fault does not happen.
struct DisplayFault {
    enum class Kind : std::uint8_t {
        late,  ///< drawing takes so much longer
        skip,  ///< the display takes the picture so many refreshes later
        stall, ///< the machine stands still for so long before the flip is asked for; not at refresh 0
        stamp, ///< the time stamp of this flip alone is wrong by so much
    };
    Kind kind = Kind::late;
    std::optional<int> trial = {}; ///< index of the trial; nothing: in each
    int refresh = 0;
    double amount_ms = 0.0; ///< of late, stall and stamp
    int refreshes = 1;      ///< of skip
    friend bool operator==(const DisplayFault&, const DisplayFault&) = default;
};
template <>
inline constexpr auto names_of<DisplayFault::Kind> = enum_names<DisplayFault::Kind>("late", "skip", "stall",
                                                                                    "stamp");

/// Faults that come by chance: each refresh is struck with these probabilities, independently.
struct RandomFaults {
    double late_share = 0.0, late_min_ms = 0.0, late_max_ms = 20.0;
    double skip_share = 0.0;
    int skip_max_refreshes = 3; ///< 1 … this many
    double stall_share = 0.0, stall_min_ms = 0.0, stall_max_ms = 100.0;
    bool are_none() const { return late_share <= 0.0 && skip_share <= 0.0 && stall_share <= 0.0; }
};

struct DisplayFaults {
    std::uint64_t seed = 1;    ///< of all that comes by chance
    double drift_ppm = 0.0;    ///< the display's clock goes faster than nominal by this much
    double jitter_sd_ms = 0.0; ///< of every time stamp: normal, cut at three standard deviations
    /// The display counts its refreshes. If not, the program infers them from the time stamps, as it has to
    /// where it learns nothing but when a buffer swap returned.
    bool counts_refreshes = true;
    RandomFaults by_chance;
    std::vector<DisplayFault> given;

    /// Nothing goes wrong.
    bool is_clean() const;
};

/// The faults of one presentation of `refreshes` refreshes, in the order of their refreshes: those given, and
/// those drawn, which are a function of the seed and the trial.
std::vector<DisplayFault> faults_in(const DisplayFaults& faults, int trial, int refreshes);

} // namespace overt
