/// What a study of sessions with a turning ball says of places that were pointed at, of light, of how long
/// poses were shown, and of objects whose surface is not there.
#include <algorithm>
#include <array>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/maps/light_pictures.h"
#include "experiment/record/preview_file.h"
#include "experiment/study/read/exposure.h"
#include "experiment/study/read/point_reader.h"
#include "tests/experiment/study/read/watched_ball.h"

using namespace overt;
using namespace overt::testing;
namespace fs = std::filesystem;

namespace {

GivenAnswer pointed_at(const std::string& id, const std::string& value, SessionTime at) {
    GivenAnswer answer{.id = id, .item = {}, .kind = "point", .is_missed = false, .value = value};
    answer.window_onset = at - std::chrono::milliseconds(300);
    answer.answered_at = at;
    return answer;
}

/// From the middle of the screen, as the mouse tells a place.
std::string by_mouse_at(const SessionHeader& header, const ScreenPoint& place) {
    const ScreenPoint middle = header.display.screen.centre();
    return fmt::format("{:.3f} {:.3f}", place.x_px - middle.x_px, place.y_px - middle.y_px);
}

const SurfaceFor surface_of_ball = [](const SessionRecord&, std::size_t, const ViewedObject&) {
    return &maps_of_ball();
};

/// A ball seen everywhere in the middle, without a mesh.
class MiddleOnly final : public SurfaceLookup {
  public:
    std::optional<SurfacePoint> surface_at(PoseIndex, glm::dvec2) const override {
        SurfacePoint point;
        point.position = {1.0, -50.0, 2.0};
        point.part = 1;
        point.depth = 400.0;
        return point;
    }
    bool goes_on(PoseIndex, glm::ivec2, glm::ivec2) const override { return true; }
};

const StudyProgress without_progress = [](std::string_view, int, int) {};

} // namespace

TEST_CASE("places that were pointed at lie on the surface as it stood then, by mouse, gaze and fixation",
          "[unit]") {
    const TemporaryFolder root;
    const SessionHeader header = ball_header("P1");
    const fs::path session =
        watched_session(root.path(), header, [&](const Trial& trial, TrialOutcome& outcome) {
            const auto at = [&](int ms) {
                return outcome.presentation_onset + std::chrono::milliseconds(ms);
            };
            if (trial.index == 1) // lit from 600 ms on: pose 0
                outcome.given = {
                    pointed_at("nose", by_mouse_at(header, seen_at(header, on_head, 0)), at(612)),
                    pointed_at("ear", "gaze", at(601)),
                    pointed_at("eye", "fixation", at(1001)),
                    pointed_at("out", by_mouse_at(header, {3.0, 3.0}), at(612)),
                    pointed_at("word", "gaze", at(612)),
                    pointed_at("never", "gaze", at(612))};
            if (trial.index == 1) {
                outcome.given[4].kind = "choice";
                outcome.given[5].is_missed = true;
            }
        });
    const fs::path other = watched_session(root.path(), ball_header("P0"));
    const StudyResults results = studied({other, session}).results;
    const std::vector<AnsweredPointRow>& rows = results.points.given;
    REQUIRE(rows.size() == 4);
    const std::array<std::string, 4> by{"mouse", "gaze", "fixation", "mouse"},
        ids{"nose", "ear", "eye", "out"};
    for (std::size_t i = 0; i < 4; ++i) {
        CAPTURE(i);
        CHECK(rows[i].of == PointsOf{"P1", "free", ids[i], 0});
        CHECK(rows[i].session == 1);
        CHECK(rows[i].trial == 2);
        CHECK(rows[i].by == by[i]);
        CHECK(rows[i].response_s == 0.3);
        CHECK(rows[i].place.has_value() == (i < 2));
        if (i < 2) {
            CHECK(glm::distance(*rows[i].place, on_head) < 1.5);
            CHECK(rows[i].part == PartIndex{1});
            CHECK(rows[i].part_name == "head");
            const glm::uvec3 corners = maps_of_ball().mesh().triangles[rows[i].triangle.value()];
            glm::dvec3 place(0.0);
            for (int corner = 0; corner < 3; ++corner)
                place += rows[i].barycentric[corner] *
                         glm::dvec3(maps_of_ball().mesh().positions[corners[corner]]);
            CHECK(glm::distance(place, *rows[i].place) < 0.01);
        }
    }
    // A pixel is about one unit, of which the pointer is off by 0.29; the tracker by half a degree, 5 mm.
    const double mm_per_unit = results.objects[0].mm_per_unit.value();
    CHECK(rows[0].largest_sd.value() > 0.28 * 150.0 * 330.0 / 600.0 / (150.0 * mm_per_unit) * 0.5);
    CHECK(rows[0].largest_sd.value() < 1.0);
    CHECK(rows[1].largest_sd.value() > 4.9 / mm_per_unit);
    CHECK(rows[1].largest_sd.value() < 12.0 / mm_per_unit);
}

