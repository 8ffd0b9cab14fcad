/// Which code an output of markers has for an event, as its [[marker_output]] says.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "experiment/factors.h"
#include "experiment/protocol/protocol.h"
#include "experiment/trial.h"

namespace overt {

/// What is marked of a trial.
enum class MarkedEvent : std::uint8_t { trial, onset, frame, end, response, result };
template <>
inline constexpr auto names_of<MarkedEvent> = enum_names<MarkedEvent>("trial", "onset", "frame", "end",
                                                                      "response", "result");

/// A code that a refresh of the animation has.
struct RefreshCode {
    int refresh = 0; ///< from 0
    int code = 0;
};

class MarkerCodes {
  public:
    /// Throws InputError for entries that cannot be read, name what is not in the protocol, or make a code
    /// beyond the largest of the output's kind.
    MarkerCodes(const Protocol& protocol, const MarkerOutputSettings& output);

    /// 0: none. Of an onset, with what the trial's condition adds.
    int code_of(MarkedEvent event, const Trial& trial) const noexcept;
    /// In the order of refreshes.
    std::span<const RefreshCode> refresh_codes() const noexcept { return refreshes_; }

  private:
    std::array<int, names_of<MarkedEvent>.size()> events_{};
    /// What the levels of a factor add to an onset's code.
    struct LevelCodes {
        Factor factor;
        std::vector<int> codes; ///< by level
    };
    Factors factors_;
    std::vector<LevelCodes> levels_;
    std::vector<RefreshCode> refreshes_;
};

} // namespace overt
