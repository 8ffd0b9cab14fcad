/// The table of all keys that a protocol file may have: one row per key. The reader, the reference in
/// docs/protocols.md and the names suggested for misspelt words all come from it.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "experiment/protocol/protocol.h"

namespace overt {

/// What is known of a key without knowing whose it is.
struct KeyRule {
    std::string_view name;
    std::string_view unit = {}; ///< "mm", "Hz", …; empty for texts and plain numbers
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity(); ///< both ends are allowed
    /// The texts allowed, if not every text is. Of an enumeration: its names, in the order of its values.
    std::span<const std::string_view> choices = {};
    bool is_required = false;
    bool is_identifier = false;        ///< a text of letters, digits, - and _, fit for a file name
    std::string_view if_left_out = {}; ///< what a key without a fixed default means when it is left out
    std::string_view explanation;
};

/// A member of Struct of any type that a key can have.
template <class Struct>
using KeyMember =
    std::variant<int Struct::*, double Struct::*, Degrees Struct::*, std::string Struct::*,
                 std::filesystem::path Struct::*, std::optional<double> Struct::*,
                 std::optional<int> Struct::*, std::optional<std::uint64_t> Struct::*,
                 std::optional<glm::dvec3> Struct::*, std::array<double, 3> Struct::*, bool Struct::*,
                 std::vector<double> Struct::*, std::vector<std::string> Struct::*,
                 std::vector<std::array<double, 4>> Struct::*, std::vector<std::array<double, 6>> Struct::*,
                 OutputMode Struct::*, Dithering Struct::*, PairFilter Struct::*, PatchCorner Struct::*,
                 TrackerKind Struct::*, Playback Struct::*, WhenLate Struct::*, TaskCoverage Struct::*,
                 MaterialKind Struct::*, FrameEncoding Struct::*, FrameColours Struct::*,
                 BakeQuality Struct::*, PixelFilter Struct::*, StandardObserver Struct::*,
                 std::optional<TaskCoverage> Struct::*, OrderMethod Struct::*, TrialFactor Struct::*,
                 SquareKind Struct::*, LevelOrder Struct::*, RepetitionOrder Struct::*, BreakPace Struct::*,
                 RepeatWhen Struct::*, FieldKind Struct::*, AnswerUse Struct::*>;

template <class Struct> struct Key {
    KeyRule rule;
    KeyMember<Struct> member;
};

/// A [section], or the entries of a [[list]]; sub-tables (`head` of a sculpture) are sections of the same
/// struct.
template <class Struct> struct Section {
    std::string_view name;
    std::string_view explanation;
    std::vector<Key<Struct>> keys;
    std::vector<Section> tables = {};
    Struct Protocol::*one = nullptr;               ///< of a [section]; null for [protocol] itself
    std::vector<Struct> Protocol::*many = nullptr; ///< of a [[list]]
};

using ProtocolSections =
    std::tuple<Section<Protocol>, Section<DisplaySettings>, Section<TrackerSettings>, Section<ViewSettings>,
               Section<LightSettings>, Section<BakingSettings>, Section<Animation>, Section<ScheduleSettings>,
               Section<ScreenSettings>, Section<ConsentSettings>, Section<InstructionSettings>,
               Section<ObserverFieldSettings>, Section<OperatorSettings>, Section<AnswerSettings>,
               Section<Task>, Section<BlockSettings>, Section<GroupSettings>, Section<PracticeSettings>,
               Section<BreakSettings>, Section<RepeatSettings>, Section<SculptureSettings>,
               Section<MaterialSettings>, Section<FrameSequenceSettings>, Section<WordSettings>,
               Section<DatasetSettings>>;

/// All sections, in the order of the documentation. Made once; safe from any thread.
const ProtocolSections& protocol_sections();

/// Calls `visit(section)` for each section in turn.
template <class Visitor> void for_each_section(Visitor&& visit) {
    std::apply([&](const auto&... section) { (visit(section), ...); }, protocol_sections());
}

/// Names as the file has them; those of output modes and kinds of material are in their tables.
std::string_view name_of(Dithering dithering);
std::string_view name_of(PairFilter filter);
std::string_view name_of(PatchCorner corner);
std::string_view name_of(TrackerKind kind);
std::string_view name_of(Playback playback);
std::string_view name_of(WhenLate when_late);
std::string_view name_of(TaskCoverage coverage);
std::string_view name_of(OrderMethod method);
std::string_view name_of(TrialFactor factor);
std::string_view name_of(LevelOrder order);
std::string_view name_of(FrameEncoding encoding);
std::string_view name_of(FrameColours colours);
std::string_view name_of(BakeQuality quality);
std::string_view name_of(PixelFilter filter);
std::string_view name_of(StandardObserver observer);

/// What a key takes, for messages and the reference: "a number of Hz", "one of \"cycle\", \"ping-pong\"".
template <class Struct> std::string expected_value(const Key<Struct>& key);

/// The range in words, as "1 … 1000 Hz"; empty if there is none.
std::string range_text(const KeyRule& rule);

/// «a number of Hz», «one of …»: a noun with the rule's unit and choices.
std::string expected_text(const KeyRule& rule, std::string_view noun);

/// What a value of this type is called in a file.
template <class Value> constexpr std::string_view noun_of() {
    using std::is_same_v;
    if constexpr (is_same_v<Value, int> || is_same_v<Value, std::optional<int>> ||
                  is_same_v<Value, std::optional<std::uint64_t>>)
        return "a whole number";
    else if constexpr (is_same_v<Value, double> || is_same_v<Value, Degrees> ||
                       is_same_v<Value, std::optional<double>>)
        return "a number";
    else if constexpr (is_same_v<Value, std::optional<glm::dvec3>> || is_same_v<Value, std::array<double, 3>>)
        return "a list of three numbers";
    else if constexpr (is_same_v<Value, std::vector<std::array<double, 4>>>)
        return "a list of spheres [x, y, z, radius]";
    else if constexpr (is_same_v<Value, std::vector<std::array<double, 6>>>)
        return "a list of planes [[x, y, z], [nx, ny, nz]]";
    else if constexpr (is_same_v<Value, bool>)
        return "true or false";
    else if constexpr (is_same_v<Value, std::vector<double>>)
        return "a list of numbers";
    else if constexpr (is_same_v<Value, std::vector<std::string>>)
        return "a list of texts";
    else
        return "a text";
}

template <class Struct> std::string expected_value(const Key<Struct>& key) {
    return std::visit([&]<class Value>(Value Struct::*) { return expected_text(key.rule, noun_of<Value>()); },
                      key.member);
}

} // namespace overt
