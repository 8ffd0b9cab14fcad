/// Both eyes, 1000 times a second: through the record, the join with the surface, the exports and back.
#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "experiment/record/read/session_record.h"
#include "tests/app/small_experiment.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;

namespace {

const std::string binocular_protocol =
    with(small_protocol, "rate_hz = 1000\n", "rate_hz = 1000\neye = \"both\"\n");

std::vector<GazeSample> of_eye(const std::vector<GazeSample>& samples, Eye eye) {
    std::vector<GazeSample> chosen;
    for (const GazeSample& sample : samples)
        if (sample.eye == eye)
            chosen.push_back(sample);
    return chosen;
}

/// A sample as ASC can hold it: a tenth of a pixel.
using Told = std::tuple<long, Eye, long, long>;
Told told(const GazeSample& sample, const GazeSample& first) {
    const auto ms = std::llround(1e-3 * static_cast<double>((sample.sampled_at - first.sampled_at).count()));
    return {ms, sample.eye, sample.gaze ? std::lround(10.0 * sample.gaze->x_px) : -1,
            sample.gaze ? std::lround(10.0 * sample.gaze->y_px) : -1};
}

} // namespace

TEST_CASE("both eyes at 1000 Hz are in the record, on the surface, in every export, and come back from ASC",
          "[session]") {
    const SmallExperiment experiment(binocular_protocol);
    const ProgramRun run = experiment.run({"--trials", "3"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const std::string session = experiment.session().string();
    const SessionRecord record(session);
    CHECK(record.header().tracker.both_eyes);
    REQUIRE(record.trials().size() == 3);
    for (const auto& trial : record.trials()) {
        const std::vector<GazeSample> samples = record.samples(trial);
        const auto left = of_eye(samples, Eye::left), right = of_eye(samples, Eye::right);
        // A second of animation, each eye once a millisecond.
        CHECK(left.size() >= 1000);
        REQUIRE(left.size() == right.size());
        double apart_px = 0.0;
        for (std::size_t i = 0; i < left.size(); ++i) {
            REQUIRE(left[i].sampled_at == right[i].sampled_at);
            if (i > 0)
                REQUIRE((left[i].sampled_at - left[i - 1].sampled_at).count() == 1000);
            if (left[i].gaze && right[i].gaze)
                apart_px += std::abs(left[i].gaze->x_px - right[i].gaze->x_px);
        }
        CHECK(apart_px > 0.0); // each eye has its own noise
    }

    const auto tables = experiment.folder().path() / "tables";
    REQUIRE(experiment.overt({"export", session, "--out", tables.string()}).exit_code == 0);
    const TsvFile samples(tables / "samples.tsv"), events(tables / "gaze_events.tsv");
    std::map<std::string, long> of, on_surface, fixations, placed;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        ++of[samples.text(i, "eye")];
        on_surface[samples.text(i, "eye")] += samples.text(i, "surface_x") != "n/a";
    }
    CHECK(of.size() == 2);
    CHECK(of["left"] == of["right"]);
    for (const char* const eye : {"left", "right"}) {
        CAPTURE(eye);
        CHECK(on_surface[eye] > of[eye] / 2);
    }
    for (std::size_t i = 0; i < events.size(); ++i)
        fixations[events.text(i, "eye")] += events.text(i, "kind") == "fixation";
    // Each eye's fixations have places by its own samples.
    for (std::size_t i = 0; i < events.size(); ++i)
        placed[events.text(i, "eye")] += events.text(i, "surface_x") != "n/a";
    CHECK(placed["left"] >= 3);
    CHECK(placed["right"] >= 3);
    CHECK(fixations["left"] >= 3);
    CHECK(fixations["right"] >= 3);

    const auto bids = experiment.folder().path() / "bids";
    REQUIRE(experiment.overt({"export", session, "--format", "bids", "--out", bids.string()}).exit_code == 0);
    std::vector<std::string> recordings;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(bids))
        if (entry.path().filename().string().find("_physio.tsv.gz") != std::string::npos)
            recordings.push_back(entry.path().filename().string());
    CHECK(recordings.size() == 4); // of each eye, as measured and on the surface

    const auto asc = experiment.folder().path() / "asc";
    REQUIRE(experiment.overt({"export", session, "--format", "asc", "--out", asc.string()}).exit_code == 0);
    std::filesystem::path file;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(asc))
        if (entry.path().extension() == ".asc")
            file = entry.path();
    const auto back = experiment.folder().path() / "back";
    const ProgramRun imported =
        experiment.overt({"import", file.string(), "--out", back.string(), "--observer", "P01"});
    INFO(imported.err);
    REQUIRE(imported.exit_code == 0);
    const SessionRecord again(back);
    CHECK(again.header().tracker.both_eyes);
    REQUIRE(again.trials().size() == record.trials().size());
    for (std::size_t t = 0; t < again.trials().size(); ++t) {
        const std::vector<GazeSample> a = record.samples(record.trials()[t]),
                                      b = again.samples(again.trials()[t]);
        REQUIRE(a.size() == b.size());
        std::size_t different = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            different += told(a[i], a.front()) != told(b[i], b.front());
        CHECK(different == 0);
    }
}
