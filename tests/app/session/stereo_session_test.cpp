/// Two eyes, each with a picture of its own: through a whole session, its record and its exports.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiment/record/read/session_record.h"
#include "tests/app/two_eyed_experiment.h"
#include "tests/support/tsv_file.h"

using namespace overt;
using namespace overt::test;

namespace {

const std::string both_eyes = with(two_eyed("both"), "rate_hz = 1000\n",
                                   "rate_hz = 1000\nsimulated_noise_deg = 0\nsimulated_accuracy_deg = 0\n");

/// Where a place on the surface is seen by an eye's camera, in pixels of its field.
glm::dvec2 seen_px(const SessionHeader& header, const TrialRecord& trial, int frame, Eye eye,
                   const glm::dvec3& surface) {
    const Stimulus stimulus = header.in_slot(trial.trial.shown(0), eye);
    const RecordedObject& object = header.objects[static_cast<std::size_t>(stimulus.object)];
    const ObjectPose& pose = header.poses.object_of(header.poses.pose_of(stimulus.motion, {frame}));
    const ScreenGeometry& screen = header.display.screen;
    const View view{object.camera(stimulus.view), screen.image_px};
    return view.project(TurntablePose{object.axis_point, pose}.world_from_object() *
                        glm::dvec4(surface, 1.0)) +
           glm::dvec2(screen.image_origin_px);
}

} // namespace

TEST_CASE("of two eyes that are measured each one's gaze is looked up in what that eye saw", "[session]") {
    const SmallExperiment experiment(both_eyes);
    const ProgramRun run = experiment.run({"--trials", "3"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const SessionRecord record(experiment.session());
    const SessionHeader& header = record.header();
    const auto tables = experiment.folder().path() / "tables";
    REQUIRE(experiment.overt({"export", experiment.session().string(), "--out", tables.string()}).exit_code ==
            0);
    const TsvFile samples(tables / "samples.tsv");
    std::map<std::string, int> compared, moved;
    std::map<std::pair<std::string, std::string>, double> left_x;
    std::vector<double> beside_px;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (!samples.has(i, "surface_x"))
            continue;
        const std::string eye = samples.text(i, "eye");
        const TrialRecord& trial = record.trials()[static_cast<std::size_t>(samples.integer(i, "trial") - 1)];
        const glm::dvec3 surface(samples.number(i, "surface_x"), samples.number(i, "surface_y"),
                                 samples.number(i, "surface_z"));
        const auto frame = static_cast<int>(samples.integer(i, "frame"));
        const glm::dvec2 gaze(samples.number(i, "x_px"), samples.number(i, "y_px"));
        const Eye own = eye == "left" ? Eye::left : Eye::right,
                  other = eye == "left" ? Eye::right : Eye::left;
        // It lies on the line of sight of its own eye, and not on the other's.
        REQUIRE(glm::distance(seen_px(header, trial, frame, own, surface), gaze) < 1e-3);
        moved[eye] += glm::distance(seen_px(header, trial, frame, other, surface), gaze) > 0.5;
        ++compared[eye];
        const std::pair when(samples.text(i, "trial"), samples.text(i, "tracker_time_us"));
        if (own == Eye::left)
            left_x[when] = gaze.x;
        else if (const auto pair = left_x.find(when); pair != left_x.end())
            beside_px.push_back(pair->second - seen_px(header, trial, frame, Eye::left, surface).x);
    }
    // What the right eye looks at the left eye looks at, too, 0.2 degrees to the left of it, as it always
    // does.
    REQUIRE(beside_px.size() > 1000);
    std::ranges::nth_element(beside_px,
                             beside_px.begin() + static_cast<std::ptrdiff_t>(beside_px.size() / 2));
    CHECK(beside_px[beside_px.size() / 2] ==
          Approx(-0.2 * header.display.screen.px_per_deg_at_centre()).margin(0.1));
    for (const char* const eye : {"left", "right"}) {
        CAPTURE(eye);
        CHECK(compared[eye] > 1000);
        CHECK(moved[eye] > compared[eye] / 4);
    }
}

TEST_CASE("a session through a stereoscope is verified, shown, analysed and replayed to the bit",
          "[session]") {
    const SmallExperiment experiment(two_eyed("left"));
    const ProgramRun run = experiment.run({"--verify-output"});
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const std::string session = experiment.session().string();
    int left = 0, right = 0;
    const SessionRecord record(session);
    for (const auto& event : record.events()) {
        left += event.detail.find("left eye, page") != std::string::npos &&
                event.detail.find(": 0 of ") != std::string::npos;
        right += event.detail.find("right eye, page") != std::string::npos &&
                 event.detail.find(": 0 of ") != std::string::npos;
    }
    CHECK(left > 10);
    CHECK(left == right);
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"verify", session}, {"show", session}, {"replay", session}}) {
        const ProgramRun done = experiment.overt(command);
        INFO(command.front() << ": " << done.out << done.err);
        CHECK(done.exit_code == 0);
    }
    const auto report = experiment.folder().path() / "report";
    const ProgramRun analysed = experiment.overt({"analyze", session, "--out", report.string()});
    INFO(analysed.err);
    REQUIRE(analysed.exit_code == 0);
    bool says_so = false;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(report))
        if (entry.path().extension() == ".md" || entry.path().extension() == ".html")
            says_so = says_so ||
                      text_of(entry.path()).find("each eye saw a picture of its own") != std::string::npos ||
                      text_of(entry.path()).find("Each eye saw a picture of its own") != std::string::npos;
    CHECK(says_so);
}
