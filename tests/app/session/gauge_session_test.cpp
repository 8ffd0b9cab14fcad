/// Sessions in which gauges are set at places of the surface: what is recorded and exported of it, that
/// planted truth comes back, that a killed one goes on, and that all comes out the same when it is presented
/// again.
#include "tests/app/session/interrupted_run.h"

#include <algorithm>

#include "experiment/base/whole_file.h"
#include "tests/app/replay/replayed_session.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

/// The small experiment with one task of a gauge, at so many places of the bust in matt.
std::string gauged(int places, std::string_view simulated, std::string_view more = {}) {
    std::string text(small_protocol);
    text.resize(text.find("[[task]]"));
    return text + fmt::format(R"([[points]]
id = "seen"
object = "bust"
evenly = {}
facing_deg = 70
[[task]]
id = "attitude"
question = "Lean it."
steps = [{{ show = "centre", frame = 0, until = "answer" }}]
[[task.probe]]
id = "place"
points = "seen"
mark = "ring"
[[task.answer]]
id = "lean"
kind = "gauge"
accept_key = "space"
{}
[[block]]
id = "all"
objects = "bust"
materials = "matt"
{})",
                              places, simulated, more);
}

TsvFile gauge_table(const fs::path& folder, const std::string& name) {
    for (const fs::directory_entry& file : fs::recursive_directory_iterator(folder))
        if (file.path().filename() == name)
            return TsvFile(file.path());
    throw std::runtime_error(name);
}

fs::path gauge_export(const SmallExperiment& experiment, const std::string& format) {
    const fs::path out = experiment.folder().path() / format;
    const ProgramRun done = experiment.overt(
        {"export", experiment.session().string(), "--format", format, "--out", out.string()});
    INFO(done.err);
    REQUIRE(done.exit_code == 0);
    return out;
}

} // namespace

TEST_CASE("what is set with a gauge is recorded, exported, presented again and analysed", "[session]") {
    const SmallExperiment experiment(gauged(8, "simulated = { gain = 0.6, median_s = 0.4 }"));
    const ProgramRun run = experiment.run();
    INFO(run.out << run.err);
    REQUIRE(run.exit_code == 0);
    const SessionRecord record(experiment.session());
    REQUIRE(record.header().points.size() == 8);
    REQUIRE(record.trials().size() == 8);
    for (const TrialRecord& trial : record.trials()) {
        CAPTURE(trial.trial.index);
        REQUIRE(trial.outcome.given.size() == 1);
        REQUIRE(trial.outcome.given.front().gauge);
        const GaugeAnswer& gauge = *trial.outcome.given.front().gauge;
        CHECK(gauge.point == own_level(trial.trial, "place"));
        CHECK(gauge.is_visible == true);
        CHECK(gauge.frame == 0);
        REQUIRE(gauge.truth);
        // The gain is one on the depth's rise, the tangent of slant; the tilt stays.
        const double planted = std::tan(to_radians(gauge.set.slant).value),
                     there = std::tan(to_radians(gauge.truth->slant).value);
        CHECK(planted == Approx(0.6 * there).margin(1e-6));
        if (gauge.truth->slant.value > 1.0)
            CHECK(std::cos(to_radians(Degrees{gauge.set.tilt.value - gauge.truth->tilt.value}).value) ==
                  Approx(1.0).margin(1e-9));
        REQUIRE(trial.outcome.probes.size() == 1);
        CHECK(trial.outcome.probes.front().was_visible);
        CHECK(trial.outcome.probes.front().visible_refreshes == trial.outcome.probes.front().shown_refreshes);
        CHECK(std::ranges::any_of(trial.outcome.inputs,
                                  [&](const AnswerInput& input) { return input.attitude == gauge.set; }));
    }
    REQUIRE(experiment.overt({"verify", experiment.session().string()}).exit_code == 0);

    const fs::path tables = gauge_export(experiment, "tsv");
    const TsvFile settings = gauge_table(tables, "gauge_settings.tsv"),
                  points = gauge_table(tables, "points.tsv"), probes = gauge_table(tables, "probes.tsv"),
                  changes = gauge_table(tables, "gauge_changes.tsv");
    REQUIRE(settings.size() == 8);
    CHECK(points.size() == 8);
    CHECK(probes.size() == 8);
    CHECK(changes.size() >= 3 * 8);
    for (std::size_t row = 0; row < 8; ++row) {
        CHECK(settings.text(row, "point") == probes.text(row, "point"));
        CHECK(settings.text(row, "set") == "yes");
        CHECK(settings.number(row, "deviation_deg") >= 0.0);
        CHECK(settings.number(row, "slant_deg") <= settings.number(row, "true_slant_deg") + 1e-3);
        CHECK(probes.text(row, "visible") == "yes");
        CHECK(points.text(row, "point") == fmt::format("seen.{}", row + 1));
        CHECK(points.number(row, "weight_a") + points.number(row, "weight_b") +
                  points.number(row, "weight_c") ==
              Approx(1.0).margin(1e-5));
    }
    std::string events;
    for (const fs::directory_entry& file : fs::recursive_directory_iterator(gauge_export(experiment, "bids")))
        if (file.path().filename().string().ends_with("_events.tsv"))
            events += text_of(file.path());
    CHECK_THAT(events, Contains("true_slant_deg") && Contains("deviation_deg"));

    const fs::path study = experiment.folder().path() / "study";
    const ProgramRun analysed =
        experiment.overt({"analyze", experiment.session().string(), "--format", "tsv", "--resamples", "100",
                          "--permutations", "100", "--out", study.string()});
    INFO(analysed.err);
    REQUIRE(analysed.exit_code == 0);
    const TsvFile reliefs = gauge_table(study, "reliefs.tsv");
    REQUIRE(reliefs.size() == 1);
    CHECK(reliefs.integer(0, "settings") == 8);
    CHECK(reliefs.has(0, "affine_gain"));
    CHECK(gauge_table(study, "relief_points.tsv").size() == 8);

    const ProgramRun replayed = replay(experiment);
    INFO(replayed.out << replayed.err);
    CHECK(replayed.exit_code == 0);
}

