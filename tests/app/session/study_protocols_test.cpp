/// The protocols of published studies that come with the program, shortened: that they run, and that what
/// they are about is in the record.
#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "experiment/record/read/session_record.h"
#include "tests/app/session/interrupted_run.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;

namespace {

/// The protocol as it is shipped, with fewer samples and shorter shows, and the name of small experiments, by
/// which their sessions are found.
std::string shortened(const std::string& name) {
    const std::string text =
        text_of(std::filesystem::path(OVERT_SOURCE_DIR) / "protocols" / (name + ".toml"));
    return with(text, "name = \"" + name + "\"", "name = \"small\"") +
           "\n[screens]\ntask_min_s = 0.1\n[bake]\nquality = \"live\"\n";
}

/// In each table below a folder no two columns are called the same.
void expect_a_name_each(const std::filesystem::path& folder) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".tsv")
            continue;
        std::ifstream file(entry.path());
        std::string line;
        std::getline(file, line);
        std::set<std::string> names;
        std::istringstream row(line);
        for (std::string name; std::getline(row, name, '\t');) {
            INFO(entry.path() << ": " << name);
            CHECK(names.insert(name).second);
        }
    }
}

/// Runs it without drawing what nobody sees, verifies the record, and gives the tables' folder.
std::filesystem::path run_study(const SmallExperiment& experiment,
                                const std::vector<std::string>& more = {}) {
    const ProgramRun check = experiment.overt({"check", experiment.protocol().string(), "--observer", "P01"});
    INFO(check.err);
    REQUIRE(check.exit_code == 0);
    std::vector<std::string> arguments =
        run_arguments(experiment, "P01", {"--virtual-time", "--no-pictures"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = experiment.overt(arguments);
    INFO(run.out << run.err);
    REQUIRE(run.exit_code == 0);
    const ProgramRun verified = experiment.overt({"verify", experiment.session().string()});
    INFO(verified.out << verified.err);
    REQUIRE(verified.exit_code == 0);
    const std::filesystem::path tables = experiment.folder().path() / "tables";
    const ProgramRun exported =
        experiment.overt({"export", experiment.session().string(), "--out", tables.string()});
    INFO(exported.err);
    REQUIRE(exported.exit_code == 0);
    const std::filesystem::path bids = experiment.folder().path() / "bids";
    REQUIRE(experiment
                .overt({"export", experiment.session().string(), "--format", "bids", "--out", bids.string()})
                .exit_code == 0);
    expect_a_name_each(tables);
    expect_a_name_each(bids);
    return tables;
}

} // namespace

TEST_CASE("nine qualities are judged of each material, in an order drawn for each trial", "[session]") {
    const SmallExperiment experiment(shortened("material_ratings"));
    const std::filesystem::path tables = run_study(experiment, {"--trials", "3"});
    const SessionRecord record(experiment.session());
    std::set<std::vector<std::string>> orders;
    for (const TrialRecord& trial : record.trials()) {
        if (!trial.counts)
            continue;
        std::vector<std::string> order;
        std::set<std::string> items;
        for (const GivenAnswer& given : trial.outcome.given) {
            CHECK(given.id == "quality");
            CHECK_FALSE(given.is_missed);
            CHECK((given.number && *given.number >= 1.0 && *given.number <= 7.0));
            order.push_back(given.item);
            items.insert(given.item);
        }
        CHECK(items.size() == 9);
        orders.insert(order);
    }
    CHECK(orders.size() == 3);
    const TsvFile given(tables / "given_answers.tsv");
    REQUIRE(given.size() == 27);
    CHECK((given.text(0, "class") == "metal" || given.text(0, "class") == "earth"));
}

TEST_CASE("shapes that were learned are old in the test, and gaze on the middle begins their trials",
          "[session]") {
    const SmallExperiment experiment(with(shortened("shape_recognition"), "for_s = 3 }", "for_s = 0.3 }"));
    const std::filesystem::path tables = run_study(experiment);
    const SessionRecord record(experiment.session());
    CHECK(record.is_complete());
    std::set<int> learned;
    std::map<std::string, int> seen;
    for (const TrialRecord& trial : record.trials()) {
        if (!trial.counts)
            continue;
        const bool is_test =
            record.header().tasks[static_cast<std::size_t>(trial.trial.task)].id == "recognise";
        if (!is_test) {
            learned.insert(trial.trial.stimulus.object);
            CHECK(trial.trial.stimulus.motion == 0);
            const AttemptStep& fixation = trial.outcome.steps.front();
            CHECK((fixation.ended_by == StepEnd::gaze || fixation.ended_by == StepEnd::patience));
            continue;
        }
        CHECK(trial.trial.stimulus.motion == 1);
        ++seen[trial.trial.correct];
        CHECK((trial.trial.correct == "old") == learned.contains(trial.trial.stimulus.object));
        REQUIRE(!trial.outcome.given.empty());
        const GivenAnswer& memory = trial.outcome.given.front();
        if (!memory.is_missed)
            CHECK(memory.is_correct == (memory.value == trial.trial.correct));
    }
    CHECK(learned.size() == 4);
    CHECK(seen == std::map<std::string, int>{{"new", 4}, {"old", 4}});
    // Gaze falls on parts of the shapes.
    const TsvFile samples(tables / "samples.tsv");
    std::set<std::string> parts;
    for (std::size_t i = 0; i < samples.size(); ++i)
        if (samples.has(i, "part"))
            parts.insert(samples.text(i, "part"));
    CHECK(parts.contains("trunk"));
}

TEST_CASE("of two small choices one has the material of the large sample, under another light", "[session]") {
    const SmallExperiment experiment(
        with(shortened("delayed_match"), "blank = [0.5, 2.0, 8.0]", "blank = [0.5, 0.6]"));
    const std::filesystem::path tables = run_study(experiment, {"--trials", "4"});
    const SessionRecord record(experiment.session());
    const std::vector<RecordedSlot>& slots = record.header().slots;
    REQUIRE(slots.size() == 3);
    CHECK(slots[0].size_px.x > slots[1].size_px.x);
    CHECK(slots[1].size_px == slots[2].size_px);
    int trials = 0;
    for (const TrialRecord& trial : record.trials()) {
        if (!trial.counts)
            continue;
        ++trials;
        const Trial& of = trial.trial;
        REQUIRE(of.shown_count() == 3);
        std::string same;
        for (std::size_t i = 0; i < 3; ++i) {
            const PlacedStimulus shown = of.shown(i);
            if (shown.slot > 0 && shown.stimulus.material == of.shown(0).stimulus.material) {
                same = slots[static_cast<std::size_t>(shown.slot)].id;
                CHECK(shown.stimulus.light != of.shown(0).stimulus.light);
            }
        }
        CHECK(same == of.correct);
        // Each slot for its step alone: the sample is over when the choices come.
        const TrialRecord sample = trial.seen_in(0), choice = trial.seen_in(1);
        CHECK(sample.outcome.shown_refreshes == 60);
        CHECK(sample.outcome.presentation_end + from_seconds(0.45) < choice.outcome.presentation_onset);
    }
    CHECK(trials == 4);
    CHECK(TsvFile(tables / "presentations.tsv").size() == 12);
}

TEST_CASE("of two pairs the one that differs more is chosen, as simulated observers mean it", "[session]") {
    const SmallExperiment experiment(shortened("gloss_scaling"));
    const std::filesystem::path tables = run_study(experiment, {"--trials", "24"});
    const SessionRecord record(experiment.session());
    int judged = 0, larger = 0;
    for (const TrialRecord& trial : record.trials()) {
        if (!trial.counts || trial.trial.shown_count() != 4)
            continue;
        const auto roughness = [&](std::size_t place) {
            constexpr double levels[] = {0.04, 0.08, 0.14, 0.22, 0.32, 0.45};
            return levels[trial.trial.shown(place).stimulus.material];
        };
        const double upper = std::abs(roughness(0) - roughness(1)),
                     lower = std::abs(roughness(2) - roughness(3));
        REQUIRE(trial.outcome.given.size() == 1);
        if (std::abs(upper - lower) < 0.1)
            continue; // hard to tell
        ++judged;
        larger += (trial.outcome.given.front().value == "pair-1") == (upper > lower);
    }
    CHECK(judged >= 5);
    CHECK(larger >= judged - 2);
}

TEST_CASE("a target among others is there in half of the trials, and what is right is known", "[session]") {
    const SmallExperiment experiment(shortened("material_search"));
    const std::filesystem::path tables = run_study(experiment, {"--trials", "10"});
    const SessionRecord record(experiment.session());
    std::set<std::size_t> sizes;
    for (const TrialRecord& trial : record.trials()) {
        if (!trial.counts)
            continue;
        sizes.insert(trial.trial.shown_count());
        bool is_there = false;
        for (std::size_t i = 0; i < trial.trial.shown_count(); ++i)
            is_there = is_there || trial.trial.shown(i).stimulus.material == 0;
        CHECK(trial.trial.correct == (is_there ? "present" : "absent"));
        REQUIRE(trial.outcome.given.size() == 1);
        if (!trial.outcome.given.front().is_missed)
            CHECK(trial.outcome.given.front().is_correct ==
                  (trial.outcome.given.front().value == trial.trial.correct));
    }
    CHECK(sizes.size() >= 2);
    CHECK(TsvFile(tables / "given_answers.tsv").size() == 10);
}

TEST_CASE("three that differ are shown for the odd one out, and one of them is chosen", "[session]") {
    const SmallExperiment experiment(shortened("odd_one_out"));
    run_study(experiment, {"--trials", "6"});
    const SessionRecord record(experiment.session());
    std::set<std::string> chosen;
    for (const TrialRecord& trial : record.trials()) {
        if (!trial.counts)
            continue;
        std::set<int> materials;
        for (std::size_t i = 0; i < trial.trial.shown_count(); ++i)
            materials.insert(trial.trial.shown(i).stimulus.material);
        CHECK(materials.size() == 3);
        REQUIRE(trial.outcome.given.size() == 1);
        chosen.insert(trial.outcome.given.front().value);
    }
    for (const std::string& value : chosen)
        CHECK((value == "place-1" || value == "place-2" || value == "place-3"));
}

TEST_CASE("a shape is gone once the eyes were on its crest, and free viewing asks nothing", "[session]") {
    const SmallExperiment contingent(shortened("gaze_contingent"));
    const std::filesystem::path tables = run_study(contingent, {"--trials", "4"});
    int by_gaze = 0;
    const SessionRecord record(contingent.session());
    for (const TrialRecord& trial : record.trials())
        for (const AttemptStep& step : trial.outcome.steps)
            by_gaze += step.id == "search" && step.ended_by == StepEnd::gaze;
    CHECK(by_gaze >= 2);
    const SmallExperiment viewing(shortened("mesh_saliency"));
    run_study(viewing, {"--trials", "2"});
    const SessionRecord viewed(viewing.session());
    for (const TrialRecord& trial : viewed.trials())
        CHECK(trial.outcome.given.empty());
}

TEST_CASE("pictures and a movie are looked at on their own surface, in areas of their pixels", "[session]") {
    const SmallExperiment experiment(with(shortened("pictures"), "duration_s = 4", "duration_s = 1.5"));
    std::filesystem::copy(std::filesystem::path(OVERT_SOURCE_DIR) / "protocols/pictures",
                          experiment.protocol().parent_path() / "pictures");
    const std::filesystem::path tables = run_study(experiment);
    const SessionRecord record(experiment.session());
    CHECK(record.is_complete());
    const ProgramRun replayed =
        experiment.overt({"replay", experiment.session().string(), "--context", "osmesa"});
    INFO(replayed.out << replayed.err);
    CHECK(replayed.exit_code == 0);
    // Twelve pictures a second, one after the other, and from the first again.
    const TsvFile flips(tables / "flips.tsv");
    std::set<long> frames;
    for (std::size_t row = 0; row < flips.size(); ++row)
        if (flips.has(row, "shown_frame"))
            frames.insert(flips.integer(row, "shown_frame"));
    CHECK(frames.size() == 12);
    const TsvFile samples(tables / "samples.tsv");
    const SessionHeader& header = record.header();
    const double mm_per_px = 299.0 / 1080.0;
    std::set<std::string> parts;
    int on_surface = 0;
    for (std::size_t row = 0; row < samples.size(); row += 7) {
        if (!samples.has(row, "surface_x"))
            continue;
        ++on_surface;
        parts.insert(samples.text(row, "part"));
        CHECK(samples.number(row, "surface_y") == 0.0);
        // Millimetres to the right and upwards are pixels to the right and downwards, from the picture's
        // corner.
        const double left = header.display.screen.image_origin_px.x,
                     top = header.display.screen.image_origin_px.y;
        CHECK(samples.number(row, "surface_x") ==
              Approx((samples.number(row, "x_px") - left) * mm_per_px).margin(0.02));
        CHECK(samples.number(row, "surface_z") ==
              Approx((256 - (samples.number(row, "y_px") - top)) * mm_per_px).margin(0.02));
    }
    CHECK(on_surface > 500);
    CHECK(parts == std::set<std::string>{"ball", "body", "face"});
}

TEST_CASE("what is clicked on and looked at are places of the surface, and marked places are chosen between",
          "[session]") {
    const SmallExperiment experiment(
        with(shortened("surface_points"), "draw_points = 40 ", "draw_points = 6 "));
    const std::filesystem::path tables = run_study(experiment);
    const TsvFile given(tables / "given_answers.tsv");
    int on_surface = 0;
    for (std::size_t row = 0; row < given.size(); ++row)
        if (given.text(row, "kind") == "point")
            on_surface += given.has(row, "point_x");
        else
            CHECK((given.text(row, "answer") == "red" || given.text(row, "answer") == "green"));
    CHECK(on_surface >= 4);
    const std::filesystem::path analysis = experiment.folder().path() / "analysis";
    const ProgramRun analysed =
        experiment.overt({"analyze", experiment.session().string(), "--permutations", "100", "--resamples",
                          "100", "--format", "tsv", "--out", analysis.string()});
    INFO(analysed.err);
    REQUIRE(analysed.exit_code == 0);
    // The same places as in the tables of the session.
    const TsvFile points(analysis / "answered_points.tsv");
    int placed = 0;
    std::size_t at = 0;
    for (std::size_t row = 0; row < given.size(); ++row) {
        if (given.text(row, "kind") != "point")
            continue;
        REQUIRE(at < points.size());
        CHECK(points.text(at, "answer") == given.text(row, "id"));
        CHECK(points.has(at, "x") == given.has(row, "point_x"));
        if (points.has(at, "x")) {
            ++placed;
            CHECK(points.number(at, "z") == Approx(given.number(row, "point_z")).margin(0.001));
            CHECK(points.text(at, "part") == given.text(row, "point_part"));
        }
        ++at;
    }
    CHECK(placed == on_surface);
    CHECK(at == points.size());
}

TEST_CASE("gauges, matches and turned objects are run as they are shipped", "[session]") {
    for (const auto& [name, trials, table] : {std::tuple("gauge_figure", "1", "gauge_settings.tsv"),
                                              std::tuple("gloss_matching", "1", "settings.tsv"),
                                              std::tuple("active_exploration", "4", "turns.tsv")}) {
        INFO(name);
        const SmallExperiment experiment(shortened(name));
        const std::filesystem::path tables = run_study(experiment, {"--trials", trials});
        CHECK(TsvFile(tables / table).size() > 0);
    }
}
