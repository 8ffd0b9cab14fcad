/// Which channel of a stream means what, from what the stream tells of its channels.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

#include "devices/tracker/tracker_driver.h"
#include "experiment/protocol/protocol.h"

namespace overt {

/// What a stream tells of a channel: desc/channels/channel, by the recommendations for meta data of gaze in
/// XDF files. Empty: not told.
struct LslChannel {
    std::string label, eye, type, unit, coordinate_system;
};

/// What a channel means.
enum class LslMeaning : std::uint8_t {
    screen_x,
    screen_y,
    confidence,
    pupil,
    position_x,
    position_y,
    position_z,
    validity ///< 0: what the eye is told to look at is none
};
inline constexpr std::size_t lsl_meanings = 8;

/// A channel that the protocol assigns: for streams that tell nothing of their channels, or not this way.
struct LslAssignment {
    LslMeaning meaning = LslMeaning::screen_x;
    std::optional<Eye> eye; ///< nothing: of both, or of no eye in particular
    std::string label;      ///< of the channel, or its number from 1
};

/// From what an experimenter writes: eye, meaning and channel, such as "left x 3" or "right pupil
/// PupilRight"; the eye may be left out. Meanings: x, y, confidence, pupil, eye-x, eye-y, eye-z, valid.
/// Throws InputError for anything else.
LslAssignment parse_lsl_assignment(std::string_view text);

struct LslLayoutSettings {
    std::vector<LslAssignment> assignments; ///< where there is any, only these count
    StreamUnit unit = StreamUnit::as_told;
    bool y_is_up = false;          ///< else the origin is the top left corner
    double least_confidence = 0.0; ///< gaze of less confidence is lost
    /// Numbers that stand for a value that there is not, besides those that are none. Gaze is missing where
    /// one of its coordinates is such a number that lies off the screen, or both are such numbers: 0 alone is
    /// a place at the screen's edge.
    std::vector<double> missing = {};
};

/// Where in a sample each value stands.
class LslGazeLayout {
  public:
    /// Throws DeviceError, with what the stream tells of its channels, if gaze on the screen is not among
    /// them or in no unit that is known. `stream`: as messages name it.
    LslGazeLayout(const std::vector<LslChannel>& channels, const LslLayoutSettings& settings,
                  const TrackerWish& wish, const std::string& stream);

    bool measures_both_eyes() const noexcept { return both_eyes_; }
    Eye eye() const noexcept { return eye_; }

    /// Puts the samples of one measurement, the left eye's first. Values that are no finite number, or one of
    /// LslLayoutSettings::missing, are missing. Allocates and throws nothing.
    void take(std::span<const double> values, TrackerTime at, TrackerItemSink& sink) const noexcept;

  private:
    using Places = std::array<std::optional<std::size_t>, lsl_meanings>;
    enum Side : std::uint8_t { left, right, neither, sides };

    std::optional<double> value(std::span<const double> values, Side side, LslMeaning meaning) const noexcept;
    bool has_gaze(Side side) const noexcept;
    std::optional<ScreenPoint> gaze_in(std::span<const double> values, Side side) const noexcept;
    bool is_missing(double value) const noexcept;
    void put_eye(std::span<const double> values, Eye eye, TrackerTime at,
                 TrackerItemSink& sink) const noexcept;

    std::array<Places, sides> places_{};
    glm::dvec2 screen_px_, scale_;
    double position_mm_ = 1.0; ///< a place of the eye's unit
    bool y_is_up_;
    double least_confidence_;
    std::vector<double> missing_;
    Eye eye_;
    bool both_eyes_ = false;
};

/// What a channel means by its type or, where that is none of gaze, by its label.
std::optional<LslMeaning> lsl_meaning(const LslChannel& channel);

/// The eye that a channel is of, by what it tells or by its label; nothing: both, or none in particular.
std::optional<Eye> lsl_eye(const LslChannel& channel);

} // namespace overt
