/// The status stream of a Display++ or Bits#: one line a sample with the box's time and the state of its
/// inputs.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "experiment/box_time.h"

namespace overt {

/// One sample, levels as the box gives them. Trigger idles at 0; digital inputs and infrared buttons idle
/// at 1.
struct StatusSample {
    std::uint64_t number = 0;
    BoxTime at;
    bool trigger = false;
    std::bitset<10> digital;           ///< Din0-Din9
    std::bitset<6> infrared;           ///< buttons A-F of a CB6
    std::array<float, 6> analogue_v{}; ///< inputs 1-6
};

/// Reads "#sample;n;time;trigger;10 digital;6 infrared;6 analogue;", also behind noise. Nothing if the line
/// is none, is cut, or has another number of fields: the box can be configured to leave some out, and then
/// it cannot be told which. Allocates nothing.
std::optional<StatusSample> parse_status_line(std::string_view line);

/// A line of the touch stream, "$touch;…", which may be mixed in. Not used, but no noise either.
bool is_touch_line(std::string_view line);

struct BoxInput {
    enum class Kind : std::uint8_t { trigger, digital, infrared, analogue };
    Kind kind = Kind::trigger;
    std::uint8_t index = 0; ///< from 0
    bool operator==(const BoxInput&) const = default;
};

/// An input changed. The change happened after the sample before and not after `at`.
struct BoxEvent {
    BoxTime at;
    BoxTime not_before; ///< time of the sample before
    BoxInput input;
    bool active = false; ///< trigger 1; digital or infrared pulled to 0, that is pressed; false for analogue
    float analogue_v = 0.0f; ///< new level, for analogue inputs
};

/// Finds the changes between samples. Needs one sample to know the state; inputs active at that time make no
/// event.
class BoxEdgeDetector {
  public:
    static constexpr std::size_t most_events = 1 + 10 + 6 + 6;

    /// An analogue input makes an event when it is this far from where it made the last. Without a threshold
    /// it makes none.
    explicit BoxEdgeDetector(std::optional<float> analogue_threshold_v = std::nullopt)
        : threshold_v_(analogue_threshold_v) {}

    /// The changes that this sample brings, in the order of its fields; valid until the next call. Allocates
    /// nothing.
    std::span<const BoxEvent> feed(const StatusSample& sample) noexcept;

  private:
    void add(const StatusSample& sample, BoxInput input, bool active, float analogue_v) noexcept;

    std::optional<float> threshold_v_;
    std::optional<StatusSample> last_;
    std::array<float, 6> reported_v_{};
    std::array<BoxEvent, most_events> events_{};
    std::size_t count_ = 0;
};

} // namespace overt
