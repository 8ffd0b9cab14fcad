#include "app/replay/replay_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/base/counted.h"

namespace overt {

namespace {

/// More would be repetitions: one flip that moves moves what follows from it.
constexpr std::size_t most_told = 8;

std::string sentence_on(const FileDifference& difference) {
    return fmt::format("file {}: {}", difference.file, difference.what);
}

} // namespace

std::string pixels_not_known(std::int64_t stimuli) {
    return fmt::format(
        "the pixels of the frames of {}: the session's program hashed what they are made from, and "
        "not them, or drew nothing",
        counted(static_cast<std::size_t>(stimuli), "stimulus", "stimuli"));
}

std::string to_text(const ReplayReport& report) {
    std::string text;
    if (!report.why_not.empty())
        text += fmt::format("not presented again, for {}: made again from the recorded flips and gaze\n",
                            report.why_not);
    for (const std::string& line : report.compared)
        text += "compared: " + line + "\n";
    for (const std::string& line : report.not_compared)
        text += "not compared: " + line + "\n";
    std::vector<std::string> found;
    for (const RecordDifference& difference : report.differences)
        found.push_back(to_text(difference));
    for (const FileDifference& difference : report.files)
        found.push_back(sentence_on(difference));
    if (found.empty())
        return text + fmt::format("{}: the replay is the same\n", report.session);
    text += fmt::format("{}: the replay differs\nfirst difference: {}\n", report.session, found.front());
    for (std::size_t i = 1; i < std::min(found.size(), most_told); ++i)
        text += "then: " + found[i] + "\n";
    if (found.size() > most_told)
        text += fmt::format("and in {} more tables or files\n", found.size() - most_told);
    if (report.recorded_by != report.replayed_by)
        text += fmt::format("The session was recorded by overt {}, and this is {}: take that version to see "
                            "whether the program is the reason.\n",
                            report.recorded_by, report.replayed_by);
    return text;
}

nlohmann::ordered_json to_json(const ReplayReport& report) {
    auto differences = nlohmann::ordered_json::array();
    for (const RecordDifference& difference : report.differences) {
        nlohmann::ordered_json item{{"table", difference.table}};
        if (difference.trial)
            item["trial"] = *difference.trial + 1;
        if (difference.attempt)
            item["attempt"] = *difference.attempt;
        item["row"] = difference.row;
        item["column"] = difference.column;
        item["recorded"] = difference.recorded;
        item["replayed"] = difference.replayed;
        differences.push_back(std::move(item));
    }
    auto files = nlohmann::ordered_json::array();
    for (const FileDifference& difference : report.files)
        files.push_back({{"file", difference.file}, {"what", difference.what}});
    nlohmann::ordered_json json{{"session", report.session},
                                {"same", report.is_same()},
                                {"presented_again", report.is_presented_again},
                                {"recorded_by", report.recorded_by},
                                {"replayed_by", report.replayed_by},
                                {"compared", report.compared},
                                {"not_compared", report.not_compared},
                                {"differences", std::move(differences)},
                                {"files", std::move(files)}};
    if (!report.why_not.empty())
        json["why_not_presented_again"] = report.why_not;
    return json;
}

} // namespace overt