TEST_CASE("a session of gauges that was killed goes on with the places that are left", "[session]") {
    // Settings take a while, so that one is under way when it is killed.
    const SmallExperiment experiment(gauged(3, "simulated = { shift_s = 20, median_s = 0.1 }"));
    make_interrupted_session(experiment, 1);
    const ProgramRun resumed = experiment.run({"--resume"});
    INFO(resumed.err);
    REQUIRE(resumed.exit_code == 0);
    const SessionRecord record(experiment.session());
    std::vector<std::string> places;
    for (const TrialRecord& trial : record.trials())
        if (trial.counts)
            places.push_back(trial.outcome.given.front().gauge->point);
    std::ranges::sort(places);
    CHECK(places == std::vector<std::string>{"seen.1", "seen.2", "seen.3"});
    CHECK(experiment.overt({"verify", experiment.session().string()}).exit_code == 0);
}

TEST_CASE("where gaze points is the place of the fixation before the key", "[session]") {
    std::string text(small_protocol);
    text.resize(text.find("[[task]]"));
    const SmallExperiment experiment(text + R"([[task]]
id = "looked"
question = "Look."
steps = [{ show = "centre", for_s = 3, until = "answer" }, { answer = "where", limit_s = 1 },
         { show = "centre", for_s = 3, until = "answer" }, { answer = "there", limit_s = 1 }]
[[task.answer]]
id = "where"
kind = "point"
by = "fixation"
keys = ["space"]
simulated = { shift_s = 1.5 }
[[task.answer]]
id = "there"
kind = "point"
by = "gaze"
keys = ["space"]
simulated = { shift_s = 1.5 }
)");
    const ProgramRun run = experiment.run();
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const fs::path tables = gauge_export(experiment, "tsv");
    const TsvFile given = gauge_table(tables, "given_answers.tsv");
    REQUIRE(given.size() == 8);
    int on_object = 0;
    for (std::size_t row = 0; row < given.size(); ++row) {
        CAPTURE(row);
        CHECK(given.text(row, "answer") == (given.text(row, "id") == "where" ? "fixation" : "gaze"));
        if (!given.has(row, "point_triangle"))
            continue;
        ++on_object;
        CHECK(given.has(row, "point_frame"));
        // Gaze is known to some tenths of a degree, which is some pixels and not a part of one.
        CHECK(given.number(row, "point_sd_major") >= given.number(row, "point_sd_minor"));
        CHECK(given.number(row, "point_sd_minor") > 0.3);
    }
    CHECK(on_object > 3);
}
