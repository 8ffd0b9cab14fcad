#include "app/record/sound_sessions.h"

#include <cstdio>

#include <fmt/format.h>

#include "app/cli/interruption.h"
#include "experiment/base/counted.h"
#include "experiment/base/parallel.h"
#include "experiment/record/verify/verification.h"

namespace overt {

std::vector<std::string> sessions_with_broken_seals(std::span<const std::filesystem::path> sessions) {
    std::vector<std::vector<std::string>> found(sessions.size());
    parallel_for(static_cast<int>(sessions.size()), [&](int i) {
        const auto session = static_cast<std::size_t>(i);
        if (!Interruption::requested())
            found[session] = broken_seals(sessions[session]);
    });
    Interruption::check("Looking at the seals of the sessions");
    std::vector<std::string> sentences;
    for (std::size_t i = 0; i < sessions.size(); ++i)
        if (!found[i].empty())
            sentences.push_back(fmt::format(
                "{}: is not what was recorded: {} not as sealed, the first: {}. `overt verify` names them "
                "all.",
                sessions[i].string(), counted(found[i].size(), "thing is", "things are"), found[i].front()));
    return sentences;
}

std::vector<std::string> say_broken_seals(std::span<const std::filesystem::path> sessions) {
    std::vector<std::string> sentences = sessions_with_broken_seals(sessions);
    for (const std::string& sentence : sentences)
        fmt::print(stderr, "{}\n", sentence);
    return sentences;
}

} // namespace overt
