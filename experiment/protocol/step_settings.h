/// What a trial does, one step after another, as `steps` of [[task]] states it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/base/diagnostics.h"
#include "experiment/base/enum_names.h"
#include "experiment/keys/value_type.h"
#include "experiment/units.h"

namespace overt {

enum class StepKind : std::uint8_t { text, fixation, show, blank, mask, answer, feedback, drift_check };

/// A kind of step. How it runs is in experiment/session/steps.
struct StepKindRow {
    StepKind kind;
    std::string_view name; ///< in a protocol, where it is the step's key, and in the record
    std::string_view shows;
    /// What may stand beside the kind's own key, besides `id`; empty behind the last.
    std::array<std::string_view, 6> keys;
    bool may_be_watched; ///< gaze is recorded meanwhile, and can end it

    constexpr bool has_key(std::string_view key) const {
        for (const std::string_view one : keys)
            if (one == key)
                return !key.empty();
        return false;
    }
};

/// All kinds, in the order of StepKind.
inline constexpr auto step_kinds = std::to_array<StepKindRow>({
    {StepKind::text, "text", "words, until a key is pressed or time is up", {"for_s"}, false},
    {StepKind::fixation,
     "fixation",
     "a target to be looked at",
     {"for_s", "limit_s", "until", "right_deg", "up_deg"},
     true},
    {StepKind::show, "show", "the trial's stimulus", {"for_s", "limit_s", "until", "frame", "probes"}, true},
    {StepKind::blank, "blank", "the background", {"for_s", "limit_s", "until"}, true},
    {StepKind::mask,
     "mask",
     "noise where stimuli stand, or what they showed, scrambled",
     {"for_s", "cell_deg"},
     true},
    {StepKind::answer, "answer", "the screen of the answer", {"limit_s"}, false},
    {StepKind::feedback,
     "feedback",
     "words, or a tone, by what was answered",
     {"for_s", "answered", "missed"},
     false},
    {StepKind::drift_check, "drift_check", "the target by which the tracker's drift is measured", {}, false},
});

constexpr const StepKindRow& row_of(StepKind kind) { return step_kinds[static_cast<std::size_t>(kind)]; }
constexpr std::string_view name_of(StepKind kind) { return row_of(kind).name; }

static_assert([] {
    for (std::size_t i = 0; i < step_kinds.size(); ++i)
        if (step_kinds[i].kind != static_cast<StepKind>(i))
            return false;
    return true;
}());

/// How long a step lasts, in seconds: always the same, or drawn for each trial.
struct StepDuration {
    enum class Law : std::uint8_t {
        fixed,
        one_of,     ///< each equally probable
        uniform,    ///< from … to
        exponential ///< the same, cut off there: most near `from`
    };
    Law law = Law::fixed;
    std::vector<double> choices_s; ///< the one, or all of the list
    double from_s = 0.0, to_s = 0.0;
    double mean_s = 0.0; ///< of the exponential law, cut off as it is

    double shortest_s() const;
    double longest_s() const;
};

/// The time constant in seconds of the exponential law on [from, to] whose mean is `mean_s`, which lies
/// between `from` and the middle. The mean is from + tau - (to - from) / (exp((to - from) / tau) - 1).
double time_constant_s(double from_s, double to_s, double mean_s);

/// What happens once gaze has not come in time.
enum class GazeMissed : std::uint8_t {
    goes_on,
    drift_check, ///< is made, and the step begins anew
    abort        ///< the attempt does not count
};
template <>
inline constexpr auto names_of<GazeMissed> = enum_names<GazeMissed>("continue", "drift-check", "abort");

/// `until` of a step: gaze stays within a distance of a point, or on an area of the object, in one piece.
struct GazeWait {
    std::optional<double> within_deg; ///< of the fixation target, or of the screen's middle
    std::string area = {};            ///< an area of the object; empty: within_deg says where
    Place area_place = {};
    /// Where: its object, or its middle; empty: any that the step shows, or no slot's middle.
    std::string slot = {};
    Place slot_place = {};
    double for_s = 0.2;
    double blink_s = 0.3; ///< gaze that is lost for no longer neither counts nor breaks
    std::optional<double> patience_s = {};
    GazeMissed otherwise = GazeMissed::goes_on;
};

/// An entry of `steps`.
struct StepSettings {
    StepKind kind = StepKind::blank;
    std::string id; ///< empty: none was given
    Place place;    ///< of the entry
    Place id_place;
    std::string text;                     ///< of a text
    std::vector<std::string> slots;       ///< of `show`: where
    std::optional<StepDuration> duration; ///< nothing: something else ends it; of `show`: the motion's
    Place duration_place;
    bool ends_by_key = false;
    bool ends_by_answer = false;      ///< of a step that shows, or waits: `until = "answer"`
    std::vector<std::string> answers; ///< of `answer`: ids; empty: it is spoken
    Place answers_place;
    std::optional<GazeWait> gaze;
    double right_deg = 0.0, up_deg = 0.0; ///< of a fixation target, from the middle of the screen
    std::optional<int> frame;             ///< `show` shows this one, still; from 0
    Place frame_place;
    std::optional<std::vector<std::string>> probes; ///< of `show`: ids of those that are drawn; nothing: all
    Place probes_place;
    double cell_deg = 0.25;       ///< side of a mask's squares
    bool is_scrambled = false;    ///< the mask is the stimulus in squares that change places; else noise
    std::string answered, missed; ///< words of a feedback
    std::string correct, wrong;   ///< the same, where that is known; empty: as `answered`
    bool is_coloured = false;     ///< they are green and red
    bool has_tone = false;        ///< it is heard, too
};

/// A step of feedback among them is heard.
bool have_tones(const std::vector<StepSettings>& steps);

/// An hour: nobody looks at a step for longer, and refreshes can be counted.
inline constexpr double longest_step_s = 3600.0;

/// The column of a table of trials that says how long the step lasts: its id, or its kind where it has none,
/// and "_s".
std::string seconds_column(const StepSettings& step);

/// A list of steps. All that is wrong with it is found at once.
const ValueType& value_type(TypeTag<std::vector<StepSettings>>);

} // namespace overt