TEST_CASE("an answer belongs to the presentation in whose picture it lies, else to the first", "[unit]") {
    const TemporaryFolder root;
    SessionHeader header = ball_header("P1");
    header.slots = {{"left", "Left", {100, 200}, {160, 150}}, {"right", "Right", {500, 200}, {160, 150}}};
    header.schedule.trials.resize(1);
    header.schedule.trials[0].beside = {{header.schedule.trials[0].stimulus, 1}};
    const fs::path session = watched_session(root.path(), header, [&](const Trial&, TrialOutcome& outcome) {
        const SessionTime at = outcome.presentation_onset + std::chrono::milliseconds(612);
        outcome.given = {pointed_at("left", by_mouse_at(header, {180.0, 270.0}), at),
                         pointed_at("right", by_mouse_at(header, {580.0, 270.0}), at),
                         pointed_at("out", by_mouse_at(header, {400.0, 270.0}), at)};
        outcome.given[2].answered_at.reset();
    });
    const std::vector<OpenSession> open = open_sessions(std::array{session}, {});
    REQUIRE(open[0].presentations.size() == 2);
    for (const bool is_turned : {false, true}) {
        PointReader reader;
        for (const std::size_t place : {is_turned ? 1u : 0u, is_turned ? 0u : 1u})
            reader.read(open[0], 4, "someone", open[0].presentations[place], static_cast<int>(10 + place),
                        &maps_of_ball());
        const std::vector<AnsweredPointRow> rows = reader.rows();
        REQUIRE(rows.size() == 3);
        CHECK(rows[0].of == PointsOf{"someone", "age", "left", 10});
        CHECK(rows[0].session == 4);
        CHECK(rows[0].place.has_value());
        // Nothing was ever lit in the slot on the right: there the answer is still in no other picture.
        CHECK(rows[1].of.object == 10);
        CHECK_FALSE(rows[1].place);
        CHECK(rows[2].of.object == 10);
        CHECK_FALSE(rows[2].response_s);
    }
}

