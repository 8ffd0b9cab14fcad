/// What one observer turned is shown to another, refresh by refresh, and gaze falls on the object as it
/// stood.
#include "tests/app/small_experiment.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "experiment/base/whole_file.h"
#include "experiment/factors.h"
#include "experiment/record/read/session_record.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

/// The small experiment with one task, in which the bust is seen in both materials in this motion.
std::string seen_in_motion(std::string_view motion) {
    std::string text = with(small_protocol, R"([animation]
frame_count = 31
frame_rate_hz = 30
amplitude_deg = 25
duration_s = 1
)",
                            motion);
    text.resize(text.find("[[task]]"));
    return text + R"([[task]]
id = "look"
question = "Look."
steps = [ { show = "centre", for_s = 1 } ]
[[block]]
id = "all"
objects = "bust"
)";
}

constexpr std::string_view turned_motion = R"([[motion]]
id = "explore"
kind = "observer"
with = "keys"
step_deg = 5
from_deg = -20
to_deg = 20
elevation_step_deg = 10
elevation_from_deg = -10
elevation_to_deg = 10
simulated_pause_s = 0.1
simulated_turn_deg = 15
duration_s = 1
)";

constexpr std::string_view yoked_motion = R"([[motion]]
id = "again"
kind = "recorded"
recorded = ["P01/courses.tsv"]
)";

void write_text(const fs::path& file, std::string_view text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
}

} // namespace

TEST_CASE("a yoked observer sees at each refresh the pose that another had turned to", "[session]") {
    const SmallExperiment turned(seen_in_motion(turned_motion));
    const ProgramRun first = turned.run();
    INFO(first.out << first.err);
    REQUIRE(first.exit_code == 0);
    const fs::path tables = turned.folder().path() / "tables";
    REQUIRE(turned.overt({"export", turned.session().string(), "--out", tables.string()}).exit_code == 0);

    const SmallExperiment yoked(seen_in_motion(yoked_motion));
    write_text(yoked.protocol().parent_path() / "P01/courses.tsv", read_whole_file(tables / "courses.tsv"));
    const ProgramRun check = yoked.overt({"check", yoked.protocol().string()});
    INFO(check.out << check.err);
    CHECK(check.exit_code == 0);
    CHECK_THAT(check.out, Contains("shown again: ") && Contains("session 1 (2 trials, 1.000 … 1.000 s); each "
                                                                "trial one with the same stimulus"));
    const ProgramRun second = yoked.run();
    INFO(second.out << second.err);
    REQUIRE(second.exit_code == 0);

    const SessionRecord before(turned.session()), after(yoked.session());
    REQUIRE(before.trials().size() == 2);
    REQUIRE(after.trials().size() == 2);
    int changes = 0, tilts = 0;
    for (const TrialRecord& trial : after.trials()) {
        const auto shown = std::ranges::find_if(before.trials(), [&](const TrialRecord& one) {
            return one.trial.stimulus.material == trial.trial.stimulus.material;
        });
        REQUIRE(shown != before.trials().end());
        const std::string_view level = own_level(trial.trial, "yoked_to");
        CHECK(level.ends_with(fmt::format("session 1 trial {}", shown->trial.index + 1)));
        const std::vector<FlipRecord> flips = after.flips(trial), as_turned = before.flips(*shown);
        REQUIRE(flips.size() == 120);
        REQUIRE(as_turned.size() == 120);
        for (std::size_t i = 0; i < flips.size(); ++i) {
            const ObjectPose &again = after.header().poses.object_of(flips[i].pose),
                             &once = before.header().poses.object_of(as_turned[i].pose);
            CHECK(is_same_object_pose(again, once));
            CHECK(flips[i].planned == flips[i].shown);
            changes += i > 0 && flips[i].pose != flips[i - 1].pose ? 1 : 0;
            tilts += again.is_turn() ? 0 : 1;
        }
    }
    CHECK(changes >= 4);
    CHECK(tilts > 0);

    // Its tables have the same courses, and say whose.
    const fs::path again = yoked.folder().path() / "tables";
    REQUIRE(yoked.overt({"export", yoked.session().string(), "--out", again.string()}).exit_code == 0);
    const TsvFile courses(tables / "courses.tsv"), repeated(again / "courses.tsv");
    REQUIRE(courses.size() == repeated.size());
    std::map<std::string, std::vector<std::string>> once, twice;
    for (std::size_t row = 0; row < courses.size(); ++row)
        for (const auto& [table, into] : {std::pair{&courses, &once}, std::pair{&repeated, &twice}})
            (*into)[table->text(row, "material")].push_back(table->text(row, "t_s") + " " +
                                                            table->text(row, "angle_deg") + " " +
                                                            table->text(row, "elevation_deg"));
    CHECK(once == twice);
    CHECK_THAT(TsvFile(again / "trials.tsv").text(0, "yoked_to"), Contains("session 1 trial"));
    CHECK(TsvFile(again / "turns.tsv").text(0, "median_delay_s") == "n/a");
    const ProgramRun verified = yoked.overt({"verify", yoked.session().string()});
    INFO(verified.out << verified.err);
    CHECK(verified.exit_code == 0);
}
