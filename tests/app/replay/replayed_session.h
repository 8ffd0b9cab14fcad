/// Small sessions to be presented again.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <catch2/catch.hpp>

#include "tests/app/small_experiment.h"

namespace overt::test {

/// With consent, a form, practice and spoken answers.
inline std::string full_protocol() {
    return std::string(small_protocol) + R"(
[consent]
text = "Do you want to take part?"

[answers]
record = "required"

[[observer_field]]
id = "age"
kind = "number"

[[practice]]
task = "face"
object = "bust"
material = "matt"
)";
}

inline constexpr std::string_view faults_of_both = R"([[fault]]
kind = "late"
trial = 1
refresh = 20
ms = 20
[[fault]]
kind = "skip"
trial = 2
refresh = 50
refreshes = 4
[[tracker-fault]]
kind = "gap"
trial = 1
at_s = 0.3
s = 0.1
)";

inline constexpr std::string_view an_unplugged_tracker = R"([[tracker-fault]]
kind = "unplug"
trial = 2
at_s = 0.5
)";

inline ProgramRun replay(const SmallExperiment& experiment, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"replay", experiment.session().string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return experiment.overt(arguments);
}

/// Changes a session file as no program of ours would.
inline void change(const std::filesystem::path& session, const std::string& sql) {
    SQLite::Database database((session / "session.sqlite").string(), SQLite::OPEN_READWRITE);
    INFO(sql);
    REQUIRE(database.exec(sql) > 0);
}

} // namespace overt::test
