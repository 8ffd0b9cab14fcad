/// Sessions on displays that fail, through the program: what is recorded, shown, exported and drawn.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/pictures/picture_file.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/record/read/timing_report.h"
#include "tests/app/small_experiment.h"
#include "tests/support/hurried_observer.h"
#include "tests/support/missed_rows.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;

namespace {

constexpr std::string_view three_faults = R"([[fault]]
kind = "late"
trial = 1
refresh = 20
ms = 20
[[fault]]
kind = "skip"
trial = 2
refresh = 50
refreshes = 4
[[fault]]
kind = "stall"
trial = 2
refresh = 80
ms = 10
)";

} // namespace

TEST_CASE("a session with faults has exactly these in its ledger, its report and its tables", "[session]") {
    const SmallExperiment experiment;
    const std::string faults = experiment.folder().file("faults.toml", three_faults).string();
    const ProgramRun run = experiment.run({"--trials", "3", "--faults", faults});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(run.out.find("3 of 3 trials completed, 7 refreshes missed") != std::string::npos);

    const SessionRecord record(experiment.session());
    const auto events = record.events();
    CHECK(std::count_if(events.begin(), events.end(), [](const RecordedEvent& event) {
              return event.kind == simulated_faults_event && event.detail == three_faults;
          }) == 1);
    CHECK(std::count_if(events.begin(), events.end(),
                        [](const RecordedEvent& event) { return event.kind == "display fault"; }) == 3);

    const TimingReport report = timing_report(record);
    REQUIRE(report.trials.size() == 3);
    CHECK(report.has_simulated_faults);
    CHECK(report.planned_refreshes == 360);
    CHECK(report.flipped_refreshes == 353);
    CHECK(report.missed_refreshes == 7);
    CHECK(report.unaccounted == 0);
    const auto& first = report.trials[0].missed_runs;
    REQUIRE(first.size() == 1);
    CHECK(
        (first[0].refresh_in_trial == 20 && first[0].count == 2 && first[0].cause == MissCause::drawn_late));
    const auto& second = report.trials[1].missed_runs;
    REQUIRE(second.size() == 2);
    CHECK((second[0].refresh_in_trial == 50 && second[0].count == 4 &&
           second[0].cause == MissCause::shown_late));
    CHECK((second[1].refresh_in_trial == 80 && second[1].count == 1 &&
           second[1].cause == MissCause::asked_late));
    CHECK(report.trials[2].missed_runs.empty());
    CHECK(missed_rows(experiment.session(), record.trials()[1].id).size() == 5);
    CHECK(report.samples_off_plan > 0);

    const std::string session = experiment.session().string();
    const std::filesystem::path tables = experiment.folder().path() / "tables";
    REQUIRE(experiment.overt({"export", session, "--out", tables.string()}).exit_code == 0);
    const TsvFile flips(tables / "flips.tsv");
    REQUIRE(flips.size() == 360);
    int missed = 0;
    for (std::size_t i = 0; i < flips.size(); ++i) {
        CHECK(flips.integer(i, "refresh") == static_cast<long>(i % 120));
        missed += flips.text(i, "state") == "missed";
        CHECK((flips.text(i, "cause") == "n/a") == (flips.text(i, "state") == "flipped"));
    }
    CHECK(missed == 7);

    const ProgramRun shown = experiment.overt({"show", session});
    CHECK(shown.out.find("FAULTS WERE SIMULATED") != std::string::npos);
    CHECK(shown.out.find("trial 2: refresh 50: 4 missed, shown late") != std::string::npos);
    const auto json = nlohmann::json::parse(experiment.overt({"show", session, "--json"}).out);
    CHECK(json["timing"]["missed_refreshes"] == 7);
    CHECK(json["timing"]["trials"][1]["missed"][1]["cause"] == "asked late");

    const std::filesystem::path plot = experiment.folder().path() / "timing.svg";
    REQUIRE(experiment.overt({"show", session, "--plot", plot.string()}).exit_code == 0);
    const std::string svg = text_of(plot);
    CHECK(svg.starts_with("<svg"));
    CHECK(svg.ends_with("</svg>\n"));
    CHECK(svg.find("7 of 360 refreshes missed") != std::string::npos);

    // The same as PNG: twice as many pixels as the SVG has points, white at the corner, vermillion for a
    // miss.
    const std::filesystem::path picture = experiment.folder().path() / "timing.png";
    REQUIRE(experiment.overt({"show", session, "--plot", picture.string()}).exit_code == 0);
    PictureFile png(picture, "plot");
    const glm::ivec2 size = png.header().size_px;
    CHECK(size.x == 1800);
    CHECK(svg.find(fmt::format("height=\"{}\"", size.y / 2)) != std::string::npos);
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(3 * size.x * size.y));
    png.read(3, PixelType::bits8, pixels.data());
    CHECK(pixels[0] == 255);
    int vermillion = 0;
    for (std::size_t i = 0; i + 2 < pixels.size(); i += 3)
        vermillion += pixels[i] == 0xd5 && pixels[i + 1] == 0x5e && pixels[i + 2] == 0x00;
    CHECK(vermillion > 100);
    const auto refused =
        experiment.overt({"show", session, "--plot", (experiment.folder().path() / "t.pdf").string()});
    CHECK(refused.exit_code == 2);
    CHECK(refused.err.find("written as .svg or as .png") != std::string::npos);
}

