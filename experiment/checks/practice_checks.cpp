#include <algorithm>

#include <fmt/format.h>

#include "experiment/checks/protocol_checks.h"

namespace overt {

namespace {

template <class Entry>
void check_id(ProtocolExamination& examination, const std::string& path, const std::string& id,
              const std::vector<Entry>& entries, std::string_view noun) {
    std::vector<std::string_view> known;
    for (const Entry& entry : entries)
        known.push_back(entry.id);
    if (std::find(known.begin(), known.end(), id) == known.end())
        examination.error({path}, fmt::format("there is no {} \"{}\"", noun, id), suggest_name(id, known));
}

} // namespace

void check_practice(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    for (std::size_t i = 0; i < protocol.practice.size(); ++i) {
        const PracticeSettings& practice = protocol.practice[i];
        const auto path = [&](std::string_view key) { return fmt::format("practice[{}].{}", i, key); };
        check_id(examination, path("task"), practice.task, protocol.tasks, "task");
        check_id(examination, path("sculpture"), practice.sculpture, protocol.sculptures, "sculpture");
        check_id(examination, path("material"), practice.material, protocol.materials, "material");
        if (!practice.block.empty())
            check_id(examination, path("block"), practice.block, protocol.blocks, "block");
    }
}

void check_breaks(ProtocolExamination& examination) {
    const BreakSettings& breaks = examination.protocol.breaks;
    if (breaks.pace == BreakPace::timed && examination.is_written("breaks.min_s"))
        examination.error({"breaks.min_s"}, "\"min_s\" is for breaks that a key ends",
                          "the length of a timed break is \"duration_s\"");
    if (breaks.pace == BreakPace::timed && breaks.duration_s <= 0.0)
        examination.error({"breaks.duration_s"}, "a timed break of 0 s is none");
    if (breaks.between_blocks && examination.protocol.blocks.size() < 2)
        examination.warning({"breaks.between_blocks"}, "there are no blocks to break between");
    const RepeatSettings& repeat = examination.protocol.repeat;
    const bool is_repeated = repeat.missed_refreshes != RepeatWhen::never ||
                             repeat.gaze_lost != RepeatWhen::never || repeat.rejected != RepeatWhen::never;
    if (examination.is_written("repeat.most_attempts") && (!is_repeated || repeat.most_attempts == 1))
        examination.warning({"repeat.most_attempts"},
                            is_repeated ? "with one attempt nothing is ever repeated"
                                        : "nothing is ever repeated: \"missed_refreshes\", \"gaze_lost\" and "
                                          "\"rejected\" are all \"never\"");
}

} // namespace overt
