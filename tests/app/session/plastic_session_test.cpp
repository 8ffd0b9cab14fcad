/// Which of two plastics is glossier, path traced and moved by a table, by the commands that a user types.
#include <catch2/catch.hpp>

#include <fstream>

#include "experiment/record/read/session_record.h"
#include "tests/app/stimuli/traced_experiment.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

std::string two_plastics() {
    std::string text =
        with(traced_protocol(),
             "[animation]\nframe_count = 7\nframe_rate_hz = 6\namplitude_deg = 25\nduration_s = 1\n",
             "[animation]\nkind = \"keyframes\"\nkeyframes = \"nod.csv\"\nframe_rate_hz = 6\n"
             "duration_s = 1\n");
    text = with(text, "[[material]]\nid = \"matt\"\nkind = \"diffuse\"\n", "");
    text = with(text, "id = \"smooth\"\nkind = \"smooth-conductor\"\n",
                "id = \"red\"\nkind = \"plastic\"\nreflectance = [0.4, 0.05, 0.05]\n"
                "series = { roughness = [0.05, 0.4] }\n");
    text.erase(text.find("[[task]]"));
    return text + R"(
[[slot]]
id = "left"
right_deg = -3
size_deg = 2

[[slot]]
id = "right"
right_deg = 3
size_deg = 2

[[task]]
id = "glossier"
question = "Which is glossier?"
slots = ["left", "right"]
trials = { rule = "pairs", of = "roughness", side = "crossed" }
steps = [ { show = ["left", "right"], for_s = 1, until = "answer" }, { answer = "which", limit_s = 3 } ]

[[task.answer]]
id = "which"
kind = "choice"
choices = ["left", "right"]
keys = ["left", "right"]
simulated = { by = "roughness", slope = -12, median_s = 0.5 }
)";
}

} // namespace

TEST_CASE("two plastics are baked, compared, recorded, replayed and exported", "[session]") {
    const SmallExperiment experiment(two_plastics(), Cache::own);
    const std::filesystem::path table = experiment.folder().path() / "nod.csv";
    std::ofstream(table) << "t_s,z,qw,qx,qy,qz\n0,0,1,0,0,0\n0.5,8,0.98,0.198997487,0,0\n1,0,1,0,0,0\n";
    const ProgramRun check = experiment.overt({"check", experiment.protocol().string()});
    CAPTURE(check.out, check.err);
    REQUIRE(check.exit_code == 0);
    CHECK_THAT(check.out, Contains("4 distinct poses, from place to place by a table"));
    const ProgramRun bake = experiment.overt(
        {"bake", experiment.protocol().string(), "--quality", "preview", "--context", "osmesa"});
    CAPTURE(bake.out, bake.err);
    REQUIRE(bake.exit_code == 0);
    CHECK(whole_files_below(experiment.cache() / "frames") == 2 * 2 * 4);

    const ProgramRun run = experiment.run();
    CAPTURE(run.out, run.err);
    REQUIRE(run.exit_code == 0);
    std::filesystem::remove(table);
    const std::string session = experiment.session().string();
    CHECK(experiment.overt({"verify", session}).exit_code == 0);
    const ProgramRun replay = experiment.overt({"replay", session});
    CAPTURE(replay.out, replay.err);
    CHECK(replay.exit_code == 0);
    const SessionRecord record(session);
    CHECK(record.header().animations.front().kind == MotionKind::keyframes);
    CHECK(record.header().poses.angles.size() == 4);
    CHECK(record.header().poses.angles[3].tilt.x == Approx(0.198997487));
    CHECK(record.header().poses.angles[3].shift.z == 8.0);
    CHECK(record.trials().size() == 4);
}