TEST_CASE("stretching shows every frame for its refreshes, and says how much longer it took", "[session]") {
    const SmallExperiment experiment(
        with(small_protocol, "duration_s = 1", "duration_s = 1\nwhen_late = \"stretch\""));
    const std::string faults = experiment.folder().file("faults.toml", three_faults).string();
    REQUIRE(experiment.run({"--trials", "2", "--faults", faults}).exit_code == 0);
    const SessionRecord record(experiment.session());
    const Animation& animation = record.header().animations[0];
    CHECK(animation.when_late == WhenLate::stretch);
    const PageCycle plan = make_page_cycle(animation, 120.0);
    for (const TrialRecord& trial : record.trials()) {
        const std::vector<FlipRecord> flips = record.flips(trial);
        REQUIRE(flips.size() == 120);
        for (std::size_t i = 0; i < flips.size(); ++i)
            CHECK(flips[i].shown == plan.entry_at(static_cast<int>(i)).frame);
        const double longer_s = trial.outcome.missed_refreshes / 120.0;
        CHECK(trial.outcome.missed_refreshes > 0);
        CHECK(to_seconds(trial.outcome.presentation_end - trial.outcome.presentation_onset) ==
              Approx(1.0 + longer_s).margin(1e-8));
    }
}

TEST_CASE("jitter and bare time stamps move no sample to another frame but by chance of a boundary",
          "[session]") {
    const SmallExperiment experiment;
    const std::string faults = experiment.folder()
                                   .file("faults.toml", "[display]\njitter_sd_ms = 0.8\ndrift_ppm = 60\n"
                                                        "time_stamps = \"bare\"\n")
                                   .string();
    REQUIRE(experiment.run({"--trials", "4", "--faults", faults}).exit_code == 0);
    const TimingReport report = timing_report(SessionRecord(experiment.session()));
    CHECK(report.missed_refreshes == 0);
    CHECK(report.unaccounted == 0);
    CHECK(report.stamp_sd_ms == Approx(0.8).epsilon(0.1));
    CHECK(std::abs(report.interval_ms - 1e3 / (120.0 * 1.00006)) < 4.0 * report.interval_uncertainty_ms);
    for (const TrialTiming& trial : report.trials)
        CHECK(trial.onset_uncertainty_ms < 0.4); // of 120 stamps
}

TEST_CASE("a fault file that cannot be meant is refused with its places, and no session begins",
          "[session]") {
    const SmallExperiment experiment;
    const std::string faults =
        experiment.folder().file("faults.toml", "[chance]\nlate_shre = 0.1\n").string();
    const ProgramRun run = experiment.run({"--faults", faults});
    CHECK(run.exit_code == 2);
    CHECK(run.err.find("faults.toml:2:1: error: unknown key \"late_shre\"") != std::string::npos);
    CHECK(run.err.find("did you mean \"late_share\"?") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(experiment.sessions() / "small"));
}

TEST_CASE("what the session's thread was refused is said and recorded, and the session goes on",
          "[session]") {
    const SmallExperiment experiment;
    const ProgramRun run = experiment.run({"--trials", "1", "--pin", "1000"});
    CHECK(run.exit_code == 0);
    CHECK(run.err.find("processor 1000: refused:") != std::string::npos);
    const auto events = SessionRecord(experiment.session()).events();
    CHECK(std::any_of(events.begin(), events.end(), [](const RecordedEvent& event) {
        return event.kind == "thread" && event.detail.starts_with("processor 1000: refused:");
    }));
}

TEST_CASE("a session in real time without a screen claims no number of missed refreshes",
          "[session][waits]") {
    const SmallExperiment experiment;
    const std::string faults =
        experiment.folder()
            .file("faults.toml", "[[fault]]\nkind = \"skip\"\ntrial = 1\nrefresh = 50\nrefreshes = 4\n")
            .string();
    std::vector<std::string> all{"run",
                                 experiment.protocol().string(),
                                 "--observer",
                                 "P01",
                                 "--sessions",
                                 experiment.sessions().string(),
                                 "--context",
                                 "osmesa",
                                 "--trials",
                                 "1",
                                 "--faults",
                                 faults,
                                 "--simulate-observer",
                                 "5"};
    for (std::string& option : hurried(1))
        all.push_back(std::move(option));
    const ProgramRun run = experiment.overt(all);
    const std::string said = run.out + run.err;
    INFO(said);
    REQUIRE(run.exit_code == 0);
    CHECK(said.find("refreshes missed, by times that nothing proves") != std::string::npos);
    CHECK(said.find("refreshes missed\n") == std::string::npos);
    CHECK(said.find("missed refreshes: there was no screen") != std::string::npos);

    // Nor do its record's readers: what the ledger counted was how late the pictures were drawn.
    const SessionRecord record(experiment.session());
    CHECK(record.header().display.timing == "none");
    REQUIRE(record.trials().front().outcome.missed_refreshes >= 4);
    CHECK(record.header().is_timing_unproven());
    const auto shown =
        nlohmann::json::parse(experiment.overt({"show", experiment.session().string(), "--json"}).out);
    CHECK(shown.at("trials").at(0).at("missed_refreshes") == "unproven");
    const std::string tables = (experiment.folder().path() / "tables").string();
    REQUIRE(experiment.overt({"export", experiment.session().string(), "--out", tables}).exit_code == 0);
    const TsvFile trials(std::filesystem::path(tables) / "trials.tsv");
    CHECK_FALSE(trials.has(0, "missed_refreshes"));
    CHECK(trials.text(0, "timing") == "none");
}