TEST_CASE("exposure is that of the poses as planned, or as the observer turned them", "[unit]") {
    const TemporaryFolder root;
    const auto seconds_visible = [&](const std::string& observer, bool is_turned, bool is_watched) {
        SessionHeader header = ball_header(observer);
        header.animations.push_back(header.animations.front());
        header.motions = {{.id = "one"}, {.id = "two"}};
        header.poses.of_motion = {{PoseIndex{0}, PoseIndex{1}, PoseIndex{2}},
                                  {PoseIndex{1}, PoseIndex{1}, PoseIndex{2}}};
        header.animations[0].playback = header.animations[1].playback = Playback::cycle;
        header.animations[0].frame_rate_hz = header.animations[1].frame_rate_hz = 2.5;
        header.animations[0].duration_s = header.animations[1].duration_s = 0.8;
        header.schedule.trials[1].stimulus.motion = 1;
        if (is_turned)
            header.animations[0].kind = MotionKind::observer;
        return studied(
                   {is_watched ? watched_session(root.path(), header) : make_session(root.path(), header)})
            .results.exposures.at(0)
            .seconds_visible;
    };
    const auto of_poses = [](double first, double second, double third) {
        const Exposure exposure = exposure_of(maps_of_ball(), std::array{first, second, third});
        return exposure_rows({exposure, maps_of_ball().mesh(), 1.0, 1.0}, 0, {}).at(0).seconds_visible;
    };
    // Two trials of the motion whose frames 0 and 1 are shown for 0.4 s each, one of the other.
    CHECK(seconds_visible("P1", false, true) ==
          Approx(of_poses(0.8 / 3.0, 2.0 / 3.0 * 0.4 + 0.8 / 3.0, 0.0)).epsilon(1e-5));
    // The two were turned: 40 refreshes of 10 ms of each pose.
    CHECK(seconds_visible("P2", true, true) ==
          Approx(of_poses(0.8 / 3.0, 0.8 / 3.0 + 0.8 / 3.0, 0.8 / 3.0)).epsilon(1e-5));
    // Where nobody has looked all motions count alike.
    CHECK(seconds_visible("P3", false, false) == Approx(of_poses(0.2, 0.2 + 0.4, 0.0)).epsilon(1e-5));
    CHECK(seconds_visible("P4", true, false) == Approx(of_poses(0.2, 0.2 + 0.4, 0.0)).epsilon(0.5));
}

TEST_CASE("light at gaze is that of the stimulus's own pictures, unless it was set to match", "[unit]") {
    const TemporaryFolder root;
    const auto study_of_light = [&](const std::string& observer, const std::string& id, bool is_damaged) {
        SessionHeader header = ball_header(observer);
        for (const int material : {0, 1})
            header.stimuli.push_back({{0, material},
                                      "rendered",
                                      std::string(64, static_cast<char>('f' - material)),
                                      std::string(64, 'b')});
        const fs::path session =
            watched_session(root.path(), header, [&](const Trial& trial, TrialOutcome& outcome) {
                if (trial.index != 2)
                    return;
                GivenAnswer match{.id = "match", .item = {}, .kind = "match", .is_missed = true};
                match.slot = id == "other slot" ? 1 : 0;
                match.settings = {{.along = "gloss", .start = 0.5, .final = 1.0, .low = 0.0, .high = 1.0}};
                if (id != "no levels")
                    match.levels = {{0, trial.stimulus, {0.5}}, {1, trial.stimulus, {1.0}}};
                outcome.given = {match};
            });
        // Of the silver one, brighter to the right and in later pictures; of the gold one there is none.
        LightPictures light{{160, 150}, 2, 3};
        for (int picture = 0; picture < 3; ++picture)
            for (int y = 0; y < 75; ++y)
                for (int x = 0; x < 80; ++x) {
                    light.luminance.push_back(static_cast<float>(0.1 + 0.005 * x + 0.02 * picture));
                    light.coverage.push_back(1.0f);
                }
        const fs::path file = session / light_file(header, {0, 1});
        fs::create_directories(file.parent_path());
        write_light_pictures(file, light);
        if (is_damaged)
            std::ofstream(file) << "no picture";
        return studied({session}).results;
    };
    const StudyResults results = study_of_light("P1", "slot", false);
    REQUIRE(results.fixations.size() == 9);
    for (std::size_t i = 0; i < 9; ++i) {
        CAPTURE(i);
        // Trials: silver, gold, and silver that was set to match; the third fixation is beside the ball.
        CHECK(results.fixations[i].light.has_value() == (i < 2));
    }
    CHECK(results.fixations[0].light->met > results.fixations[1].light->met); // body to the right of the head
    CHECK(study_of_light("P2", "no levels", false).fixations[6].light);
    CHECK(study_of_light("P3", "other slot", false).fixations[6].light);
    const StudyResults damaged = study_of_light("P4", "slot", true);
    CHECK_FALSE(damaged.fixations[0].light);
    CHECK(std::ranges::count_if(damaged.remarks, [](const std::string& remark) {
              return remark.starts_with("The light of a stimulus is left out: ");
          }) == 1);
}

