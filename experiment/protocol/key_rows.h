/// The rows of the key table, section by section. Only protocol_keys.cpp puts them together.
#pragma once

#include "experiment/protocol/protocol_keys.h"

namespace overt::key_rows {

// What the experiment runs on (rig_keys.cpp).
Section<DisplaySettings> display();
Section<TrackerSettings> tracker();
Section<ScreenSettings> screens();

// What is shown (stimulus_keys.cpp).
Section<ViewSettings> view();
Section<LightSettings> light();
Section<Animation> animation();
Section<SculptureSettings> sculpture();
Section<MaterialSettings> material();

// How it becomes pictures (frame_keys.cpp).
Section<BakingSettings> bake();
Section<FrameSequenceSettings> frames();

// What is asked, and in which order (design_keys.cpp).
Section<Protocol> protocol();
Section<ScheduleSettings> schedule();
Section<Task> task();

// The order of trials and of observers (order_keys.cpp).
Section<BlockSettings> block();
Section<GroupSettings> group();

// How a session goes besides its trials (practice_keys.cpp).
Section<PracticeSettings> practice();
Section<BreakSettings> breaks();
Section<RepeatSettings> repeat();

// What surrounds the trials (sitting_keys.cpp).
Section<ConsentSettings> consent();
Section<InstructionSettings> instructions();
Section<ObserverFieldSettings> observer_fields();
Section<OperatorSettings> operators();
Section<AnswerSettings> answers();

// What is said on the screen besides, and of the dataset (word_keys.cpp).
Section<WordSettings> words();
Section<DatasetSettings> dataset();

/// The names of a table's rows, in their order.
template <const auto& table>
inline constexpr auto names_in = [] {
    std::array<std::string_view, table.size()> names;
    for (std::size_t i = 0; i < table.size(); ++i)
        names[i] = table[i].name;
    return names;
}();

// Names of enumerations, in the order of their values.
inline constexpr std::string_view ditherings[] = {"none", "ordered", "blue-noise"};
inline constexpr std::string_view pair_filters[] = {"box", "lanczos"};
inline constexpr std::string_view patch_corners[] = {"none", "top-left", "top-right", "bottom-left",
                                                     "bottom-right"};
inline constexpr std::string_view playbacks[] = {"cycle", "ping-pong"};
inline constexpr std::string_view when_lates[] = {"drop", "stretch"};
inline constexpr std::string_view task_coverages[] = {"every-stimulus", "once-per-sculpture"};
inline constexpr std::string_view order_methods[] = {"random", "sequential", "blocked", "weighted"};
inline constexpr std::string_view trial_factors[] = {"task", "sculpture", "material", "stimulus"};
inline constexpr std::string_view level_orders[] = {"random", "fixed", "cyclic", "balanced", "random-square"};
inline constexpr std::string_view square_kinds[] = {"cyclic", "balanced", "random-square"};
inline constexpr std::string_view break_paces[] = {"self", "timed"};
inline constexpr std::string_view repeat_whens[] = {"never", "now", "end-of-block"};
inline constexpr std::string_view answer_uses[] = {"none", "optional", "required"};
inline constexpr std::string_view field_kinds[] = {"text", "number", "choice"};
inline constexpr std::string_view repetition_orders[] = {"in-turn", "mixed"};
inline constexpr std::string_view frame_encodings[] = {"linear", "srgb"};
inline constexpr std::string_view frame_colours[] = {"display", "rec709", "xyz"};
inline constexpr std::string_view bake_qualities[] = {"live", "preview", "draft", "standard", "reference"};
inline constexpr std::string_view pixel_filters[] = {"box", "gaussian", "blackman-harris"};
inline constexpr std::string_view standard_observers[] = {"cie1931", "cie2006"};

} // namespace overt::key_rows