TEST_CASE("a surface is that of the first session that has it whole, and its progress is told", "[unit]") {
    const TemporaryFolder root;
    const std::vector<fs::path> sessions{watched_session(root.path(), ball_header("P1")),
                                         watched_session(root.path(), ball_header("P2"))};
    std::vector<std::size_t> asked;
    const auto second_only = [&](const SessionRecord&, std::size_t session,
                                 const ViewedObject&) -> const SurfaceLookup* {
        asked.push_back(session);
        if (session == 0)
            throw InputError("the first is damaged");
        return &maps_of_ball();
    };
    std::vector<std::string> told;
    std::mutex mutex;
    const StudyResults results =
        read_study(sessions, second_only, {}, [&](std::string_view what, int done, int all) {
            const std::scoped_lock lock(mutex);
            told.push_back(fmt::format("{}: {}/{}", what, done, all));
        }).results;
    CHECK(asked == std::vector<std::size_t>{0, 1});
    CHECK(results.objects[0].remark.empty());
    std::ranges::sort(told);
    CHECK(told == std::vector<std::string>{"exposure of ball: 0/1", "exposure of ball: 1/1",
                                           "reading gaze on ball: 1/6", "reading gaze on ball: 2/6",
                                           "reading gaze on ball: 3/6", "reading gaze on ball: 4/6",
                                           "reading gaze on ball: 5/6", "reading gaze on ball: 6/6"});
    // Of two faults the first is told.
    const StudyResults none =
        read_study(
            sessions,
            [](const SessionRecord&, std::size_t session, const ViewedObject&) -> const SurfaceLookup* {
                throw InputError(session == 0 ? "first" : "second");
            },
            {}, without_progress)
            .results;
    CHECK(none.objects[0].remark == "The maps of ball cannot be used, so its gaze is not counted: first");
    CHECK(none.objects[0].mesh == nullptr);
    CHECK(none.exposures.empty());
}

TEST_CASE("sessions read alone and joined have the answers of all, and trials that do not count do not",
          "[unit]") {
    const TemporaryFolder root;
    SessionHeader header = ball_header("P1");
    header.schedule.trials[1].role = TrialRole::practice;
    const fs::path session = watched_session(root.path(), header, [](const Trial&, TrialOutcome& outcome) {
        outcome.given = {
            pointed_at("nose", "gaze", outcome.presentation_onset + std::chrono::milliseconds(601))};
    });
    const auto read = read_sessions(std::array{session}, surface_of_ball, {}, without_progress);
    REQUIRE(read.size() == 1);
    CHECK(read[0].trials.size() == 4);
    CHECK(read[0].trials[1].fixations.empty());
    const StudyResults joined = join_sessions(read, surface_of_ball, {}, without_progress).results;
    const StudyResults whole = studied({session}).results;
    for (const StudyResults* results : {&joined, &whole}) {
        CHECK(results->trials.size() == 2);
        CHECK(results->answers.given.size() == 2);
        CHECK(results->points.given.size() == 2);
        CHECK(results->glance.samples == 2 * 2 * 650);
        CHECK(results->session_quality.at(0).missed_refreshes == 2);
        CHECK(results->exposures.size() == 3);
        CHECK(results->sessions[0].trials == 2);
        CHECK(results->fixations.size() == 6);
        CHECK(results->fixations[5].trial == 1);
        CHECK(results->trials[1].first_fixation == 3);
    }
    CHECK(joined.sessions[0].events == whole.sessions[0].events);
    CHECK_FALSE(whole.sessions[0].events.empty());
}

TEST_CASE("ready-made maps without a mesh give places, and surfaces without parts no areas", "[unit]") {
    const TemporaryFolder root;
    const std::vector<fs::path> sessions{watched_session(root.path(), ball_header("P1"))};
    const MiddleOnly middle;
    const ReadStudy ready_made = read_study(
        sessions, [&](const SessionRecord&, std::size_t, const ViewedObject&) { return &middle; }, {},
        without_progress);
    const StudyObject& object = ready_made.results.objects.at(0);
    CHECK(object.remark ==
          "Of ball there are ready-made maps and no mesh: fixations have places but there are no "
          "maps on the surface.");
    CHECK(object.mesh == nullptr);
    CHECK(object.mm_per_unit);
    CHECK(object.mm_per_deg);
    CHECK(object.shown_size);
    CHECK(ready_made.results.exposures.empty());
    CHECK(ready_made.surfaces.at(0).geometry == nullptr);
    CHECK(std::ranges::count(ready_made.results.remarks, object.remark) == 1);
    for (const StudyFixation& fixation : ready_made.results.fixations) {
        CHECK(fixation.position == glm::dvec3(1.0, -50.0, 2.0));
        CHECK_FALSE(fixation.triangle);
        CHECK(fixation.evidence.empty());
    }
    // The mesh's own parts are those of the study, whatever the session says; one part is no area.
    const test::CastScene plain(test::icosphere(50.0, 2), turning_ball().angles, {160, 150}, 0.2);
    const CoordinateMaps maps = plain.maps();
    const StudyResults whole =
        read_study(
            sessions, [&](const SessionRecord&, std::size_t, const ViewedObject&) { return &maps; }, {},
            without_progress)
            .results;
    CHECK(whole.objects[0].part_names == plain.mesh.part_names);
    CHECK(whole.objects[0].mesh->positions.size() == plain.mesh.positions.size());
    CHECK(whole.objects[0].remark == "ball has no named areas: there are no shares of its parts.");
    // Without a known screen there are no millimetres, but a surface.
    SessionHeader unknown = ball_header("P2");
    unknown.display.screen.viewing_distance_mm = 0.0;
    const ReadStudy without_scale = studied({watched_session(root.path(), unknown)});
    CHECK_FALSE(without_scale.results.objects[0].mm_per_unit);
    REQUIRE(without_scale.surfaces[0].geometry);
    CHECK(without_scale.surfaces[0].coarse == nullptr);
    CHECK(without_scale.surfaces[0].areas_mm2.size() == maps_of_ball().mesh().positions.size());
    CHECK(without_scale.surfaces[0].pixel_seconds.size() == maps_of_ball().mesh().positions.size());
    CHECK(without_scale.results.exposures.empty());
    CHECK(without_scale.results.fixations[0].evidence.empty());
    CHECK_FALSE(without_scale.results.fixations[0].spread_mm);
}

TEST_CASE("evidence takes each trial's own accuracy, and fixations that missed the surface by as much",
          "[unit]") {
    const TemporaryFolder root;
    std::vector<fs::path> sessions;
    for (const char* const observer : {"P1", "P2", "P3", "P4"})
        sessions.push_back(watched_session(root.path(), ball_header(observer)));
    const StudyResults results = studied(sessions).results;
    REQUIRE(results.fixations.size() == 36);
    // The first trial's tracker was off by 0.3 degrees, that of the others by 0.5: the same place tells more.
    const auto told = [&](std::size_t fixation) { return results.fixations[fixation].evidence.at(1); };
    CHECK(told(1).inside > told(4).inside);
    CHECK(told(1).inside == Approx(told(10).inside).epsilon(1e-9));
    CHECK(told(4).inside == Approx(told(7).inside).epsilon(1e-9));
    for (std::size_t i = 0; i < 36; ++i)
        CHECK(results.fixations[i].evidence.empty() == (i % 3 == 2)); // those are 70 units away
    CAPTURE(told(0).inside, told(0).elsewhere, told(1).inside, told(1).elsewhere);
    CHECK(told(1).inside > 100.0 * told(1).elsewhere);
}
